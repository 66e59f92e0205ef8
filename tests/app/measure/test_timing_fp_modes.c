// Tests that the caller's floating-point mode changes no time and no ratio of times: the functions
// of app/measure/stats/ and app/measure/timing/ that compute them give the same bits in every mode
// and leave the mode as it was. The caller's own functions run in the caller's mode.
#include "app/measure/stats/rounds.h"
#include "app/measure/timing/child.h"
#include "app/measure/timing/driver.h"
#include "tests/support/fp_walk.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

enum { SUBJECTS = 4, STARTS = 3, ROUNDS = 4, PATH = 24, COPIES = 2 };

static const int bases[SUBJECTS] = {0, 0, 0, 3};

static void hash_numbers(DipHash *hash, const void *values, size_t count) {
    dip_hash_bytes(hash, values, count * sizeof(double));
}

// Returns a number of 0..255 that looks random.
static uint32_t draw_number(uint32_t seed) {
    uint32_t h = seed * 374761393u + 668265263u;
    h = (h ^ h >> 13) * 1274126177u;
    return (h ^ h >> 16) & 255;
}

static void assert_callers_mode(void) {
    if (fp_walk_mode() != FP_MODE_COUNT) {
        assert_true(fp_mode_is(fp_walk_mode()));
    }
}

// --- a made-up machine ---------------------------------------------------------------------------

static int64_t now_ns;
static DipThreadUse use;
static uint32_t drawn;
static bool is_elsewhere; // The frames tell their times.

static bool prepare(void *context, const DipDriverTurn *turn, DipError *err) {
    (void)context, (void)turn, (void)err;
    assert_callers_mode();
    return true;
}

static bool draw(void *context, const DipDriverTurn *turn, DipTimed *timed, DipError *err) {
    (void)context, (void)err;
    assert_callers_mode();
    const uint32_t noise = draw_number(++drawn);
    const int64_t ns = 1000003 + 100003 * turn->subject + 7001 * turn->frame + 1013 * (int)noise;
    now_ns += ns;
    use.cpu_ns += ns - 333;
    use.wait_ns += noise % 8 == 0 ? ns / 3 : 333;
    use.switches += noise % 3;
    timed->parts_ms[0] = 0.1;
    timed->parts_ms[1] = noise % 2 ? 0.7 : 0.3;
    if (is_elsewhere) {
        timed->ms = (double)ns / 0x1p20;
        timed->wait = noise % 8 == 0 ? 0.25 : 0.015625;
        timed->cpu_ms = 0.7;
    }
    return true;
}

static int64_t clock_ns(void *context) {
    (void)context;
    assert_callers_mode();
    return now_ns;
}

static DipThreadUse thread_use(void *context) {
    (void)context;
    assert_callers_mode();
    return use;
}

static bool keep(void *context, const DipTimed *timed, int count, DipError *err) {
    (void)context, (void)timed, (void)count, (void)err;
    assert_callers_mode();
    return true;
}

static DipDriver *make_driver(void) {
    const DipDriverDef def = {.subjects = SUBJECTS,
                              .base_of = bases,
                              .block_subjects = 2,
                              .starts = STARTS,
                              .rounds = ROUNDS,
                              .frames = PATH,
                              .base_copies = COPIES,
                              .warm_frames = 1,
                              .seed = 7,
                              .settle = true,
                              .most_wait = DIP_TIMED_MOST_WAIT,
                              .most_start = 0.3};
    const DipDriverCalls calls = {.draw = draw,
                                  .prepare = prepare,
                                  .keep = keep,
                                  .clock_ns = clock_ns,
                                  .thread_use = thread_use};
    now_ns = 12345;
    use = (DipThreadUse){.has_wait = true};
    drawn = 0;
    DipDriver *driver = dip_driver_create(&def, &calls, NULL);
    assert_non_null(driver);
    return driver;
}

static void hash_timed(DipHash *hash, const DipTimed *timed) {
    dip_hash_integer(hash, timed->subject);
    dip_hash_integer(hash, timed->frame);
    const double values[] = {timed->ms, timed->wait, timed->cpu_ms, timed->switches};
    hash_numbers(hash, values, 4);
    hash_numbers(hash, timed->parts_ms, DIP_TIMED_PARTS);
}

static void hash_driver(DipHash *hash, const DipDriver *driver) {
    const DipTimes times = dip_driver_times(driver);
    for (int i = 0; i < times.count; i++) {
        hash_timed(hash, &times.list[i]);
    }
    const DipDriverMachine machine = dip_driver_machine(driver, 3);
    dip_hash_integer(hash, machine.repeated);
    dip_hash_integer(hash, machine.settled);
    dip_hash_number(hash, machine.wait);
}

static void call_driver(DipHash *hash) {
    DipDriver *driver = make_driver();
    DipDriverStep step;
    do {
        step = dip_driver_step(driver, NULL);
    } while (step == DIP_DRIVER_WORKING || step == DIP_DRIVER_ROUND);
    assert_int_equal(step, DIP_DRIVER_DONE);
    hash_driver(hash, driver);
    dip_driver_destroy(&driver);
}

static void call_driver_elsewhere(DipHash *hash) {
    is_elsewhere = true;
    call_driver(hash);
    is_elsewhere = false;
}

// Continues from frames that no mode has changed: those of the first round.
static void call_resumed_driver(DipHash *hash) {
    static DipTimed known[512];
    static int count;
    if (count == 0) {
        DipDriver *first = make_driver();
        while (dip_driver_step(first, NULL) != DIP_DRIVER_ROUND) {
        }
        const DipTimes times = dip_driver_times(first);
        count = times.count;
        memcpy(known, times.list, (size_t)count * sizeof *known);
        dip_driver_destroy(&first);
    }
    DipDriver *driver = make_driver();
    assert_true(dip_driver_resume(driver, known, count));
    hash_driver(hash, driver);
    dip_driver_destroy(&driver);
}

// --- ratios --------------------------------------------------------------------------------------

enum { LIST = SUBJECTS * STARTS * ROUNDS * PATH };

static DipTimed list[LIST];

// Makes times in which every round draws every frame, or, unless they are complete, every second
// one. All numbers are exact.
static DipTimes make_times(int starts, bool complete) {
    int count = 0;
    for (int i = 0; i < starts * ROUNDS * SUBJECTS * PATH; i++) {
        const int frame = i % PATH, subject = i / PATH % SUBJECTS;
        const int round = i / (PATH * SUBJECTS) % ROUNDS;
        if (!complete && (frame + round) % 2 != 0) {
            continue;
        }
        const uint32_t noise = draw_number((uint32_t)i);
        list[count++] = (DipTimed){.subject = subject,
                                   .start = i / (PATH * SUBJECTS * ROUNDS),
                                   .round = round,
                                   .block = subject == 3,
                                   .frame = frame,
                                   .begin_ns = i * INT64_C(1000000),
                                   .ms = (1000 + 100 * subject + 9 * frame + (int)noise) / 1024.0,
                                   .wait = noise < 10 ? 0.5 : noise / 4096.0,
                                   .parts_ms = {0.25, noise / 512.0}};
    }
    return (DipTimes){.list = list,
                      .count = count,
                      .subjects = SUBJECTS,
                      .starts = starts,
                      .rounds = ROUNDS,
                      .frames = PATH,
                      .base_of = bases,
                      .complete = complete};
}

static void hash_estimate(DipHash *hash, DipEstimate estimate) {
    hash_numbers(hash, &estimate, 5);
}

static void hash_fit(DipHash *hash, DipTimesFit *fit) {
    assert_non_null(fit);
    for (int s = 0; s < SUBJECTS; s++) {
        const DipAlong along = dip_times_along(fit, s);
        hash_estimate(hash, dip_times_ratio(fit, s));
        hash_estimate(hash, dip_times_ratio_of(fit, s, s < 3 ? 2 - s : s));
        hash_estimate(hash, along.mean_ms);
        hash_estimate(hash, along.p95_ms);
        hash_estimate(hash, along.worst_ms);
        dip_hash_number(hash, along.level_error);
        dip_hash_number(hash, dip_times_spread(fit, s));
        hash_numbers(hash, dip_times_shares(fit, s), DIP_TIMED_PARTS);
        hash_numbers(hash, dip_times_frames(fit, s), PATH);
    }
    dip_times_fit_free(&fit);
}

static void call_fit(DipHash *hash) {
    for (int i = 0; i < 4; i++) {
        const DipTimes times = make_times(i % 2 ? STARTS : 1, i < 2);
        hash_fit(hash, dip_times_fit(&times, NULL));
    }
}

static void call_fit_of_part(DipHash *hash) {
    const DipTimes times = make_times(STARTS, true);
    hash_fit(hash, dip_times_fit_part(&times, 1, NULL));
}

// Estimates from a fit that was made in the usual mode.
static DipTimesFit *usual_fit;

static void call_estimates_of_fit(DipHash *hash) {
    for (int s = 0; s < SUBJECTS; s++) {
        const DipAlong along = dip_times_along(usual_fit, s);
        hash_estimate(hash, dip_times_ratio(usual_fit, s));
        hash_estimate(hash, dip_times_ratio_of(usual_fit, s, s < 3 ? 2 - s : s));
        hash_estimate(hash, along.mean_ms);
        hash_estimate(hash, along.p95_ms);
        hash_estimate(hash, along.worst_ms);
    }
}

// --- another process -----------------------------------------------------------------------------

static const char first_word[] = "child", second_word[] = "answers";

// What the frames of the child say. Their digits after the sixth are rounded when they are sent.
static const double child_ms[] = {0.1234565, 1.0 / 3.0, 2.7182818284, 12.00000049999, 1.0000003};

static bool answer_frame(void *context, const char *request, DipBenchSample *sample,
                         DipError *err) {
    const FpMode *mode = context;
    (void)err;
    const int frame = atoi(request) % 5;
    *sample = (DipBenchSample){.hash = "abc"};
    for (int stage = 0; stage < DIP_BENCH_STAGE_COUNT; stage++) {
        sample->ms[stage] = child_ms[(frame + stage) % 5];
    }
    return *mode == FP_MODE_COUNT || fp_mode_is(*mode);
}

// The child: serves frames in the mode that its last argument but --serve names, or answers with
// times that it makes up.
static int run_child(int argc, char **argv) {
    FpMode mode = (FpMode)atoi(argv[argc - 2]);
    if (strcmp(argv[2], second_word) != 0) {
        if (mode != FP_MODE_COUNT) {
            fp_mode_enter(mode);
        }
        return dip_child_serve("test", 1, 5, NULL, answer_frame, &mode, NULL) ? 0 : 1;
    }
    printf("diptych-test 1 1 5\n");
    fflush(stdout);
    for (char line[64]; fgets(line, sizeof line, stdin);) {
        printf("total_ms=%s.7 wait_ms=0.3 cpu_ms=0.1 switches=2 hash=abc\n", strtok(line, "\n"));
        fflush(stdout);
    }
    return 0;
}

static void ask_child(DipHash *hash, const char *kind, bool with_use) {
    char mode[16];
    snprintf(mode, sizeof mode, "%d", (int)fp_walk_mode());
    char *argv[] = {NULL, (char *)first_word, (char *)kind, mode};
    const DipChildDef def = {.program = "/proc/self/exe",
                             .argv = argv,
                             .argc = 4,
                             .what = "test",
                             .count = 1,
                             .frames = 5,
                             .key = "child"};
    DipChild *child = dip_child_start(&def, NULL);
    assert_non_null(child);
    for (int frame = 0; frame < 5; frame++) {
        char request[16];
        DipBenchSample sample;
        DipTimed timed = {.ms = NAN};
        snprintf(request, sizeof request, "%d", frame);
        assert_true(dip_child_draw(child, request, &sample, &timed, NULL));
        hash_numbers(hash, sample.ms, DIP_BENCH_STAGE_COUNT);
        dip_hash_number(hash, timed.ms);
        if (with_use) {
            const double values[] = {timed.wait, timed.cpu_ms, timed.switches};
            hash_numbers(hash, values, 3);
        }
    }
    dip_child_stop(&child, false);
}

static void call_child(DipHash *hash) {
    ask_child(hash, second_word, true);
}

// The times of the child's threads are those of the machine, so they are not compared.
static void call_serving_child(DipHash *hash) {
    ask_child(hash, "serves", false);
}

// --- the test ------------------------------------------------------------------------------------

static const FpWalkEntry entries[] = {
    {"driver", call_driver},
    {"driver whose frames tell their times", call_driver_elsewhere},
    {"resumed driver", call_resumed_driver},
    {"ratios and times along a path", call_fit},
    {"ratios of a part", call_fit_of_part},
    {"estimates of a fit", call_estimates_of_fit},
    {"asking a child", call_child},
    {"a child that serves", call_serving_child},
};

static int make_fit(void **state) {
    (void)state;
    const DipTimes times = make_times(STARTS, false);
    usual_fit = dip_times_fit(&times, NULL);
    return usual_fit ? 0 : -1;
}

static int free_fit(void **state) {
    (void)state;
    dip_times_fit_free(&usual_fit);
    return 0;
}

int main(int argc, char **argv) {
    if (argc > 3 && strcmp(argv[1], first_word) == 0) {
        return run_child(argc, argv);
    }
    return fp_walk_main(entries, sizeof entries / sizeof *entries, make_fit, free_fit);
}
