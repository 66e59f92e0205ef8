// Predicting the times of a report's combinations at another size, on another camera path, with
// another number of threads or another instruction set ("there").
//
// A combination is a set of quality settings on the camera path. The report's model of times
// (fit.h) knows the price of each kind of work. The work is counted there, and the sum of work
// times price is the prediction "as it is". If some combinations are timed there, prices are fitted
// anew to them and to the report, and predict all others.
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
    int timed;        // Combinations to time there, to predict from; 0: from the report alone.
    int checked;      // Further combinations to time there, to compare the predictions with.
    const char *json; // Files to write, or NULL.
    const char *csv;
} DipCostPredictArguments;

// A combination of the report.
typedef struct DipCostPredictedThere {
    DipQuality quality;
    double report_ms; // In the report: measured, or predicted there.
    double as_is_ms;  // Predicted from the report alone.
    double ms;        // Predicted from the report and from what was timed there.
    int timed;        // Index in `timed`, or -1.
} DipCostPredictedThere;

// All times are milliseconds of the report, whatever the machine's speed is today, because what is
// timed is timed beside the report's baseline.
typedef struct DipCostElsewherePrediction {
    DipCostReport report;
    DipCostReport there;         // Size, path and threads; no rows.
    DipCostMisses fit;           // Each row of the report predicted from all others.
    DipCostPredictedThere *list; // Owned; `count` of them, in the order of the report.
    int count;
    DipCostElsewhere timed[2 * DIP_COST_MOST_TIMED];
    int timed_count;           // The first ones, to which prices are fitted.
    int checked_count;         // The others, to which they are not.
    double factor;             // The usual quotient of the former's times and as_is_ms; 1 without.
    DipCostMisses timed_as_is; // Of those to which prices are fitted: how far as_is_ms misses,
    DipCostMisses timed_left_out; // and each with prices fitted to the others.
    DipCostMisses checked_as_is;
    DipCostMisses checked_fitted;
    double wait; // Share of their time that threads waited for a core while times were taken.
} DipCostElsewherePrediction;

// Reads the report, and counts, predicts and times. Shows progress. Free the prediction even after
// a failure. Fails as dip_cost_read_report and the renderer do; with CONFLICT if the session shows
// another scene than the report; with MISSING if the report has no times or no combinations.
bool dip_cost_predict_there(DipCostElsewherePrediction *prediction, const DipSession *session,
                            const DipCostPredictArguments *arguments, DipError *err);
void dip_cost_predict_there_free(DipCostElsewherePrediction *prediction);

// Predicts all combinations from the report and from what was timed there, and computes all misses.
// Needs the report's rows, the counters of `there`, the list and the timed combinations.
void dip_cost_predict_and_judge_there(DipCostElsewherePrediction *prediction);

void dip_cost_predict_there_print(const DipCostElsewherePrediction *prediction, FILE *out);
extern const DipRecord dip_cost_prediction_record; // DipCostElsewherePrediction
bool dip_cost_predict_there_write_json(const DipCostElsewherePrediction *prediction,
                                       const char *file, DipError *err);
bool dip_cost_predict_there_write_csv(const DipCostElsewherePrediction *prediction,
                                      const char *file, DipError *err);

#endif
