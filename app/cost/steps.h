// Declares the functions that make a report, in the order in which they run. Each fills in a part
// of the report and shows its progress on standard error. A row of the report is one combination of
// settings on a camera path.
#ifndef DIP_APP_COST_STEPS_H
#define DIP_APP_COST_STEPS_H

#include "app/cost/context.h"

// Makes the truths (converged pictures) that are not in the cache, and fills in the noise floor of
// each truth, which tells how far the truth itself may be wrong.
bool dip_cost_make_truths(DipCostContext *cost, DipError *err);

// Draws every row at every viewpoint that this run has (--part), and measures the pictures' errors
// against the truths. This is called judging.
bool dip_cost_judge(DipCostContext *cost, DipError *err);

// Times every row beside the baseline of its path (app/measure/timing/driver.h), counts its work
// (DipCounters) and computes the verdict: how quiet the machine was (DipCostVerdict).
bool dip_cost_time_rows(DipCostContext *cost, DipError *err);

// Times a few combinations at half the width and height, for the model of times (report.h). Does
// nothing if the width or height is below 64 pixels. The journal does not keep these times, since
// measuring them again takes only seconds. Comes after dip_cost_time_rows.
bool dip_cost_time_smaller(DipCostContext *cost, DipError *err);

// Times rows of path 0 beside the baseline, after dip_cost_time_rows and in as many rounds, and
// adds the times to the report's log. `times_before` is how often the rows were timed before. If it
// is 0, the rows are new, and their work is counted, too. The journal does not keep these times.
// The caller must call dip_cost_estimate_times afterwards.
bool dip_cost_time_more(DipCostContext *cost, const int *rows, int count, int times_before,
                        DipError *err);

// Ranks the combinations of report->predicted: counts their work on a few frames, measures the few
// that tell most about all others, predicts the times and errors of all, and measures those that
// the prediction puts on the Pareto front or near a budget (predict.c). Takes the place of
// dip_cost_judge and dip_cost_time_rows.
bool dip_cost_predict(DipCostContext *cost, DipError *err);

// Times again the rows of which it is unclear whether they are within a budget. Does nothing if the
// verdict on the machine is red.
bool dip_cost_advise(DipCostContext *cost, DipError *err);

// Answers requests for timed frames on standard input until it is closed. dip_cost_time_rows starts
// processes that do so (--starts).
bool dip_cost_serve(DipCostContext *cost, DipError *err);

// --- predicting ----------------------------------------------------------------------------------

// Draws `frames` of the frames that are timed along path 0, spread evenly, and writes the means of
// their counters.
bool dip_cost_count(DipCostContext *cost, const DipQuality *quality, int frames, double *counters,
                    DipError *err);

// Fills in the counters of every combination in report->predicted: means over a few frames. Draws
// every combination if there are at most DIP_COST_MOST_COUNTED. Otherwise draws only combinations
// with the baseline's antialiasing or the baseline's filtering, and composes the counters of any
// other combination C from three that were drawn: counters(C's antialiasing, baseline's filtering)
// * counters(baseline's antialiasing, C's filtering) / counters(baseline). Shows its progress on
// standard error.
bool dip_cost_count_combinations(DipCostContext *cost, DipError *err);

// The counters of report->predicted come from a few frames, the counters of rows from all timed
// frames. Scales each counter of the combinations without a row by the ratio of the two. This ratio
// comes from the combinations with a row, which have both counters. Then gives the combinations
// with a row the counters of that row.
void dip_cost_scale_counters(DipCostReport *report);

// Returns how many combinations are measured to predict `count` combinations of these settings.
// Bit s of `settings` stands for setting s. Antialiasing and anisotropic filtering need 16. Every
// other setting needs two more for each step after its first. Returns at most `count`.
int dip_cost_training_count(unsigned settings, int count);

// Chooses the combinations to measure: those that tell most about the price of each kind of work
// (fit.h) and about FLIP, by a D-optimal design. `chosen` has room for `count` indices of
// report->predicted; the first is the baseline if it is one of the combinations. Fails with
// DIP_ERROR_MEMORY.
bool dip_cost_choose_training(const DipCostReport *report, int count, int *chosen, DipError *err);

// Predicts the time and FLIP of every combination of report->predicted that has no row, from all
// combinations that have one.
void dip_cost_predict_others(DipCostReport *report);

// Lists the combinations without a row that should be measured: those on the thinned Pareto front
// (dip_front, choice.h) of predicted or measured time and FLIP. For each budget of the options,
// also lists the few of least FLIP whose time is at most 8 % above the budget. Returns their
// number, at most `most`, or -1 and fills *err.
int dip_cost_list_promising(const DipCostReport *report, int most, int *list, DipError *err);

// --- elsewhere -----------------------------------------------------------------------------------

// Combinations can be timed elsewhere than a report's rows: at another size, on another camera path
// or with another number of threads. `cost` is the context of the report, and `there` is a context
// without truths for the other size, path or number of threads.

// Makes *there a report without rows for this size and the camera path of this category. The number
// of timed frames is that of `report`. The caller frees the predicted combinations that it adds to
// *there.
void dip_cost_elsewhere_begin(DipCostReport *there, const DipCostReport *report, int width,
                              int height, const char *path);

// Times the combinations of `rows` in the context `there`, each beside the baseline of the report's
// path 0, and fills in their times and counters. `progress` is the text of the progress display,
// such as "smaller frames timed". Sets *wait to the share of the frames' time that their threads
// waited for a core. Fails with MEMORY, as the renderer does, and with RUNTIME after Ctrl-C or if
// too many frames were disturbed.
bool dip_cost_time_elsewhere(DipCostContext *cost, DipCostContext *there, DipCostElsewhere *rows,
                             int count, const char *progress, double *wait, DipError *err);

#endif
