// Tests of the texts that the window shows: which time is compared with the target, and that no
// sentence loses its last words.
#include "tests/app/cost/made_report.h"
#include "tests/app/preview/made_live.h"
#include "tests/app/preview/shown_texts.h"
#include "app/preview/loop/view.h"
#include "app/preview/prices/price_text.h"
#include "app/preview/tabs/tabs.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static DipCamPath *path;
static DipCamTrack track;
static DipPreviewState state;
static DipView *view;
static DipPrices *prices;
static DipTools *tools;
static DipPaneFigures figures[DIP_PANE_COUNT];
static uint8_t pixels[4 * 16 * 16];
static DipViewInput input;

static int set_up(void **unused) {
    (void)unused;
    const DipCamKey keys[2] = {{{0, 0, 0}, {0, 0, 0, 1}}, {{1, 1, 0}, {0, 0, 0, 1}}};
    assert_true(dip_campath_create(keys, 2, INT64_C(5000000000), &path, NULL));
    track = dip_camtrack_make(true);
    dip_camtrack_set(&track, DIP_CATEGORY_DEFAULT, path, 60.0);
    const DipQuality quality[2] = {dip_quality_default(), dip_quality_default()};
    state = dip_preview_state_make(quality, &track);
    view = dip_view_create(NULL, NULL);
    prices = dip_prices_create(NULL);
    tools = dip_tools_create(NULL);
    assert_true(view && prices && tools);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        const DipFrame frame = {.rgba8 = pixels, .stride_bytes = 64, .width = 16, .height = 16};
        dip_view_set_frame(view, p, &frame);
        figures[p] = (DipPaneFigures){.ms = 4.0 + p};
    }
    input = (DipViewInput){.width = 1282,
                           .height = 720,
                           .scale = 1.0,
                           .state = &state,
                           .figures = figures,
                           .prices = prices,
                           .tools = tools,
                           .still = true};
    return 0;
}

static int tear_down(void **unused) {
    (void)unused;
    dip_tools_destroy(&tools);
    dip_prices_destroy(&prices);
    dip_view_destroy(&view);
    dip_campath_destroy(&path);
    return 0;
}

// Draws the window in a size, with pictures of the panes' size.
static void draw(int width, int height) {
    static uint8_t black[4 * 2000 * 1100];
    input.width = width;
    input.height = height;
    const DipRect pane = dip_view_layout(&input).panes[0];
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        const DipFrame frame = {.rgba8 = black,
                                .stride_bytes = 4 * (size_t)pane.width,
                                .width = pane.width,
                                .height = pane.height};
        dip_view_set_frame(view, p, &frame);
    }
    dip_shown_texts_forget();
    assert_true(dip_view_draw(view, &input, NULL));
}

static const int sizes[][2] = {{900, 560}, {1282, 720}, {1920, 1080}};
enum { SIZES = sizeof sizes / sizeof *sizes };

// The mean of these times is within the target and their 95th percentile is over it. The window
// shows the mean, and says beside the target that the 95th percentile is compared with it.
static void the_target_names_the_time_that_is_judged(void **unused) {
    (void)unused;
    DipCostReport report;
    dip_made_report(&report, 16); // Row 0, with the default settings, takes 1 ms.
    const int frames = dip_cost_frame_count(&report);
    for (int f = 0; f < frames; f++) {
        dip_made_timed(&report, 0, f)->ms = f % 8 == 0 ? 4.0 : 1.0;
    }
    assert_true(dip_cost_estimate_times(&report, NULL));
    assert_true(dip_prices_set_report(prices, &report, NULL));
    assert_true(report.rows[0].time.mean_ms.value < 1.1 && report.rows[0].time.p95_ms.value > 1.3);
    dip_preview_set_budget(&state, 1.2);
    for (int i = 0; i < SIZES; i++) {
        bool whole = false;
        draw(sizes[i][0], sizes[i][1]);
        const char *verdict = dip_shown_text("p95 ", &whole);
        assert_non_null(verdict);
        assert_true(whole && strstr(verdict, " over"));
        report.options.budget_of = DIP_TIME_MEAN;
        draw(sizes[i][0], sizes[i][1]);
        assert_null(dip_shown_text("p95 ", NULL));
        assert_non_null(dip_shown_text("mean: within", &whole));
        assert_true(whole);
        report.options.budget_of = DIP_TIME_P95;
    }
    dip_prices_destroy(&prices);
    prices = dip_prices_create(NULL);
    dip_cost_report_free(&report);
}

// Where live prices come from is said whole or not at all, whatever the room is and whatever else
// is said there.
static void the_source_of_live_prices_is_whole(void **unused) {
    (void)unused;
    static const char *const progress[] = {
        "", "times: 12 steps left, 4 s",
        "times: 12 steps left, 4 s; errors: the picture is 40 % drawn"};
    int shown = 0;
    dip_made_live(prices, "aa=none", 6.7, 0.01, 0.05);
    for (int i = 0; i < 3; i++) {
        dip_prices_set_progress(prices, progress[i]);
        for (int width = 600; width <= 1920; width += 13) {
            draw(width, 720);
            if (dip_shown_text("Prices:", NULL)) {
                assert_non_null(dip_shown_text("(rough).", NULL));
                shown++;
            }
        }
        draw(1282, 720);
        assert_true(i == 2 || dip_shown_text("(rough).", NULL));
    }
    assert_true(shown > 100);
}

// While pictures move, no work is measured. The tab Maps then says so, and draws no scale.
static void a_map_without_values_has_no_scale(void **unused) {
    (void)unused;
    bool whole = false;
    state.tools.tab = DIP_TAB_MAPS;
    state.tools.map = DIP_MAP_TIME;
    state.tools.comparison = DIP_COMPARE_WIPE; // No words over the panes.
    for (int p = 0; p < DIP_PANE_COUNT; ++p) { // The maps have seen the panes' frames.
        tools->maps.key.quality[p] = state.quality[p];
    }
    for (int i = 0; i < SIZES; i++) {
        input.still = false;
        draw(sizes[i][0], sizes[i][1]);
        assert_non_null(dip_shown_text("ms per tile", NULL));
        assert_non_null(dip_shown_text("Measured while the camera rests.", &whole));
        assert_true(whole);
        assert_null(dip_shown_text("Brightness", NULL));
        input.still = true;
        draw(sizes[i][0], sizes[i][1]);
        assert_non_null(dip_shown_text("Measuring.", NULL));
        assert_null(dip_shown_text("Brightness", NULL));
    }
}

static void thumbnails_that_wait_are_marked(void **unused) {
    (void)unused;
    state.tools.tab = DIP_TAB_COMPARE;
    figures[0].frames = figures[1].frames = 30; // The panes' own times are known.
    for (int i = 0; i < SIZES; i++) {
        draw(sizes[i][0], sizes[i][1]);
        assert_non_null(dip_shown_text(DIP_WAITING_MARK, NULL));
    }
    tools->strip.failed = true;
    draw(1282, 720);
    assert_null(dip_shown_text(DIP_WAITING_MARK, NULL));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(the_target_names_the_time_that_is_judged, set_up,
                                        tear_down),
        cmocka_unit_test_setup_teardown(the_source_of_live_prices_is_whole, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_map_without_values_has_no_scale, set_up, tear_down),
        cmocka_unit_test_setup_teardown(thumbnails_that_wait_are_marked, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
