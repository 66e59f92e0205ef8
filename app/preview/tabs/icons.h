// Symbols of the dock's bar, drawn as rectangles so that they are sharp at every scale.
#ifndef DIP_APP_PREVIEW_TABS_ICONS_H
#define DIP_APP_PREVIEW_TABS_ICONS_H

#include "app/preview/tools/tools.h"
#include "app/ui/ui.h"

// Each draws its symbol in the middle of a rectangle.
void dip_icon_tab(DipUi *ui, DipTab tab, DipRect rect, DipColour colour);
void dip_icon_play(DipUi *ui, DipRect rect, bool paused, DipColour colour);
// Draws a bar and a triangle that points away from it: one frame on, or back.
void dip_icon_step(DipUi *ui, DipRect rect, bool back, DipColour colour);
// Draws the corners of a screen.
void dip_icon_full_screen(DipUi *ui, DipRect rect, DipColour colour);
// Draws two pictures beside each other.
void dip_icon_panes(DipUi *ui, DipRect rect, DipColour colour);
// Draws a chevron that points up or down.
void dip_icon_fold(DipUi *ui, DipRect rect, bool up, DipColour colour);

#endif
