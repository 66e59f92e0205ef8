// Timing combinations elsewhere than a report's rows: at another size, on another camera path or
// with another number of threads.
//
// A combination is a set of quality settings. `cost` is the context (context.h) of the report, and
// `there` is a context without truths for the other place.
#ifndef DIP_APP_COST_ELSEWHERE_H
#define DIP_APP_COST_ELSEWHERE_H

#include "app/cost/context.h"

// Fills in a report without rows for a place with this size, on the camera path of this category,
// which times as many frames as `report`. Its predicted combinations, if it gets any, are the
// caller's to free.
void dip_cost_elsewhere_begin(DipCostReport *there, const DipCostReport *report, int width,
                              int height, const char *path);

// Times the combinations of `rows` there, each beside the baseline of the report's path 0, and
// fills in their times and counters. `progress` names what is timed: "smaller frames timed".
// *machine gets what the timing tells about the machine, except whether it settled. Fails with
// MEMORY, as the renderer does, and with RUNTIME after Ctrl-C or if too many frames were disturbed.
bool dip_cost_time_elsewhere(DipCostContext *cost, DipCostContext *there, DipCostElsewhere *rows,
                             int count, const char *progress, DipDriverMachine *machine,
                             DipError *err);

#endif
