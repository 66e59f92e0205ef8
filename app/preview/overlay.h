// The overlay over the panes' pictures: a label and a panel per pane, the status line, and the
// sheets (help and costs).
#ifndef DIP_APP_PREVIEW_OVERLAY_H
#define DIP_APP_PREVIEW_OVERLAY_H

#include "app/canvas/draw_list.h"
#include "app/preview/panel.h"
#include "app/preview/state.h"

// Records the overlay of the whole window. panes: the rectangles of the two pictures. scale: the
// display's scale (display.h).
void dip_overlay_draw(DipDrawList *list, const DipPreviewState *state,
                      const DipRect panes[DIP_PANE_COUNT],
                      const DipPaneFigures figures[DIP_PANE_COUNT], double scale);

#endif
