// Checks whether error and work follow theory from one step of a sweep to the next. (A sweep is all
// steps of one setting.) Times are not checked, because they depend on the machine.
#ifndef DIP_APP_REPORT_ORDER_H
#define DIP_APP_REPORT_ORDER_H

#include "app/report/report.h"

#include <stddef.h>

// Writes a sentence about a sweep. If the steps follow theory, the sentence says what falls or
// rises from step to step. Otherwise it names the step that departs from theory and gives a likely
// reason. Returns false if the steps' errors are unknown or theory says nothing about the setting.
bool dip_cost_order_text(const DipCostReport *report, const DipCostSweep *sweep, char *text,
                         size_t size_bytes);

#endif
