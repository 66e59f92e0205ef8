// Checks whether error and work follow theory from one step of a sweep to the next. Times are not
// checked, since they depend on the machine.
#ifndef DIP_APP_COST_ORDER_H
#define DIP_APP_COST_ORDER_H

#include "app/cost/report.h"

#include <stddef.h>

// Writes a sentence: what falls or rises with the steps, or which step departs from theory and what
// the reason may be. Returns false if the steps are not judged or theory says nothing about them.
bool dip_cost_order_text(const DipCostReport *report, const DipCostSweep *sweep, char *text,
                         size_t size_bytes);

#endif
