// Holds what the user has chosen in the dock (the panel with the controls) for examining the
// pictures: the tab, the loupe, the comparison and the map.
#ifndef DIP_APP_PREVIEW_STATE_TOOL_STATE_H
#define DIP_APP_PREVIEW_STATE_TOOL_STATE_H

#include <stdbool.h>

// The tabs of the dock, from left to right.
typedef enum DipTab {
    DIP_TAB_SETTINGS,
    DIP_TAB_LOUPE,
    DIP_TAB_COMPARE,
    DIP_TAB_MAPS,
    DIP_TAB_ADVICE,
    DIP_TAB_TIMES,
    DIP_TAB_PATH,
    DIP_TAB_COUNT
} DipTab;

// How the window compares the pictures of the two panes.
typedef enum DipComparison {
    DIP_COMPARE_SIDE_BY_SIDE,
    DIP_COMPARE_WIPE,  // One picture: the current pane's left of a divider, the requested pane's
                       // right of it.
    DIP_COMPARE_BLINK, // One pane's picture; a key or a timer switches to the other pane's.
    DIP_COMPARE_DIFFERENCE, // Absolute difference of the two pictures, times a gain.
    DIP_COMPARE_ALONE, // One pane alone, in the area of both: the requested pane, unless the keys
                       // change only the current one.
    DIP_COMPARE_TRUTH, // The converged picture (the truth) in the current pane's place.
    DIP_COMPARISON_COUNT
} DipComparison;

// Maps: pictures that show over the panes in place of the panes' own pictures.
typedef enum DipMap {
    DIP_MAP_NONE,
    DIP_MAP_FLIP,      // FLIP error of each pixel against the converged picture.
    DIP_MAP_TIME,      // Time of drawing each tile.
    DIP_MAP_FRAGMENTS, // Fragments shaded per pixel.
    DIP_MAP_PROBES,    // Texture probes per pixel.
    DIP_MAP_SAMPLES,   // Pixels whose samples differ.
    DIP_MAP_MIPS,      // Mip level of each surface patch.
    DIP_MAP_COUNT
} DipMap;

enum { DIP_LOUPE_MIN_ZOOM = 2, DIP_LOUPE_MAX_ZOOM = 32 };
enum { DIP_COMPARE_MAX_GAIN = 64, DIP_MAP_MAX_BRIGHTNESS = 8 };

// The choices of the user. Plain data; part of the preview's state.
typedef struct DipToolState {
    DipTab tab;
    bool open;        // The dock is open and shows `tab`.
    bool bare;        // The window shows nothing but the panes.
    double ui_scale;  // Factor on the display's scale, from 0.75 to 4.
    bool fixed_scale; // --ui-scale is given, so the window's height does not change the scale
                      // (dip_layout_scale).
    bool loupe;       // The user has switched the loupe on.
    int zoom;         // Width of an enlarged pixel: 2, 4, 8, 16 or 32 pixels of the window.
    bool pinned;      // The loupe stays at its pixel instead of following the pointer.
    int x; // The pixel at which the loupe looks, in a pane's picture; below 0 means the middle.
    int y;
    DipComparison comparison;
    double divider; // WIPE: where the divider stands, from 0 (the picture's left edge) to 1 (its
                    // right edge).
    int gain;       // DIFFERENCE: factor of the differences: 1, 2, 4, ... 64.
    bool against_truth; // WIPE, BLINK, DIFFERENCE: the truth replaces the current pane's picture.
    bool blinked;       // BLINK: shows the requested pane instead of the current one. The timer
                        // (`blinks`) reverses this.
    bool blinks;        // BLINK: a timer switches between the panes, twice a second.
    DipMap map;
    int brightness; // The value at the end of a map's colour scale is divided by this: 1, 2, 4 or
                    // 8. A value below 1 counts as 1.
} DipToolState;

// Doubles the loupe's zoom `steps` times, or halves it for steps below 0, within its range.
void dip_tool_state_zoom(DipToolState *tools, int steps);

// Puts the divider at a share of the picture's width; below 0 counts as 0, above 1 as 1.
void dip_tool_state_divide(DipToolState *tools, double at);

// Chooses a map, or DIP_MAP_NONE. A map needs both panes side by side, so choosing a map also
// chooses DIP_COMPARE_SIDE_BY_SIDE.
void dip_tool_state_choose_map(DipToolState *tools, DipMap map);

// In a wipe, moves the divider by `steps` times 1/64 of the picture's width. In a difference,
// doubles the gain `steps` times, and otherwise the brightness of the chosen map; steps below 0
// halve it. Returns false if there is nothing to adjust.
bool dip_tool_state_adjust(DipToolState *tools, int steps);

#endif
