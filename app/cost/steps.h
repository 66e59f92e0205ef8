// Declares the steps that make a report, in the order in which they run, and then the functions
// that predictions consist of. The steps fill in parts of the report and show their progress on
// standard error. A row of the report is one combination of settings on a camera path.
#ifndef DIP_APP_COST_STEPS_H
#define DIP_APP_COST_STEPS_H

#include "app/cost/context.h"
#include "app/report/flip_model.h"
#include "app/report/fit.h"

// Finds out with fewer than a hundred frames how busy other programs keep the machine: times the
// baseline beside a second copy of itself. Warns if the verdict on these times (verdict.h) is red,
// or if a verdict on the waiting time of the threads alone is not green. (The report's own verdict
// comes later, from all of its times.) Sets cost->baseline_ms. There is at most one warning for
// each context, either from this function or from dip_cost_look_at_times.
bool dip_cost_look_at_machine(DipCostContext *cost, DipError *err);

// Warns if the threads waited so long for a core while these frames were drawn that a verdict on
// their waiting time alone is not green.
void dip_cost_look_at_times(DipCostContext *cost, const DipTimed *timed, int count);

// The phases of a run, in order. Only runs with predictions have the phases COUNTING, TRAINING,
// BEST_ERRORS, BEST_TIMES and MORE_BEST. Such runs measure the best combinations in several goes
// (best.c), so the phases BEST_ERRORS and BEST_TIMES may begin several times.
typedef enum DipCostPhase {
    DIP_COST_PHASE_TRUTHS,
    DIP_COST_PHASE_SWEEPS,      // Errors of the planned rows (plan.h).
    DIP_COST_PHASE_COUNTING,    // Work of combinations.
    DIP_COST_PHASE_TRAINING,    // Errors of the combinations that tell most about all others.
    DIP_COST_PHASE_TIMES,       // Times of all rows so far.
    DIP_COST_PHASE_BEST_ERRORS, // Errors of the best combinations, in one go.
    DIP_COST_PHASE_BEST_TIMES,  // Times of the best combinations, in one go.
    DIP_COST_PHASE_MORE_BEST,   // All later goes together. Only the forecast uses this phase.
    DIP_COST_PHASE_ADVICE,
    DIP_COST_PHASE_PAGE,
    DIP_COST_PHASE_COUNT
} DipCostPhase;

// Begins the forecast. Uses cost->baseline_ms, so call this function after
// dip_cost_look_at_machine, unless nothing is timed.
void dip_cost_forecast_begin(DipCostContext *cost);

// Begins a phase: tells the progress display how long this phase and all later phases will probably
// take. Returns the expected time of the later phases in seconds.
double dip_cost_begin_phase(DipCostContext *cost, DipCostPhase phase);

// Makes the truths (converged pictures) that are not in the cache. Fills in the noise floor of each
// truth, which tells how far the truth itself may be wrong. Writes the truths as PFM files if the
// user asks for them (--save-truths).
bool dip_cost_make_truths(DipCostContext *cost, DipError *err);

// Judges the rows: draws every row at every viewpoint that this run has (--part), and measures the
// pictures' errors against the truths. Leaves out rows at viewpoints where they are judged already.
bool dip_cost_judge(DipCostContext *cost, DipError *err);

// Times every row beside the baseline of its path (app/measure/timing/driver.h), counts its work
// (DipCounters) and computes the verdict: how quiet the machine was (DipCostVerdict).
bool dip_cost_time_rows(DipCostContext *cost, DipError *err);

// Times a few combinations at half the width and height, for the model of times (fit.h). Does
// nothing if the width or height is below 64 pixels. The journal does not keep these times, since
// measuring them again takes only seconds. Call this function after dip_cost_time_rows.
bool dip_cost_time_smaller(DipCostContext *cost, DipError *err);

// Times rows of path 0 beside the baseline, in as many rounds as dip_cost_time_rows, which must
// have been called before. Adds the times to the report's log. `times_before` is 0 if the rows are
// new; their work is then counted, too. If the rows are timed again, it is 1 or more, and each
// number gives another order of frames. The journal does not keep these times. The caller must call
// dip_cost_estimate_times afterwards.
bool dip_cost_time_more(DipCostContext *cost, const int *rows, int count, int times_before,
                        DipError *err);

// Finds the best combinations of the combined settings (--combine) by predictions. Judges the
// sweeps, and drops the settings that change no picture. Counts the work of combinations on a few
// frames. Measures the combinations that tell most about all others, and predicts the times and
// errors of all others from them. Then measures those that the predictions put on the Pareto front
// or near a budget. A run with predictions calls this function instead of dip_cost_judge,
// dip_cost_time_rows and dip_cost_time_smaller.
bool dip_cost_predict(DipCostContext *cost, DipError *err);

// Times rows again if it is unclear whether they are within a budget. If a row is advised for this
// budget, only rows that are clearly better than the advised row are timed again. Does nothing if
// the verdict on the machine is red.
bool dip_cost_advise(DipCostContext *cost, DipError *err);

// Answers requests for timed frames on standard input until it is closed. The processes that
// dip_cost_time_rows and dip_cost_time_more start (--starts) call this function.
bool dip_cost_serve(DipCostContext *cost, DipError *err);

// --- predicting ----------------------------------------------------------------------------------

// Draws `frames` of the frames that are timed along path 0, spread evenly, and writes the means of
// their counters.
bool dip_cost_count(DipCostContext *cost, const DipQuality *quality, int frames, double *counters,
                    DipError *err);

// Takes a setting out of options.combined if all steps of its sweep draw the same pictures. All
// combinations then have the baseline's step of this setting. If adaptive AA (aaa) is taken out, so
// is its group size (asd).
void dip_cost_drop_idle_settings(DipCostReport *report);

// Lists the combinations of the combined settings in report->predicted, and sets `searched` to
// their number. If there are more than DIP_COST_MAX_ROWS, lists only the baseline, the combinations
// that differ from it in one group of settings, the corners (combinations.h explains both), and a
// sample of the others. Fails with DIP_ERROR_MEMORY.
bool dip_cost_list_predictions(DipCostReport *report, DipError *err);

// Fills in the counters of every combination in report->predicted: means over a few frames. Draws
// every combination if there are at most DIP_COST_MOST_COUNTED. Otherwise draws the corners and
// those that differ from the baseline in at most one group of settings, and composes the counters
// of the others from theirs (combinations.h). Draws those that it cannot compose, too. Shows its
// progress on standard error.
bool dip_cost_count_combinations(DipCostContext *cost, DipError *err);

// If report->predicted has only a sample of the combinations, removes the slow ones from it: those
// that differ from the baseline in several groups of settings and take more than about four times
// the baseline's time. They would tell much about prices, but measuring them would take too long.
void dip_cost_drop_slow_sample(DipCostReport *report);

// Composes the counters of a combination from those of counted combinations in report->predicted.
// Returns false as dip_work_compose (combinations.h) does.
bool dip_cost_compose_counters(const DipCostReport *report, DipCostPrediction *prediction);

// Mends counters of report->predicted, which come from a few frames only, while the counters of
// rows come from all timed frames. A combination with a row has both counters: for each kind of
// work, their ratio over all such combinations tells by how much the few frames are wrong. Scales
// the counters of the combinations without a row by these ratios. Gives each combination with a row
// the counters of its row.
void dip_cost_scale_counters(DipCostReport *report);

// Number of frames of path 0, spread evenly, on which the work of a combination is counted.
enum { DIP_COST_COUNTED_FRAMES = 8 };

// Returns how many combinations are measured to predict `count` combinations of these settings. The
// combinations of the sweeps are part of this number. Bit s of `settings` stands for setting s.
// The number is 16, or 20 if adaptive AA is among the settings; this covers aa, aaa, asd, af and
// aaf. Every other setting adds three for each two steps after its first, rounded up. Returns at
// most `count`.
int dip_cost_training_count(unsigned settings, int count);

// Chooses the combinations to time: those that tell most about the price of each kind of work
// (fit.h), by a D-optimal design. Writes their `count` indices in report->predicted to `chosen`.
// The first of them are the combinations that have a row already or, if there are none, the
// baseline. Fails with DIP_ERROR_MEMORY.
bool dip_cost_choose_timed(const DipCostReport *report, int count, int *chosen, DipError *err);

// Chooses the combinations to measure, which tell most about times and about FLIP. Writes their
// indices as dip_cost_choose_timed does. Of the chosen combinations without a row,
// dip_cost_choose_timed chooses one half, and dip_flip_model_design the other half. Fails with
// DIP_ERROR_MEMORY.
bool dip_cost_choose_training(const DipCostReport *report, int count, int *chosen, DipError *err);

// Indices of the values that are predicted for a combination.
enum {
    DIP_COST_PREDICTED_MS,
    DIP_COST_PREDICTED_P95,
    DIP_COST_PREDICTED_FLIP,
    DIP_COST_PREDICTED // Number of values.
};

// What the combinations that have a row tell about all others.
typedef struct DipCostModels {
    DipCostModel times;
    double p95;        // The usual ratio of the 95th percentile of the frames' times to their mean.
    DipFlipModel flip; // Knows the combinations that have a row (flip.known).
    DipCostProcess of_times; // Models log(measured time / time of the model `times`).
    // [combination of flip.known]: its share (process.h) in the corrections of mean times. Owned.
    double *ms_shares;
    // [combination of flip.known]: its share in the corrections of 95th percentiles. Lies in the
    // array ms_shares.
    double *p95_shares;
} DipCostModels;

// Fits the models to the combinations of report->predicted that have a row. Free the models even
// after a failure. Fails with DIP_ERROR_MEMORY.
bool dip_cost_models_of(const DipCostReport *report, DipCostModels *models, DipError *err);
void dip_cost_models_free(DipCostModels *models);

// Predicts a combination with these counters and these distances to all measured combinations
// (dip_flip_model_distances). The model models->times predicts the time, which is then corrected by
// what this model misses at similar measured combinations.
void dip_cost_predict_one(const DipCostModels *models, const double *counters,
                          const DipQuality *quality, const int *distances,
                          double values[DIP_COST_PREDICTED]);

// Predicts every combination of report->predicted that has no row. Fails with DIP_ERROR_MEMORY.
bool dip_cost_predict_others(DipCostReport *report, const DipCostModels *models, DipError *err);

// What the gain of a combination for one budget is computed from (dip_cost_gain).
typedef struct DipCostAim {
    double budget_ms;
    double loss;       // FLIP of the combination that is advised now; if none is advised, the
                       // greatest measured FLIP.
    double floor;      // The least loss: the FLIP that the noise of the truth makes.
    double time_error; // Standard deviation of the logarithms of times from their predictions.
} DipCostAim;

DipCostAim dip_cost_aim(const DipCostReport *report, int budget);

// Returns by what share measuring a combination probably lowers the FLIP of the advised
// combination: the expected improvement (Jones, Schonlau and Welch 1998) times the probability that
// the combination is within the budget. `ms` is its predicted time, `flip` its predicted FLIP, and
// `error` the standard deviation of the logarithm of this FLIP.
double dip_cost_gain(const DipCostAim *aim, double ms, double flip, double error);

// No combination that gains less than this is measured for a budget.
#define DIP_COST_LEAST_GAIN 0.003

// Predicts all combinations of the combined settings, and adds the best to report->predicted, which
// has room for DIP_COST_MAX_ROWS. The best are, for each budget, the DIP_COST_PER_BUDGET
// combinations that gain most, and the combinations on a Pareto front. This front has at most one
// combination for each 2 % of time, and the FLIP of each is at least 1 % below that of the next
// faster one. The work of combinations is composed from the work of those of report->predicted that
// were counted. Fails with DIP_ERROR_MEMORY.
enum { DIP_COST_PER_BUDGET = 64 };
bool dip_cost_search(DipCostReport *report, DipPool *pool, const DipCostModels *models,
                     DipError *err);

// Lists combinations that should be measured and have no row yet. First lists some that gain most
// for each budget, one after another. Measuring one will make the FLIP of similar combinations less
// uncertain, so each listed combination is added to models->flip.process before the next is chosen.
// If `front` is true, also lists some combinations on the Pareto front of predicted or measured
// time and FLIP (dip_front, choice.h). Writes the indices in report->predicted to `list`. Returns
// their number, or -1 and fills *err.
enum { DIP_COST_MOST_PROMISING = 24 };
int dip_cost_list_promising(const DipCostReport *report, DipCostModels *models, bool front,
                            int list[DIP_COST_MOST_PROMISING], DipError *err);

// Adds a row for each listed combination that has none. `list` holds indices in report->predicted.
// Writes the rows of all listed combinations to `rows`. Fills *err if it returns false.
bool dip_cost_add_rows(DipCostReport *report, const int *list, int count, int *rows, DipError *err);

// Measures the errors, times and work of new rows of path 0, and estimates the times of all rows.
typedef bool DipCostMeasure(void *context, const int *rows, int count, DipError *err);

// Predicts all combinations. Then measures the best ones and predicts the others anew, at most
// dip_cost_most_goes times. If the verdict on the machine is red, only predicts.
bool dip_cost_measure_best(DipCostReport *report, DipPool *pool, DipCostMeasure *measure,
                           void *context, DipError *err);
int dip_cost_most_goes(const DipCostOptions *options);

// --- elsewhere -----------------------------------------------------------------------------------

// Combinations can be timed elsewhere than a report's rows: at another size, on another camera path
// or with another number of threads. `cost` is the context of the report, and `there` is a context
// without truths for the other size, path or number of threads.

// Makes *there a report without rows for this size and the camera path with this name. The number
// of timed frames is that of `report`. A caller that adds predicted combinations to *there also
// frees them.
void dip_cost_elsewhere_begin(DipCostReport *there, const DipCostReport *report, int width,
                              int height, const char *path);

// Times the combinations of `rows` in the context `there`. Each is timed beside the baseline of the
// report's path 0, which is drawn in the context `cost`. Fills in their times and counters.
// `progress` is the text of the progress display, such as "smaller frames timed". Sets *wait to the
// share of the threads' time in these frames for which they waited for a core. Fails with MEMORY,
// with RUNTIME after Ctrl-C, and with the renderer's error if a frame cannot be drawn.
bool dip_cost_time_elsewhere(DipCostContext *cost, DipCostContext *there, DipCostElsewhere *rows,
                             int count, const char *progress, double *wait, DipError *err);

#endif
