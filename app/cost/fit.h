// How well work counters explain time: a linear fit over all timed rows.
#ifndef DIP_APP_COST_FIT_H
#define DIP_APP_COST_FIT_H

#include "app/cost/report.h"

enum { DIP_COST_FIT_MAX_TERMS = 8 };

typedef struct DipCostFit {
    const char *names[DIP_COST_FIT_MAX_TERMS]; // The first is "frame", the constant term.
    double ns[DIP_COST_FIT_MAX_TERMS];         // Price per unit; 0 if it would be negative.
    int count;                                 // Number of terms.
    double r2;                                 // Share of the relative variance that is explained.
    double median_miss;                        // Median of |fitted / measured - 1|.
    int rows;                                  // Number of rows fitted; 0 if there are too few.
} DipCostFit;

// Least squares of relative errors over the rows' times; no price is negative.
DipCostFit dip_cost_fit(const DipCostReport *report);

#endif
