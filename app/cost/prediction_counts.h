// Counts the work of the combinations that --predict ranks, from a few frames of each.
#ifndef DIP_APP_COST_PREDICTION_COUNTS_H
#define DIP_APP_COST_PREDICTION_COUNTS_H

#include "app/cost/context.h"

enum { DIP_COST_COUNTED_FRAMES = 8 }; // Frames of path 0 that are counted, spread evenly.

// Fills in the counters of all of report->predicted: means over the counted frames. Up to
// DIP_COST_MOST_COUNTED combinations are drawn one by one. Of more, only those are drawn that have
// the baseline's antialiasing or the baseline's filtering. The counters of any other combination
// are then composed: those with its antialiasing and the baseline's filtering, times those with the
// baseline's antialiasing and its filtering, over those of the baseline. Shows its progress on
// standard error.
bool dip_cost_count_combinations(DipCostContext *cost, DipError *err);

// Scales the counters of combinations that were not measured to the frames that are timed. The
// factor of each counter comes from the measured combinations, which have both. Then gives the
// measured ones the counters of their rows.
void dip_cost_scale_counters(DipCostReport *report);

#endif
