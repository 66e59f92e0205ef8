// Opens the display and everything else that the preview needs, and runs the preview's loop.
#include "app/preview/preview.h"

#include "app/cost/context.h"
#include "app/display/sdl/sdl_display.h"
#include "app/display/terminal/terminal_display.h"
#include "app/cli/log.h"
#include "app/preview/control/control.h"
#include "app/preview/loop/loop.h"
#include "app/preview/loop/reload.h"
#include "app/preview/state/pilot.h"
#include "app/preview/loop/view.h"
#include "renderer/base/clock.h"

#include <stdlib.h>
#include <string.h>

static bool load_scene_def(void *context, DipError *err) {
    return dip_session_keep_model(context, err);
}

static bool open_window(DipDisplay *display, const DipSession *session,
                        const DipPreviewOptions *options, DipError *err) {
    const DipToolState tools = {.ui_scale = options->ui_scale > 0.0 ? options->ui_scale : 1.0,
                                .fixed_scale = options->ui_scale > 0.0};
    const int pane_height = session->pane_size.height;
    int height = pane_height;
    // Iterates, because the scale depends on the height, and the height on the scale.
    for (int i = 0; i < 4 && !options->hides_panel; ++i) {
        const double scale = dip_layout_scale(1.0, &tools, height);
        height = pane_height + (int)(scale * dip_layout_dock_height() + 0.5);
    }
    return options->window_id
               ? dip_sdl_display_open_in(display, options->window_id, err)
               : dip_sdl_display_open(display, 2 * session->pane_size.width + DIP_PANE_GAP_PX,
                                      height, err);
}

// Opens the terminal as the display. Also fails if --control is "-", because requests would then
// come from standard input, which the terminal needs.
static bool open_terminal(DipDisplay *display, const DipPreviewOptions *options, DipError *err) {
    if (options->control && strcmp(options->control, "-") == 0) {
        return dip_error_set(
            err, DIP_ERROR_CONFLICT, NULL, 0, "--control",
            "standard input and output are the terminal; give the path of a socket");
    }
    return dip_terminal_display_open(display, options->terminal_colours, err);
}

// Opens the terminal or the window that the options ask for. If there is no display to open a
// window on, `auto` opens the terminal instead, unless --window-id or --control is given or
// standard output is no terminal. Sets *notice to a text that tells the user that the terminal
// replaces the window, or to NULL.
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

// Creates what the preview needs besides its session and its display: prices, the reload
// (reload.h), the cost report, the cache of truths and the control channel. After a failure, the
// caller still closes what *def and *remote hold.
static bool open_parts(DipPreviewDef *def, DipRemote **remote, char cache[PATH_MAX],
                       const DipPreviewOptions *options, DipError *err) {
    char scene[DIP_COST_TEXT];
    def->prices = dip_prices_create(err);
    def->reload = def->prices ? dip_reload_create(def->session, options->watch, err) : NULL;
    if (!def->reload) {
        return false;
    }
    if (options->cost_report) {
        dip_cost_scene_name(def->session, scene);
        def->costs = dip_costs_load(def->prices, options->cost_report, scene, err);
        if (!def->costs) {
            return false;
        }
    }
    dip_prices_set_viewing(def->prices, options->pixels_per_degree);
    if (dip_cost_find_cache(options->cache, cache, err)) {
        def->cache = cache[0] ? cache : NULL;
    } else if (options->cache) {
        return false; // Only a folder that --cache names must be usable.
    }
    if (options->control) {
        *remote = dip_remote_open(options->control, err);
        def->control = *remote ? dip_remote_control(*remote) : def->control;
    }
    return !options->control || *remote;
}

static bool run_loop(const DipPreviewDef *def, DipError *err) {
    DipPreview *preview = dip_preview_create(def, err);
    bool done = preview != NULL;
    while (done && !dip_preview_has_quit(preview)) {
        done = dip_preview_turn(preview, err);
    }
    def->session->times.ended_ns = dip_clock_ns();
    dip_preview_destroy(&preview);
    return done;
}

bool dip_preview_run(DipSession *session, const DipPreviewOptions *options, DipError *err) {
    char cache[PATH_MAX];
    DipRemote *remote = NULL;
    DipPreviewDef def = {
        .session = session,
        .measures_prices = true,
        .flying_speed_m_per_s = dip_flying_speed(session),
        .ui_scale = options->ui_scale,
        .hides_panel = options->hides_panel,
        .load_scene_def = load_scene_def,
        .context = session,
    };
    bool done = open_parts(&def, &remote, cache, options, err) &&
                open_display(&def.display, session, options, &def.notice, err);
    if (done) {
        done = run_loop(&def, err);
        if (options->window_id && options->display != DIP_DISPLAY_TERMINAL &&
            dip_sdl_display_has_lost_host(&def.display)) {
            dip_log_note("the program that owns window %lu has closed it", options->window_id);
        }
        def.display.close(def.display.context);
    }
    dip_remote_close(&remote);
    dip_reload_destroy(&def.reload);
    dip_costs_free(&def.costs);
    dip_prices_destroy(&def.prices);
    return done;
}
