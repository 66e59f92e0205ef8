// Draws what the sum of prices of the requested settings consists of.
#ifndef DIP_APP_PREVIEW_TABS_SUM_PARTS_H
#define DIP_APP_PREVIEW_TABS_SUM_PARTS_H

#include "app/preview/prices/prices.h"
#include "app/ui/ui.h"

enum { DIP_SUM_LEGEND_HEIGHT = 15 }; // Height of a row of the legend, at scale 1.

// Draws the parts of a sum as a bar, with a mark at the budget. The scale ends beyond both.
void dip_sum_bar_draw(DipUi *ui, const DipPriceSum *sum, double budget_ms, DipRect rect);

// Draws the names and the times of these parts. `row` is the first row. Entries that do not fit are
// drawn in the rows below it.
void dip_sum_legend_draw(DipUi *ui, const DipPriceSum *sum, DipRect row);

#endif
