// Acts on the dock and on its tools.
#include "app/preview/state/state_private.h"

void dip_state_open_tab(DipPreviewState *state, DipTab tab) {
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

bool dip_state_act_on_tools(DipPreviewState *state, DipAction action, int argument, bool reverse,
                            int64_t now_ns) {
    DipToolState *tools = &state->tools;
    switch (action) {
    case DIP_ACTION_TAB:
        dip_state_open_tab(state, (DipTab)argument);
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
        dip_state_seek(state, reverse ? -argument : argument);
        return true;
    default:
        return false;
    }
}

void dip_preview_follow_dock(DipPreviewState *state) {
    const DipToolState *tools = &state->tools;
    state->panel = tools->open && !tools->bare && tools->tab == DIP_TAB_TIMES;
}
