// Printing the tiers of a settings menu.
#include "app/report/tiers.h"

#include "app/files/put.h"

const char *const dip_cost_tier_names[DIP_COST_TIER_COUNT] = {"low", "medium", "high", "ultra"};

void dip_cost_tiers_sort(DipCostTier tiers[DIP_COST_TIER_COUNT]) {
    for (int i = 1; i < DIP_COST_TIER_COUNT; i++) {
        const DipCostTier tier = tiers[i];
        int at = i;
        for (; at > 0 && tiers[at - 1].budget_ms > tier.budget_ms; at--) {
            tiers[at] = tiers[at - 1];
        }
        tiers[at] = tier;
    }
}

void dip_cost_tiers_print(DipCostTier tiers[DIP_COST_TIER_COUNT], FILE *out) {
    dip_cost_tiers_sort(tiers);
    dip_put_text(out, "\nAs the tiers of a settings menu, and as lines for the ini:\n");
    for (int i = 0; i < DIP_COST_TIER_COUNT; i++) {
        char text[256];
        if (tiers[i].quality) {
            dip_quality_format(tiers[i].quality, text, sizeof text);
            dip_put_text(out, "  %-7s REQUESTED: %s\n", dip_cost_tier_names[i], text);
        } else {
            dip_put_text(out, "  %-7s nothing is surely within %g ms\n", dip_cost_tier_names[i],
                         tiers[i].budget_ms);
        }
    }
}
