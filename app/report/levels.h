// How fast this machine was in earlier runs. Milliseconds do not repeat from run to run: on a quiet
// machine they may differ by a tenth, and nothing within one run shows it. Ratios of times repeat
// far better, but where a machine's speed changes, it does not change alike for all work. So every
// run leaves the baseline's time and the ratios of its sweeps' steps in the cache, and a report
// whose machine, build, scene and size were measured before says how far its runs lie apart.
#ifndef DIP_APP_REPORT_LEVELS_H
#define DIP_APP_REPORT_LEVELS_H

#include "app/report/report.h"

enum {
    DIP_COST_LEVEL_LEAST_RUNS = 4, // The spread of fewer runs is not stated.
    DIP_COST_LEVEL_MOST_RUNS = 200 // Only the latest runs count.
};

// Computes the spread of levels: the standard deviation of their logarithms, and the factor within
// which 95 % of the ratios of two runs lie, exp(t sqrt(2) sd) with the quantile of Student's t for
// count - 1 degrees of freedom. Leaves spread->factor 0 for fewer than DIP_COST_LEVEL_LEAST_RUNS.
DipCostLevelSpread dip_cost_level_spread(const double *levels_ms, int count);

// The ratio of a step in one run. Equal keys stand for the same step.
typedef struct DipCostRememberedRatio {
    char key[33];
    double log_ratio;
} DipCostRememberedRatio;

// Computes the standard deviation of logarithms of ratios between runs, over all steps together:
// the root of the sum of squared distances from each step's mean, over the number of ratios less
// that of steps. Sorts the ratios. Sets *runs to the number of ratios of the step that has most.
// Returns 0 if no step has two.
double dip_cost_ratio_deviation(DipCostRememberedRatio *ratios, int count, int *runs);

// Adds the time of the baseline on path 0, and the ratios of all sweeps' steps, to those that the
// cache has of the same machine, build, scene, poses, size, threads and settings, unless the
// verdict is red, and fills in report->level_spread. Without a cache (NULL), and where the file
// cannot be read or written, it does nothing: the report then speaks of this run alone.
void dip_cost_remember_level(DipCostReport *report, const char *cache);

#endif
