// Tests how the catalogue of hard cases judges a row: the greatest error, the case that has it, and
// what does not count as measured.
#include "renderer/catalogue/stability.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static void compare_nothing(StabilityRun *run) {
    (void)run;
}

static void compare_equals(StabilityRun *run) {
    stability_error(run, 0.0, "case %d", 0);
    stability_expect(run, true, "case %d", 1);
}

static void compare_errors(StabilityRun *run) {
    static const double errors[5] = {0.5, -2.0, 0.0, 2.0, 1.0};
    for (int i = 0; i < 5; i++) {
        stability_error(run, errors[i], "case %d", i);
    }
}

static void break_a_promise(StabilityRun *run) {
    stability_expect(run, false, "case %d", 0);
}

static void compare_no_number(StabilityRun *run) {
    stability_error(run, NAN, "case %d", 0);
    stability_error(run, 1e300, "case %d", 1);
}

static void run_out_of_memory(StabilityRun *run) {
    stability_error(run, 0.0, "case %d", 0);
    stability_break(run, "no memory for %s", "a mesh");
    stability_break(run, "something else");
}

typedef struct Expected {
    void (*measure)(StabilityRun *run);
    double bound;
    bool holds;
    double worst;
    const char *worst_at;
    uint64_t cases;
    uint64_t failed;
    const char *broken_why;
} Expected;

static void rows_are_judged_by_their_greatest_error(void **state) {
    (void)state;
    static const Expected rows[] = {
        {compare_nothing, 1.0, false, 0.0, "", 0, 0, "the row compared no case"},
        {compare_equals, 0.0, true, 0.0, "", 2, 0, ""},
        {compare_errors, 2.0, true, 2.0, "case 1", 5, 4, ""},
        {compare_errors, 1.999, false, 2.0, "case 1", 5, 4, ""},
        {break_a_promise, 0.0, false, 1.0, "case 0", 1, 1, ""},
        {compare_no_number, 1e300, false, INFINITY, "case 0", 2, 2, ""},
        {run_out_of_memory, 1.0, false, 0.0, "", 1, 0, "no memory for a mesh"},
        {compare_equals, 0.0, true, 0.0, "", 2, 0, ""},
    };
    StabilityRun run = {.depth = STABILITY_SHORT}; // Each row begins with the results of the last.
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const StabilityRow row = {.bound = rows[i].bound, .measure = rows[i].measure};
        assert_int_equal(stability_measure(&row, &run), rows[i].holds);
        assert_true(run.worst == rows[i].worst);
        assert_string_equal(run.worst_at, rows[i].worst_at);
        assert_int_equal(run.case_count, rows[i].cases);
        assert_int_equal(run.failed_count, rows[i].failed);
        assert_int_equal(run.broken, rows[i].broken_why[0] != '\0');
        assert_string_equal(run.broken_why, rows[i].broken_why);
    }
}

static void keep_numbers(StabilityRun *run) {
    stability_keep(run, (double[]){0.5, -2.0}, 2);
    stability_expect(run, true, "case %d", 0);
}

static void keep_another_number(StabilityRun *run) {
    stability_keep(run, (double[]){0.5, nextafter(-2.0, 0.0)}, 2);
    stability_expect(run, true, "case %d", 0);
}

static void keep_after_another_case(StabilityRun *run) {
    stability_keep(run, (double[]){0.5, -2.0}, 2);
    stability_expect(run, true, "case %d", 1);
}

// The hash of a row is of its cases' names and of its results, and of nothing else.
static void hash_identifies_cases_and_results(void **state) {
    (void)state;
    static void (*const measures[4])(StabilityRun *) = {keep_numbers, keep_another_number,
                                                        keep_after_another_case, keep_numbers};
    char hex[4][DIP_HASH_HEX_SIZE];
    StabilityRun run = {.depth = STABILITY_SHORT};
    for (int i = 0; i < 4; i++) {
        const StabilityRow row = {.measure = measures[i]};
        assert_true(stability_measure(&row, &run));
        dip_hash_hex(&run.hash, hex[i]);
    }
    DipHash expected = dip_hash_begin(0);
    dip_hash_number(&expected, 0.5);
    dip_hash_number(&expected, -2.0);
    dip_hash_text(&expected, "case 0");
    char text[DIP_HASH_HEX_SIZE];
    dip_hash_hex(&expected, text);
    assert_string_equal(hex[0], text);
    assert_string_equal(hex[3], text);
    assert_string_not_equal(hex[1], text);
    assert_string_not_equal(hex[2], text);
}

static void deeper_runs_have_more_cases(void **state) {
    (void)state;
    static const StabilityDepth depths[3] = {STABILITY_SHORT, STABILITY_FULL, STABILITY_LONG};
    for (int i = 0; i < 3; i++) {
        const StabilityRun run = {.depth = depths[i]};
        assert_int_equal(stability_count(&run, 0, 1, 2), i);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_are_judged_by_their_greatest_error),
        cmocka_unit_test(hash_identifies_cases_and_results),
        cmocka_unit_test(deeper_runs_have_more_cases),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
