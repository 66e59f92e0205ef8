// Carries out the user's actions.
#include "app/preview/state.h"

#include "app/preview/pilot.h"
#include "config/config.h"
#include "renderer/base/assert.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const int64_t notice_ns = 2500000000;
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
    return state;
}

void dip_preview_notice(DipPreviewState *state, int64_t now_ns, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(state->notice, sizeof state->notice, format, arguments);
    va_end(arguments);
    state->notice_end_ns = now_ns + notice_ns;
}

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

int dip_preview_category_of(DipSetting setting) {
    switch (setting) {
    case DIP_SETTING_AA:
        return DIP_CATEGORY_AA;
    case DIP_SETTING_TAA:
        return DIP_CATEGORY_TAA;
    case DIP_SETTING_AAA:
    case DIP_SETTING_ASD:
        return DIP_CATEGORY_AAA;
    case DIP_SETTING_AF:
        return DIP_CATEGORY_AF;
    case DIP_SETTING_AAF:
        return DIP_CATEGORY_AAF;
    case DIP_SETTING_OPT:
        return DIP_CATEGORY_CAI;
    case DIP_SETTING_MIPLOD:
        return DIP_CATEGORY_MIPLOD;
    case DIP_SETTING_GI:
        return DIP_CATEGORY_GI;
    default:
        return -1; // Mip colours show on any path.
    }
}

// --- undo --------------------------------------------------------------------------------------

static int undo_slot(const DipPreviewState *state, int index) {
    return (state->undo_first + index) % DIP_UNDO_DEPTH;
}

// Remembers both panes' settings before a change. Forgets what has been undone.
static void remember(DipPreviewState *state) {
    if (state->undo_count == DIP_UNDO_DEPTH) {
        state->undo_first = undo_slot(state, 1);
        state->undo_count--;
    }
    memcpy(state->undo[undo_slot(state, state->undo_count)], state->quality, sizeof state->quality);
    state->undo_count++;
    state->redo_count = 0;
}

static void swap_settings(DipPreviewState *state, int slot) {
    DipQuality held[DIP_PANE_COUNT];
    memcpy(held, state->undo[slot], sizeof held);
    memcpy(state->undo[slot], state->quality, sizeof held);
    memcpy(state->quality, held, sizeof held);
    ++state->scene_changes;
}

static void undo(DipPreviewState *state, bool reverse, int64_t now_ns) {
    if (reverse ? state->redo_count == 0 : state->undo_count == 0) {
        dip_preview_notice(state, now_ns, reverse ? "Nothing to do again" : "Nothing to undo");
        return;
    }
    if (reverse) {
        swap_settings(state, undo_slot(state, state->undo_count));
        state->undo_count++;
        state->redo_count--;
    } else {
        state->undo_count--;
        state->redo_count++;
        swap_settings(state, undo_slot(state, state->undo_count));
    }
    dip_preview_notice(state, now_ns, reverse ? "Made the change again" : "Took the change back");
}

// --- settings ----------------------------------------------------------------------------------

// The path that plays: that of the active category or of category 0.
static const DipCamPath *playing_path(const DipPreviewState *state) {
    const DipCamPath *path = state->track->categories[state->track->active].path;
    return path ? path : state->track->categories[0].path;
}

// Says which step a setting has now. While the camera flies along its paths, chooses the one that
// shows the setting best. While it rests, the picture that the user looks at stays.
static void follow_setting(DipPreviewState *state, DipSetting setting, const char *step,
                           int64_t now_ns) {
    const int category = dip_preview_category_of(setting);
    const DipCamPath *before = playing_path(state);
    if (category >= 0 && !state->manual && !state->paused) {
        dip_camtrack_switch(state->track, category, state->play_ns);
    }
    const bool moved = playing_path(state) != before;
    dip_preview_notice(state, now_ns, "%s: %s%s%s", dip_setting_info(setting)->title, step,
                       moved ? ", on the path " : "",
                       moved ? dip_preview_path_title(state, state->track->active) : "");
    ++state->scene_changes;
}

void dip_preview_set_step(DipPreviewState *state, DipSetting setting, int step, int64_t now_ns) {
    DipQuality wanted[DIP_PANE_COUNT];
    DipError err;
    memcpy(wanted, state->quality, sizeof wanted);
    for (int pane = 0; pane < DIP_PANE_COUNT; ++pane) {
        if (!state->edited[pane]) {
            continue;
        }
        wanted[pane].step[setting] = (uint8_t)step;
        if (setting == DIP_SETTING_AA && !dip_quality_check(&wanted[pane], NULL)) {
            wanted[pane].step[DIP_SETTING_ASD] = dip_quality_default().step[DIP_SETTING_ASD];
        }
        if (!dip_quality_check(&wanted[pane], &err)) {
            dip_preview_notice(state, now_ns, "%s", err.message);
            return;
        }
    }
    if (memcmp(wanted, state->quality, sizeof wanted) == 0) {
        return;
    }
    remember(state);
    memcpy(state->quality, wanted, sizeof wanted);
    follow_setting(state, setting, dip_setting_info(setting)->steps[step], now_ns);
}

void dip_preview_set_quality(DipPreviewState *state, int pane, const DipQuality *quality,
                             int64_t now_ns) {
    char text[96];
    if (memcmp(&state->quality[pane], quality, sizeof *quality) != 0) {
        remember(state);
        state->quality[pane] = *quality;
        dip_preview_describe(quality, true, text, sizeof text);
        dip_preview_notice(state, now_ns, "%s: %s",
                           pane == DIP_PANE_CURRENT ? "Current" : "Requested", text);
        ++state->scene_changes;
    }
}

DipQuality dip_preview_preset(const DipPreviewState *state, DipPreset preset) {
    static const char *const texts[] = {
        [DIP_PRESET_PERFORMANCE] = "opt=advanced,miplod=performance",
        [DIP_PRESET_BALANCED] = "aa=2,af=4",
        [DIP_PRESET_QUALITY] = "aa=4,aaa=on,asd=2,af=16",
        [DIP_PRESET_BEST] = "aa=8,aaa=on,af=16,aaf=on",
    };
    DipQuality quality = dip_quality_default();
    switch (preset) {
    case DIP_PRESET_INI:
        return state->ini_quality;
    case DIP_PRESET_CURRENT:
        return state->quality[DIP_PANE_CURRENT];
    default:
        DIP_ASSERT(dip_quality_parse(texts[preset], &quality, NULL));
        return quality;
    }
}

const char *dip_preview_preset_name(DipPreset preset) {
    static const char *const names[DIP_PRESET_COUNT] = {"Performance", "Balanced",    "Quality",
                                                        "Best",        "As at start", "As current"};
    return names[preset];
}

static void choose_preset(DipPreviewState *state, DipPreset preset, int64_t now_ns) {
    const DipQuality quality = dip_preview_preset(state, preset);
    dip_preview_set_quality(state, DIP_PANE_REQUESTED, &quality, now_ns);
    dip_preview_notice(state, now_ns, "Requested: %s", dip_preview_preset_name(preset));
}

// Sets a setting to its next step that is valid with the other settings. If a new number of samples
// does not fit the group size of adaptive AA, resets the group size to its default. Returns false
// if no other step is valid.
static bool cycle(DipQuality *quality, DipSetting setting, bool reverse) {
    const DipSettingInfo *info = dip_setting_info(setting);
    DipQuality candidate;
    for (int i = 1; i < info->step_count; ++i) {
        const int offset = reverse ? info->step_count - i : i;
        const int step = (quality->step[setting] + offset) % info->step_count;
        candidate = *quality;
        candidate.step[setting] = (uint8_t)step;
        if (setting == DIP_SETTING_AA && !dip_quality_check(&candidate, NULL)) {
            candidate.step[DIP_SETTING_ASD] = dip_quality_default().step[DIP_SETTING_ASD];
        }
        if (dip_quality_check(&candidate, NULL)) {
            *quality = candidate;
            return true;
        }
    }
    return false;
}

static void change_setting(DipPreviewState *state, DipSetting setting, bool reverse,
                           int64_t now_ns) {
    const DipSettingInfo *info = dip_setting_info(setting);
    bool changed = false;
    const char *step = "";
    DipQuality before[DIP_PANE_COUNT];
    memcpy(before, state->quality, sizeof before);
    for (int pane = 0; pane < DIP_PANE_COUNT; ++pane) {
        if (state->edited[pane] && cycle(&state->quality[pane], setting, reverse)) {
            changed = true;
            step = info->steps[state->quality[pane].step[setting]];
        }
    }
    if (!changed) {
        dip_preview_notice(state, now_ns, "%s: no other step fits the other settings", info->title);
        return;
    }
    DipQuality after[DIP_PANE_COUNT];
    memcpy(after, state->quality, sizeof after);
    memcpy(state->quality, before, sizeof before);
    remember(state);
    memcpy(state->quality, after, sizeof after);
    follow_setting(state, setting, step, now_ns);
}

static bool has_path(const DipPreviewState *state, int category) {
    return state->track->categories[category].path != NULL;
}

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
static void next_path(DipPreviewState *state, int direction, int64_t now_ns) {
    if (state->shows_gallery) { // each scene has one path
        state->scene_step = direction;
        ++state->scene_changes;
        return;
    }
    const int from = state->track->active;
    const DipCamPath *playing = state->track->categories[from].path;
    const int count = DIP_CAMTRACK_CATEGORIES; // The cameras of the models follow the categories.
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
    const DipCamPath *path = playing_path(state);
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
    const DipCamPath *path = playing_path(state);
    const int64_t span_ns = path ? dip_campath_span_ns(path, state->track->end) : 0;
    const int64_t at_ns = dip_camtrack_time(state->track, state->play_ns);
    const bool once = state->track->end == DIP_CAMPATH_END_once;
    // Goes to the way there of the present round.
    const int64_t past_ns = once || span_ns == 0 ? at_ns : (at_ns % span_ns + span_ns) % span_ns;
    const int64_t to_ns = state->play_ns + path_ns - past_ns;
    state->play_ns = to_ns >= 0 ? to_ns : once ? 0 : to_ns + span_ns;
    ++state->scene_changes;
}

static void step_time(DipPreviewState *state, int direction, int64_t now_ns) {
    const int64_t to_ns = state->play_ns + direction * state->step_ns;
    state->paused = true;
    state->play_ns = to_ns > 0 ? to_ns : 0;
    dip_preview_notice(state, now_ns, "Paused");
    ++state->scene_changes;
}

// Chooses the panes that the keys change. The order is the requested pane, the current pane, both,
// and then the requested pane again.
static void choose_pane(DipPreviewState *state, int64_t now_ns) {
    bool *edited = state->edited;
    const bool both = edited[DIP_PANE_CURRENT] && edited[DIP_PANE_REQUESTED];
    const bool current_only = edited[DIP_PANE_CURRENT] && !both;
    edited[DIP_PANE_REQUESTED] = both || current_only;
    edited[DIP_PANE_CURRENT] = !both;
    const char *which = edited[0] && edited[1] ? "both panes"
                        : edited[0]            ? "the current pane"
                                               : "the requested pane";
    dip_preview_notice(state, now_ns, "Keys change %s", which);
}

static void apply(DipPreviewState *state, int64_t now_ns) {
    dip_preview_set_quality(state, DIP_PANE_CURRENT, &state->quality[DIP_PANE_REQUESTED], now_ns);
    dip_preview_notice(state, now_ns, "Copied requested to current");
}

// Gives the requested pane the settings with the least error within a time budget. Each press of
// the key uses the report's next budget.
static void take_advice(DipPreviewState *state, bool reverse, int64_t now_ns) {
    const DipCosts *costs = state->costs;
    if (!costs) {
        dip_preview_notice(state, now_ns, "No cost report is loaded; U says how to make one");
        return;
    }
    const int count = costs->advice_count;
    const int index = (state->next_advice + (reverse ? count - 2 : 0) + count) % count;
    const DipCostsAdvice *advice = &costs->advice[index];
    char text[DIP_NOTICE_SIZE];
    if (advice->found) {
        const unsigned changes = state->scene_changes;
        dip_preview_set_quality(state, DIP_PANE_REQUESTED, &advice->quality, now_ns);
        state->scene_changes = changes + 1;
    }
    dip_costs_describe(costs, index, text, sizeof text);
    if (state->pane_width > 0 &&
        (state->pane_width != costs->width || state->pane_height != costs->height)) {
        dip_preview_notice(state, now_ns, "%s (measured at %dx%d)", text, costs->width,
                           costs->height);
    } else {
        dip_preview_notice(state, now_ns, "%s", text);
    }
    state->notice_end_ns = now_ns + 2 * notice_ns; // This text is longer than other notices.
    state->next_advice = (index + 1) % count;
}

static void change_look(DipPreviewState *state, bool reverse, int64_t now_ns) {
    if (!state->shows_gallery) {
        dip_preview_notice(state, now_ns, "Only scenes of the gallery have variants");
        return;
    }
    state->look += reverse ? -1 : 1;
    ++state->scene_changes;
}

// --- the dock and its tools ----------------------------------------------------------------------

static void open_tab(DipPreviewState *state, DipTab tab) {
    DipToolState *tools = &state->tools;
    tools->open = !(tools->open && tools->tab == tab);
    tools->bare = false;
    tools->tab = tab;
}

// Chooses the next value of a tool in a ring of `count`, and opens its tab.
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

// Moves the wipe's divider by 5 %, doubles or halves the gain of the difference, or the brightness
// of the map that shows.
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

static void seek(DipPreviewState *state, int milliseconds) {
    const int64_t to_ns = state->play_ns + (int64_t)milliseconds * 1000000;
    state->play_ns = to_ns > 0 ? to_ns : 0;
    ++state->scene_changes;
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
            tools->comparison = DIP_COMPARE_SIDE_BY_SIDE; // Maps show side by side.
        }
        return true;
    case DIP_ACTION_ADJUST:
        adjust(state, reverse);
        return true;
    case DIP_ACTION_BLINK:
        tools->blinked = !tools->blinked;
        return true;
    case DIP_ACTION_SEEK:
        seek(state, reverse ? -argument : argument);
        return true;
    default:
        return false;
    }
}

void dip_preview_act(DipPreviewState *state, DipAction action, int argument, bool reverse,
                     int64_t now_ns) {
    if (act_on_tools(state, action, argument, reverse, now_ns)) {
        dip_preview_follow_dock(state);
        return;
    }
    switch (action) {
    case DIP_ACTION_UNDO:
        undo(state, reverse, now_ns);
        break;
    case DIP_ACTION_PRESET:
        choose_preset(state, (DipPreset)argument, now_ns);
        break;
    case DIP_ACTION_SETTING:
        change_setting(state, (DipSetting)argument, reverse, now_ns);
        break;
    case DIP_ACTION_NEXT_PANE:
        choose_pane(state, now_ns);
        break;
    case DIP_ACTION_APPLY:
        apply(state, now_ns);
        break;
    case DIP_ACTION_PAUSE:
        state->paused = !state->paused;
        dip_preview_notice(state, now_ns, state->paused ? "Paused" : "Playing");
        break;
    case DIP_ACTION_STEP:
        step_time(state, 1, now_ns);
        break;
    case DIP_ACTION_STEP_BACK:
        step_time(state, -1, now_ns);
        break;
    case DIP_ACTION_NEXT_PATH:
        next_path(state, reverse ? -1 : 1, now_ns);
        break;
    case DIP_ACTION_PREVIOUS_PATH:
        next_path(state, -1, now_ns);
        break;
    case DIP_ACTION_PATH:
        choose_path(state, argument, now_ns);
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
        break;
    case DIP_ACTION_PANEL:
        open_tab(state, DIP_TAB_TIMES);
        dip_preview_follow_dock(state);
        break;
    case DIP_ACTION_COSTS:
        state->show_costs = !state->show_costs;
        break;
    case DIP_ACTION_ADVICE:
        take_advice(state, reverse, now_ns);
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

void dip_preview_follow_dock(DipPreviewState *state) {
    const DipToolState *tools = &state->tools;
    state->panel = tools->open && !tools->bare && tools->tab == DIP_TAB_TIMES;
}

void dip_preview_seek(DipPreviewState *state, int64_t play_ns) {
    state->play_ns = play_ns > 0 ? play_ns : 0;
    ++state->scene_changes;
}

bool dip_preview_rests(const DipPreviewState *state, bool flying) {
    return state->manual ? !flying : state->paused;
}

void dip_preview_advance(DipPreviewState *state, int64_t elapsed_ns, int64_t now_ns) {
    if (!state->paused && !state->manual) {
        state->play_ns += elapsed_ns;
        ++state->scene_changes;
    }
    if (now_ns >= state->notice_end_ns) {
        state->notice[0] = '\0';
    }
}

// Returns the short form of a setting, in which %s stands for the step. A setting that is either on
// or off has a short form without a step; if the setting is off, "no" precedes the short form.
static const char *brief_form(DipSetting setting) {
    switch (setting) {
    case DIP_SETTING_AA:
        return "AA %sx";
    case DIP_SETTING_TAA:
        return "temporal AA";
    case DIP_SETTING_AAA:
        return "adaptive AA";
    case DIP_SETTING_ASD:
        return "groups of %s";
    case DIP_SETTING_AF:
        return "AF %sx";
    case DIP_SETTING_AAF:
        return "advanced AF";
    case DIP_SETTING_OPT:
        return "%s textures";
    case DIP_SETTING_MIPLOD:
        return "mip detail %s";
    case DIP_SETTING_GI:
        return "instancing";
    default:
        return "mip colours";
    }
}

// Writes a setting in its short form: "AA 4x", "no instancing".
static void describe_briefly(DipSetting setting, const char *step, char *text, size_t size_bytes) {
    const char *form = brief_form(setting);
    const char *mark = strstr(form, "%s");
    if (mark) {
        snprintf(text, size_bytes, "%.*s%s%s", (int)(mark - form), form, step, mark + 2);
    } else {
        snprintf(text, size_bytes, "%s%s", strcmp(step, "off") == 0 ? "no " : "", form);
    }
}

// Writes a setting in full: "Antialiasing 4x", "Geometry instancing off", "Adaptive AA".
static void describe_fully(DipSetting setting, const char *step, char *text, size_t size_bytes) {
    const bool on = strcmp(step, "on") == 0;
    const bool times = setting == DIP_SETTING_AA || setting == DIP_SETTING_AF;
    const bool number = isdigit((unsigned char)step[0]) != 0;
    snprintf(text, size_bytes, "%s%s%s%s", dip_setting_info(setting)->title, on ? "" : " ",
             on ? "" : step, times && number ? "x" : "");
}

void dip_preview_describe(const DipQuality *quality, bool brief, char *text, size_t size_bytes) {
    size_t length = 0;
    text[0] = '\0';
    for (int s = 0; s < DIP_SETTING_COUNT; ++s) {
        const DipSettingInfo *info = dip_setting_info((DipSetting)s);
        if (quality->step[s] == info->default_step || length + 1 >= size_bytes) {
            continue;
        }
        char one[64];
        (brief ? describe_briefly : describe_fully)((DipSetting)s, info->steps[quality->step[s]],
                                                    one, sizeof one);
        const int written =
            snprintf(text + length, size_bytes - length, "%s%s", length ? ", " : "", one);
        length += written > 0 ? (size_t)written : 0;
    }
    if (!text[0]) {
        snprintf(text, size_bytes, "Default settings");
    }
}
