// A Gaussian process over combinations of settings (Rasmussen and Williams 2006). A value that is
// known at some combinations has a mean and a variance at every other one. The covariance of two
// combinations is `common` + alike^(d / DIP_PROCESS_STEP), where d is their distance
// (dip_cost_distance). What is known also has a variance of its own, `own`.
#ifndef DIP_APP_REPORT_PROCESS_H
#define DIP_APP_REPORT_PROCESS_H

#include "renderer/scene/quality.h"

enum {
    DIP_PROCESS_STEP = 8,
    DIP_PROCESS_MOST_WEIGHT = 4,
    DIP_PROCESS_MOST_DISTANCE = 15 * DIP_MAX_STEPS * DIP_PROCESS_STEP * DIP_PROCESS_MOST_WEIGHT
};

typedef struct DipCostProcess {
    double covariance[DIP_PROCESS_MOST_DISTANCE]; // [distance]
    double own;
    // The Cholesky factor of the covariance of all known combinations: row i begins at
    // factor[i (i + 1) / 2]. Owned.
    double *factor;
    int count, room; // Number of known combinations, and how many there may be.
} DipCostProcess;

// Returns how far two combinations are apart in the settings of a mask (bit s for setting s),
// summed over the settings. Steps of setting s are weights[s] * DIP_PROCESS_STEP apart, where a
// weight is 0 to DIP_PROCESS_MOST_WEIGHT. If `weights` is NULL, all are 1. Of samples and probes,
// each doubling has about half the effect of the one before, so their steps are that much closer to
// each other. If masks share no setting, the distances add up.
int dip_cost_distance(const DipQuality *a, const DipQuality *b, unsigned settings,
                      const double weights[DIP_SETTING_COUNT]);

// Begins a process without known combinations. Returns false if there is no memory. Free it anyway.
bool dip_cost_process_begin(DipCostProcess *process, double common, double alike, double own,
                            int room);
void dip_cost_process_free(DipCostProcess *process);

// Makes one more combination known, at these distances to those that are known already.
void dip_cost_process_add(DipCostProcess *process, const int *distances);

// Computes the share of each known combination from its value. The mean at a combination is the sum
// of all shares, each times covariance[distance].
void dip_cost_process_solve(const DipCostProcess *process, const double *values, double *shares);

// Returns the logarithm of the likelihood of the values (Rasmussen and Williams 2006, eq. 5.8)
// without its constant. The variance of the values, divided by that of the process, is the one with
// the greatest likelihood. `shares` are those of these values.
double dip_cost_process_likelihood(const DipCostProcess *process, const double *values,
                                   const double *shares);

// Computes by how much the value of each known combination lies above what all others predict.
void dip_cost_process_left_out(const DipCostProcess *process, const double *shares, double *misses);

// Returns the variance at a combination with these distances to the known ones: 0 to covariance[0].
double dip_cost_process_variance(const DipCostProcess *process, const int *distances);

#endif
