// Draws the preview as one picture: both panes (the pictures of the current and the requested
// settings), and the controls and texts over and beneath them.
#ifndef DIP_APP_PREVIEW_LOOP_VIEW_H
#define DIP_APP_PREVIEW_LOOP_VIEW_H

#include "app/ui/draw_list.h"
#include "app/preview/tabs/tabs.h"
#include "app/preview/cells/text_view.h"

typedef struct DipView DipView;

// If `text` is not NULL, it draws all texts as character cells (text_view.h), and the picture holds
// the panes only. Otherwise all texts are drawn into the picture. `text` is borrowed. Fails with
// MISSING if the picture needs a font and there is none, or with MEMORY.
DipView *dip_view_create(DipTextView *text, DipError *err);
void dip_view_destroy(DipView **view);

// Sets a pane's frame. The frame's pixels are borrowed until the pane's next frame is set.
void dip_view_set_frame(DipView *view, int pane, const DipFrame *frame);

// Returns the version of a pane's picture: equal versions mean equal pixels.
uint64_t dip_view_version(const DipView *view, int pane);

// What the window shows besides the panes' frames. All pointers are borrowed for a call.
typedef struct DipViewInput {
    int width; // Size of the window in pixels.
    int height;
    double scale;      // The display's scale (display.h).
    DipTextView *text; // Draws the texts as character cells; NULL if the picture holds them.
    DipWindow window;  // Without layout, frames, versions and truth, which the view fills in.
} DipViewInput;

// Returns where the panes and the dock lie.
DipLayout dip_view_layout(const DipViewInput *input);

// Hands an event to the window's controls, which change the state. Returns whether one of them
// took the event.
bool dip_view_handle(DipView *view, const DipViewInput *input, const DipEvent *event);

// Draws what has changed since the last call, or everything if the size has changed.
bool dip_view_draw(DipView *view, const DipViewInput *input, DipError *err);

// Returns the window's controls (ui.h), which know the focus and when the window must be drawn
// again.
DipUi *dip_view_ui(DipView *view);

// Returns the picture, which is valid until the next dip_view_draw.
DipPixels dip_view_picture(const DipView *view);

// Returns the rectangles that have changed since the previous call, or with `all` one that covers
// the whole picture, and forgets them.
DipDamage dip_view_take_damage(DipView *view, bool all);

#endif
