// Colours of the overlay, and the arithmetic of laying it out.
#ifndef DIP_APP_PREVIEW_STYLE_H
#define DIP_APP_PREVIEW_STYLE_H

#include "app/canvas/pixels.h"

static const DipColour dip_style_background = {10, 11, 14, 255};
static const DipColour dip_style_white = {255, 255, 255, 255}; // Values.
static const DipColour dip_style_soft = {196, 202, 210, 255};  // Words.
static const DipColour dip_style_accent = {255, 190, 92, 255}; // The pane that keys change.
static const DipColour dip_style_strip = {12, 14, 18, 168};    // Behind labels.
static const DipColour dip_style_status = {12, 14, 18, 150};   // Behind the status line.
static const DipColour dip_style_panel = {12, 14, 18, 190};    // Behind the panel.
static const DipColour dip_style_sheet = {14, 16, 21, 236};    // Behind help and costs.
static const DipColour dip_style_shade = {0, 0, 0, 90};        // Around help and costs.

static inline int dip_style_min(int a, int b) {
    return a < b ? a : b;
}

static inline int dip_style_max(int a, int b) {
    return a > b ? a : b;
}

// A length of a screen of scale 1 on a screen of another scale, in whole pixels.
static inline int dip_style_scaled(int length, double scale) {
    return (int)(scale * length + 0.5);
}

#endif
