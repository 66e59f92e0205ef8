// Printing the tiers of a settings menu.
#include "app/report/tiers.h"

#include "app/files/put.h"
#include "app/report/words.h"

const char *const dip_cost_tier_names[DIP_COST_TIER_COUNT] = {"low", "medium", "high", "ultra"};

static void sort(DipCostTier tiers[DIP_COST_TIER_COUNT]) {
    for (int i = 1; i < DIP_COST_TIER_COUNT; i++) {
        const DipCostTier tier = tiers[i];
        int at = i;
        for (; at > 0 && tiers[at - 1].budget_ms > tier.budget_ms; at--) {
            tiers[at] = tiers[at - 1];
        }
        tiers[at] = tier;
    }
}

bool dip_cost_tiers_of(const DipCostReport *report, DipCostTier tiers[DIP_COST_TIER_COUNT]) {
    if (report->choice.advice_count != DIP_COST_TIER_COUNT) {
        return false;
    }
    for (int i = 0; i < DIP_COST_TIER_COUNT; i++) {
        const DipCandidate *chosen = dip_cost_chosen(report, i);
        tiers[i] = (DipCostTier){report->choice.advice[i].budget_ms,
                                 chosen ? &chosen->quality : NULL, chosen ? chosen->row : -1};
    }
    sort(tiers);
    return true;
}

void dip_cost_tiers_print(DipCostTier tiers[DIP_COST_TIER_COUNT], FILE *out) {
    sort(tiers);
    dip_put_text(out, "\nAs the tiers of a settings menu, and as lines for the ini:\n");
    for (int i = 0; i < DIP_COST_TIER_COUNT; i++) {
        char text[256];
        if (tiers[i].quality) {
            dip_quality_format(tiers[i].quality, text, sizeof text);
            dip_put_text(out, "  %-7s REQUESTED: %s\n", dip_cost_tier_names[i], text);
        } else {
            char ms[DIP_NUMBER_BYTES];
            dip_budget_ms_text(tiers[i].budget_ms, ms);
            dip_put_text(out, "  %-7s nothing is surely within %s ms\n", dip_cost_tier_names[i],
                         ms);
        }
    }
}
