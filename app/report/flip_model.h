// Predicts the FLIP of combinations of settings from the FLIP of measured combinations alone, by a
// Gaussian process (process.h) of the logarithms of FLIP. The process learns which settings change
// FLIP most, so that combinations that differ only in the other settings count as alike.
#ifndef DIP_APP_REPORT_FLIP_MODEL_H
#define DIP_APP_REPORT_FLIP_MODEL_H

#include "app/report/process.h"
#include "app/report/report.h"

typedef struct DipFlipModel {
    double weights[DIP_SETTING_COUNT]; // The weight of each setting in distances.
    DipQuality *known; // [combination]: the settings of each measured combination. Owned.
    double *shares;    // [combination]: its share in predictions (dip_cost_process_solve). Owned.
    int count;         // Number of measured combinations; 0 if there is no model.
    double log_mean;   // Mean of the logarithms of the measured FLIP.
    double variance;   // The variance of a logarithm of FLIP, divided by that of the process.
    // Knows the measured combinations. The caller may add `more` others, which will be measured, so
    // that combinations near them are less uncertain.
    DipCostProcess process;
} DipFlipModel;

// Fits a model to rows whose error is known. Returns false if there is no memory. Free the model
// anyway.
bool dip_flip_model_fit(const DipCostReport *report, const int *rows, int count, int more,
                        DipFlipModel *model);
void dip_flip_model_free(DipFlipModel *model);

// Writes the distances (process.h) of a combination to all measured ones.
void dip_flip_model_distances(const DipFlipModel *model, const DipQuality *quality, int *distances);

// Returns the FLIP of a combination with these distances to the measured ones.
double dip_flip_model_value(const DipFlipModel *model, const int *distances);

// Returns the standard deviation of the logarithm of that FLIP. `distances` has those to the
// measured combinations, and then those to the others that the process knows.
double dip_flip_model_error(const DipFlipModel *model, const int *distances);

// Returns an upper bound of that standard deviation, which is computed faster: what the nearest
// measured combination alone leaves.
double dip_flip_model_error_bound(const DipFlipModel *model, const int *distances);

// Predicts the FLIP of each measured combination from all others (leave one out), and summarises
// the misses.
DipCostMisses dip_flip_model_left_out(const DipFlipModel *model);

// Chooses combinations to measure, so that the FLIP of all predictions becomes most certain: one
// after another, each time the one whose FLIP is least certain (maximum entropy sampling, Shewry
// and Wynn 1987). On entry, `chosen` holds the indices of `given` predictions that will be measured
// anyway; on return, it holds all `count` indices. 0 <= given <= count <= predicted->count. Returns
// false if there is no memory.
bool dip_flip_model_design(const DipCostPredictions *predicted, int given, int count, int *chosen);

#endif
