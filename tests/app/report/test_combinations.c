// Tests combinations of settings (app/report/combinations.h): which there are, how the work of one
// is composed from that of others, which draw the same pictures, and what two settings add to each
// other.
#include "app/report/analysis.h"
#include "app/report/combinations.h"
#include "app/report/report.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const unsigned five = 1u << DIP_SETTING_AA | 1u << DIP_SETTING_AAA | 1u << DIP_SETTING_ASD |
                             1u << DIP_SETTING_AF | 1u << DIP_SETTING_AAF;

enum { COMBINATIONS = 198 };

static void combinations_without_effect_are_left_out(void **state) {
    (void)state;
    DipQuality list[COMBINATIONS];
    const DipQuality baseline = dip_quality_default();
    assert_int_equal(dip_cost_list_combinations(&baseline, five, list, COMBINATIONS), COMBINATIONS);
    for (int i = 0; i < COMBINATIONS; i++) {
        const DipQuality *q = &list[i];
        assert_true(dip_quality_check(q, NULL));
        assert_false(q->step[DIP_SETTING_AAF] && !q->step[DIP_SETTING_AF]);
        assert_false(q->step[DIP_SETTING_AAA] && !q->step[DIP_SETTING_AA]);
        for (int k = 0; k < i; k++) {
            assert_true(memcmp(&list[k], q, sizeof *q) != 0);
        }
    }
    assert_int_equal(dip_cost_list_combinations(&baseline, 0, list, 1), 1);
    assert_int_equal(dip_cost_list_combinations(&baseline, 1u << DIP_SETTING_AF, list, 1), 5);
}

// --- composed work -------------------------------------------------------------------------------

// A made-up truth: each group of settings multiplies each counter by a factor of its own. Counter 0
// is work that the base lacks and that filtering alone brings.
static void make_true_work(const DipQuality *quality, double *counters) {
    const uint8_t *step = quality->step;
    const double sampling = 1.0 + step[DIP_SETTING_AA] + 0.25 * step[DIP_SETTING_AAA] +
                            0.125 * step[DIP_SETTING_ASD] + 0.5 * step[DIP_SETTING_TAA];
    const double filtering = (1.0 + step[DIP_SETTING_AF] + 0.5 * step[DIP_SETTING_AAF]) *
                             (1.0 + 0.25 * step[DIP_SETTING_OPT]) *
                             (6.0 - step[DIP_SETTING_MIPLOD]) * (1.5 - 0.5 * step[DIP_SETTING_GI]) *
                             (1.0 + 0.25 * step[DIP_SETTING_SCALE]) *
                             (1.0 + 0.125 * step[DIP_SETTING_UPSCALE]);
    for (int c = 0; c < DIP_COUNTER_COUNT; c++) {
        counters[c] = 16.0 * (c % 3 ? sampling : 1.0) * (c % 2 ? filtering : 1.0);
    }
    // The filters draw their pixels in passes of their own, which add up.
    counters[DIP_COUNTER_pixels_filtered] = 0.0;
    counters[0] = step[DIP_SETTING_AF] ? 8.0 * step[DIP_SETTING_AF] : 0.0;
}

// Adds the made-up truth of shadows: the map is work of its own, and a share of all fragments read
// it.
static void add_true_shadows(const DipQuality *quality, double *counters) {
    const double map = quality->step[DIP_SETTING_SHADOWS];
    for (int c = 0; c < DIP_COUNTER_COUNT; c++) {
        counters[c] += c == DIP_COUNTER_fragments_shaded ? 0.0 : 5.0 * map;
    }
    counters[DIP_COUNTER_fragments_shadowed] =
        map > 0.0 ? 0.75 * counters[DIP_COUNTER_fragments_shaded] : 0.0;
}

typedef struct Counted {
    DipQuality base;
    int most_groups;    // Combinations that differ in more groups were not counted...
    bool has_filtering; // ...but for those that have the base's antialiasing.
    double counters[16][DIP_COUNTER_COUNT];
    int next;
} Counted;

static const double *find_counted(const void *context, const DipQuality *quality) {
    Counted *counted = (Counted *)context;
    const DipQuality filtering =
        dip_cost_take_settings(&counted->base, quality, ~dip_work_group(0));
    const bool known = dip_work_count_groups(&counted->base, quality) <= counted->most_groups ||
                       (counted->has_filtering && dip_quality_equal(&filtering, quality));
    double *counters = counted->counters[counted->next++ % 16];
    make_true_work(quality, counters);
    add_true_shadows(quality, counters);
    return known ? counters : NULL;
}

// Callers that counted single groups and callers that counted whole filterings compose the same
// work for every combination: the true one.
static void composed_work_is_one(void **state) {
    (void)state;
    static DipQuality list[1 << 18];
    const unsigned few = 1u << DIP_SETTING_AA | 1u << DIP_SETTING_AF | 1u << DIP_SETTING_SHADOWS;
    // Filters of the finished picture add work of their own, which no other setting changes.
    const unsigned all = ((1u << DIP_SETTING_MIPDEBUG) - 1) &
                         ~(1u << DIP_SETTING_UPSCALE | 1u << DIP_SETTING_POST |
                           1u << DIP_SETTING_SHARPEN | 1u << DIP_SETTING_SHADOWS);
    Counted groups = {.base = dip_quality_default(), .most_groups = 1};
    Counted parts = {.base = groups.base, .most_groups = 1, .has_filtering = true};
    int count = dip_cost_list_combinations(&groups.base, all, list, 1 << 18);
    assert_int_equal(count, 168480);
    count += dip_cost_list_combinations(&groups.base, few, list + count, (1 << 18) - count);
    assert_int_equal(count, 168480 + 5 * 5 * 4);
    for (int i = 0; i < count; i++) {
        double truth[DIP_COUNTER_COUNT], first[DIP_COUNTER_COUNT], second[DIP_COUNTER_COUNT];
        make_true_work(&list[i], truth);
        add_true_shadows(&list[i], truth);
        assert_true(dip_work_compose(find_counted, &groups, &groups.base, &list[i], first));
        assert_true(dip_work_compose(find_counted, &parts, &parts.base, &list[i], second));
        for (int c = 0; c < DIP_COUNTER_COUNT; c++) {
            assert_true(fabs(first[c] - truth[c]) <= 1e-9 * truth[c]);
            assert_true(fabs(second[c] - truth[c]) <= 1e-9 * truth[c]);
        }
    }
    double counters[DIP_COUNTER_COUNT];
    DipQuality mip_colours = groups.base;
    mip_colours.step[DIP_SETTING_MIPDEBUG] = 1;
    assert_false(dip_work_compose(find_counted, &groups, &groups.base, &mip_colours, counters));
    groups.most_groups = 0;
    assert_false(dip_work_compose(find_counted, &groups, &groups.base, &list[count - 1], counters));
}

// Counts the pixels that filters write, per pixel of the frame.
static void count_filtered(double *counters, const DipQuality *quality) {
    static const double drawn[] = {1.0 / 4.0, 100.0 / 289.0, 4.0 / 9.0, 100.0 / 169.0};
    const bool below = quality->step[DIP_SETTING_SCALE] < DIP_SCALE_1;
    const double part = below ? drawn[quality->step[DIP_SETTING_SCALE]] : 1.0;
    counters[DIP_COUNTER_pixels_filtered] =
        (quality->step[DIP_SETTING_TAA] == DIP_TAA_HISTORY ? part : 0.0) +
        (quality->step[DIP_SETTING_POST] ? part : 0.0) + below +
        (quality->step[DIP_SETTING_SHARPEN] != 0);
}

// Combinations that differ from a base in one group of settings.
typedef struct Alone {
    DipQuality base;
    double counters[16][DIP_COUNTER_COUNT];
    int next;
} Alone;

static const double *find_alone(const void *context, const DipQuality *quality) {
    Alone *alone = (Alone *)context;
    double *counters = alone->counters[alone->next++ % 16];
    count_filtered(counters, quality);
    return dip_work_count_groups(&alone->base, quality) <= 1 ? counters : NULL;
}

// A history and post-process AA filter the picture that is drawn, the other filters the frame.
static void composed_filters_write_the_pixels_of_their_pictures(void **state) {
    (void)state;
    static DipQuality list[1024];
    const unsigned all = 1u << DIP_SETTING_TAA | 1u << DIP_SETTING_SCALE |
                         1u << DIP_SETTING_UPSCALE | 1u << DIP_SETTING_POST |
                         1u << DIP_SETTING_SHARPEN;
    const DipQuality base = dip_quality_default();
    const int count = dip_cost_list_combinations(&base, all, list, 1024);
    assert_int_equal(count, 2 * (4 + 4 * 3) * 3 * 4);
    for (int i = 0; i < count; i++) {
        for (int b = 0; b < count; b += 7) {
            double truth[DIP_COUNTER_COUNT] = {0.0}, found[DIP_COUNTER_COUNT];
            Alone alone = {.base = list[b]};
            count_filtered(truth, &list[i]);
            assert_true(dip_work_compose(find_alone, &alone, &list[b], &list[i], found));
            const double wanted = truth[DIP_COUNTER_pixels_filtered];
            assert_true(fabs(found[DIP_COUNTER_pixels_filtered] - wanted) < 1e-9);
            assert_true(fabs(dip_cost_pixels_filtered(&list[i]) - wanted) < 1e-12);
        }
    }
}

// A made-up truth of a fine mesh: which triangles are drawn follows from the samples on them, and
// the pixels that show several fragments, which one sample cannot have, grow with the picture. So
// do the edges that post-process AA finds in it.
static void make_fine_work(const DipQuality *quality, double *counters) {
    const double scale = dip_quality_scale(quality);
    const double density = dip_quality_sample_count(quality) * scale * scale;
    const double others =
        (1.0 + quality->step[DIP_SETTING_AF]) * (1.0 + 0.25 * quality->step[DIP_SETTING_AAA]);
    memset(counters, 0, DIP_COUNTER_COUNT * sizeof *counters);
    counters[DIP_COUNTER_triangles_drawn] = 1000.0 * density / (1.0 + density) * others;
    counters[DIP_COUNTER_fragments_shaded] = 500.0 * scale * scale * others;
    counters[DIP_COUNTER_pixels_resolved] =
        dip_quality_sample_count(quality) > 1 ? 100.0 * scale * scale : 0.0;
    counters[DIP_COUNTER_edges_found] = 70.0 * quality->step[DIP_SETTING_POST] * (0.5 + scale);
}

typedef struct Fine {
    DipQuality base;
    bool has_corners;   // The corners were counted.
    bool has_filtering; // So were all combinations with the base's antialiasing.
    double counters[16][DIP_COUNTER_COUNT];
    int next;
} Fine;

static const double *find_fine(const void *context, const DipQuality *quality) {
    Fine *fine = (Fine *)context;
    double *counters = fine->counters[fine->next++ % 16];
    make_fine_work(quality, counters);
    const DipQuality filtering = dip_cost_take_settings(&fine->base, quality, ~dip_work_group(0));
    const bool known = dip_work_count_groups(&fine->base, quality) <= 1 ||
                       (fine->has_corners && dip_work_is_corner(&fine->base, quality)) ||
                       (fine->has_filtering && dip_quality_equal(&filtering, quality));
    return known ? counters : NULL;
}

// Returns by what part composed work of these settings misses the truth at most in one counter.
static double worst_miss(Fine fine, unsigned settings, int counter) {
    static DipQuality list[1024];
    const int count = dip_cost_list_combinations(&fine.base, settings, list, 1024);
    double worst = 0.0;
    assert_true(count > 400 && count <= 1024);
    for (int i = 0; i < count; i++) {
        double truth[DIP_COUNTER_COUNT], found[DIP_COUNTER_COUNT];
        make_fine_work(&list[i], truth);
        assert_true(dip_work_compose(find_fine, &fine, &fine.base, &list[i], found));
        const double miss = fabs(found[counter] - truth[counter]);
        worst = fmax(worst, miss > 0.0 ? miss / truth[counter] : 0.0);
    }
    return worst;
}

// Antialiasing and render scale depend on each other, and so do post-process AA and render scale.
// Their work is composed right from what both do together, and wrong by up to two fifths from what
// each does alone.
static void settings_that_depend_on_each_other_are_composed_together(void **state) {
    (void)state;
    const unsigned fine_mesh = 1u << DIP_SETTING_AA | 1u << DIP_SETTING_AAA | 1u << DIP_SETTING_AF |
                               1u << DIP_SETTING_SCALE;
    const unsigned edges = 1u << DIP_SETTING_AA | 1u << DIP_SETTING_SCALE |
                           1u << DIP_SETTING_UPSCALE | 1u << DIP_SETTING_POST |
                           1u << DIP_SETTING_SHARPEN;
    const Fine alone = {.base = dip_quality_default()};
    assert_true(worst_miss(alone, fine_mesh, DIP_COUNTER_triangles_drawn) > 0.4);
    assert_true(worst_miss(alone, edges, DIP_COUNTER_edges_found) > 0.39);
    for (int filtering = 0; filtering < 2; filtering++) {
        const Fine fine = {alone.base, .has_corners = true, .has_filtering = filtering};
        for (int c = 0; c < DIP_COUNTER_COUNT; c++) {
            if (c != DIP_COUNTER_pixels_filtered) { // It follows from the settings.
                assert_true(worst_miss(fine, fine_mesh, c) <= 1e-9);
                assert_true(worst_miss(fine, edges, c) <= 1e-9);
            }
        }
    }
}

// --- reports of combinations ---------------------------------------------------------------------

static void set_flip(DipCostRow *row, double flip) {
    row->judged[0] = true;
    row->viewpoints[0] = (DipMetricSums){.bursts = 1.0};
    row->viewpoints[0].regions[0].pixels = 1.0;
    row->viewpoints[0].regions[0].flip = flip;
}

// A report of a path with one viewpoint that has every combination as a row. All take 1 ms and have
// the same FLIP, until a test changes them.
static void make_report(DipCostReport *report) {
    DipQuality list[COMBINATIONS];
    *report = (DipCostReport){.path_count = 1, .rounds = 2};
    report->options = (DipCostOptions){.baseline = dip_quality_default(),
                                       .places = 1,
                                       .rounds = 2,
                                       .timed_frames = 1,
                                       .combined = five};
    assert_int_equal(
        dip_cost_list_combinations(&report->options.baseline, five, list, COMBINATIONS),
        COMBINATIONS);
    report->rows = calloc(DIP_COST_MAX_ROWS, sizeof *report->rows);
    report->predicted.list = calloc(COMBINATIONS, sizeof *report->predicted.list);
    assert_true(report->rows && report->predicted.list);
    assert_true(dip_cost_report_alloc(report, NULL));
    for (int i = 0; i < COMBINATIONS; i++) {
        assert_int_equal(dip_cost_report_add_row(report, &list[i], 0, NULL), i);
        report->rows[i].time.mean_ms.value = 1.0;
        set_flip(&report->rows[i], 0.1);
    }
}

// FLIP = .1 - .02 (aa) - .03 (af) + .005 if both, and time = 4 * 2 (aa) * 1.5 (af) * 1.1 if both.
static void interactions_are_what_both_add(void **state) {
    (void)state;
    DipCostReport report;
    make_report(&report);
    for (int i = 0; i < COMBINATIONS; i++) {
        const DipQuality *q = &report.rows[i].quality;
        const bool aa = q->step[DIP_SETTING_AA] != 0;
        const bool af = q->step[DIP_SETTING_AF] != 0;
        set_flip(&report.rows[i], 0.1 - 0.02 * aa - 0.03 * af + 0.005 * (aa && af));
        report.rows[i].time.mean_ms.value =
            4.0 * (aa ? 2.0 : 1.0) * (af ? 1.5 : 1.0) * (aa && af ? 1.1 : 1.0);
    }
    assert_true(dip_cost_analyse(&report, NULL));
    const DipCostInteraction *list = report.analysis->interactions;
    int found = 0;
    for (int i = 0; i < report.analysis->interaction_count; i++) {
        if (list[i].a == DIP_SETTING_AA && list[i].b == DIP_SETTING_AF) {
            assert_true(fabs(list[i].flip - 0.005) < 1e-12);
            assert_true(fabs(list[i].time - 1.1) < 1e-12);
            assert_int_equal(list[i].contexts, 1); // aaa needs samples, aaf needs probes.
            found++;
        } else {
            assert_true(fabs(list[i].flip) < 0.0051);
        }
    }
    assert_int_equal(found, 1);
    dip_cost_report_free(&report);
}

// --- rows with the same pictures -----------------------------------------------------------------

static void combinations_with_the_same_pictures_are_one_row(void **state) {
    (void)state;
    DipCostReport report;
    make_report(&report);
    for (int i = 0; i < COMBINATIONS; i++) { // In this scene adaptive AA changes no picture.
        const DipQuality *q = &report.rows[i].quality;
        snprintf(report.rows[i].pictures[0], 33, "aa %d af %d aaf %d", q->step[DIP_SETTING_AA],
                 q->step[DIP_SETTING_AF], q->step[DIP_SETTING_AAF]);
        // All were measured after they had been predicted.
        report.predicted.list[report.predicted.count++] =
            (DipCostPrediction){.quality = *q, .row = i};
    }
    // A sweep of all rows that have no adaptive AA; joining moves these rows.
    DipQuality swept[DIP_COST_MAX_SWEEP_ROWS];
    DipCostSweep *sweep = &report.sweeps[report.sweep_count++];
    *sweep = (DipCostSweep){.base = COMBINATIONS - 1};
    for (int i = COMBINATIONS - 1; i >= 0 && sweep->row_count < DIP_COST_MAX_SWEEP_ROWS; i--) {
        if (report.rows[i].quality.step[DIP_SETTING_AAA] == 0) {
            swept[sweep->row_count] = report.rows[i].quality;
            sweep->rows[sweep->row_count++] = i;
        }
    }
    for (int again = 0; again < 2; again++) { // A merged report may have been joined before.
        assert_true(dip_cost_join_same_pictures(&report, NULL));
    }
    for (int i = 0; i < sweep->row_count; i++) {
        assert_true(dip_quality_equal(&report.rows[sweep->rows[i]].quality, &swept[i]));
    }
    assert_true(sweep->base < report.row_count);
    assert_int_equal(report.row_count, 5 * 9);
    assert_int_equal(report.same_count, COMBINATIONS - 5 * 9);
    for (int r = 0; r < report.row_count; r++) {
        assert_int_equal(report.rows[r].quality.step[DIP_SETTING_AAA], 0);
    }
    for (int i = 0; i < report.same_count; i++) {
        const DipQuality *q = &report.same[i].quality;
        const DipQuality *stands = &report.rows[report.same[i].row].quality;
        assert_int_equal(q->step[DIP_SETTING_AA], stands->step[DIP_SETTING_AA]);
        assert_int_equal(q->step[DIP_SETTING_AF], stands->step[DIP_SETTING_AF]);
        assert_int_equal(q->step[DIP_SETTING_AAF], stands->step[DIP_SETTING_AAF]);
    }
    for (int i = 0; i < report.predicted.count; i++) { // Their rows follow.
        const DipCostPrediction *p = &report.predicted.list[i];
        assert_true(p->row >= 0 && p->row < report.row_count);
        assert_int_equal(dip_report_find_same(&report, &p->quality, 0), p->row);
    }
    dip_cost_report_free(&report);
}

static void pictures_that_are_not_known_are_not_the_same(void **state) {
    (void)state;
    DipCostReport report;
    make_report(&report);
    assert_false(dip_cost_same_pictures(&report, 1, 2)); // No hashes.
    snprintf(report.rows[1].pictures[0], 33, "x");
    snprintf(report.rows[2].pictures[0], 33, "x");
    assert_true(dip_cost_same_pictures(&report, 1, 2));
    report.rows[2].judged[0] = false; // Another part has this viewpoint.
    assert_false(dip_cost_same_pictures(&report, 1, 2));
    dip_cost_report_free(&report);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(combinations_without_effect_are_left_out),
        cmocka_unit_test(composed_work_is_one),
        cmocka_unit_test(composed_filters_write_the_pixels_of_their_pictures),
        cmocka_unit_test(settings_that_depend_on_each_other_are_composed_together),
        cmocka_unit_test(interactions_are_what_both_add),
        cmocka_unit_test(combinations_with_the_same_pictures_are_one_row),
        cmocka_unit_test(pictures_that_are_not_known_are_not_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
