// Tests of advice per segment of a path: times and errors of the segments against the formulas that
// made them, and choices against trying all.
#include "app/report/segments_output.h"
#include "tests/app/cost/made_report.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cjson/cJSON.h>
#include <cmocka.h>

#include <math.h>

enum { ROUNDS = 6, FRAMES = 24, VIEWPOINTS = 3, SEGMENTS = 3, COMBINATIONS = 6 };

static uint32_t random_state = 1;

static double random_share(void) {
    random_state = random_state * 1664525u + 1013904223u;
    return (random_state >> 8) * 0x1p-24;
}

static void expect_near(double found, double expected, double tolerance) {
    if (!(fabs(found - expected) <= tolerance)) {
        fail_msg("%.9g, expected %.9g", found, expected);
    }
}

// What the combinations cost in each third of the path.
typedef struct Truth {
    double ratio[COMBINATIONS][SEGMENTS];
    double flip[COMBINATIONS][SEGMENTS];
} Truth;

// The baseline's time of a frame, in ms.
static double level_of(int frame) {
    return 2.0 + 0.1 * frame;
}

static void set_baseline_times(DipCostReport *report) {
    for (int r = 0; r < report->row_count; r++) {
        for (int f = 0; f < FRAMES; f++) {
            report->rows[r].pairs[f].ms = level_of(f);
            report->rows[r].pairs[f].base_ms = level_of(f);
        }
    }
}

static void make_report(DipCostReport *report, const Truth *truth) {
    dip_made_report(report, ROUNDS);
    set_baseline_times(report);
    for (int c = 0; c < COMBINATIONS; c++) {
        DipQuality quality = dip_quality_default();
        quality.step[DIP_SETTING_AF] = (uint8_t)(c % 5);
        quality.step[DIP_SETTING_AA] = (uint8_t)(c / 5);
        const int row = dip_made_combination(report, &quality, 1.0, 0.5);
        for (int f = 0; f < FRAMES; f++) {
            report->rows[row].pairs[f].ms = level_of(f) * truth->ratio[c][f / 8];
            report->rows[row].pairs[f].base_ms = level_of(f);
        }
        for (int p = 0; p < VIEWPOINTS; p++) {
            DipMetricSums *sums = &report->rows[row].viewpoints[p];
            sums->regions[0].flip = truth->flip[c][p] * sums->regions[0].pixels;
        }
    }
    assert_true(dip_cost_estimate_times(report, NULL));
}

static Truth make_random(void) {
    Truth truth;
    for (int c = 0; c < COMBINATIONS; c++) {
        for (int s = 0; s < SEGMENTS; s++) {
            truth.ratio[c][s] = 1.0 + 3.0 * random_share();
            truth.flip[c][s] = (0.05 + 0.1 * random_share()) / truth.ratio[c][s];
        }
    }
    return truth;
}

// --- dividing ------------------------------------------------------------------------------------

static void segments_have_their_frames_and_viewpoints(void **state) {
    (void)state;
    const Truth truth = make_random();
    DipCostReport report;
    DipCostSegments segments;
    make_report(&report, &truth);
    report.options.budget_of = DIP_COST_BUDGET_MEAN;
    assert_int_equal(dip_cost_default_segments(&report), 3);
    assert_true(dip_cost_segments_make(&report, SEGMENTS, &segments, NULL));
    assert_true(segments.count == SEGMENTS && segments.row_count == COMBINATIONS);
    for (int s = 0; s < SEGMENTS; s++) {
        const DipCostSegment *segment = &segments.list[s];
        expect_near(segment->from, s / 3.0, 1e-12);
        assert_true(segment->first_frame == 8 * s && segment->end_frame == 8 * s + 8);
        assert_true(segment->first_viewpoint == s && segment->end_viewpoint == s + 1);
        // The mean level of frames 8 s to 8 s + 7.
        const double level = 2.0 + 0.1 * (8.0 * s + 3.5);
        for (int c = 0; c < COMBINATIONS; c++) {
            const DipCostSegmentValue *value = &segments.values[s * COMBINATIONS + c];
            const DipEstimate mean = report.rows[segments.rows[c]].time.mean_ms;
            expect_near(value->ms, level * truth.ratio[c][s], 1e-9);
            expect_near(value->bound / value->ms, mean.high / mean.value, 1e-12);
            expect_near(value->flip, truth.flip[c][s], 1e-12);
        }
    }
    dip_cost_segments_free(&segments);
    // Two segments of three viewpoints: one has a third of the path, the other the rest.
    assert_true(dip_cost_segments_make(&report, 2, &segments, NULL));
    assert_true(segments.list[0].end_viewpoint == 1 && segments.list[0].end_frame == 8);
    expect_near(segments.values[COMBINATIONS].flip, (truth.flip[0][1] + truth.flip[0][2]) / 2.0,
                1e-12);
    dip_cost_segments_free(&segments);
    DipError err = {0};
    assert_false(dip_cost_segments_make(&report, 4, &segments, &err));
    assert_int_equal(err.code, DIP_ERROR_RANGE);
    dip_cost_segments_free(&segments);
    for (int r = report.combined_first; r < report.row_count; r++) {
        report.rows[r].judged[1] = false;
    }
    assert_int_equal(dip_cost_default_segments(&report), 1);
    assert_false(dip_cost_segments_make(&report, 3, &segments, &err));
    assert_int_equal(err.code, DIP_ERROR_MISSING);
    dip_cost_segments_free(&segments);
    dip_cost_report_free(&report);
}

static void times_of_frames_have_the_mean_of_the_row(void **state) {
    (void)state;
    const Truth truth = make_random();
    DipCostReport report;
    double ms[2 * FRAMES];
    make_report(&report, &truth);
    const int first = report.combined_first;
    const int rows[2] = {first + 3, first};
    dip_cost_frame_times(&report, rows, 2, ms);
    for (int i = 0; i < 2; i++) {
        double sum = 0.0;
        for (int f = 0; f < FRAMES; f++) {
            expect_near(ms[i * FRAMES + f], level_of(f) * truth.ratio[rows[i] - first][f / 8],
                        1e-9);
            sum += ms[i * FRAMES + f];
        }
        expect_near(sum / FRAMES, dip_cost_ms(&report, rows[i]), 1e-9);
    }
    dip_cost_report_free(&report);
}

// --- choosing ------------------------------------------------------------------------------------

static const DipCostSegmentValue *value_of(const DipCostSegments *segments, int s, int c) {
    return &segments->values[s * COMBINATIONS + c];
}

// The least mean FLIP of all choices whose mean bound is within the budget.
static double try_all(const DipCostSegments *segments, double budget_ms) {
    double least = INFINITY;
    for (int code = 0; code < COMBINATIONS * COMBINATIONS * COMBINATIONS; code++) {
        const int chosen[SEGMENTS] = {code % COMBINATIONS, code / COMBINATIONS % COMBINATIONS,
                                      code / COMBINATIONS / COMBINATIONS};
        double bound = 0.0, flip = 0.0;
        for (int s = 0; s < SEGMENTS; s++) {
            bound += value_of(segments, s, chosen[s])->bound / SEGMENTS;
            flip += value_of(segments, s, chosen[s])->flip / SEGMENTS;
        }
        least = bound <= budget_ms ? fmin(least, flip) : least;
    }
    return least;
}

// The best single combination for the whole path.
static double try_fixed(const DipCostReport *report, const Truth *truth, double budget_ms) {
    double least = INFINITY;
    for (int c = 0; c < COMBINATIONS; c++) {
        const DipEstimate time = dip_cost_budget_time(report, report->combined_first + c);
        const double flip = (truth->flip[c][0] + truth->flip[c][1] + truth->flip[c][2]) / 3.0;
        least = time.high <= budget_ms ? fmin(least, flip) : least;
    }
    return least;
}

static void segments_of_equal_slope_are_near_the_best(void **state) {
    (void)state;
    int best = 0, gained = 0, tried = 0;
    for (int trial = 0; trial < 30; trial++) {
        const Truth truth = make_random();
        DipCostReport report;
        DipCostSegments segments;
        make_report(&report, &truth);
        report.options.budget_of = DIP_COST_BUDGET_MEAN;
        assert_true(dip_cost_segments_make(&report, SEGMENTS, &segments, NULL));
        for (double budget_ms = 3.0; budget_ms < 13.0; budget_ms += 0.9) {
            DipCostSegmentAdvice advice;
            const double least = try_all(&segments, budget_ms);
            const double fixed = try_fixed(&report, &truth, budget_ms);
            assert_true(dip_cost_segments_advise(&report, &segments, budget_ms, &advice, NULL));
            assert_int_equal(advice.chosen[0] >= 0, isfinite(least));
            assert_int_equal(advice.fixed >= 0, isfinite(fixed));
            if (!isfinite(least)) {
                continue;
            }
            double bound = 0.0;
            for (int s = 0; s < SEGMENTS; s++) {
                bound += value_of(&segments, s, advice.chosen[s])->bound / SEGMENTS;
            }
            expect_near(advice.bound, bound, 1e-9);
            assert_true(advice.bound <= budget_ms);
            assert_true(advice.flip >= least - 1e-12 && advice.flip <= fixed + 1e-12);
            best += advice.flip <= least + 1e-12 || least > 0.99 * fixed;
            gained += advice.flip < 0.99 * fixed;
            tried++;
        }
        dip_cost_segments_free(&segments);
        dip_cost_report_free(&report);
    }
    assert_true(tried > 150 && best > tried / 2 && gained > tried / 3);
}

// For budgets of the worst frame, each segment stands alone. Levels rise along the path, so its
// last frame is the slowest of a segment.
static void the_worst_frame_of_each_segment_is_within_the_budget(void **state) {
    (void)state;
    for (int trial = 0; trial < 30; trial++) {
        const Truth truth = make_random();
        DipCostReport report;
        DipCostSegments segments;
        DipCostSegmentAdvice advice;
        make_report(&report, &truth);
        report.options.budget_of = DIP_COST_BUDGET_WORST;
        assert_true(dip_cost_segments_make(&report, SEGMENTS, &segments, NULL));
        for (double budget_ms = 3.0; budget_ms < 20.0; budget_ms += 1.1) {
            double flip = 0.0;
            for (int s = 0; s < SEGMENTS; s++) {
                double least = INFINITY;
                for (int c = 0; c < COMBINATIONS; c++) {
                    const DipEstimate worst = report.rows[report.combined_first + c].time.worst_ms;
                    const double ms = level_of(8 * s + 7) * truth.ratio[c][s];
                    const bool fits = ms * worst.high / worst.value <= budget_ms;
                    least = fits ? fmin(least, truth.flip[c][s]) : least;
                }
                flip += least / SEGMENTS;
            }
            assert_true(dip_cost_segments_advise(&report, &segments, budget_ms, &advice, NULL));
            assert_int_equal(advice.chosen[0] >= 0, isfinite(flip));
            if (isfinite(flip)) {
                const double fixed = try_fixed(&report, &truth, budget_ms);
                expect_near(advice.flip, flip > 0.99 * fixed ? fixed : flip, 1e-12);
                assert_true(advice.bound <= budget_ms);
            }
        }
        dip_cost_segments_free(&segments);
        dip_cost_report_free(&report);
    }
}

// --- output --------------------------------------------------------------------------------------

static void expect_text(const char *text, const char *part) {
    if (!strstr(text, part)) {
        fail_msg("\"%s\" is not in:\n%s", part, text);
    }
}

// Combination 1 is worth its time in the middle of the path only.
static void the_table_names_what_supports_a_segment(void **state) {
    (void)state;
    Truth truth;
    for (int c = 0; c < COMBINATIONS; c++) {
        for (int s = 0; s < SEGMENTS; s++) {
            truth.ratio[c][s] = c == 0 ? 1.0 : c == 1 ? 2.0 : 5.0;
            truth.flip[c][s] = c == 1 && s == 1 ? 0.02 : 0.08;
        }
    }
    DipCostReport report;
    DipCostSegments segments;
    DipCostSegmentAdvice advice[3];
    make_report(&report, &truth);
    report.options.budget_of = DIP_COST_BUDGET_MEAN;
    assert_true(dip_cost_segments_make(&report, SEGMENTS, &segments, NULL));
    static const double budgets[3] = {1.0, 4.5, 20.0};
    for (int i = 0; i < 3; i++) {
        assert_true(dip_cost_segments_advise(&report, &segments, budgets[i], &advice[i], NULL));
    }
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    const DipCostSegmentList list = {&report, &segments, advice, 3};
    dip_cost_segments_print(&list, out);
    fclose(out);
    expect_text(text, "path DEFAULT in 3 segments. Time is spent where it lowers FLIP most");
    expect_text(text, "of which the segment with the fewest has 1");
    expect_text(text, "1 ms: no combination is surely that fast");
    expect_text(text, "4.5 ms: mean FLIP 0.06000, 25.0 % below that of defaults for the whole path "
                      "(0.08000); mean time 4.20 ms");
    expect_text(text, "      33 %   67 %           1       8     6.30");
    expect_text(text, "0.02000  af=2\n");
    free(text);
    cJSON *root = cJSON_CreateObject();
    dip_cost_segments_add_json(&list, root);
    const cJSON *advised = cJSON_GetObjectItem(root, "advice_per_segment");
    assert_int_equal(cJSON_GetArraySize(cJSON_GetObjectItem(root, "segments")), SEGMENTS);
    assert_int_equal(cJSON_GetArraySize(advised), 3);
    assert_null(cJSON_GetObjectItem(cJSON_GetArrayItem(advised, 0), "chosen"));
    const cJSON *second = cJSON_GetArrayItem(advised, 1);
    expect_near(cJSON_GetNumberValue(cJSON_GetObjectItem(second, "mean_flip")), 0.06, 1e-12);
    const cJSON *middle = cJSON_GetArrayItem(cJSON_GetObjectItem(second, "chosen"), 1);
    expect_near(cJSON_GetNumberValue(cJSON_GetObjectItem(middle, "ms")), 6.3, 1e-9);
    cJSON_Delete(root);
    dip_cost_segments_free(&segments);
    dip_cost_report_free(&report);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(segments_have_their_frames_and_viewpoints),
        cmocka_unit_test(times_of_frames_have_the_mean_of_the_row),
        cmocka_unit_test(segments_of_equal_slope_are_near_the_best),
        cmocka_unit_test(the_worst_frame_of_each_segment_is_within_the_budget),
        cmocka_unit_test(the_table_names_what_supports_a_segment),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
