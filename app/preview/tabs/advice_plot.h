// The plot of the advice tab.
#ifndef DIP_APP_PREVIEW_TABS_ADVICE_PLOT_H
#define DIP_APP_PREVIEW_TABS_ADVICE_PLOT_H

#include "app/preview/tools/window.h"

// Draws what can be chosen (window->state->choice) by time and error into `room`: the front as
// stairs, the times beyond the budget shaded, the advised settings and those of the current pane
// marked. Draws no plot in a room that is too small for one, or of fewer than two candidates.
void dip_advice_plot(DipUi *ui, const DipWindow *window, DipRect room);

#endif
