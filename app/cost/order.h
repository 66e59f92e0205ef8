// Checks whether error and work follow theory from one step of a sweep to the next. Times are not
// checked, since they depend on the machine.
#ifndef DIP_APP_COST_ORDER_H
#define DIP_APP_COST_ORDER_H

#include "app/cost/report.h"

#include <stddef.h>

// Writes a sentence. If the steps follow theory, it says what falls or rises with them. Otherwise
// it says which step departs from theory, and a likely reason. Returns false if the steps' errors
// are unknown or theory says nothing about the setting.
bool dip_cost_order_text(const DipCostReport *report, const DipCostSweep *sweep, char *text,
                         size_t size_bytes);

#endif
