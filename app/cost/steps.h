// The functions that make a report, in the order in which they run. Each fills in its part of the
// report and shows its progress on standard error. A row of the report is one combination of
// settings on a camera path.
#ifndef DIP_APP_COST_STEPS_H
#define DIP_APP_COST_STEPS_H

#include "app/cost/context.h"

// Makes the truths (converged pictures) that are not in the cache, and fills in the noise floors of
// all truths.
bool dip_cost_make_truths(DipCostContext *cost, DipError *err);

// Draws every row at every viewpoint that this run has (--part), and judges the pictures: measures
// their errors against the truths.
bool dip_cost_judge(DipCostContext *cost, DipError *err);

// Times every row in interleaved rounds (app/measure/timing.h), and counts its work.
bool dip_cost_time_rows(DipCostContext *cost, DipError *err);

// Times one row alone, in as many rounds as dip_cost_time_rows.
bool dip_cost_time_row_again(DipCostContext *cost, int row, DipStatsEstimate *time, DipError *err);

// Chooses a row for each budget, times it again and fills in the advice.
bool dip_cost_advise(DipCostContext *cost, DipError *err);

#endif
