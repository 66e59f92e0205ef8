// Predicts the times of a report's combinations at another place, called "there": at another size,
// on another camera path, with another number of threads or another instruction set.
//
// The combinations are those of --combine or --predict: sets of quality settings that the report
// timed or predicted on its first camera path. The report's model of times (fit.h) knows the price
// of each kind of work: the milliseconds that a unit of this work takes. The work of each
// combination is counted there. The sum of work times price is the prediction from the report alone
// (as_is_ms). If some combinations are timed there, prices are fitted anew to them and to the
// report, and all combinations are predicted with these prices.
#ifndef DIP_APP_COST_PREDICT_PREDICT_ELSEWHERE_H
#define DIP_APP_COST_PREDICT_PREDICT_ELSEWHERE_H

#include "app/cost/steps.h"
#include "app/report/format/fields.h"
#include "app/report/fit.h"
#include "app/cost/options.h"

#include <stdio.h>

enum { DIP_COST_MOST_TIMED = 200 };

// The whole command line. Texts are borrowed from argv.
typedef struct DipCostPredictArguments {
    DipProgramOptions program;
    DipSessionOptions session;
    const char *report; // A cost.json, or a folder that has one.
    int report_count;
    int timed;        // Number of combinations to time there, from which all others are predicted.
                      // If it is 0, the predictions come from the report alone.
    int checked;      // Number of further combinations to time there, to check the predictions.
    const char *json; // JSON file to write, or NULL.
    const char *csv;  // CSV file to write, or NULL.
} DipCostPredictArguments;

// A combination of the report.
typedef struct DipCostPredictedThere {
    DipQuality quality;
    double report_ms; // Mean time of a frame in the report, which measured or predicted it.
    double as_is_ms;  // Mean time there, predicted from the report alone.
    double ms;        // Mean time there, predicted from the report and from what was timed there,
                      // or as_is_ms (DipCostElsewherePrediction.from_report).
    int timed;        // Index in the prediction's `timed`; -1 if it was not timed there.
} DipCostPredictedThere;

// All times are on the scale of the report's times. Each combination is timed there, in turn with
// the baseline, which is drawn with the report's own size, path, threads and instruction set. The
// machine's speed today therefore does not matter.
typedef struct DipCostElsewherePrediction {
    DipCostReport report;
    DipCostReport there;         // Has the size, path, threads and instruction set there, and no
                                 // rows. there.predicted has the counted work.
    DipCostMisses fit;           // Misses of the report's rows, each predicted from the other rows.
    DipCostPredictedThere *list; // [count]: the combinations, in the order of the report. Owned.
    int count;
    DipCostElsewhere timed[2 * DIP_COST_MOST_TIMED];
    int timed_count;   // Prices are fitted to the first timed_count combinations of `timed`.
    int checked_count; // The next checked_count combinations of `timed` are only compared with
                       // their predictions.
    // Median of time / as_is_ms of the combinations to which prices are fitted; 1 if there are
    // none.
    double factor;
    DipCostMisses timed_as_is; // How far as_is_ms misses the times to which prices are fitted.
    // Misses of the times to which prices are fitted. Each time is predicted with prices that are
    // fitted to the report and to all others of these times.
    DipCostMisses timed_left_out;
    // True if all `ms` are as_is_ms: nothing was timed there, or timed_left_out has a greater
    // median than timed_as_is, so that the times, each with an error of its own, mislead.
    bool from_report;
    DipCostMisses checked_as_is;  // How far as_is_ms misses the times of checked combinations.
    DipCostMisses checked_fitted; // How far ms misses the times of checked combinations.
    double wait; // Waiting time of the threads in the timed frames / (time of these frames * number
                 // of threads).
} DipCostElsewherePrediction;

// Reads the report, counts the work of its combinations there, times a few there and predicts all.
// Shows its progress on standard error. Free the prediction even after a failure. Fails as
// dip_cost_read_report and the renderer do. Also fails with CONFLICT if the session's scene is not
// the report's, or if the session's camera path with the name of the report's path 0 has other
// poses, with MISSING if the report has no times or no combinations, with UNSUPPORTED if this
// machine lacks the report's instruction set, with RUNTIME after Ctrl-C, and with MEMORY.
bool dip_cost_predict_there(DipCostElsewherePrediction *prediction, const DipSession *session,
                            const DipCostPredictArguments *arguments, DipError *err);
void dip_cost_predict_there_free(DipCostElsewherePrediction *prediction);

// Predicts all combinations from the report and from what was timed there. Computes `factor` and
// all misses except `fit`. Needs the report's rows, the counters in there.predicted, `list`,
// `timed` and their counts.
void dip_cost_predict_and_judge_there(DipCostElsewherePrediction *prediction);

// Prints the prediction for a terminal.
void dip_cost_predict_there_print(const DipCostElsewherePrediction *prediction, FILE *out);

// Writes the prediction to a file. Fails with DIP_ERROR_MEMORY, or DIP_ERROR_IO if the file cannot
// be written.
extern const DipRecord dip_cost_prediction_record; // The fields of DipCostElsewherePrediction.
bool dip_cost_predict_there_write_json(const DipCostElsewherePrediction *prediction,
                                       const char *file, DipError *err);
bool dip_cost_predict_there_write_csv(const DipCostElsewherePrediction *prediction,
                                      const char *file, DipError *err);

#endif
