// Tests of the panel's lines of times, errors, work and effects, and of the costs and advice that
// come from a cost report.
#include "app/report/format/formats.h"
#include "app/preview/live/figures.h"
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
    assert_string_equal(value_of(0, "Frame, last second"), "10.0 ms");
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

// The reasons are those of the plan (renderer/scene/plan/plan.c).
static void the_panel_says_which_effects_ran(void **state) {
    (void)state;
    const DipEffect none = {false, "the scene has no metallic-roughness surface"};
    const DipEffect hidden = {false, "no fragment of it is visible"};
    char text[DIP_EFFECTS_TEXT_BYTES] = "untouched";
    dip_effects_text(&figures.effects, text);
    assert_string_equal(text, ""); // No frame has been drawn yet.
    assert_string_equal(value_of(0, "Effects that ran"), "0");
    figures.effects = (DipEffects){.reflection = {true, "water is in view"},
                                   .alpha_clip = hidden,
                                   .adaptive_aa = {false, "aaa is off"},
                                   .lights = hidden,
                                   .pbr = none,
                                   .coat = none,
                                   .sky = {true, "sky is in view"}};
    dip_effects_text(&figures.effects, text);
    assert_string_equal(text, "Effects that ran: reflection, clouds\n"
                              "alpha clip, lights: no fragment of it is visible\n"
                              "adaptive AA: aaa is off");
    assert_string_equal(value_of(0, "Effects that ran"), "2");
    figures.effects.reflection = figures.effects.sky = hidden;
    dip_effects_text(&figures.effects, text);
    assert_string_equal(text,
                        "reflection, alpha clip, lights, clouds: no fragment of it is visible\n"
                        "adaptive AA: aaa is off");
}

// A text of all effects, each with a reason of its own, is cut to its room.
static void a_text_of_all_effects_is_cut_to_its_room(void **state) {
    (void)state;
    static char whys[64][80];
    int count = 0;
    struct {
        char text[DIP_EFFECTS_TEXT_BYTES];
        char guard[4];
    } room = {.guard = "end"};
#define SKIP(name, title)                                                                          \
    memset(whys[count], 'a' + count, sizeof whys[count] - 1);                                      \
    figures.effects.name = (DipEffect){false, whys[count++]};
    DIP_EFFECT_LIST(SKIP)
#undef SKIP
    dip_effects_text(&figures.effects, room.text);
    assert_int_equal(strlen(room.text), sizeof room.text - 1);
    assert_string_equal(room.guard, "end");
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
    assert_string_equal(value_of(1, "Effects that ran"), "");
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
    char expected[48], heading[DIP_COSTS_HEADING];
    dip_made_report(&report, 3);
    const DipCostsRow row = dip_costs_row(&report, &report.sweeps[0]);
    dip_costs_heading(&report, heading);
    assert_string_equal(heading, "made up, 64x48, 2 threads, scalar");
    assert_int_equal(report.sweep_count, 1);
    assert_string_equal(row.title, "Antialiasing");
    assert_int_equal(row.step_count, 3);
    assert_string_equal(row.steps[2].name, "4");
    assert_memory_equal(row.steps[0].figures, "1x .", 4);
    const double change = flip_of(&report, 3) - flip_of(&report, 0);
    snprintf(expected, sizeof expected, "%.4f", fabs(change));
    assert_memory_equal(row.steps[2].figures, "4.00x \u2212", 9);
    assert_true(change < 0.0);
    assert_string_equal(row.steps[2].figures + 9, expected[0] == '0' ? expected + 1 : expected);
    DipQuality quality = dip_quality_default();
    assert_true(dip_costs_is_at(&row, 0, &quality));
    assert_false(dip_costs_is_at(&row, 2, &quality));
    dip_cost_report_free(&report);
}

// The sheet (U) and the panel's prices mark the same steps as doubtful: none of a good report, one
// whose times scatter, all of a report from a machine that was too busy.
static void the_sheet_doubts_what_the_panel_doubts(void **state) {
    (void)state;
    static const double scatter[] = {0.2, 5.0, 0.5, 3.0};
    static const char *const good[] = {"1x", "3.00x", "4.00x"};
    static const char *const busy[] = {"1x", "3?x", "4?x"};
    enum { GOOD, SCATTERED, BUSY, KINDS };
    for (int kind = GOOD; kind < KINDS; kind++) {
        DipCostReport report;
        DipPrices *prices = dip_prices_create(NULL);
        int doubtful = 0;
        dip_made_report(&report, 16);
        for (int f = 0; kind == SCATTERED && f < dip_cost_frame_count(&report); f++) {
            dip_made_timed(&report, 3, f)->ms = 4.0 * scatter[f % 4];
        }
        assert_true(dip_cost_estimate_times(&report, NULL));
        report.verdict = kind == BUSY ? DIP_COST_RED : DIP_COST_GREEN;
        assert_true(dip_prices_set_report(prices, &report, NULL));
        const DipCostsRow row = dip_costs_row(&report, &report.sweeps[0]);
        for (int s = 1; s < row.step_count; s++) {
            const DipQuality *quality = &row.steps[s].quality;
            const DipPrice price =
                dip_prices_step(prices, DIP_SETTING_AA, quality->step[DIP_SETTING_AA], quality);
            const bool marked = strchr(row.steps[s].time, '?') != NULL;
            assert_int_equal(marked, dip_price_trust(&price) == DIP_PRICE_TRUST_DOUBTFUL);
            assert_string_equal(row.steps[s].time, kind == SCATTERED ? row.steps[s].time
                                                   : kind == GOOD    ? good[s]
                                                                     : busy[s]);
            doubtful += marked;
        }
        assert_true(kind == GOOD        ? doubtful == 0
                    : kind == SCATTERED ? doubtful > 0
                                        : doubtful == row.step_count - 1);
        dip_prices_destroy(&prices);
        dip_cost_report_free(&report);
    }
}

static void a_report_of_another_scene_is_refused(void **state) {
    (void)state;
    DipCostReport report;
    DipError err = {0};
    DipPrices *prices = dip_prices_create(NULL);
    char file[] = "/tmp/test_panel.XXXXXX";
    const int descriptor = mkstemp(file);
    assert_true(descriptor >= 0);
    close(descriptor);
    dip_made_report(&report, 3);
    assert_true(dip_cost_write_json(&report, file, &err));
    DipCostReport *costs = dip_costs_load(prices, file, "made up", &err);
    assert_non_null(costs);
    assert_int_equal(costs->sweep_count, 1);
    assert_null(dip_costs_load(prices, file, "other", &err));
    assert_int_equal(err.code, DIP_ERROR_CONFLICT);
    assert_true(dip_prices_has_report(prices)); // The first one.
    dip_prices_destroy(&prices);
    dip_costs_free(&costs);
    remove(file);
    dip_cost_report_free(&report);
}

static void choose(DipPreviewState *preview, DipPreviewChoice *choice, const DipPrices *prices) {
    dip_preview_choose(choice, prices, &preview->quality[DIP_PANE_REQUESTED], preview->budget_ms);
    preview->choice = choice;
}

// Row r of the made-up report takes r + 1 ms; rows 2 and 3 are its combinations. The key takes the
// advice for the budget and leaves the budget as it is; with Shift, it goes on to the next one.
static void advice_sets_the_requested_pane(void **state) {
    (void)state;
    DipCostReport report;
    DipPrices *prices = dip_prices_create(NULL);
    DipPreviewChoice choice = {0};
    dip_made_report(&report, 16);
    report.combined_first = 2;
    memset(report.rows[4].judged, false, (size_t)report.options.places); // Not a combination.
    report.rows[2].quality = report.options.baseline;
    report.options.budgets_ms[0] = 16.6;
    report.options.budgets_ms[1] = 1.0;
    report.options.budget_count = 2;
    assert_true(dip_cost_choose(&report, NULL) && dip_prices_set_report(prices, &report, NULL));
    DipPreviewState preview = {.budget_ms = 16.6};
    dip_preview_act(&preview, DIP_ACTION_ADVICE, 0, false, 0);
    assert_non_null(strstr(preview.notice, "Nothing is measured yet"));
    assert_int_equal(preview.scene_changes, 0);
    preview.costs = &report;
    choose(&preview, &choice, prices);
    for (int i = 0; i < 2; i++) { // The second press changes nothing.
        preview.scene_changes = 0;
        dip_preview_act(&preview, DIP_ACTION_ADVICE, 0, false, 0);
        assert_true(preview.budget_ms == 16.6);
    }
    // Both combinations are fast enough; the one of 4 ms has less error.
    assert_non_null(strstr(preview.notice, "Within 16.6 ms: 4.0 ms p95, FLIP "));
    assert_non_null(strstr(preview.notice, ", fits with 100 %; baseline 3.0 ms, "));
    assert_memory_equal(&preview.quality[DIP_PANE_REQUESTED], &report.rows[3].quality,
                        sizeof(DipQuality));
    assert_int_equal(preview.scene_changes, 1);
    dip_preview_act(&preview, DIP_ACTION_ADVICE, 0, true, 0);
    assert_string_equal(preview.notice, "Nothing measured surely fits 1 ms.");
    assert_true(preview.budget_ms == 1.0 && preview.has_budget);
    assert_int_equal(preview.scene_changes, 1);
    dip_preview_act(&preview, DIP_ACTION_ADVICE, 0, true, 0);
    assert_true(preview.budget_ms == 16.6);
    assert_int_equal(preview.scene_changes, 2);
    dip_preview_choice_free(&choice);
    dip_prices_destroy(&prices);
    dip_cost_report_free(&report);
}

// The budget is one refresh of the display until the user chooses another one.
static void the_budget_follows_the_display(void **state) {
    (void)state;
    double list[DIP_COST_MAX_BUDGETS];
    DipPreviewState preview = {.budget_ms = 1000.0 / 60.0};
    dip_preview_follow_refresh(&preview, 1000.0 / 144.0);
    assert_true(preview.budget_ms == 1000.0 / 144.0);
    assert_int_equal(dip_preview_budgets(&preview, list), 4);
    assert_true(list[2] == 1000.0 / 60.0);
    dip_preview_set_budget(&preview, list[3]);
    dip_preview_follow_refresh(&preview, 1000.0 / 75.0);
    assert_true(preview.budget_ms == 1000.0 / 30.0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(the_panel_shows_times_and_work, set_up),
        cmocka_unit_test_setup(the_panel_shows_errors_at_rest, set_up),
        cmocka_unit_test_setup(mip_colours_have_no_error, set_up),
        cmocka_unit_test_setup(the_panel_says_which_effects_ran, set_up),
        cmocka_unit_test_setup(a_text_of_all_effects_is_cut_to_its_room, set_up),
        cmocka_unit_test_setup(a_copy_has_errors_only, set_up),
        cmocka_unit_test(the_preview_rests_when_nothing_moves),
        cmocka_unit_test(steps_show_their_time_and_change_of_flip),
        cmocka_unit_test(the_sheet_doubts_what_the_panel_doubts),
        cmocka_unit_test(a_report_of_another_scene_is_refused),
        cmocka_unit_test(advice_sets_the_requested_pane),
        cmocka_unit_test(the_budget_follows_the_display),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
