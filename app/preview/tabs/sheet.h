// Sheets of text (help, costs) that cover the middle of the window until the user closes them.
#ifndef DIP_APP_PREVIEW_TABS_SHEET_H
#define DIP_APP_PREVIEW_TABS_SHEET_H

#include "app/ui/draw_list.h"
#include "app/preview/state/state.h"

// Darkens the window and draws an empty sheet of the given size in the middle of the window.
// Returns the sheet's rectangle.
DipRect dip_sheet_draw(DipDrawList *list, int width, int height);

// Draws all keys and what they do, in the largest letters that fit, or those whose text holds
// `words` in any case. scale: the display's scale (display.h).
void dip_sheet_draw_help(DipDrawList *list, double scale, const char *words);

// Draws the cost report as a table, in which the steps of the requested pane are highlighted. If
// there is no report, the sheet says how to make one.
void dip_sheet_draw_costs(DipDrawList *list, const DipPreviewState *state, double scale);

#endif
