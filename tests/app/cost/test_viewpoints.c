// Tests of intervals over viewpoints and of noise floors, in every metric.
#include "app/report/report.h"
#include "app/measure/metrics/difference.h"
#include "app/measure/metrics/ssim.h"
#include "tests/app/cost/made_report.h"
#include "tests/app/measure/map_sum.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include <math.h>

static void expect_near(double found, double expected, double tolerance) {
    if (!(fabs(found - expected) <= tolerance)) {
        fail_msg("%.12g, expected %.12g", found, expected);
    }
}

static uint32_t random_state = 1;

// Returns a number of a standard normal distribution, nearly: the sum of twelve uniform ones.
static double normal(void) {
    double sum = -6.0;
    for (int i = 0; i < 12; i++) {
        random_state = random_state * 1664525u + 1013904223u;
        sum += (random_state >> 8) * 0x1p-24;
    }
    return sum;
}

// Sets the mean squares and the means of a row at a viewpoint of ten pixels.
static void set_errors(DipCostReport *report, int row, int viewpoint, double square, double ssim) {
    DipMetricSums *sums = &report->rows[row].viewpoints[viewpoint];
    report->rows[row].judged[viewpoint] = true;
    *sums = (DipMetricSums){.bursts = 1.0, .squared_flicker = square / 4.0};
    sums->regions[0] = (DipMetricRegionSums){.pixels = 10.0,
                                             .squared_lin = 10.0 * square,
                                             .squared_codes = 10.0 * 1e4 * square,
                                             .ssim = 6.0 * ssim,
                                             .ssim_pixels = 6.0,
                                             .flip = 10.0 * (1.0 - ssim)};
}

// Mean squares of 1e-4, 4e-4 and 7e-4 have the mean 4e-4 and the standard deviation 3e-4; t with 2
// degrees of freedom is 4.303 (published tables).
static void intervals_follow_the_tables(void **state) {
    (void)state;
    DipCostReport report;
    dip_made_report(&report, 2);
    for (int p = 0; p < 3; p++) {
        set_errors(&report, 0, p, 1e-4 + 3e-4 * p, 0.9 + 0.01 * p);
        set_errors(&report, 2, p, 1e-4 + 3e-4 * p, 0.95 + 0.01 * p);
    }
    const double half = 4.303 * 3e-4 / sqrt(3.0) / 4e-4; // Of the logarithm.
    const DipEstimate rmse = dip_cost_metric(&report, 0, DIP_COST_RMSE);
    expect_near(rmse.value, 0.02, 1e-12);
    expect_near(rmse.value, dip_cost_row_metrics(&report, 0).rmse_lin, 1e-12);
    expect_near(rmse.low, 0.02 * exp(-half / 2.0), 2e-6);
    expect_near(rmse.high, 0.02 * exp(half / 2.0), 3e-5);
    const DipEstimate psnr = dip_cost_metric(&report, 0, DIP_COST_PSNR);
    expect_near(psnr.value, 10.0 * log10(255.0 * 255.0 / 4.0), 1e-9);
    expect_near(psnr.high - psnr.value, 10.0 / log(10.0) * half, 2e-3);
    expect_near(psnr.value - psnr.low, 10.0 / log(10.0) * half, 2e-3);
    const DipEstimate flicker = dip_cost_metric(&report, 0, DIP_COST_FLICKER);
    expect_near(flicker.value, 0.01, 1e-12);
    expect_near(flicker.high / flicker.value, rmse.high / rmse.value, 1e-12);
    report.options.burst = 1; // One frame at each viewpoint tells nothing of flicker.
    assert_true(isnan(dip_cost_metric(&report, 0, DIP_COST_FLICKER).value));
    assert_true(isnan(dip_cost_metric_change(&report, 2, 0, DIP_COST_FLICKER).value));
    report.options.burst = 2;
    const DipEstimate ssim = dip_cost_metric(&report, 0, DIP_COST_SSIM);
    expect_near(ssim.value, 0.91, 1e-12);
    expect_near(ssim.low, 0.91 - 4.303 * 0.01 / sqrt(3.0), 1e-5);
    expect_near(dip_cost_metric(&report, 2, DIP_COST_SSIM).high, 0.96 + 4.303 * 0.01 / sqrt(3.0),
                1e-5);
    const DipEstimate change = dip_cost_metric_change(&report, 2, 0, DIP_COST_SSIM);
    expect_near(change.value, 0.05, 1e-12);
    expect_near(change.high - change.low, 0.0, 1e-12);
    set_errors(&report, 2, 0, 1e-4, 0.8);
    assert_true(dip_cost_metric(&report, 2, DIP_COST_SSIM).high == 1.0); // No more is possible.
    report.rows[2].judged[0] = report.rows[2].judged[1] = false;
    for (int m = 0; m < DIP_COST_METRIC_COUNT; m++) { // One viewpoint.
        assert_true(isnan(dip_cost_metric(&report, 2, (DipCostMetric)m).low));
        assert_true(isnan(dip_cost_metric_change(&report, 2, 0, (DipCostMetric)m).high));
    }
    dip_cost_report_free(&report);
}

// Mean squares whose logarithms are normal with the standard deviation `sigma` have the mean
// exp(sigma^2 / 2). Of 4000 samples of three viewpoints each, the intervals must hold it in about
// 95 %.
static double coverage(DipCostReport *report, double sigma, DipCostMetric metric) {
    enum { RUNS = 4000 };
    const double mean = exp(sigma * sigma / 2.0);
    const double truth = metric == DIP_COST_PSNR ? dip_psnr_db(1e4 * mean) : sqrt(mean);
    int held = 0;
    for (int run = 0; run < RUNS; run++) {
        for (int p = 0; p < 3; p++) {
            set_errors(report, 0, p, exp(sigma * normal()), 0.9);
        }
        const DipEstimate estimate = dip_cost_metric(report, 0, metric);
        held += estimate.low <= truth && truth <= estimate.high;
    }
    return (double)held / RUNS;
}

static void intervals_hold_the_mean_of_skewed_squares(void **state) {
    (void)state;
    DipCostReport report;
    dip_made_report(&report, 2);
    const double sigmas[] = {0.1, 0.3, 0.6};
    for (int i = 0; i < 3; i++) {
        const double rmse = coverage(&report, sigmas[i], DIP_COST_RMSE);
        const double psnr = coverage(&report, sigmas[i], DIP_COST_PSNR);
        if (fmin(rmse, psnr) < 0.93 || fmax(rmse, psnr) > 0.98) {
            fail_msg("sigma %.1f: %.3f of RMSE and %.3f of PSNR", sigmas[i], rmse, psnr);
        }
    }
    dip_cost_report_free(&report);
}

// --- floors --------------------------------------------------------------------------------------

enum { SIZE = 96 };

typedef struct Grey {
    uint8_t rgba8[SIZE * SIZE * 4];
} Grey;

static void set_pixel(Grey *to, int i, double code) {
    const uint8_t grey = (uint8_t)(code + 0.5);
    for (int c = 0; c < 4; c++) {
        to->rgba8[4 * i + c] = grey;
    }
}

// Returns the PSNR and the SSIM of two pictures.
static DipMetrics compare(const Grey *a, const Grey *b) {
    static float map[SIZE * SIZE];
    const DipSrgbPicture x = {a->rgba8, 4 * SIZE, SIZE, SIZE};
    const DipSrgbPicture y = {b->rgba8, 4 * SIZE, SIZE, SIZE};
    DipMetrics metrics = {0};
    dip_difference_codes_map(&x, &y, map);
    metrics.psnr_db =
        dip_psnr_db(dip_map_mean(dip_map_sum(map, SIZE * SIZE, (DipPixelMask){NULL, 0})));
    assert_true(dip_ssim_map(&x, &y, map));
    metrics.ssim = dip_map_mean(dip_map_sum(map, SIZE * SIZE, (DipPixelMask){NULL, 0}));
    return metrics;
}

// Two halves are a picture with noise of their own. The floor that their comparison gives must be
// the error that their mean has against the picture without noise.
static void floors_are_the_errors_of_the_truths_themselves(void **state) {
    (void)state;
    static Grey clean, halves[2], mean;
    DipCostReport report;
    for (int i = 0; i < SIZE * SIZE; i++) {
        const double x = i % SIZE, y = i / SIZE;
        const double code = floor(128.0 + 60.0 * sin(x / 3.0) * cos(y / 4.0));
        const double a = code + 4.0 * normal(), b = code + 4.0 * normal();
        set_pixel(&clean, i, code);
        set_pixel(&halves[0], i, a);
        set_pixel(&halves[1], i, b);
        set_pixel(&mean, i, (a + b) / 2.0);
    }
    const DipMetrics between = compare(&halves[0], &halves[1]);
    const DipMetrics truth = compare(&mean, &clean);
    dip_made_report(&report, 2);
    for (int p = 0; p < 3; p++) {
        report.has_floor[p] = p == 0;
    }
    DipMetricRegionSums *sums = &report.floors[0].regions[0];
    *sums = (DipMetricRegionSums){
        .pixels = 1.0,
        .squared_lin = 0.02 * 0.02,
        .squared_codes = 255.0 * 255.0 * pow(10.0, -between.psnr_db / 10.0),
        .ssim = between.ssim,
        .ssim_pixels = 1.0,
        .flip = 0.1,
    };
    const DipMetrics noise = dip_cost_floor_metrics(&report, 0);
    expect_near(noise.rmse_lin, 0.01, 1e-15);
    expect_near(noise.flip, 0.1 * pow(0.5, 0.7), 1e-15);
    expect_near(noise.psnr_db, truth.psnr_db, 0.2);
    expect_near((1.0 - noise.ssim) / (1.0 - truth.ssim), 1.0, 0.1);
    assert_true(fabs(between.psnr_db - truth.psnr_db) > 5.0); // The halves alone are far off.
    dip_cost_report_free(&report);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(intervals_follow_the_tables),
        cmocka_unit_test(intervals_hold_the_mean_of_skewed_squares),
        cmocka_unit_test(floors_are_the_errors_of_the_truths_themselves),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
