// Colours of the overlay, and the arithmetic of laying it out.
#ifndef DIP_APP_PREVIEW_STYLE_H
#define DIP_APP_PREVIEW_STYLE_H

#include "app/canvas/pixels.h"

static const DipColour dip_style_background = {10, 11, 14, 255};
static const DipColour dip_style_white = {255, 255, 255, 255}; // Text: titles and values.
static const DipColour dip_style_soft = {196, 202, 210, 255};  // Text: names and notes.
static const DipColour dip_style_accent = {255, 190, 92, 255}; // Highlights and the edited pane.
static const DipColour dip_style_strip = {12, 14, 18, 168};    // Background of labels.
static const DipColour dip_style_status = {12, 14, 18, 150};   // Background of the status line.
static const DipColour dip_style_panel = {12, 14, 18, 190};    // Background of the panel.
static const DipColour dip_style_sheet = {14, 16, 21, 236};    // Background of the sheets.
static const DipColour dip_style_shade = {0, 0, 0, 90};        // Darkens the window around a sheet.

static inline int dip_style_min(int a, int b) {
    return a < b ? a : b;
}

static inline int dip_style_max(int a, int b) {
    return a > b ? a : b;
}

// Converts a length in pixels of a display with scale 1 to whole pixels of a display with the given
// scale.
static inline int dip_style_scaled(int length, double scale) {
    return (int)(scale * length + 0.5);
}

#endif
