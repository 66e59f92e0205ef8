// The timing driver on a made-up machine: a clock that the frames advance, and threads that wait
// when the test says so.
#include "app/measure/timing/driver.h"
#include "renderer/base/assert.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    SUBJECTS = 12,
    STARTS = 2,
    ROUNDS = 5, // Of each start.
    ALL_ROUNDS = STARTS * ROUNDS,
    PER_ROUND = 2,
    PATH = ALL_ROUNDS * PER_ROUND,
    COPIES = 3,
    WARM = 2,
    MOST_TURNS = 20000
};

// Subjects 0 to 8 have the base 0, subjects 9 to 11 the base 9.
static const int bases[SUBJECTS] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 9, 9, 9};

typedef struct Machine {
    int64_t now_ns;
    DipThreadUse use;
    DipDriverTurn turns[MOST_TURNS];
    int turn_count;
    int starts[16]; // As they were begun.
    int start_count;
    DipTimed kept[MOST_TURNS]; // What the journal has.
    int kept_count;
    int kept_rounds;
    int busy_round;   // In this round of all starts, frames wait for half of their time; -1: none.
    int busy_subject; // Only this subject waits; -1: all do.
    bool busy_again;  // The first repetition waits longer.
    bool busy_always;
    bool busy_at_first; // All frames wait, until the rounds are repeated.
    double slow_down;   // Per frame: the machine becomes slower all the time.
    double start_ms;
    int settling;
    int fail_at;       // The turn that fails; -1 for none.
    bool is_elsewhere; // Another process draws, and tells its times.
    bool tells_no_wait;
    bool stands_still; // The clock does not advance.
    int prepared;      // Number of frames that were prepared.
} Machine;

static Machine m;
static DipDriver *driver;

static double true_ms(int subject, int frame) {
    return (1.0 + 0.5 * subject) * (4.0 + 0.1 * frame);
}

static bool is_busy(const DipDriverTurn *turn) {
    return turn->round >= 0 && (m.busy_subject < 0 || turn->subject == m.busy_subject) &&
           (turn->start * ROUNDS + turn->round == m.busy_round ||
            (m.busy_at_first && m.kept_rounds < ALL_ROUNDS) || m.busy_always);
}

static bool draw(void *context, const DipDriverTurn *turn, DipTimed *timed, DipError *err) {
    (void)context;
    if (m.turn_count == m.fail_at) {
        return dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "draw", "failed");
    }
    assert_true(m.turn_count < MOST_TURNS);
    m.turns[m.turn_count++] = *turn;
    double ms = true_ms(turn->subject, turn->frame) * (1.0 + m.slow_down * m.turn_count);
    if (turn->phase == DIP_DRIVER_UNTIMED) {
        ms *= 3.0; // The caches are cold.
    } else if (turn->phase == DIP_DRIVER_SETTLE) {
        // Each of the first fifteen is 5 ms faster than the one before; later ones are equal.
        ms = m.settling < 15 ? 100.0 - 5.0 * m.settling : 25.0;
        m.settling++;
    }
    int64_t ns = (int64_t)llround(1e6 * ms);
    m.use.cpu_ns += ns;
    if (is_busy(turn)) {
        m.use.wait_ns += ns;
        m.use.switches += 3;
        ns *= 2;
    } else if (m.busy_again && m.kept_rounds == ALL_ROUNDS) {
        m.use.wait_ns += 3 * ns;
        ns *= 4;
    }
    m.now_ns += m.stands_still ? 0 : ns;
    timed->parts_ms[1] = 0.25 * ms;
    if (m.is_elsewhere) {
        timed->ms = ms;
        timed->wait = m.tells_no_wait ? NAN : 0.125;
        timed->cpu_ms = 2.0 * ms;
        m.now_ns += 1000000; // Telling takes time, too.
    }
    return true;
}

// Takes long, and its threads wait.
static bool prepare(void *context, const DipDriverTurn *turn, DipError *err) {
    (void)context;
    (void)turn;
    (void)err;
    m.prepared++;
    m.now_ns += 70000000;
    m.use.cpu_ns += 50000000;
    m.use.wait_ns += 20000000;
    return true;
}

static bool start(void *context, int index, DipError *err) {
    (void)context;
    (void)err;
    m.starts[m.start_count++] = index;
    m.now_ns += (int64_t)(1e6 * m.start_ms);
    return true;
}

static bool keep(void *context, const DipTimed *timed, int count, DipError *err) {
    (void)context;
    (void)err;
    memcpy(m.kept + m.kept_count, timed, (size_t)count * sizeof *timed);
    m.kept_count += count;
    m.kept_rounds++;
    return true;
}

static int64_t clock_ns(void *context) {
    (void)context;
    return m.now_ns;
}

static DipThreadUse thread_use(void *context) {
    (void)context;
    return m.use;
}

static DipDriverDef path_def(void) {
    return (DipDriverDef){
        .subjects = SUBJECTS,
        .base_of = bases,
        .block_subjects = 3,
        .starts = STARTS,
        .rounds = ROUNDS,
        .frames = PATH,
        .base_copies = COPIES,
        .warm_frames = WARM,
        .seed = 7,
        .most_wait = DIP_TIMED_MOST_WAIT,
    };
}

static DipDriverCalls calls = {
    .draw = draw, .start = start, .keep = keep, .clock_ns = clock_ns, .thread_use = thread_use};

static void begin(const DipDriverDef *def) {
    driver = dip_driver_create(def, &calls, NULL);
    assert_non_null(driver);
}

static DipDriverStep work(DipError *err) {
    DipDriverStep step;
    do {
        const int before = m.turn_count;
        step = dip_driver_step(driver, err);
        assert_in_range(m.turn_count - before, 0, 1); // One frame at most.
    } while (step < DIP_DRIVER_DONE);
    return step;
}

static void work_until_done(const DipDriverDef *def) {
    begin(def);
    assert_int_equal(work(NULL), DIP_DRIVER_DONE);
}

static int set_up(void **state) {
    (void)state;
    memset(&m, 0, sizeof m);
    m.busy_round = m.fail_at = m.busy_subject = -1;
    m.use.has_wait = true;
    m.now_ns = 1000;
    calls.prepare = NULL;
    return 0;
}

static int tear_down(void **state) {
    (void)state;
    dip_driver_destroy(&driver);
    assert_null(driver);
    return 0;
}

static int round_of(const DipTimed *timed) {
    return timed->start * ROUNDS + timed->round;
}

// --- a path --------------------------------------------------------------------------------------

static void every_frame_is_timed_once_beside_its_base(void **state) {
    (void)state;
    static int timed_in[SUBJECTS * PATH][ALL_ROUNDS];
    const DipDriverDef def = path_def();
    memset(timed_in, 0, sizeof timed_in);
    work_until_done(&def);
    const DipTimes times = dip_driver_times(driver);
    assert_true(times.subjects == SUBJECTS && times.starts == STARTS && times.rounds == ROUNDS &&
                times.frames == PATH);
    assert_memory_equal(times.base_of, bases, sizeof bases);
    for (int i = 0; i < times.count; i++) {
        const DipTimed *timed = &times.list[i];
        assert_true(fabs(timed->ms - true_ms(timed->subject, timed->frame)) < 1e-5);
        assert_true(fabs(timed->parts_ms[1] - 0.25 * timed->ms) < 1e-5);
        timed_in[timed->subject * PATH + timed->frame][round_of(timed)]++;
    }
    for (int s = 0; s < SUBJECTS; s++) {
        for (int f = 0; f < PATH; f++) {
            int rounds = 0, all = 0;
            for (int r = 0; r < ALL_ROUNDS; r++) {
                rounds += timed_in[s * PATH + f][r] > 0;
                all += timed_in[s * PATH + f][r];
            }
            assert_int_equal(rounds, bases[s] == s ? COPIES : 1);
            assert_true(bases[s] == s || all == 1);
        }
    }
    DipTimesFit *fit = dip_times_fit(&times, NULL);
    assert_non_null(fit);
    for (int s = 0; s < SUBJECTS; s++) {
        const DipAlong along = dip_times_along(fit, s);
        assert_int_equal(along.timed, bases[s] == s ? 0 : PATH);
        assert_int_equal(along.kept, along.timed);
        assert_true(fabs(dip_times_shares(fit, s)[1] - 0.25) < 1e-6);
    }
    dip_times_fit_free(&fit);
    // In each round: 8 subjects in 3 blocks, 2 subjects in 1 block, and a base in each block; a
    // visit has an untimed frame; and each base draws each frame in two more rounds.
    assert_int_equal(m.turn_count, STARTS * SUBJECTS * WARM +
                                       ALL_ROUNDS * (8 + 3 + 2 + 1) * (PER_ROUND + 1) +
                                       2 * (COPIES - 1) * PATH);
    const DipDriverMachine machine = dip_driver_machine(driver, 1);
    assert_true(machine.settled && machine.has_wait && machine.wait == 0.0 && !machine.repeated);
}

// A coarse clock may show the same time before and after a frame.
static void a_clock_that_stands_still_gives_a_least_time(void **state) {
    (void)state;
    const DipDriverDef def = path_def();
    m.stands_still = true;
    work_until_done(&def);
    const DipTimes times = dip_driver_times(driver);
    assert_true(times.count > 0);
    for (int i = 0; i < times.count; i++) {
        assert_true(times.list[i].ms == 1e-6 && times.list[i].wait == 0.0);
    }
}

static void what_is_prepared_is_not_timed(void **state) {
    (void)state;
    const DipDriverDef def = path_def();
    calls.prepare = prepare;
    work_until_done(&def);
    const DipTimes times = dip_driver_times(driver);
    assert_true(times.count > 0);
    for (int i = 0; i < times.count; i++) {
        const DipTimed *timed = &times.list[i];
        const double ms = true_ms(timed->subject, timed->frame);
        assert_true(fabs(timed->ms - ms) < 1e-5 && fabs(timed->cpu_ms - ms) < 1e-5);
        assert_true(timed->wait == 0.0);
    }
    assert_int_equal(m.prepared, m.turn_count);
}

// The frames of each block in the order in which they were drawn: whole visits, each with an
// untimed frame first, and the base's among them.
static void visits_begin_untimed_and_lie_beside_the_base(void **state) {
    (void)state;
    const DipDriverDef def = path_def();
    work_until_done(&def);
    int visit_of_base[2] = {0};
    for (int i = 0; i < m.turn_count; i++) {
        const DipDriverTurn *turn = &m.turns[i];
        if (turn->phase != DIP_DRIVER_UNTIMED) {
            continue;
        }
        int from = i, end = i;
        const DipDriverTurn *next = turn + 1;
        assert_true(next->phase == DIP_DRIVER_TIMED && next->subject == turn->subject &&
                    next->frame == turn->frame); // The same frame is timed at once.
        // At most 4 visits of a block: the base's is not farther than 3 visits away.
        bool found = false;
        const int most = 3 * (PER_ROUND + 1 + (COPIES - 1) * PER_ROUND);
        from = i > most ? i - most : 0;
        end = i + most < m.turn_count ? i + most : m.turn_count - 1;
        for (int j = from; j <= end; j++) {
            found |= m.turns[j].subject == bases[turn->subject] &&
                     m.turns[j].round == turn->round && m.turns[j].start == turn->start;
        }
        assert_true(found);
        visit_of_base[bases[turn->subject] == 9] += turn->subject == bases[turn->subject];
    }
    assert_int_equal(visit_of_base[0], 3 * ALL_ROUNDS);
    assert_int_equal(visit_of_base[1], ALL_ROUNDS);
}

static void visits_of_a_log_begin_in_order(void **state) {
    (void)state;
    const DipDriverDef def = path_def();
    work_until_done(&def);
    const DipTimes times = dip_driver_times(driver);
    assert_int_equal(times.list[0].begin_ns,
                     llround(1e6 * WARM * (12.0 * 4.0 + 33.0 * 4.0) + 1e6 * 0.1 * (12.0 + 33.0)));
    for (int i = 1; i < times.count; i++) {
        const DipTimed *a = &times.list[i - 1], *b = &times.list[i];
        const bool same =
            a->block == b->block && a->subject == b->subject && round_of(a) == round_of(b);
        assert_true(same ? a->begin_ns == b->begin_ns : a->begin_ns < b->begin_ns);
    }
}

static void order_follows_the_seed(void **state) {
    (void)state;
    static DipDriverTurn first[MOST_TURNS];
    DipDriverDef def = path_def();
    work_until_done(&def);
    memcpy(first, m.turns, sizeof first);
    const int count = m.turn_count;
    tear_down(NULL);
    set_up(NULL);
    work_until_done(&def);
    assert_int_equal(m.turn_count, count);
    assert_memory_equal(m.turns, first, sizeof first);
    tear_down(NULL);
    set_up(NULL);
    def.seed = 8;
    work_until_done(&def);
    assert_memory_not_equal(m.turns, first, sizeof first);
}

static void starts_begin_with_untimed_frames(void **state) {
    (void)state;
    const DipDriverDef def = path_def();
    work_until_done(&def);
    assert_int_equal(m.start_count, STARTS);
    for (int s = 0; s < STARTS; s++) {
        assert_int_equal(m.starts[s], s);
    }
    int begun = 0;
    for (int i = 0; i < m.turn_count; i++) {
        begun += m.turns[i].phase == DIP_DRIVER_WARM_UP && m.turns[i].subject == 0 &&
                 m.turns[i].frame == 0;
        assert_int_equal(m.turns[i].start, begun - 1);
    }
}

static void drift_cancels(void **state) {
    (void)state;
    const DipDriverDef def = path_def();
    m.slow_down = 0.005; // The last frames take several times as long as the first.
    work_until_done(&def);
    const DipTimes times = dip_driver_times(driver);
    DipTimesFit *fit = dip_times_fit(&times, NULL);
    assert_non_null(fit);
    assert_true(fabs(dip_times_ratio(fit, 5).value / 3.5 - 1.0) < 0.02);
    dip_times_fit_free(&fit);
}

// The medians of five are 90, 65, 40, 25 and 25 ms, so settling ends with the fifth.
static void settling_ends_when_two_medians_agree(void **state) {
    (void)state;
    DipDriverDef def = path_def();
    def.settle = true;
    work_until_done(&def);
    assert_int_equal(m.settling, 25);
    assert_int_equal(m.turns[SUBJECTS * WARM].phase, DIP_DRIVER_SETTLE);
    assert_true(dip_driver_machine(driver, 1).settled);
}

// --- disturbed frames ----------------------------------------------------------------------------

static void a_few_disturbed_frames_are_left(void **state) {
    (void)state;
    const DipDriverDef def = path_def();
    m.busy_round = 2; // 2 of 20 frames: more than three quarters are left.
    work_until_done(&def);
    const DipTimes times = dip_driver_times(driver);
    const DipDriverMachine machine = dip_driver_machine(driver, 1);
    assert_int_equal(machine.repeated, 0);
    assert_true(machine.wait > 0.05 && machine.wait < 0.1);
    for (int i = 0; i < times.count; i++) {
        const bool busy = round_of(&times.list[i]) == 2;
        assert_true(busy ? fabs(times.list[i].wait - 0.5) < 1e-6 && times.list[i].switches == 3.0
                         : times.list[i].wait == 0.0);
    }
    DipTimesFit *fit = dip_times_fit(&times, NULL);
    assert_non_null(fit);
    assert_int_equal(dip_times_along(fit, 3).kept, PATH - PER_ROUND);
    dip_times_fit_free(&fit);
}

static void many_disturbed_frames_are_drawn_again(void **state) {
    (void)state;
    const DipDriverDef def = path_def();
    m.busy_at_first = true;
    work_until_done(&def);
    // Eight rounds reach three quarters of ten; then no more are repeated.
    assert_int_equal(m.kept_rounds, ALL_ROUNDS + 8);
    assert_int_equal(m.start_count, STARTS);
    const DipTimes times = dip_driver_times(driver);
    assert_true(dip_driver_machine(driver, 1).repeated > 0);
    DipTimesFit *fit = dip_times_fit(&times, NULL);
    assert_non_null(fit);
    for (int s = 0; s < SUBJECTS; s++) {
        const DipAlong along = dip_times_along(fit, s);
        assert_true(bases[s] == s || (along.timed == PATH && along.kept == 16));
    }
    dip_times_fit_free(&fit);
    int again = 0;
    for (int i = 0; i < times.count; i++) {
        again += times.list[i].block >= SUBJECTS;
        assert_true(times.list[i].block < SUBJECTS || times.list[i].wait == 0.0);
    }
    assert_true(again > 0);
}

// Only the base waits, and so do the frames beside it.
static void frames_beside_a_disturbed_base_are_drawn_again(void **state) {
    (void)state;
    const DipDriverDef def = path_def();
    m.busy_at_first = true;
    m.busy_subject = 9;
    work_until_done(&def);
    assert_int_equal(m.kept_rounds, ALL_ROUNDS + 8);
    const DipTimes times = dip_driver_times(driver);
    for (int i = 0; i < times.count; i++) {
        assert_true(times.list[i].block < SUBJECTS || bases[times.list[i].subject] == 9);
    }
}

static void worse_repetitions_are_not_kept(void **state) {
    (void)state;
    const DipDriverDef def = path_def();
    m.busy_at_first = m.busy_again = true;
    work_until_done(&def);
    const DipTimes times = dip_driver_times(driver);
    int first = 0;
    for (int i = 0; i < times.count; i++) {
        assert_true(times.list[i].wait < 0.6);
        first += times.list[i].block >= SUBJECTS && round_of(&times.list[i]) == 0;
    }
    assert_int_equal(first, 0);
    assert_int_equal(m.kept_rounds, ALL_ROUNDS + 9);
}

// The first repetitions show that the machine is still busy, so there are no more.
static void a_machine_that_stays_busy_repeats_little(void **state) {
    (void)state;
    const DipDriverDef def = path_def();
    m.busy_always = true;
    work_until_done(&def);
    assert_int_equal(m.kept_rounds, ALL_ROUNDS + 2);
}

// A base is drawn first, last and between in about equally many of its blocks.
static void visits_of_a_block_have_no_fixed_order(void **state) {
    (void)state;
    const DipDriverDef def = {.subjects = 5,
                              .base_of = bases,
                              .block_subjects = 4,
                              .starts = 1,
                              .rounds = 100,
                              .frames = 1,
                              .seed = 5};
    int at[5] = {0};
    work_until_done(&def);
    for (int i = 0; i < m.turn_count; i++) {
        at[i / 2 % 5] += m.turns[i].subject == 0 && m.turns[i].phase == DIP_DRIVER_TIMED;
    }
    for (int i = 0; i < 5; i++) {
        assert_in_range(at[i], 8, 35); // About 20 are expected.
    }
    static DipDriverTurn first[MOST_TURNS];
    memcpy(first, m.turns, sizeof first);
    DipDriverDef other = def;
    other.seed = 6;
    tear_down(NULL);
    set_up(NULL);
    work_until_done(&other);
    assert_memory_not_equal(first, m.turns, sizeof first);
}

static void without_a_limit_nothing_is_disturbed(void **state) {
    (void)state;
    DipDriverDef def = path_def();
    def.most_wait = 0.0;
    m.busy_at_first = true;
    work_until_done(&def);
    assert_int_equal(m.kept_rounds, ALL_ROUNDS);
    m.use.has_wait = false;
    def = path_def();
    tear_down(NULL);
    work_until_done(&def);
    assert_false(dip_driver_machine(driver, 1).has_wait);
    assert_true(dip_driver_machine(driver, 4).wait > 0.7); // One processor of four worked.
}

// --- resuming ------------------------------------------------------------------------------------

// Compares everything but the moments.
static void check_same(const DipTimes *a, const DipTimed *list, int count) {
    assert_int_equal(a->count, count);
    for (int i = 0; i < count; i++) {
        const DipTimed *x = &a->list[i], *y = &list[i];
        assert_true(x->subject == y->subject && x->start == y->start && x->round == y->round);
        assert_true(x->block == y->block && x->frame == y->frame);
        assert_true(x->ms == y->ms && x->wait == y->wait && x->cpu_ms == y->cpu_ms);
        assert_true(x->switches == y->switches);
        assert_memory_equal(x->parts_ms, y->parts_ms, sizeof x->parts_ms);
    }
}

// Resumes after each number of rounds. The log is that of the uninterrupted measurement.
static void check_resume(const DipDriverDef *def) {
    static DipTimed kept[MOST_TURNS], whole[MOST_TURNS];
    const Machine begin_with = m;
    work_until_done(def);
    const DipTimes times = dip_driver_times(driver);
    const int count = times.count, rounds = m.kept_rounds, kept_count = m.kept_count;
    const DipDriverMachine machine = dip_driver_machine(driver, 1);
    memcpy(whole, times.list, (size_t)count * sizeof *whole);
    memcpy(kept, m.kept, sizeof kept);
    int known = 0;
    for (int round = 0; round <= rounds; round++) {
        tear_down(NULL);
        m = begin_with;
        m.kept_rounds = round;
        begin(def);
        assert_true(dip_driver_resume(driver, kept, known));
        const DipDriverProgress at_first = dip_driver_progress(driver);
        assert_int_equal(at_first.drawn, 0);
        assert_int_equal(at_first.rounds, round < ALL_ROUNDS ? round : ALL_ROUNDS);
        assert_int_equal(work(NULL), DIP_DRIVER_DONE);
        assert_true(round >= ALL_ROUNDS || dip_driver_progress(driver).drawn == at_first.total);
        const DipTimes again = dip_driver_times(driver);
        check_same(&again, whole, count);
        assert_true(dip_driver_machine(driver, 1).wait == machine.wait);
        assert_int_equal(dip_driver_machine(driver, 1).repeated, machine.repeated);
        for (int i = 1; i < again.count; i++) {
            assert_true(again.list[i].block >= SUBJECTS || again.list[i - 1].block >= SUBJECTS ||
                        again.list[i].begin_ns >= again.list[i - 1].begin_ns);
        }
        assert_int_equal(m.kept_count, kept_count - known);
        if (known == kept_count) {
            assert_int_equal(m.turn_count, 0); // Nothing is left to draw.
            break;
        }
        const DipTimed *first = &kept[known];
        const bool repeated = first->block >= SUBJECTS;
        while (known < kept_count && round_of(&kept[known]) == round_of(first) &&
               (kept[known].block >= SUBJECTS) == repeated) {
            known++;
        }
    }
    // One time more than a measurement can have is not used.
    tear_down(NULL);
    m = begin_with;
    begin(def);
    kept[kept_count] = kept[kept_count - 1];
    assert_false(dip_driver_resume(driver, kept, kept_count + 1));
}

static void resumed_rounds_are_those_of_the_whole(void **state) {
    (void)state;
    const DipDriverDef def = path_def();
    check_resume(&def);
}

static void resumed_repetitions_are_those_of_the_whole(void **state) {
    (void)state;
    const DipDriverDef def = path_def();
    m.busy_at_first = true;
    check_resume(&def);
    tear_down(NULL);
    set_up(NULL);
    m.busy_always = true;
    check_resume(&def);
}

// A journal of another seed, cut short, or forged is used up to where it differs.
static void what_does_not_fit_is_drawn(void **state) {
    (void)state;
    static DipTimed kept[MOST_TURNS];
    DipDriverDef def = path_def();
    work_until_done(&def);
    memcpy(kept, m.kept, sizeof kept);
    const int count = m.kept_count;
    int round = 1;
    while (round_of(&kept[round]) == round_of(&kept[0])) {
        round++;
    }
    for (int change = 0; change < 9; change++) {
        tear_down(NULL);
        set_up(NULL);
        DipTimed saved = kept[round + 3];
        DipTimed *timed = &kept[round + 3];
        def.seed = change ? 7 : 8;
        begin(&def);
        timed->subject = change == 1 ? timed->subject + 1 : timed->subject;
        timed->frame = change == 2 ? -1 : timed->frame;
        timed->ms = change == 3 ? 0.0 : change == 4 ? NAN : change == 8 ? INFINITY : timed->ms;
        timed->wait = change == 5 ? -1.0 : timed->wait;
        timed->start = change == 6 ? 1 : timed->start;
        const int given = change == 7 ? round + 3 : count;
        assert_false(dip_driver_resume(driver, kept, given));
        assert_int_equal(dip_driver_progress(driver).rounds, change ? 1 : 0);
        *timed = saved;
        assert_int_equal(work(NULL), DIP_DRIVER_DONE);
    }
}

// --- the preview ---------------------------------------------------------------------------------

static DipDriverDef block_def(void) {
    return (DipDriverDef){.subjects = 5,
                          .base_of = bases,
                          .block_subjects = 4,
                          .starts = 1,
                          .rounds = 8,
                          .frames = 1,
                          .seed = 3,
                          .most_wait = DIP_TIMED_MOST_WAIT};
}

static void a_dropped_round_is_drawn_anew(void **state) {
    (void)state;
    static DipTimed whole[MOST_TURNS];
    const DipDriverDef def = block_def();
    work_until_done(&def);
    assert_int_equal(m.turn_count, 8 * 5 * 2);
    const int count = dip_driver_times(driver).count;
    memcpy(whole, dip_driver_times(driver).list, (size_t)count * sizeof *whole);
    tear_down(NULL);
    set_up(NULL);
    begin(&def);
    for (int i = 0; i < 2 * 10 + 7; i++) {
        dip_driver_step(driver, NULL);
    }
    DipDriverProgress progress = dip_driver_progress(driver);
    assert_true(progress.rounds == 2 && progress.drawn == 27 && progress.total == 80);
    dip_driver_drop_round(driver);
    progress = dip_driver_progress(driver);
    assert_true(progress.rounds == 2 && progress.drawn == 20 && progress.total == 80);
    assert_int_equal(dip_driver_times(driver).count, 2 * 5); // Complete rounds only.
    assert_int_equal(work(NULL), DIP_DRIVER_DONE);
    const DipTimes times = dip_driver_times(driver);
    check_same(&times, whole, count);
    assert_int_equal(m.turn_count, 80 + 7);
}

static void progress_counts_frames_and_rounds(void **state) {
    (void)state;
    DipDriverDef def = path_def();
    def.settle = true;
    begin(&def);
    const int64_t total = dip_driver_progress(driver).total;
    int rounds = 0;
    for (DipDriverStep step; (step = dip_driver_step(driver, NULL)) < DIP_DRIVER_DONE;) {
        rounds += step == DIP_DRIVER_ROUND;
        const DipDriverProgress progress = dip_driver_progress(driver);
        assert_int_equal(progress.total, total);
        assert_int_equal(progress.rounds, rounds);
    }
    const DipDriverProgress progress = dip_driver_progress(driver);
    assert_int_equal(progress.drawn, total);
    assert_int_equal(m.turn_count, total + 25); // Settling is not counted.
}

// --- two programs, and no base -------------------------------------------------------------------

static void subjects_in_turn_alternate_at_every_frame(void **state) {
    (void)state;
    enum { FRAMES = 3 };
    static const int pairs[4] = {0, 0, 2, 2};
    const DipDriverDef def = {.subjects = 4,
                              .base_of = pairs,
                              .block_subjects = 1,
                              .starts = 2,
                              .rounds = 20,
                              .frames = FRAMES,
                              .seed = 3,
                              .in_turn = true};
    m.is_elsewhere = true;
    work_until_done(&def);
    int first[2] = {0};
    for (int i = 0; i < m.turn_count; i += 2) {
        const DipDriverTurn *a = &m.turns[i], *b = &m.turns[i + 1];
        assert_true(a->phase == DIP_DRIVER_TIMED && b->phase == DIP_DRIVER_TIMED);
        assert_true(pairs[a->subject] == pairs[b->subject] && a->subject != b->subject &&
                    a->frame == b->frame && a->round == b->round);
        first[a->subject % 2]++;
    }
    assert_int_equal(m.turn_count, 2 * 20 * 4 * FRAMES);
    assert_in_range(first[0], 90, 150); // About 120 of 240 are expected.
    const DipTimes times = dip_driver_times(driver);
    for (int i = 0; i < times.count; i++) { // The times that the other process told.
        const DipTimed *timed = &times.list[i];
        assert_true(fabs(timed->ms - true_ms(timed->subject, timed->frame)) < 1e-9);
        assert_true(timed->wait == 0.125 && timed->cpu_ms == 2.0 * timed->ms);
    }
    assert_true(fabs(dip_driver_machine(driver, 1).wait - 0.125) < 1e-9);
}

static void a_machine_elsewhere_may_tell_no_waiting(void **state) {
    (void)state;
    const DipDriverDef def = block_def();
    m.is_elsewhere = m.tells_no_wait = true;
    work_until_done(&def);
    assert_false(dip_driver_machine(driver, 1).has_wait);
    assert_true(dip_driver_times(driver).list[0].wait == 0.0);
}

static void subjects_without_a_base_are_visited_in_seeded_order(void **state) {
    (void)state;
    enum { COUNT = 5, ROUND = COUNT * 3 };
    const DipDriverDef def = {.subjects = COUNT,
                              .block_subjects = 1,
                              .starts = 1,
                              .rounds = 40,
                              .frames = 2,
                              .warm_frames = 2,
                              .seed = 11};
    int first[COUNT] = {0};
    work_until_done(&def);
    assert_int_equal(m.turn_count, 2 * COUNT + 40 * ROUND);
    for (int round = 0; round < 40; round++) {
        unsigned seen = 0;
        const DipDriverTurn *turns = &m.turns[2 * COUNT + round * ROUND];
        for (int i = 0; i < ROUND; i++) {
            seen |= 1u << turns[i].subject;
            assert_int_equal(turns[i].frame, i % 3 == 2);
            assert_int_equal(turns[i].round, round);
        }
        assert_int_equal(seen, (1u << COUNT) - 1);
        first[turns[0].subject]++;
    }
    for (int s = 0; s < COUNT; s++) {
        assert_in_range(first[s], 2, 16); // About 8 of 40 are expected.
    }
}

// --- long starts ---------------------------------------------------------------------------------

// 6 starts of 4 rounds. A round takes about 1.1 s, so a tenth of a start's rounds is .44 s.
static void check_starts(double start_ms, int starts) {
    DipDriverDef def = path_def();
    def.starts = 6;
    def.rounds = 4;
    def.frames = 24;
    def.most_start = 0.1;
    set_up(NULL);
    m.start_ms = start_ms;
    work_until_done(&def);
    DipTimes times = dip_driver_times(driver);
    assert_int_equal(times.starts, starts);
    assert_int_equal(times.rounds, 24 / starts);
    assert_int_equal(m.start_count, starts);
    for (int i = 0; i < times.count; i++) {
        assert_in_range(times.list[i].start, 0, starts - 1);
        assert_in_range(times.list[i].round, 0, 24 / starts - 1);
    }
    static DipTimed whole[MOST_TURNS];
    const int count = times.count;
    memcpy(whole, times.list, (size_t)count * sizeof *whole);
    // A journal with the rounds of several starts says how many there are.
    tear_down(NULL);
    static DipTimed kept[MOST_TURNS];
    memcpy(kept, m.kept, sizeof kept);
    int known = 0;
    while (kept[known].start * times.rounds + kept[known].round < 6) {
        known++;
    }
    set_up(NULL);
    m.start_ms = starts == 2 ? 0.0 : 1e6;
    begin(&def);
    assert_true(dip_driver_resume(driver, kept, known));
    assert_int_equal(work(NULL), DIP_DRIVER_DONE);
    times = dip_driver_times(driver);
    assert_int_equal(times.starts, starts);
    check_same(&times, whole, count);
    tear_down(NULL);
}

static void long_starts_are_fewer(void **state) {
    (void)state;
    check_starts(20.0, 6);
    check_starts(2000.0, 2);
}

// --- failures ------------------------------------------------------------------------------------

static bool start_fails(void *context, int index, DipError *err) {
    (void)context;
    return index == 0 || dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "start", "failed");
}

static bool keep_fails(void *context, const DipTimed *timed, int count, DipError *err) {
    keep(context, timed, count, err);
    return m.kept_rounds < 3 || dip_error_set(err, DIP_ERROR_IO, NULL, 0, "keep", "failed");
}

static void check_failure(const DipDriverCalls *failing, const char *key, int rounds) {
    const DipDriverDef def = path_def();
    DipError err = {0};
    tear_down(NULL);
    driver = dip_driver_create(&def, failing, NULL);
    assert_int_equal(work(&err), DIP_DRIVER_FAILED);
    assert_string_equal(err.key, key);
    const int turns = m.turn_count;
    assert_int_equal(dip_driver_step(driver, NULL), DIP_DRIVER_FAILED);
    assert_int_equal(m.turn_count, turns);
    assert_int_equal(dip_driver_progress(driver).rounds, rounds < 0 ? m.kept_rounds : rounds);
}

static void a_failure_ends_the_measurement(void **state) {
    (void)state;
    for (int at = 0; at < 200; at += 13) {
        set_up(NULL);
        m.fail_at = at;
        const int round = 14 * (PER_ROUND + 1);
        check_failure(&calls, "draw", -1);
        assert_int_equal(m.turn_count, at);
        assert_in_range(m.kept_rounds, (at - SUBJECTS * WARM) / (2 * round), at / round);
    }
    DipDriverCalls failing = calls;
    failing.start = start_fails;
    set_up(NULL);
    check_failure(&failing, "start", ROUNDS);
    failing = calls;
    failing.keep = keep_fails;
    set_up(NULL);
    check_failure(&failing, "keep", 3);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
    const struct CMUnitTest tests[] = {
        TEST(every_frame_is_timed_once_beside_its_base),
        TEST(a_clock_that_stands_still_gives_a_least_time),
        TEST(what_is_prepared_is_not_timed),
        TEST(visits_begin_untimed_and_lie_beside_the_base),
        TEST(visits_of_a_log_begin_in_order),
        TEST(order_follows_the_seed),
        TEST(starts_begin_with_untimed_frames),
        TEST(drift_cancels),
        TEST(settling_ends_when_two_medians_agree),
        TEST(a_few_disturbed_frames_are_left),
        TEST(many_disturbed_frames_are_drawn_again),
        TEST(frames_beside_a_disturbed_base_are_drawn_again),
        TEST(worse_repetitions_are_not_kept),
        TEST(a_machine_that_stays_busy_repeats_little),
        TEST(visits_of_a_block_have_no_fixed_order),
        TEST(without_a_limit_nothing_is_disturbed),
        TEST(resumed_rounds_are_those_of_the_whole),
        TEST(resumed_repetitions_are_those_of_the_whole),
        TEST(what_does_not_fit_is_drawn),
        TEST(a_dropped_round_is_drawn_anew),
        TEST(progress_counts_frames_and_rounds),
        TEST(subjects_in_turn_alternate_at_every_frame),
        TEST(a_machine_elsewhere_may_tell_no_waiting),
        TEST(subjects_without_a_base_are_visited_in_seeded_order),
        TEST(long_starts_are_fewer),
        TEST(a_failure_ends_the_measurement),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
