// Runs the turns of the preview: hands events to the state and the window, lets time pass, and
// draws and presents what has changed.
#include "app/preview/loop/loop_private.h"

#include "app/cost/plan.h"
#include "app/preview/loop/reload.h"
#include "app/preview/tools/compare.h"
#include "renderer/base/clock.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const int64_t ns_per_ms = 1000000;
enum { IDLE_WAIT_MS = 30 };

int64_t dip_loop_clock_ns(const DipPreview *preview) {
    const DipDisplay *display = &preview->def.display;
    return display->now_ns ? display->now_ns(display->context) : dip_clock_ns();
}

static void follow_refresh(DipPreview *preview) {
    const double hz = preview->def.display.refresh_hz(preview->def.display.context);
    preview->refresh_ns = (int64_t)(1e9 / hz);
    dip_preview_follow_refresh(&preview->state, 1000.0 / hz);
}

DipPreview *dip_preview_create(const DipPreviewDef *def, DipError *err) {
    DipQuality quality[DIP_PANE_COUNT];
    DipPreview *preview = calloc(1, sizeof *preview);
    if (!preview) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "preview", "out of memory");
        return NULL;
    }
    preview->def = *def;
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        quality[p] = dip_painter_quality(def->session->renderers[p]);
    }
    preview->state = dip_preview_state_make(quality, &def->session->track);
    preview->state.costs = def->costs;
    preview->state.choice = &preview->choice;
    preview->state.in_terminal = def->display.set_text != NULL;
    preview->state.animations = &def->session->animations;
    preview->state.shows_gallery = def->session->shows_gallery;
    dip_pilot_enter(&preview->state.flight, def->session);
    if (def->session->shows_gallery) {
        preview->state.look = def->session->options->look;
    }
    preview->resized = true;
    preview->figures.outdated = true;
    preview->turn_ns = dip_loop_clock_ns(preview);
    follow_refresh(preview);
    if (def->session->config.target_fps > 0.0) {
        dip_preview_set_budget(&preview->state, 1000.0 / def->session->config.target_fps);
    }
    if (def->notice) {
        dip_preview_notice(&preview->state, preview->turn_ns, "%s", def->notice);
    }
    preview->view = dip_view_create(def->display.set_text ? &preview->text : NULL, err);
    preview->prices = def->prices || !preview->view ? def->prices : dip_prices_create(err);
    preview->tools = preview->view && preview->prices ? dip_tools_create(err) : NULL;
    preview->state.editor = preview->tools ? dip_path_editor_create(err) : NULL;
    preview->live_prices =
        preview->state.editor ? dip_live_prices_create(def->session, preview->prices, err) : NULL;
    if (!preview->live_prices) {
        dip_preview_destroy(&preview);
        return NULL;
    }
    dip_loop_enter_scene(preview);
    if (def->ui_scale > 0.0) {
        preview->state.tools.ui_scale = def->ui_scale;
        preview->state.tools.fixed_scale = true;
    }
    preview->state.tools.bare = def->hides_panel;
    // Opens the dock, unless it is a drawer (layout.h), which would cover the current pane.
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
    dip_path_editor_destroy(&preview->state.editor);
    dip_tools_destroy(&preview->tools);
    dip_live_prices_destroy(&preview->live_prices);
    if (!preview->def.prices) {
        dip_prices_destroy(&preview->prices);
    }
    dip_preview_choice_free(&preview->choice);
    dip_view_destroy(&preview->view);
    dip_text_screen_free(&preview->text.screen);
    free(preview);
}

DipViewInput dip_loop_view_input(DipPreview *preview, int64_t now_ns) {
    const DipDisplay *display = &preview->def.display;
    DipViewInput input = {
        .scale = display->scale(display->context),
        .text = display->set_text ? &preview->text : NULL,
        .window = {.state = &preview->state,
                   .still = dip_preview_rests(&preview->state, preview->flying),
                   .now_ns = now_ns,
                   .figures = preview->figures.shown,
                   .prices = preview->prices,
                   .tools = preview->tools},
    };
    display->size(display->context, &input.width, &input.height);
    return input;
}

void dip_loop_report(DipPreview *preview, const DipError *err, int64_t now_ns) {
    char text[DIP_NOTICE_SIZE];
    dip_preview_error_text(err, text);
    dip_preview_notice(&preview->state, now_ns, "%s", text);
    dip_preview_keep_notice(&preview->state, now_ns);
}

// --- events --------------------------------------------------------------------------------------

static DipPreviewMoment moment_of(DipPreview *preview, int64_t now_ns) {
    return (DipPreviewMoment){
        .state = &preview->state,
        .session = preview->def.session,
        .display = &preview->def.display,
        .figures = preview->figures.shown,
        .prices = preview->prices,
        .panes = preview->frame.panes,
        .picture = dip_view_picture(preview->view),
        .layout = dip_preview_layout(preview),
        .drawn = preview->picture_number != 0 && !preview->redraw && !preview->resized &&
                 preview->state.scene_changes == preview->drawn_changes,
        .now_ns = now_ns,
    };
}

static void take_control(DipPreview *preview) {
    const DipPreviewControl *control = &preview->def.control;
    if (control->turn && !preview->state.quit) {
        const DipPreviewMoment moment = moment_of(preview, dip_loop_clock_ns(preview));
        preview->redraw = control->turn(control->context, &moment) || preview->redraw;
    }
}

// Hands an event to the window's controls. Returns whether one of them took it.
static bool handle_in_window(DipPreview *preview, const DipEvent *event, int64_t now_ns) {
    const DipViewInput input = dip_loop_view_input(preview, now_ns);
    preview->redraw = true;
    return dip_view_handle(preview->view, &input, event);
}

static void drop_file(DipPreview *preview, const char *file, int64_t now_ns) {
    if (preview->def.reload && file && !dip_reload_drop(preview->def.reload, file)) {
        dip_preview_notice(&preview->state, now_ns, "Too many files wait to be opened");
        preview->redraw = true;
    }
}

// A key acts on the control with the focus or, if no control takes it, on the preview. If a control
// has the focus, Escape only takes the focus away.
static void press_key(DipPreview *preview, const DipEvent *event, int64_t now_ns) {
    const DipFrame *frame = &preview->frame.panes[DIP_PANE_CURRENT];
    DipUi *ui = dip_view_ui(preview->view);
    if (!preview->state.help) { // Letters typed into the help do not fly the camera.
        dip_keys_hold(&preview->held, event);
    }
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

static void handle_event(DipPreview *preview, const DipEvent *event, int64_t now_ns) {
    switch (event->kind) {
    case DIP_EVENT_QUIT:
        preview->state.quit = true;
        break;
    case DIP_EVENT_KEY_DOWN:
        press_key(preview, event, now_ns);
        break;
    case DIP_EVENT_KEY_UP:
        dip_keys_hold(&preview->held, event);
        if (event->key == (DipKeycode)';' && preview->state.tools.blinked) {
            preview->state.tools.blinked = false; // The key shows the other pane while it is held.
            preview->redraw = true;
        }
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

// Waits up to timeout_ms for an event and handles it. Returns whether there was one.
static bool take_event(DipPreview *preview, int timeout_ms) {
    DipEvent event;
    if (!preview->def.display.next_event(preview->def.display.context, timeout_ms, &event)) {
        return false;
    }
    const int64_t now_ns = dip_loop_clock_ns(preview);
    if (dip_controllers_concern(&event)) {
        // A button of a game controller may stand for a key; `key` is then the event of that key.
        DipEvent key;
        if (dip_controllers_handle(&preview->controllers, &preview->state, &event, now_ns, &key)) {
            handle_event(preview, &key, now_ns);
        }
        preview->redraw |= event.kind != DIP_EVENT_CONTROLLER_AXIS;
    } else {
        handle_event(preview, &event, now_ns);
    }
    return true;
}

// Moves the free camera as the user and the path editor ask (dip_pilot_turn).
static void fly(DipPreview *preview, int64_t elapsed_ns) {
    const DipPilotTurn turn = {.session = preview->def.session,
                               .keys = dip_keys_camera(&preview->held),
                               .controllers = &preview->controllers,
                               .elapsed_ns = elapsed_ns};
    preview->flying = dip_pilot_turn(&preview->state, &turn, &preview->pose);
    preview->state.scene_changes += preview->flying;
}

// --- what a turn follows -------------------------------------------------------------------------

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
        dip_loop_report(preview, &err, now_ns);
        return;
    }
    dip_preview_set_quality(state, DIP_PANE_REQUESTED, &quality, now_ns);
    dip_preview_notice(state, now_ns, "Pasted: %.180s", text);
}

// Copies the requested settings as text to the clipboard, if the user asked for it.
static void copy_settings(DipPreview *preview, int64_t now_ns) {
    const DipDisplay *display = &preview->def.display;
    char text[DIP_SETTINGS_BYTES];
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

// Notices whether the panes' frames need another size: the dock may have been opened or folded,
// another comparison chosen, or the settings in a terminal shown or hidden.
static void follow_layout(DipPreview *preview) {
    const DipLayout layout = dip_preview_layout(preview);
    int width, height;
    dip_compare_frame_size(&layout, preview->state.tools.comparison, &width, &height);
    preview->resized |= width != preview->pane_width || height != preview->pane_height;
    preview->pane_width = width;
    preview->pane_height = height;
}

// Finds the settings that can be chosen with the present prices and budget. Returns whether they
// were found anew.
static bool choose(DipPreview *preview) {
    const DipPreviewState *state = &preview->state;
    return dip_preview_choose(&preview->choice, preview->prices,
                              &state->quality[DIP_PANE_REQUESTED], state->budget_ms);
}

// Names the scene in the window's title.
static void follow_title(DipPreview *preview) {
    const DipSession *session = preview->def.session;
    const DipDisplay *display = &preview->def.display;
    char scene[DIP_COST_TEXT], title[sizeof preview->title];
    if (!display->set_title || !session->options) {
        return;
    }
    if (session->shows_gallery) {
        snprintf(scene, sizeof scene, "%s",
                 dip_session_scene_title(session, preview->state.play_ns));
    } else {
        dip_cost_scene_name(session, scene);
    }
    snprintf(title, sizeof title, "Diptych: %.*s", (int)sizeof title - 16, scene);
    if (strcmp(title, preview->title) != 0) {
        memcpy(preview->title, title, sizeof title);
        display->set_title(display->context, title);
    }
}

// When another path or scene plays, finds out whether the camera moves, whether the scene moves,
// and whether the scene has shadows.
static void follow_motion(DipPreview *preview) {
    const DipSession *session = preview->def.session;
    const DipCamPath *path = dip_preview_playing_path(&preview->state);
    if (path != preview->judged_path || session->scene != preview->judged_scene) {
        preview->judged_path = path;
        preview->judged_scene = session->scene;
        preview->state.scene_moves =
            session->shows_gallery || (session->scene && dip_scene_moves(session->scene));
        preview->state.lacks_shadows = session->scene && !dip_scene_has_shadows(session->scene);
        preview->state.stands = session->scene && !preview->state.scene_moves &&
                                dip_preview_path_stands(&preview->state);
    }
}

// Lets time pass, carries out what the user has asked for, and measures. Draws and presents the
// picture if something has changed, and sets *shown to whether it has. `err` must not be NULL.
static bool draw_turn(DipPreview *preview, int64_t now_ns, bool *shown, DipError *err) {
    DipPreviewState *state = &preview->state;
    const bool had_notice = state->notice[0] != '\0';
    const int64_t since_ns = now_ns - preview->turn_ns;
    const int64_t elapsed_ns =
        since_ns < DIP_LOOP_LONGEST_STEP_NS ? since_ns : DIP_LOOP_LONGEST_STEP_NS;
    preview->turn_ns = now_ns;
    follow_motion(preview);
    follow_title(preview);
    fly(preview, elapsed_ns);
    dip_preview_advance(state, elapsed_ns, now_ns);
    follow_full_screen(preview);
    copy_settings(preview, now_ns);
    paste_settings(preview, now_ns);
    dip_loop_follow_scene(preview, now_ns);
    dip_loop_follow_reload(preview, now_ns);
    preview->redraw |= choose(preview);
    follow_layout(preview);
    if (preview->resized) {
        follow_refresh(preview);
    }
    const bool new_frame = state->scene_changes != preview->drawn_changes || preview->resized ||
                           dip_loop_alternates(preview) || dip_loop_settles(preview);
    if (new_frame && !dip_loop_draw_panes(preview, err)) {
        return false;
    }
    if (state->save_pose) {
        dip_loop_save_pose(preview, now_ns);
    }
    const bool new_errors = dip_loop_measure_errors(preview, now_ns);
    const bool measured = dip_loop_measure_prices(preview);
    const bool new_prices = choose(preview) || measured;
    *shown = new_frame || new_errors || new_prices || preview->redraw || preview->exposed ||
             state->screenshot || (had_notice && !state->notice[0]) ||
             now_ns >= dip_ui_wakes_ns(dip_view_ui(preview->view)) || now_ns >= preview->blinks_ns;
    if (*shown && !dip_loop_show(preview, now_ns, err)) {
        preview->redraw = preview->exposed = true; // The next turn shows what this one could not.
        return false;
    }
    return true;
}

// After a picture was shown, waits for the display's next refresh and handles the events that
// arrive. Otherwise waits up to IDLE_WAIT_MS for an event. While prices are being measured, handles
// an event only if one waits already, so that the next turn can measure on.
static void wait_for_turn(DipPreview *preview, bool shown) {
    if (!shown) {
        const bool busy = dip_live_prices_are_working(preview->live_prices) &&
                          // The text of the progress is empty while measuring is paused.
                          dip_prices_progress(preview->prices)[0] != '\0';
        take_event(preview, busy ? 0 : IDLE_WAIT_MS);
        return;
    }
    preview->due_ns = dip_taa_pace_next_ns(preview->due_ns, preview->turn_ns, preview->refresh_ns,
                                           dip_loop_clock_ns(preview));
    int64_t left_ns = preview->due_ns - dip_loop_clock_ns(preview);
    while (left_ns >= ns_per_ms && !preview->state.quit) {
        take_event(preview, (int)(left_ns / ns_per_ms));
        left_ns = preview->due_ns - dip_loop_clock_ns(preview);
    }
}

// Returns whether nobody sees the window and no program waits for its picture.
static bool is_hidden(const DipPreview *preview) {
    const DipDisplay *display = &preview->def.display;
    return display->is_hidden && display->is_hidden(display->context) &&
           !preview->state.wants_picture;
}

// Runs a turn in which nothing is drawn or measured and the time on the path stands still.
static void rest_hidden(DipPreview *preview) {
    if (preview->errors) {
        dip_error_thread_pause(preview->errors);
    }
    dip_live_prices_pause(preview->live_prices);
    preview->figures.presented_ns = 0; // No refresh counts as dropped meanwhile.
    preview->exposed = true;
    take_event(preview, IDLE_WAIT_MS);
    preview->turn_ns = dip_loop_clock_ns(preview);
}

bool dip_preview_turn(DipPreview *preview, DipError *err) {
    DipError unused;
    bool shown = false;
    while (!preview->state.quit && take_event(preview, 0)) {
    }
    take_control(preview);
    if (preview->state.quit) {
        return true; // The user or another program has quit, so no further frame is drawn.
    }
    if (is_hidden(preview)) {
        rest_hidden(preview);
        return true;
    }
    if (!draw_turn(preview, dip_loop_clock_ns(preview), &shown, err ? err : &unused)) {
        return false;
    }
    wait_for_turn(preview, shown);
    return true;
}

const DipPreviewState *dip_preview_state(const DipPreview *preview) {
    return &preview->state;
}

DipPixels dip_preview_picture(const DipPreview *preview) {
    return dip_view_picture(preview->view);
}

DipLayout dip_preview_layout(DipPreview *preview) {
    const DipViewInput input = dip_loop_view_input(preview, dip_loop_clock_ns(preview));
    return dip_view_layout(&input);
}
