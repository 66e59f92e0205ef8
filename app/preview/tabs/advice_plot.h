// The plot of the advice tab.
#ifndef DIP_APP_PREVIEW_TABS_ADVICE_PLOT_H
#define DIP_APP_PREVIEW_TABS_ADVICE_PLOT_H

#include "app/preview/prices/costs.h"
#include "app/preview/tabs/tabs.h"

// Draws the combinations of window->state->costs by time and error into `room`: the front as
// stairs, the times beyond the budget of `advice` shaded, its settings and those of the current
// pane marked. If the report has more combinations than DIP_COSTS_MAX_POINTS, the heading says so.
// Draws no plot in a room that is too small for one, or with fewer than two combinations.
void dip_advice_plot(DipUi *ui, const DipWindow *window, const DipCostsAdvice *advice,
                     DipRect room);

#endif
