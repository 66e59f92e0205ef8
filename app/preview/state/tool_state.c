// Changes what the user has chosen for examining the pictures, within the ranges of these choices.
#include "app/preview/state/tool_state.h"

enum { DIVIDER_STEPS = 64 }; // Steps of the divider across the picture.

// Doubles a value `steps` times, or halves it for steps below 0, within a range.
static int doubled(int value, int steps, int least, int most) {
    value = value < least ? least : value;
    for (; steps > 0 && value < most; --steps) {
        value *= 2;
    }
    for (; steps < 0 && value > least; ++steps) {
        value /= 2;
    }
    return value;
}

void dip_tool_state_zoom(DipToolState *tools, int steps) {
    tools->zoom = doubled(tools->zoom, steps, DIP_LOUPE_MIN_ZOOM, DIP_LOUPE_MAX_ZOOM);
}

void dip_tool_state_divide(DipToolState *tools, double at) {
    tools->divider = at > 0.0 ? (at < 1.0 ? at : 1.0) : 0.0;
}

void dip_tool_state_choose_map(DipToolState *tools, DipMap map) {
    tools->map = map;
    if (map != DIP_MAP_NONE) {
        tools->comparison = DIP_COMPARE_SIDE_BY_SIDE;
    }
}

bool dip_tool_state_adjust(DipToolState *tools, int steps) {
    if (tools->comparison == DIP_COMPARE_WIPE) {
        dip_tool_state_divide(tools, tools->divider + (double)steps / DIVIDER_STEPS);
        return true;
    }
    if (tools->comparison == DIP_COMPARE_DIFFERENCE) {
        tools->gain = doubled(tools->gain, steps, 1, DIP_COMPARE_MAX_GAIN);
        return true;
    }
    if (tools->map != DIP_MAP_NONE) {
        tools->brightness = doubled(tools->brightness, steps, 1, DIP_MAP_MAX_BRIGHTNESS);
        return true;
    }
    return false;
}
