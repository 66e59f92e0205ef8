// The model of times: each stage of a frame takes the sum of its terms (terms.h), amounts of work
// times prices. The prices come from measured rows. (A row is one combination of settings on a
// camera path, report.h.) The model explains how time follows from work, and predicts the times of
// combinations that were not measured.
#ifndef DIP_APP_REPORT_FIT_H
#define DIP_APP_REPORT_FIT_H

#include "app/report/report.h"
#include "app/report/terms.h"

typedef struct DipCostModel {
    double price_ms[DIP_COST_STAGE_COUNT][DIP_COST_MAX_TERMS]; // Per unit of work; never negative.
    int rows; // Number of rows that the prices come from; 0 if there are none.
} DipCostModel;

// Fits prices to rows whose times and stages are known, and to the combinations that the report has
// timed at half its size. Chooses for each stage the prices >= 0 with the least sum of squared
// deviations. Each deviation is relative to the row's whole time, so that slow rows have no more
// weight than fast ones.
DipCostModel dip_cost_model_fit(const DipCostReport *report, const int *rows, int count);

// Fits prices as dip_cost_model_fit does, and also to combinations that were timed at another size,
// on another camera path or with other threads ("there"). The prices are to hold there: all these
// combinations together count 30 times as much as all rows of the report. The rows decide only what
// the combinations leave open.
DipCostModel dip_cost_model_fit_there(const DipCostReport *report, const int *rows, int count,
                                      const DipCostElsewhere *there, int there_count);

// Returns the mean time of a frame with these counters and settings, in milliseconds.
double dip_cost_model_ms(const DipCostModel *model, const double counters[DIP_COST_COUNTER_COUNT],
                         const DipQuality *quality);

// A miss is |predicted / measured - 1|. Summarises misses, and sorts them.
DipCostMisses dip_cost_misses_of(double *misses, int count);

// Returns the misses of a model at rows to which it was not fitted.
DipCostMisses dip_cost_model_misses(const DipCostReport *report, const DipCostModel *model,
                                    const int *rows, int count);

// Predicts each of the rows from all others (leave one out), and returns the misses.
DipCostMisses dip_cost_model_leave_one_out(const DipCostReport *report, const int *rows, int count);

// --- errors --------------------------------------------------------------------------------------

// The model of FLIP: a sum of terms of the settings alone (dip_cost_error_terms), since the error
// of antialiasing and that of filtering nearly add up.
typedef struct DipCostErrorModel {
    double coefficients[DIP_COST_ERROR_TERMS];
    int rows; // Number of rows that the model comes from; 0 if there are none.
} DipCostErrorModel;

// Fits the model to rows whose FLIP is known, by least squares of relative deviations.
DipCostErrorModel dip_cost_error_model_fit(const DipCostReport *report, const int *rows, int count);

double dip_cost_error_model_flip(const DipCostErrorModel *model, const DipQuality *quality);

// These two do for FLIP what the functions of the model of times above do for times.
DipCostMisses dip_cost_error_model_misses(const DipCostReport *report,
                                          const DipCostErrorModel *model, const int *rows,
                                          int count);
DipCostMisses dip_cost_error_model_leave_one_out(const DipCostReport *report, const int *rows,
                                                 int count);

// --- the fit of a whole report -------------------------------------------------------------------

// The model of all rows of a report, in the form in which the report shows it.
enum { DIP_COST_FIT_MAX_TERMS = DIP_COST_ALL_TERMS };

typedef struct DipCostFit {
    const char *stages[DIP_COST_FIT_MAX_TERMS]; // The stage of each term.
    const char *names[DIP_COST_FIT_MAX_TERMS];  // The kind of work; the first of each stage is
                                                // "frame", the constant term.
    double ns[DIP_COST_FIT_MAX_TERMS];          // Time per unit of each term; never negative.
    int count;                                  // Number of terms.
    double r2;            // Share of the relative variance of the times that the fit explains.
    double median_miss;   // Median of |fitted / measured - 1|.
    DipCostMisses others; // Each row predicted from all others.
    int rows;             // Number of rows fitted; 0 if there are too few.
} DipCostFit;

DipCostFit dip_cost_fit(const DipCostReport *report);

#endif
