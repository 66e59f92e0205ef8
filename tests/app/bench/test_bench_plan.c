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
        const int *at = plan.at[i];
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
    dip_bench_label(&plan, 3, DIP_BENCH_AXIS_COUNT, label);
    assert_string_equal(label, "64x48, aa=4, 2 threads");
    dip_bench_label(&plan, 4, DIP_BENCH_AXIS_THREADS, label);
    assert_string_equal(label, "128x96, aa=none");
    dip_bench_fixed_label(&plan, label);
    assert_string_equal(label, "scalar");
    dip_made_single_plan(&plan, 3, 2);
    dip_bench_label(&plan, 0, DIP_BENCH_AXIS_COUNT, label);
    assert_string_equal(label, "aa=none"); // no axis varies
    dip_bench_fixed_label(&plan, label);
    assert_string_equal(label, "64x48, aa=none, scalar, 1 thread");
}

static void the_session_fills_in_what_options_leave_open(void **state) {
    (void)state;
    DipSession session = {.isa = DIP_ISA_SCALAR};
    session.config.res.width = 320;
    session.config.res.height = 200;
    DipBenchOptions options = {.counts[DIP_BENCH_AXIS_SET] = 1,
                               .threads = {0},
                               .counts[DIP_BENCH_AXIS_THREADS] = 1,
                               .frames = 1,
                               .measure.rounds = 1};
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
    dip_bench_value_name(&plan, 0, DIP_BENCH_AXIS_GRID, name, sizeof name);
    assert_string_equal(name, "");
    DipBenchOptions options = plan.options;
    options.grids[0] = 10;
    options.grids[1] = 2000;
    options.counts[DIP_BENCH_AXIS_GRID] = 2;
    const DipSession session = {.isa = DIP_ISA_SCALAR};
    dip_bench_plan_make(&plan, &session, &options);
    assert_int_equal(plan.count, 2);
    dip_bench_value_name(&plan, 1, DIP_BENCH_AXIS_GRID, name, sizeof name);
    assert_string_equal(name, "2000 triangles");
}

// Two sizes, three scales, two instruction sets and three numbers of threads: the base has the
// first size and set, and the greatest scale.
static void rows_know_with_which_rows_they_are_compared(void **state) {
    (void)state;
    const DipSession session = {.isa = DIP_ISA_SCALAR};
    const DipBenchOptions options = {.counts[DIP_BENCH_AXIS_SET] = 2,
                                     .threads = {4, 1, 2},
                                     .counts[DIP_BENCH_AXIS_THREADS] = 3,
                                     .isas = {DIP_ISA_SCALAR, DIP_ISA_SCALAR},
                                     .counts[DIP_BENCH_AXIS_ISA] = 2,
                                     .sizes = {{64, 48}, {128, 96}},
                                     .counts[DIP_BENCH_AXIS_SIZE] = 2,
                                     .scales = {0.5, 1.0, 0.75},
                                     .counts[DIP_BENCH_AXIS_SCALE] = 3,
                                     .frames = 1,
                                     .measure.rounds = 1,
                                     .measure.has_seed = true};
    dip_bench_plan_make(&plan, &session, &options);
    assert_int_equal(plan.count, 2 * 3 * 2 * 2 * 3);
    assert_int_equal(plan.base, 12);
    const int *at = plan.at[plan.base];
    assert_int_equal(at[DIP_BENCH_AXIS_SCALE], 1);
    assert_int_equal(at[DIP_BENCH_AXIS_SIZE] + at[DIP_BENCH_AXIS_SET] + at[DIP_BENCH_AXIS_ISA] +
                         at[DIP_BENCH_AXIS_THREADS],
                     0);
    for (int i = 0; i < plan.count; i++) {
        assert_int_equal(dip_bench_fewest_threads(&plan, i), i / 3 * 3 + 1);
        assert_int_equal(dip_bench_same_pictures(&plan, i), i / 6 * 6);
    }
}

static void render_scales_are_named_with_the_size_that_is_drawn(void **state) {
    (void)state;
    char name[64];
    dip_made_single_plan(&plan, 1, 1);
    dip_bench_value_name(&plan, 0, DIP_BENCH_AXIS_SCALE, name, sizeof name);
    assert_string_equal(name, "");
    DipBenchOptions options = plan.options;
    options.scales[0] = 0.5;
    options.counts[DIP_BENCH_AXIS_SCALE] = 1;
    const DipSession session = {.isa = DIP_ISA_SCALAR};
    dip_bench_plan_make(&plan, &session, &options);
    dip_bench_value_name(&plan, 0, DIP_BENCH_AXIS_SCALE, name, sizeof name);
    assert_string_equal(name, "scale 0.5 (32x24)");
}

static void scaled_pictures_keep_their_shape(void **state) {
    (void)state;
    static const struct {
        int width, height;
        double scale;
        int to_width, to_height;
    } rows[] = {
        {640, 480, 0.5, 320, 240},     {640, 480, 0.7071, 452, 339},
        {640, 480, 1.0, 640, 480},     {640, 480, 0.1, 64, 48},
        {1920, 1080, 0.85, 1632, 918}, {1280, 720, 0.7071, 912, 513},
        {641, 479, 0.5, 321, 240}, // No smaller size has exactly this shape.
        {641, 479, 1.0, 641, 479},     {1, 1, 0.1, 1, 1},
        {1, 700, 0.5, 1, 350},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        int width, height;
        dip_bench_drawn_size(rows[i].width, rows[i].height, rows[i].scale, &width, &height);
        assert_int_equal(width, rows[i].to_width);
        assert_int_equal(height, rows[i].to_height);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_last_axis_changes_fastest),
        cmocka_unit_test(labels_name_what_varies),
        cmocka_unit_test(the_session_fills_in_what_options_leave_open),
        cmocka_unit_test(grids_are_named_by_their_triangles),
        cmocka_unit_test(rows_know_with_which_rows_they_are_compared),
        cmocka_unit_test(render_scales_are_named_with_the_size_that_is_drawn),
        cmocka_unit_test(scaled_pictures_keep_their_shape),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
