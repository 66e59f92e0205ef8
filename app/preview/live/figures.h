// Collects the panes' frame times and turns them into figures that change slowly enough to be read.
#ifndef DIP_APP_PREVIEW_LIVE_FIGURES_H
#define DIP_APP_PREVIEW_LIVE_FIGURES_H

#include "app/preview/live/panel.h"
#include "app/preview/live/timing.h"

// Zero-initialise.
typedef struct DipFigures {
    DipTiming total[DIP_PANE_COUNT];
    DipTiming stages[DIP_PANE_COUNT][DIP_STAGE_COUNT];
    DipTiming presented;
    DipTiming dropped;    // Refreshes without a new picture, with their number as the time.
    int64_t presented_ns; // When the last picture was presented; 0 before, and after a rest.
    int64_t updated_ns;   // When the shown times were updated.
    bool outdated;        // True if settings have changed since the shown times were measured.
    DipPaneFigures shown[DIP_PANE_COUNT]; // What the window shows.
} DipFigures;

// Forgets a pane's times. Call it when the pane's settings change.
void dip_figures_forget(DipFigures *figures, int pane);

// Adds a frame. The frame's effects and counters show at once; its times show after
// dip_figures_update.
void dip_figures_add(DipFigures *figures, const DipSessionFrame *frame, int64_t now_ns);

// Counts a presented picture, and the refreshes of the display that passed without one while the
// picture moved.
void dip_figures_count_presented(DipFigures *figures, bool moving, int64_t refresh_ns,
                                 int64_t now_ns);

// Updates the shown times if they are outdated or a quarter of a second old. `moving` is true if
// frames follow each other without pauses. Only then is a frame rate shown.
void dip_figures_update(DipFigures *figures, bool moving, int64_t now_ns);

#endif
