// The tabs of the dock, and the tools that draw over the panes.
//
// Each tab has a file that declares its controls (ui.h) and draws its contents. The same code runs
// for events and for drawing. A tab changes nothing but the state (state.h, by dip_preview_act
// where an action exists) and its own tool's memory.
#ifndef DIP_APP_PREVIEW_TABS_TABS_H
#define DIP_APP_PREVIEW_TABS_TABS_H

#include "app/preview/tools/window.h"

// Declares and draws the whole window: the panes' pictures, labels, marks, the dock and sheets.
void dip_window_declare(DipUi *ui, DipWindow *window);

// Each function declares and draws one tab in the rectangle `body`, which is never empty. Where the
// room is too small, a tab leaves out whole parts and cuts none.
void dip_tab_settings(DipUi *ui, DipWindow *window, DipRect body);
void dip_tab_loupe(DipUi *ui, DipWindow *window, DipRect body);
void dip_tab_compare(DipUi *ui, DipWindow *window, DipRect body);
void dip_tab_maps(DipUi *ui, DipWindow *window, DipRect body);
void dip_tab_advice(DipUi *ui, DipWindow *window, DipRect body);
void dip_tab_times(DipUi *ui, DipWindow *window, DipRect body);
void dip_tab_path(DipUi *ui, DipWindow *window, DipRect body);

// Draws the frame times of both panes in the last seconds, with the line of the budget.
void dip_times_graph_draw(DipUi *ui, const DipWindow *window, DipRect rect);

#endif
