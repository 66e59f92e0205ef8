// Tests that a plan holds every combination of the axes' values, in order, and labels each
// combination.
#include "tests/app/bench/made_result.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static DipBenchPlan plan;

static void the_last_axis_changes_fastest(void **state) {
    (void)state;
    // Each row holds the indices of size, set of settings and number of threads. There is one
    // instruction set and no grid.
    static const int expected[8][3] = {{0, 0, 0}, {0, 0, 1}, {0, 1, 0}, {0, 1, 1},
                                       {1, 0, 0}, {1, 0, 1}, {1, 1, 0}, {1, 1, 1}};
    dip_made_plan(&plan, 3, 2);
    assert_int_equal(plan.count, 8);
    for (int i = 0; i < 8; i++) {
        const int *at = plan.combinations[i].at;
        assert_int_equal(at[DIP_BENCH_AXIS_GRID], 0);
        assert_int_equal(at[DIP_BENCH_AXIS_SIZE], expected[i][0]);
        assert_int_equal(at[DIP_BENCH_AXIS_SET], expected[i][1]);
        assert_int_equal(at[DIP_BENCH_AXIS_ISA], 0);
        assert_int_equal(at[DIP_BENCH_AXIS_THREADS], expected[i][2]);
    }
}

static void labels_name_what_varies(void **state) {
    (void)state;
    char label[DIP_BENCH_LABEL_SIZE];
    dip_made_plan(&plan, 3, 2);
    dip_bench_label(&plan, &plan.combinations[3], DIP_BENCH_AXIS_COUNT, label);
    assert_string_equal(label, "64x48, aa=4, 2 threads");
    dip_bench_label(&plan, &plan.combinations[4], DIP_BENCH_AXIS_THREADS, label);
    assert_string_equal(label, "128x96, aa=none");
    dip_bench_fixed_label(&plan, label);
    assert_string_equal(label, "scalar");
    dip_made_single_plan(&plan, 3, 2);
    dip_bench_label(&plan, &plan.combinations[0], DIP_BENCH_AXIS_COUNT, label);
    assert_string_equal(label, "aa=none"); // no axis varies
    dip_bench_fixed_label(&plan, label);
    assert_string_equal(label, "64x48, aa=none, scalar, 1 thread");
}

static void the_session_fills_in_what_options_leave_open(void **state) {
    (void)state;
    DipSession session = {.isa = DIP_ISA_SCALAR};
    session.config.res.width = 320;
    session.config.res.height = 200;
    DipBenchOptions options = {
        .set_count = 1, .threads = {0}, .threads_count = 1, .frames = 1, .measure.rounds = 1};
    options.sets[0].quality = dip_quality_default();
    dip_bench_plan_make(&plan, &session, &options);
    assert_int_equal(plan.count, 1);
    assert_int_equal(plan.options.sizes[0].width, 320);
    assert_int_equal(plan.options.sizes[0].height, 200);
    assert_true(plan.options.threads[0] >= 1); // the default 0 means all processors
    assert_true(plan.options.measure.seed >= 0);
}

static void grids_are_named_by_their_triangles(void **state) {
    (void)state;
    char name[64];
    dip_made_single_plan(&plan, 1, 1);
    dip_bench_value_name(&plan, plan.combinations, DIP_BENCH_AXIS_GRID, name, sizeof name);
    assert_string_equal(name, "");
    DipBenchOptions options = plan.options;
    options.grids[0] = 10;
    options.grids[1] = 2000;
    options.grid_count = 2;
    const DipSession session = {.isa = DIP_ISA_SCALAR};
    dip_bench_plan_make(&plan, &session, &options);
    assert_int_equal(plan.count, 2);
    dip_bench_value_name(&plan, &plan.combinations[1], DIP_BENCH_AXIS_GRID, name, sizeof name);
    assert_string_equal(name, "2000 triangles");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_last_axis_changes_fastest),
        cmocka_unit_test(labels_name_what_varies),
        cmocka_unit_test(the_session_fills_in_what_options_leave_open),
        cmocka_unit_test(grids_are_named_by_their_triangles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
