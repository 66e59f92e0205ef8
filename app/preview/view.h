// The preview as one picture: both panes (the pictures of the current and the requested settings)
// side by side, and the overlay over the panes.
#ifndef DIP_APP_PREVIEW_VIEW_H
#define DIP_APP_PREVIEW_VIEW_H

#include "app/canvas/draw_list.h"
#include "app/preview/panel.h"
#include "app/preview/state.h"

enum { DIP_PANE_GAP_PX = 2 }; // Width of the gap between the panes.

typedef struct DipView DipView;

// Fails with MISSING if there is no font.
DipView *dip_view_create(DipError *err);
void dip_view_destroy(DipView **view);

// Fills in the panes' rectangles for a picture of the given size.
void dip_view_panes(int width, int height, DipRect panes[DIP_PANE_COUNT]);

// Sets a pane's frame. The frame's pixels are borrowed until the pane's next frame is set.
void dip_view_set_frame(DipView *view, int pane, const DipFrame *frame);

// Draws what has changed since the last call, or everything if the size has changed.
bool dip_view_draw(DipView *view, int width, int height, double scale, const DipPreviewState *state,
                   const DipPaneFigures figures[DIP_PANE_COUNT], DipError *err);

// Returns the picture, which is valid until the next dip_view_draw.
DipPixels dip_view_picture(const DipView *view);

// Returns the rectangles that have changed since the previous call, and forgets them.
DipDamage dip_view_take_damage(DipView *view);

// Marks the whole picture as changed.
void dip_view_damage_all(DipView *view);

// Writes the picture to a file in the working folder: to the first of diptych-0001.png,
// diptych-0002.png, ... that does not exist yet. Fills in the file's name.
bool dip_view_save(const DipView *view, char *file, size_t size_bytes, DipError *err);

#endif
