// Tests of prices: from reports with made-up times, whose prices are computed by hand, and from
// rough times.
#include "app/measure/metrics/flip.h"
#include "app/preview/prices/price_text.h"
#include "app/preview/prices/prices.h"
#include "tests/app/cost/made_report.h"
#include "tests/app/preview/made_live.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { ROUNDS = 3 };

// The 97.5 % quantile of Student's t with two degrees of freedom (tables), times the least standard
// error of a ratio's logarithm (app/measure/stats/rounds.h). Times without noise have no other
// error.
static const double half_width = 1.959964 * 0.001;

static DipCostReport report;
static DipPrices *prices;

static DipQuality settings(const char *text) {
    DipQuality quality;
    assert_true(dip_quality_parse(text, &quality, NULL));
    return quality;
}

// Adds a row that takes ms beside a baseline of base_ms, with the same error at all viewpoints.
static int add_row(const char *text, int path, double ms, double base_ms, double flip) {
    const DipQuality quality = settings(text);
    DipCostRow *rows = realloc(report.rows, ((size_t)report.row_count + 1) * sizeof *rows);
    assert_non_null(rows);
    report.rows = rows;
    const int row = dip_cost_report_add_row(&report, &quality, path, NULL);
    assert_true(row >= 0);
    for (int p = 0; p < report.options.places; p++) {
        DipMetricSums *sums = &rows[row].viewpoints[p];
        rows[row].judged[p] = true;
        sums->bursts = 1.0;
        sums->regions[0].pixels = 10.0;
        sums->regions[0].flip = 10.0 * flip;
        sums->regions[0].squared_lin = 10.0; // An error far above the floor.
    }
    for (int f = 0; f < dip_cost_frame_count(&report); f++) {
        dip_made_frame(&report, row, f, ms, base_ms);
    }
    return row;
}

static int set_up(void **state) {
    (void)state;
    dip_made_report(&report, ROUNDS); // On path 0 the base takes 1 ms, aa=2 3 ms and aa=4 4 ms.
    report.rows[0].viewpoints[0].regions[0].squared_lin = 1e3;
    add_row("af=16", 0, 2.5, 1.0, 0.4);
    add_row("af=16,aaf=on", 0, 2.75, 1.0, 0.35);
    add_row("aa=4,aaa=on,asd=2", 0, 6.0, 1.0, 0.3);
    add_row("aa=4,aaa=on,asd=2,af=16", 0, 8.2, 1.0, 0.25);
    add_row("opt=standard", 0, 1.001, 1.0, 0.5);
    // Path 1, whose baseline takes 2 ms, is the only one with mip detail.
    for (int f = 0; f < dip_cost_frame_count(&report); f++) {
        dip_made_frame(&report, 4, f, 2.0, 2.0);
    }
    add_row("miplod=quality", 1, 1.5, 2.0, 0.6);
    return 0;
}

static int tear_down(void **state) {
    (void)state;
    dip_prices_destroy(&prices);
    dip_cost_report_free(&report);
    return 0;
}

static void take_report(void) {
    assert_true(report.rounds == 0 || dip_cost_estimate_times(&report, NULL));
    prices = dip_prices_create(NULL);
    assert_non_null(prices);
    assert_true(dip_prices_set_report(prices, &report, NULL));
}

static void check_near(double value, double expected) {
    if (!(fabs(value - expected) <= 1e-6 * fmax(1.0, fabs(expected)))) {
        fail_msg("%.9g is not %.9g", value, expected);
    }
}

// Checks a price of `ratio` times a row that takes without_ms, less that row.
static void check_price(const DipPrice *price, double ratio, double without_ms) {
    assert_int_equal(price->state, DIP_PRICE_MEASURED);
    check_near(price->ms, (ratio - 1.0) * without_ms);
    check_near(price->ms_low, (ratio * exp(-half_width) - 1.0) * without_ms);
    check_near(price->ms_high, (ratio * exp(half_width) - 1.0) * without_ms);
    assert_int_equal(dip_price_trust(price) == DIP_PRICE_TRUST_ZERO, fabs(log(ratio)) < half_width);
}

// --- reports -------------------------------------------------------------------------------------

static void a_price_is_what_a_step_adds_to_the_base(void **state) {
    (void)state;
    take_report();
    const DipQuality pane = settings("aa=8,af=2,opt=advanced"); // Other settings do not matter.
    DipPrice price = dip_prices_step(prices, DIP_SETTING_AA, 1, &pane);
    check_price(&price, 3.0, 1.0);
    assert_string_equal(price.beside, "");
    assert_string_equal(price.path, "DEFAULT");
    assert_false(price.needs_company);
    price = dip_prices_step(prices, DIP_SETTING_AF, 4, &pane);
    check_price(&price, 2.5, 1.0);
    price = dip_prices_step(prices, DIP_SETTING_AA, 0, &pane);
    assert_int_equal(price.state, DIP_PRICE_BASE);
    check_near(price.ms, 1.0);
    price = dip_prices_step(prices, DIP_SETTING_AA, 4, &pane); // aa=8 was not measured.
    assert_int_equal(price.state, DIP_PRICE_UNKNOWN);
    assert_false(price.has_flip);
    price = dip_prices_step(prices, DIP_SETTING_MIPDEBUG, 1, &pane);
    assert_int_equal(price.state, DIP_PRICE_UNKNOWN);
}

static void a_price_within_the_noise_is_zero(void **state) {
    (void)state;
    take_report();
    const DipQuality pane = dip_quality_default();
    const DipPrice price = dip_prices_step(prices, DIP_SETTING_OPT, DIP_OPT_STANDARD, &pane);
    check_price(&price, 1.001, 1.0);
    assert_true(dip_price_trust(&price) == DIP_PRICE_TRUST_ZERO);
}

static void steps_that_need_others_are_priced_beside_them(void **state) {
    (void)state;
    take_report();
    const DipQuality pane = settings("aa=4,asd=2,af=16");
    DipPrice price = dip_prices_step(prices, DIP_SETTING_AAA, DIP_AAA_ON, &pane);
    check_price(&price, 6.0 / 4.0, 4.0);
    assert_false(price.needs_company);
    price = dip_prices_step(prices, DIP_SETTING_ASD, 1, &pane);
    check_price(&price, 6.0 / 4.0, 4.0);
    assert_true(price.needs_company);
    assert_string_equal(price.needs, "adaptive AA");
    price = dip_prices_step(prices, DIP_SETTING_AAF, 1, &pane);
    check_price(&price, 2.75 / 2.5, 2.5);
    assert_false(price.needs_company);
    price = dip_prices_step(prices, DIP_SETTING_ASD, 3, &pane);
    assert_int_equal(price.state, DIP_PRICE_UNKNOWN);
    assert_string_equal(price.needs, "AA 8x");
}

// aa=4 with AF was measured with adaptive AA in pairs only.
static void filtering_is_priced_beside_antialiasing(void **state) {
    (void)state;
    add_row("aa=4,af=4", 0, 4.5, 1.0, 0.3);
    take_report();
    DipQuality pane = settings("aa=4,aaa=on,asd=2");
    DipPrice price = dip_prices_step(prices, DIP_SETTING_AF, 4, &pane);
    check_price(&price, 8.2 / 6.0, 6.0);
    assert_string_equal(price.beside, "aa=4,aaa=on,asd=2");
    price = dip_prices_step(prices, DIP_SETTING_AF, 2, &pane); // Beside the same AA.
    check_price(&price, 4.5 / 4.0, 4.0);
    assert_string_equal(price.beside, "aa=4");
    price = dip_prices_step(prices, DIP_SETTING_AAF, 1, &pane); // Without antialiasing.
    check_price(&price, 2.75 / 2.5, 2.5);
    assert_string_equal(price.beside, "af=16");
    price = dip_prices_step(prices, DIP_SETTING_AF, 0, &pane); // The base is that of all prices.
    assert_int_equal(price.state, DIP_PRICE_BASE);
    check_near(price.ms, 1.0);
    pane = settings("aa=2,aaa=on,asd=2"); // One group, so adaptive AA has no effect.
    price = dip_prices_step(prices, DIP_SETTING_AF, 4, &pane);
    check_price(&price, 2.5, 1.0);
    assert_string_equal(price.beside, "");
}

static void steps_without_their_company_say_what_they_need(void **state) {
    (void)state;
    take_report();
    const DipQuality pane = dip_quality_default();
    DipPrice price = dip_prices_step(prices, DIP_SETTING_AAF, 1, &pane);
    check_price(&price, 2.75 / 2.5, 2.5); // Beside 16x, as the report's sweeps are.
    assert_true(price.needs_company);
    assert_string_equal(price.needs, "AF");
    price = dip_prices_step(prices, DIP_SETTING_AAA, DIP_AAA_ON, &pane);
    assert_string_equal(price.needs, "AA");
    price = dip_prices_step(prices, DIP_SETTING_TAA, 1, &pane);
    assert_string_equal(price.needs, "AA");
    price = dip_prices_step(prices, DIP_SETTING_ASD, 1, &pane);
    assert_string_equal(price.needs, "AA 4x");
    price = dip_prices_step(prices, DIP_SETTING_AAF, 0, &pane);
    assert_false(price.needs_company);
    const DipQuality idle = settings("aa=2,aaa=on,asd=2"); // One group: the same as without.
    price = dip_prices_step(prices, DIP_SETTING_AAA, DIP_AAA_ON, &idle);
    assert_string_equal(price.needs, "smaller groups");
}

static void gains_are_differences_of_flip(void **state) {
    (void)state;
    const int clean = add_row("af=8", 0, 2.0, 1.0, 0.0);
    for (int p = 0; p < report.options.places; p++) {
        report.rows[clean].viewpoints[p].regions[0].squared_lin = 0.0;
    }
    take_report();
    const DipQuality pane = settings("aa=4,asd=2,af=16");
    DipPrice price = dip_prices_step(prices, DIP_SETTING_AAF, 1, &pane);
    assert_true(price.has_flip && !price.flip_at_floor);
    check_near(price.flip, 0.35 - 0.4);
    price = dip_prices_step(prices, DIP_SETTING_AF, 3, &pane);
    assert_true(price.has_flip && price.flip_at_floor);
    price = dip_prices_step(prices, DIP_SETTING_AF, 0, &pane);
    assert_true(price.has_flip);
    check_near(price.flip, dip_cost_row_metrics(&report, 0).flip);
}

static void other_paths_are_named(void **state) {
    (void)state;
    take_report();
    const DipQuality pane = dip_quality_default();
    DipPrice price = dip_prices_step(prices, DIP_SETTING_MIPLOD, DIP_MIPLOD_QUALITY, &pane);
    check_price(&price, 0.75, 2.0);
    assert_string_equal(price.path, "AA");
    price = dip_prices_step(prices, DIP_SETTING_MIPLOD, DIP_MIPLOD_HIGH_QUALITY, &pane);
    assert_int_equal(price.state, DIP_PRICE_BASE);
    assert_string_equal(price.path, "AA");
    check_near(price.ms, 2.0);
}

static double add_up(const DipPriceSum *sum) {
    double ms = sum->base_ms;
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        ms += sum->parts_ms[s];
    }
    return ms + sum->together_ms;
}

static void a_measured_sum_is_its_parts_and_what_they_miss(void **state) {
    (void)state;
    add_row("aa=4,opt=standard", 0, 4.2, 1.0, 0.3);
    take_report();
    const DipQuality quality = settings("aa=4,aaa=on,asd=2,af=16");
    const DipPriceSum sum = dip_prices_sum(prices, &quality);
    assert_int_equal(sum.state, DIP_PRICE_MEASURED);
    check_near(sum.ms, 8.2);
    check_near(sum.base_ms, 1.0);
    check_near(sum.parts_ms[DIP_SETTING_AA], 3.0);
    check_near(sum.parts_ms[DIP_SETTING_AAA], 2.0);
    check_near(sum.parts_ms[DIP_SETTING_ASD], 0.0);
    check_near(sum.parts_ms[DIP_SETTING_AF], 2.2);
    check_near(sum.together_ms, 0.0);
    const DipQuality compressed = settings("aa=4,opt=standard");
    check_near(dip_prices_sum(prices, &compressed).together_ms, 4.2 - 4.001);
    assert_true(add_up(&sum) == sum.ms);
    assert_true(sum.ms_low < 8.2 && sum.ms_high > 8.2);
    assert_true(sum.has_flip);
    check_near(sum.flip, 0.25);
}

// Settings that have no effect do not make another combination.
static void settings_without_effect_do_not_count(void **state) {
    (void)state;
    take_report();
    const DipQuality quality = settings("aa=4,asd=2,aaf=on,mipdebug=on");
    const DipPriceSum sum = dip_prices_sum(prices, &quality);
    assert_int_equal(sum.state, DIP_PRICE_MEASURED);
    check_near(sum.ms, 4.0);
    check_near(sum.together_ms, 0.0);
}

static void a_sum_that_was_not_measured_adds_the_parts(void **state) {
    (void)state;
    take_report();
    // Path 0 has everything but mip detail, whose part comes from path 1.
    DipQuality quality = settings("aa=4,aaa=on,asd=2,af=16,miplod=quality");
    DipPriceSum sum = dip_prices_sum(prices, &quality);
    assert_int_equal(sum.state, DIP_PRICE_ROUGH);
    check_near(sum.ms, 8.2 - 0.5);
    check_near(sum.together_ms, 0.0);
    assert_true(add_up(&sum) == sum.ms);
    // The interval of a time has the error of the level, too: .001 in quadrature, and the quantile
    // of Student's t for four times the level's 2 degrees of freedom.
    const double of_time = 8.2 * (exp(2.306004 * sqrt(2.0) * 0.001) - 1.0);
    check_near(sum.ms_high - sum.ms, hypot(of_time, 1.5 * (exp(half_width) - 1.0)));
    quality = settings("aa=2,af=16"); // Not measured together.
    sum = dip_prices_sum(prices, &quality);
    assert_int_equal(sum.state, DIP_PRICE_ROUGH);
    check_near(sum.ms, 1.0 + 2.0 + 1.5);
    check_near(sum.together_ms, 0.0);
    quality = settings("aa=2,af=16,aaf=on"); // Advanced AF was measured without AA only.
    sum = dip_prices_sum(prices, &quality);
    check_near(sum.ms, 1.0 + 2.0 + 1.5 + 0.25);
    quality = settings("aa=8,af=16"); // The part of aa=8 is not known.
    sum = dip_prices_sum(prices, &quality);
    assert_int_equal(sum.state, DIP_PRICE_UNKNOWN);
    check_near(sum.ms, 2.5);
}

static void a_predicted_sum_has_the_predictions_miss(void **state) {
    (void)state;
    report.predicted.list[1] =
        (DipCostPrediction){.quality = settings("aa=6,af=4"), .ms = 4.5, .flip = 0.2, .row = -1};
    report.predicted.times_left_out = (DipCostMisses){.p90 = 0.04, .rows = 16};
    take_report();
    const DipQuality quality = settings("aa=6,af=4");
    const DipPriceSum sum = dip_prices_sum(prices, &quality);
    assert_int_equal(sum.state, DIP_PRICE_PREDICTED);
    check_near(sum.ms, 4.5);
    // Of a normal distribution, 90 % lie within 1.6449 standard deviations. 2.119905 is the
    // quantile of Student's t for 16 misses (tables).
    check_near(sum.ms_high, 4.5 * exp(2.119905 / 1.6449 * log(1.04)));
    check_near(sum.ms_low, 4.5 * exp(-2.119905 / 1.6449 * log(1.04)));
    check_near(sum.flip, 0.2);
}

static void pictures_that_are_the_same_have_one_price(void **state) {
    (void)state;
    report.same = calloc(1, sizeof *report.same);
    assert_non_null(report.same);
    report.same[0] = (DipCostSame){settings("aa=2,aaa=on"), 2};
    report.same_count = 1;
    take_report();
    const DipQuality quality = settings("aa=2,aaa=on");
    const DipPrice price = dip_prices_step(prices, DIP_SETTING_AAA, DIP_AAA_ON, &quality);
    assert_int_equal(price.state, DIP_PRICE_MEASURED);
    assert_true(price.ms == 0.0 && price.ms_low == 0.0 && price.ms_high == 0.0);
    assert_true(dip_price_trust(&price) == DIP_PRICE_TRUST_ZERO);
    assert_int_equal(dip_prices_sum(prices, &quality).state, DIP_PRICE_MEASURED);
}

static void a_report_without_truth_or_times_has_the_other(void **state) {
    (void)state;
    for (int r = 0; r < report.row_count; r++) {
        memset(report.rows[r].judged, 0, (size_t)report.options.places);
    }
    take_report();
    const DipQuality pane = settings("aa=4");
    DipPrice price = dip_prices_step(prices, DIP_SETTING_AA, 2, &pane);
    assert_int_equal(price.state, DIP_PRICE_MEASURED);
    assert_false(price.has_flip || dip_prices_sum(prices, &pane).has_flip);
    dip_cost_report_free(&report);
    dip_prices_destroy(&prices);
    dip_made_report(&report, 0);
    take_report();
    price = dip_prices_step(prices, DIP_SETTING_AA, 2, &pane);
    assert_int_equal(price.state, DIP_PRICE_UNKNOWN);
    assert_true(price.has_flip);
    assert_int_equal(dip_prices_sum(prices, &pane).state, DIP_PRICE_UNKNOWN);
    assert_true(dip_prices_sum(prices, &pane).has_flip);
}

// --- the source ----------------------------------------------------------------------------------

static char text[512];

static void the_source_names_what_differs(void **state) {
    (void)state;
    take_report();
    assert_false(dip_prices_source(prices, 64, 48, text, sizeof text));
    assert_string_equal(text, "Prices: report of this scene, path DEFAULT, 64x48, 2 threads.");
    assert_true(dip_prices_source(prices, 320, 240, text, sizeof text));
    assert_string_equal(text, "Prices: report of this scene, path DEFAULT, 64x48, 2 threads. "
                              "The panes are 320x240.");
    dip_prices_set_conditions(prices, &(DipPriceConditions){"made up", "none", "scalar", 2});
    assert_false(dip_prices_source(prices, 64, 48, text, sizeof text));
    assert_false(dip_prices_are_of_other_scene(prices));
    dip_prices_set_conditions(prices, &(DipPriceConditions){"square.obj", "fast", "avx2", 1});
    assert_true(dip_prices_are_of_other_scene(prices));
    assert_true(dip_prices_source(prices, 64, 48, text, sizeof text));
    assert_string_equal(text, "Prices: report of made up, path DEFAULT, 64x48, 2 threads. "
                              "The panes show square.obj. The panes have 1 thread. "
                              "The report is from another machine.");
    dip_prices_set_conditions(prices, &(DipPriceConditions){.isa = "avx2"});
    assert_true(dip_prices_source(prices, 64, 48, text, sizeof text));
    assert_true(dip_prices_source(prices, 64, 48, text, 12)); // Cut, not overrun.
    assert_string_equal(text, "Prices: rep");
}

// The panes' FLIP is for the viewing distance of the report, unless the user wants another one.
static void live_and_report_flip_share_pixels_per_degree(void **state) {
    (void)state;
    prices = dip_prices_create(NULL);
    assert_true(dip_prices_viewing(prices) == DIP_FLIP_PIXELS_PER_DEGREE);
    report.options.pixels_per_degree = 37.9;
    assert_true(dip_cost_estimate_times(&report, NULL));
    assert_true(dip_prices_set_report(prices, &report, NULL));
    assert_true(dip_prices_viewing(prices) == 37.9);
    assert_false(dip_prices_source(prices, 64, 48, text, sizeof text));
    dip_prices_set_viewing(prices, 94.2);
    assert_true(dip_prices_viewing(prices) == 94.2);
    assert_true(dip_prices_source(prices, 64, 48, text, sizeof text));
    assert_string_equal(text,
                        "Prices: report of this scene, path DEFAULT, 64x48, 2 threads. FLIP of "
                        "the panes is for 94.2 pixels per degree, that of the report for 37.9.");
}

static void prices_of_a_busy_machine_are_marked(void **state) {
    (void)state;
    assert_true(dip_cost_estimate_times(&report, NULL));
    report.verdict = DIP_COST_RED;
    prices = dip_prices_create(NULL);
    assert_true(dip_prices_set_report(prices, &report, NULL));
    const DipQuality pane = settings("aa=4");
    assert_true(dip_prices_step(prices, DIP_SETTING_AA, 2, &pane).doubtful);
    assert_true(dip_prices_sum(prices, &pane).doubtful);
    const DipPrice price = dip_prices_step(prices, DIP_SETTING_AA, 2, &pane);
    assert_int_equal(dip_price_trust(&price), DIP_PRICE_TRUST_DOUBTFUL);
    dip_prices_source(prices, 64, 48, text, sizeof text);
    assert_non_null(strstr(text, "The machine was too busy"));
}

// --- live prices ---------------------------------------------------------------------------------

static void live_prices_are_differences_of_whole_times(void **state) {
    (void)state;
    const DipQuality pane = settings("aa=4,aaa=on,af=8");
    prices = dip_prices_create(NULL);
    assert_true(dip_prices_are_rough(prices));
    assert_int_equal(dip_prices_step(prices, DIP_SETTING_AA, 2, &pane).state, DIP_PRICE_UNKNOWN);
    assert_int_equal(dip_prices_sum(prices, &pane).state, DIP_PRICE_UNKNOWN);
    assert_false(dip_prices_source(prices, 64, 48, text, sizeof text));
    assert_non_null(strstr(text, "not measured yet"));
    dip_made_live(prices, "aa=none", 5.0, 0.001, 0.05);
    dip_made_live(prices, "aa=4", 7.0, 0.01, -1.0);
    dip_made_live(prices, "aa=4,aaa=on", 7.02, 0.03, -1.0);
    dip_made_live(prices, "af=8", 6.0, 0.01, 0.04);
    assert_false(dip_prices_source(prices, 64, 48, text, sizeof text));
    assert_non_null(strstr(text, "measured here"));
    DipPrice price = dip_prices_step(prices, DIP_SETTING_AA, 2, &pane);
    assert_int_equal(price.state, DIP_PRICE_ROUGH);
    check_near(price.ms, 2.0);
    assert_true(price.ms_low < 1.95 && price.ms_low > 1.6 && price.ms_high > 2.05);
    assert_string_equal(price.path, "");
    assert_false(price.has_flip || dip_price_trust(&price) == DIP_PRICE_TRUST_ZERO);
    price = dip_prices_step(prices, DIP_SETTING_AAA, DIP_AAA_ON, &pane);
    check_near(price.ms, 0.02);
    assert_true(price.ms_low < 0.0 && dip_price_trust(&price) == DIP_PRICE_TRUST_ZERO);
    price = dip_prices_step(prices, DIP_SETTING_AF, 3, &pane);
    assert_true(price.has_flip);
    check_near(price.flip, -0.01);
    assert_int_equal(dip_prices_step(prices, DIP_SETTING_AF, 0, &pane).state, DIP_PRICE_BASE);
    DipPriceSum sum = dip_prices_sum(prices, &pane);
    assert_int_equal(sum.state, DIP_PRICE_ROUGH);
    check_near(sum.ms, 5.0 + 2.0 + 0.02 + 1.0);
    dip_made_live(prices, "aa=2", 5.1, 0.5, -1.0); // A busy machine: the interval says little.
    price = dip_prices_step(prices, DIP_SETTING_AA, 1, &pane);
    assert_true(price.ms_low < 0.0 && price.ms_high > 0.0 &&
                dip_price_trust(&price) == DIP_PRICE_TRUST_DOUBTFUL);
    dip_made_live(prices, "aa=4,aaa=on,af=8", 8.0, 0.01, -1.0); // Measured together.
    sum = dip_prices_sum(prices, &pane);
    check_near(sum.ms, 8.0);
    check_near(sum.parts_ms[DIP_SETTING_AF], 0.98); // Beside the antialiasing.
    check_near(sum.together_ms, 0.0);
    dip_made_live(prices, "opt=advanced", 4.5, 0.01, -1.0);
    dip_made_live(prices, "aa=4,opt=advanced", 6.3, 0.01, -1.0);
    const DipQuality optimised = settings("aa=4,opt=advanced");
    sum = dip_prices_sum(prices, &optimised);
    check_near(sum.together_ms, -0.2);
    assert_true(add_up(&sum) == sum.ms);
}

// A number that other programs have disturbed is never written as if it were sure.
static void doubtful_times_are_written_with_one_digit(void **state) {
    (void)state;
    static const struct {
        double ms, low, high, without_ms;
        DipPriceState state;
        const char *text;
        bool compares; // With others at a glance: it has a bar and is a part of sums.
    } cases[] = {
        {1.23, 1.1, 1.3, 5.0, DIP_PRICE_MEASURED, "+1.2", true},
        {1.23, 1.1, 1.3, 5.0, DIP_PRICE_ROUGH, "\u2248 +1.2", true},
        {1.23, 1.1, 1.3, 5.0, DIP_PRICE_PREDICTED, "~+1.2", true},
        {70.4, 10.0, 3864303.5, 12.0, DIP_PRICE_ROUGH, "+70?", false},
        {10.0, 2.0, 30.0, 12.0, DIP_PRICE_MEASURED, "+10?", false},
        {-2.6, -9.0, 4.0, 5.0, DIP_PRICE_ROUGH, "\u22123?", false},
        {7.5, -2.0, 17.0, 5.0, DIP_PRICE_MEASURED, "+8?", false},
        {0.34, 0.1, 0.6, 5.0, DIP_PRICE_ROUGH, "+0.3?", false},
        {0.2, -0.3, 0.7, 5.0, DIP_PRICE_ROUGH, "\u2248 0", false},
        {-0.02, -3.0, 3.0, 5.0, DIP_PRICE_ROUGH, "0?", false},
        {-0.01, -0.02, -0.005, 5.0, DIP_PRICE_MEASURED, "\u2248 0", false},
        {0.0, 0.0, 0.0, 5.0, DIP_PRICE_MEASURED, "\u2248 0", false},
        {8.0, 8.0, 8.0, 0.0, DIP_PRICE_BASE, "base", true},
        {0.0, 0.0, 0.0, 0.0, DIP_PRICE_UNKNOWN, "\u00b7 \u00b7 \u00b7", false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char written[DIP_STEP_NAME_BYTES];
        const DipPrice price = {.state = cases[i].state,
                                .ms = cases[i].ms,
                                .ms_low = cases[i].low,
                                .ms_high = cases[i].high,
                                .without_ms = cases[i].without_ms};
        dip_price_ms_text(&price, INFINITY, written);
        assert_string_equal(written, cases[i].text);
        assert_int_equal(dip_price_trust(&price) == DIP_PRICE_TRUST_KNOWN, cases[i].compares);
    }
    char tip[DIP_STEP_TEXT_BYTES];
    const DipPrice wild = {.state = DIP_PRICE_ROUGH,
                           .ms = 12.0,
                           .ms_high = 3864303.5,
                           .without_ms = 5.0,
                           .has_flip = true};
    dip_step_tip(DIP_SETTING_AA, 1, &wild, INFINITY, "", tip);
    assert_null(strstr(tip, "3864303"));
    assert_non_null(strstr(tip, "Its time cannot be told"));
    const DipPrice busy = {.state = DIP_PRICE_BASE, .ms = 50.16, .doubtful = true};
    dip_step_tip(DIP_SETTING_AA, 0, &busy, INFINITY, "", tip);
    assert_non_null(strstr(tip, "The base of all prices: 50? ms."));
    const DipPrice gain = {
        .state = DIP_PRICE_MEASURED, .ms = -1.5, .ms_low = -1.6, .ms_high = -1.4};
    dip_step_tip(DIP_SETTING_AA, 1, &gain, INFINITY, "", tip);
    assert_non_null(strstr(tip, "\u22121.50 ms (\u22121.60 to \u22121.40)"));
    dip_flip_text(-0.00001, true, tip);
    assert_string_equal(tip, ".0000"); // Not "-.0000".
    const DipPriceSum sum = {.state = DIP_PRICE_ROUGH, .ms = 12.0, .ms_high = 3864303.5};
    assert_int_equal(dip_price_sum_trust(&sum), DIP_PRICE_TRUST_DOUBTFUL);
}

// Rounding carries no time over the budget: more digits are written where one would.
static void no_time_is_rounded_across_the_budget(void **state) {
    (void)state;
    static const struct {
        double ms, budget_ms;
        bool doubtful;
        const char *written;
    } cases[] = {
        {14.9, 12.0, true, "15?"},
        {14.9, 16.7, true, "10?"},
        {14.9, 17.0, true, "10?"},
        {16.9, 16.7, true, "20?"},
        {15.4, 16.7, true, "15?"},
        {16.9, 16.95, true, "16.9?"},
        {16.66, 1000 / 60.0, false, "16.66"},
        {16.64, 16.0, false, "16.6"},
        {16.04, 16.0, false, "16.04"},
        {15.96, 16.0, false, "16.0"},
        {8.4, INFINITY, true, "8?"},
        {120.0, 95.0, true, "100?"},
        {96.0, 99.0, true, "96?"},
        {0.34, 0.3, true, "0.34?"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char shown[DIP_STEP_NAME_BYTES];
        dip_ms_text(cases[i].ms,
                    cases[i].doubtful ? DIP_PRICE_TRUST_DOUBTFUL : DIP_PRICE_TRUST_KNOWN,
                    cases[i].budget_ms, shown);
        assert_string_equal(shown, cases[i].written);
    }
    for (int i = 1; i < 4000; i++) { // Any time beside any budget.
        const double ms = 0.01 * i, budget_ms = 0.37 * (i % 100) + 1.0;
        for (int doubtful = 0; doubtful < 2; doubtful++) {
            char shown[DIP_STEP_NAME_BYTES];
            dip_ms_text(ms, doubtful ? DIP_PRICE_TRUST_DOUBTFUL : DIP_PRICE_TRUST_KNOWN, budget_ms,
                        shown);
            assert_int_equal(strtod(shown, NULL) > budget_ms, ms > budget_ms);
        }
    }
    // A step is priced beside what the budget leaves for it.
    char shown[DIP_STEP_NAME_BYTES];
    const DipPrice price = {
        .state = DIP_PRICE_MEASURED, .ms = 14.9, .ms_low = 6.0, .ms_high = 30.0, .without_ms = 5.0};
    dip_price_ms_text(&price, 16.7, shown);
    assert_string_equal(shown, "+15?");
    dip_price_ms_text(&price, 33.3, shown);
    assert_string_equal(shown, "+10?");
}

static void a_new_live_time_replaces_the_old_one(void **state) {
    (void)state;
    const DipQuality pane = settings("aa=4");
    prices = dip_prices_create(NULL);
    dip_made_live(prices, "aa=none", 5.0, 0.01, 0.05);
    dip_made_live(prices, "aa=4", 7.0, 0.01, 0.02);
    unsigned changes = dip_prices_changes(prices);
    dip_made_live(prices, "aa=4", 8.0, 0.01, -1.0); // The error stays.
    assert_true(dip_prices_changes(prices) > changes);
    const DipPrice price = dip_prices_step(prices, DIP_SETTING_AA, 2, &pane);
    check_near(price.ms, 3.0);
    check_near(price.flip, -0.03);
    dip_prices_forget_live(prices);
    assert_int_equal(dip_prices_step(prices, DIP_SETTING_AA, 2, &pane).state, DIP_PRICE_UNKNOWN);
}

static void live_prices_replace_a_report_on_demand(void **state) {
    (void)state;
    take_report();
    const DipQuality pane = settings("aa=4");
    dip_made_live(prices, "aa=none", 5.0, 0.01, -1.0);
    dip_made_live(prices, "aa=4", 7.0, 0.01, -1.0);
    assert_false(dip_prices_are_rough(prices));
    check_near(dip_prices_step(prices, DIP_SETTING_AA, 2, &pane).ms, 3.0);
    dip_prices_prefer_rough(prices, true);
    assert_true(dip_prices_are_rough(prices));
    check_near(dip_prices_step(prices, DIP_SETTING_AA, 2, &pane).ms, 2.0);
    assert_false(dip_prices_step(prices, DIP_SETTING_AA, 2, &pane).doubtful);
    assert_false(dip_prices_source(prices, 1, 1, text, sizeof text));
    assert_non_null(strstr(text, "rough"));
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
    const struct CMUnitTest tests[] = {
        TEST(a_price_is_what_a_step_adds_to_the_base),
        TEST(a_price_within_the_noise_is_zero),
        TEST(steps_that_need_others_are_priced_beside_them),
        TEST(filtering_is_priced_beside_antialiasing),
        TEST(steps_without_their_company_say_what_they_need),
        TEST(gains_are_differences_of_flip),
        TEST(other_paths_are_named),
        TEST(a_measured_sum_is_its_parts_and_what_they_miss),
        TEST(settings_without_effect_do_not_count),
        TEST(a_sum_that_was_not_measured_adds_the_parts),
        TEST(a_predicted_sum_has_the_predictions_miss),
        TEST(pictures_that_are_the_same_have_one_price),
        TEST(a_report_without_truth_or_times_has_the_other),
        TEST(the_source_names_what_differs),
        TEST(live_and_report_flip_share_pixels_per_degree),
        TEST(prices_of_a_busy_machine_are_marked),
        TEST(live_prices_are_differences_of_whole_times),
        TEST(doubtful_times_are_written_with_one_digit),
        TEST(no_time_is_rounded_across_the_budget),
        TEST(a_new_live_time_replaces_the_old_one),
        TEST(live_prices_replace_a_report_on_demand),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
