// Tests that the caller's floating-point mode changes nothing: every public function of
// app/measure/ that computes with floats gives the same bits in every mode and leaves the mode as
// it was. tests/borders/check_fp_modes.sh checks that no function is missing. The caller's own
// functions run in the caller's mode.
#include "app/measure/metrics/ssim.h"
#include "app/measure/metrics/truth.h"
#include "app/measure/stats/least_squares.h"
#include "app/measure/timing/child.h"
#include "app/measure/timing/driver.h"
#include "renderer/catalogue/scenes.h"
#include "renderer/reference/reference.h"
#include "tests/app/measure/patterns.h"
#include "tests/support/fp_walk.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

enum { WIDTH = 53, HEIGHT = 41, PIXELS = WIDTH * HEIGHT };

// Numbers that are exact in every mode, but whose sums and quotients are not. The last ones are so
// small that flushing to zero loses them or their products.
static const double numbers[] = {0.1,   3.7,   1.0 / 3.0, 255.3,  -0.7,   12.9,
                                 1e-11, 0.987, 2e-155,    7e-300, 3e-310, 5.5};
enum { NUMBERS = sizeof numbers / sizeof *numbers };

static DipPattern pictures[2];
static float light[2][3 * PIXELS];
static float map[3 * PIXELS];
static DipTestScene scene;

static void hash_numbers(DipHash *hash, const void *values, size_t count) {
    dip_hash_bytes(hash, values, count * sizeof(double));
}

static void hash_map(DipHash *hash, size_t count) {
    dip_hash_bytes(hash, map, count * sizeof *map);
}

static int make_inputs(void **state) {
    (void)state;
    dip_test_scene_make(&scene, DIP_TEST_SCENE_water_effects);
    dip_pattern_fill(&pictures[0], WIDTH, HEIGHT, dip_pattern_hash);
    dip_pattern_fill(&pictures[1], WIDTH, HEIGHT, dip_pattern_gradient);
    for (int i = 0; i < 3 * PIXELS; i++) {
        light[0][i] = (float)dip_pattern_hash(i, 1, 0) / 1000.0f;
        light[1][i] = i % 97 == 0 ? 1e-39f : (float)dip_pattern_hash(i, 2, 0) / 257.0f;
    }
    return 0;
}

static int free_inputs(void **state) {
    (void)state;
    dip_test_scene_free(&scene);
    return 0;
}

// --- metrics -------------------------------------------------------------------------------------

static void call_differences(DipHash *hash) {
    dip_difference_lin(&pictures[0].picture, light[0], map);
    hash_map(hash, 3 * PIXELS);
}

static void call_squared_differences(DipHash *hash) {
    dip_difference_squared_map(light[1], PIXELS, map);
    hash_map(hash, PIXELS);
}

static void call_differences_of_codes(DipHash *hash) {
    dip_difference_codes_map(&pictures[0].picture, &pictures[1].picture, map);
    hash_map(hash, PIXELS);
}

static void call_map_sum(DipHash *hash) {
    DipMapSum sum = {3e-310, 0.0};
    dip_map_sum_add(&sum, light[1], PIXELS, (DipPixelMask){0});
    hash_numbers(hash, &sum, 2);
}

static void call_psnr(DipHash *hash) {
    for (int i = 0; i < NUMBERS; i++) {
        dip_hash_number(hash, dip_psnr_db(numbers[i]));
    }
}

// Fills sums with numbers that are 0 or more.
static DipMetricSums some_sums(int from) {
    static const double values[] = {0.1, 3.7, 1.0 / 3.0, 255.3, 12.9, 3e-310, 1.7};
    DipMetricSums sums;
    double to[DIP_METRIC_SUM_COUNT];
    for (int i = 0; i < DIP_METRIC_SUM_COUNT; i++) {
        to[i] = values[(i + from) % 7];
    }
    memcpy(&sums, to, sizeof sums);
    return sums;
}

static void call_sums(DipHash *hash) {
    DipMetricSums to = some_sums(0);
    const DipMetricSums sums = some_sums(3);
    dip_metric_sums_add(&to, &sums);
    hash_numbers(hash, &to, DIP_METRIC_SUM_COUNT);
}

static void call_metrics(DipHash *hash) {
    const DipMetricSums sums = some_sums(0);
    for (int r = 0; r < DIP_METRIC_REGION_COUNT; r++) {
        const DipMetrics metrics = dip_metrics_of(&sums, r);
        hash_numbers(hash, &metrics, 4);
    }
}

static void call_flicker_metrics(DipHash *hash) {
    for (int from = 0; from < 7; from++) {
        const DipMetricSums sums = some_sums(from);
        const DipFlickerMetrics metrics = dip_flicker_metrics_of(&sums);
        hash_numbers(hash, &metrics, 4);
    }
}

static void call_flicker(DipHash *hash) {
    DipFlicker flicker;
    assert_true(dip_flicker_init(&flicker, 3 * PIXELS));
    for (int frame = 0; frame < 3; frame++) {
        dip_flicker_add(&flicker, light[frame % 2], 3 * PIXELS);
    }
    hash_numbers(hash, flicker.mean, 3 * PIXELS);
    hash_numbers(hash, flicker.deviation, 3 * PIXELS);
    const DipFlickerResult result = dip_flicker_result(&flicker);
    hash_numbers(hash, &result, 4);
    dip_flicker_free(&flicker);
}

// The result of sums that no mode has changed.
static void call_flicker_result(DipHash *hash) {
    double mean[NUMBERS], deviation[NUMBERS];
    memcpy(mean, numbers, sizeof mean);
    memcpy(deviation, numbers, sizeof deviation);
    const DipFlicker flicker = {.mean = mean,
                                .deviation = deviation,
                                .value_count = NUMBERS,
                                .frame_count = 7,
                                .step_squares = 0.7,
                                .pair_squares = 0.3};
    const DipFlickerResult result = dip_flicker_result(&flicker);
    hash_numbers(hash, &result, 4);
}

static void call_flip(DipHash *hash) {
    DipFlip flip;
    DipFlipAnalysis analysis;
    assert_true(dip_flip_init(&flip, WIDTH, HEIGHT, 67.02));
    assert_true(dip_flip_analysis_init(&flip, &analysis));
    dip_hash_bytes(hash, flip.light, sizeof flip.light);
    dip_flip_analyse(&flip, &pictures[0].picture, &analysis);
    dip_hash_bytes(hash, analysis.memory, 7 * PIXELS * sizeof(float));
    dip_flip_analyse_block(&flip, &pictures[1].picture, 0, &analysis);
    dip_hash_bytes(hash, analysis.memory, 7 * PIXELS * sizeof(float));
    dip_flip_compare(&flip, &pictures[0].picture, &analysis, map);
    hash_map(hash, PIXELS);
    dip_flip_compare_block(&flip, &pictures[0].picture, 0, &analysis, map);
    hash_map(hash, PIXELS);
    dip_flip_analysis_free(&analysis);
    dip_flip_free(&flip);
}

static void call_magma(DipHash *hash) {
    for (int i = 0; i <= 4096; i++) {
        uint8_t rgb[3];
        dip_magma((float)i / 4096.0f, rgb);
        dip_hash_bytes(hash, rgb, 3);
    }
}

static void call_flip_tail(DipHash *hash) {
    DipFlipTailMeter meter;
    assert_true(dip_flip_tail_init(&meter));
    dip_flip_tail_add(&meter, light[0], WIDTH, HEIGHT);
    dip_flip_tail_add(&meter, light[1], WIDTH, HEIGHT);
    const DipFlipTail tail = dip_flip_tail_result(&meter);
    hash_numbers(hash, &tail, DIP_FLIP_TAIL_COUNT);
    dip_flip_tail_free(&meter);
}

static void call_ssim(DipHash *hash) {
    assert_true(dip_ssim_map(&pictures[0].picture, &pictures[1].picture, map));
    hash_map(hash, PIXELS);
}

// Measures with and without linear light, as single pictures and as bursts.
static void call_meter(DipHash *hash) {
    static uint8_t classes[PIXELS];
    for (int i = 0; i < PIXELS; i++) {
        classes[i] = (uint8_t)(i % (DIP_METRIC_REGION_COUNT - 1));
    }
    for (int i = 0; i < 4; i++) {
        DipMeter meter;
        DipMetricSums sums = some_sums(0);
        const DipMeterStandard standard = {
            .picture = pictures[1].picture, .rgb_lin = light[1], .classes = classes};
        const DipMeterKind kind = i < 2 ? DIP_METER_BURSTS : DIP_METER_PICTURES;
        assert_true(dip_meter_init(&meter, kind, WIDTH, HEIGHT, 67.02));
        assert_true(
            dip_meter_add(&meter, &pictures[0].picture, i % 2 ? light[0] : NULL, &standard, &sums));
        dip_meter_begin(&meter, &pictures[1].picture, NULL);
        while (dip_meter_step(&meter) == DIP_STEP_WORKING) {
        }
        dip_meter_end_burst(&meter, &sums);
        hash_numbers(hash, &sums, DIP_METRIC_SUM_COUNT);
        hash_numbers(hash, &meter.sums, DIP_METRIC_SUM_COUNT);
        dip_meter_free(&meter);
    }
}

// --- truths --------------------------------------------------------------------------------------

static bool draw_half(const DipTruthDef *def, int half, double *rgb_lin, DipError *err) {
    (void)err;
    if (fp_walk_mode() != FP_MODE_COUNT) {
        assert_true(fp_mode_is(fp_walk_mode())); // The caller's function has the caller's mode.
    }
    for (int i = 0; i < 3 * def->width * def->height; i++) {
        rgb_lin[i] = (double)light[half][i];
    }
    return true;
}

static void hash_truth(DipHash *hash, const DipTruth *truth) {
    const size_t pixels = (size_t)truth->width * (size_t)truth->height;
    dip_hash_bytes(hash, truth->rgb_lin, 3 * pixels * sizeof(float));
    dip_hash_bytes(hash, truth->rgba8, 4 * pixels);
    dip_hash_bytes(hash, truth->classes, pixels);
    hash_numbers(hash, &truth->floor, DIP_METRIC_SUM_COUNT);
    dip_hash_text(hash, truth->key);
}

static DipTruthDef def_of_truth(void) {
    return (DipTruthDef){.scene_hash = "scene",
                         .pose = {{0.1, 0.2, 3e-310}, {0, 0, 0, 1}, 50.0},
                         .width = WIDTH,
                         .height = HEIGHT,
                         .samples = 4,
                         .pixels_per_degree = 67.02,
                         .draw = draw_half};
}

static void call_truth(DipHash *hash) {
    const DipTruthDef def = def_of_truth();
    DipTruth truth;
    assert_true(dip_truth_get(&truth, &def, NULL, NULL, NULL, NULL, NULL));
    hash_truth(hash, &truth);
    dip_truth_free(&truth);
}

// A truth that the reference renderer draws in steps.
static void call_truth_job(DipHash *hash) {
    DipReference *reference = dip_reference_create(&scene.def, NULL);
    DipTruthDef def = def_of_truth();
    def.draw = NULL;
    def.reference = reference;
    def.pose = scene.pose;
    def.width = 24;
    def.height = 16;
    DipTruthJob *job = dip_truth_job_create(&def, NULL, NULL, true, NULL);
    assert_true(reference && job);
    while (dip_truth_job_step(job, NULL) != DIP_STEP_DONE) {
        int samples;
        dip_hash_number(hash, dip_truth_job_drawn(job, &samples));
        if (dip_truth_job_truth(job)) {
            hash_truth(hash, dip_truth_job_truth(job));
        }
    }
    dip_truth_job_destroy(&job);
    dip_reference_destroy(&reference);
}

static void call_floor(DipHash *hash) {
    for (int r = 0; r < DIP_METRIC_REGION_COUNT; r++) {
        const DipMetricSums floor = some_sums(r);
        dip_hash_number(hash, dip_truth_floor_rmse(&floor, r));
    }
    // Errors of exactly three times the floor's, so that the rounding of the roots decides.
    DipMetricSums floor = some_sums(0), sums = some_sums(0);
    for (int i = 1; i < 200; i++) {
        floor.regions[0].squared_lin = (double)(4 * i);
        sums.regions[0].squared_lin = (double)(9 * i);
        floor.regions[0].pixels = sums.regions[0].pixels = 7.0;
        dip_hash_integer(hash, dip_truth_hides(&floor, &sums));
    }
}

// --- estimates -----------------------------------------------------------------------------------

static void hash_estimate(DipHash *hash, const DipEstimate *estimate) {
    hash_numbers(hash, estimate, 5);
}

static void call_quantile(DipHash *hash) {
    static const double degrees[] = {1.0, 2.7, 31.4, 1e9};
    for (int i = 0; i < 4; i++) {
        dip_hash_number(hash, dip_student_quantile(0.975, degrees[i]));
    }
}

static const DipEstimate estimate_of_test = {1.3, 1.1, 1.5, 0.07, 4.3};

static void call_estimate(DipHash *hash) {
    const DipEstimate made = dip_estimate_make(1.3, 0.07, 4.3);
    const DipEstimate unknown = dip_estimate_make(3e-310, NAN, 4.3);
    hash_estimate(hash, &made);
    hash_estimate(hash, &unknown);
}

static void call_wider_estimate(DipHash *hash) {
    const DipEstimate wider = dip_estimate_widen(&estimate_of_test, 0.013);
    hash_estimate(hash, &wider);
}

static void call_chance(DipHash *hash) {
    for (int i = 0; i < NUMBERS; i++) {
        dip_hash_number(hash, dip_estimate_chance_below(&estimate_of_test, numbers[i], 0.011));
    }
}

static void call_percentile(DipHash *hash) {
    double values[NUMBERS], scratch[NUMBERS];
    memcpy(values, numbers, sizeof values);
    dip_hash_number(hash, dip_percentile_of(values, NUMBERS, 0.13, scratch));
    dip_hash_number(hash, dip_percentile(values, NUMBERS, 0.77));
    hash_numbers(hash, values, NUMBERS);
}

static void call_median(DipHash *hash) {
    double values[NUMBERS];
    memcpy(values, numbers, sizeof values);
    dip_hash_number(hash, dip_median(values, NUMBERS));
    hash_numbers(hash, values, NUMBERS);
    double few[2] = {0.1, 0.7};
    dip_hash_number(hash, dip_median(few, 2));
}

// --- least squares -------------------------------------------------------------------------------

enum { TERMS = 5, ROWS = 24 };

static DipNormalEquations equations;

static double amount(int row, int term) {
    return (double)dip_pattern_hash(row, term, 0);
}

static void call_least_squares(DipHash *hash) {
    const double scale[TERMS] = {255.3, 251.7, 253.1, 249.9, 254.3};
    double prices[TERMS];
    dip_normal_equations_begin(&equations, TERMS, scale);
    for (int row = 0; row < ROWS; row++) {
        double amounts[TERMS];
        for (int term = 0; term < TERMS; term++) {
            amounts[term] = amount(row, term);
        }
        dip_normal_equations_add(&equations, amounts, amount(row, TERMS), 0.3);
    }
    hash_numbers(hash, equations.left, DIP_LEAST_SQUARES_MAX_TERMS * TERMS);
    hash_numbers(hash, equations.right, TERMS);
    dip_least_squares_nonnegative(&equations, prices);
    hash_numbers(hash, prices, TERMS);
}

// The prices of equations that no mode has changed.
static void call_prices(DipHash *hash) {
    double prices[TERMS];
    dip_normal_equations_begin(&equations, TERMS, (const double[]){3.0, 7.0, 11.0, 13.0, 17.0});
    for (int i = 0; i < TERMS; i++) {
        for (int k = 0; k < TERMS; k++) {
            equations.left[i][k] = i == k ? 9.0 : 1.0;
        }
        equations.right[i] = amount(i, 0);
    }
    dip_least_squares_nonnegative(&equations, prices);
    hash_numbers(hash, prices, TERMS);
}

// Rows with the same amounts in another order. They tell equally much at first, so that rounding
// decides which one is chosen.
static void call_design(DipHash *hash) {
    double matrix[ROWS * TERMS];
    int chosen[ROWS] = {3};
    for (int i = 0; i < ROWS * TERMS; i++) {
        matrix[i] = amount(0, (i / TERMS + i) % TERMS);
    }
    dip_design_choose(matrix, ROWS, TERMS, 1, ROWS - 2, chosen);
    dip_hash_bytes(hash, chosen, sizeof chosen);
}

// --- the test ------------------------------------------------------------------------------------

static const FpWalkEntry entries[] = {
    {"differences of light", call_differences},
    {"squared differences", call_squared_differences},
    {"differences of codes", call_differences_of_codes},
    {"sum of a map", call_map_sum},
    {"PSNR", call_psnr},
    {"sums of metrics", call_sums},
    {"metrics", call_metrics},
    {"metrics of flicker", call_flicker_metrics},
    {"flicker of pictures", call_flicker},
    {"flicker of sums", call_flicker_result},
    {"FLIP", call_flip},
    {"magma", call_magma},
    {"percentiles of FLIP", call_flip_tail},
    {"SSIM", call_ssim},
    {"meter", call_meter},
    {"truth", call_truth},
    {"truth of the reference", call_truth_job},
    {"floor of a truth", call_floor},
    {"quantile", call_quantile},
    {"estimate", call_estimate},
    {"wider estimate", call_wider_estimate},
    {"chance", call_chance},
    {"percentile", call_percentile},
    {"median", call_median},
    {"least squares", call_least_squares},
    {"prices", call_prices},
    {"design", call_design},
};

int main(void) {
    return fp_walk_main(entries, sizeof entries / sizeof *entries, make_inputs, free_inputs);
}
