// Declares a cost report: its measurements, and the values that are computed from them. A row of
// the report is one combination of quality settings, measured on one camera path. Its errors are
// measured against truths (converged pictures, app/measure/metrics/truth.h) at a few viewpoints of
// the path. Its times are measured along the path, each beside a time of the path's baseline
// (app/measure/timing/driver.h, which also explains rounds and starts).
#ifndef DIP_APP_REPORT_REPORT_H
#define DIP_APP_REPORT_REPORT_H

#include "app/report/report_plan.h"
#include "app/measure/metrics/flip_tail.h"
#include "app/measure/metrics/metrics.h"
#include "app/measure/stats/rounds.h"
#include "app/measure/timing/driver.h"
#include "app/measure/timing/sample.h"
#include "app/report/choice.h"
#include "app/report/words.h"
#include "renderer/scene/frame.h"
#include "renderer/scene/quality.h"

#include <stdbool.h>

// Parts of a frame's time: the stages of the pipeline, in the order of DIP_STAGE_LIST, and the rest
// (such as the choice of effects, the start of the passes and the filters of the finished picture).
typedef enum DipCostStage {
#define DIP_COST_STAGE(name, text) DIP_COST_STAGE_##name,
    DIP_STAGE_LIST(DIP_COST_STAGE)
#undef DIP_COST_STAGE
        DIP_COST_STAGE_rest,
    DIP_COST_STAGE_COUNT
} DipCostStage;

extern const char *const dip_cost_stage_names[DIP_COST_STAGE_COUNT];

enum {
    DIP_COST_MAX_PATHS = 16,
    DIP_COST_PATH_NAME = 16, // Bytes of a path's name.
    DIP_COST_MAX_SWEEPS = 24,
    DIP_COST_MAX_SWEEP_ROWS = 8,
    DIP_COST_MAX_REFUSED = 24,
    DIP_COST_MAX_WARNINGS = 256,
    DIP_COST_MOST_LEFT_OUT = 1000000000, // Warnings that a file may say it leaves out.
    DIP_COST_MAX_ROWS = 4096,
    DIP_COST_MAX_SMALLER = 4,
    // If more combinations than this are predicted, the work of some is not counted, but composed
    // from the work of others (combinations.h).
    DIP_COST_MOST_COUNTED = 256,
    DIP_COST_TEXT = DIP_SETTINGS_BYTES, // A text may be that of settings.
    DIP_COST_REASON = 512
};

// A row's times along its path. All intervals are widened by DipCostReport.doubt.
typedef struct DipPathEstimate {
    DipEstimate ratio;    // The row's time for all frames, divided by its baseline's time.
    DipEstimate mean_ms;  // Mean over the frames.
    DipEstimate p95_ms;   // 95th percentile over the frames.
    DipEstimate worst_ms; // The slowest frame.
    // Standard errors of the logarithms of ratio, p95_ms and worst_ms. They leave out level_error,
    // which all rows of a path share.
    double ratio_error;
    double p95_error;
    double worst_error;
    double level_error; // Standard error of the logarithm of the baseline's mean time along the
                        // path; NAN if it is not known.
    int used;           // Number of the row's timed frames that no other program disturbed.
} DipPathEstimate;

// One measured combination: quality settings on a camera path.
typedef struct DipCostRow {
    DipQuality quality;
    int path;                  // Index of the camera path in the report.
    DipMetricSums *viewpoints; // Errors per viewpoint of the path. Owned.
    DipFlipTail *tails;        // [viewpoint]: distribution of FLIP; all 0 if not known. Owned.
    bool *judged;              // [viewpoint]: true if the row's errors there are known. Owned.
    char (*pictures)[33]; // [viewpoint]: hash of the row's pictures, their truths and the pixels
                          // per degree; "" if not known. Owned.
    double counters[DIP_COUNTER_COUNT];    // Means over the timed frames.
    DipPathEstimate time;                  // Computed from the log.
    double stage_ms[DIP_COST_STAGE_COUNT]; // Parts of time.mean_ms; they add up to it.
} DipCostRow;

// A combination that has no row of its own, because another row draws the same pictures
// (dip_cost_join_same_pictures).
typedef struct DipCostSame {
    DipQuality quality;
    int row; // The row that stands for it.
} DipCostSame;

// A sweep: the steps of one setting on one path, with every other setting held constant. A sweep of
// adaptive AA (aaa) also has steps that differ in the group size (asd).
typedef struct DipCostSweep {
    DipSetting setting;
    int path;
    int base; // Index of the row with which all steps are compared. It has the baseline's step, or
              // aaa=off in a sweep of adaptive AA.
    int rows[DIP_COST_MAX_SWEEP_ROWS];
    DipEstimate ratios[DIP_COST_MAX_SWEEP_ROWS]; // Each row's time divided by the base row's.
    int row_count;
} DipCostSweep;

// Holds what is chosen from the measurements (app/report/choice.h). All times are of the kind that
// budgets limit (options.budget_of).
typedef struct DipCostChoice {
    DipCandidates
        candidates; // Combinations with a time and an error; `row` is an index in `rows`. Owned.
    // Indices of the candidates on the Pareto front of time and error, in order of time. Each one
    // is clearly better than the one before (DIP_CLEARLY_BETTER). Owned.
    int *front;
    int front_count;
    int knee;                               // Index of the knee in `front`; -1 if there is none.
    DipAdvice advice[DIP_COST_MAX_BUDGETS]; // One for each of options.budgets_ms.
    int advice_count;                       // Number of budgets, or 0 without candidates.
} DipCostChoice;

// A combination that was timed under other conditions than the rows: at another size, on another
// camera path or with another number of threads. Each of its frames was timed beside a frame of
// path 0's baseline. Its time is the ratio to the baseline, times the baseline's time in this
// report, so it can be compared with the rows' times.
typedef struct DipCostElsewhere {
    DipQuality quality;
    double counters[DIP_COUNTER_COUNT];    // Means over the timed frames.
    DipEstimate ms;                        // Mean time of a frame.
    double stage_ms[DIP_COST_STAGE_COUNT]; // Parts of ms.value; they add up to it.
} DipCostElsewhere;

// How far predictions lie from measurements: |predicted / measured - 1| over some rows.
typedef struct DipCostMisses {
    double median;
    double p90;       // 90th percentile.
    double within_10; // Share of the rows that are missed by at most 10 %.
    double within_5;  // Share of the rows that are missed by at most 5 %.
    int rows;         // Number of rows; 0 if there are none to compare.
} DipCostMisses;

// A combination that --predict lists, on path 0 (app/cost/predict.c). Its time and error are
// predicted, unless the combination is measured to predict the others (`trained` below).
typedef struct DipCostPrediction {
    DipQuality quality;
    double counters[DIP_COUNTER_COUNT]; // Means per frame.
    // These three are measured values if the combination was measured to predict the others. All
    // other combinations keep their predicted values, even when they are measured later.
    double ms;     // Mean time of a frame.
    double p95_ms; // 95th percentile of the frames along the path.
    double flip;   // Mean FLIP of the viewpoints.
    int row;       // The row with the combination's measurements; -1 if it was not measured.
} DipCostPrediction;

// The combinations that --predict lists, and how far the predictions lie from measurements. If
// there are more than DIP_COST_MAX_ROWS, the list has only a sample of them, and those that looked
// best.
typedef struct DipCostPredictions {
    DipCostPrediction *list; // Owned; NULL if nothing was predicted.
    int count;
    int searched; // Number of all combinations that were predicted.
    int trained;  // Number of rows that were measured to predict all others.
    // Misses of the mean times and of the FLIP of these rows, each predicted from the others.
    DipCostMisses times_left_out;
    DipCostMisses errors_left_out;
    // Misses of the mean times and of the FLIP of rows that were measured after their prediction.
    DipCostMisses times;
    DipCostMisses errors;
} DipCostPredictions;

// How quiet the machine was while times were taken.
typedef enum DipCostVerdict {
    DIP_COST_GREEN, // The intervals of the times can be trusted.
    DIP_COST_AMBER, // The intervals may be too narrow.
    DIP_COST_RED    // The times are wrong: no advice is given.
} DipCostVerdict;

extern const char *const dip_cost_verdict_names[]; // "green", "amber", "red"

typedef struct DipCostReport {
    char scene[DIP_COST_TEXT];
    char scene_hash[33];
    char processor[DIP_COST_TEXT];
    char isa[16];
    char version[32];
    char build[33];      // Hash of the program's file.
    bool several_builds; // Parts of a merged report come from programs with other hashes.
    char date[24];       // When the measurement ended: ISO 8601, UTC; "" if unknown.
    int threads;
    int width;  // Pixels.
    int height; // Pixels.
    DipCostOptions options;
    char paths[DIP_COST_MAX_PATHS][DIP_COST_PATH_NAME]; // Names: "DEFAULT", "AA", "FOLIAGE", ...
    // Hashes of the poses at the viewpoints of each path, since a path may be edited and keep its
    // name.
    char path_hashes[DIP_COST_MAX_PATHS][33];
    int path_count;
    DipCostRow *rows; // Owned.
    int row_count;
    // Each path has two rows with the baseline's settings. One is the base row, beside which all
    // other rows of the path are timed. The other is the A/A row (same_rows), which is timed as if
    // it were another setting; its ratio shows how noisy the machine is.
    int base_rows[DIP_COST_MAX_PATHS];
    int same_rows[DIP_COST_MAX_PATHS];
    // Rows from this index on are the combinations, on path 0. The first of them is the base row of
    // path 0; in reports of older programs the baseline was timed once more as a combination.
    int combined_first;
    DipCostSame *same; // Combinations without a row of their own. Owned.
    int same_count;
    DipCostSweep sweeps[DIP_COST_MAX_SWEEPS];
    int sweep_count;
    char refused[DIP_COST_MAX_REFUSED][DIP_COST_REASON]; // Steps left out of sweeps, with reasons.
    int refused_count;
    // The warnings that loading the scene gave, in the order of loading. Their file names are
    // without folders, so that reports of several machines have the same ones. Owned.
    DipError *warnings;
    int warning_count;
    int warnings_left_out;    // Number of further warnings, which `warnings` leaves out.
    int rounds;               // Number of rounds timed; 0 if the report has no times.
    DipDriverMachine machine; // What the timing tells about the machine.
    DipTimed *log; // Every timed frame. A frame's `subject` is the index of its row. Owned; NULL
                   // without times.
    int log_count;
    int starts; // Number of processes that took the times. Each one timed every row, in equally
                // many rounds.
    DipTimesFit *fit;       // Computed from the log. Owned; NULL without times.
    double doubt;           // Standard error that an amber verdict adds to each time's logarithm;
                            // 0 if the verdict is not amber.
    DipCostVerdict verdict; // Valid if the report has times.
    char verdict_reason[DIP_COST_REASON];
    // Noise floors of the truths: the errors of a truth's first half against its second half
    // (truth.h), [path * options.places + viewpoint]. Both arrays are owned.
    DipMetricSums *floors;
    bool *has_floor;              // True if the floor with this index is known.
    DipCostChoice choice;         // Empty without times.
    DipCostPredictions predicted; // Empty without --predict.
    // A few combinations on path 0, drawn at about half the width and height. They show which work
    // grows with the picture and which does not. The model of times (fit.h) needs to know this to
    // predict the times of other sizes.
    DipCostElsewhere smaller[DIP_COST_MAX_SMALLER];
    int smaller_count; // 0 if no such combinations were timed.
    int smaller_width; // Pixels.
    int smaller_height;
    struct DipCostAnalysis *analysis; // Owned; NULL until dip_cost_analyse (analysis.h).
} DipCostReport;

// Fills *err with DIP_ERROR_MEMORY and returns false.
static inline bool dip_cost_out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost", "out of memory");
}

// Allocates the arrays of the report and of its rows. The rows, paths and options must be filled in
// before.
bool dip_cost_report_alloc(DipCostReport *report, DipError *err);

// Adds a row to a report whose arrays have been allocated. Returns its index, or -1 and fills *err
// if there is no room or no memory. `rows` must have room for DIP_COST_MAX_ROWS rows.
int dip_cost_report_add_row(DipCostReport *report, const DipQuality *quality, int path,
                            DipError *err);
void dip_cost_report_free(DipCostReport *report);

// Adds warnings to the report, without the folders of their files. Skips those that the report had
// before the call, and counts those beyond DIP_COST_MAX_WARNINGS as left out. Fails with
// DIP_ERROR_MEMORY.
bool dip_cost_report_add_warnings(DipCostReport *report, const DipError *warnings, int count,
                                  DipError *err);

// Returns the first row from `first` on with these settings on a path, or -1 if there is none.
int dip_report_find(const DipCostReport *report, const DipQuality *quality, int path, int first);

// Returns the first row from `first` on with these settings on path 0. If there is none, returns
// the row that stands for them because it draws the same pictures (report->same), or -1.
int dip_report_find_same(const DipCostReport *report, const DipQuality *quality, int first);

// Returns whether several successive frames were judged at each viewpoint (--burst). One frame does
// not tell how errors change over time.
static inline bool dip_cost_has_flicker(const DipCostReport *report) {
    return report->options.burst > 1;
}

// Returns the number of all combinations that were predicted; 0 if none were.
static inline int dip_cost_searched(const DipCostReport *report) {
    const DipCostPredictions *predicted = &report->predicted;
    return predicted->searched > predicted->count ? predicted->searched : predicted->count;
}

// Returns the index of the prediction of these settings, or -1 if there is none.
int dip_report_find_predicted(const DipCostPredictions *predicted, const DipQuality *quality);

// Writes sentences that say by how much the milliseconds of another run may all be higher or lower
// than the report's, that ratios do not share this, and whether intervals were widened.
void dip_cost_level_text(const DipCostReport *report, char text[DIP_COST_REASON]);

void dip_cost_row_free(DipCostRow *row);

// --- texts ---------------------------------------------------------------------------------------

// Writes the settings that differ from the defaults, "aa=4,af=16", or "defaults".
static inline void dip_cost_settings_text(const DipQuality *quality, char text[DIP_COST_TEXT]) {
    dip_quality_format_changes(quality, text, DIP_COST_TEXT);
}

// Returns the plural ending of a noun after a number: "" or "s".
static inline const char *dip_cost_plural(int count) {
    return count == 1 ? "" : "s";
}

// Writes the sweep's setting, and the other settings that are off their defaults in its base row:
// "Adaptive AA with aa=4".
void dip_cost_sweep_title(const DipCostReport *report, const DipCostSweep *sweep,
                          char text[DIP_COST_TEXT]);

// Writes the name of a row's step in its sweep: "4", "high-quality"; for adaptive AA "off" or
// "on, asd=2".
void dip_cost_step_text(const DipCostReport *report, const DipCostSweep *sweep, int row,
                        char text[DIP_COST_TEXT]);

// --- errors --------------------------------------------------------------------------------------

// Returns the sum of a row's errors over all judged viewpoints (those whose errors are known). Sets
// *viewpoints to the number of these viewpoints.
DipMetricSums dip_cost_row_sums(const DipCostReport *report, int row, int *viewpoints);

// Returns whether a row's errors are known at any viewpoint.
bool dip_cost_is_judged(const DipCostReport *report, int row);

// Returns the metrics of a row's whole pictures, over all judged viewpoints.
DipMetrics dip_cost_row_metrics(const DipCostReport *report, int row);

// Metrics of the whole picture.
typedef enum DipCostMetric {
    DIP_COST_RMSE,
    DIP_COST_PSNR,
    DIP_COST_SSIM,
    DIP_COST_FLIP,
    DIP_COST_FLICKER,
    DIP_COST_METRIC_COUNT
} DipCostMetric;

// Returns a row's metric over all judged viewpoints. Its 95 % interval is for the metric over all
// possible viewpoints of the path. For FLIP and SSIM, it is a Student's t interval of the values at
// the viewpoints. The other metrics come from a mean of squares, which is positive and skewed, so
// they use a Student's t interval of its logarithm. The standard error of this logarithm is the
// standard error of the mean, divided by the mean. With a single viewpoint, or if all viewpoints
// have exactly the same value, there is no interval, and low and high are NAN.
DipEstimate dip_cost_metric(const DipCostReport *report, int row, DipCostMetric metric);

// Returns by how much a row's metric exceeds the metric of `base`, another row of the same path:
// the mean of the differences at the viewpoints, with a Student's t interval. This interval is far
// narrower than the interval of either row's metric, since viewpoints differ more than settings do.
// Only viewpoints that were judged for both rows count.
DipEstimate dip_cost_metric_change(const DipCostReport *report, int row, int base,
                                   DipCostMetric metric);

// The distribution of a row's FLIP over pixels.
typedef struct DipCostTail {
    // The percentiles are means over the viewpoints. The worst block is the worst of all
    // viewpoints.
    DipFlipTail flip;
    int worst_viewpoint; // The viewpoint of the worst block.
    int viewpoints; // Number of viewpoints whose distribution is known; if 0, the other members
                    // are not valid.
} DipCostTail;

DipCostTail dip_cost_row_tail(const DipCostReport *report, int row);

// Returns the sum of the noise floors of a path's truths.
DipMetricSums dip_cost_floor(const DipCostReport *report, int path);

// Returns an estimate of the FLIP that the noise of a path's truths alone makes. It is the FLIP of
// the truths' two halves against each other, times 0.5^0.7, since the truth's error is half of
// their difference and FLIP grows with the 0.7th power of differences. Rows whose FLIP is below the
// estimate are equally good as far as these truths can tell.
double dip_cost_floor_flip(const DipCostReport *report, int path);

// Returns estimates of the errors of a path's truths themselves. A truth is the mean of two halves,
// whose noise is independent, so the mean square of its noise is a quarter of the mean square of
// the difference of the halves. The estimates are therefore the RMSE of the first half against the
// second, halved; its PSNR plus 6.02 dB; and a quarter of its 1 - SSIM, since 1 - SSIM is
// proportional to the noise's variance as long as it is small. FLIP is dip_cost_floor_flip.
DipMetrics dip_cost_floor_metrics(const DipCostReport *report, int path);

// Returns a row's FLIP for ranking: its measured FLIP or, if this is greater, dip_cost_floor_flip.
double dip_cost_ranking_flip(const DipCostReport *report, int row);

// Returns whether a row's error is too small to be told from the truth's own noise.
bool dip_cost_at_floor(const DipCostReport *report, int row);

// Returns whether two rows of one path are known to have the same pictures (by hash) at every
// viewpoint. False if a viewpoint of either row has not been judged.
bool dip_cost_same_pictures(const DipCostReport *report, int a, int b);

// Returns the row that stands for a row. Of all combinations (from combined_first on) with the same
// pictures, it is the base row, which all others are timed beside, or else the one with the fewest
// settings off their defaults. If several have equally few, it is the first of them.
int dip_cost_simplest_row(const DipCostReport *report, int row);

// Makes combinations with the same pictures one row. (Where a setting changes nothing in a scene,
// for example adaptive AA without alpha-clipped surfaces, several combinations draw the same
// pictures.) The combination with the fewest settings off their defaults stays, and the others are
// listed in report->same. Call it once every viewpoint has been judged. If the report has times,
// estimate them again afterwards. Fails with DIP_ERROR_MEMORY.
bool dip_cost_join_same_pictures(DipCostReport *report, DipError *err);

// --- times ---------------------------------------------------------------------------------------

// Returns whether the report is of one picture instead of camera paths, as the preview measures it:
// every round of its log draws the same frame.
static inline bool dip_cost_is_view(const DipCostReport *report) {
    return report->rounds > 0 && report->options.timed_frames == 0;
}

// Returns the number of frames that are timed along a path.
static inline int dip_cost_frame_count(const DipCostReport *report) {
    return dip_cost_is_view(report) ? 1 : report->options.rounds * report->options.timed_frames;
}

// Returns the time budgets as limits for the times of the report. Rounding must not carry a time
// over a budget. If the machine was too busy, the times are doubtful (words.h).
static inline DipLimits dip_cost_budgets(const DipCostReport *report) {
    const DipLimits limits = {report->options.budgets_ms, report->options.budget_count,
                              report->verdict == DIP_COST_RED};
    return limits;
}

// Adds timed frames to the report's log, which must have as many rounds and starts as `times`.
// rows[s] is the report's row for subject s of `times`. Fails with DIP_ERROR_MEMORY.
bool dip_cost_log_add(DipCostReport *report, const DipTimes *times, const int *rows, DipError *err);
void dip_cost_log_clear(DipCostReport *report);

// Computes the time of every row from the log, the ratios of all sweeps, the verdict and the
// choice. Fails with DIP_ERROR_MEMORY.
bool dip_cost_estimate_times(DipCostReport *report, DipError *err);

// Returns whether the report has a time of a row.
static inline bool dip_cost_is_timed(const DipCostReport *report, int row) {
    return report->rounds > 0 && row < report->row_count;
}

// Returns the mean time of a row over the frames along the path, in milliseconds per frame.
static inline double dip_cost_ms(const DipCostReport *report, int row) {
    return report->rows[row].time.mean_ms.value;
}

// Computes row->ms and row->stage_ms of a combination that was timed elsewhere (DipCostElsewhere).
// `fit` holds its times as those of `subject`, whose base is the baseline of path 0. Call
// dip_cost_estimate_times before.
void dip_cost_estimate_elsewhere(const DipCostReport *report, const DipTimesFit *fit, int subject,
                                 DipCostElsewhere *row);

// Returns the ratio of the times of two rows of one path. A row's ratio to itself has no interval.
DipEstimate dip_cost_ratio(const DipCostReport *report, int row, int base);

// --- choosing ------------------------------------------------------------------------------------

// Returns a measured row as a candidate, with its time of this kind. The candidate's `row` is the
// index of the row in the report.
DipCandidate dip_candidate_of_row(const DipCostReport *report, int row, DipTimeKind kind);

// Lists report->predicted as candidates, whose `row` is the index of the prediction. If `measured`
// is true, combinations that have a row have its time and error. Otherwise all combinations have
// the time and error of their predictions. A prediction has no time of its slowest frame, so its
// 95th percentile stands for it. The caller frees the list even after a failure. Fails with
// DIP_ERROR_MEMORY.
bool dip_candidates_of_predictions(const DipCostReport *report, DipTimeKind kind, bool measured,
                                   DipCandidates *candidates, DipError *err);

// Lists the predictions that a page shows, in order of predicted time. If there are more than
// DIP_CANDIDATES_LISTED, lists at most this many of the predictions whose combinations were
// measured or lie on the Pareto front of predicted times and errors. A candidate's `row` is the
// index of the prediction. The caller frees the list even after a failure. Returns false when
// memory runs out.
enum { DIP_CANDIDATES_LISTED = 500 };
bool dip_candidates_to_list(const DipCostReport *report, DipCandidates *listed);
void dip_candidates_free(DipCandidates *candidates);

// Computes report->choice from the times and errors. dip_cost_estimate_times calls it; call it
// again after errors, budgets or rows have changed. Fails with DIP_ERROR_MEMORY.
bool dip_cost_choose(DipCostReport *report, DipError *err);
void dip_cost_choice_free(DipCostChoice *choice);

// Returns the candidate that is advised for the budget with this index, or NULL if there is none.
const DipCandidate *dip_cost_chosen(const DipCostReport *report, int budget);

#endif
