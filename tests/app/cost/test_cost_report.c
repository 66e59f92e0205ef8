// Tests of the cost report: metrics and times, the verdict, the fit of prices, and the choice among
// combinations.
#include "app/report/report.h"
#include "app/report/fit.h"
#include "app/report/analysis.h"
#include "app/report/verdict.h"
#include "tests/app/cost/made_report.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <math.h>

static uint32_t random_state = 1;

static double random_share(void) {
    random_state = random_state * 1664525u + 1013904223u;
    return (random_state >> 8) * 0x1p-24;
}

static void expect_near(double found, double expected, double tolerance) {
    const bool unknown = isnan(found) && isnan(expected);
    if (!(fabs(found - expected) <= tolerance) && found != expected && !unknown) {
        fail_msg("%.9g, expected %.9g", found, expected);
    }
}

// --- errors ------------------------------------------------------------------------------------

static void metrics_are_means(void **state) {
    (void)state;
    DipMetricSums sums = {0};
    sums.regions[0] = (DipMetricRegionSums){100.0, 4.0, 2500.0, 40.0, 80.0, 25.0};
    sums.bursts = 2.0;
    sums.squared_flicker = 0.5;
    DipMetricSums twice = sums;
    dip_metric_sums_add(&twice, &sums);
    for (int i = 0; i < 2; i++) { // the doubled sums have the same means
        const DipMetrics f = dip_metrics_of(i ? &twice : &sums, 0);
        expect_near(f.rmse_lin, 0.2, 1e-15);
        expect_near(f.psnr_db, 20.0 * log10(255.0 / 5.0), 1e-12);
        expect_near(f.ssim, 0.5, 1e-15);
        expect_near(f.flip, 0.25, 1e-15);
        expect_near(dip_flicker_metrics_of(i ? &twice : &sums).flicker, 0.5, 1e-15);
    }
    const DipMetrics none = dip_metrics_of(&sums, 1);
    assert_true(none.rmse_lin == 0.0 && isinf(none.psnr_db) && none.ssim == 1.0);
}

static void errors_below_three_noise_floors_are_marked(void **state) {
    (void)state;
    DipCostReport report;
    dip_made_report(&report, 2);
    for (int p = 0; p < 3; p++) {
        report.has_floor[p] = p == 0;
        report.rows[0].judged[p] = p == 0;
    }
    // The truth's halves differ by 0.02.
    report.floors[0].regions[0].squared_lin = 10.0 * 0.02 * 0.02;
    expect_near(dip_cost_floor_metrics(&report, 0).rmse_lin, 0.01, 1e-15);
    report.rows[0].viewpoints[0].regions[0].squared_lin = 10.0 * 0.0299 * 0.0299;
    assert_true(dip_cost_at_floor(&report, 0));
    report.rows[0].viewpoints[0].regions[0].squared_lin = 10.0 * 0.0301 * 0.0301;
    assert_false(dip_cost_at_floor(&report, 0));
    dip_cost_report_free(&report);
}

static void expect_order(const DipCostReport *report, const char *part) {
    char text[2 * DIP_COST_TEXT];
    assert_true(dip_cost_order_text(report, &report->sweeps[0], text, sizeof text));
    if (!strstr(text, part)) {
        fail_msg("\"%s\" is not in \"%s\"", part, text);
    }
}

// In the made report, FLIP falls and all counters rise from row to row.
static void steps_out_of_order_are_named(void **state) {
    (void)state;
    DipCostReport report;
    dip_made_report(&report, 2);
    expect_order(
        &report,
        "As theory says: FLIP falls from step to step, and the counter samples_shown rises.");
    double *counters = report.rows[3].counters;
    counters[DIP_COUNTER_samples_shown] = report.rows[2].counters[DIP_COUNTER_samples_shown];
    expect_order(&report, "As theory says"); // equal work does not contradict theory
    counters[DIP_COUNTER_samples_shown] -= 1.0;
    expect_order(&report, "at step \"4\", the counter samples_shown should rise but does not.");
    report.rows[2].viewpoints[0].regions[0].flip = 100.0;
    expect_order(&report, "at step \"2\", FLIP should fall but does not.");
    report.sweeps[0].setting = DIP_SETTING_OPT; // in theory, this setting's errors rise
    expect_order(&report, "at step \"off\", FLIP should rise but does not.");
    report.sweeps[0].setting = DIP_SETTING_TAA;
    expect_order(&report, "the error of the mean of two frames");
    report.options.burst = 1; // There are no two frames.
    char text[2 * DIP_COST_TEXT];
    assert_false(dip_cost_order_text(&report, &report.sweeps[0], text, sizeof text));
    report.options.burst = 2;
    report.sweeps[0].setting = DIP_SETTING_MIPDEBUG;
    assert_false(dip_cost_order_text(&report, &report.sweeps[0], text, sizeof text));
    dip_cost_report_free(&report);
}

// --- times -------------------------------------------------------------------------------------

enum { ROUNDS = 40 };

static DipEstimate ratio_of(const DipCostReport *report, int row, int base) {
    return dip_cost_ratio(report, row, base);
}

// The times of frames differ up to tenfold, and drift slows all rows down alike. Row 2 takes 1.5
// times as long as row 0, and row 3 three times as long.
static void drift_and_uneven_frames_do_not_change_ratios(void **state) {
    (void)state;
    DipCostReport report;
    dip_made_report(&report, ROUNDS);
    static const double factors[] = {1.0, 1.0, 1.5, 3.0};
    const int frames = dip_cost_frame_count(&report);
    for (int r = 0; r < 4; r++) {
        for (int f = 0; f < frames; f++) {
            const double base = (1.0 + 9.0 * f / frames) * (1.0 + f % ROUNDS / 20.0);
            const double ms = factors[r] * base * (1.0 + 0.05 * random_share());
            dip_made_frame(&report, r, f, ms, base * (1.0 + 0.05 * random_share()));
        }
    }
    dip_made_timed(&report, 2, 7)->ms *= 20.0; // another program ran
    assert_true(dip_cost_estimate_times(&report, NULL));
    const DipEstimate ratio = ratio_of(&report, 2, 0);
    expect_near(ratio.value, 1.5, 0.015);
    assert_true(ratio.low <= 1.5 + 0.01 && ratio.high >= 1.5 - 0.01);
    assert_true(ratio.high - ratio.low < 0.05);
    const DipEstimate same = ratio_of(&report, 1, 0);
    assert_true(same.low <= 1.0 && same.high >= 1.0);
    // Rows 2 and 3 were never timed side by side, but both beside the baseline.
    const DipEstimate other = ratio_of(&report, 3, 2);
    expect_near(other.value, 2.0, 0.03);
    assert_true(other.low <= 2.0 && other.high >= 2.0 && other.high - other.low < 0.1);
    dip_cost_report_free(&report);
}

// A row's time in milliseconds is its ratio times the baseline's usual time.
static void milliseconds_are_those_of_the_level(void **state) {
    (void)state;
    DipCostReport report;
    dip_made_report(&report, 5);
    const int frames = dip_cost_frame_count(&report);
    for (int r = 0; r < 4; r++) {
        for (int f = 0; f < frames; f++) {
            // Row 2 was timed while the machine was ten times as slow.
            const double slow = r == 2 ? 10.0 : 1.0;
            dip_made_frame(&report, r, f, slow * 2.0 * (1.0 + f), slow * (1.0 + f));
        }
    }
    assert_true(dip_cost_estimate_times(&report, NULL));
    const double mean = (1.0 + frames) / 2.0;
    expect_near(dip_cost_ms(&report, 2), 2.0 * mean, 1e-9);
    expect_near(ratio_of(&report, 2, 3).value, 1.0, 1e-9); // timed at different speeds
    expect_near(report.rows[2].time.worst_ms.value, 2.0 * frames, 1e-9);
    const DipCandidate worst = dip_candidate_of_row(&report, 2, DIP_TIME_WORST);
    expect_near(worst.time.value, 2.0 * frames, 1e-9);
    dip_cost_report_free(&report);
}

// A red machine has wrong times, whatever the intervals say.
static void the_verdict_has_both_sides_of_each_limit(void **state) {
    (void)state;
    char reason[DIP_COST_REASON];
    const DipCostSigns quiet = {.wait = 0.03, .spread = 0.03, .offset = 0.01, .settled = true};
    assert_int_equal(dip_cost_verdict_of(&quiet, reason), DIP_COST_GREEN);
    static const struct {
        size_t sign;
        const DipCostLimits *limits;
        const char *word;
    } rows[] = {
        {offsetof(DipCostSigns, wait), &dip_cost_wait_limits, "waited"},
        {offsetof(DipCostSigns, spread), &dip_cost_spread_limits, "from round to round"},
        {offsetof(DipCostSigns, offset), &dip_cost_offset_limits, "as if it were two"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        DipCostSigns signs = quiet;
        double *sign = (double *)((char *)&signs + rows[i].sign);
        *sign = rows[i].limits->green;
        assert_int_equal(dip_cost_verdict_of(&signs, reason), DIP_COST_GREEN);
        *sign = rows[i].limits->green + 1e-6;
        assert_int_equal(dip_cost_verdict_of(&signs, reason), DIP_COST_AMBER);
        assert_non_null(strstr(reason, rows[i].word));
        *sign = rows[i].limits->red + 1e-6;
        assert_int_equal(dip_cost_verdict_of(&signs, reason), DIP_COST_RED);
        assert_non_null(strstr(reason, rows[i].word));
    }
    DipCostSigns signs = quiet;
    signs.disturbed = 0.26;
    assert_int_equal(dip_cost_verdict_of(&signs, reason), DIP_COST_RED);
    signs = quiet;
    signs.settled = false;
    assert_int_equal(dip_cost_verdict_of(&signs, reason), DIP_COST_AMBER);
}

// One frame in a hundred that waited is left out, and the report stays green.
static void a_few_frames_that_waited_are_left_out(void **state) {
    (void)state;
    DipCostReport report;
    dip_made_report(&report, ROUNDS);
    for (int f = 0; f < dip_cost_frame_count(&report); f += 100) {
        dip_made_timed(&report, 2, f)->ms *= 50.0;
        dip_made_timed(&report, 2, f)->wait = 0.9;
    }
    assert_true(dip_cost_estimate_times(&report, NULL));
    expect_near(ratio_of(&report, 2, 0).value, 3.0, 1e-9);
    assert_int_equal(report.verdict, DIP_COST_GREEN);
    dip_cost_report_free(&report);
}

// Times are computed from work counters and prices, with 1 % of noise, for settings whose pixels
// lie differently far apart on surfaces. The fit finds the prices again.
static void the_fit_finds_the_prices(void **state) {
    (void)state;
    enum { ROWS = 60 };
    DipCostReport report = {.row_count = ROWS, .rounds = 1, .path_count = 1};
    report.options = (DipCostOptions){.places = 1, .rounds = 2, .timed_frames = 1};
    report.rows = calloc(ROWS, sizeof *report.rows);
    assert_true(dip_cost_report_alloc(&report, NULL));
    for (int r = 0; r < ROWS; r++) {
        DipCostRow *row = &report.rows[r];
        row->quality = dip_quality_default();
        static const struct {
            const char *settings;
            double apart;
        } ways[] = {{"scale=1", 1.0},
                    {"scale=1/2", 2.0},
                    {"taa=history,miplod=sharper", 4.0},
                    {"scale=1/2,miplod=performance", 1.0},
                    {"scale=2", 0.5}};
        assert_true(dip_quality_parse(ways[r % 5].settings, &row->quality, NULL));
        for (int c = 0; c < DIP_COUNTER_COUNT; c++) {
            row->counters[c] = 1e6 * random_share();
        }
        // A texel takes 3 ns, and 2 ns times the distance of pixels.
        const double ns =
            5e5 + 20.0 * row->counters[DIP_COUNTER_fragments_shaded] +
            (3.0 + 2.0 * ways[r % 5].apart) * row->counters[DIP_COUNTER_texels_fetched];
        row->stage_ms[DIP_COST_STAGE_shading] = 1e-6 * ns * (0.99 + 0.02 * random_share());
    }
    const DipCostFit fit = dip_cost_fit(&report);
    assert_true(fit.r2 > 0.99 && fit.median_miss < 0.01);
    assert_true(fit.others.rows == ROWS && fit.others.within_10 == 1.0);
    assert_true(fit.others.median > fit.median_miss && fit.others.median < 0.01);
    for (int i = 0; i < fit.count; i++) {
        if (strcmp(fit.names[i], "fragment shaded") == 0) {
            expect_near(fit.ns[i], 20.0, 1.0);
        } else if (strcmp(fit.names[i], "texel fetched") == 0) {
            expect_near(fit.ns[i], 3.0, 0.6);
        } else if (strcmp(fit.names[i], "texel fetched, times the distance of pixels") == 0) {
            expect_near(fit.ns[i], 2.0, 0.4);
        }
        assert_true(fit.ns[i] >= 0.0);
    }
    dip_cost_report_free(&report);
}

static void set_flip(DipCostReport *report, int row, int viewpoint, double flip) {
    report->rows[row].judged[viewpoint] = true;
    report->rows[row].viewpoints[viewpoint] = (DipMetricSums){.bursts = 1.0};
    report->rows[row].viewpoints[viewpoint].regions[0].pixels = 10.0;
    report->rows[row].viewpoints[viewpoint].regions[0].flip = 10.0 * flip;
}

// FLIP of .1, .2 and .3 has the mean .2 and the standard deviation .1; t with 2 degrees of freedom
// is 4.303 (published tables). A second row is better by .01 everywhere: the change has no spread.
static void flip_has_an_interval_over_viewpoints(void **state) {
    (void)state;
    DipCostReport report;
    dip_made_report(&report, 2);
    for (int p = 0; p < 3; p++) {
        set_flip(&report, 0, p, 0.1 + 0.1 * p);
        set_flip(&report, 2, p, 0.09 + 0.1 * p);
    }
    const DipEstimate flip = dip_cost_metric(&report, 0, DIP_COST_FLIP);
    const DipEstimate change = dip_cost_metric_change(&report, 2, 0, DIP_COST_FLIP);
    expect_near(flip.value, 0.2, 1e-12);
    expect_near(flip.high - flip.value, 4.303 * 0.1 / sqrt(3.0), 1e-4);
    expect_near(change.value, -0.01, 1e-12);
    assert_true(!(change.high - change.low > 1e-8)); // Not known, but for what is rounded.
    report.rows[2].judged[0] = false;
    report.rows[2].judged[1] = false;
    assert_true(isnan(dip_cost_metric_change(&report, 2, 0, DIP_COST_FLIP).low)); // One viewpoint.
    dip_cost_report_free(&report);
}

// Below the noise of the truth, the faster of two rows is as good as the better one.
static void rows_below_the_floor_rank_alike(void **state) {
    (void)state;
    DipCostReport report;
    dip_made_report(&report, 2);
    report.combined_first = 2;
    for (int p = 0; p < 3; p++) {
        set_flip(&report, 2, p, 0.020);
        set_flip(&report, 3, p, 0.010);
        report.has_floor[p] = false;
    }
    report.rows[4].judged[0] = report.rows[4].judged[2] = false;
    report.options.budgets_ms[0] = 100.0;
    assert_true(dip_cost_choose(&report, NULL));
    assert_int_equal(dip_cost_chosen(&report, 0)->row, 3);
    report.has_floor[0] = true;
    report.floors[0] = (DipMetricSums){0};
    report.floors[0].regions[0].pixels = 1.0;
    report.floors[0].regions[0].flip = 0.05;
    expect_near(dip_cost_floor_flip(&report, 0), 0.05 * pow(0.5, 0.7), 1e-12);
    expect_near(dip_cost_ranking_flip(&report, 3), 0.05 * pow(0.5, 0.7), 1e-12);
    assert_true(dip_cost_choose(&report, NULL));
    assert_int_equal(dip_cost_chosen(&report, 0)->row, 2);
    dip_cost_report_free(&report);
}

// Of combinations with the same pictures, only the one with the fewest settings off their defaults
// can be chosen, even if another one seems faster. In this scene, nothing casts a small shadow.
static void settings_without_effect_are_not_chosen(void **state) {
    (void)state;
    static const struct {
        const char *settings, *pictures;
        double ms, flip;
    } rows[] = {{"shadows=512", "plain", 0.9, 0.05},
                {"aa=none", "plain", 1.0, 0.05},
                {"aa=4", "smooth", 2.0, 0.03},
                {"aa=4,shadows=512", "smooth", 1.9, 0.03},
                {"aa=4,shadows=2048", "shady", 3.0, 0.01}};
    DipCostReport report;
    dip_made_report(&report, 16);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        DipQuality quality;
        assert_true(dip_quality_parse(rows[i].settings, &quality, NULL));
        const int row = dip_made_combination(&report, &quality, rows[i].ms, rows[i].flip);
        for (int p = 0; p < report.options.places; p++) {
            snprintf(report.rows[row].pictures[p], 33, "%s", rows[i].pictures);
        }
    }
    assert_true(dip_cost_estimate_times(&report, NULL));
    assert_true(dip_cost_choose(&report, NULL));
    const DipCostChoice *choice = &report.choice;
    assert_int_equal(choice->candidates.count, 3);
    assert_int_equal(choice->front_count, 3);
    for (int i = 0; i < 3; i++) {
        static const char *const front[] = {"aa=none", "aa=4", "aa=4,shadows=2048"};
        DipQuality quality;
        assert_true(dip_quality_parse(front[i], &quality, NULL));
        assert_true(
            dip_quality_equal(&choice->candidates.list[choice->front[i]].quality, &quality));
    }
    dip_cost_report_free(&report);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(metrics_are_means),
        cmocka_unit_test(errors_below_three_noise_floors_are_marked),
        cmocka_unit_test(steps_out_of_order_are_named),
        cmocka_unit_test(drift_and_uneven_frames_do_not_change_ratios),
        cmocka_unit_test(milliseconds_are_those_of_the_level),
        cmocka_unit_test(the_verdict_has_both_sides_of_each_limit),
        cmocka_unit_test(a_few_frames_that_waited_are_left_out),
        cmocka_unit_test(the_fit_finds_the_prices),
        cmocka_unit_test(flip_has_an_interval_over_viewpoints),
        cmocka_unit_test(rows_below_the_floor_rank_alike),
        cmocka_unit_test(settings_without_effect_are_not_chosen),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
