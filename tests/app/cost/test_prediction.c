// Tests predictions: of times from made-up work and prices, of FLIP from recorded errors, and the
// choice of what to measure.
#include "app/report/combinations.h"
#include "app/report/fit.h"
#include "app/cost/steps.h"
#include "app/cost/predict/predict_elsewhere.h"
#include "renderer/catalogue/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/app/cost/recorded_flip.inc"

enum { COMBINATIONS = 126, TRAINED = 20 };

static const unsigned five = 1u << DIP_SETTING_AA | 1u << DIP_SETTING_AAA | 1u << DIP_SETTING_ASD |
                             1u << DIP_SETTING_AF | 1u << DIP_SETTING_AAF;

// Lists the combinations whose FLIP was recorded: those with aaa=off and aaa=on.
static int list_recorded(const DipQuality *baseline, DipQuality list[COMBINATIONS]) {
    static DipQuality all[2 * COMBINATIONS];
    const int count = dip_cost_list_combinations(baseline, five, all, 2 * COMBINATIONS);
    int kept = 0;
    for (int i = 0; i < count; i++) {
        const int step = all[i].step[DIP_SETTING_AAA];
        if (kept < COMBINATIONS && (step == DIP_AAA_OFF || step == DIP_AAA_ON)) {
            list[kept++] = all[i];
        }
    }
    return kept;
}

// Work that depends on the settings as in a real scene: samples, groups and probes rise with their
// settings, and the edges that several samples show get more fragments.
static void make_counters(const DipQuality *quality, double *counters) {
    const double samples = dip_quality_sample_count(quality);
    const double groups = samples / dip_quality_samples_per_group(quality);
    const double probes = dip_quality_max_anisotropy(quality);
    const double fragments = 3e5 * (1.0 + 0.2 * (1.0 - 1.0 / samples));
    memset(counters, 0, DIP_COUNTER_COUNT * sizeof *counters);
    counters[DIP_COUNTER_passes] = 2.0;
    counters[DIP_COUNTER_tiles_drawn] = 80.0;
    counters[DIP_COUNTER_triangles_in] = 2e4;
    counters[DIP_COUNTER_triangles_drawn] = 8e3;
    counters[DIP_COUNTER_tile_triangles] = 1.5e4;
    counters[DIP_COUNTER_sub_blocks_tested] = 1e5;
    counters[DIP_COUNTER_sub_blocks_accepted] = 3e4;
    counters[DIP_COUNTER_fragments_clip_tested] = 4e4 * groups;
    counters[DIP_COUNTER_clip_sample_groups] = 900.0 * groups;
    counters[DIP_COUNTER_fragments_shaded] = fragments;
    counters[DIP_COUNTER_samples_shown] = 3e5 * samples;
    counters[DIP_COUNTER_pixels_resolved] = samples > 1.0 ? 5e4 : 0.0;
    counters[DIP_COUNTER_texture_probes] =
        fragments *
        (1.0 + 0.6 * log2(probes) - 0.01 * probes + (quality->step[DIP_SETTING_AAF] ? 0.05 : 0.0));
    counters[DIP_COUNTER_texels_fetched] = 6.5 * counters[DIP_COUNTER_texture_probes];
}

// Prices that the model does not have as they are: a fixed time, and work of several stages.
static void make_times(DipCostRow *row, double noise) {
    const double *c = row->counters;
    row->stage_ms[DIP_COST_STAGE_geometry] = 0.2 + 3e-5 * c[DIP_COUNTER_triangles_in];
    row->stage_ms[DIP_COST_STAGE_raster] =
        0.1 + 1e-6 * c[DIP_COUNTER_samples_shown] + 8e-6 * c[DIP_COUNTER_fragments_clip_tested];
    row->stage_ms[DIP_COST_STAGE_shading] =
        4e-6 * c[DIP_COUNTER_fragments_shaded] + 5e-7 * c[DIP_COUNTER_texels_fetched];
    row->stage_ms[DIP_COST_STAGE_resolve] = 5e-6 * c[DIP_COUNTER_pixels_resolved];
    row->stage_ms[DIP_COST_STAGE_rest] = 0.1;
    row->time.mean_ms.value = 0.0;
    for (int s = 0; s < DIP_COST_STAGE_COUNT; s++) {
        row->stage_ms[s] *= noise;
        row->time.mean_ms.value += row->stage_ms[s];
    }
    row->time.p95_ms = dip_estimate_unknown(1.3 * row->time.mean_ms.value);
}

static void set_flip(DipCostRow *row, double flip) {
    row->judged[0] = true;
    row->viewpoints[0] = (DipMetricSums){.bursts = 1.0};
    row->viewpoints[0].regions[0].pixels = 1.0;
    row->viewpoints[0].regions[0].flip = flip;
}

// A report with every combination as a row and as a prediction. All rows are known; a test forgets
// those that it wants to predict.
static void make_report(DipCostReport *report, const double *flip, double noise, uint64_t seed) {
    DipQuality list[COMBINATIONS];
    Random random = {seed};
    *report = (DipCostReport){.path_count = 1, .rounds = 2};
    report->options = (DipCostOptions){.baseline = dip_quality_default(),
                                       .places = 1,
                                       .rounds = 2,
                                       .timed_frames = 1,
                                       .combined = five};
    assert_int_equal(list_recorded(&report->options.baseline, list), COMBINATIONS);
    report->rows = calloc(DIP_COST_MAX_ROWS, sizeof *report->rows);
    report->predicted.list = calloc(COMBINATIONS, sizeof *report->predicted.list);
    report->predicted.count = COMBINATIONS;
    assert_true(report->rows && report->predicted.list);
    assert_true(dip_cost_report_alloc(report, NULL));
    for (int i = 0; i < COMBINATIONS; i++) {
        assert_int_equal(dip_cost_report_add_row(report, &list[i], 0, NULL), i);
        make_counters(&list[i], report->rows[i].counters);
        make_times(&report->rows[i], 1.0 + noise * random_real(&random, -1.0, 1.0));
        set_flip(&report->rows[i], flip[i]);
        report->predicted.list[i] = (DipCostPrediction){.quality = list[i], .row = -1};
        memcpy(report->predicted.list[i].counters, report->rows[i].counters,
               sizeof report->rows[i].counters);
    }
}

static void predict_others(DipCostReport *report) {
    DipCostModels models;
    assert_true(dip_cost_models_of(report, &models, NULL));
    assert_true(dip_cost_predict_others(report, &models, NULL));
    dip_cost_models_free(&models);
}

// Trains on TRAINED combinations and predicts the others. Returns the misses of times and of FLIP.
static void train(DipCostReport *report, DipCostMisses *times, DipCostMisses *errors) {
    int chosen[TRAINED];
    double time_misses[COMBINATIONS], flip_misses[COMBINATIONS];
    int others = 0;
    assert_int_equal(dip_cost_training_count(five, COMBINATIONS), TRAINED);
    assert_true(dip_cost_choose_training(report, TRAINED, chosen, NULL));
    for (int i = 0; i < TRAINED; i++) {
        report->predicted.list[chosen[i]].row = chosen[i];
    }
    predict_others(report);
    for (int i = 0; i < COMBINATIONS; i++) {
        const DipCostPrediction *p = &report->predicted.list[i];
        if (p->row < 0) {
            const DipCostRow *row = &report->rows[i];
            time_misses[others] = fabs(p->ms / row->time.mean_ms.value - 1.0);
            flip_misses[others++] = fabs(p->flip / row->viewpoints[0].regions[0].flip - 1.0);
            assert_true(fabs(p->p95_ms / p->ms - 1.3) < 1e-9);
        }
    }
    assert_int_equal(others, COMBINATIONS - TRAINED);
    *times = dip_cost_misses_of(time_misses, others);
    *errors = dip_cost_misses_of(flip_misses, others);
}

static void times_follow_from_work(void **state) {
    (void)state;
    DipCostMisses times, errors;
    DipCostReport report;
    make_report(&report, courtyard_flip, 0.0, 1);
    train(&report, &times, &errors);
    assert_true(times.p90 < 1e-6); // Without noise, prices explain all of it.
    dip_cost_report_free(&report);
    make_report(&report, courtyard_flip, 0.02, 1);
    train(&report, &times, &errors);
    assert_true(times.median < 0.02 && times.p90 < 0.05);
    dip_cost_report_free(&report);
}

// All settings pose the same vertices, so their price takes in whatever else geometry costs in
// every frame. It must not be less than the vertices cost.
static void posed_vertices_have_a_price(void **state) {
    (void)state;
    const double vertices = 4e4, ms_per_vertex = 2e-5;
    DipCostMisses times, errors;
    DipCostReport report;
    int rows[COMBINATIONS];
    make_report(&report, courtyard_flip, 0.0, 1);
    for (int i = 0; i < COMBINATIONS; i++) {
        DipCostRow *row = &report.rows[i];
        rows[i] = i;
        row->counters[DIP_COUNTER_vertices_posed] = vertices;
        report.predicted.list[i].counters[DIP_COUNTER_vertices_posed] = vertices;
        row->stage_ms[DIP_COST_STAGE_geometry] += ms_per_vertex * vertices;
        row->time.mean_ms.value += ms_per_vertex * vertices;
        row->time.p95_ms = dip_estimate_unknown(1.3 * row->time.mean_ms.value);
    }
    train(&report, &times, &errors);
    assert_true(times.p90 < 1e-6);
    const DipCostModel model = dip_cost_model_fit(&report, rows, COMBINATIONS);
    double counters[DIP_COUNTER_COUNT];
    memcpy(counters, report.rows[0].counters, sizeof counters);
    const double before_ms = dip_cost_model_value(&model, counters, &report.rows[0].quality);
    counters[DIP_COUNTER_vertices_posed] += vertices;
    const double more_ms =
        dip_cost_model_value(&model, counters, &report.rows[0].quality) - before_ms;
    assert_true(more_ms >= 0.999 * ms_per_vertex * vertices);
    assert_true(more_ms <= 1.001 * report.rows[0].stage_ms[DIP_COST_STAGE_geometry]);
    dip_cost_report_free(&report);
}

// A larger picture that is twice as wide as the frame is averaged faster than one that is 1.25 or
// 1.5 times as wide, whose pixels count in part for two pixels of the frame.
static void averaging_parts_of_pixels_has_a_price(void **state) {
    (void)state;
    const int first = DIP_SCALE_1, count = DIP_SCALE_2 - DIP_SCALE_1 + 1;
    int rows[] = {0, 1, 2, 3};
    DipCostReport report;
    make_report(&report, courtyard_flip, 0.0, 1);
    assert_int_equal(count, sizeof rows / sizeof *rows);
    for (int i = 0; i < count; i++) {
        DipCostRow *row = &report.rows[i];
        row->quality = dip_quality_default();
        row->quality.step[DIP_SETTING_SCALE] = (uint8_t)(first + i);
        const double scale = dip_quality_scale(&row->quality);
        const double bytes = 1e6 * scale * scale;
        memset(row->counters, 0, sizeof row->counters);
        memset(row->stage_ms, 0, sizeof row->stage_ms);
        row->counters[DIP_COUNTER_target_bytes] = bytes;
        row->stage_ms[DIP_COST_STAGE_resolve] =
            0.1 + (scale > 1.0 ? 3e-6 * bytes : 0.0) + (scale > 1.0 && scale < 2.0 ? 4.0 : 0.0);
    }
    report.smaller_count = 0;
    const DipCostModel model = dip_cost_model_fit(&report, rows, count);
    for (int i = 0; i < count; i++) {
        const DipCostRow *row = &report.rows[i];
        const double ms = dip_cost_model_value(&model, row->counters, &row->quality);
        assert_true(fabs(ms / row->stage_ms[DIP_COST_STAGE_resolve] - 1.0) < 1e-6);
    }
    dip_cost_report_free(&report);
}

static void flip_follows_from_settings(void **state) {
    (void)state;
    const double *const scenes[] = {courtyard_flip, city_flip};
    for (int s = 0; s < 2; s++) {
        DipCostMisses times, errors;
        DipCostReport report;
        make_report(&report, scenes[s], 0.0, 1);
        train(&report, &times, &errors);
        assert_true(errors.median < 0.01);
        assert_true(errors.p90 < 0.02);
        dip_cost_report_free(&report);
    }
}

// The error of leaving one out must not be less than that of the rows that were never seen: it
// would promise too much. A single median of 16 errors is uncertain, so several draws of the noise
// are compared.
static void leaving_one_out_does_not_promise_too_much(void **state) {
    (void)state;
    double left_out = 0.0, flip_left_out = 0.0, unseen = 0.0, flip_unseen = 0.0;
    for (int seed = 1; seed <= 16; seed++) {
        DipCostMisses times, errors;
        DipCostReport report;
        int chosen[TRAINED];
        make_report(&report, courtyard_flip, 0.03, (uint64_t)seed);
        assert_true(dip_cost_choose_training(&report, TRAINED, chosen, NULL));
        const DipCostMisses misses = dip_cost_model_leave_one_out(&report, chosen, TRAINED);
        assert_int_equal(misses.rows, TRAINED);
        left_out += misses.median / 16.0;
        train(&report, &times, &errors);
        DipCostModels models;
        assert_true(dip_cost_models_of(&report, &models, NULL));
        flip_left_out += dip_flip_model_left_out(&models.flip).median / 16.0;
        dip_cost_models_free(&models);
        unseen += times.median / 16.0;
        flip_unseen += errors.median / 16.0;
        dip_cost_report_free(&report);
    }
    if (!(left_out >= 0.95 * unseen && flip_left_out >= flip_unseen)) {
        fail_msg("times %.4f, unseen %.4f; FLIP %.4f, unseen %.4f", left_out, unseen, flip_left_out,
                 flip_unseen);
    }
}

// Whatever is on the true front is measured or lies within 1 % of a measured one.
static void the_front_is_found(void **state) {
    (void)state;
    DipCostMisses times, errors;
    DipCostReport report;
    make_report(&report, courtyard_flip, 0.0, 3);
    report.options.budget_count = 1;
    report.options.budgets_ms[0] = 6.0;
    train(&report, &times, &errors);
    for (int go = 0; go < 4; go++) {
        int list[DIP_COST_MOST_PROMISING];
        DipCostModels models;
        assert_true(dip_cost_models_of(&report, &models, NULL));
        const int count = dip_cost_list_promising(&report, &models, true, list, NULL);
        dip_cost_models_free(&models);
        for (int i = 0; i < count; i++) {
            assert_true(report.predicted.list[list[i]].row < 0);
            report.predicted.list[list[i]].row = list[i];
        }
        predict_others(&report);
    }
    int measured = 0;
    for (int i = 0; i < COMBINATIONS; i++) {
        bool beaten = report.predicted.list[i].row >= 0;
        measured += beaten;
        for (int k = 0; k < COMBINATIONS; k++) {
            beaten |=
                report.predicted.list[k].row >= 0 &&
                report.rows[k].time.mean_ms.value <= 1.02 * report.rows[i].time.mean_ms.value &&
                courtyard_flip[k] <= 1.015 * courtyard_flip[i];
        }
        assert_true(beaten);
    }
    assert_true(measured < 60);
    dip_cost_report_free(&report);
}

// Counters of a few frames are scaled to those of all frames by what the measured rows have.
static void counters_are_scaled_to_the_timed_frames(void **state) {
    (void)state;
    DipCostReport report;
    make_report(&report, courtyard_flip, 0.0, 1);
    for (int i = 0; i < COMBINATIONS; i++) {
        for (int c = 0; c < DIP_COUNTER_COUNT; c++) {
            report.predicted.list[i].counters[c] *= 0.8; // The few frames show less.
        }
    }
    report.predicted.list[3].row = 3;
    report.predicted.list[90].row = 90;
    dip_cost_scale_counters(&report);
    for (int i = 0; i < COMBINATIONS; i++) {
        for (int c = 0; c < DIP_COUNTER_COUNT; c++) {
            const double truth = report.rows[i].counters[c];
            const bool seen = report.rows[3].counters[c] + report.rows[90].counters[c] > 0.0;
            assert_true(!seen ||
                        fabs(report.predicted.list[i].counters[c] - truth) <= 1e-9 * truth);
        }
    }
    dip_cost_report_free(&report);
}

// --- other sizes ---------------------------------------------------------------------------------

// Makes the work of a picture with `area` times the pixels. Its triangles are the same.
static void scale_work(double *counters, double area) {
    static const int grows[] = {DIP_COUNTER_sub_blocks_tested,     DIP_COUNTER_sub_blocks_accepted,
                                DIP_COUNTER_fragments_clip_tested, DIP_COUNTER_clip_sample_groups,
                                DIP_COUNTER_fragments_shaded,      DIP_COUNTER_samples_shown,
                                DIP_COUNTER_pixels_resolved,       DIP_COUNTER_texture_probes,
                                DIP_COUNTER_texels_fetched};
    for (size_t i = 0; i < sizeof grows / sizeof *grows; i++) {
        counters[grows[i]] *= area;
    }
}

// Returns the median of the misses of all combinations in a picture twice as wide and high.
static double miss_at_twice_the_size(const DipCostReport *report, const DipCostModel *model) {
    double misses[COMBINATIONS];
    for (int i = 0; i < COMBINATIONS; i++) {
        DipCostRow larger = report->rows[i];
        scale_work(larger.counters, 4.0);
        make_times(&larger, 1.0);
        misses[i] = fabs(dip_cost_model_value(model, larger.counters, &larger.quality) /
                             larger.time.mean_ms.value -
                         1.0);
    }
    return dip_cost_misses_of(misses, COMBINATIONS).median;
}

static void add_smaller(DipCostReport *report, int row) {
    DipCostRow smaller = report->rows[row];
    scale_work(smaller.counters, 0.25);
    make_times(&smaller, 1.0);
    DipCostElsewhere *to = &report->smaller[report->smaller_count++];
    to->quality = smaller.quality;
    memcpy(to->counters, smaller.counters, sizeof to->counters);
    memcpy(to->stage_ms, smaller.stage_ms, sizeof to->stage_ms);
}

// From noisy times of one size, no one can tell what grows with the picture. A few times of half
// the size tell it.
static void a_smaller_size_tells_the_prices_of_others(void **state) {
    (void)state;
    double without = 0.0, with = 0.0;
    for (int seed = 1; seed <= 8; seed++) {
        DipCostReport report;
        int chosen[TRAINED];
        make_report(&report, courtyard_flip, 0.04, (uint64_t)seed);
        assert_true(dip_cost_choose_training(&report, TRAINED, chosen, NULL));
        DipCostModel model = dip_cost_model_fit(&report, chosen, TRAINED);
        without += miss_at_twice_the_size(&report, &model) / 8.0;
        const int rows[] = {0, 40, 80, COMBINATIONS - 1};
        for (int i = 0; i < 4; i++) {
            add_smaller(&report, rows[i]);
        }
        model = dip_cost_model_fit(&report, chosen, TRAINED);
        with += miss_at_twice_the_size(&report, &model) / 8.0;
        dip_cost_report_free(&report);
    }
    if (!(with < 0.03 && with < 0.6 * without)) {
        fail_msg("median misses %.4f with smaller pictures, %.4f without", with, without);
    }
}

// --- elsewhere -----------------------------------------------------------------------------------

// Elsewhere, shading takes `shading` times as long for the same work, and all else takes as long.
static void make_times_there(const DipCostRow *row, double shading, DipCostElsewhere *there) {
    *there = (DipCostElsewhere){.quality = row->quality};
    memcpy(there->counters, row->counters, sizeof there->counters);
    for (int s = 0; s < DIP_COST_STAGE_COUNT; s++) {
        there->stage_ms[s] = row->stage_ms[s] * (s == DIP_COST_STAGE_shading ? shading : 1.0);
        there->ms.value += there->stage_ms[s];
    }
}

// Every other one of the times to which prices are fitted is too long by the share `error`, and the
// others are too short by it.
static DipCostElsewherePrediction *predict_there(const DipCostReport *report, int timed,
                                                 int checked, double shading, double error) {
    DipCostElsewherePrediction *p = calloc(1, sizeof *p);
    assert_non_null(p);
    p->report = *report;
    p->there.predicted = report->predicted; // Its counters are those of the report.
    p->there.threads = report->threads + 1;
    p->count = COMBINATIONS;
    p->timed_count = timed;
    p->checked_count = checked;
    p->list = calloc(COMBINATIONS, sizeof *p->list);
    assert_non_null(p->list);
    int chosen[COMBINATIONS];
    assert_true(dip_cost_choose_training(report, timed, chosen, NULL));
    for (int i = 0; i < COMBINATIONS; i++) {
        p->list[i] = (DipCostPredictedThere){.quality = report->rows[i].quality, .timed = -1};
    }
    for (int t = 0; t < timed; t++) {
        p->list[chosen[t]].timed = t;
    }
    for (int i = 0, t = timed; i < COMBINATIONS && t < timed + checked; i += 3) {
        if (p->list[i].timed < 0) {
            p->list[i].timed = t++;
        }
    }
    for (int i = 0; i < COMBINATIONS; i++) {
        if (p->list[i].timed >= 0) {
            make_times_there(&report->rows[i], shading, &p->timed[p->list[i].timed]);
        }
    }
    for (int t = 0; t < timed; t++) {
        const double factor = t % 2 == 0 ? 1.0 + error : 1.0 - error;
        p->timed[t].ms.value *= factor;
        for (int s = 0; s < DIP_COST_STAGE_COUNT; s++) {
            p->timed[t].stage_ms[s] *= factor;
        }
    }
    dip_cost_predict_and_judge_there(p);
    return p;
}

static void six_times_elsewhere_tell_all_others(void **state) {
    (void)state;
    DipCostReport report;
    make_report(&report, courtyard_flip, 0.01, 1);
    DipCostElsewherePrediction *p = predict_there(&report, 6, 30, 1.5, 0.0);
    assert_false(p->from_report);
    assert_int_equal(p->timed_as_is.rows, 6);
    assert_int_equal(p->timed_left_out.rows, 6);
    assert_int_equal(p->checked_as_is.rows, 30);
    assert_int_equal(p->checked_fitted.rows, 30);
    double misses[COMBINATIONS];
    for (int i = 0; i < COMBINATIONS; i++) {
        DipCostElsewhere there;
        make_times_there(&report.rows[i], 1.5, &there);
        misses[i] = fabs(p->list[i].ms / there.ms.value - 1.0);
    }
    const double all = dip_cost_misses_of(misses, COMBINATIONS).p90;
    if (!(p->factor > 1.15 && p->factor < 1.5 && p->checked_as_is.median > 0.12 &&
          p->checked_fitted.p90 < 0.045 && p->timed_left_out.median < 0.06 && all < 0.045)) {
        fail_msg("factor %.4f, checked %.4f alone and %.4f, left out %.4f, all %.4f", p->factor,
                 p->checked_as_is.median, p->checked_fitted.p90, p->timed_left_out.median, all);
    }
    free(p->list);
    free(p);
    p = predict_there(&report, 0, 30, 1.5, 0.0);
    assert_true(p->from_report);
    assert_true(p->factor == 1.0);
    assert_int_equal(p->timed_as_is.rows, 0);
    assert_true(p->checked_fitted.median == p->checked_as_is.median);
    for (int i = 0; i < COMBINATIONS; i++) {
        assert_true(p->list[i].ms == p->list[i].as_is_ms);
    }
    free(p->list);
    free(p);
    dip_cost_report_free(&report);
}

// Where all takes as long as in the report, but the six times are uncertain by 8 %.
static void uncertain_times_elsewhere_do_not_mislead(void **state) {
    (void)state;
    DipCostReport report;
    make_report(&report, courtyard_flip, 0.01, 1);
    DipCostElsewherePrediction *p = predict_there(&report, 6, 30, 1.0, 0.08);
    if (!(p->from_report && p->checked_fitted.p90 < 0.03)) {
        fail_msg("checked %.4f alone and %.4f, left out %.4f, by report %.4f", p->checked_as_is.p90,
                 p->checked_fitted.p90, p->timed_left_out.median, p->timed_as_is.median);
    }
    for (int i = 0; i < COMBINATIONS; i++) {
        assert_true(p->list[i].ms == p->list[i].as_is_ms);
    }
    free(p->list);
    free(p);
    dip_cost_report_free(&report);
}

// Where nothing differs from the report, six uncertain times are only six more rows.
static void times_at_the_same_place_count_like_rows(void **state) {
    (void)state;
    DipCostReport report;
    make_report(&report, courtyard_flip, 0.01, 1);
    DipCostElsewherePrediction *p = predict_there(&report, 6, 0, 1.0, 0.08);
    double p90[2];
    for (int same_place = 0; same_place < 2; same_place++) {
        double misses[COMBINATIONS];
        const DipCostModel model =
            dip_cost_model_fit_there(&report, NULL, report.row_count, p->timed, 6, same_place);
        for (int i = 0; i < COMBINATIONS; i++) {
            DipCostElsewhere there;
            make_times_there(&report.rows[i], 1.0, &there);
            misses[i] =
                fabs(dip_cost_model_value(&model, there.counters, &there.quality) / there.ms.value -
                     1.0);
        }
        p90[same_place] = dip_cost_misses_of(misses, COMBINATIONS).p90;
    }
    if (!(p90[1] < 0.03 && p90[0] > 0.04)) {
        fail_msg("p90 %.4f like rows, %.4f elsewhere", p90[1], p90[0]);
    }
    const double left_out = p->timed_left_out.median;
    p->there.threads = report.threads;
    dip_cost_predict_and_judge_there(p);
    if (!(p->timed_left_out.median < 0.09 && left_out > 0.1)) {
        fail_msg("left out: %.4f here, %.4f elsewhere", p->timed_left_out.median, left_out);
    }
    for (int i = 0; i < COMBINATIONS; i++) {
        assert_true(fabs(p->list[i].ms / p->list[i].as_is_ms - 1.0) < 0.03);
    }
    free(p->list);
    free(p);
    dip_cost_report_free(&report);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(times_follow_from_work),
        cmocka_unit_test(posed_vertices_have_a_price),
        cmocka_unit_test(averaging_parts_of_pixels_has_a_price),
        cmocka_unit_test(flip_follows_from_settings),
        cmocka_unit_test(leaving_one_out_does_not_promise_too_much),
        cmocka_unit_test(the_front_is_found),
        cmocka_unit_test(counters_are_scaled_to_the_timed_frames),
        cmocka_unit_test(a_smaller_size_tells_the_prices_of_others),
        cmocka_unit_test(six_times_elsewhere_tell_all_others),
        cmocka_unit_test(uncertain_times_elsewhere_do_not_mislead),
        cmocka_unit_test(times_at_the_same_place_count_like_rows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
