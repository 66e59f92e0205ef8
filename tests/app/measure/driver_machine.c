#include "tests/app/measure/driver_machine.h"

#include <math.h>
#include <string.h>

const int bases[SUBJECTS] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 9, 9, 9};

Machine made;
DipDriver *driver;

double true_ms(int subject, int frame) {
    return (1.0 + 0.5 * subject) * (4.0 + 0.1 * frame);
}

static bool is_busy(const DipDriverTurn *turn) {
    return turn->round >= 0 && (made.busy_subject < 0 || turn->subject == made.busy_subject) &&
           (turn->start * ROUNDS + turn->round == made.busy_round ||
            (made.busy_at_first && made.kept_rounds < ALL_ROUNDS) || made.busy_always);
}

static bool draw(void *context, const DipDriverTurn *turn, DipTimed *timed, DipError *err) {
    (void)context;
    if (made.turn_count == made.fail_at) {
        return dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "draw", "failed");
    }
    assert_true(made.turn_count < MOST_TURNS);
    made.turns[made.turn_count++] = *turn;
    double ms = true_ms(turn->subject, turn->frame) * (1.0 + made.slow_down * made.turn_count);
    if (turn->phase == DIP_DRIVER_UNTIMED) {
        ms *= 3.0; // The caches are cold.
    } else if (turn->phase == DIP_DRIVER_SETTLE) {
        // Each of the first fifteen is 5 ms faster than the one before; later ones are equal.
        ms = made.settling < 15 ? 100.0 - 5.0 * made.settling : 25.0;
        made.settling++;
    }
    int64_t ns = (int64_t)llround(1e6 * ms);
    made.use.cpu_ns += ns;
    if (is_busy(turn)) {
        made.use.wait_ns += ns;
        made.use.switches += 3;
        ns *= 2;
    } else if (made.busy_again && made.kept_rounds == ALL_ROUNDS) {
        made.use.wait_ns += 3 * ns;
        ns *= 4;
    }
    made.now_ns += made.stands_still ? 0 : ns;
    timed->parts_ms[1] = 0.25 * ms;
    if (made.is_elsewhere) {
        timed->ms = ms;
        timed->wait = made.tells_no_wait ? NAN : 0.125;
        timed->cpu_ms = 2.0 * ms;
        made.now_ns += 1000000; // Telling takes time, too.
    }
    return true;
}

bool machine_prepare(void *context, const DipDriverTurn *turn, DipError *err) {
    (void)context;
    (void)turn;
    (void)err;
    made.prepared++;
    made.now_ns += 70000000;
    made.use.cpu_ns += 50000000;
    made.use.wait_ns += 20000000;
    return true;
}

static bool start(void *context, int index, DipError *err) {
    (void)context;
    (void)err;
    made.starts[made.start_count++] = index;
    made.now_ns += (int64_t)(1e6 * made.start_ms);
    return true;
}

bool machine_keep(void *context, const DipTimed *timed, int count, DipError *err) {
    (void)context;
    (void)err;
    memcpy(made.kept + made.kept_count, timed, (size_t)count * sizeof *timed);
    made.kept_count += count;
    made.kept_rounds++;
    return true;
}

static int64_t clock_ns(void *context) {
    (void)context;
    return made.now_ns;
}

static DipThreadUse thread_use(void *context) {
    (void)context;
    return made.use;
}

DipDriverDef path_def(void) {
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

DipDriverCalls calls = {.draw = draw,
                        .start = start,
                        .keep = machine_keep,
                        .clock_ns = clock_ns,
                        .thread_use = thread_use};

void begin(const DipDriverDef *def) {
    driver = dip_driver_create(def, &calls, NULL);
    assert_non_null(driver);
}

DipDriverStep work(DipError *err) {
    DipDriverStep step;
    do {
        const int before = made.turn_count;
        step = dip_driver_step(driver, err);
        assert_in_range(made.turn_count - before, 0, 1); // One frame at most.
    } while (step < DIP_DRIVER_DONE);
    return step;
}

void work_until_done(const DipDriverDef *def) {
    begin(def);
    assert_int_equal(work(NULL), DIP_DRIVER_DONE);
}

int machine_set_up(void **state) {
    (void)state;
    memset(&made, 0, sizeof made);
    made.busy_round = made.fail_at = made.busy_subject = -1;
    made.use.has_wait = true;
    made.now_ns = 1000;
    calls.prepare = NULL;
    return 0;
}

int machine_tear_down(void **state) {
    (void)state;
    dip_driver_destroy(&driver);
    assert_null(driver);
    return 0;
}

int round_of(const DipTimed *timed) {
    return timed->start * ROUNDS + timed->round;
}

void check_same(const DipTimes *a, const DipTimed *list, int count) {
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
