// How well work explains time: a straight line through all timed frames.
#ifndef DIP_APP_COST_FIT_H
#define DIP_APP_COST_FIT_H

#include "app/cost/report.h"

enum { DIP_COST_FIT_MAX_TERMS = 8 };

typedef struct DipCostFit {
    const char *names[DIP_COST_FIT_MAX_TERMS]; // the first is "frame": the same for all
    double ns[DIP_COST_FIT_MAX_TERMS];         // per unit; 0: left out, as it would be negative
    int count;
    double r2;          // share of the times' variance that is explained
    double median_miss; // median of |fitted / measured - 1|
    int rows;           // that it is a fit of; 0: too few
} DipCostFit;

// Least squares over the rows' mean times, without negative costs.
DipCostFit dip_cost_fit(const DipCostReport *report);

#endif
