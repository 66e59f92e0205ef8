// Opens the display and runs the loop.
#include "app/preview/preview.h"

#include "app/cost/context.h"
#include "app/display/sdl/sdl_display.h"
#include "app/display/terminal/terminal_display.h"
#include "app/cli/log.h"
#include "app/preview/control/control.h"
#include "app/preview/loop/loop.h"
#include "app/preview/loop/reload.h"
#include "app/preview/state/speed.h"
#include "app/preview/loop/view.h"
#include "renderer/base/clock.h"

#include <stdlib.h>
#include <string.h>

static bool load_scene_def(void *context, DipError *err) {
    return dip_session_keep_model(context, err);
}

// Loads the cost report if `file` is not NULL; otherwise *costs stays NULL.
static bool load_costs(const DipSession *session, const char *file, DipCostReport **costs,
                       DipPrices *prices, DipError *err) {
    char scene[DIP_COST_TEXT];
    if (!file) {
        return true;
    }
    dip_cost_scene_name(session, scene);
    *costs = dip_costs_load(prices, file, scene, err);
    return *costs != NULL;
}

// What the preview needs beside its session and display.
typedef struct Parts {
    DipCostReport *costs;
    DipPrices *prices;
    DipReload *reload;
    DipRemote *remote;
    double ui_scale;
    const char *notice; // Shown at first, or NULL.
    char cache[PATH_MAX];
    bool hides_panel;
} Parts;

static bool run_loop(DipSession *session, const DipDisplay *display, const Parts *parts,
                     DipError *err) {
    const DipPreviewDef def = {
        .session = session,
        .display = *display,
        .costs = parts->costs,
        .prices = parts->prices,
        .measures_prices = true,
        .cache = parts->cache[0] ? parts->cache : NULL,
        .reload = parts->reload,
        .flying_speed_m_per_s = dip_flying_speed(session),
        .ui_scale = parts->ui_scale,
        .notice = parts->notice,
        .hides_panel = parts->hides_panel,
        .control = parts->remote ? dip_remote_control(parts->remote) : (DipPreviewControl){0},
        .load_scene_def = load_scene_def,
        .context = session,
    };
    DipPreview *preview = dip_preview_create(&def, err);
    bool done = preview != NULL;
    while (done && !dip_preview_has_quit(preview)) {
        done = dip_preview_turn(preview, err);
    }
    session->times.ended_ns = dip_clock_ns();
    dip_preview_destroy(&preview);
    return done;
}

static bool open_parts(Parts *parts, DipSession *session, const DipPreviewOptions *options,
                       DipError *err) {
    parts->reload = dip_reload_create(session, options->watch, err);
    parts->prices = parts->reload ? dip_prices_create(err) : NULL;
    if (!parts->prices ||
        !load_costs(session, options->cost_report, &parts->costs, parts->prices, err)) {
        return false;
    }
    dip_prices_set_viewing(parts->prices, options->pixels_per_degree);
    if (!dip_cost_find_cache(options->cache, parts->cache, err)) {
        if (options->cache) {
            return false;
        }
        parts->cache[0] = '\0'; // The preview does without the user's folder.
    }
    dip_reload_set_prices(parts->reload, parts->prices);
    if (options->control) {
        parts->remote = dip_remote_open(options->control, err);
    }
    return !options->control || parts->remote;
}

static void close_parts(Parts *parts) {
    dip_remote_close(&parts->remote);
    dip_reload_destroy(&parts->reload);
    dip_costs_free(&parts->costs);
    dip_prices_destroy(&parts->prices);
}

static bool open_window(DipDisplay *display, const DipSession *session,
                        const DipPreviewOptions *options, DipError *err) {
    const DipToolState tools = {.ui_scale = options->ui_scale > 0.0 ? options->ui_scale : 1.0,
                                .fixed_scale = options->ui_scale > 0.0};
    const int pane_height = session->pane_size.height;
    int height = pane_height;
    for (int i = 0; i < 4 && !options->hides_panel; ++i) { // The dock follows the height's scale.
        const double scale = dip_layout_scale(1.0, &tools, height);
        height = pane_height + (int)(scale * dip_layout_dock_height() + 0.5);
    }
    return options->window_id
               ? dip_sdl_display_open_in(display, options->window_id, err)
               : dip_sdl_display_open(display, 2 * session->pane_size.width + DIP_PANE_GAP_PX,
                                      height, err);
}

// Opens the terminal, which must not be where requests come from.
static bool open_terminal(DipDisplay *display, const DipPreviewOptions *options, DipError *err) {
    if (options->control && strcmp(options->control, "-") == 0) {
        return dip_error_set(
            err, DIP_ERROR_CONFLICT, NULL, 0, "--control",
            "standard input and output are the terminal; give the path of a socket");
    }
    return dip_terminal_display_open(display, options->terminal_colours, err);
}

// Opens a window. If there is no display to open it on, opens the terminal, unless the user has
// asked for a window. Sets *notice to a text that tells the user about this, or to NULL.
static bool open_display(DipDisplay *display, const DipSession *session,
                         const DipPreviewOptions *options, const char **notice, DipError *err) {
    static const char no_window[] =
        "There is no display to open a window on, so the preview shows in the terminal";
    DipError failure = {0};
    *notice = NULL;
    if (options->display == DIP_DISPLAY_TERMINAL) {
        return open_terminal(display, options, err);
    }
    if (open_window(display, session, options, &failure)) {
        return true;
    }
    if (options->display == DIP_DISPLAY_AUTO && failure.code == DIP_ERROR_RUNTIME &&
        !options->window_id && !options->control && dip_terminal_is_there()) {
        dip_log_note("%s", no_window);
        *notice = no_window;
        return open_terminal(display, options, err);
    }
    if (err) {
        *err = failure;
    }
    return false;
}

bool dip_preview_run(DipSession *session, const DipPreviewOptions *options, DipError *err) {
    Parts parts = {.ui_scale = options->ui_scale, .hides_panel = options->hides_panel};
    DipDisplay display;
    bool done = open_parts(&parts, session, options, err) &&
                open_display(&display, session, options, &parts.notice, err);
    if (done) {
        done = run_loop(session, &display, &parts, err);
        if (options->window_id && options->display != DIP_DISPLAY_TERMINAL &&
            dip_sdl_display_has_lost_host(&display)) {
            dip_log_note("the program that owns window %lu has closed it", options->window_id);
        }
        display.close(display.context);
    }
    close_parts(&parts);
    return done;
}
