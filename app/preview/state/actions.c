// Carries out the user's actions: one function for each action, and a table of these functions.
// state_settings.c and pilot.c define some of the functions (state_private.h).
#include "app/preview/state/pilot.h"
#include "app/preview/state/state_private.h"

static const int64_t ns_per_ms = 1000000;

// --- time ----------------------------------------------------------------------------------------

static void pause_or_play(const DipAct *act) {
    DipPreviewState *state = act->state;
    state->paused = !state->paused;
    dip_preview_notice(state, act->now_ns, state->paused ? "Paused" : "Playing");
}

static void step(const DipAct *act) {
    DipPreviewState *state = act->state;
    state->paused = true;
    dip_preview_seek(state, state->play_ns + act->argument * state->step_ns);
    dip_preview_notice(state, act->now_ns, "Paused");
}

static void seek(const DipAct *act) {
    const int64_t by_ns = act->argument * ns_per_ms;
    dip_preview_seek(act->state, act->state->play_ns + (act->reverse ? -by_ns : by_ns));
}

// --- paths, animations and scenes ----------------------------------------------------------------

static bool has_path(const DipPreviewState *state, int category) {
    return state->track->categories[category].path != NULL;
}

// Plays the path of a category. If the category has no path, a notice says so.
static void play_path(DipPreviewState *state, int category, int64_t now_ns) {
    if (category < 0 || category >= DIP_CAMTRACK_CATEGORIES || !has_path(state, category)) {
        dip_preview_notice(state, now_ns, "%s has no path: the ini names no CAMPATH_%s",
                           dip_preview_category_title(category), dip_session_category(category));
        return;
    }
    dip_camtrack_switch(state->track, category, state->play_ns);
    state->manual = false;
    dip_preview_notice(state, now_ns, "Path: %s", dip_preview_path_title(state, category));
    ++state->scene_changes;
}

static void choose_path(const DipAct *act) {
    play_path(act->state, act->argument, act->now_ns);
}

// Chooses the next category (reversed: the category before) whose path is another one than the path
// that plays. Several categories may share a path.
static void next_path(const DipAct *act) {
    DipPreviewState *state = act->state;
    const int direction = act->reverse ? -1 : 1;
    if (state->shows_gallery) { // A scene of the gallery has only one path, so another scene shows.
        state->scene_step = direction;
        ++state->scene_changes;
        return;
    }
    const int from = state->track->active;
    const DipCamPath *playing = state->track->categories[from].path;
    const int count = DIP_CAMTRACK_CATEGORIES; // Includes the cameras of the models.
    for (int i = 1; i < count; ++i) {
        const int category = (from + direction * i + count * i) % count;
        if (has_path(state, category) && state->track->categories[category].path != playing) {
            play_path(state, category, act->now_ns);
            return;
        }
    }
    dip_preview_notice(state, act->now_ns, "There is only one path");
}

// Asks for an animation of the models, or for none if the argument is -1.
static void choose_animation(const DipAct *act) {
    DipPreviewState *state = act->state;
    const DipSessionAnimations *animations = state->animations;
    const int index = act->argument;
    if (!animations || animations->count == 0 || index < -1 || index >= animations->count) {
        dip_preview_notice(state, act->now_ns, "The models have no such animation");
    } else if (index != animations->playing || state->opens_animation) {
        state->wants_animation = true;
        state->wanted_animation = index;
    }
}

static void next_scene(const DipAct *act) {
    act->state->scene_step = act->reverse ? -1 : 1;
    ++act->state->scene_changes;
}

static void change_look(const DipAct *act) {
    DipPreviewState *state = act->state;
    if (!state->shows_gallery) {
        dip_preview_notice(state, act->now_ns, "Only scenes of the gallery have variants");
        return;
    }
    state->look += act->reverse ? -1 : 1;
    ++state->scene_changes;
}

// --- the camera ----------------------------------------------------------------------------------

static void free_camera(const DipAct *act) {
    DipPreviewState *state = act->state;
    state->manual = !state->manual;
    dip_preview_notice(state, act->now_ns,
                       state->manual ? "Free camera: W A S D Q E move it, dragging turns it"
                                     : "The camera follows its path");
    ++state->scene_changes;
}

static void change_speed(const DipAct *act) {
    dip_pilot_change_speed(act->state, act->reverse ? -act->argument : act->argument, act->now_ns);
}

// --- the dock and the tools ----------------------------------------------------------------------

static void open_tab(DipPreviewState *state, DipTab tab) {
    DipToolState *tools = &state->tools;
    const bool shows = tools->open && !tools->bare && tools->tab == tab;
    tools->open = !shows;
    tools->bare = false;
    tools->tab = tab;
}

static void open_tab_of(const DipAct *act) {
    open_tab(act->state, (DipTab)act->argument);
}

static void open_times(const DipAct *act) {
    open_tab(act->state, DIP_TAB_TIMES);
}

static void fold_dock(const DipAct *act) {
    act->state->tools.open = !act->state->tools.open;
    act->state->tools.bare = false;
}

static void show_panes_only(const DipAct *act) {
    bool *bare = &act->state->tools.bare;
    *bare = !*bare;
    dip_preview_notice(act->state, act->now_ns, *bare ? "Panes only" : "Panes with the panel");
}

static void use_loupe(const DipAct *act) {
    DipToolState *tools = &act->state->tools;
    tools->loupe = !tools->loupe;
    tools->open = tools->loupe || tools->open;
    tools->bare = tools->bare && !tools->loupe;
    tools->tab = tools->loupe ? DIP_TAB_LOUPE : DIP_TAB_SETTINGS;
}

static void zoom(const DipAct *act) {
    dip_tool_state_zoom(&act->state->tools, act->reverse ? -1 : 1);
}

// Returns a tool's next value (reversed: the value before) in a ring of `count` values, and opens
// the tool's tab.
static int next_of(const DipAct *act, DipTab tab, int value, int count) {
    DipToolState *tools = &act->state->tools;
    tools->tab = tab;
    tools->open = true;
    tools->bare = false;
    return (value + (act->reverse ? count - 1 : 1)) % count;
}

static void next_comparison(const DipAct *act) {
    DipToolState *tools = &act->state->tools;
    tools->comparison =
        (DipComparison)next_of(act, DIP_TAB_COMPARE, (int)tools->comparison, DIP_COMPARISON_COUNT);
}

static void next_map(const DipAct *act) {
    DipToolState *tools = &act->state->tools;
    dip_tool_state_choose_map(tools,
                              (DipMap)next_of(act, DIP_TAB_MAPS, (int)tools->map, DIP_MAP_COUNT));
}

static void adjust(const DipAct *act) {
    dip_tool_state_adjust(&act->state->tools, act->reverse ? -1 : 1);
}

static void blink(const DipAct *act) {
    act->state->tools.blinked = !act->state->tools.blinked;
}

// --- sheets, files and the window ----------------------------------------------------------------

static void show_help(const DipAct *act) {
    act->state->help = !act->state->help;
    act->state->help_words[0] = '\0';
}

static void show_costs(const DipAct *act) {
    act->state->show_costs = !act->state->show_costs;
}

static void save_screenshot(const DipAct *act) {
    act->state->screenshot = true;
    act->state->plain_screenshot = act->reverse;
}

static void save_pose(const DipAct *act) {
    act->state->save_pose = true;
}

static void fill_screen(const DipAct *act) {
    act->state->full_screen = !act->state->full_screen;
}

static void quit(const DipAct *act) {
    act->state->quit = true;
}

// --- all actions ---------------------------------------------------------------------------------

static const struct {
    void (*carry_out)(const DipAct *act);
    bool needs_window; // A terminal does not show what the action does.
} actions[DIP_ACTION_COUNT] = {
    [DIP_ACTION_SETTING] = {.carry_out = dip_state_change_setting},
    [DIP_ACTION_NEXT_PANE] = {.carry_out = dip_state_choose_pane},
    [DIP_ACTION_APPLY] = {.carry_out = dip_state_apply},
    [DIP_ACTION_PAUSE] = {.carry_out = pause_or_play},
    [DIP_ACTION_STEP] = {.carry_out = step},
    [DIP_ACTION_NEXT_PATH] = {.carry_out = next_path},
    [DIP_ACTION_PATH] = {.carry_out = choose_path},
    [DIP_ACTION_ANIMATION] = {.carry_out = choose_animation},
    [DIP_ACTION_NEXT_SCENE] = {.carry_out = next_scene},
    [DIP_ACTION_LOOK] = {.carry_out = change_look},
    [DIP_ACTION_CAMERA] = {.carry_out = free_camera},
    [DIP_ACTION_CAMERA_BACK] = {.carry_out = dip_pilot_reset},
    [DIP_ACTION_ORBIT] = {.carry_out = dip_pilot_orbit},
    [DIP_ACTION_SPEED] = {.carry_out = change_speed},
    [DIP_ACTION_PATH_END] = {.carry_out = dip_pilot_choose_end},
    [DIP_ACTION_PATH_EDIT] = {.carry_out = dip_pilot_edit_path, .needs_window = true},
    [DIP_ACTION_HELP] = {.carry_out = show_help},
    [DIP_ACTION_PANEL] = {.carry_out = open_times},
    [DIP_ACTION_COSTS] = {.carry_out = show_costs},
    [DIP_ACTION_ADVICE] = {.carry_out = dip_state_take_advice},
    [DIP_ACTION_TAB] = {.carry_out = open_tab_of, .needs_window = true},
    [DIP_ACTION_DOCK] = {.carry_out = fold_dock, .needs_window = true},
    [DIP_ACTION_BARE] = {.carry_out = show_panes_only, .needs_window = true},
    [DIP_ACTION_UNDO] = {.carry_out = dip_state_undo},
    [DIP_ACTION_PRESET] = {.carry_out = dip_state_choose_preset},
    [DIP_ACTION_SEEK] = {.carry_out = seek},
    [DIP_ACTION_LOUPE] = {.carry_out = use_loupe, .needs_window = true},
    [DIP_ACTION_ZOOM] = {.carry_out = zoom, .needs_window = true},
    [DIP_ACTION_COMPARISON] = {.carry_out = next_comparison, .needs_window = true},
    [DIP_ACTION_MAP] = {.carry_out = next_map, .needs_window = true},
    [DIP_ACTION_ADJUST] = {.carry_out = adjust, .needs_window = true},
    [DIP_ACTION_BLINK] = {.carry_out = blink, .needs_window = true},
    [DIP_ACTION_SCREENSHOT] = {.carry_out = save_screenshot},
    [DIP_ACTION_SAVE_POSE] = {.carry_out = save_pose},
    [DIP_ACTION_FULL_SCREEN] = {.carry_out = fill_screen, .needs_window = true},
    [DIP_ACTION_QUIT] = {.carry_out = quit},
};

bool dip_preview_needs_window(DipAction action) {
    return actions[action].needs_window;
}

void dip_preview_act(DipPreviewState *state, DipAction action, int argument, bool reverse,
                     int64_t now_ns) {
    const DipAct act = {state, argument, reverse, now_ns};
    if (state->in_terminal && actions[action].needs_window) {
        dip_preview_notice(state, now_ns, "This key acts in a window, not in a terminal");
        return;
    }
    actions[action].carry_out(&act);
}

bool dip_preview_shows_times(const DipPreviewState *state) {
    const DipToolState *tools = &state->tools;
    return tools->open && !tools->bare && tools->tab == DIP_TAB_TIMES;
}

void dip_preview_scale_ui(DipPreviewState *state, double by, int64_t now_ns) {
    const double scale = state->tools.ui_scale + by;
    state->tools.ui_scale = scale < 0.75 ? 0.75 : scale > 4.0 ? 4.0 : scale;
    dip_preview_notice(state, now_ns, "Size of the panel: %.0f %%", 100.0 * state->tools.ui_scale);
}
