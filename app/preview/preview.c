// Opens the display and runs the loop.
#include "app/preview/preview.h"

#include "app/cost/plan.h"
#include "app/display/sdl/sdl_display.h"
#include "app/log.h"
#include "app/preview/control.h"
#include "app/preview/loop.h"
#include "app/preview/view.h"
#include "renderer/base/clock.h"

#include <math.h>
#include <stdlib.h>

static const double courtyard_speed_m_per_s = 3.0;
static const double seconds_across_model = 4.0;

// Returns the speed of the free camera. If the user gave models, the camera crosses them in four
// seconds, whatever their unit of length is.
static double flying_speed(const DipSession *session) {
    if (session->options->model_count == 0) {
        return courtyard_speed_m_per_s;
    }
    float low[3];
    float high[3];
    dip_scene_bounds(session->scene, low, high);
    const double diagonal =
        sqrt(pow((double)high[0] - low[0], 2) + pow((double)high[1] - low[1], 2) +
             pow((double)high[2] - low[2], 2));
    return diagonal / seconds_across_model;
}

static bool load_scene_def(void *context, DipError *err) {
    return dip_session_keep_model(context, err);
}

// Loads the cost report if `file` is not NULL; otherwise *costs stays NULL.
static bool load_costs(const DipSession *session, const char *file, DipCosts **costs,
                       DipError *err) {
    char scene[DIP_COST_TEXT];
    if (!file) {
        return true;
    }
    *costs = calloc(1, sizeof **costs);
    if (!*costs) {
        return dip_error_set(err, DIP_ERROR_MEMORY, file, 0, "--cost", "out of memory");
    }
    dip_cost_scene_name(session, scene);
    return dip_costs_load(*costs, file, scene, err);
}

static bool run_loop(DipSession *session, const DipDisplay *display, const DipCosts *costs,
                     DipRemote *remote, DipError *err) {
    const DipPreviewDef def = {
        .session = session,
        .display = *display,
        .costs = costs,
        .flying_speed_m_per_s = flying_speed(session),
        .control = remote ? dip_remote_control(remote) : (DipPreviewControl){0},
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

// Opens the channel of --control. Without the option, *remote stays NULL.
static bool open_remote(const char *where, DipRemote **remote, DipError *err) {
    if (where) {
        *remote = dip_remote_open(where, err);
    }
    return !where || *remote;
}

static bool open_display(DipDisplay *display, const DipSession *session, unsigned long window_id,
                         DipError *err) {
    return window_id ? dip_sdl_display_open_in(display, window_id, err)
                     : dip_sdl_display_open(display, 2 * session->pane_size.width + DIP_PANE_GAP_PX,
                                            session->pane_size.height, err);
}

bool dip_preview_run(DipSession *session, const DipPreviewOptions *options, DipError *err) {
    DipCosts *costs = NULL;
    DipRemote *remote = NULL;
    DipDisplay display;
    bool done = load_costs(session, options->cost_report, &costs, err) &&
                open_remote(options->control, &remote, err) &&
                open_display(&display, session, options->window_id, err);
    if (done) {
        done = run_loop(session, &display, costs, remote, err);
        if (options->window_id && dip_sdl_display_has_lost_host(&display)) {
            dip_log_note("the program that owns window %lu has closed it", options->window_id);
        }
        display.close(display.context);
    }
    dip_remote_close(&remote);
    free(costs);
    return done;
}
