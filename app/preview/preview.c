// The preview's loop: events, time, pictures.
#include "app/preview/preview.h"

#include "app/cost/plan.h"
#include "app/preview/ahead.h"
#include "app/preview/camera.h"
#include "app/preview/keys.h"
#include "app/preview/live.h"
#include "app/preview/state.h"
#include "app/preview/timing.h"
#include "app/preview/window.h"
#include "renderer/base/clock.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const int64_t figures_period_ns = 250000000; // figures that change faster cannot be read
static const int64_t longest_step_ns = 250000000;   // a stall does not make the camera jump
static const double courtyard_speed_m_per_s = 3.0;
enum { IDLE_WAIT_MS = 30 };

// All that decides what the pictures show.
typedef struct Drawn {
    DipPose pose;
    int64_t play_ns;
    DipQuality quality[DIP_PANE_COUNT];
    int width;
    int height;
} Drawn;

typedef struct Preview {
    DipSession *session;
    DipWindow *window;
    DipPreviewState state;
    DipQuality drawn_quality[DIP_PANE_COUNT]; // what the renderers are set to
    DipTiming timing[DIP_PANE_COUNT];
    DipTiming stages[DIP_PANE_COUNT][DIP_STAGE_COUNT];
    DipTiming presented;
    DipPaneFigures figures[DIP_PANE_COUNT];
    int64_t figures_ns;
    DipPose pose;
    bool flying; // the camera moved by hand in this turn
    double speed_m_per_s;
    unsigned drawn_changes;
    uint64_t frame_index; // of the pictures shown
    bool full_screen;
    bool redraw; // the overlay or the window changed
    DipAhead ahead;
    DipLive *live;
    DipSessionFrame frame; // the last one drawn
    Drawn drawn;
    unsigned picture_number; // counts what the pictures show: not the turns of temporal AA
} Preview;

// A model of the user's own is crossed in four seconds, whatever its unit.
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
    return diagonal / 4.0;
}

static void handle_event(Preview *preview, const SDL_Event *event, int64_t now_ns) {
    DipPreviewState *state = &preview->state;
    switch (event->type) {
    case SDL_QUIT:
        state->quit = true;
        break;
    case SDL_KEYDOWN:
        preview->redraw = dip_keys_press(state, &event->key, now_ns) || preview->redraw;
        break;
    case SDL_MOUSEBUTTONDOWN:
        if (event->button.button == SDL_BUTTON_LEFT && event->button.clicks == 2) {
            dip_preview_act(state, DIP_ACTION_FULL_SCREEN, 0, false, now_ns);
        } else if (event->button.button == SDL_BUTTON_LEFT) {
            const int pane = dip_window_pane_at(preview->window, event->button.x);
            state->edited[pane] = true;
            state->edited[1 - pane] = false;
        }
        preview->redraw = true;
        break;
    case SDL_WINDOWEVENT:
        preview->redraw = true;
        break;
    default:
        break;
    }
}

static double held(const Uint8 *keys, SDL_Scancode plus, SDL_Scancode minus) {
    return (keys[plus] ? 1.0 : 0.0) - (keys[minus] ? 1.0 : 0.0);
}

static void fly(Preview *preview, int64_t elapsed_ns) {
    DipPreviewState *state = &preview->state;
    preview->flying = false;
    if (!state->manual) {
        return;
    }
    const Uint8 *keys = SDL_GetKeyboardState(NULL);
    const SDL_Keymod modifiers = SDL_GetModState();
    const DipCameraKeys directions = {
        .right = held(keys, SDL_SCANCODE_D, SDL_SCANCODE_A),
        .up = held(keys, SDL_SCANCODE_Q, SDL_SCANCODE_E),
        .forward = held(keys, SDL_SCANCODE_W, SDL_SCANCODE_S),
        .turn = (modifiers & KMOD_SHIFT) != 0,
    };
    if (modifiers & (KMOD_CTRL | KMOD_ALT | KMOD_GUI)) {
        return;
    }
    preview->flying = dip_camera_move(&preview->pose, &directions, preview->speed_m_per_s,
                                      1e-9 * (double)elapsed_ns);
    state->scene_changes += preview->flying;
}

// Makes renderers follow the window and the settings. Figures of other settings are forgotten.
static bool follow_state(Preview *preview, DipError *err) {
    int width = 0;
    int height = 0;
    dip_window_pane_size(preview->window, &width, &height);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        DipRenderer *renderer = preview->session->renderers[p];
        const DipQuality *wanted = &preview->state.quality[p];
        if (memcmp(wanted, &preview->drawn_quality[p], sizeof *wanted) != 0) {
            if (!dip_renderer_set_quality(renderer, wanted, err)) {
                return false;
            }
            preview->drawn_quality[p] = *wanted;
            dip_timing_clear(&preview->timing[p]);
            for (int s = 0; s < DIP_STAGE_COUNT; ++s) {
                dip_timing_clear(&preview->stages[p][s]);
            }
            preview->figures_ns = 0;
        }
        if (!dip_renderer_resize(renderer, width, height, err)) {
            return false;
        }
    }
    return true;
}

static void count_picture(Preview *preview, int64_t play_ns) {
    Drawn drawn;
    memset(&drawn, 0, sizeof drawn); // compared with its padding
    drawn.pose = preview->pose;
    drawn.play_ns = play_ns;
    drawn.width = preview->frame.panes[0].width;
    drawn.height = preview->frame.panes[0].height;
    memcpy(drawn.quality, preview->drawn_quality, sizeof drawn.quality);
    if (memcmp(&drawn, &preview->drawn, sizeof drawn) != 0) {
        preview->drawn = drawn;
        ++preview->picture_number;
    }
}

static void add_times(Preview *preview, int pane, const DipStageTimes *times, int64_t now_ns) {
    DipTiming *stage = preview->stages[pane];
    dip_timing_add(&preview->timing[pane], now_ns, times->total_ms);
#define ADD_STAGE(name, text) dip_timing_add(stage++, now_ns, times->name##_ms);
    DIP_STAGE_LIST(ADD_STAGE)
#undef ADD_STAGE
}

static bool draw_panes(Preview *preview, DipError *err) {
    DipSession *session = preview->session;
    const int64_t play_ns = preview->state.play_ns;
    const bool on_path = !preview->state.manual;
    if (!follow_state(preview, err)) {
        return false;
    }
    if (on_path && !dip_camtrack_pose(&session->track, play_ns, &preview->pose)) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "path", "there is no camera path");
    }
    DipSessionFrame *frame = &preview->frame;
    if (!dip_session_draw_pose(session, &preview->pose, play_ns, preview->frame_index, frame,
                               err)) {
        return false;
    }
    count_picture(preview, play_ns);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        if (!dip_window_set_picture(preview->window, p, &frame->panes[p], err)) {
            return false;
        }
        preview->figures[p].effects = frame->panes[p].effects;
        preview->figures[p].counters = frame->panes[p].counters;
        preview->figures[p].copied = p == DIP_PANE_REQUESTED && frame->copied;
        add_times(preview, p, &frame->panes[p].stages, dip_clock_ns());
    }
    ++preview->frame_index;
    return true;
}

// Whether a pane's picture changes from frame to frame though nothing moves.
static bool alternates(const Preview *preview) {
    bool found = false;
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        const DipQuality *quality = &preview->state.quality[p];
        found |= quality->step[DIP_SETTING_TAA] != 0 && dip_quality_sample_count(quality) > 1;
    }
    return found;
}

static void update_figures(Preview *preview, int64_t now_ns) {
    if (now_ns - preview->figures_ns < figures_period_ns) {
        return;
    }
    preview->figures_ns = now_ns;
    // While nothing moves pictures are shown only when something changes: no rate to tell.
    const bool moving = !dip_preview_rests(&preview->state, preview->flying);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        preview->figures[p].ms = dip_timing_median_ms(&preview->timing[p], now_ns);
        for (int s = 0; s < DIP_STAGE_COUNT; ++s) {
            preview->figures[p].stage_ms[s] = dip_timing_median_ms(&preview->stages[p][s], now_ns);
        }
        preview->figures[p].fps = moving ? dip_timing_per_second(&preview->presented, now_ns) : 0;
    }
}

static void take_screenshot(Preview *preview, int64_t now_ns) {
    char file[64];
    DipError err;
    char line[512];
    preview->state.screenshot = false;
    if (dip_window_screenshot(preview->window, &preview->state, preview->figures, file, sizeof file,
                              &err)) {
        dip_preview_notice(&preview->state, now_ns, "Saved %s", file);
    } else {
        dip_error_format(&err, line, sizeof line);
        dip_preview_notice(&preview->state, now_ns, "%.120s", line);
    }
}

// What judges pictures is made when it is first asked for.
static bool make_live(Preview *preview, int64_t now_ns) {
    DipError err;
    if (!preview->live && dip_session_keep_model(preview->session, &err)) {
        preview->live =
            dip_live_create(&preview->session->scene_def, &preview->session->reflection, &err);
    }
    if (!preview->live) {
        char line[512];
        dip_error_format(&err, line, sizeof line);
        dip_preview_notice(&preview->state, now_ns, "%.120s", line);
        preview->state.panel = false;
    }
    return preview->live != NULL;
}

// Has the pictures judged while the panel is there and the camera rests. Returns whether there is
// something new to show.
static bool judge_pictures(Preview *preview, int64_t now_ns) {
    const bool judges = preview->state.panel && dip_preview_rests(&preview->state, preview->flying);
    if (!preview->live && !(judges && make_live(preview, now_ns))) {
        return false;
    }
    const DipSessionFrame *frame = &preview->frame;
    const DipFrame *current = &frame->panes[DIP_PANE_CURRENT];
    if (judges) {
        const DipJudgeShot shot = {
            .pose = preview->drawn.pose,
            .time_ns = preview->drawn.play_ns,
            .width = current->width,
            .height = current->height,
            .stride_bytes = current->stride_bytes,
            .rgba8 = {current->rgba8,
                      frame->copied ? NULL : frame->panes[DIP_PANE_REQUESTED].rgba8},
        };
        dip_live_show(preview->live, &shot, preview->picture_number);
    } else {
        dip_live_rest(preview->live);
    }
    DipLiveReading reading;
    const bool news = dip_live_read(preview->live, &reading);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        preview->figures[p].live = reading;
    }
    return news;
}

// One turn of the loop. Returns whether something was shown.
static bool turn(Preview *preview, int64_t now_ns, int64_t elapsed_ns, bool *shown, DipError *err) {
    DipPreviewState *state = &preview->state;
    const bool had_notice = state->notice[0] != '\0';
    fly(preview, elapsed_ns);
    dip_preview_advance(state, elapsed_ns, now_ns);
    if (state->full_screen != preview->full_screen) {
        preview->full_screen = state->full_screen;
        dip_window_full_screen(preview->window, state->full_screen);
        preview->redraw = true;
    }
    const bool new_scene =
        state->scene_changes != preview->drawn_changes || preview->redraw || alternates(preview);
    if (new_scene && !draw_panes(preview, err)) {
        return false;
    }
    const bool news = judge_pictures(preview, now_ns);
    *shown = new_scene || news || state->screenshot || (had_notice && !state->notice[0]);
    if (!*shown) {
        return true;
    }
    preview->drawn_changes = state->scene_changes;
    preview->redraw = false;
    update_figures(preview, now_ns);
    if (state->screenshot) {
        take_screenshot(preview, now_ns);
    }
    dip_window_present(preview->window, state, preview->figures);
    dip_start_times_frame(&preview->session->times);
    dip_ahead_begin(&preview->ahead, preview->session->scene);
    dip_timing_add(&preview->presented, dip_clock_ns(), 0.0);
    return true;
}

// Waits for the next picture of the screen, or, when nothing moves, for an event.
static void wait_for_turn(bool shown, int64_t begun_ns, int64_t refresh_ns) {
    if (!shown) {
        SDL_WaitEventTimeout(NULL, IDLE_WAIT_MS);
        return;
    }
    const int64_t left_ns = refresh_ns - (dip_clock_ns() - begun_ns);
    if (left_ns >= 1000000) {
        SDL_Delay((Uint32)(left_ns / 1000000));
    }
}

static bool run_loop(Preview *preview, DipError *err) {
    const int64_t refresh_ns = dip_window_refresh_ns(preview->window);
    int64_t last_ns = dip_clock_ns();
    while (!preview->state.quit) {
        const int64_t now_ns = dip_clock_ns();
        SDL_Event event;
        while (SDL_PollEvent(&event)) {
            handle_event(preview, &event, now_ns);
        }
        if (preview->state.quit) {
            break; // without another frame
        }
        const int64_t since_ns = now_ns - last_ns;
        const int64_t elapsed_ns = since_ns < longest_step_ns ? since_ns : longest_step_ns;
        bool shown = false;
        if (!turn(preview, now_ns, elapsed_ns, &shown, err)) {
            return false;
        }
        last_ns = now_ns;
        wait_for_turn(shown, now_ns, refresh_ns);
    }
    return true;
}

static bool load_costs(DipCosts *costs, const DipSession *session, const char *report,
                       DipError *err) {
    char scene[DIP_COST_TEXT];
    dip_cost_scene_name(session, scene);
    return dip_costs_load(costs, report, scene, err);
}

bool dip_preview_run(DipSession *session, const DipPreviewOptions *options, DipError *err) {
    Preview preview = {.session = session, .redraw = true};
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        preview.drawn_quality[p] = dip_renderer_quality(session->renderers[p]);
    }
    preview.state = dip_preview_state_make(preview.drawn_quality, &session->track);
    preview.speed_m_per_s = flying_speed(session);
    static DipCosts costs;
    if (options->cost_report && !load_costs(&costs, session, options->cost_report, err)) {
        return false;
    }
    preview.state.costs = options->cost_report ? &costs : NULL;
    preview.window = dip_window_create(session->pane_size.width, session->pane_size.height, err);
    const bool done = preview.window && run_loop(&preview, err);
    session->times.ended_ns = dip_clock_ns();
    dip_live_destroy(&preview.live);
    dip_ahead_end(&preview.ahead);
    dip_window_destroy(&preview.window);
    return done;
}
