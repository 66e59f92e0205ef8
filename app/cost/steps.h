// Declares the functions that make a report, in the order in which they run. Each fills in a part
// of the report and shows its progress on standard error. A row of the report is one combination of
// settings on a camera path.
#ifndef DIP_APP_COST_STEPS_H
#define DIP_APP_COST_STEPS_H

#include "app/cost/context.h"
#include "app/report/fit.h"

// Times the baseline for about a second, twice in turn, and warns if the verdict on the machine
// would not be green (verdict.h). The verdict of the report comes from all of its times. Sets
// cost->baseline_ms. Warns at most once for a context, here and in dip_cost_look_at_times.
bool dip_cost_look_at_machine(DipCostContext *cost, DipError *err);

// Warns if the threads waited so long for a core while these frames were drawn that the verdict on
// the machine would not be green.
void dip_cost_look_at_times(DipCostContext *cost, const DipTimed *timed, int count);

// The phases of a run, in order. Some have no work in some runs.
typedef enum DipCostPhase {
    DIP_COST_PHASE_TRUTHS,
    DIP_COST_PHASE_SWEEPS,      // Errors of the rows that are planned.
    DIP_COST_PHASE_COUNTING,    // This phase and the next are those of predictions.
    DIP_COST_PHASE_TRAINING,    // Errors of the rows that tell most about all others.
    DIP_COST_PHASE_TIMES,       // Times of all rows so far.
    DIP_COST_PHASE_BEST_ERRORS, // Errors of the best combinations, in one go (predict.c).
    DIP_COST_PHASE_BEST_TIMES,
    DIP_COST_PHASE_MORE_BEST, // All further goes.
    DIP_COST_PHASE_ADVICE,
    DIP_COST_PHASE_PAGE,
    DIP_COST_PHASE_COUNT
} DipCostPhase;

// Begins the forecast, once cost->baseline_ms is known.
void dip_cost_forecast_begin(DipCostContext *cost);

// Begins a phase: tells the progress display how long the later phases will take. Returns this time
// in seconds.
double dip_cost_begin_phase(DipCostContext *cost, DipCostPhase phase);

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

// Ranks all combinations of the combined settings: judges the sweeps and drops the settings that
// change no picture, counts the work of combinations on a few frames, measures those that tell most
// about all others, predicts the times and errors of all, and measures those that the prediction
// puts on the Pareto front or near a budget. Takes the place of dip_cost_judge and
// dip_cost_time_rows.
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

// Takes those settings out of options.combined of which all steps of the sweep draw the same
// pictures. They keep their step of the baseline.
void dip_cost_drop_idle_settings(DipCostReport *report);

// Lists the combinations of the combined settings in report->predicted, and sets `searched`. If
// there are more than DIP_COST_MAX_ROWS, lists only those that differ from the baseline in one
// group of settings (combinations.h) and a sample of the others. Fails with DIP_ERROR_MEMORY.
bool dip_cost_list_predictions(DipCostReport *report, DipError *err);

// Fills in the counters of every combination in report->predicted: means over a few frames. Draws
// every combination if there are at most DIP_COST_MOST_COUNTED. Otherwise draws those that differ
// from the baseline in one group of settings, and composes the counters of the others. Shows its
// progress on standard error.
bool dip_cost_count_combinations(DipCostContext *cost, DipError *err);

// If report->predicted has only a sample of the combinations, takes those out of the list that will
// take about four times as long as the baseline or longer, and differ from it in several groups of
// settings. They would tell much about prices, but take too long to measure.
void dip_cost_drop_slow_sample(DipCostReport *report);

// Composes the counters of a combination from the counted ones of report->predicted
// (combinations.h). Returns false if one that is needed is not listed.
bool dip_cost_compose_counters(const DipCostReport *report, DipCostPrediction *prediction);

// The counters of report->predicted come from a few frames, the counters of rows from all timed
// frames. Scales each counter of the combinations without a row by the ratio of the two. This ratio
// comes from the combinations with a row, which have both counters. Then gives the combinations
// with a row the counters of that row.
void dip_cost_scale_counters(DipCostReport *report);

enum { DIP_COST_COUNTED_FRAMES = 8 }; // Frames of path 0, spread evenly, whose work is counted.

// Returns how many combinations are measured to predict `count` combinations of these settings,
// with those of the sweeps. Bit s of `settings` stands for setting s. Antialiasing and anisotropic
// filtering need 16. Every other setting needs three more for each two steps after its first.
// Returns at most `count`.
int dip_cost_training_count(unsigned settings, int count);

// Chooses the combinations to measure: those that tell most about the price of each kind of work
// (fit.h) and about FLIP, by a D-optimal design. `chosen` has room for `count` indices of
// report->predicted. First come the combinations that have a row, or if there are none, the
// baseline. Fails with DIP_ERROR_MEMORY.
bool dip_cost_choose_training(const DipCostReport *report, int count, int *chosen, DipError *err);

// What is predicted of a combination.
enum {
    DIP_COST_PREDICTED_MS,
    DIP_COST_PREDICTED_P95,
    DIP_COST_PREDICTED_FLIP,
    DIP_COST_PREDICTED // Number of values.
};

// A measured combination's shares in the corrections of the logarithms of all predictions.
typedef struct DipCostCorrection {
    DipQuality quality;
    double shares[DIP_COST_PREDICTED];
} DipCostCorrection;

// The models of the combinations that have a row, and corrections by what they miss there.
typedef struct DipCostModels {
    DipCostModel times;
    DipCostModel errors;
    double p95; // The usual ratio of the 95th percentile of the frames' times to their mean.
    DipCostCorrection *corrections; // Owned.
    int correction_count;
} DipCostModels;

// Fits the models. Free them even after a failure. Fails with DIP_ERROR_MEMORY.
bool dip_cost_models_of(const DipCostReport *report, DipCostModels *models, DipError *err);
void dip_cost_models_free(DipCostModels *models);

// Returns how alike two combinations are in the settings of a mask: 1 if these are the same, and
// half for each setting that differs. The likeness in all settings is the product of those in parts
// of them.
double dip_cost_alike(const DipQuality *a, const DipQuality *b, unsigned settings);

// Predicts a combination with these counters: the models' values, times exp(c). The correction c is
// the sum of the shares of all measured combinations, each times its likeness to this one: the mean
// of a Gaussian process whose covariance is the likeness (Rasmussen and Williams 2006, eq. 2.25).
void dip_cost_predict_one(const DipCostModels *models, const double *counters,
                          const DipQuality *quality, const double *likeness,
                          double values[DIP_COST_PREDICTED]);

// Predicts every combination of report->predicted that has no row. Fails with DIP_ERROR_MEMORY.
bool dip_cost_predict_others(DipCostReport *report, const DipCostModels *models, DipError *err);

// Up to which predicted time combinations are measured for a budget: up to that at which nine of
// ten fit it, and up to that at which one of ten does, by how far times are predicted wrong so far.
enum { DIP_COST_LIMIT_SURE, DIP_COST_LIMIT_MAY, DIP_COST_LIMITS };
double dip_cost_limit_ms(const DipCostReport *report, int budget, int limit);

// Predicts all combinations of the combined settings, and adds the best to report->predicted: for
// each limit of each budget DIP_COST_PER_LIMIT of least FLIP, and those on the thinned Pareto front
// of times that differ by 2 % or more. The work is composed of the counted combinations of the
// list. Fails with DIP_ERROR_MEMORY.
enum { DIP_COST_PER_LIMIT = 8 };
bool dip_cost_search(DipCostReport *report, DipPool *pool, const DipCostModels *models,
                     DipError *err);

// Lists the combinations without a row that should be measured: for each limit of each budget the
// few of least FLIP, and those on the thinned Pareto front (dip_front, choice.h) of predicted or
// measured time and FLIP. Returns their number, at most `most`, or -1 and fills *err.
int dip_cost_list_promising(const DipCostReport *report, int most, int *list, DipError *err);

// Adds rows for those of these combinations (indices of report->predicted) that have none, and
// lists the rows of all.
bool dip_cost_add_rows(DipCostReport *report, const int *list, int count, int *rows, DipError *err);

// Measures the errors, times and work of new rows of path 0, and estimates the times of all rows.
typedef bool DipCostMeasure(void *context, const int *rows, int count, DipError *err);

// Predicts all combinations, measures the best ones and predicts the others anew, at most
// dip_cost_most_goes times. If the verdict is red, only predicts.
bool dip_cost_measure_best(DipCostReport *report, DipPool *pool, DipCostMeasure *measure,
                           void *context, DipError *err);
int dip_cost_most_goes(const DipCostOptions *options);

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
