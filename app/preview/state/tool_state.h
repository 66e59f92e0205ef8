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
    DIP_COMPARE_WIPE,       // One picture: the current one left of a divider, the requested right.
    DIP_COMPARE_BLINK,      // One pane's picture; a key or a timer switches to the other pane's.
    DIP_COMPARE_DIFFERENCE, // Absolute difference of the two pictures, times a gain.
    DIP_COMPARE_ALONE,      // One pane alone, as large as both.
    DIP_COMPARE_TRUTH,      // The converged picture (the truth) in the current pane's place.
    DIP_COMPARISON_COUNT
} DipComparison;

// What is shown over each pane's picture in place of its colours.
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

// What the user has chosen. Plain data; part of the preview's state.
typedef struct DipToolState {
    DipTab tab;
    bool open;        // The dock is open and shows `tab`.
    bool bare;        // The window shows nothing but the panes.
    double ui_scale;  // 0.75..4; multiplies the display's scale.
    bool fixed_scale; // The user gave a scale, so that the window's size does not change it.
    bool loupe;       // The loupe is in use. It follows the pointer or shows the pinned pixel.
    int zoom;         // 2, 4, 8, 16 or 32.
    bool pinned;
    int x; // The loupe's pixel, in pixels of a pane's picture; below 0 stands for the middle.
    int y;
    DipComparison comparison;
    double divider;     // WIPE: 0 is the pane's left edge, 1 its right edge.
    int gain;           // DIFFERENCE: 1, 2, 4, ... 64.
    bool against_truth; // WIPE, BLINK, DIFFERENCE: the truth replaces the current picture.
    bool blinked;       // BLINK: shows the requested pane.
    bool blinks;        // BLINK: changes between the panes by itself, twice a second.
    DipMap map;
    double brightness; // Divides the end of a map's colour scale. Below 1 counts as 1.
} DipToolState;

#endif
