// Carries out the user's actions.
#include "app/preview/state/state_private.h"

#include "app/preview/state/pilot.h"

#include <stdarg.h>
#include <stdio.h>

static const int64_t default_step_ns = 33333333; // A thirtieth of a second.

DipPreviewState dip_preview_state_make(const DipQuality quality[DIP_PANE_COUNT],
                                       DipCamTrack *track) {
    DipPreviewState state = {.track = track, .step_ns = default_step_ns};
    state.quality[DIP_PANE_CURRENT] = quality[DIP_PANE_CURRENT];
    state.quality[DIP_PANE_REQUESTED] = quality[DIP_PANE_REQUESTED];
    state.edited[DIP_PANE_REQUESTED] = true;
    state.ini_quality = quality[DIP_PANE_REQUESTED];
    state.tools = (DipToolState){.open = true,
                                 .ui_scale = 1.0,
                                 .zoom = 16,
                                 .x = -1,
                                 .y = -1,
                                 .divider = 0.5,
                                 .gain = 8,
                                 .brightness = 1.0};
    state.budget_ms = state.refresh_ms = 1000.0 / 60.0;
    return state;
}

void dip_preview_notice(DipPreviewState *state, int64_t now_ns, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(state->notice, sizeof state->notice, format, arguments);
    va_end(arguments);
    state->notice_end_ns = now_ns + dip_state_notice_ns;
}

static void change_look(DipPreviewState *state, bool reverse, int64_t now_ns) {
    if (!state->shows_gallery) {
        dip_preview_notice(state, now_ns, "Only scenes of the gallery have variants");
        return;
    }
    state->look += reverse ? -1 : 1;
    ++state->scene_changes;
}

void dip_preview_act(DipPreviewState *state, DipAction action, int argument, bool reverse,
                     int64_t now_ns) {
    if (state->in_terminal && dip_preview_needs_window(action)) {
        dip_preview_notice(state, now_ns, "This key acts in a window, not in a terminal");
        return;
    }
    if (dip_state_act_on_tools(state, action, argument, reverse, now_ns)) {
        dip_preview_follow_dock(state);
        return;
    }
    switch (action) {
    case DIP_ACTION_UNDO:
        dip_state_undo(state, reverse, now_ns);
        break;
    case DIP_ACTION_PRESET:
        dip_state_choose_preset(state, (DipPreset)argument, now_ns);
        break;
    case DIP_ACTION_SETTING:
        dip_state_change_setting(state, (DipSetting)argument, reverse, now_ns);
        break;
    case DIP_ACTION_NEXT_PANE:
        dip_state_choose_pane(state, now_ns);
        break;
    case DIP_ACTION_APPLY:
        dip_state_apply(state, now_ns);
        break;
    case DIP_ACTION_PAUSE:
        state->paused = !state->paused;
        dip_preview_notice(state, now_ns, state->paused ? "Paused" : "Playing");
        break;
    case DIP_ACTION_STEP:
        dip_state_step_time(state, 1, now_ns);
        break;
    case DIP_ACTION_STEP_BACK:
        dip_state_step_time(state, -1, now_ns);
        break;
    case DIP_ACTION_NEXT_PATH:
        dip_state_next_path(state, reverse ? -1 : 1, now_ns);
        break;
    case DIP_ACTION_PREVIOUS_PATH:
        dip_state_next_path(state, -1, now_ns);
        break;
    case DIP_ACTION_PATH:
        dip_state_choose_path(state, argument, now_ns);
        break;
    case DIP_ACTION_NEXT_SCENE:
        state->scene_step = reverse ? -1 : 1;
        ++state->scene_changes;
        break;
    case DIP_ACTION_LOOK:
        change_look(state, reverse, now_ns);
        break;
    case DIP_ACTION_CAMERA:
        state->manual = !state->manual;
        dip_preview_notice(state, now_ns,
                           state->manual ? "Free camera: W A S D Q E move it, dragging turns it"
                                         : "The camera follows its path");
        ++state->scene_changes;
        break;
    case DIP_ACTION_HELP:
        state->help = !state->help;
        state->help_words[0] = '\0';
        break;
    case DIP_ACTION_PANEL:
        dip_state_open_tab(state, DIP_TAB_TIMES);
        dip_preview_follow_dock(state);
        break;
    case DIP_ACTION_COSTS:
        state->show_costs = !state->show_costs;
        break;
    case DIP_ACTION_ADVICE:
        dip_state_take_advice(state, reverse, now_ns);
        break;
    case DIP_ACTION_SCREENSHOT:
        state->screenshot = true;
        state->plain_screenshot = reverse;
        break;
    case DIP_ACTION_SAVE_POSE:
        state->save_pose = true;
        break;
    case DIP_ACTION_FULL_SCREEN:
        state->full_screen = !state->full_screen;
        break;
    case DIP_ACTION_QUIT:
        state->quit = true;
        break;
    default:
        dip_pilot_act(state, action, argument, reverse, now_ns);
        break;
    }
}

void dip_preview_seek(DipPreviewState *state, int64_t play_ns) {
    state->play_ns = play_ns > 0 ? play_ns : 0;
    ++state->scene_changes;
}

bool dip_preview_rests(const DipPreviewState *state, bool flying) {
    return state->manual ? !flying : state->paused || state->stands;
}

void dip_preview_advance(DipPreviewState *state, int64_t elapsed_ns, int64_t now_ns) {
    if (!state->paused && !state->manual && !state->stands) {
        state->play_ns += elapsed_ns;
        ++state->scene_changes;
    }
    if (now_ns >= state->notice_end_ns) {
        state->notice[0] = '\0';
    }
}
