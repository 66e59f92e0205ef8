// Computes where the panes and the dock lie in a window of any size.
//
// The dock holds the preview's controls. It lies beneath the panes and does not cover them. In
// windows that are too small for both, the open dock becomes a drawer that covers the current pane
// only, since the requested pane shows what a control changes.
#ifndef DIP_APP_PREVIEW_TOOLS_LAYOUT_H
#define DIP_APP_PREVIEW_TOOLS_LAYOUT_H

#include "app/ui/pixels.h"
#include "app/preview/state/tool_state.h"
#include "app/session/session.h"

// Width of the gap between the panes. In a window of odd width, the gap is one pixel wider.
enum { DIP_PANE_GAP_PX = 2 };

typedef enum DipDockSide { DIP_DOCK_BELOW, DIP_DOCK_DRAWER } DipDockSide;

typedef struct DipLayout {
    int width;
    int height;
    double scale;
    DipRect panes[DIP_PANE_COUNT]; // Where the panes' pictures show. Both rectangles have the same
                                   // size.
    DipDockSide side;
    DipRect bar;  // One row with the tabs and the time line, which a folded dock also has. Empty if
                  // the window is bare.
    DipRect body; // The chosen tab's contents; empty while the dock is folded.
} DipLayout;

// Returns the scale of text and controls in a window of this height in pixels. The scale is the one
// that the display reports (display_scale), times tools->ui_scale. display_scale counts as at least
// 1 and, unless --ui-scale is given, as at least height / 1080, rounded down to a multiple of 0.25.
// So text stays legible on a display with small pixels that reports a scale of 1.
double dip_layout_scale(double display_scale, const DipToolState *tools, int height);

// Lays a window out, with the scale of dip_layout_scale. `tools` says whether the dock shows a tab,
// or the window nothing but the panes.
DipLayout dip_layout_make(int width, int height, double display_scale, const DipToolState *tools);

// Finds a size of the window in which each pane has the given size in pixels. The other arguments
// are those of dip_layout_make.
void dip_layout_window_size(int pane_width, int pane_height, double display_scale,
                            const DipToolState *tools, int *width, int *height);

// Returns the rectangle of the gap between the panes.
DipRect dip_layout_gap(const DipLayout *layout);

// Returns the height of an open dock below the panes, with its bar, at scale 1.
int dip_layout_dock_height(void);

#endif
