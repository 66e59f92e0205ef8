// Grouping exact differences, so that a reader sees their few causes and not one line per row.
#ifndef DIP_APP_COST_DIFF_DIFF_GROUPS_H
#define DIP_APP_COST_DIFF_DIFF_GROUPS_H

#include "app/cost/diff/diff.h"

#ifdef __cplusplus
extern "C" {
#endif

// How one quantity differs over the rows of a group.
typedef struct DipCostDiffChange {
    int quantity;
    int rows;     // Number of rows in which it differs.
    int greatest; // The row with the greatest change.
    double least; // Least and greatest growth (dip_cost_diff_growth).
    double most;
} DipCostDiffChange;

// Quantities that differ in the same rows. All errors are one group.
typedef struct DipCostDiffGroup {
    char which[256]; // The rows, in words: "all 12 rows with af=16".
    int row_count;   // Number of rows in which any of the quantities differs.
    DipCostDiffChange changes[DIP_COST_DIFF_QUANTITY_COUNT];
    int change_count;
} DipCostDiffGroup;

// Finds all groups. Returns their number, or -1 when memory runs out. Each quantity is in at most
// one group.
int dip_cost_diff_group(const DipCostDiff *diff,
                        DipCostDiffGroup groups[DIP_COST_DIFF_QUANTITY_COUNT]);

#ifdef __cplusplus
}
#endif

#endif
