// The one figure that stands for a pane's time, wherever the window shows it.
#ifndef DIP_APP_PREVIEW_TABS_PANE_TIME_H
#define DIP_APP_PREVIEW_TABS_PANE_TIME_H

#include "app/preview/tools/window.h"

enum { DIP_PANE_TIME_BYTES = 48 };

typedef struct DipPaneTime {
    double ms;
    DipPriceTrust trust;
    bool measured_here; // Timed at rest, a few frames beside the other settings' frames.
    bool single;        // The time of a single frame.
} DipPaneTime;

// Returns a pane's time. While pictures move, it is the median of the last second. At rest it is
// the time of the settings that was measured for their prices or, before there is one, the last
// median. If the settings have changed since, it is the time of the single frame that was drawn.
DipPaneTime dip_pane_time(const DipWindow *window, int pane);

// Writes "8.4 ms", "≈ 8.4 ms" if it was measured at rest, "8? ms" if it is doubtful, or "one frame:
// 44.0 ms".
void dip_pane_time_text(const DipPaneTime *time, char text[DIP_PANE_TIME_BYTES]);

// Returns the sum of prices that the panel shows for a pane: that of the report or, without a
// report, one that ends at the pane's time. While no price is known, it has the base alone.
DipPriceSum dip_pane_sum(const DipWindow *window, int pane);

#endif
