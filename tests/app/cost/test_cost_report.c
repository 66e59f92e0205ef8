// Tests of the cost report: metrics and times, the Pareto front, the fit of prices, and a report
// written to JSON and read back.
#include "app/report/report.h"
#include "app/report/fit.h"
#include "app/report/page/html.h"
#include "app/report/analysis.h"
#include "app/report/format/formats.h"
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

static const char *const file = "test_cost_report.json";

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

// --- files -------------------------------------------------------------------------------------

// Compares arrays of numbers. The JSON library may round the last bit.
static void check_values(const void *a, const void *b, size_t size) {
    const double *x = a;
    const double *y = b;
    for (size_t i = 0; i < size / sizeof(double); i++) {
        expect_near(x[i], y[i], 4e-16 * fabs(y[i]));
    }
}

static void check_same_warnings(const DipCostReport *a, const DipCostReport *b) {
    assert_int_equal(a->warning_count, b->warning_count);
    assert_int_equal(a->warnings_left_out, b->warnings_left_out);
    for (int i = 0; i < a->warning_count; i++) {
        assert_string_equal(a->warnings[i].file, b->warnings[i].file);
        assert_int_equal(a->warnings[i].line, b->warnings[i].line);
        assert_string_equal(a->warnings[i].key, b->warnings[i].key);
        assert_string_equal(a->warnings[i].message, b->warnings[i].message);
    }
}

static void check_same(const DipCostReport *a, const DipCostReport *b) {
    check_same_warnings(a, b);
    assert_string_equal(a->scene, b->scene);
    assert_string_equal(a->scene_hash, b->scene_hash);
    assert_string_equal(a->date, b->date);
    assert_int_equal(a->rounds, b->rounds);
    assert_int_equal(a->combined_first, b->combined_first);
    assert_string_equal(a->paths[1], b->paths[1]);
    assert_string_equal(a->refused[0], b->refused[0]);
    assert_int_equal(a->row_count, b->row_count);
    for (int r = 0; r < a->row_count; r++) {
        const DipCostRow *x = &a->rows[r];
        const DipCostRow *y = &b->rows[r];
        assert_memory_equal(&x->quality, &y->quality, sizeof x->quality);
        assert_int_equal(x->path, y->path);
        assert_memory_equal(x->judged, y->judged, 3 * sizeof(bool));
        check_values(x->tails, y->tails, 3 * sizeof *x->tails);
        check_values(x->viewpoints, y->viewpoints, 3 * sizeof *x->viewpoints);
        check_values(&x->time.ratio, &y->time.ratio, sizeof x->time.ratio);
        check_values(&x->time.p95_ms, &y->time.p95_ms, sizeof x->time.p95_ms);
        check_values(x->counters, y->counters, sizeof x->counters);
    }
    check_values(a->floors, b->floors, 6 * sizeof *a->floors);
    assert_memory_equal(a->sweeps[0].rows, b->sweeps[0].rows, sizeof a->sweeps[0].rows);
    assert_int_equal(a->choice.candidates.count, b->choice.candidates.count);
    assert_int_equal(a->predicted.count, b->predicted.count);
    for (int i = 0; i < a->predicted.count; i++) {
        const DipCostPrediction *x = &a->predicted.list[i];
        const DipCostPrediction *y = &b->predicted.list[i];
        assert_memory_equal(&x->quality, &y->quality, sizeof x->quality);
        assert_true(x->ms == y->ms && x->p95_ms == y->p95_ms && x->flip == y->flip);
        assert_int_equal(x->row, y->row);
        assert_true(a->predicted.times.median == b->predicted.times.median);
        assert_true(a->predicted.times.within_10 == b->predicted.times.within_10);
        assert_true(a->predicted.errors_left_out.p90 == b->predicted.errors_left_out.p90);
    }
    assert_int_equal(a->smaller_count, b->smaller_count);
    assert_int_equal(a->smaller_width, b->smaller_width);
    assert_int_equal(a->smaller_height, b->smaller_height);
    for (int i = 0; i < a->smaller_count; i++) {
        const DipCostElsewhere *x = &a->smaller[i];
        const DipCostElsewhere *y = &b->smaller[i];
        assert_memory_equal(&x->quality, &y->quality, sizeof x->quality);
        check_values(&x->ms, &y->ms, 3 * sizeof(double)); // Value, low and high.
        check_values(x->counters, y->counters, sizeof x->counters);
        check_values(x->stage_ms, y->stage_ms, sizeof x->stage_ms);
    }
    assert_int_equal(a->choice.advice_count, b->choice.advice_count);
    for (int i = 0; i < a->choice.advice_count; i++) {
        assert_true(a->choice.advice[i].budget_ms == b->choice.advice[i].budget_ms);
        assert_int_equal(a->choice.advice[i].chosen, b->choice.advice[i].chosen);
    }
    assert_int_equal(a->verdict, b->verdict);
    assert_true(a->rounds == 0 || a->machine.wait == b->machine.wait);
}

static void json_keeps_everything(void **state) {
    (void)state;
    for (int rounds = 0; rounds < 5; rounds += 2) {
        DipCostReport report;
        DipCostReport read;
        DipError err = {0};
        dip_made_report(&report, rounds);
        assert_true(dip_cost_write_json(&report, file, &err));
        assert_true(dip_cost_read_json(&read, file, &err));
        check_same(&report, &read);
        dip_cost_report_free(&report);
        dip_cost_report_free(&read);
    }
    remove(file);
}

// A log of two starts, in which each frame of a path is timed in one round.
static void add_log(DipCostReport *report) {
    const int frames = dip_cost_frame_count(report), rounds = report->options.rounds / 2;
    DipTimed *list = calloc((size_t)(report->row_count * frames), sizeof *list);
    int rows[8], count = 0;
    assert_true(list && report->row_count <= 8);
    for (int r = 0; r < report->row_count; r++) {
        rows[r] = r;
        for (int f = 0; f < frames; f++) {
            const int round = (f + f / 3) % (2 * rounds);
            list[count++] = (DipTimed){.subject = r,
                                       .start = round / rounds,
                                       .round = round % rounds,
                                       .frame = f,
                                       .begin_ns = 1000000 * r,
                                       .ms = (1.0 + r) * (1.0 + 0.01 * random_share()),
                                       .wait = f == 1 ? NAN : 0.01};
        }
    }
    const DipTimes times = {list, count, report->row_count, 2, rounds, frames, NULL, false};
    dip_cost_log_clear(report);
    assert_true(dip_cost_log_add(report, &times, rows, NULL));
    free(list);
    assert_true(dip_cost_estimate_times(report, NULL));
}

static void json_keeps_the_log(void **state) {
    (void)state;
    DipCostReport report, read;
    dip_made_report(&report, 4);
    add_log(&report);
    assert_true(fabs(report.rows[3].time.ratio.value - 4.0) < 0.1);
    assert_true(report.rows[3].time.ratio.low < report.rows[3].time.ratio.high);
    assert_true(dip_cost_write_json(&report, file, NULL));
    assert_true(dip_cost_read_json(&read, file, NULL));
    assert_true(read.starts == 2 && read.log_count == report.log_count);
    int found = 0;
    for (int i = 0; i < read.log_count; i++) {
        const DipTimed *a = &report.log[i], *b = &read.log[i];
        found += a->subject == b->subject && a->start == b->start && a->round == b->round &&
                 a->block == b->block && a->frame == b->frame && a->begin_ns == b->begin_ns &&
                 fabs(a->ms - b->ms) <= 4e-16 * a->ms && (a->wait == b->wait || isnan(b->wait));
    }
    assert_int_equal(found, read.log_count);
    check_values(&report.rows[3].time.ratio, &read.rows[3].time.ratio, sizeof(DipEstimate));
    dip_cost_report_free(&report);
    dip_cost_report_free(&read);
    remove(file);
}

static char *read_whole(size_t *size) {
    FILE *in = fopen(file, "rb");
    assert_non_null(in);
    char *text = calloc(1, 1 << 20);
    *size = fread(text, 1, 1 << 20, in);
    fclose(in);
    return text;
}

static void write_whole(const char *text, size_t size) {
    FILE *out = fopen(file, "wb");
    assert_non_null(out);
    assert_int_equal(fwrite(text, 1, size, out), size);
    fclose(out);
}

// Reports of earlier versions have no date.
static void json_without_a_date_is_read(void **state) {
    (void)state;
    DipCostReport report;
    DipCostReport read;
    DipError err = {0};
    size_t size;
    dip_made_report(&report, 2);
    assert_true(dip_cost_write_json(&report, file, &err));
    char *text = read_whole(&size);
    char *format = strstr(text, "\"format\":3");
    assert_non_null(format);
    format[9] = '2';
    char *date = strstr(text, "\"date\":\"2026-01-31T23:59:58Z\",");
    assert_non_null(date);
    memmove(date, strchr(date, ',') + 1, strlen(strchr(date, ',')));
    write_whole(text, strlen(text));
    assert_true(dip_cost_read_json(&read, file, &err));
    assert_string_equal(read.date, "");
    dip_cost_report_free(&read);
    dip_cost_report_free(&report);
    free(text);
    remove(file);
}

// A file that is cut short anywhere, or that lacks a field, is refused, and the error names the
// file.
static void broken_json_is_refused(void **state) {
    (void)state;
    static const char *const fields[] = {
        "\"width\"",
        "\"rows\"",
        "\"sums\"",
        "\"begin_ms\"",
        "\"setting\"",
        "\"path\"",
        "\"baseline\"",
        "\"combinations\":[\n{\"settings\":\"aa=none,taa=off,aaa=off,"
        "asd=1,af=none,aaf=off,opt=off,miplod=high-quality,scale=1,upscale=bilinear,"
        "post=off,sharpen=off,shadows=off,gi=on,mipdebug=off\",\"ms\":0.5"};
    DipCostReport report;
    DipCostReport read;
    DipError err = {0};
    size_t size;
    dip_made_report(&report, 2);
    assert_true(dip_cost_write_json(&report, file, &err));
    dip_cost_report_free(&report);
    char *text = read_whole(&size);
    for (size_t cut = 0; cut < size; cut += size / 37) {
        write_whole(text, cut);
        assert_false(dip_cost_read_json(&read, file, &err));
        assert_string_equal(err.file, file);
    }
    for (size_t f = 0; f < sizeof fields / sizeof *fields; f++) {
        char *at = strstr(text, fields[f]);
        assert_non_null(at);
        at[1] ^= 1;
        write_whole(text, size);
        assert_false(dip_cost_read_json(&read, file, &err));
        at[1] ^= 1;
    }
    free(text);
    remove(file);
    assert_false(dip_cost_read_json(&read, "none.json", &err));
    assert_int_equal(err.code, DIP_ERROR_MISSING);
}

// Each line of the CSV has the same number of fields as the header. The HTML page has all its parts
// and refers to no other file.
static void csv_and_page_are_complete(void **state) {
    (void)state;
    DipCostReport report;
    DipError err = {0};
    size_t size;
    dip_made_report(&report, 2);
    strcpy(report.scene, "a \"b\", c");
    assert_true(dip_cost_write_csv(&report, file, &err));
    char *text = read_whole(&size);
    assert_non_null(strstr(text, ",\"a \"\"b\"\", c\",64,48,"));
    assert_non_null(strstr(text, ",version,date,verdict,warnings,"));
    assert_non_null(strstr(text, ",\"0\",\"2026-01-31T23:59:58Z\",\"green\",5,"));
    int lines = 0, commas = 0, first = 0;
    bool quoted = false;
    for (const char *c = text; *c; c++) {
        quoted = quoted != (*c == '"');
        commas += *c == ',' && !quoted;
        if (*c == '\n') {
            first = lines++ ? first : commas;
            assert_int_equal(commas, first);
            commas = 0;
        }
    }
    assert_int_equal(lines, 1 + 2 + 3 + 1); // One of two combinations was only predicted.
    assert_non_null(strstr(text, "\n\"predicted\",\"\",\"DEFAULT\",\"aa=4,"));
    assert_non_null(strstr(text, ",flip_tail_p50,flip_tail_p95,flip_tail_p99,flip_tail_worst,"));
    // aa=4 is row 3: the means of equal percentiles, and the worst block at the first viewpoint.
    assert_non_null(strstr(text, ",0.0025,0.025,0.05,0.075,0,1,32,16,32,32,"));
    free(text);
    assert_true(dip_cost_write_html(&report, NULL, file, &err));
    text = read_whole(&size);
    assert_non_null(strstr(text, "Antialiasing"));
    assert_non_null(strstr(text, "opt=standard"));
    assert_non_null(strstr(text, "</html>"));
    assert_null(strstr(text, "http://www.w3.org/1999"));
    for (const char *at = text; (at = strstr(at, "href=")) != NULL; at++) {
        assert_int_equal(strncmp(at, "href=\"#", 7), 0); // a link within the page
    }
    assert_null(strstr(text, " src=\"h"));
    assert_null(strstr(text, "@import"));
    assert_non_null(strstr(text, "2026-01-31T23:59:58Z"));
    assert_null(strstr(text, "nan"));
    free(text);
    remove(file);
    dip_cost_report_free(&report);
}

// Parts of a report have the same warnings, perhaps of files in other folders. Each is kept once.
// No number of warnings is too great: those that are not kept are counted.
static void warnings_are_added_once(void **state) {
    (void)state;
    static DipError many[DIP_COST_MAX_WARNINGS + 30];
    const int most = DIP_COST_MAX_WARNINGS, count = (int)(sizeof many / sizeof *many);
    DipError few[] = {{.file = "/a/b/m.gltf", .key = "k", .message = "one"},
                      {.file = "m.gltf", .line = 1, .key = "k", .message = "one"},
                      {.file = "m.gltf", .key = "l", .message = "one"},
                      {.file = "m.gltf", .key = "k", .message = "two"},
                      {.file = "n.gltf", .key = "k", .message = "one"}};
    DipCostReport report = {.rounds = 0};
    assert_true(dip_cost_report_add_warnings(&report, few, 0, NULL));
    assert_true(dip_cost_report_add_warnings(&report, few, 5, NULL));
    assert_int_equal(report.warning_count, 5);
    assert_string_equal(report.warnings[0].file, "m.gltf");
    strcpy(few[0].file, "/elsewhere/m.gltf");
    few[4].line = 9;
    assert_true(dip_cost_report_add_warnings(&report, few, 5, NULL));
    assert_int_equal(report.warning_count, 6);
    assert_int_equal(report.warnings[5].line, 9);
    for (int i = 0; i < count; i++) {
        snprintf(many[i].message, sizeof many[i].message, "%d", i);
    }
    assert_true(dip_cost_report_add_warnings(&report, many, count, NULL));
    assert_int_equal(report.warning_count, most);
    assert_int_equal(report.warnings_left_out, 6 + count - most);
    assert_string_equal(report.warnings[6].message, "0");
    dip_cost_report_free(&report);
}

// A page lists the warnings, and a terminal shows their number. Both escape them.
static void warnings_are_shown_escaped(void **state) {
    (void)state;
    DipCostReport report;
    size_t size;
    dip_made_report(&report, 2);
    strcpy(report.warnings[0].message, "</script><b>\x1b[31m'\"");
    assert_true(dip_cost_write_html(&report, NULL, file, NULL));
    char *text = read_whole(&size);
    assert_non_null(strstr(text, "<a href=\"#warnings\">"));
    assert_non_null(strstr(text, "<th scope=\"row\">made.gltf</th>"));
    assert_non_null(strstr(text, ">extensionsUsed</td><td class=\"l\">"
                                 "&lt;/script&gt;&lt;b&gt;?[31m&#39;&quot;</td>"));
    assert_non_null(strstr(text, "2 more warnings are left out."));
    free(text);
    FILE *out = fopen(file, "w");
    assert_non_null(out);
    dip_cost_print(&report, out);
    fclose(out);
    text = read_whole(&size);
    assert_non_null(strstr(text, "Warnings"));
    assert_non_null(strstr(text, "5 when the scene was loaded; cost.json and cost.html list them"));
    free(text);
    report.warning_count = report.warnings_left_out = 0;
    assert_true(dip_cost_write_html(&report, NULL, file, NULL));
    text = read_whole(&size);
    assert_null(strstr(text, "arnings"));
    free(text);
    remove(file);
    dip_cost_report_free(&report);
}

// The settings of a row are written whole, however long their text is.
static void long_settings_are_not_cut(void **state) {
    (void)state;
    static const char longest[] =
        "aa=8,taa=alternate,aaa=coverage,asd=2,af=16,aaf=on,opt=advanced,miplod=high-performance,"
        "scale=1/1.7,upscale=bicubic,post=fxaa,sharpen=medium,shadows=1024,gi=off,mipdebug=on";
    DipQuality quality;
    char text[DIP_COST_TEXT];
    assert_true(dip_quality_parse(longest, &quality, NULL));
    dip_cost_settings_text(&quality, text);
    assert_string_equal(text, longest);
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

// The tables, the titles and the bars of a report from a busy machine write no time and no ratio of
// times as if it were sure. Only the ratios of A/A, which say how wrong times are, keep their
// digits, and so does the base's ratio to itself.
static void doubtful_times_have_a_mark(void **state) {
    (void)state;
    enum { ROOM = 1 << 20 };
    static char text[2][ROOM];
    for (int busy = 0; busy < 2; busy++) {
        DipCostReport report;
        DipError err;
        dip_made_report(&report, 16);
        dip_made_times(&report, 1, 1.25);
        dip_made_times(&report, 3, 8.996);
        DipQuality both = dip_quality_default();
        both.step[DIP_SETTING_AA] = both.step[DIP_SETTING_AF] = 1;
        dip_made_combination(&report, &both, 7.125, 0.01);
        both.step[DIP_SETTING_AA] = 2;
        dip_made_combination(&report, &both, 7.875, 0.005);
        assert_true(dip_cost_estimate_times(&report, NULL));
        report.verdict = busy ? DIP_COST_RED : DIP_COST_GREEN;
        assert_true(dip_cost_choose(&report, NULL));
        FILE *out = fmemopen(text[0], ROOM - 1, "w");
        assert_non_null(out);
        dip_cost_print(&report, out);
        fclose(out);
        assert_true(dip_cost_write_html(&report, NULL, "doubtful_times.html", &err));
        FILE *in = fopen("doubtful_times.html", "rb");
        assert_non_null(in);
        text[1][fread(text[1], 1, ROOM - 1, in)] = '\0';
        fclose(in);
        remove("doubtful_times.html");
        assert_int_equal(strstr(text[0], " 9.00 ") != NULL, !busy);
        assert_int_equal(strstr(text[0], " 9? ") != NULL, busy);
        assert_int_equal(strstr(text[1], ">9.00</td>") != NULL, !busy);
        assert_int_equal(strstr(text[1], ">9?</td>") != NULL, busy);
        assert_non_null(strstr(text[1], busy ? ": 9? ms" : ": 9.00 ms")); // A row's title.
        assert_non_null(strstr(text[1], busy ? "of the path: 1? ms<" : "of the path: 1.00 ms<"));
        for (int page = 0; page < 2; page++) {
            assert_non_null(strstr(text[page], "1.250")); // A/A.
            assert_int_equal(strstr(text[page], "8.996") != NULL, !busy);
            assert_int_equal(strstr(text[page], "3.000") != NULL, !busy);
        }
        assert_int_equal(strstr(text[1], ">7.125</td>") != NULL, !busy);  // Only the page lists it.
        assert_int_equal(strstr(text[1], ">9.00</text>") != NULL, !busy); // A bar.
        assert_int_equal(strstr(text[1], ">9?</text>") != NULL, busy);
        assert_non_null(strstr(text[1], ">1.00</text>")); // The base's.
        assert_non_null(strstr(text[1], busy ? ">1?</td><td class=\"n\">1.000</td>"
                                             : ">1.00</td><td class=\"n\">1.000</td>"));
        dip_cost_report_free(&report);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(long_settings_are_not_cut),
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
        cmocka_unit_test(json_keeps_everything),
        cmocka_unit_test(json_keeps_the_log),
        cmocka_unit_test(json_without_a_date_is_read),
        cmocka_unit_test(broken_json_is_refused),
        cmocka_unit_test(csv_and_page_are_complete),
        cmocka_unit_test(warnings_are_added_once),
        cmocka_unit_test(warnings_are_shown_escaped),
        cmocka_unit_test(settings_without_effect_are_not_chosen),
        cmocka_unit_test(doubtful_times_have_a_mark),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
