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

// Times every row beside the baseline of its path (app/measure/timing/driver.h), counts its
// work and computes the verdict on the machine.
bool dip_cost_time_rows(DipCostContext *cost, DipError *err);

// Times a few combinations at half the width and height, for the model of times (report.h). The
// journal does not keep these times, which take seconds. Pictures of less than 64 x 64 pixels have
// no smaller ones. Comes after dip_cost_time_rows.
bool dip_cost_time_smaller(DipCostContext *cost, DipError *err);

// Times rows of path 0 again, each next to the baseline, in as many rounds as dip_cost_time_rows,
// and joins the times to those before. `times_before` is how often the rows were timed before. The
// caller estimates the report's times again.
bool dip_cost_time_again(DipCostContext *cost, const int *rows, int count, int times_before,
                         DipError *err);

// Times rows of path 0 for the first time, which were added after dip_cost_time_rows, and counts
// their work. The journal does not keep these times. The caller estimates the report's times again.
bool dip_cost_time_added(DipCostContext *cost, const int *rows, int count, DipError *err);

// Ranks the combinations of report->predicted: counts their work on a few frames, measures the few
// that tell most about all others, predicts the times and errors of all, and measures those that
// the prediction puts on the Pareto front or near a budget (predict.c). Takes the place of
// dip_cost_judge and dip_cost_time_rows.
bool dip_cost_predict(DipCostContext *cost, DipError *err);

// Times again the rows that may or may not be within a budget, unless the verdict on the machine is
// red.
bool dip_cost_advise(DipCostContext *cost, DipError *err);

// --- elsewhere -----------------------------------------------------------------------------------

// Combinations can be timed elsewhere than a report's rows: at another size, on another camera path
// or with another number of threads. `cost` is the context of the report, and `there` is a context
// without truths for the other place.

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
