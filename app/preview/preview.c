// The command: reads the options, opens the display, runs the loop.
#include "app/preview/preview.h"

#include "app/cost/plan.h"
#include "app/display/sdl/sdl_display.h"
#include "app/preview/loop.h"
#include "app/preview/view.h"
#include "renderer/base/clock.h"

#include <math.h>
#include <stdlib.h>

static const double courtyard_speed_m_per_s = 3.0;
static const double seconds_across_model = 4.0;

// --- what the options say ----------------------------------------------------------------------

typedef struct Inputs {
    DipSession *session;
    const DipOptions *options;
    int pane_width;
    int pane_height;
    double flying_speed_m_per_s;
} Inputs;

// The camera crosses a model of the user's own in four seconds, whatever the model's unit is.
static double flying_speed(const DipSession *session, const DipOptions *options) {
    if (options->model_count == 0) {
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

static Inputs read_options(DipSession *session, const DipOptions *options) {
    const DipConfigSize *res = &session->config.res;
    return (Inputs){
        .session = session,
        .options = options,
        .pane_width = options->has_size ? options->width : res->width,
        .pane_height = options->has_size ? options->height : res->height,
        .flying_speed_m_per_s = flying_speed(session, options),
    };
}

static bool load_scene_def(void *context, DipError *err) {
    const Inputs *inputs = context;
    return dip_session_keep_model(inputs->session, inputs->options, err);
}

// Loads the cost report if the options name one; else *costs stays NULL.
static bool load_costs(const Inputs *inputs, DipCosts **costs, DipError *err) {
    const char *file = inputs->options->cost_report;
    char scene[DIP_COST_TEXT];
    if (!file) {
        return true;
    }
    *costs = calloc(1, sizeof **costs);
    if (!*costs) {
        return dip_error_set(err, DIP_ERROR_MEMORY, file, 0, "--cost", "out of memory");
    }
    dip_cost_scene_name(inputs->session, inputs->options, scene);
    return dip_costs_load(*costs, file, scene, err);
}

// --- running -----------------------------------------------------------------------------------

static bool run_loop(Inputs *inputs, const DipDisplay *display, const DipCosts *costs,
                     DipError *err) {
    const DipPreviewDef def = {
        .session = inputs->session,
        .display = *display,
        .costs = costs,
        .flying_speed_m_per_s = inputs->flying_speed_m_per_s,
        .load_scene_def = load_scene_def,
        .context = inputs,
    };
    DipPreview *preview = dip_preview_create(&def, err);
    bool done = preview != NULL;
    while (done && !dip_preview_has_quit(preview)) {
        done = dip_preview_turn(preview, err);
    }
    inputs->session->times.ended_ns = dip_clock_ns();
    dip_preview_destroy(&preview);
    return done;
}

bool dip_preview_run(DipSession *session, const DipOptions *options, DipError *err) {
    Inputs inputs = read_options(session, options);
    DipCosts *costs = NULL;
    DipDisplay display;
    bool done = load_costs(&inputs, &costs, err) &&
                dip_sdl_display_open(&display, 2 * inputs.pane_width + DIP_PANE_GAP_PX,
                                     inputs.pane_height, err);
    if (done) {
        done = run_loop(&inputs, &display, costs, err);
        display.close(display.context);
    }
    free(costs);
    return done;
}
