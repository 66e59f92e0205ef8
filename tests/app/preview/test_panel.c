// Tests of the panel's lines of times, errors and work, and of the costs and advice that come from
// a cost report.
#include "app/report/format/formats.h"
#include "app/preview/live/panel.h"
#include "app/preview/state/state.h"
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

static DipPaneFigures figures;
static DipPanelLine lines[DIP_PANEL_MAX_LINES];
static int line_count;

static const char *value_of(int pane, const char *name) {
    line_count = dip_panel_lines(&figures, pane, lines);
    assert_true(line_count <= DIP_PANEL_MAX_LINES);
    for (int i = 0; i < line_count; i++) {
        if (strcmp(lines[i].name, name) == 0) {
            return lines[i].value;
        }
    }
    return "";
}

static int set_up(void **state) {
    (void)state;
    figures = (DipPaneFigures){
        .ms = 10.0,
        .stage_ms = {1.0, 2.0, 5.0, 2.0},
        .counters = {.fragments_shaded = 99999, .texels_fetched = 1234567, .triangles_in = 123456},
    };
    return 0;
}

static void the_panel_shows_times_and_work(void **state) {
    (void)state;
    assert_string_equal(value_of(0, "Frame"), "10.0 ms");
    assert_string_equal(value_of(0, "Geometry"), "1.00 ms  10 %");
    assert_string_equal(value_of(0, "Shading"), "5.00 ms  50 %");
    assert_string_equal(value_of(0, "Fragments shaded"), "99999");
    assert_string_equal(value_of(0, "Triangles submitted"), "123.5 k");
    assert_string_equal(value_of(0, "Texels read"), "1.23 M");
}

static void the_panel_shows_errors_at_rest(void **state) {
    (void)state;
    DipErrorReading *errors = &figures.errors;
    errors->result.panes[1] = (DipPaneError){.rmse_lin = .0123, .psnr_db = 31.26, .flip = .0475};
    assert_string_equal(value_of(1, "Error"), "pause to measure");
    assert_string_equal(value_of(1, "FLIP"), "");
    errors->status = DIP_ERROR_STATUS_WORKING;
    assert_string_equal(value_of(1, "Error"), "measuring");
    assert_string_equal(value_of(1, "FLIP"), "");
    errors->result.samples = 8;
    assert_string_equal(value_of(1, "Error"), "refining: 8 of 128 samples");
    assert_string_equal(value_of(1, "RMSE, linear"), "0.0123");
    assert_string_equal(value_of(1, "PSNR"), "31.3 dB");
    assert_string_equal(value_of(1, "FLIP"), "0.0475");
    errors->result.panes[1].at_floor = true;
    assert_string_equal(value_of(1, "RMSE, linear"), "0.0123 at floor so far");
    errors->result.samples = 128;
    errors->result.last = true;
    errors->result.panes[1].at_floor = true;
    errors->result.panes[1].psnr_db = INFINITY;
    assert_string_equal(value_of(1, "Error"), "128 samples");
    assert_string_equal(value_of(1, "RMSE, linear"), "0.0123 at floor");
    assert_string_equal(value_of(1, "PSNR"), "no difference");
    assert_string_equal(value_of(0, "RMSE, linear"), "0.0000");
    errors->status = DIP_ERROR_STATUS_FAILED;
    assert_string_equal(value_of(1, "Error"), "not enough memory");
}

// Mip colours are no picture of the scene, so the panel says why they have no error.
static void mip_colours_have_no_error(void **state) {
    (void)state;
    figures.errors.status = DIP_ERROR_STATUS_DONE;
    figures.errors.result.samples = 128;
    figures.mip_colours = true;
    assert_string_equal(value_of(1, "Error"), "none, since mip colours show");
    assert_string_equal(value_of(1, "FLIP"), "");
    figures.mip_colours = false;
    assert_string_equal(value_of(1, "FLIP"), "0.0000");
    figures.errors.result.panes[1].unjudged = true;
    assert_string_equal(value_of(1, "Error"), "none, since mip colours show");
    assert_string_equal(value_of(0, "FLIP"), "0.0000");
}

// A pane that shows a copy has errors, but neither times nor work.
static void a_copy_has_errors_only(void **state) {
    (void)state;
    figures.copied = true;
    figures.errors.status = DIP_ERROR_STATUS_DONE;
    figures.errors.result.samples = 32;
    assert_string_equal(value_of(1, "Frame"), "copied: same settings");
    assert_string_equal(value_of(1, "Geometry"), "");
    assert_string_equal(value_of(1, "Texels read"), "");
    assert_string_equal(value_of(1, "FLIP"), "0.0000");
}

static void the_preview_rests_when_nothing_moves(void **state) {
    (void)state;
    DipPreviewState preview = {0};
    assert_false(dip_preview_rests(&preview, false));
    preview.paused = true;
    assert_true(dip_preview_rests(&preview, false));
    preview.manual = true;
    assert_false(dip_preview_rests(&preview, true));
    preview.paused = false;
    assert_true(dip_preview_rests(&preview, false));
}

static double flip_of(const DipCostReport *report, int row) {
    int places;
    const DipMetricSums sums = dip_cost_row_sums(report, row, &places);
    return dip_metrics_of(&sums, 0).flip;
}

// Row r of the made-up report takes r + 1 ms; its sweep has rows 0, 2 and 3.
static void steps_show_their_time_and_change_of_flip(void **state) {
    (void)state;
    DipCostReport report;
    DipCosts costs;
    char expected[48];
    dip_made_report(&report, 3);
    dip_costs_make(&costs, &report);
    assert_string_equal(costs.heading, "made up, 64x48, 2 threads, scalar");
    assert_int_equal(costs.row_count, 1);
    assert_string_equal(costs.rows[0].title, "Antialiasing");
    assert_int_equal(costs.rows[0].step_count, 3);
    assert_string_equal(costs.rows[0].steps[2].name, "4");
    assert_memory_equal(costs.rows[0].steps[0].figures, "1x .", 4);
    const double change = flip_of(&report, 3) - flip_of(&report, 0);
    snprintf(expected, sizeof expected, "%.4f", fabs(change));
    assert_memory_equal(costs.rows[0].steps[2].figures, "4.00x -", 7);
    assert_true(change < 0.0);
    assert_string_equal(costs.rows[0].steps[2].figures + 7,
                        expected[0] == '0' ? expected + 1 : expected);
    DipQuality quality = dip_quality_default();
    assert_true(dip_costs_is_at(&costs.rows[0], 0, &quality));
    assert_false(dip_costs_is_at(&costs.rows[0], 2, &quality));
    dip_cost_report_free(&report);
}

static void a_report_of_another_scene_is_refused(void **state) {
    (void)state;
    DipCostReport report;
    DipCosts costs;
    DipError err = {0};
    char file[] = "/tmp/test_panel.XXXXXX";
    const int descriptor = mkstemp(file);
    assert_true(descriptor >= 0);
    close(descriptor);
    dip_made_report(&report, 3);
    assert_true(dip_cost_write_json(&report, file, &err));
    assert_true(dip_costs_load(&costs, NULL, file, "made up", &err));
    assert_int_equal(costs.row_count, 1);
    assert_false(dip_costs_load(&costs, NULL, file, "other", &err));
    assert_int_equal(err.code, DIP_ERROR_CONFLICT);
    remove(file);
    dip_cost_report_free(&report);
}

static void advice_sets_the_requested_pane(void **state) {
    (void)state;
    DipCostReport report;
    DipCosts costs;
    dip_made_report(&report, 3);
    report.advice[1] = (DipCostAdvice){.budget_ms = 1.0, .row = -1};
    report.advice_count = 2;
    dip_costs_make(&costs, &report);
    DipPreviewState preview = {0};
    dip_preview_act(&preview, DIP_ACTION_ADVICE, 0, false, 0);
    assert_non_null(strstr(preview.notice, "No cost report"));
    assert_int_equal(preview.scene_changes, 0);
    preview.costs = &costs;
    dip_preview_act(&preview, DIP_ACTION_ADVICE, 0, false, 0);
    assert_non_null(strstr(preview.notice, "Within 16.6 ms: 3.0 ms, FLIP "));
    assert_memory_equal(&preview.quality[DIP_PANE_REQUESTED], &report.rows[2].quality,
                        sizeof(DipQuality));
    assert_int_equal(preview.scene_changes, 1);
    dip_preview_act(&preview, DIP_ACTION_ADVICE, 0, false, 0);
    assert_string_equal(preview.notice, "Nothing measured is within 1 ms");
    assert_int_equal(preview.scene_changes, 1);
    dip_preview_act(&preview, DIP_ACTION_ADVICE, 0, true, 0);
    assert_int_equal(preview.scene_changes, 2);
    dip_cost_report_free(&report);
}

// A report without budgets gives advice for 16.6 ms.
static void the_default_budget_is_16_6_ms(void **state) {
    (void)state;
    DipCostReport report;
    DipCosts costs;
    dip_made_report(&report, 3);
    report.advice_count = 0;
    report.combined_first = 2;
    report.rows[2].quality = report.options.baseline;
    memset(report.rows[4].judged, false, (size_t)report.options.places); // not a combination
    report.rows[4].quality.step[DIP_SETTING_AF] = 1;
    dip_costs_make(&costs, &report);
    assert_int_equal(costs.advice_count, 1);
    assert_true(costs.advice[0].budget_ms == 16.6 && costs.advice[0].found);
    // Both combinations are fast enough; the one of 4 ms has less error.
    assert_true(costs.advice[0].ms == 4.0);
    char text[160];
    dip_costs_describe(&costs, 0, text, sizeof text);
    assert_non_null(strstr(text, "; baseline 3.0 ms, "));
    dip_cost_report_free(&report);
}

// Times that other programs disturbed choose nothing, whatever they seem to fit.
static void red_report_advises_nothing(void **state) {
    (void)state;
    DipCostReport report;
    DipCosts costs;
    dip_made_report(&report, 3);
    report.advice_count = 0;
    report.combined_first = 2;
    report.verdict = DIP_COST_RED;
    dip_costs_make(&costs, &report);
    for (int i = 0; i < costs.advice_count; i++) {
        assert_false(costs.advice[i].found);
    }
    dip_cost_report_free(&report);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(the_panel_shows_times_and_work, set_up),
        cmocka_unit_test_setup(the_panel_shows_errors_at_rest, set_up),
        cmocka_unit_test_setup(mip_colours_have_no_error, set_up),
        cmocka_unit_test_setup(a_copy_has_errors_only, set_up),
        cmocka_unit_test(the_preview_rests_when_nothing_moves),
        cmocka_unit_test(steps_show_their_time_and_change_of_flip),
        cmocka_unit_test(a_report_of_another_scene_is_refused),
        cmocka_unit_test(advice_sets_the_requested_pane),
        cmocka_unit_test(the_default_budget_is_16_6_ms),
        cmocka_unit_test(red_report_advises_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
