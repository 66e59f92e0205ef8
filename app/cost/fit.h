// A linear fit of time to the work counters over all timed rows. (A row is one combination of
// settings on a camera path, report.h.) The fit shows how well work explains time, and how much
// time each kind of work (a term) takes.
#ifndef DIP_APP_COST_FIT_H
#define DIP_APP_COST_FIT_H

#include "app/cost/report.h"

enum { DIP_COST_FIT_MAX_TERMS = 8 };

typedef struct DipCostFit {
    const char *names[DIP_COST_FIT_MAX_TERMS]; // The first is "frame", the constant term.
    double ns[DIP_COST_FIT_MAX_TERMS];         // Time per unit of each term; never negative.
    int count;                                 // Number of terms.
    double r2;          // Share of the relative variance that the fit explains.
    double median_miss; // Median of |fitted / measured - 1|.
    int rows;           // Number of rows fitted; 0 if there are too few.
} DipCostFit;

// Fits the times per unit: minimises the sum of the squares of the rows' relative errors. No time
// per unit is negative.
DipCostFit dip_cost_fit(const DipCostReport *report);

#endif
