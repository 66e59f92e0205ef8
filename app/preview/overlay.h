// What stands over the pictures: a label and a panel per pane, the status line, the help.
#ifndef DIP_APP_PREVIEW_OVERLAY_H
#define DIP_APP_PREVIEW_OVERLAY_H

#include "app/preview/panel.h"
#include "app/preview/state.h"
#include "app/preview/text.h"

// Draws over the whole window. panes: where the two pictures are.
void dip_overlay_draw(SDL_Renderer *renderer, DipText *text, const DipPreviewState *state,
                      const SDL_Rect panes[DIP_PANE_COUNT],
                      const DipPaneFigures figures[DIP_PANE_COUNT]);

#endif
