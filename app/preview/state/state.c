// Carries out the user's actions, and lets time pass.
#include "app/preview/state/state_private.h"

#include "app/preview/state/pilot.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const int64_t default_step_ns = 33333333; // A thirtieth of a second.
static const int64_t ns_per_ms = 1000000;

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

void dip_preview_error_text(const DipError *err, char text[DIP_NOTICE_SIZE]) {
    const char *slash = strrchr(err->file, '/');
    const char *name = slash && slash[1] ? slash + 1 : err->file;
    char place[96] = "";
    if (name[0] && err->line > 0) {
        snprintf(place, sizeof place, " (%.64s:%d)", name, err->line);
    } else if (name[0]) {
        snprintf(place, sizeof place, " (%.80s)", name);
    }
    snprintf(text, DIP_NOTICE_SIZE, "%s%.40s%s%.160s%s", err->key[0] ? "[" : "", err->key,
             err->key[0] ? "] " : "", err->message, place);
}

void dip_preview_keep_notice(DipPreviewState *state, int64_t now_ns) {
    state->notice_end_ns = now_ns + 4 * dip_state_notice_ns;
}

// --- the dock and the tools ----------------------------------------------------------------------

// Opens the dock with a tab, or folds it if the tab shows already.
static void open_tab(DipPreviewState *state, DipTab tab) {
    DipToolState *tools = &state->tools;
    tools->open = !(tools->open && tools->tab == tab);
    tools->bare = false;
    tools->tab = tab;
}

// Returns a tool's next value in a ring of `count` values, and opens the tool's tab.
static int next_of(DipPreviewState *state, DipTab tab, int value, int count, bool reverse) {
    state->tools.tab = tab;
    state->tools.open = true;
    state->tools.bare = false;
    return (value + (reverse ? count - 1 : 1)) % count;
}

static void zoom(DipPreviewState *state, bool out) {
    const int zoom = out ? state->tools.zoom / 2 : state->tools.zoom * 2;
    if (zoom >= DIP_LOUPE_MIN_ZOOM && zoom <= DIP_LOUPE_MAX_ZOOM) {
        state->tools.zoom = zoom;
    }
}

// Changes what shows: doubles or halves the brightness of a map or the gain of the difference, or
// moves the wipe's divider by 5 %.
static void adjust(DipPreviewState *state, bool down) {
    enum { MAX_GAIN = 64 };
    DipToolState *tools = &state->tools;
    if (tools->map != DIP_MAP_NONE) {
        const double brightness = tools->brightness * (down ? 0.5 : 2.0);
        tools->brightness = brightness < 0.125 ? 0.125 : brightness > 64.0 ? 64.0 : brightness;
    } else if (tools->comparison == DIP_COMPARE_DIFFERENCE) {
        const int gain = down ? tools->gain / 2 : tools->gain * 2;
        tools->gain = gain < 1 ? 1 : gain > MAX_GAIN ? MAX_GAIN : gain;
    } else {
        const double divider = tools->divider + (down ? -0.05 : 0.05);
        tools->divider = divider < 0.0 ? 0.0 : divider > 1.0 ? 1.0 : divider;
    }
}

void dip_preview_scale_ui(DipPreviewState *state, double by, int64_t now_ns) {
    const double scale = state->tools.ui_scale + by;
    state->tools.ui_scale = scale < 0.75 ? 0.75 : scale > 4.0 ? 4.0 : scale;
    dip_preview_notice(state, now_ns, "Size of the panel: %.0f %%", 100.0 * state->tools.ui_scale);
}

bool dip_preview_needs_window(DipAction action) {
    switch (action) {
    case DIP_ACTION_TAB:
    case DIP_ACTION_DOCK:
    case DIP_ACTION_BARE:
    case DIP_ACTION_LOUPE:
    case DIP_ACTION_ZOOM:
    case DIP_ACTION_COMPARISON:
    case DIP_ACTION_MAP:
    case DIP_ACTION_ADJUST:
    case DIP_ACTION_BLINK:
    case DIP_ACTION_PATH_EDIT:
    case DIP_ACTION_FULL_SCREEN:
        return true;
    default:
        return false;
    }
}

// Carries out an action of the dock or of a tool. Returns false if the action is none of these.
static bool act_on_tools(DipPreviewState *state, DipAction action, int argument, bool reverse,
                         int64_t now_ns) {
    DipToolState *tools = &state->tools;
    switch (action) {
    case DIP_ACTION_TAB:
        open_tab(state, (DipTab)argument);
        return true;
    case DIP_ACTION_DOCK:
        tools->open = !tools->open;
        tools->bare = false;
        return true;
    case DIP_ACTION_BARE:
        tools->bare = !tools->bare;
        dip_preview_notice(state, now_ns, tools->bare ? "Panes only" : "Panes with the panel");
        return true;
    case DIP_ACTION_LOUPE:
        tools->loupe = !tools->loupe;
        tools->open = tools->loupe || tools->open;
        tools->tab = tools->loupe ? DIP_TAB_LOUPE : DIP_TAB_SETTINGS;
        return true;
    case DIP_ACTION_ZOOM:
        zoom(state, reverse);
        return true;
    case DIP_ACTION_COMPARISON:
        tools->comparison = (DipComparison)next_of(state, DIP_TAB_COMPARE, (int)tools->comparison,
                                                   DIP_COMPARISON_COUNT, reverse);
        return true;
    case DIP_ACTION_MAP:
        tools->map = (DipMap)next_of(state, DIP_TAB_MAPS, (int)tools->map, DIP_MAP_COUNT, reverse);
        if (tools->map != DIP_MAP_NONE) {
            tools->comparison = DIP_COMPARE_SIDE_BY_SIDE; // A map needs both panes side by side.
        }
        return true;
    case DIP_ACTION_ADJUST:
        adjust(state, reverse);
        return true;
    case DIP_ACTION_BLINK:
        tools->blinked = !tools->blinked;
        return true;
    default:
        return false;
    }
}

void dip_preview_follow_dock(DipPreviewState *state) {
    const DipToolState *tools = &state->tools;
    state->panel = tools->open && !tools->bare && tools->tab == DIP_TAB_TIMES;
}

// --- camera paths --------------------------------------------------------------------------------

const char *dip_preview_category_name(int category) {
    static const char *const names[] = {
#define PATH_NAME(NAME, fallback, text) #NAME,
        DIP_CONFIG_LIST(DIP_CONFIG_NONE, PATH_NAME, DIP_CONFIG_NONE)
#undef PATH_NAME
    };
    return category >= 0 && category < DIP_CATEGORY_COUNT ? names[category] : "?";
}

const char *dip_preview_category_title(int category) {
    for (int s = 0; s < DIP_SETTING_COUNT; ++s) {
        if (category == dip_preview_category_of((DipSetting)s)) {
            return dip_setting_info((DipSetting)s)->title;
        }
    }
    return category == DIP_CATEGORY_DEFAULT ? "Default"
           : category == DIP_CATEGORY_WATER ? "Water"
                                            : dip_preview_category_name(category);
}

const char *dip_preview_path_name(const DipPreviewState *state, int category) {
    const bool is_camera = category >= DIP_CATEGORY_COUNT && category < DIP_CAMTRACK_CATEGORIES;
    const char *name = is_camera ? state->track->categories[category].name : NULL;
    return name ? name : dip_preview_category_name(category);
}

const char *dip_preview_path_title(const DipPreviewState *state, int category) {
    const bool known = category >= 0 && category < DIP_CAMTRACK_CATEGORIES;
    const char *name = known ? state->track->categories[category].name : NULL;
    return name ? name : dip_preview_category_title(category);
}

const DipCamPath *dip_preview_playing_path(const DipPreviewState *state) {
    const DipCamPath *path = state->track->categories[state->track->active].path;
    return path ? path : state->track->categories[0].path;
}

bool dip_preview_path_stands(const DipPreviewState *state) {
    const DipCamPath *path = dip_preview_playing_path(state);
    const size_t count = path ? dip_campath_info(path).key_count : 0;
    bool stands = count > 0;
    for (size_t i = 1; stands && i < count; ++i) {
        const DipCamKey first = dip_campath_key(path, 0), key = dip_campath_key(path, i);
        stands = memcmp(&first, &key, sizeof key) == 0;
    }
    return stands;
}

static bool has_path(const DipPreviewState *state, int category) {
    return state->track->categories[category].path != NULL;
}

// Plays the path of a category, or says that it has none.
static void choose_path(DipPreviewState *state, int category, int64_t now_ns) {
    if (category < 0 || category >= DIP_CAMTRACK_CATEGORIES || !has_path(state, category)) {
        dip_preview_notice(state, now_ns, "%s has no path: the ini names no CAMPATH_%s",
                           dip_preview_category_title(category),
                           dip_preview_category_name(category));
        return;
    }
    dip_camtrack_switch(state->track, category, state->play_ns);
    state->manual = false;
    dip_preview_notice(state, now_ns, "Path: %s", dip_preview_path_title(state, category));
    ++state->scene_changes;
}

// Chooses the next category, in the given direction, whose path is not the current one. Several
// categories may share a path.
static void choose_next_path(DipPreviewState *state, int direction, int64_t now_ns) {
    if (state->shows_gallery) { // Each scene has one path, so the next scene shows.
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
            choose_path(state, category, now_ns);
            return;
        }
    }
    dip_preview_notice(state, now_ns, "There is only one path");
}

int64_t dip_preview_path_length_ns(const DipPreviewState *state) {
    const DipCamPath *path = dip_preview_playing_path(state);
    if (!path) {
        return 0;
    }
    const bool loops = state->track->end == DIP_CAMPATH_END_loop;
    return dip_campath_span_ns(path, loops ? DIP_CAMPATH_END_loop : DIP_CAMPATH_END_once);
}

int64_t dip_preview_path_ns(const DipPreviewState *state) {
    return dip_camtrack_path_time(state->track, state->play_ns);
}

void dip_preview_seek_path(DipPreviewState *state, int64_t path_ns) {
    const DipCamPath *path = dip_preview_playing_path(state);
    const int64_t span_ns = path ? dip_campath_span_ns(path, state->track->end) : 0;
    const int64_t at_ns = dip_camtrack_time(state->track, state->play_ns);
    const bool once = state->track->end == DIP_CAMPATH_END_once;
    // Stays in the present repetition of the path. If a repetition plays the path forwards and then
    // backwards, goes to the part that plays forwards.
    const int64_t past_ns = once || span_ns == 0 ? at_ns : (at_ns % span_ns + span_ns) % span_ns;
    const int64_t to_ns = state->play_ns + path_ns - past_ns;
    state->play_ns = to_ns >= 0 ? to_ns : once ? 0 : to_ns + span_ns;
    ++state->scene_changes;
}

// --- animations ----------------------------------------------------------------------------------

// Asks for an animation of the models, or for none if index is -1.
static void choose_animation(DipPreviewState *state, int index, int64_t now_ns) {
    const DipSessionAnimations *animations = state->animations;
    if (!animations || animations->count == 0 || index < -1 || index >= animations->count) {
        dip_preview_notice(state, now_ns, "The models have no such animation");
    } else if (index != animations->playing || state->opens_animation) {
        state->wants_animation = true;
        state->wanted_animation = index;
    }
}

// --- all actions ---------------------------------------------------------------------------------

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
    if (act_on_tools(state, action, argument, reverse, now_ns)) {
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
    case DIP_ACTION_STEP_BACK:
        state->paused = true;
        dip_preview_seek(state,
                         state->play_ns + (action == DIP_ACTION_STEP ? 1 : -1) * state->step_ns);
        dip_preview_notice(state, now_ns, "Paused");
        break;
    case DIP_ACTION_SEEK:
        dip_preview_seek(state, state->play_ns + (reverse ? -argument : argument) * ns_per_ms);
        break;
    case DIP_ACTION_NEXT_PATH:
    case DIP_ACTION_PREVIOUS_PATH:
        choose_next_path(state, reverse || action == DIP_ACTION_PREVIOUS_PATH ? -1 : 1, now_ns);
        break;
    case DIP_ACTION_PATH:
        choose_path(state, argument, now_ns);
        break;
    case DIP_ACTION_ANIMATION:
        choose_animation(state, argument, now_ns);
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
        open_tab(state, DIP_TAB_TIMES);
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

bool dip_preview_time_runs(const DipPreviewState *state) {
    return !state->paused && (state->manual ? state->scene_moves : !state->stands);
}

bool dip_preview_rests(const DipPreviewState *state, bool flying) {
    return !dip_preview_time_runs(state) && !(state->manual && flying);
}

void dip_preview_advance(DipPreviewState *state, int64_t elapsed_ns, int64_t now_ns) {
    if (dip_preview_time_runs(state)) {
        state->play_ns += elapsed_ns;
        ++state->scene_changes;
    }
    if (now_ns >= state->notice_end_ns) {
        state->notice[0] = '\0';
    }
}
