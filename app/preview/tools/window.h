// Declares what the window shows in one pass (ui.h), and the functions by which the tools draw the
// panes, draw over them and take events.
#ifndef DIP_APP_PREVIEW_TOOLS_WINDOW_H
#define DIP_APP_PREVIEW_TOOLS_WINDOW_H

#include "app/preview/live/figures.h"
#include "app/preview/prices/prices.h"
#include "app/preview/state/state.h"
#include "app/preview/tools/layout.h"
#include "app/ui/ui.h"

typedef struct DipTools DipTools; // tools.h

// Everything that the window shows. All pointers are borrowed for one pass.
typedef struct DipWindow {
    DipPreviewState *state;
    const DipLayout *layout;
    DipPixels frames[DIP_PANE_COUNT];  // The panes' newest pictures.
    uint64_t versions[DIP_PANE_COUNT]; // Equal versions mean equal pixels (draw_list.h).
    bool still;                        // Camera and scene stand still.
    int64_t now_ns;                    // Time on the display's clock, as in DipUiPass.
    const DipPaneFigures *figures;     // Array with the figures of each pane.
    const DipPrices *prices;
    DipTools *tools; // The memory of the tools: loupe, comparison, maps and thumbnails.
    // The converged picture from the frames' pose and in their size; NULL if this picture is not
    // known.
    const DipPixels *truth;
    uint64_t truth_version; // Equal versions mean equal pixels. No frame has the same number.
} DipWindow;

// Returns the pixels of a frame, which the frame still owns.
static inline DipPixels dip_frame_pixels(const DipFrame *frame) {
    const DipPixels pixels = {frame->rgba8, frame->stride_bytes, frame->width, frame->height};
    return pixels;
}

// Draws the panes' pictures side by side, or as the chosen comparison shows them.
void dip_compare_pictures(DipUi *ui, DipWindow *window);

// Each function declares what its tool shows over the panes, such as marks, dividers and the map.
// `panes`: what the user did with each pane's control in this pass.
void dip_loupe_over_panes(DipUi *ui, DipWindow *window, const DipUiInput panes[DIP_PANE_COUNT]);
void dip_compare_over_panes(DipUi *ui, DipWindow *window, const DipUiInput panes[DIP_PANE_COUNT]);
void dip_maps_over_panes(DipUi *ui, DipWindow *window, const DipUiInput panes[DIP_PANE_COUNT]);

// Lets the mouse fly the camera. `panes`: what the user did with each pane's control in this pass.
// Dragging with the right button turns the camera, and frees it from the path. Dragging with the
// left button turns a camera that is free already, unless a wipe uses the button. The wheel changes
// the speed of the free camera, or the distance of a free camera that orbits. With Ctrl, the wheel
// is left to the loupe.
//
// Removes from `panes` the input that has flown the camera, so that no tool acts on it: the wheel's
// steps and the press of the right button. A press of the right button is reported when the button
// is released without a drag.
void dip_fly_over_panes(DipUi *ui, DipWindow *window, DipUiInput panes[DIP_PANE_COUNT]);

// Lets arrow keys move the loupe by a pixel, or with Shift by 8 pixels, while the loupe is on. Keys
// with Ctrl, Alt or Super do not move it. Call it for events that neither a control nor the focus
// took. Returns whether the event moved the loupe.
bool dip_loupe_press(DipPreviewState *state, int width, int height, const DipEvent *event);

#endif
