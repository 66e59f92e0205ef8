// Tells how long the window takes to draw, without the panes' own pictures: for each tab of the
// panel, at three sizes, at which the figures of both panes change with every frame. Declaring all
// controls, recording what they draw, finding what has changed and painting that all count. The
// times are medians and 95th percentiles of many frames, so they mean something on a machine that
// does nothing else. Fails if a window cannot be drawn; never because of a time.
//
// Usage: window_time
#include "app/preview/loop/view.h"
#include "config/config.h"
#include "renderer/base/clock.h"
#include "tests/app/cost/made_report.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FRAMES = 400, PANE_WIDTH = 640, PANE_HEIGHT = 480 };

typedef struct Bench {
    DipCamPath *path;
    DipCamTrack track;
    DipPreviewState state;
    DipView *view;
    DipPrices *prices;
    DipTools *tools;
    DipCostReport report;
    DipTiming timing;
    DipPaneFigures figures[DIP_PANE_COUNT];
    DipViewInput input;
    uint8_t pixels[4 * PANE_WIDTH * PANE_HEIGHT];
} Bench;

static Bench bench;

static bool make_prices(void) {
    dip_made_report(&bench.report, 4);
    static const char *const settings[] = {"af=16", "af=16,aaf=on", "aa=4,aaa=on,asd=2",
                                           "aa=4,af=16", "opt=standard"};
    for (int i = 0; i < 5; ++i) {
        DipQuality quality;
        if (!dip_quality_parse(settings[i], &quality, NULL)) {
            return false;
        }
        dip_made_combination(&bench.report, &quality, 2.0 + i, 0.4 - 0.05 * i);
    }
    bench.prices = dip_prices_create(NULL);
    return bench.prices && dip_cost_estimate_times(&bench.report, NULL) &&
           dip_prices_set_report(bench.prices, &bench.report, NULL);
}

static bool set_up(void) {
    const DipCamKey keys[2] = {{{0, 0, 0}, {0, 0, 0, 1}}, {{1, 1, 0}, {0, 0, 0, 1}}};
    const DipQuality quality[2] = {dip_quality_default(), dip_quality_default()};
    if (!dip_campath_create(keys, 2, INT64_C(5000000000), &bench.path, NULL)) {
        return false;
    }
    bench.track = dip_camtrack_make(true);
    dip_camtrack_set(&bench.track, DIP_CATEGORY_DEFAULT, bench.path, 60.0);
    bench.state = dip_preview_state_make(quality, &bench.track);
    bench.state.quality[DIP_PANE_REQUESTED].step[DIP_SETTING_AA] = 2;
    bench.view = dip_view_create(NULL, NULL);
    bench.tools = dip_tools_create(NULL);
    for (int p = 0; bench.view && p < DIP_PANE_COUNT; ++p) {
        const DipFrame frame = {.rgba8 = bench.pixels,
                                .stride_bytes = 4 * PANE_WIDTH,
                                .width = PANE_WIDTH,
                                .height = PANE_HEIGHT};
        dip_view_set_frame(bench.view, p, &frame);
    }
    bench.input = (DipViewInput){
        .scale = 1.0,
        .window = {.state = &bench.state, .figures = bench.figures, .tools = bench.tools}};
    const bool priced = make_prices();
    bench.input.window.prices = bench.prices;
    return bench.view && bench.tools && priced;
}

static void tear_down(void) {
    dip_prices_destroy(&bench.prices);
    dip_cost_report_free(&bench.report);
    dip_tools_destroy(&bench.tools);
    dip_view_destroy(&bench.view);
    dip_campath_destroy(&bench.path);
}

// Gives both panes the figures of frame `i`.
static void change_figures(int i) {
    const int64_t now_ns = INT64_C(16666667) * i;
    dip_timing_add(&bench.timing, now_ns, 8.0 + i % 17 * 0.3);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        bench.figures[p] =
            (DipPaneFigures){.ms = 4.0 + p + i % 31 * 0.1, .fps = 60, .times = &bench.timing};
    }
    bench.input.window.now_ns = bench.state.play_ns = now_ns;
}

// Draws a tab and prints its times. Returns false if it cannot be drawn.
static bool time_tab(int tab, const char *name, int width, int height) {
    double ms[FRAMES];
    DipError err;
    bench.input.width = width;
    bench.input.height = height;
    bench.state.tools.open = tab < DIP_TAB_COUNT;
    bench.state.tools.tab = tab < DIP_TAB_COUNT ? (DipTab)tab : DIP_TAB_SETTINGS;
    for (int i = -2; i < FRAMES; ++i) { // The first frames draw everything.
        change_figures(i + 2);
        const int64_t begin_ns = dip_clock_ns();
        if (!dip_view_draw(bench.view, &bench.input, &err)) {
            fprintf(stderr, "window_time: %s\n", err.message);
            return false;
        }
        if (i >= 0) {
            ms[i] = 1e-6 * (double)(dip_clock_ns() - begin_ns);
        }
        dip_view_take_damage(bench.view, false);
    }
    const double p95 = dip_percentile(ms, FRAMES, 0.95);
    const double p50 = dip_percentile(ms, FRAMES, 0.50);
    printf("%5d x %-5d %-10s %6.3f ms  %6.3f ms\n", width, height, name, p50, p95);
    return true;
}

int main(void) {
    static const char *const names[DIP_TAB_COUNT + 1] = {"settings", "loupe", "compare", "maps",
                                                         "advice",   "times", "path",    "folded"};
    static const int sizes[][2] = {{402, 360}, {1282, 720}, {1920, 1080}};
    bool ok = set_up();
    printf("window        tab           half       95 %%  of the frames are faster\n");
    for (int s = 0; ok && s < 3; ++s) {
        for (int tab = 0; ok && tab <= DIP_TAB_COUNT; ++tab) {
            ok = time_tab(tab, names[tab], sizes[s][0], sizes[s][1]);
        }
    }
    tear_down();
    return ok ? EXIT_SUCCESS : EXIT_FAILURE;
}
