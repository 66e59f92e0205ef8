// Whether a sweep's steps order as theory says, in error and in work. Times are not asked: they are
// the machine's.
#ifndef DIP_APP_COST_ORDER_H
#define DIP_APP_COST_ORDER_H

#include "app/cost/report.h"

#include <stddef.h>

// One sentence or two: what falls or rises with the steps, or which step does not and why that may
// be. False where the report cannot tell: steps are not judged, or theory says nothing of them.
bool dip_cost_order_text(const DipCostReport *report, const DipCostSweep *sweep, char *text,
                         size_t size_bytes);

#endif
