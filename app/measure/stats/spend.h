// Spending a budget on several parts, for example on the segments of a camera path: which option to
// take for each part, so that the sum of their losses is least and the sum of their costs is within
// the budget.
//
// The options of a part that are worth taking lie on the lower convex hull of its points (cost,
// loss). The best choice for a given price of cost takes the point of each hull at which its slope
// reaches that price, so all parts have an equal slope (Everett 1963; Shoham and Gersho 1988 for
// bit rates). All functions are thread-safe.
#ifndef DIP_APP_MEASURE_STATS_SPEND_H
#define DIP_APP_MEASURE_STATS_SPEND_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

// An option of a part. Both numbers are finite.
typedef struct DipSpendOption {
    double cost;
    double loss;
} DipSpendOption;

// What was chosen.
typedef struct DipSpendResult {
    bool fits;    // False if even the cheapest options cost more than the budget.
    double cost;  // Sum of the costs.
    double loss;  // Sum of the losses.
    double slope; // By how much one more unit of cost would lower the loss; 0 if nothing would.
} DipSpendResult;

// Finds the lower convex hull of count >= 1 options, from the cheapest one to the one of least
// loss. Of options that cost the same, only one of least loss can be on the hull. Writes the
// indices of the options on the hull, in order of cost; `hull` has room for `count`. Returns their
// number.
int dip_spend_hull(const DipSpendOption *options, int count, int *hull);

// Chooses an option for each part: options[part * count + i] is option i of a part, and
// chosen[part] becomes the index of the chosen option. Starts with the cheapest point of each hull,
// and goes along the edges of all hulls, from the steepest on, until an edge does not fit in the
// budget. If the edges up to there use the whole budget, no choice of this cost has a smaller loss.
// In general, the loss is above the least possible one by less than the fall of the edge that did
// not fit. What is left of the budget then goes to the single options that lower the loss most;
// these need not be on a hull. If nothing fits, chooses the cheapest options.
DipSpendResult dip_spend(const DipSpendOption *options, int parts, int count, double budget,
                         int *chosen);

#ifdef __cplusplus
}
#endif

#endif
