// Names the colours of the user interface, and scales its lengths.
#ifndef DIP_APP_UI_STYLE_H
#define DIP_APP_UI_STYLE_H

#include "app/ui/pixels.h"

static const DipColour dip_style_background = {10, 11, 14, 255};
static const DipColour dip_style_white = {255, 255, 255, 255}; // Titles, values, outlines, marks.
static const DipColour dip_style_soft = {196, 202, 210, 255};  // Names, notes, some outlines.
static const DipColour dip_style_accent = {255, 190, 92, 255}; // Highlights; marks of the pane
                                                               // being edited.
static const DipColour dip_style_sheet = {14, 16, 21, 252};    // Background of the sheets.
static const DipColour dip_style_shade = {0, 0, 0, 90};        // Darkens the window around a sheet.

static const DipColour dip_style_dock = {20, 22, 26, 255};
static const DipColour dip_style_bar = {27, 30, 36, 255};      // Background of the dock's bar.
static const DipColour dip_style_editor = {27, 31, 37, 255};   // Behind the open setting's steps.
static const DipColour dip_style_row = {42, 48, 56, 255};      // Behind the open setting's row.
static const DipColour dip_style_raised = {32, 36, 43, 255};   // Behind buttons, steps and tips.
static const DipColour dip_style_line = {51, 58, 68, 255};     // Lines and outlines.
static const DipColour dip_style_well = {12, 14, 17, 255};     // Behind plots, pictures and fields.
static const DipColour dip_style_glass = {10, 12, 15, 199};    // Background of labels on pictures.
static const DipColour dip_style_dim = {152, 162, 174, 255};   // Minor notes and disabled texts.
static const DipColour dip_style_off = {139, 149, 162, 255};   // Disabled steps; dots of plots.
static const DipColour dip_style_over = {74, 42, 42, 255};     // Behind what exceeds a budget.
static const DipColour dip_style_gain = {95, 214, 189, 255};   // Less error; Pareto fronts.
static const DipColour dip_style_worse = {255, 154, 139, 255}; // More error; too slow; warnings.
static const DipColour dip_style_focus = {109, 184, 255, 255}; // Ring of the control with focus.
static const DipColour dip_style_dark = {0, 0, 0, 255};        // Dark parts of marks on pictures.
static const DipColour dip_style_shadow = {10, 12, 15, 255};   // Dark edges of letters and lines.
static const DipColour dip_style_on_accent = {26, 18, 6, 255}; // Text on the accent colour.

// Returns the colour of a pane's figures and marks, for places where both panes' figures stand
// beside each other.
static inline DipColour dip_style_of_pane(int pane) {
    return pane ? dip_style_accent : dip_style_white;
}

// Returns black or white, whichever stands out from a colour.
static inline DipColour dip_style_contrast(DipColour ground) {
    const int luma = 2 * ground.red + 5 * ground.green + ground.blue; // From 0 to 2040.
    return luma > 1000 ? dip_style_dark : dip_style_white;
}

// Converts a length in pixels of a display with scale 1 to whole pixels of a display with the given
// scale.
static inline int dip_style_scaled(int length, double scale) {
    return (int)(scale * length + 0.5);
}

#endif
