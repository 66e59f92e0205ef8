// Tests of the options of `diptych bench`: options that take a list, the limits of the lists, and
// options that exclude each other.
#include "app/session/session.h"
#include "app/bench/options.h"
#include "app/cli/command_line.h"
#include "renderer/base/assert.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MAX_WORDS = 12 };

static const DipCommand *const only_bench[] = {&dip_bench_command};
static const DipCommandList list = {.commands = only_bench, .count = 1};

#define WORDS(...) ((const char *const[]){__VA_ARGS__, NULL})

static char *argv[MAX_WORDS] = {(char *)"diptych", (char *)"bench"};

// Parses "bench" and the given arguments, which end with a NULL.
static bool parse(DipCommandLine *line, DipError *err, const char *const words[]) {
    int argc = 2;
    for (; words[argc - 2]; argc++) {
        argv[argc] = (char *)words[argc - 2];
    }
    return dip_command_line_parse(&list, argc, argv, line, err);
}

static void assert_refused(DipErrorCode code, const char *key, const char *const words[]) {
    DipCommandLine line;
    DipError err = {0};
    assert_false(parse(&line, &err, words));
    dip_command_line_free(&line);
    assert_int_equal(err.code, code);
    assert_string_equal(err.key, key);
}

// Parses the arguments and returns the options. The caller frees the line.
static const DipBenchOptions *options_of(DipCommandLine *line, const char *const words[]) {
    DipError err = {0};
    assert_true(parse(line, &err, words));
    return &((const DipBenchArguments *)line->options)->bench;
}

static void defaults_are_six_settings_and_empty_lists(void **state) {
    (void)state;
    DipCommandLine line;
    const DipBenchOptions *bench = options_of(&line, (const char *const[]){NULL});
    assert_int_equal(bench->counts[DIP_BENCH_AXIS_SET], 6);
    assert_string_equal(bench->sets[0].text, "aa=none");
    assert_string_equal(bench->sets[5].text, "aa=8,af=16");
    assert_int_equal(dip_quality_max_anisotropy(&bench->sets[5].quality), 16);
    assert_int_equal(bench->counts[DIP_BENCH_AXIS_THREADS] + bench->counts[DIP_BENCH_AXIS_ISA] +
                         bench->counts[DIP_BENCH_AXIS_SIZE] + bench->counts[DIP_BENCH_AXIS_SCALE] +
                         bench->counts[DIP_BENCH_AXIS_GRID],
                     0);
    assert_int_equal(bench->frames, 12);
    assert_int_equal(bench->measure.rounds, 10);
    assert_false(bench->measure.has_seed);
    dip_command_line_free(&line);
}

static void lists_keep_their_order(void **state) {
    (void)state;
    DipCommandLine line;
    const DipBenchOptions *bench =
        options_of(&line, WORDS("--sets", "aa=2;af=4", "--threads", "2,0,1", "--isa", "scalar,auto",
                                "--size", "64x48,32x24", "--seed", "9"));
    assert_int_equal(bench->counts[DIP_BENCH_AXIS_SET], 2);
    assert_string_equal(bench->sets[1].text, "af=4");
    assert_int_equal(bench->counts[DIP_BENCH_AXIS_THREADS], 3);
    assert_int_equal(bench->threads[0], 2);
    assert_int_equal(bench->threads[1], 0);
    assert_int_equal(bench->counts[DIP_BENCH_AXIS_ISA], 2);
    assert_int_equal(bench->isas[0], DIP_ISA_SCALAR);
    assert_int_equal(bench->isas[1], dip_isa_best());
    assert_int_equal(bench->counts[DIP_BENCH_AXIS_SIZE], 2);
    assert_int_equal(bench->sizes[1].width, 32);
    assert_int_equal(bench->sizes[1].height, 24);
    assert_true(bench->measure.has_seed);
    assert_int_equal(bench->measure.seed, 9);
    dip_command_line_free(&line);
}

static void render_scales_are_shares(void **state) {
    (void)state;
    DipCommandLine line;
    const DipBenchOptions *bench = options_of(&line, WORDS("--scale", "0.5,0.1,1"));
    assert_int_equal(bench->counts[DIP_BENCH_AXIS_SCALE], 3);
    assert_true(bench->scales[0] == 0.5 && bench->scales[1] == 0.1 && bench->scales[2] == 1.0);
    dip_command_line_free(&line);
    assert_refused(DIP_ERROR_RANGE, "--scale", WORDS("--scale", "0.5,1.01"));
    assert_refused(DIP_ERROR_RANGE, "--scale", WORDS("--scale", "0.09"));
    assert_refused(DIP_ERROR_RANGE, "--scale", WORDS("--scale", "nan"));
    assert_refused(DIP_ERROR_RANGE, "--scale", WORDS("--scale", "half"));
}

static void the_whole_command_line_is_kept_for_other_programs(void **state) {
    (void)state;
    DipCommandLine line;
    options_of(&line, WORDS("--frames", "3"));
    const DipProgramOptions *program = line.options;
    assert_int_equal(program->argc, 4);
    assert_ptr_equal(program->argv, argv);
    dip_command_line_free(&line);
}

static void bad_values_name_the_option(void **state) {
    (void)state;
    assert_refused(DIP_ERROR_UNKNOWN, "aa", WORDS("--sets", "aa=none;aa=3"));
    assert_refused(DIP_ERROR_MISSING, "--sets", WORDS("--sets", "aa=2;"));
    assert_refused(DIP_ERROR_RANGE, "--threads", WORDS("--threads", "1,257"));
    assert_refused(DIP_ERROR_UNKNOWN, "--isa", WORDS("--isa", "scalar,mmx"));
    assert_refused(DIP_ERROR_RANGE, "--size", WORDS("--size", "64x48,64"));
    assert_refused(DIP_ERROR_RANGE, "--grid", WORDS("--grid", "1000,1"));
    assert_refused(DIP_ERROR_RANGE, "--frames", WORDS("--frames", "0"));
    assert_refused(DIP_ERROR_RANGE, "--rounds", WORDS("--rounds", "1001"));
    assert_refused(DIP_ERROR_RANGE, "--seed", WORDS("--seed", "-1"));
}

static void lists_have_at_most_32_values(void **state) {
    (void)state;
    DipCommandLine line;
    char threads[200] = "1";
    for (int i = 2; i <= DIP_BENCH_MAX_VALUES; i++) {
        snprintf(threads + strlen(threads), sizeof threads - strlen(threads), ",%d", i);
    }
    assert_int_equal(options_of(&line, WORDS("--threads", threads, "--sets", "aa=2"))
                         ->counts[DIP_BENCH_AXIS_THREADS],
                     32);
    dip_command_line_free(&line);
    strcat(threads, ",33");
    assert_refused(DIP_ERROR_OVERSIZED, "--threads", WORDS("--threads", threads));
}

static void too_many_combinations_are_refused(void **state) {
    (void)state;
    assert_refused(DIP_ERROR_RANGE, "bench",
                   WORDS("--threads", "1,2,3,4,5,6,7,8,9,10", "--size",
                         "1x1,2x1,3x1,4x1,5x1,6x1,7x1,8x1,9x1")); // times 6 sets: 540 combinations
}

static void a_grid_excludes_a_scene(void **state) {
    (void)state;
    assert_refused(DIP_ERROR_CONFLICT, "--grid", WORDS("--grid", "9", "--model", "m"));
    assert_refused(DIP_ERROR_CONFLICT, "--grid", WORDS("--grid", "9", "--path", "p"));
    assert_refused(DIP_ERROR_CONFLICT, "--grid", WORDS("--grid", "9", "--category", "AA"));
    assert_refused(DIP_ERROR_MISSING, "--grid-out-of-view", WORDS("--grid-out-of-view"));
}

static void plots_are_refused_without_an_axis_or_with_two_programs(void **state) {
    (void)state;
    assert_refused(DIP_ERROR_MISSING, "--svg", WORDS("--svg", "s", "--sets", "aa=2;aa=2,af=4"));
    assert_refused(DIP_ERROR_CONFLICT, "--svg", WORDS("--svg", "s", "--vs", "/bin/sh"));
    assert_refused(DIP_ERROR_IO, "--vs", WORDS("--vs", "./none"));
}

static void session_loads_a_scene_only_if_it_is_drawn(void **state) {
    (void)state;
    static const struct {
        const char *words[5];
        bool scene;
    } cases[] = {
        {{NULL}, true},
        {{"--grid", "9", NULL}, false},
        {{"--vs", "/bin/sh", NULL}, false},
        {{"--vs", "/bin/sh", "--serve", NULL}, true},
        {{"--grid", "9", "--serve", NULL}, false},
    };
    for (size_t i = 0; i < DIP_ARRAY_COUNT(cases); i++) {
        DipCommandLine line;
        DipSessionDef def = {0};
        options_of(&line, cases[i].words);
        line.command->describe_session(line.options, &def);
        assert_int_equal(def.scene, cases[i].scene);
        assert_false(def.renderers || def.keep_model);
        dip_command_line_free(&line);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults_are_six_settings_and_empty_lists),
        cmocka_unit_test(lists_keep_their_order),
        cmocka_unit_test(render_scales_are_shares),
        cmocka_unit_test(the_whole_command_line_is_kept_for_other_programs),
        cmocka_unit_test(bad_values_name_the_option),
        cmocka_unit_test(lists_have_at_most_32_values),
        cmocka_unit_test(too_many_combinations_are_refused),
        cmocka_unit_test(a_grid_excludes_a_scene),
        cmocka_unit_test(plots_are_refused_without_an_axis_or_with_two_programs),
        cmocka_unit_test(session_loads_a_scene_only_if_it_is_drawn),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
