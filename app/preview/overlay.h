// What stands over the pictures: a label per pane, the status line, the help.
#ifndef DIP_APP_PREVIEW_OVERLAY_H
#define DIP_APP_PREVIEW_OVERLAY_H

#include "app/preview/state.h"
#include "app/preview/text.h"
#include "renderer/frame.h"

#include <stdbool.h>

// A pane's figures, as they are shown.
typedef struct DipPaneFigures {
    double ms; // median frame time
    int fps;   // frames shown in the last second; 0: not shown
    DipEffects effects;
    bool copied; // from the pane before, with the same settings
} DipPaneFigures;

// Draws over the whole window. panes: where the two pictures are.
void dip_overlay_draw(SDL_Renderer *renderer, DipText *text, const DipPreviewState *state,
                      const SDL_Rect panes[DIP_PANE_COUNT],
                      const DipPaneFigures figures[DIP_PANE_COUNT]);

#endif
