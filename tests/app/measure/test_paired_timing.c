// Paired timing on a made-up machine: a clock that the runs advance, and threads that wait when the
// test says so.
#include "app/measure/stats/paired.h"
#include "app/measure/timing/paired_timing.h"
#include "renderer/base/assert.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <signal.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { SUBJECTS = 12, ROUNDS = 5, FRAMES = 2, PATH = ROUNDS * FRAMES, MOST_RUNS = 4000 };

// Subjects 0 to 8 have the base 0, subjects 9 to 11 the base 9.
static const int bases[SUBJECTS] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 9, 9, 9};

typedef struct Machine {
    int64_t now_ns;
    DipThreadUse use;
    DipTimingTurn turns[MOST_RUNS];
    int turn_count;
    int busy_round; // In this round all runs wait for half of their time; -1: in none.
    int known;      // Rounds below this one come from `journal`.
    DipTimePair journal[2 * ROUNDS][SUBJECTS * FRAMES];
    bool kept[2 * ROUNDS];
    double slow_down; // Per run: the machine becomes slower all the time.
    int fail_at;      // The run that fails; -1 for none.
} Machine;

static double true_ms(int subject, int frame) {
    return (1.0 + 0.5 * subject) * (4.0 + frame);
}

static bool run(void *context, const DipTimingTurn *turn, DipError *err) {
    Machine *m = context;
    if (m->turn_count == m->fail_at) {
        return dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "run", "failed");
    }
    assert_true(m->turn_count < MOST_RUNS);
    m->turns[m->turn_count++] = *turn;
    const double slower = 1.0 + m->slow_down * m->turn_count;
    int64_t ns = (int64_t)(1e6 * true_ms(turn->subject, turn->frame) * slower);
    m->use.cpu_ns += ns;
    if (turn->round == m->busy_round) {
        m->use.wait_ns += ns;
        m->use.switches += 3;
        ns *= 2;
    }
    m->now_ns += ns;
    return true;
}

static int64_t clock_ns(void *context) {
    return ((Machine *)context)->now_ns;
}

static DipThreadUse thread_use(void *context) {
    return ((Machine *)context)->use;
}

static const DipTimePair *known_round(void *context, int round) {
    Machine *m = context;
    return round < m->known ? m->journal[round] : NULL;
}

static bool keep_round(void *context, int round, const DipTimePair *pairs, bool known,
                       DipError *err) {
    (void)err;
    Machine *m = context;
    m->kept[round] = true;
    if (!known) {
        memcpy(m->journal[round], pairs, sizeof m->journal[round]);
    }
    return true;
}

static const DipPairedTimingDef def = {
    .subject_count = SUBJECTS,
    .base_of = bases,
    .block_subjects = 3,
    .rounds = ROUNDS,
    .frames_per_round = FRAMES,
    .seed = 7,
};

static bool time_all(Machine *m, DipTimePair pairs[SUBJECTS * PATH], DipPairedTimingResult *result,
                     DipError *err) {
    const DipPairedTimingCalls calls = {
        .run = run,
        .known_round = known_round,
        .after_round = keep_round,
        .clock_ns = clock_ns,
        .thread_use = thread_use,
        .context = m,
    };
    return dip_paired_timing_run(&def, &calls, 1, pairs, result, err);
}

static Machine machine(void) {
    return (Machine){.busy_round = -1, .fail_at = -1, .use.has_wait = true};
}

static DipTimePair all[SUBJECTS * PATH];
static DipPairedTimingResult outcome;

static void every_frame_is_timed_once_beside_its_base(void **state) {
    (void)state;
    static Machine m;
    m = machine();
    assert_true(time_all(&m, all, &outcome, NULL));
    for (int s = 0; s < SUBJECTS; s++) {
        for (int f = 0; f < PATH; f++) {
            const DipTimePair *pair = &all[s * PATH + f];
            assert_true(fabs(pair->ms - true_ms(s, f)) < 1e-5);
            assert_true(fabs(pair->base_ms - true_ms(bases[s], f)) < 1e-5);
            assert_true(pair->wait == 0.0 && pair->base_wait == 0.0);
        }
    }
    // In each round: 8 subjects in 3 blocks, 2 subjects in 1 block, and a base in each block; a
    // visit has an untimed run and two timed ones.
    assert_int_equal(m.turn_count, SUBJECTS + ROUNDS * (8 + 3 + 2 + 1) * (FRAMES + 1));
    assert_int_equal(dip_paired_timing_run_count(&def, 0), m.turn_count);
    assert_true(outcome.settled && outcome.wait == 0.0 && outcome.repeated == 0);
}

// A subject and its base lie in one block: at most 4 visits of 3 runs.
static void base_is_close(void **state) {
    (void)state;
    static Machine m;
    m = machine();
    assert_true(time_all(&m, all, &outcome, NULL));
    for (int i = 0; i < m.turn_count; i++) {
        const DipTimingTurn *turn = &m.turns[i];
        bool found = turn->round < 0;
        for (int j = i - 4 * 3; j <= i + 4 * 3; j++) {
            found |= j >= 0 && j < m.turn_count && m.turns[j].subject == bases[turn->subject] &&
                     m.turns[j].round == turn->round;
        }
        assert_true(found);
    }
}

static void order_follows_the_seed(void **state) {
    (void)state;
    static Machine a, b;
    a = machine();
    b = machine();
    assert_true(time_all(&a, all, &outcome, NULL) && time_all(&b, all, &outcome, NULL));
    assert_memory_equal(a.turns, b.turns, sizeof a.turns);
    int same = 0, rounds = 0;
    const int length = (8 + 3 + 2 + 1) * 3;
    for (int i = SUBJECTS; i + length < a.turn_count; i += length, rounds++) {
        same += a.turns[i].subject == a.turns[i + length].subject;
    }
    assert_true(same < rounds); // The order changes from round to round.
}

static void drift_cancels(void **state) {
    (void)state;
    static Machine m;
    m = machine();
    m.slow_down = 0.005; // The last run takes twice as long as the first.
    assert_true(time_all(&m, all, &outcome, NULL));
    double ms[PATH], base_ms[PATH], level_ms[PATH];
    for (int f = 0; f < PATH; f++) {
        ms[f] = all[5 * PATH + f].ms;
        base_ms[f] = all[5 * PATH + f].base_ms;
        level_ms[f] = base_ms[f];
    }
    const DipPathTimes times = {ms, base_ms, level_ms, PATH, ROUNDS, 0.0};
    DipPathEstimate got;
    assert_true(dip_path_estimate(&times, &got, NULL));
    assert_true(fabs(got.ratio.value / 3.5 - 1.0) < 0.01);
}

static void disturbed_rounds_are_timed_again(void **state) {
    (void)state;
    static Machine m;
    m = machine();
    m.busy_round = 2; // 2 of 10 frames: three quarters are left.
    assert_true(time_all(&m, all, &outcome, NULL));
    assert_int_equal(outcome.repeated, 0);
    assert_true(outcome.wait > 0.1 && outcome.wait < 0.2);
    assert_true(dip_time_pair_is_disturbed(&all[3 * PATH + 2]));
    assert_true(all[3 * PATH + 2].switches == 3.0);
}

// Every run of all rounds waits, but those of the repetitions do not.
static bool run_busy_at_first(void *context, const DipTimingTurn *turn, DipError *err) {
    Machine *m = context;
    m->busy_round = turn->round < ROUNDS ? turn->round : -1;
    return run(context, turn, err);
}

static void busy_rounds_are_repeated(void **state) {
    (void)state;
    static Machine m;
    m = machine();
    const DipPairedTimingCalls calls = {
        .run = run_busy_at_first,
        .after_round = keep_round,
        .clock_ns = clock_ns,
        .thread_use = thread_use,
        .context = &m,
    };
    assert_true(dip_paired_timing_run(&def, &calls, 1, all, &outcome, NULL));
    for (int s = 0; s < SUBJECTS; s++) {
        int undisturbed = 0;
        for (int f = 0; f < PATH; f++) {
            undisturbed += !dip_time_pair_is_disturbed(&all[s * PATH + f]);
        }
        assert_true(bases[s] == s || undisturbed >= 0.75 * PATH);
    }
    // Four rounds of two frames reach eight of ten; then no more are repeated.
    assert_true(m.kept[ROUNDS + 3] && !m.kept[ROUNDS + 4]);
}

static void resumed_rounds_are_not_timed_again(void **state) {
    (void)state;
    static Machine whole, resumed;
    static DipTimePair before[SUBJECTS * PATH];
    whole = machine();
    assert_true(time_all(&whole, before, &outcome, NULL));
    resumed = whole;
    resumed.known = 3;
    resumed.turn_count = 0;
    assert_true(time_all(&resumed, all, &outcome, NULL));
    for (int i = 0; i < SUBJECTS * PATH; i++) {
        assert_true(fabs(all[i].ms - before[i].ms) < 1e-5);
    }
    assert_int_equal(resumed.turn_count, dip_paired_timing_run_count(&def, 3));
    // The rest has the order that it had in the whole measurement.
    const int rest = resumed.turn_count - SUBJECTS;
    assert_memory_equal(resumed.turns + SUBJECTS, whole.turns + whole.turn_count - rest,
                        (size_t)rest * sizeof *whole.turns);
}

// A measurement that was complete, but whose report was not written, tells the same of the machine.
static void known_rounds_keep_the_verdict(void **state) {
    (void)state;
    static Machine m;
    m = machine();
    m.busy_round = 2;
    DipPairedTimingResult whole;
    assert_true(time_all(&m, all, &whole, NULL));
    m.known = ROUNDS;
    m.turn_count = 0;
    assert_true(time_all(&m, all, &outcome, NULL));
    assert_int_equal(m.turn_count, SUBJECTS); // only the warm-up
    assert_true(outcome.has_wait && whole.wait > 0.1 && fabs(outcome.wait - whole.wait) < 1e-12);
}

static void a_failing_run_ends_the_measurement(void **state) {
    (void)state;
    static Machine m;
    for (int fail_at = 0; fail_at < 60; fail_at += 7) {
        m = machine();
        m.fail_at = fail_at;
        DipError err = {0};
        assert_false(time_all(&m, all, &outcome, &err));
        assert_string_equal(err.key, "run");
        assert_int_equal(m.turn_count, fail_at);
    }
}

// --- the watch -----------------------------------------------------------------------------------

static void the_watch_counts_processor_time(void **state) {
    (void)state;
    DipThreadWatch *watch = dip_thread_watch_open();
    const DipThreadUse before = dip_thread_watch_read(watch);
    const clock_t begin = clock();
    while (clock() - begin < CLOCKS_PER_SEC / 10) {
    }
    const DipThreadUse after = dip_thread_watch_read(watch);
    assert_true(before.has_wait == (watch != NULL));
    assert_true(after.cpu_ns - before.cpu_ns > 80000000);
    assert_true(after.wait_ns >= before.wait_ns && after.switches >= before.switches);
    dip_thread_watch_close(&watch);
    assert_null(watch);
    assert_true(dip_thread_watch_read(NULL).cpu_ns >= after.cpu_ns / 2);
}

// Burns .1 s of processor time, says so by closing its end of the pipe, and waits to be killed.
static void run_child(int pipe_end) {
    const clock_t begin = clock();
    while (clock() - begin < CLOCKS_PER_SEC / 10) {
    }
    close(pipe_end);
    pause();
    _exit(0);
}

static void the_watch_sees_another_process(void **state) {
    (void)state;
    int ends[2];
    char byte;
    assert_int_equal(pipe(ends), 0);
    const pid_t pid = fork();
    assert_true(pid >= 0);
    if (pid == 0) {
        run_child(ends[1]);
    }
    close(ends[1]);
    assert_int_equal(read(ends[0], &byte, 1), 0);
    close(ends[0]);
    DipThreadWatch *own = dip_thread_watch_open();
    DipThreadWatch *watch = dip_thread_watch_open_process((long)pid);
    if (own) { // This system tells.
        assert_int_equal(dip_thread_watch_count(watch), 1);
        assert_true(dip_thread_watch_read(watch).cpu_ns > 80000000);
    }
    dip_thread_watch_close(&own);
    dip_thread_watch_close(&watch);
    kill(pid, SIGKILL);
    waitpid(pid, NULL, 0);
    assert_null(dip_thread_watch_open_process(0x7fffffff)); // No process has this number.
    assert_int_equal(dip_thread_watch_count(NULL), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_frame_is_timed_once_beside_its_base),
        cmocka_unit_test(base_is_close),
        cmocka_unit_test(order_follows_the_seed),
        cmocka_unit_test(drift_cancels),
        cmocka_unit_test(disturbed_rounds_are_timed_again),
        cmocka_unit_test(busy_rounds_are_repeated),
        cmocka_unit_test(resumed_rounds_are_not_timed_again),
        cmocka_unit_test(known_rounds_keep_the_verdict),
        cmocka_unit_test(a_failing_run_ends_the_measurement),
        cmocka_unit_test(the_watch_counts_processor_time),
        cmocka_unit_test(the_watch_sees_another_process),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
