// Tests the timing of frames in another process. The process is a shell, whose command says what it
// answers. Also tests the samples that are taken of frames.
#include "app/measure/timing/child.h"

#include <math.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static const char shell[] = "/bin/sh";

// Starts a shell with this command as a child that must have 3 combinations of 5 frames.
static DipChild *start(const char *command, DipError *err) {
    static char *arguments[3];
    arguments[0] = (char *)"replaced";
    arguments[1] = (char *)"-c";
    arguments[2] = (char *)command;
    const DipChildDef def = {.program = shell,
                             .argv = arguments,
                             .argc = 3,
                             .what = "bench",
                             .count = 3,
                             .frames = 5,
                             .key = "--against"};
    *err = (DipError){0};
    return dip_child_start(&def, err);
}

// Starts a child that sends the greeting and then runs the command. It is called with --serve.
static DipChild *start_greeting(const char *command) {
    char text[1024];
    DipError err;
    snprintf(text, sizeof text, "test \"$0\" = --serve || exit; echo diptych-bench 1 3 5; %s",
             command);
    DipChild *child = start(text, &err);
    if (!child) {
        fail_msg("%s", err.message);
    }
    return child;
}

static void assert_not_started(const char *command, DipErrorCode code, const char *message) {
    DipError err;
    DipChild *child = start(command, &err);
    if (child || err.code != code || strcmp(err.message, message) != 0) {
        fail_msg("%s: %s: %s", command, dip_error_code_name(err.code), err.message);
    }
    assert_string_equal(err.key, "--against");
}

static void a_greeting_that_is_not_the_expected_one_is_refused(void **state) {
    (void)state;
    static const char *const others[] = {"hello",
                                         "",
                                         "diptych-bench 2 3 5",
                                         "diptych-plan 1 3 5",
                                         "diptych-bench 1",
                                         "diptych-bench 1 3",
                                         "diptych-benches 1 3 5",
                                         "bench 1 3 5",
                                         "diptych-bench 1 x 5"};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        char command[64];
        snprintf(command, sizeof command, "echo '%s'", others[i]);
        assert_not_started(command, DIP_ERROR_FORMAT,
                           "/bin/sh did not answer as diptych's bench does; is it a diptych of "
                           "another version?");
    }
    assert_not_started("echo diptych-bench 1 4 5", DIP_ERROR_CONFLICT,
                       "/bin/sh has 4 combinations of 5 frames, but this program has 3 "
                       "combinations of 5 frames");
    assert_not_started("echo diptych-bench 1 3 6", DIP_ERROR_CONFLICT,
                       "/bin/sh has 3 combinations of 6 frames, but this program has 3 "
                       "combinations of 5 frames");
    assert_not_started("exit 2", DIP_ERROR_RUNTIME, "/bin/sh has ended; see its own message above");
}

static void a_program_that_does_not_exist_is_refused(void **state) {
    (void)state;
    char *arguments[1] = {(char *)"diptych"};
    const DipChildDef def = {.program = "/nowhere/diptych",
                             .argv = arguments,
                             .argc = 1,
                             .what = "bench",
                             .count = 3,
                             .frames = 5,
                             .key = "--against"};
    DipError err = {0};
    assert_null(dip_child_start(&def, &err));
    assert_int_equal(err.code, DIP_ERROR_RUNTIME);
    assert_string_equal(err.key, "--against");
    assert_string_equal(err.message,
                        "/nowhere/diptych cannot be started: No such file or directory");
}

// Unknown names and words without a value are ignored. The child's own numbers replace those of the
// watch, and the wait becomes a share of the frame's time.
static void an_answer_is_read_by_its_names(void **state) {
    (void)state;
    char command[512];
    snprintf(command, sizeof command,
             "read request; echo \"geometry_ms=0.25 raster_ms=0.5 shading_ms=1.5 resolve_ms=0.125 "
             "total_ms=2.5 later_ms=7 word wait_ms=5 cpu_ms=9.75 switches=3 "
             "%s=18446744073709551615 hash=<$request>\"; read request",
             dip_counter_names[DIP_COUNTER_COUNT - 1]);
    DipChild *child = start_greeting(command);
    DipBenchSample sample;
    DipTimed timed = {0};
    DipError err = {0};
    assert_true(dip_child_draw(child, "frame7", &sample, &timed, &err));
    assert_string_equal(sample.hash, "<frame7>");
    assert_true(sample.ms[DIP_BENCH_STAGE_geometry] == 0.25);
    assert_true(sample.ms[DIP_BENCH_STAGE_raster] == 0.5);
    assert_true(sample.ms[DIP_BENCH_STAGE_shading] == 1.5);
    assert_true(sample.ms[DIP_BENCH_STAGE_resolve] == 0.125);
    assert_true(sample.ms[DIP_BENCH_STAGE_total] == 2.5);
    assert_true(timed.ms == 2.5 && timed.parts_ms[DIP_BENCH_STAGE_shading] == 1.5);
    assert_true(timed.wait == 2.0 && timed.cpu_ms == 9.75 && timed.switches == 3.0);
    double counters[DIP_COUNTER_COUNT] = {0};
    dip_counters_add(&sample.counters, counters);
    for (int i = 0; i < DIP_COUNTER_COUNT; i++) {
        assert_true(counters[i] == (i < DIP_COUNTER_COUNT - 1 ? 0.0 : 0x1p64));
    }
    dip_child_stop(&child, false);
    assert_null(child);
}

static void an_answer_without_a_time_is_refused(void **state) {
    (void)state;
    static const char *const answers[] = {
        "", "hello", "total_ms=0", "total_ms=-1", "total_ms=nan", "total_ms=", "geometry_ms=1"};
    for (size_t i = 0; i < sizeof answers / sizeof *answers; i++) {
        char command[64];
        snprintf(command, sizeof command, "read request; echo '%s'; read request", answers[i]);
        DipChild *child = start_greeting(command);
        DipBenchSample sample;
        DipTimed timed = {0};
        DipError err = {0};
        assert_false(dip_child_draw(child, "frame", &sample, &timed, &err));
        assert_int_equal(err.code, DIP_ERROR_FORMAT);
        assert_string_equal(err.key, "--against");
        assert_string_equal(err.message, "/bin/sh answered without a time");
        dip_child_stop(&child, false);
    }
}

// Writing to a child that has ended does not end this process.
static void a_child_that_ends_is_told(void **state) {
    (void)state;
    signal(SIGPIPE, SIG_DFL);
    DipChild *child = start_greeting("read request; echo total_ms=1; exec <&-; exec >&-");
    DipBenchSample sample;
    DipTimed timed = {0};
    DipError err = {0};
    assert_true(dip_child_draw(child, "one", &sample, &timed, &err));
    for (int i = 0; i < 2; i++) {
        assert_false(dip_child_draw(child, "two", &sample, &timed, &err));
        assert_int_equal(err.code, DIP_ERROR_RUNTIME);
        assert_string_equal(err.message, "/bin/sh has ended; see its own message above");
    }
    dip_child_stop(&child, false);
}

// Only a child that is stopped at once gets SIGTERM. It is waited for in both cases.
static void a_child_may_be_stopped_at_once(void **state) {
    (void)state;
    for (int at_once = 0; at_once < 2; at_once++) {
        char marker[] = "/tmp/test_child.XXXXXX";
        char command[256];
        const int file = mkstemp(marker);
        assert_true(file >= 0);
        snprintf(command, sizeof command,
                 "trap 'echo stopped >%s; exit' TERM; echo diptych-bench 1 3 5; read request; "
                 "echo closed >%s",
                 marker, marker);
        DipError err;
        DipChild *child = start(command, &err);
        assert_non_null(child);
        dip_child_stop(&child, at_once);
        char text[16] = "";
        assert_true(read(file, text, sizeof text - 1) > 0);
        assert_string_equal(text, at_once ? "stopped\n" : "closed\n");
        close(file);
        unlink(marker);
    }
    DipChild *none = NULL;
    dip_child_stop(&none, true);
}

#ifdef __linux__
// nproc tells how many processors a process may use.
static void a_child_draws_on_as_many_processors_as_told(void **state) {
    (void)state;
    DipChild *child = start_greeting("unset OMP_NUM_THREADS OMP_THREAD_LIMIT; "
                                     "while read request; do echo total_ms=1 hash=$(nproc); done");
    DipBenchSample sample;
    DipTimed timed = {0};
    DipError err = {0};
    assert_int_equal(dip_child_thread_count(child), 1);
    assert_true(dip_child_draw(child, "all", &sample, &timed, &err));
    char all[33];
    strcpy(all, sample.hash);
    dip_child_confine(child, 1);
    assert_true(dip_child_draw(child, "one", &sample, &timed, &err));
    assert_string_equal(sample.hash, "1");
    dip_child_confine(child, 0);
    assert_true(dip_child_draw(child, "all", &sample, &timed, &err));
    assert_string_equal(sample.hash, all);
    dip_child_stop(&child, false);
}
#endif

static void a_sample_holds_a_frames_times_and_counters(void **state) {
    (void)state;
    const uint8_t pixels[8] = {1, 2, 3, 255, 4, 5, 6, 255};
    DipFrame frame = {.rgba8 = pixels, .stride_bytes = 8, .width = 2, .height = 1};
    frame.stages = (DipStageTimes){.geometry_ms = 1.0,
                                   .raster_ms = 2.0,
                                   .shading_ms = 3.0,
                                   .resolve_ms = 4.0,
                                   .total_ms = 11.0};
    memset(&frame.counters, 0x5a, sizeof frame.counters);
    DipBenchSample sample;
    char hash[33];
    memset(&sample, 0xff, sizeof sample);
    dip_bench_sample_set(&sample, &frame, false);
    static const double expected[DIP_BENCH_STAGE_COUNT] = {1.0, 2.0, 3.0, 4.0, 11.0};
    for (int i = 0; i < DIP_BENCH_STAGE_COUNT; i++) {
        assert_true(sample.ms[i] == expected[i]);
    }
    assert_memory_equal(&sample.counters, &frame.counters, sizeof frame.counters);
    assert_string_equal(sample.hash, "");
    dip_bench_sample_set(&sample, &frame, true);
    dip_frame_hash(&frame, hash);
    assert_string_equal(sample.hash, hash);
    assert_int_equal(strlen(sample.hash), 32);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_greeting_that_is_not_the_expected_one_is_refused),
        cmocka_unit_test(a_program_that_does_not_exist_is_refused),
        cmocka_unit_test(an_answer_is_read_by_its_names),
        cmocka_unit_test(an_answer_without_a_time_is_refused),
        cmocka_unit_test(a_child_that_ends_is_told),
        cmocka_unit_test(a_child_may_be_stopped_at_once),
#ifdef __linux__
        cmocka_unit_test(a_child_draws_on_as_many_processors_as_told),
#endif
        cmocka_unit_test(a_sample_holds_a_frames_times_and_counters),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
