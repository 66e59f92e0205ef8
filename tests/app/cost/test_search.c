// Tests the choice among all combinations: how many there are, which are kept, which settings are
// dropped; and what the user is told meanwhile: that the machine is busy, and the time left.
#include "app/cli/log.h"
#include "app/cli/progress.h"
#include "app/cost/steps.h"
#include "app/report/combinations.h"
#include "app/report/format/formats.h"
#include "renderer/base/clock.h"
#include "renderer/catalogue/random.h"
#include "tests/app/cost/made_report.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#define BIT(NAME) (1u << DIP_SETTING_##NAME)

static const unsigned all_settings = ((1u << DIP_SETTING_COUNT) - 1) & ~BIT(MIPDEBUG);
static const unsigned some_settings =
    BIT(AA) | BIT(AAA) | BIT(ASD) | BIT(AF) | BIT(POST) | BIT(SCALE) | BIT(UPSCALE) | BIT(SHADOWS);

// --- how many ------------------------------------------------------------------------------------

static void combinations_are_counted_without_a_list(void **state) {
    (void)state;
    const unsigned masks[] = {0, BIT(AF), BIT(AF) | BIT(AAF), BIT(MIPDEBUG) | BIT(OPT),
                              some_settings};
    const DipQuality baseline = dip_quality_default();
    for (size_t i = 0; i < sizeof masks / sizeof *masks; i++) {
        assert_int_equal(dip_cost_count_combinations_of(&baseline, masks[i]),
                         dip_cost_list_combinations(&baseline, masks[i], NULL, 0));
    }
    // Samples 65 (none: history or not; 2: 4, 4: 5, 6 and 8: 6 kinds of adaptive AA, each with 3
    // of temporal AA), filtering 1 + 4 * 2, opt 3, miplod 6, scale 4 + 4 * 3, post 3, sharpen 4,
    // shadows 4, instancing 2.
    assert_int_equal(dip_cost_count_combinations_of(&baseline, all_settings),
                     (2 + 3 * (4 + 5 + 6 + 6)) * 9 * 3 * 6 * 16 * 3 * 4 * 4 * 2);
}

// --- what is kept --------------------------------------------------------------------------------

// Every group of settings multiplies the work by a factor of its own, but which triangles of a fine
// mesh are drawn follows from antialiasing and render scale together.
static void make_work(const DipQuality *quality, double *counters) {
    const uint8_t *step = quality->step;
    const double scale = dip_quality_scale(quality);
    const double samples = dip_quality_sample_count(quality);
    const double probes = 1.0 + 0.5 * step[DIP_SETTING_AF];
    memset(counters, 0, DIP_COUNTER_COUNT * sizeof *counters);
    const double density = samples * scale * scale;
    counters[DIP_COUNTER_triangles_in] = 2e4;
    counters[DIP_COUNTER_triangles_drawn] = 2e4 * density / (1.0 + density);
    counters[DIP_COUNTER_samples_shown] = 3e5 * samples * scale * scale;
    counters[DIP_COUNTER_fragments_shaded] = 3e5 * scale * scale;
    counters[DIP_COUNTER_fragments_clip_tested] =
        4e4 * scale * scale * (1.0 + step[DIP_SETTING_AAA]);
    counters[DIP_COUNTER_texture_probes] = 3e5 * scale * scale * probes;
    counters[DIP_COUNTER_texels_fetched] =
        2e6 * scale * scale * probes * (1.0 + 0.1 * step[DIP_SETTING_MIPLOD]);
    counters[DIP_COUNTER_shadow_texels] = 1e5 * step[DIP_SETTING_SHADOWS];
    counters[DIP_COUNTER_pixels_filtered] = 3e5 * dip_cost_pixels_filtered(quality);
    counters[DIP_COUNTER_edges_found] = 1e5 * step[DIP_SETTING_POST] * scale;
}

// Measures some of the listed combinations: those of one group, and every tenth other one.
static void measure_some(DipCostReport *report, uint64_t seed) {
    DipCostModel times = {.rows = 1};
    Random random = {seed};
    for (int stage = 0; stage < DIP_COST_STAGE_COUNT; stage++) {
        for (int t = 0; t < dip_cost_term_count(stage); t++) {
            times.prices[stage][t] = random_real(&random, 0.0, 2e-6);
        }
    }
    for (int i = 0; i < report->predicted.count; i++) {
        DipCostPrediction *p = &report->predicted.list[i];
        if (dip_work_count_groups(&report->options.baseline, &p->quality) > 1 && i % 10) {
            continue;
        }
        p->row = dip_cost_report_add_row(report, &p->quality, 0, NULL);
        assert_true(p->row >= 0);
        DipCostRow *row = &report->rows[p->row];
        memcpy(row->counters, p->counters, sizeof row->counters);
        double ms = 0.0;
        for (int stage = 0; stage < DIP_COST_STAGE_COUNT; stage++) {
            row->stage_ms[stage] = dip_cost_sum_terms(
                stage, stage + 1, (const double(*)[DIP_COST_MAX_TERMS])times.prices, row->counters,
                &row->quality);
            ms += row->stage_ms[stage];
        }
        ms *= random_real(&random, 0.95, 1.05);
        row->time = (DipPathEstimate){.mean_ms = dip_estimate_make(ms, 0.004, 15.0),
                                      .p95_ms = dip_estimate_make(1.2 * ms, 0.004, 15.0)};
        row->viewpoints[0].regions[0].pixels = 1.0;
        row->viewpoints[0].regions[0].flip = random_real(&random, 0.01, 0.02);
        for (int s = 0; s < DIP_SETTING_COUNT; s++) {
            row->viewpoints[0].regions[0].flip *= 1.0 + 0.1 * p->quality.step[s] / (1 + s % 3);
        }
        row->judged[0] = true;
    }
}

static const double *find_listed(const void *context, const DipQuality *quality) {
    const DipCostReport *report = context;
    const DipQuality *base = &report->options.baseline;
    const bool is_part =
        dip_work_count_groups(base, quality) <= 1 || dip_work_is_corner(base, quality);
    const int found = is_part ? dip_report_find_predicted(&report->predicted, quality) : -1;
    return found >= 0 ? report->predicted.list[found].counters : NULL;
}

static void make_report(DipCostReport *report, unsigned combined) {
    *report = (DipCostReport){.path_count = 1};
    report->options = (DipCostOptions){.baseline = dip_quality_default(),
                                       .places = 1,
                                       .rounds = 2,
                                       .timed_frames = 1,
                                       .combined = combined};
    report->rows = calloc(DIP_COST_MAX_ROWS, sizeof *report->rows);
    assert_non_null(report->rows);
    assert_true(dip_cost_report_alloc(report, NULL));
    assert_true(dip_cost_list_predictions(report, NULL));
    for (int i = 0; i < report->predicted.count; i++) {
        make_work(&report->predicted.list[i].quality, report->predicted.list[i].counters);
    }
}

// The search is asked about combinations of eight settings, and the same combinations are predicted
// one by one: what it keeps is as good, for each budget and along the whole front.
static void the_search_finds_the_best_of_all(void **state) {
    (void)state;
    static DipQuality list[1 << 17];
    DipCostReport report;
    for (uint64_t seed = 1; seed <= 3; seed++) {
        DipCostModels models;
        make_report(&report, some_settings);
        const int count =
            dip_cost_list_combinations(&report.options.baseline, some_settings, list, 1 << 17);
        assert_true(count > DIP_COST_MAX_ROWS && count <= 1 << 17);
        int corners = 0;
        for (int i = 0; i < report.predicted.count; i++) {
            corners +=
                dip_work_is_corner(&report.options.baseline, &report.predicted.list[i].quality);
        }
        assert_int_equal(
            corners, (4 + 2) * 7); // the other steps of AA and of post, times those of the scale
        assert_int_equal(report.predicted.searched, count);
        measure_some(&report, seed);
        const double base_ms = dip_cost_ms(&report, 0);
        report.options.budgets_ms[0] = 1.5 * base_ms;
        report.options.budgets_ms[1] = 4.0 * base_ms;
        report.options.budget_count = 2;
        const int before = report.predicted.count, measured = report.row_count;
        assert_true(dip_cost_models_of(&report, &models, NULL));
        assert_true(dip_cost_search(&report, NULL, &models, NULL));
        assert_true(report.predicted.count > before);
        assert_true(dip_cost_predict_others(&report, &models, NULL));
        double best[2] = {0.0}, found[2] = {0.0};
        for (int i = 0; i < count; i++) {
            double counters[DIP_COUNTER_COUNT], values[DIP_COST_PREDICTED];
            int distances[DIP_COST_MAX_ROWS];
            bool is_measured = false;
            for (int r = 0; r < measured; r++) {
                is_measured |= dip_quality_equal(&list[i], &report.rows[r].quality);
            }
            if (is_measured || i % 7) { // One of seven, since this takes long.
                continue;
            }
            assert_true(dip_work_compose(find_listed, &report, &report.options.baseline, &list[i],
                                         counters));
            dip_flip_model_distances(&models.flip, &list[i], distances);
            dip_cost_predict_one(&models, counters, &list[i], distances, values);
            bool is_matched = false;
            for (int k = 0; k < report.predicted.count && !is_matched; k++) {
                const DipCostPrediction *p = &report.predicted.list[k];
                is_matched = p->row < 0 && p->ms <= 1.021 * values[DIP_COST_PREDICTED_MS] &&
                             p->flip <= 1.011 * values[DIP_COST_PREDICTED_FLIP] + 1e-12;
            }
            assert_true(is_matched);
            const double error = dip_flip_model_error(&models.flip, distances);
            for (int b = 0; b < 2; b++) {
                const DipCostAim aim = dip_cost_aim(&report, b);
                best[b] = fmax(best[b], dip_cost_gain(&aim, values[DIP_COST_PREDICTED_P95],
                                                      values[DIP_COST_PREDICTED_FLIP], error));
            }
        }
        for (int k = 0; k < report.predicted.count; k++) { // it may have been listed before
            const DipCostPrediction *p = &report.predicted.list[k];
            int distances[DIP_COST_MAX_ROWS];
            dip_flip_model_distances(&models.flip, &p->quality, distances);
            const double error = dip_flip_model_error(&models.flip, distances);
            for (int b = 0; b < 2 && p->row < 0; b++) {
                const DipCostAim aim = dip_cost_aim(&report, b);
                found[b] = fmax(found[b], dip_cost_gain(&aim, p->p95_ms, p->flip, error));
            }
        }
        assert_true(best[0] >= DIP_COST_LEAST_GAIN && best[1] >= DIP_COST_LEAST_GAIN);
        assert_true(found[0] >= best[0] - 1e-12 && found[1] >= best[1] - 1e-12);
        dip_cost_models_free(&models);
        dip_cost_report_free(&report);
    }
}

static void combinations_that_fit_a_list_are_all_listed(void **state) {
    (void)state;
    DipCostReport report;
    const unsigned few = BIT(AA) | BIT(AF) | BIT(SCALE);
    make_report(&report, few);
    assert_int_equal(report.predicted.count, 5 * 5 * 8);
    assert_int_equal(report.predicted.searched, 5 * 5 * 8);
    dip_cost_report_free(&report);
}

// --- what is dropped -----------------------------------------------------------------------------

static void settings_that_change_no_picture_are_dropped(void **state) {
    (void)state;
    DipCostReport report = {.path_count = 1};
    report.options =
        (DipCostOptions){.baseline = dip_quality_default(), .places = 2, .combined = all_settings};
    report.rows = calloc(DIP_COST_MAX_ROWS, sizeof *report.rows);
    assert_non_null(report.rows);
    assert_true(dip_cost_report_alloc(&report, NULL));
    const DipSetting settings[] = {DIP_SETTING_AA, DIP_SETTING_AAA, DIP_SETTING_SHADOWS};
    for (int s = 0; s < 3; s++) {
        DipCostSweep *sweep = &report.sweeps[report.sweep_count++];
        *sweep = (DipCostSweep){.setting = settings[s]};
        for (int step = 0; step < 3; step++) {
            DipQuality quality = report.options.baseline;
            quality.step[settings[s]] = (uint8_t)step;
            const int row = dip_cost_report_add_row(&report, &quality, 0, NULL);
            sweep->base = step == 0 ? row : sweep->base;
            sweep->rows[sweep->row_count++] = row;
            for (int p = 0; p < 2; p++) {
                report.rows[row].judged[p] = true;
                // The last step of AA changes one picture. The others change none.
                const bool changes = s == 0 && step == 2 && p == 1;
                snprintf(report.rows[row].pictures[p], 33, changes ? "other" : "same");
            }
        }
    }
    dip_cost_drop_idle_settings(&report);
    assert_int_equal(report.options.combined, all_settings & ~(BIT(AAA) | BIT(ASD) | BIT(SHADOWS)));
    dip_cost_report_free(&report);
}

// --- what the user is told -----------------------------------------------------------------------

static int count_in_file(const char *file, const char *text) {
    char line[1024];
    int count = 0;
    FILE *in = fopen(file, "r");
    assert_non_null(in);
    while (fgets(line, sizeof line, in)) {
        count += strstr(line, text) != NULL;
    }
    fclose(in);
    return count;
}

static void a_busy_machine_is_told_once(void **state) {
    (void)state;
    const char *const log = "test_search.log";
    DipCostReport report = {.threads = 2};
    remove(log);
    assert_true(dip_log_open(log, NULL));
    const double shares[] = {0.09, 0.19, 0.50};
    const char *const texts[] = {NULL, "less exact", "wrong and no settings will be advised"};
    for (int i = 0; i < 3; i++) {
        DipCostContext cost = {.report = &report};
        const DipTimed timed[2] = {{.ms = 1.0, .wait = 0.0},
                                   {.ms = 3.0, .wait = shares[i] * 4 / 3}};
        const int before = count_in_file(log, "the machine is busy");
        dip_cost_look_at_times(&cost, timed, 2);
        dip_cost_look_at_times(&cost, timed, 2); // Not again.
        assert_int_equal(count_in_file(log, "the machine is busy") - before, texts[i] != NULL);
        assert_true(!texts[i] || count_in_file(log, texts[i]) == 1);
    }
    assert_int_equal(count_in_file(log, "Close other programs"), 2);
    assert_int_equal(count_in_file(log, "--quick"), 2);
    dip_log_close();
    remove(log);
}

// Shows the progress of a part that has run 10 s and done some of 100 things. Returns the text.
static const char *show_progress(int done) {
    static char text[256];
    const char *const file = "test_search.txt";
    DipProgress progress = dip_progress_begin("things", 100);
    progress.terminal = false;
    progress.begin_ns = dip_clock_ns() - INT64_C(10000000000);
    progress.shown_ns = 0;
    fflush(stderr);
    const int kept = dup(STDERR_FILENO);
    assert_non_null(freopen(file, "w", stderr));
    dip_progress_show(&progress, done);
    fflush(stderr);
    assert_true(dup2(kept, STDERR_FILENO) >= 0);
    close(kept);
    FILE *in = fopen(file, "r");
    assert_non_null(in);
    text[0] = '\0';
    assert_non_null(fgets(text, sizeof text, in));
    fclose(in);
    remove(file);
    return text;
}

static void the_time_left_is_that_of_the_whole_run(void **state) {
    (void)state;
    dip_progress_expect(0.0, 0.0);
    assert_string_equal(show_progress(50), "50 of 100 things, 10 s left\n");
    dip_progress_expect(0.0, 40.0);
    assert_string_equal(show_progress(50), "50 of 100 things, about 50 s left in all\n");
    dip_progress_expect(0.0, 290.0);
    assert_string_equal(show_progress(50), "50 of 100 things, about 5 min left in all\n");
    // At first the expectation counts: 10 s for one of 100 things do not mean 990 s for the others.
    dip_progress_expect(20.0, 40.0);
    assert_string_equal(show_progress(1), "1 of 100 things, about 4 min left in all\n");
    assert_string_equal(show_progress(1), "1 of 100 things, about 17 min left in all\n");
    dip_progress_expect(20.0, 40.0);
    assert_string_equal(show_progress(50), "50 of 100 things, about 50 s left in all\n");
    dip_progress_expect(0.0, 0.0);
}

// Returns the seconds of all phases after this one.
static double later_than(DipCostContext *cost, DipCostPhase phase) {
    return dip_cost_begin_phase(cost, phase);
}

static void each_phase_forecasts_less_than_the_one_before(void **state) {
    (void)state;
    DipCostReport report = {.threads = 2, .width = 640, .height = 480, .path_count = 1};
    report.row_count = 45;
    report.options = (DipCostOptions){.baseline = dip_quality_default(),
                                      .places = 3,
                                      .burst = 2,
                                      .rounds = 16,
                                      .starts = 4,
                                      .timed_frames = 4,
                                      .predict = true,
                                      .combined = all_settings,
                                      .budgets_ms = {16.7},
                                      .budget_count = 1};
    DipCostContext cost = {.report = &report, .baseline_ms = 4.0};
    dip_cost_forecast_begin(&cost);
    double before = INFINITY;
    for (int p = 0; p < DIP_COST_PHASE_COUNT; p++) {
        const double later = later_than(&cost, (DipCostPhase)p);
        assert_true(later < before || p == DIP_COST_PHASE_COUNT - 1);
        before = later;
    }
    assert_true(before == 0.0);
    // Each go that is done leaves one less.
    const double first = later_than(&cost, DIP_COST_PHASE_BEST_ERRORS);
    cost.forecast.goes = 1;
    assert_true(later_than(&cost, DIP_COST_PHASE_BEST_ERRORS) < first);
    // In the last go, no other one is expected, however few rounds there are.
    for (int rounds = 6; rounds <= 16; rounds += 10) {
        report.options.rounds = rounds;
        cost.forecast.goes = dip_cost_most_goes(&report.options) - 1;
        assert_true(later_than(&cost, DIP_COST_PHASE_BEST_TIMES) ==
                    later_than(&cost, DIP_COST_PHASE_MORE_BEST));
    }
    // Pictures that take longer to judge than was guessed make the whole run longer.
    const double guessed = later_than(&cost, DIP_COST_PHASE_TRUTHS);
    cost.forecast.picture_s *= 2.0;
    assert_true(later_than(&cost, DIP_COST_PHASE_TRUTHS) > guessed);
    // Without times, only errors are left.
    report.options.errors_only = true;
    report.options.predict = false;
    assert_true(later_than(&cost, DIP_COST_PHASE_TRUTHS) > 0.0);
    assert_true(later_than(&cost, DIP_COST_PHASE_SWEEPS) == 0.0);
    dip_progress_expect(0.0, 0.0);
}

// Makes a report of three measured combinations, of which 5000000 more were predicted, and returns
// what is printed of it. The fastest takes `ms`, and each other one 1 ms more. `wait` is the share
// of the time that the threads waited for a core.
static char *print_answer(bool predicted, double wait, double ms) {
    static char text[1 << 16];
    const char *const file = "test_search.txt";
    DipCostReport report;
    dip_made_report(&report, 4);
    report.machine.wait = wait;
    report.options.budgets_ms[0] = 1000.0 / 60.0;
    const char *const sets[] = {"aa=none", "aa=4", "aa=4,af=16"};
    for (int i = 0; i < 3; i++) {
        DipQuality quality;
        assert_true(dip_quality_parse(sets[i], &quality, NULL));
        dip_made_combination(&report, &quality, ms + i, 0.05 - 0.01 * i);
    }
    if (!predicted) {
        report.predicted.count = 0;
    } else {
        free(report.predicted.list);
        report.predicted = (DipCostPredictions){
            .list = calloc(2, sizeof *report.predicted.list), .count = 2, .searched = 5000000};
        assert_non_null(report.predicted.list);
        assert_true(
            dip_quality_parse("aa=8,af=8,scale=2", &report.predicted.list[0].quality, NULL));
        assert_true(dip_quality_parse("opt=standard", &report.predicted.list[1].quality, NULL));
        // This setting was swept and then not combined.
        report.sweeps[report.sweep_count++] =
            (DipCostSweep){.setting = DIP_SETTING_SHADOWS, .rows = {0}, .row_count = 1};
    }
    assert_true(dip_cost_estimate_times(&report, NULL));
    FILE *out = fopen(file, "w");
    assert_non_null(out);
    dip_cost_print(&report, out);
    fclose(out);
    FILE *in = fopen(file, "r");
    assert_non_null(in);
    text[fread(text, 1, sizeof text - 1, in)] = '\0';
    fclose(in);
    remove(file);
    dip_cost_report_free(&report);
    return text;
}

static void assert_has(const char *text, const char *part) {
    if (!strstr(text, part)) {
        fail_msg("'%s' is not in\n%s", part, text);
    }
}

static void the_answer_says_what_was_searched(void **state) {
    (void)state;
    const char *text = print_answer(true, 0.0, 2.0);
    assert_true(strncmp(text, "At 60 frames a second (16.7 ms) on this machine:\n", 49) == 0);
    assert_has(text,
               "  Best of        5000000 combinations of 4 settings: all predicted, 3 measured\n");
    assert_has(text, "  Not combined   shadows: no step changes a picture here\n");
    text = print_answer(false, 0.0, 2.0);
    assert_has(text, "  Best of        3 combinations of 2 settings: all measured\n");
    assert_null(strstr(text, "Not combined"));
}

static void a_busy_machine_gets_no_times_but_errors(void **state) {
    (void)state;
    const char *text = print_answer(true, 0.9, 2.0);
    assert_true(strncmp(text, "No advice:\n", 11) == 0);
    assert_has(text, "What to do: close other programs");
    assert_has(text, "--quick");
    // The front has the errors, without times.
    char *front = strstr(text, "Combinations from the fastest");
    assert_non_null(front);
    *strstr(front, "\n\n") = '\0';
    assert_has(front, "aa=4,af=16");
    assert_has(front, ".03");
    assert_null(strstr(front, "ms"));
    assert_null(strstr(text, "Line for ini"));
}

// 16.666 ms are within 16.667 ms. With two digits, both the answer and the front would show 16.67.
static void no_time_is_rounded_across_the_budget(void **state) {
    (void)state;
    const char *text = print_answer(true, 0.0, 16.666);
    assert_null(strstr(text, "16.67"));
    const char *answer = strstr(text, "16.666 ms");
    assert_non_null(answer);
    assert_non_null(strstr(answer + 1, "16.666"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(combinations_are_counted_without_a_list),
        cmocka_unit_test(the_search_finds_the_best_of_all),
        cmocka_unit_test(combinations_that_fit_a_list_are_all_listed),
        cmocka_unit_test(settings_that_change_no_picture_are_dropped),
        cmocka_unit_test(a_busy_machine_is_told_once),
        cmocka_unit_test(the_answer_says_what_was_searched),
        cmocka_unit_test(no_time_is_rounded_across_the_budget),
        cmocka_unit_test(a_busy_machine_gets_no_times_but_errors),
        cmocka_unit_test(the_time_left_is_that_of_the_whole_run),
        cmocka_unit_test(each_phase_forecasts_less_than_the_one_before),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
