// Models the mean time of a frame of a combination of settings as a sum of terms. A term is an
// amount times a price, and the prices are fitted to measured rows. (A row is one combination of
// settings on a camera path, report.h.) The model explains how time follows from work, and predicts
// combinations that were not measured.
#ifndef DIP_APP_REPORT_FIT_H
#define DIP_APP_REPORT_FIT_H

#include "app/report/report.h"

// --- terms ---------------------------------------------------------------------------------------

// Each stage of a frame (DipCostStage) has its own terms. A term is one kind of work. Its amount
// comes from the exact counters of a frame and from the settings. No counter tells which reads miss
// the processor's caches. Reads that miss them more often than others therefore have terms of their
// own: reads of uncompressed textures, probes of advanced AF, and texels times the distance of
// neighbouring pixels on a surface, in texels of the level that they read. (The farther apart the
// pixels lie, the fewer texels they share. A small render scale sets them apart, and so does a bias
// towards larger levels: miplod=sharp and sharper, or taa=history.)
enum { DIP_COST_MAX_TERMS = 64 }; // Greatest number of terms of one stage.

int dip_cost_term_count(int stage);

// Returns the name of a term: "texel fetched". Static storage.
const char *dip_cost_term_name(int stage, int term);

// Computes the amounts of a stage's terms. The amount of the first term is 1, except in the
// geometry stage of frames that pose vertices, where it is 0 (terms.c says why). `counters` are
// those of a frame that was drawn with these settings, or their means over several frames.
void dip_cost_terms(int stage, const double counters[DIP_COUNTER_COUNT], const DipQuality *quality,
                    double amounts[DIP_COST_MAX_TERMS]);

// Returns the sum of amounts times prices of all terms of the stages `first` to `end` - 1.
// `prices` is indexed [stage][term].
double dip_cost_sum_terms(int first, int end, const double (*prices)[DIP_COST_MAX_TERMS],
                          const double counters[DIP_COUNTER_COUNT], const DipQuality *quality);

// --- models --------------------------------------------------------------------------------------

typedef struct DipCostModel {
    double prices[DIP_COST_STAGE_COUNT][DIP_COST_MAX_TERMS]; // In milliseconds; never negative.
    int rows; // Number of rows that the prices come from; 0 if there are none.
} DipCostModel;

// Fits prices to the rows whose times of the stages are known. Minimises the sum of squared
// deviations, each relative to the row's time, so that slow rows have no more weight than fast
// ones. Prices are also fitted to the combinations at half the size (report->smaller). Here and
// below, `rows` may be NULL, which means the rows 0 to count - 1.
DipCostModel dip_cost_model_fit(const DipCostReport *report, const int *rows, int count);

// Fits prices that are meant for another size, another camera path or another number of threads
// than the report's. `there` holds a few combinations that were timed under these other conditions.
// Together they count 30 times as much as all rows of the report and its combinations at half the
// size, which decide only what `there` leaves open. If same_place is true, size, camera path,
// threads and instruction set are those of the report, and each of `there` counts like a row: it is
// no better than one.
DipCostModel dip_cost_model_fit_there(const DipCostReport *report, const int *rows, int count,
                                      const DipCostElsewhere *there, int there_count,
                                      bool same_place);

// Returns the mean time of a frame with these counters and settings, in milliseconds.
double dip_cost_model_value(const DipCostModel *model, const double counters[DIP_COUNTER_COUNT],
                            const DipQuality *quality);

// Summarises misses; a miss is |predicted / measured - 1|. Sorts the array `misses`.
DipCostMisses dip_cost_misses_of(double *misses, int count);

// Predicts the time of each of the rows from all others (leave one out), and summarises the misses.
DipCostMisses dip_cost_model_leave_one_out(const DipCostReport *report, const int *rows, int count);

// --- the fit of a whole report -------------------------------------------------------------------

// DipCostFit is the model of the times of all rows of a report, as the report shows it.
enum { DIP_COST_FIT_MAX_TERMS = (int)DIP_COST_STAGE_COUNT * (int)DIP_COST_MAX_TERMS };

typedef struct DipCostFit {
    const char *stages[DIP_COST_FIT_MAX_TERMS]; // The stage of each term.
    const char *names[DIP_COST_FIT_MAX_TERMS];  // The kind of work; the first of each stage is
                                                // "frame", the constant term.
    double ns[DIP_COST_FIT_MAX_TERMS];          // Nanoseconds per unit of work; never negative.
    int count;                                  // Number of terms.
    double r2;            // Share of the relative variance of the times that the fit explains.
    double median_miss;   // Median of |fitted / measured - 1|.
    DipCostMisses others; // Misses of the rows, each predicted from all others.
    int rows;             // Number of rows fitted; 0 if there are too few.
} DipCostFit;

DipCostFit dip_cost_fit(const DipCostReport *report);

// Lists the rows to which a report's model of times can be fitted. Returns their number; 0 if there
// are too few for a model.
int dip_cost_fit_rows(const DipCostReport *report, int rows[DIP_COST_MAX_ROWS]);

#endif
