// Colours of the tools for looking closer: text, marks over pictures, and the ground beneath crops;
// and the outline that marks a rectangle of a picture.
#ifndef DIP_APP_PREVIEW_TOOLS_TOOL_COLOURS_H
#define DIP_APP_PREVIEW_TOOLS_TOOL_COLOURS_H

#include "app/canvas/pixels.h"
#include "app/ui/style.h"
#include "app/ui/ui.h"

static const DipColour dip_tool_white = {255, 255, 255, 255}; // Values.
static const DipColour dip_tool_soft = {196, 202, 210, 255};  // Words.
static const DipColour dip_tool_dim = {152, 162, 174, 255};   // Notes, on the dock only.
static const DipColour dip_tool_accent = {255, 190, 92, 255}; // The requested pane.
static const DipColour dip_tool_gain = {95, 214, 189, 255};   // Less error.
static const DipColour dip_tool_worse = {255, 154, 139, 255}; // More error.
static const DipColour dip_tool_line = {51, 58, 68, 255};     // Lines and outlines.
static const DipColour dip_tool_well = {12, 14, 17, 255};     // Ground beneath pictures.
static const DipColour dip_tool_ground = {20, 22, 26, 255};   // Ground of the dock.
static const DipColour dip_tool_glass = {10, 12, 15, 199};    // Labels over pictures.
static const DipColour dip_tool_dark = {0, 0, 0, 255};        // Borders of marks over pictures.

// Returns black or white, whichever stands out from a colour.
static inline DipColour dip_tool_contrast(DipColour ground) {
    const int luma = 2 * ground.red + 5 * ground.green + ground.blue; // 0..2040
    return luma > 1000 ? dip_tool_dark : dip_tool_white;
}

// Outlines a rectangle from outside with a colour on a dark border, so that the outline shows over
// any picture.
static inline void dip_tool_outline(DipUi *ui, DipRect rect, DipColour colour) {
    const int thin = dip_style_max(1, dip_ui_px(ui, 1));
    const DipRect outer = {rect.x - 3 * thin, rect.y - 3 * thin, rect.width + 6 * thin,
                           rect.height + 6 * thin};
    const DipRect middle = {rect.x - 2 * thin, rect.y - 2 * thin, rect.width + 4 * thin,
                            rect.height + 4 * thin};
    dip_ui_outline(ui, outer, 0, thin, dip_tool_dark);
    dip_ui_outline(ui, middle, 0, 2 * thin, colour);
}

#endif
