// Runs the turns of the preview.
#include "app/preview/loop.h"

#include "app/preview/compare.h"
#include "app/preview/controller.h"
#include "app/preview/error_thread.h"
#include "app/preview/figures.h"
#include "app/preview/handover.h"
#include "app/preview/keys.h"
#include "app/preview/poses.h"
#include "app/preview/live_prices.h"
#include "app/preview/maps.h"
#include "app/preview/pilot.h"
#include "app/preview/prefetch.h"
#include "app/preview/reload.h"
#include "app/preview/screenshot.h"
#include "app/preview/speed.h"
#include "app/preview/view.h"
#include "app/session.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// After a stall, the camera moves on by at most this time, so that it does not jump.
static const int64_t longest_step_ns = 250000000;
static const int64_t ns_per_ms = 1000000;
// Rough prices are measured for about this time in each turn.
static const double price_budget_ms = 8.0;
static const int least_truth_samples = 32; // Errors of prices against a coarser truth mislead.
enum { IDLE_WAIT_MS = 30 };

// Everything that decides what the pictures show. There is one exception: the sample pattern that
// temporal antialiasing uses in this frame.
typedef struct Drawn {
    DipPose pose;
    int64_t play_ns;
    DipQuality quality[DIP_PANE_COUNT];
    int width;
    int height;
    int look;
    const void *gallery;
} Drawn;

struct DipPreview {
    DipPreviewDef def;
    DipPreviewState state;
    DipView *view;
    DipPrices *prices;          // Owned unless it is that of the def.
    DipLivePrices *live_prices; // NULL if no prices are measured.
    DipTools *tools;
    DipPathEditor *editor;
    DipTextView text; // Used if the display shows characters.
    DipFigures figures;
    DipPrefetch prefetch;
    DipErrorThread *errors; // NULL until errors are first wanted.
    bool no_truth;          // The thread could not be made for the prices, which do without.
    DipHeldKeys held;
    DipControllers controllers;
    int64_t turn_ns; // When the last turn began.
    int64_t refresh_ns;
    int64_t due_ns; // When the frame of the last turn was due.
    DipTaaPace taa_pace;
    bool full_screen;
    bool resized;   // The panes' size may have changed.
    int pane_width; // Size of a pane in the last turn.
    int pane_height;
    int tried_width; // Size that the renderers last got, or were refused for lack of memory.
    int tried_height;
    int64_t blinks_ns;     // When the comparison shows another picture, or INT64_MAX.
    bool redraw;           // The overlay may have changed.
    bool exposed;          // The display lost its picture, so all of it must be presented.
    bool flying;           // The user moved the camera in this turn.
    DipPose pose;          // Pose of the frame.
    DipSessionFrame frame; // The frame that was drawn last.
    uint64_t frame_index;
    unsigned drawn_changes;                   // Value of state.scene_changes at the last frame.
    DipQuality drawn_quality[DIP_PANE_COUNT]; // Settings of the renderers.
    DipQuality first_quality[DIP_PANE_COUNT]; // Settings with which the session began.
    int drawn_look;
    Drawn drawn;
    unsigned picture_number; // Number of the current pictures; grows when `drawn` changes.
};

static int64_t clock_ns(const DipPreview *preview) {
    return preview->def.display.now_ns(preview->def.display.context);
}

static void follow_refresh(DipPreview *preview) {
    const double hz = preview->def.display.refresh_hz(preview->def.display.context);
    preview->refresh_ns = (int64_t)(1e9 / hz);
}

static DipViewInput view_input(DipPreview *preview, int64_t now_ns);

static bool create_live_prices(DipPreview *preview, DipError *err) {
    if (!preview->def.measures_prices) {
        return true;
    }
    preview->live_prices = dip_live_prices_create(preview->def.session, preview->prices, err);
    if (preview->live_prices) {
        dip_live_prices_enter_scene(preview->live_prices);
    }
    return preview->live_prices != NULL;
}

DipPreview *dip_preview_create(const DipPreviewDef *def, DipError *err) {
    DipPreview *preview = calloc(1, sizeof *preview);
    if (!preview) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "preview", "out of memory");
        return NULL;
    }
    preview->def = *def;
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        preview->drawn_quality[p] = dip_painter_quality(def->session->renderers[p]);
    }
    memcpy(preview->first_quality, preview->drawn_quality, sizeof preview->first_quality);
    preview->state = dip_preview_state_make(preview->drawn_quality, &def->session->track);
    preview->state.costs = def->costs;
    dip_scene_words(def->session->options, preview->state.scene_words);
    preview->state.shows_gallery = def->session->shows_gallery;
    dip_pilot_enter(&preview->state.flight, def->session);
    if (def->session->shows_gallery) {
        preview->state.look = preview->drawn_look = def->session->options->look;
    }
    preview->resized = true;
    preview->figures.outdated = true;
    preview->turn_ns = clock_ns(preview);
    follow_refresh(preview);
    if (def->notice) {
        dip_preview_notice(&preview->state, preview->turn_ns, "%s", def->notice);
    }
    preview->view = dip_view_create(def->display.set_text ? &preview->text : NULL, err);
    preview->prices = def->prices || !preview->view ? def->prices : dip_prices_create(err);
    preview->tools = preview->view && preview->prices ? dip_tools_create(err) : NULL;
    preview->editor = preview->tools ? dip_path_editor_create(err) : NULL;
    preview->state.editor = preview->editor;
    if (!preview->editor || !create_live_prices(preview, err)) {
        dip_preview_destroy(&preview);
        return NULL;
    }
    if (def->ui_scale > 0.0) {
        preview->state.tools.ui_scale = def->ui_scale;
    }
    // An open drawer would cover the current pane.
    preview->state.tools.open = dip_preview_layout(preview).side == DIP_DOCK_BELOW;
    return preview;
}

void dip_preview_destroy(DipPreview **preview_pointer) {
    DipPreview *preview = *preview_pointer;
    if (!preview) {
        return;
    }
    *preview_pointer = NULL;
    dip_error_thread_destroy(&preview->errors);
    dip_prefetch_end(&preview->prefetch);
    dip_path_editor_destroy(&preview->editor);
    dip_tools_destroy(&preview->tools);
    dip_live_prices_destroy(&preview->live_prices);
    if (!preview->def.prices) {
        dip_prices_destroy(&preview->prices);
    }
    dip_view_destroy(&preview->view);
    dip_text_view_free(&preview->text);
    free(preview);
}

// --- events ------------------------------------------------------------------------------------

// What the window shows now, and where.
static DipViewInput view_input(DipPreview *preview, int64_t now_ns) {
    const DipDisplay *display = &preview->def.display;
    DipViewInput input = {
        .scale = display->scale(display->context),
        .now_ns = now_ns,
        .state = &preview->state,
        .figures = preview->figures.shown,
        .prices = preview->prices,
        .tools = preview->tools,
        .text = display->set_text ? &preview->text : NULL,
        .still = dip_preview_rests(&preview->state, preview->flying),
    };
    display->size(display->context, &input.width, &input.height);
    return input;
}

static DipPreviewMoment moment_of(DipPreview *preview, int64_t now_ns) {
    return (DipPreviewMoment){
        .state = &preview->state,
        .session = preview->def.session,
        .display = &preview->def.display,
        .figures = preview->figures.shown,
        .panes = preview->frame.panes,
        .picture = dip_view_picture(preview->view),
        .drawn = preview->picture_number != 0 && !preview->redraw && !preview->resized &&
                 preview->state.scene_changes == preview->drawn_changes,
        .now_ns = now_ns,
    };
}

static void take_control(DipPreview *preview) {
    const DipPreviewControl *control = &preview->def.control;
    if (control->turn && !preview->state.quit) {
        const DipPreviewMoment moment = moment_of(preview, clock_ns(preview));
        preview->redraw = control->turn(control->context, &moment) || preview->redraw;
    }
}

// Hands an event to the window's controls. Returns whether one of them took it. The panes
// change their size if the dock was opened or folded.
static bool handle_in_window(DipPreview *preview, const DipEvent *event, int64_t now_ns) {
    const DipViewInput input = view_input(preview, now_ns);
    preview->redraw = true;
    return dip_view_handle(preview->view, &input, event);
}

static void drop_file(DipPreview *preview, const char *file, int64_t now_ns) {
    if (preview->def.reload && file && !dip_reload_drop(preview->def.reload, file)) {
        dip_preview_notice(&preview->state, now_ns, "Too many files wait to be opened");
        preview->redraw = true;
    }
}

// A key acts on the control with the focus or, if no control takes it, on the preview. Escape first
// takes the focus away.
static void press_key(DipPreview *preview, const DipEvent *event, int64_t now_ns) {
    const DipFrame *frame = &preview->frame.panes[DIP_PANE_CURRENT];
    DipUi *ui = dip_view_ui(preview->view);
    dip_keys_hold(&preview->held, event);
    if (handle_in_window(preview, event, now_ns)) {
        return;
    }
    if (event->key == DIP_KEYCODE_ESCAPE && dip_ui_focus(ui)) {
        dip_ui_blur(ui);
        return;
    }
    if (!dip_loupe_press(&preview->state, frame->width, frame->height, event)) {
        dip_keys_press(&preview->state, event, now_ns);
    }
}

// The key that blinks shows the other picture while it is held.
static void release_key(DipPreview *preview, const DipEvent *event) {
    if (event->key == (DipKeycode)';' && preview->state.tools.blinked) {
        preview->state.tools.blinked = false;
        preview->redraw = true;
    }
}

static void handle_event(DipPreview *preview, const DipEvent *event, int64_t now_ns) {
    if (preview->def.display.set_text &&
        dip_text_view_event(&preview->text, &preview->state, event, now_ns)) {
        preview->redraw = true;
        return;
    }
    switch (event->kind) {
    case DIP_EVENT_QUIT:
        preview->state.quit = true;
        break;
    case DIP_EVENT_KEY_DOWN:
        press_key(preview, event, now_ns);
        break;
    case DIP_EVENT_KEY_UP:
        dip_keys_hold(&preview->held, event);
        release_key(preview, event);
        break;
    case DIP_EVENT_MOUSE_DOWN:
        if (preview->def.control.press) {
            const DipPreviewMoment moment = moment_of(preview, now_ns);
            preview->def.control.press(preview->def.control.context, &moment, event);
        }
        handle_in_window(preview, event, now_ns);
        break;
    case DIP_EVENT_MOUSE_UP:
    case DIP_EVENT_MOUSE_MOVE:
    case DIP_EVENT_MOUSE_WHEEL:
        handle_in_window(preview, event, now_ns);
        break;
    case DIP_EVENT_RESIZE:
        preview->resized = true;
        break;
    case DIP_EVENT_EXPOSE:
        preview->exposed = true;
        break;
    case DIP_EVENT_DROP:
        drop_file(preview, event->file, now_ns);
        break;
    default:
        break;
    }
}

// A button of a game controller has an action or stands for a key.
static void handle_controller(DipPreview *preview, const DipEvent *event, int64_t now_ns) {
    DipEvent key;
    if (dip_controllers_handle(&preview->controllers, &preview->state, event, now_ns, &key)) {
        handle_event(preview, &key, now_ns);
    }
    preview->redraw |= event->kind != DIP_EVENT_CONTROLLER_AXIS;
}

// Returns whether there was an event.
static bool take_event(DipPreview *preview, int timeout_ms) {
    DipEvent event;
    if (!preview->def.display.next_event(preview->def.display.context, timeout_ms, &event)) {
        return false;
    }
    if (dip_controllers_concern(&event)) {
        handle_controller(preview, &event, clock_ns(preview));
    } else {
        handle_event(preview, &event, clock_ns(preview));
    }
    return true;
}

static void fly(DipPreview *preview, int64_t elapsed_ns) {
    const DipPilotTurn turn = {.session = preview->def.session,
                               .keys = dip_keys_camera(&preview->held),
                               .controllers = &preview->controllers,
                               .speed_m_per_s = preview->def.flying_speed_m_per_s,
                               .elapsed_ns = elapsed_ns};
    preview->flying = dip_pilot_turn(&preview->state, &turn, &preview->pose);
    preview->state.scene_changes += preview->flying;
}

// --- pictures -----------------------------------------------------------------------------------

// Sets the renderers to the panes' settings. If a pane's settings change, forgets the pane's
// times.
static bool follow_settings(DipPreview *preview, DipError *err) {
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        const DipQuality *wanted = &preview->state.quality[p];
        if (memcmp(wanted, &preview->drawn_quality[p], sizeof *wanted) == 0) {
            continue;
        }
        if (!dip_painter_set_quality(preview->def.session->renderers[p], wanted, err)) {
            return false;
        }
        preview->drawn_quality[p] = *wanted;
        dip_figures_forget(&preview->figures, p);
    }
    return true;
}

// Tells the user about an error that does not end the preview.
static void report(DipPreview *preview, const DipError *err, int64_t now_ns) {
    char line[512];
    dip_error_format(err, line, sizeof line);
    dip_preview_notice(&preview->state, now_ns, "%.120s", line);
}

static bool fail(const DipError *failure, DipError *err) {
    if (err) {
        *err = *failure;
    }
    return false;
}

static bool resize_panes(DipPreview *preview, int width, int height, DipError *err) {
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        if (!dip_painter_resize(preview->def.session->renderers[p], width, height, err)) {
            return false;
        }
    }
    return true;
}

// Goes back to the size of the last frame, after memory ran out for a new size. The view scales
// the frames to the panes. Returns false if there was no frame.
static bool keep_size(DipPreview *preview, DipError *err) {
    if (err->code != DIP_ERROR_MEMORY || preview->picture_number == 0) {
        return false;
    }
    report(preview, err, clock_ns(preview));
    return resize_panes(preview, preview->drawn.width, preview->drawn.height, err);
}

// Sets the renderers to the panes' size. A frame's size is limited; if the display is larger,
// the view scales the frame up.
static bool follow_size(DipPreview *preview, DipError *err) {
    const DipViewInput input = view_input(preview, clock_ns(preview));
    const DipLayout layout = dip_view_layout(&input);
    int width, height;
    dip_compare_frame_size(&layout, preview->state.tools.comparison, &width, &height);
    width = width < DIP_MAX_FRAME_SIZE ? width : DIP_MAX_FRAME_SIZE;
    height = height < DIP_MAX_FRAME_SIZE ? height : DIP_MAX_FRAME_SIZE;
    if (width == preview->tried_width && height == preview->tried_height) {
        return true;
    }
    DipError failure;
    if (!resize_panes(preview, width, height, &failure) && !keep_size(preview, &failure)) {
        return fail(&failure, err);
    }
    preview->tried_width = width;
    preview->tried_height = height;
    return true;
}

static void number_picture(DipPreview *preview) {
    Drawn drawn;
    memset(&drawn, 0, sizeof drawn); // memcmp compares the padding, too.
    drawn.pose = preview->pose;
    drawn.play_ns = preview->state.play_ns;
    drawn.width = preview->frame.panes[0].width;
    drawn.height = preview->frame.panes[0].height;
    drawn.look = preview->drawn_look;
    drawn.gallery = preview->def.session->gallery;
    memcpy(drawn.quality, preview->drawn_quality, sizeof drawn.quality);
    if (memcmp(&drawn, &preview->drawn, sizeof drawn) != 0) {
        preview->drawn = drawn;
        ++preview->picture_number;
    }
}

static bool draw_with_settings(DipPreview *preview, DipError *err) {
    return follow_settings(preview, err) &&
           dip_session_draw_pose(preview->def.session, &preview->pose, preview->state.play_ns,
                                 preview->frame_index, &preview->frame, err);
}

// Draws with the settings of the last frame, after memory ran out for new settings. Returns
// false if the settings were not new.
static bool take_back_settings(DipPreview *preview, DipError *err) {
    const size_t size_bytes = sizeof preview->drawn.quality;
    if (err->code != DIP_ERROR_MEMORY || preview->picture_number == 0 ||
        memcmp(preview->state.quality, preview->drawn.quality, size_bytes) == 0) {
        return false;
    }
    report(preview, err, clock_ns(preview));
    memcpy(preview->state.quality, preview->drawn.quality, size_bytes);
    return draw_with_settings(preview, err);
}

// Shows the scene that the user has asked for. If it cannot be opened, a notice says why and
// the old scene stays.
static void follow_scene(DipPreview *preview, int64_t now_ns) {
    DipSession *session = preview->def.session;
    DipPreviewState *state = &preview->state;
    const int step = state->scene_step;
    DipError failure;
    state->scene_step = 0;
    if (step == 0) {
        if (session->gallery && state->look != preview->drawn_look) {
            dip_gallery_set_look(session->gallery, state->look);
            preview->drawn_look = state->look;
        }
        return;
    }
    if (preview->live_prices) {
        dip_live_prices_leave_scene(preview->live_prices);
    }
    if (!dip_session_step_scene(session, step, &failure)) {
        report(preview, &failure, now_ns);
        return;
    }
    if (preview->live_prices) {
        dip_live_prices_enter_scene(preview->live_prices);
    }
    state->shows_gallery = session->shows_gallery;
    preview->tried_width = 0; // the new renderers do not have the panes' size yet
    state->look = preview->drawn_look = 0;
    state->play_ns = 0;
    state->manual = false;
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        dip_figures_forget(&preview->figures, p);
    }
    dip_preview_notice(state, now_ns, "Scene: %s", dip_session_scene_title(session, 0));
    ++state->scene_changes;
}

// --- new sessions ------------------------------------------------------------------------------

// Gives the maps the newest error pictures.
static void show_errors(DipPreview *preview, const DipErrorReading *reading) {
    dip_maps_set_errors(dip_tools_maps(preview->tools), reading,
                        preview->errors ? dip_error_thread_pictures(preview->errors) : NULL);
}

// Replaces the session by the new one. The threads that read the old scene end first.
static void use_new_session(DipPreview *preview, bool dropped) {
    const DipErrorReading nothing = {.status = DIP_ERROR_STATUS_PAUSED};
    DipSession *session = preview->def.session;
    dip_error_thread_destroy(&preview->errors);
    preview->no_truth = false;
    show_errors(preview, &nothing); // The pictures of the errors were the thread's.
    dip_prefetch_end(&preview->prefetch);
    preview->prefetch = (DipPrefetch){.running = false};
    if (preview->live_prices) {
        dip_live_prices_leave_scene(preview->live_prices);
    }
    dip_handover(preview->def.reload, session, &preview->state, preview->first_quality, dropped);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        preview->drawn_quality[p] = dip_painter_quality(session->renderers[p]);
        dip_figures_forget(&preview->figures, p);
    }
    if (preview->live_prices) {
        dip_live_prices_enter_scene(preview->live_prices);
    }
    preview->drawn_look = preview->state.look;
    preview->def.flying_speed_m_per_s = dip_flying_speed(session);
    dip_pilot_enter(&preview->state.flight, session);
    preview->tried_width = 0; // The new renderers do not have the panes' size yet.
    ++preview->picture_number;
}

static void follow_reload(DipPreview *preview, int64_t now_ns) {
    DipReloadNews news;
    if (!preview->def.reload || !dip_reload_poll(preview->def.reload, now_ns, &news)) {
        return;
    }
    if (news.kind == DIP_RELOAD_SESSION) {
        use_new_session(preview, news.dropped);
    } else if (news.kind == DIP_RELOAD_COSTS) {
        preview->state.costs = dip_reload_costs(preview->def.reload);
        preview->state.next_advice = 0;
    }
    dip_preview_notice(&preview->state, now_ns, "%s", news.notice);
    preview->redraw = true;
}

static bool draw_panes(DipPreview *preview, DipError *err) {
    DipSession *session = preview->def.session;
    const int64_t play_ns = preview->state.play_ns;
    if (!follow_size(preview, err)) {
        return false;
    }
    preview->state.scene_title =
        session->shows_gallery ? dip_session_scene_title(session, play_ns) : NULL;
    preview->state.scene_look = session->shows_gallery
                                    ? dip_session_scene_look(session, preview->state.look, play_ns)
                                    : NULL;
    if (!preview->state.manual && !dip_camtrack_pose(&session->track, play_ns, &preview->pose)) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "path", "there is no camera path");
    }
    DipError failure;
    if (!draw_with_settings(preview, &failure) && !take_back_settings(preview, &failure)) {
        return fail(&failure, err);
    }
    number_picture(preview);
    dip_scene_words(preview->def.session->options, preview->state.scene_words);
    preview->state.pane_width = preview->frame.panes[0].width;
    preview->state.pane_height = preview->frame.panes[0].height;
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        dip_view_set_frame(preview->view, p, &preview->frame.panes[p]);
    }
    dip_figures_add(&preview->figures, &preview->frame, clock_ns(preview));
    preview->drawn_changes = preview->state.scene_changes;
    preview->resized = false;
    ++preview->frame_index;
    return true;
}

// Returns whether temporal antialiasing changes a pane's picture from frame to frame even if
// nothing moves.
static bool pane_alternates(const DipPreview *preview, int pane) {
    const DipQuality *quality = &preview->state.quality[pane];
    return quality->step[DIP_SETTING_TAA] != 0 && dip_quality_sample_count(quality) > 1;
}

static bool alternates(const DipPreview *preview) {
    return pane_alternates(preview, DIP_PANE_CURRENT) ||
           pane_alternates(preview, DIP_PANE_REQUESTED);
}

// Lets the panes with temporal antialiasing say whether frames come fast enough. What they say
// changes only as often as the other figures.
static void judge_taa(DipPreview *preview, int64_t now_ns) {
    const DipTaaSpeed speed =
        dip_taa_pace_update(&preview->taa_pace, alternates(preview), &preview->figures.presented,
                            preview->refresh_ns, now_ns);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        DipTaaSpeed *shown = &preview->figures.shown[p].taa_speed;
        if (!pane_alternates(preview, p)) {
            *shown = (DipTaaSpeed){.too_slow = false};
        } else if (preview->figures.updated_ns == now_ns) {
            *shown = speed;
        }
    }
}

// --- errors of the pictures ---------------------------------------------------------------------

// Returns whether rough prices are measured: the dock shows them, and nothing moves.
static bool wants_prices(const DipPreview *preview) {
    const DipPreviewState *state = &preview->state;
    return preview->live_prices && dip_prices_are_rough(preview->prices) && state->tools.open &&
           !state->tools.bare && dip_preview_rests(state, preview->flying);
}

// Returns whether the tags of the settings wait for the truth, from which their errors are
// measured. It is drawn only once all times are known, because it would disturb them.
static bool prices_need_truth(const DipPreview *preview) {
    return preview->state.tools.tab == DIP_TAB_SETTINGS && !preview->no_truth &&
           wants_prices(preview) && dip_live_prices_have_times(preview->live_prices);
}

// Returns whether the user looks at errors or at the truth.
static bool shows_errors(const DipPreview *preview) {
    const DipPreviewState *state = &preview->state;
    return state->panel || state->wants_errors || dip_maps_need_errors(&state->tools);
}

static bool wants_errors(const DipPreview *preview) {
    return !preview->def.session->shows_gallery &&
           dip_preview_rests(&preview->state, preview->flying) &&
           (shows_errors(preview) || prices_need_truth(preview));
}

static void close_errors(DipPreview *preview) {
    preview->state.tools.open = preview->state.wants_errors = false;
    dip_maps_choose(&preview->state.tools, DIP_MAP_NONE);
    preview->resized = true;
    dip_preview_follow_dock(&preview->state);
}

static bool create_errors(DipPreview *preview, int64_t now_ns) {
    const DipSession *session = preview->def.session;
    DipError err;
    if (!preview->errors && preview->def.load_scene_def(preview->def.context, &err)) {
        preview->errors = dip_error_thread_create(&session->scene_def, &session->reflection, &err);
    }
    if (!preview->errors) {
        report(preview, &err, now_ns);
        if (shows_errors(preview)) {
            close_errors(preview);
        }
        preview->no_truth = true;
    }
    return preview->errors != NULL;
}

static bool shows_mips(const DipPreview *preview, int pane) {
    return preview->drawn.quality[pane].step[DIP_SETTING_MIPDEBUG] != 0;
}

static DipStill still_of(const DipPreview *preview) {
    const DipFrame *current = &preview->frame.panes[DIP_PANE_CURRENT];
    const DipFrame *requested = &preview->frame.panes[DIP_PANE_REQUESTED];
    return (DipStill){
        .pose = preview->drawn.pose,
        .time_ns = preview->drawn.play_ns,
        .width = current->width,
        .height = current->height,
        .stride_bytes = current->stride_bytes,
        .rgba8 = {current->rgba8, preview->frame.copied ? NULL : requested->rgba8},
        .unjudged = {shows_mips(preview, DIP_PANE_CURRENT),
                     shows_mips(preview, DIP_PANE_REQUESTED)},
    };
}

// Measures errors while the window shows them and the camera rests. Returns whether there are new
// errors to show.
static bool measure_errors(DipPreview *preview, int64_t now_ns) {
    const bool gallery = preview->def.session->shows_gallery;
    const bool measures = wants_errors(preview);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        preview->figures.shown[p].no_errors = gallery;
        preview->figures.shown[p].mip_colours = shows_mips(preview, p);
    }
    if (!preview->errors && !(measures && create_errors(preview, now_ns))) {
        return false;
    }
    if (measures) {
        const DipStill still = still_of(preview);
        dip_error_thread_measure(preview->errors, &still, preview->picture_number);
    } else {
        dip_error_thread_pause(preview->errors);
    }
    DipErrorReading reading;
    const bool news = dip_error_thread_read(preview->errors, &reading);
    show_errors(preview, &reading);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        preview->figures.shown[p].errors = reading;
    }
    return news;
}

// Returns the truth of the picture that the panes show, or NULL while it is too noisy for prices.
static const DipErrorPictures *truth_for_prices(const DipPreview *preview) {
    const DipErrorPictures *pictures = preview->errors && wants_errors(preview)
                                           ? dip_error_thread_pictures(preview->errors)
                                           : NULL;
    return pictures && pictures->result.samples >= least_truth_samples ? pictures : NULL;
}

// Measures rough prices while the dock is open and the camera rests. Returns whether the dock must
// be drawn again.
static bool measure_prices(DipPreview *preview) {
    if (!preview->live_prices) {
        return false;
    }
    if (!wants_prices(preview)) {
        dip_live_prices_pause(preview->live_prices);
        return false;
    }
    const DipLivePicture picture = {
        .pose = preview->drawn.pose,
        .time_ns = preview->drawn.play_ns,
        .width = preview->drawn.width,
        .height = preview->drawn.height,
        .look = preview->drawn.look,
    };
    const DipErrorPictures *pictures = truth_for_prices(preview);
    const DipSrgbPicture truth =
        pictures ? (DipSrgbPicture){pictures->truth_rgba8, 4 * (size_t)pictures->width,
                                    pictures->width, pictures->height}
                 : (DipSrgbPicture){.width = 0};
    // A picture has one truth for each number of samples.
    return dip_live_prices_step(preview->live_prices, &picture, preview->drawn_quality,
                                pictures ? &truth : NULL,
                                pictures ? (uint64_t)pictures->result.samples : 0, price_budget_ms);
}

// --- showing -----------------------------------------------------------------------------------

static bool draw_view(DipPreview *preview, DipError *err) {
    const DipViewInput input = view_input(preview, clock_ns(preview));
    return dip_view_draw(preview->view, &input, err);
}

static void save_picture(DipPreview *preview, int64_t now_ns) {
    DipPreviewState *state = &preview->state;
    const DipPixels picture = dip_view_picture(preview->view);
    const DipScreenshot shot = {
        .picture = state->plain_screenshot ? NULL : &picture,
        .session = preview->def.session,
        .frame = &preview->frame,
        .quality = preview->drawn_quality,
        .pose = &preview->drawn.pose,
        .time_ns = preview->drawn.play_ns,
        .free_camera = state->manual,
    };
    char file[64];
    char text[DIP_NOTICE_SIZE];
    DipError err;
    state->screenshot = false;
    if (dip_screenshot_save(&shot, file, sizeof file, &err)) {
        dip_saved_describe("Saved", file, text, sizeof text);
        dip_preview_notice(state, now_ns, "%s", text);
    } else {
        report(preview, &err, now_ns);
    }
}

// Adds the pose of the last frame to the file of saved poses.
static void save_pose(DipPreview *preview, int64_t now_ns) {
    DipPreviewState *state = &preview->state;
    size_t count = 0;
    DipError err;
    state->save_pose = false;
    if (dip_poses_append(DIP_POSES_FILE, &preview->drawn.pose, &count, &err)) {
        char what[64];
        char text[DIP_NOTICE_SIZE];
        snprintf(what, sizeof what, "Saved pose %zu to", count);
        dip_saved_describe(what, DIP_POSES_FILE, text, sizeof text);
        dip_preview_notice(state, now_ns, "%s", text);
    } else {
        report(preview, &err, now_ns);
    }
    preview->redraw = true;
}

static bool present(DipPreview *preview, DipError *err) {
    const DipDisplay *display = &preview->def.display;
    if (preview->exposed) {
        dip_view_damage_all(preview->view);
        preview->exposed = false;
    }
    const DipPixels picture = dip_view_picture(preview->view);
    const DipDamage damage = dip_view_take_damage(preview->view);
    if (display->set_text) {
        const DipTextScreen *screen = &preview->text.screen;
        display->set_text(display->context, screen->cells, screen->columns, screen->rows);
    }
    return display->present(display->context, &picture, damage.rects, damage.count, err);
}

// Gives the requested pane the settings that the clipboard holds as text, if the user asked for it.
static void paste_settings(DipPreview *preview, int64_t now_ns) {
    const DipDisplay *display = &preview->def.display;
    DipPreviewState *state = &preview->state;
    DipQuality quality;
    DipError err;
    char text[512];
    if (!state->paste_settings) {
        return;
    }
    state->paste_settings = false;
    if (!display->get_clipboard || !display->get_clipboard(display->context, text, sizeof text)) {
        dip_preview_notice(state, now_ns, "The clipboard holds no text");
        return;
    }
    text[strcspn(text, " \t\r\n")] = '\0';
    if (!dip_quality_parse(text, &quality, &err)) {
        report(preview, &err, now_ns);
        return;
    }
    dip_preview_set_quality(state, DIP_PANE_REQUESTED, &quality, now_ns);
    dip_preview_notice(state, now_ns, "Pasted: %.120s", text);
}

// Copies the requested settings as text, if the user asked for it.
static void copy_settings(DipPreview *preview, int64_t now_ns) {
    const DipDisplay *display = &preview->def.display;
    char text[256];
    if (!preview->state.copy_settings) {
        return;
    }
    preview->state.copy_settings = false;
    dip_quality_format(&preview->state.quality[DIP_PANE_REQUESTED], text, sizeof text);
    if (display->set_clipboard && display->set_clipboard(display->context, text)) {
        dip_preview_notice(&preview->state, now_ns, "Copied: %s", text);
    } else {
        dip_preview_notice(&preview->state, now_ns, "This display has no clipboard: %s", text);
    }
}

// Lets the tools draw what the window has asked them for.
static void update_tools(DipPreview *preview) {
    const DipFrame *frame = &preview->frame.panes[DIP_PANE_CURRENT];
    const DipToolsInput input = {
        .session = preview->def.session,
        .pose = &preview->drawn.pose,
        .play_ns = preview->drawn.play_ns,
        .frame_index = preview->frame_index - 1,
        .versions = {dip_view_version(preview->view, DIP_PANE_CURRENT),
                     dip_view_version(preview->view, DIP_PANE_REQUESTED)},
        .width = frame->width,
        .height = frame->height,
        .copied = preview->frame.copied,
        .still = dip_preview_rests(&preview->state, preview->flying),
    };
    preview->redraw |= dip_tools_update(preview->tools, &input);
}

static bool show(DipPreview *preview, int64_t now_ns, DipError *err) {
    const bool moving = !dip_preview_rests(&preview->state, preview->flying);
    dip_figures_update(&preview->figures, moving, now_ns);
    judge_taa(preview, now_ns);
    if (!draw_view(preview, err)) {
        return false;
    }
    if (preview->state.screenshot) {
        save_picture(preview, now_ns);
        if (!draw_view(preview, err)) { // Adds the notice that names the file.
            return false;
        }
    }
    preview->redraw = false;
    if (!present(preview, err)) {
        return false;
    }
    dip_start_times_frame(&preview->def.session->times);
    if (preview->def.session->scene) {
        dip_prefetch_begin(&preview->prefetch, preview->def.session->scene);
    }
    dip_figures_count_presented(&preview->figures, moving, preview->refresh_ns, clock_ns(preview));
    update_tools(preview);
    preview->blinks_ns = dip_compare_wakes_ns(&preview->state.tools, now_ns);
    return true;
}

// Notices that settings which show or hide in characters leave the panes another size.
static void follow_text(DipPreview *preview) {
    const DipDisplay *display = &preview->def.display;
    int width, height;
    if (display->set_text) {
        display->size(display->context, &width, &height);
        preview->resized = dip_text_view_follow(&preview->text, &preview->state, width, height) ||
                           preview->resized;
    }
}

static void follow_full_screen(DipPreview *preview) {
    const DipDisplay *display = &preview->def.display;
    if (preview->state.full_screen == preview->full_screen) {
        return;
    }
    preview->full_screen = preview->state.full_screen;
    if (display->set_full_screen) {
        display->set_full_screen(display->context, preview->full_screen);
    }
}

// Notices whether the panes have another size, because the dock was opened or folded.
static void follow_layout(DipPreview *preview) {
    const DipLayout layout = dip_preview_layout(preview);
    int width, height;
    dip_compare_frame_size(&layout, preview->state.tools.comparison, &width, &height);
    preview->resized |= width != preview->pane_width || height != preview->pane_height;
    preview->pane_width = width;
    preview->pane_height = height;
}

// Draws and presents the picture if something has changed. Sets *shown to whether something has
// changed.
static bool draw_turn(DipPreview *preview, int64_t now_ns, bool *shown, DipError *err) {
    DipPreviewState *state = &preview->state;
    const bool had_notice = state->notice[0] != '\0';
    const int64_t since_ns = now_ns - preview->turn_ns;
    const int64_t elapsed_ns = since_ns < longest_step_ns ? since_ns : longest_step_ns;
    preview->turn_ns = now_ns;
    fly(preview, elapsed_ns);
    dip_preview_advance(state, elapsed_ns, now_ns);
    follow_full_screen(preview);
    copy_settings(preview, now_ns);
    paste_settings(preview, now_ns);
    follow_scene(preview, now_ns);
    follow_reload(preview, now_ns);
    follow_layout(preview);
    follow_text(preview);
    if (preview->resized) {
        follow_refresh(preview);
    }
    const bool new_frame =
        state->scene_changes != preview->drawn_changes || preview->resized || alternates(preview);
    if (new_frame && !draw_panes(preview, err)) {
        return false;
    }
    if (state->save_pose) {
        save_pose(preview, now_ns);
    }
    const bool new_errors = measure_errors(preview, now_ns);
    const bool new_prices = measure_prices(preview);
    *shown = new_frame || new_errors || new_prices || preview->redraw || preview->exposed ||
             state->screenshot || (had_notice && !state->notice[0]) ||
             now_ns >= dip_ui_wakes_ns(dip_view_ui(preview->view)) || now_ns >= preview->blinks_ns;
    if (*shown && !show(preview, now_ns, err)) {
        preview->redraw = preview->exposed = true; // The next turn shows what this one could not.
        return false;
    }
    return true;
}

// After a picture was shown, waits for the display's next refresh. Otherwise waits up to
// IDLE_WAIT_MS for an event.
static void wait_for_turn(DipPreview *preview, bool shown) {
    if (!shown) {
        const bool busy = preview->live_prices &&
                          dip_live_prices_are_working(preview->live_prices) &&
                          dip_prices_progress(preview->prices)[0] != '\0';
        take_event(preview, busy ? 0 : IDLE_WAIT_MS);
        return;
    }
    preview->due_ns = dip_taa_pace_next_ns(preview->due_ns, preview->turn_ns, preview->refresh_ns,
                                           clock_ns(preview));
    int64_t left_ns = preview->due_ns - clock_ns(preview);
    while (left_ns >= ns_per_ms && !preview->state.quit) {
        take_event(preview, (int)(left_ns / ns_per_ms));
        left_ns = preview->due_ns - clock_ns(preview);
    }
}

bool dip_preview_turn(DipPreview *preview, DipError *err) {
    bool shown = false;
    while (!preview->state.quit && take_event(preview, 0)) {
    }
    take_control(preview);
    if (preview->state.quit) {
        return true; // The user has quit, so no further frame is drawn.
    }
    if (!draw_turn(preview, clock_ns(preview), &shown, err)) {
        return false;
    }
    wait_for_turn(preview, shown);
    return true;
}

bool dip_preview_has_quit(const DipPreview *preview) {
    return preview->state.quit;
}

const DipPreviewState *dip_preview_state(const DipPreview *preview) {
    return &preview->state;
}

DipPixels dip_preview_picture(const DipPreview *preview) {
    return dip_view_picture(preview->view);
}

DipLayout dip_preview_layout(DipPreview *preview) {
    const DipViewInput input = view_input(preview, clock_ns(preview));
    return dip_view_layout(&input);
}
