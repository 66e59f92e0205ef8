// Collects the panes' frame times and turns them into figures slow enough to be read.
#ifndef DIP_APP_PREVIEW_FIGURES_H
#define DIP_APP_PREVIEW_FIGURES_H

#include "app/preview/panel.h"
#include "app/preview/timing.h"

// Zero-initialise.
typedef struct DipFigures {
    DipTiming total[DIP_PANE_COUNT];
    DipTiming stages[DIP_PANE_COUNT][DIP_STAGE_COUNT];
    DipTiming presented;
    int64_t updated_ns;                   // When the shown times were taken.
    bool outdated;                        // The shown times are of other settings.
    DipPaneFigures shown[DIP_PANE_COUNT]; // What the window shows.
} DipFigures;

// Forgets a pane's times: its settings have changed.
void dip_figures_forget(DipFigures *figures, int pane);

// Adds a frame. Its effects and counters show at once, its times with dip_figures_update.
void dip_figures_add(DipFigures *figures, const DipSessionFrame *frame, int64_t now_ns);

// Counts a presented picture.
void dip_figures_count_presented(DipFigures *figures, int64_t now_ns);

// Updates the shown times, four times a second. moving: frames follow each other steadily, so that
// a frame rate has a meaning.
void dip_figures_update(DipFigures *figures, bool moving, int64_t now_ns);

#endif
