// The tiers of a settings menu (low, medium, high, ultra): the best settings for four time budgets.
#ifndef DIP_APP_REPORT_TIERS_H
#define DIP_APP_REPORT_TIERS_H

#include "app/report/report.h"

#include <stdio.h>

enum { DIP_COST_TIER_COUNT = 4 };

extern const char *const dip_cost_tier_names[DIP_COST_TIER_COUNT]; // From the least budget on.

// The settings for one budget.
typedef struct DipCostTier {
    double budget_ms;
    const DipQuality *quality; // NULL if nothing is surely within the budget. Borrowed.
    int row;                   // The row of the report, or -1.
} DipCostTier;

// Makes the tiers of a report from its advice, in the order of their budgets. Returns false if
// there are not four budgets.
bool dip_cost_tiers_of(const DipCostReport *report, DipCostTier tiers[DIP_COST_TIER_COUNT]);

// Sorts the tiers and prints them as lines for the ini.
void dip_cost_tiers_print(DipCostTier tiers[DIP_COST_TIER_COUNT], FILE *out);

#endif
