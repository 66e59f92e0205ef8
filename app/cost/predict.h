// Choosing which combinations to measure in order to predict the others, and predicting them.
#ifndef DIP_APP_COST_PREDICT_H
#define DIP_APP_COST_PREDICT_H

#include "app/cost/context.h"

// Draws this many timed frames of path 0, spread evenly, and writes the means of their counters.
bool dip_cost_count(DipCostContext *cost, const DipQuality *quality, int frames, double *counters,
                    DipError *err);

// Fills in the counters of all of report->predicted: means over a few frames. Up to
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

// Returns how many combinations are measured to predict `count` combinations of these settings
// (bit s: setting s): 16 for antialiasing and anisotropic filtering, and two more for every further
// step of every further setting; at most `count`.
int dip_cost_training_count(unsigned settings, int count);

// Chooses the combinations to measure: those that tell most about the prices of work and about
// FLIP (a D-optimal design). `chosen` has room for `count` indices of report->predicted; the first
// is the baseline if it is one of the combinations. Fails with DIP_ERROR_MEMORY.
bool dip_cost_choose_training(const DipCostReport *report, int count, int *chosen, DipError *err);

// Predicts the time and FLIP of every combination of report->predicted that has no row, from all
// combinations that have one.
void dip_cost_predict_others(DipCostReport *report);

// Lists the combinations without a row that should be measured: those on the thinned Pareto front
// of predicted (or measured) time and FLIP, and for each budget of the options the few with
// the least FLIP among those that are predicted to be at most 8 % above it. Returns their number,
// at most `most`.
int dip_cost_list_promising(const DipCostReport *report, int most, int *list, DipError *err);

#endif
