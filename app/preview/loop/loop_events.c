// Hands events, control messages and held keys to the state and the window.
#include "app/preview/loop/loop_private.h"

#include "app/preview/loop/reload.h"

static DipPreviewMoment moment_of(DipPreview *preview, int64_t now_ns) {
    return (DipPreviewMoment){
        .state = &preview->state,
        .session = preview->def.session,
        .display = &preview->def.display,
        .figures = preview->figures.shown,
        .prices = preview->prices,
        .panes = preview->frame.panes,
        .picture = dip_view_picture(preview->view),
        .drawn = preview->picture_number != 0 && !preview->redraw && !preview->resized &&
                 preview->state.scene_changes == preview->drawn_changes,
        .now_ns = now_ns,
    };
}

void dip_loop_take_control(DipPreview *preview) {
    const DipPreviewControl *control = &preview->def.control;
    if (control->turn && !preview->state.quit) {
        const DipPreviewMoment moment = moment_of(preview, dip_loop_clock_ns(preview));
        preview->redraw = control->turn(control->context, &moment) || preview->redraw;
    }
}

// Hands an event to the window's controls. Returns whether one of them took it. The panes
// change their size if the dock was opened or folded.
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

// A key acts on the control with the focus or, if no control takes it, on the preview. Escape first
// takes the focus away.
static void press_key(DipPreview *preview, const DipEvent *event, int64_t now_ns) {
    const DipFrame *frame = &preview->frame.panes[DIP_PANE_CURRENT];
    DipUi *ui = dip_view_ui(preview->view);
    if (!preview->state.help) { // What is typed there does not fly the camera.
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

// The key that blinks shows the other picture while it is held.
static void release_key(DipPreview *preview, const DipEvent *event) {
    if (event->key == (DipKeycode)';' && preview->state.tools.blinked) {
        preview->state.tools.blinked = false;
        preview->redraw = true;
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

bool dip_loop_take_event(DipPreview *preview, int timeout_ms) {
    DipEvent event;
    if (!preview->def.display.next_event(preview->def.display.context, timeout_ms, &event)) {
        return false;
    }
    if (dip_controllers_concern(&event)) {
        handle_controller(preview, &event, dip_loop_clock_ns(preview));
    } else {
        handle_event(preview, &event, dip_loop_clock_ns(preview));
    }
    return true;
}

void dip_loop_fly(DipPreview *preview, int64_t elapsed_ns) {
    const DipPilotTurn turn = {.session = preview->def.session,
                               .keys = dip_keys_camera(&preview->held),
                               .controllers = &preview->controllers,
                               .speed_m_per_s = preview->def.flying_speed_m_per_s,
                               .elapsed_ns = elapsed_ns};
    preview->flying = dip_pilot_turn(&preview->state, &turn, &preview->pose);
    preview->state.scene_changes += preview->flying;
}
