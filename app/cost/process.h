// A Gaussian process over combinations of settings (Rasmussen and Williams 2006). A value that is
// known at some combinations has a mean and a variance at every other one. The covariance of two
// combinations is `common` + alike^d, where d is their distance in steps of settings. What is known
// also has a variance of its own, `own`.
#ifndef DIP_APP_COST_PROCESS_H
#define DIP_APP_COST_PROCESS_H

#include "renderer/scene/quality.h"

enum { DIP_PROCESS_STEP = 8, DIP_PROCESS_MOST_DISTANCE = 15 * DIP_MAX_STEPS * DIP_PROCESS_STEP };

typedef struct DipCostProcess {
    double covariance[DIP_PROCESS_MOST_DISTANCE]; // [distance]
    double own;
    // The Cholesky factor of the covariance of all known combinations: row i begins at
    // factor[i (i + 1) / 2]. Owned.
    double *factor;
    int count, room; // Number of known combinations, and how many there may be.
} DipCostProcess;

// Returns how far two combinations are apart in the settings of a mask (bit s for setting s),
// summed over the settings. Steps are DIP_PROCESS_STEP apart. Of samples and probes, each doubling
// has about half the effect of the one before, so their steps are that much closer to each other.
// If masks share no setting, the distances add up.
int dip_cost_distance(const DipQuality *a, const DipQuality *b, unsigned settings);

// Begins a process without known combinations. Returns false if there is no memory. Free it anyway.
bool dip_cost_process_begin(DipCostProcess *process, double common, double alike, double own,
                            int room);
void dip_cost_process_free(DipCostProcess *process);

// Makes one more combination known, at these distances to those that are known already.
void dip_cost_process_add(DipCostProcess *process, const int *distances);

// Computes the share of each known combination from its value. The mean at a combination is the sum
// of all shares, each times covariance[distance].
void dip_cost_process_solve(const DipCostProcess *process, const double *values, double *shares);

// Computes by how much the value of each known combination lies above what all others predict.
void dip_cost_process_left_out(const DipCostProcess *process, const double *shares, double *misses);

// Returns the variance at a combination with these distances to the known ones: 0 to covariance[0].
double dip_cost_process_variance(const DipCostProcess *process, const int *distances);

#endif
