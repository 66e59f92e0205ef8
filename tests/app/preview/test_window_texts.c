// Tests of the texts that the window shows: which time is compared with the target, which effects
// ran, and that no sentence loses its last words.
#include "tests/app/cost/made_report.h"
#include "tests/app/preview/lone_window.h"
#include "tests/app/preview/made_live.h"
#include "tests/app/preview/shown_texts.h"
#include "app/preview/prices/price_text.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// Draws the window in a size, with pictures of the panes' size.
static void draw(int width, int height) {
    static uint8_t black[4 * 2000 * 1100];
    lone.input.width = width;
    lone.input.height = height;
    const DipRect pane = dip_view_layout(&lone.input).panes[0];
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        const DipFrame frame = {.rgba8 = black,
                                .stride_bytes = 4 * (size_t)pane.width,
                                .width = pane.width,
                                .height = pane.height};
        dip_view_set_frame(lone.view, p, &frame);
    }
    dip_shown_texts_forget();
    assert_true(dip_view_draw(lone.view, &lone.input, NULL));
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
    assert_true(dip_prices_set_report(lone.prices, &report, NULL));
    assert_true(report.rows[0].time.mean_ms.value < 1.1 && report.rows[0].time.p95_ms.value > 1.3);
    dip_preview_set_budget(&lone.state, 1.2);
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
    dip_prices_destroy(&lone.prices);
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
    dip_made_live(lone.prices, "aa=none", 6.7, 0.01, 0.05);
    for (int i = 0; i < 3; i++) {
        dip_prices_set_progress(lone.prices, progress[i]);
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
    lone.state.tools.tab = DIP_TAB_MAPS;
    lone.state.tools.map = DIP_MAP_TIME;
    lone.state.tools.comparison = DIP_COMPARE_WIPE; // No words over the panes.
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {      // The maps have seen the panes' frames.
        lone.tools->maps.key.quality[p] = lone.state.quality[p];
    }
    for (int i = 0; i < SIZES; i++) {
        lone.input.window.still = false;
        draw(sizes[i][0], sizes[i][1]);
        assert_non_null(dip_shown_text("ms per tile", NULL));
        assert_non_null(dip_shown_text("Measured while the camera rests.", &whole));
        assert_true(whole);
        assert_null(dip_shown_text("Brightness", NULL));
        lone.input.window.still = true;
        draw(sizes[i][0], sizes[i][1]);
        assert_non_null(dip_shown_text("Measuring.", NULL));
        assert_null(dip_shown_text("Brightness", NULL));
    }
}

// Gives both panes' maps the work of a frame of one tile.
static void make_work(void) {
    enum { SIDE = 64 };
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        DipMapWork *work = &lone.tools->maps.panes[p];
        *work = (DipMapWork){
            .draws = DIP_MAP_DRAWS, .width = SIDE, .height = SIDE, .across = 1, .down = 1};
        work->records = calloc(1, sizeof *work->records);
        work->ms = calloc(1, sizeof *work->ms);
        work->mixed = calloc(1, SIDE * SIDE);
        work->mips = calloc(4, SIDE * SIDE);
        assert_true(work->records && work->ms && work->mixed && work->mips);
        const DipColour colour = dip_map_mip_colour(2); // 256 texels.
        for (int i = 0; i < SIDE * SIDE; i++) {
            memcpy(work->mips + 4 * i, (uint8_t[]){colour.red, colour.green, colour.blue, 255}, 4);
        }
        work->ms[0] = 7.25;
        work->geometry_ms = 3.75;
    }
}

// The tables of the tab Maps show values of the frame in view. While pictures move, a mark stands
// in the place of each value, and nothing does where no value will come.
static void tables_of_maps_wait_while_pictures_move(void **unused) {
    (void)unused;
    static const struct {
        DipMap map;
        const char *value; // A value at the pinned pixel.
    } maps[] = {{DIP_MAP_TIME, "7.25 ms"},
                {DIP_MAP_FRAGMENTS, "7.25 ms"},
                {DIP_MAP_SAMPLES, "all the same"},
                {DIP_MAP_MIPS, "256 texels"},
                {DIP_MAP_FLIP, DIP_WAITING_MARK}}; // There are no errors.
    make_work();
    lone.figures[0].frames = lone.figures[1].frames = 30; // The panes' own times are known.
    lone.state.tools.tab = DIP_TAB_MAPS;
    lone.state.tools.comparison = DIP_COMPARE_WIPE; // No words over the panes.
    lone.state.tools.pinned = true;
    lone.state.tools.x = lone.state.tools.y = 5;
    for (int i = 0; i < 5; i++) {
        const bool has_table = maps[i].map != DIP_MAP_MIPS && maps[i].map != DIP_MAP_FLIP;
        const bool has_error = maps[i].map == DIP_MAP_FLIP;
        lone.state.tools.map = maps[i].map;
        lone.input.window.still = true;
        draw(1920, 1080);
        assert_non_null(dip_shown_text(maps[i].value, NULL));
        assert_int_equal(dip_shown_text("3.75 ms", NULL) != NULL, has_table);
        assert_int_equal(dip_shown_text(DIP_WAITING_MARK, NULL) != NULL, has_error);
        lone.input.window.still = false;
        draw(1920, 1080);
        assert_int_equal(dip_shown_text(maps[i].value, NULL) != NULL, has_error);
        assert_null(dip_shown_text("3.75 ms", NULL));
        assert_string_equal(dip_shown_text(DIP_WAITING_MARK, NULL), DIP_WAITING_MARK);
        lone.state.shows_gallery = true;
        draw(1920, 1080);
        assert_int_equal(dip_shown_text(DIP_WAITING_MARK, NULL) != NULL,
                         maps[i].map == DIP_MAP_MIPS);
        lone.state.shows_gallery = false;
    }
}

static void thumbnails_that_wait_are_marked(void **unused) {
    (void)unused;
    lone.state.tools.tab = DIP_TAB_COMPARE;
    lone.figures[0].frames = lone.figures[1].frames = 30; // The panes' own times are known.
    for (int i = 0; i < SIZES; i++) {
        draw(sizes[i][0], sizes[i][1]);
        assert_non_null(dip_shown_text(DIP_WAITING_MARK, NULL));
    }
    lone.tools->strip.failed = true;
    draw(1282, 720);
    assert_null(dip_shown_text(DIP_WAITING_MARK, NULL));
}

// A tip over a pane's figures in the tab Times lists that pane's effects.
static void a_tip_lists_the_effects_of_a_pane(void **unused) {
    (void)unused;
    static const char *const parts[DIP_PANE_COUNT] = {"Effects that ran: clouds",
                                                      "clouds: no sky is in view"};
    static const int xs[DIP_PANE_COUNT] = {100, 600};
    bool whole = false;
    lone.state.tools.tab = DIP_TAB_TIMES;
    lone.figures[0].effects.sky = (DipEffect){true, "sky is in view"};
    lone.figures[1].effects.sky = (DipEffect){false, "no sky is in view"};
    draw(1282, 720);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        assert_null(dip_shown_text(parts[p], NULL));
    }
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        dip_lone_mouse(DIP_EVENT_MOUSE_MOVE, DIP_MOUSE_LEFT, xs[p], 600);
        lone.input.window.now_ns += 1000000000;
        draw(1282, 720);
        assert_non_null(dip_shown_text(parts[p], &whole));
        assert_true(whole);
        assert_null(dip_shown_text(parts[1 - p], NULL));
    }
}

int main(void) {
#define TEXT_TEST(name) cmocka_unit_test_setup_teardown(name, dip_lone_set_up, dip_lone_tear_down)
    const struct CMUnitTest tests[] = {
        TEXT_TEST(the_target_names_the_time_that_is_judged),
        TEXT_TEST(the_source_of_live_prices_is_whole),
        TEXT_TEST(a_map_without_values_has_no_scale),
        TEXT_TEST(tables_of_maps_wait_while_pictures_move),
        TEXT_TEST(thumbnails_that_wait_are_marked),
        TEXT_TEST(a_tip_lists_the_effects_of_a_pane),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
