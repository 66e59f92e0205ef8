// Composes counters from the base and one combination for each group of settings.
#include "app/report/work.h"

#include "app/report/combinations.h"

#include <math.h>
#include <string.h>

enum { GROUPS = 5 };

static unsigned group_mask(int group) {
    const unsigned masks[GROUPS] = {
        dip_cost_sampling_settings(), 1u << DIP_SETTING_AF | 1u << DIP_SETTING_AAF,
        1u << DIP_SETTING_OPT,        1u << DIP_SETTING_MIPLOD,
        1u << DIP_SETTING_GI,
    };
    return masks[group];
}

int dip_work_count_groups(const DipQuality *base, const DipQuality *quality) {
    DipQuality rest = *quality;
    int count = 0;
    for (int g = 0; g < GROUPS; g++) {
        const DipQuality without = dip_cost_take_settings(&rest, base, group_mask(g));
        count += !dip_quality_equal(&without, &rest);
        rest = without;
    }
    return dip_quality_equal(&rest, base) ? count : -1;
}

// Multiplies the counters by the factors between a combination and the base. Work that the base
// lacks has no factor, so the combination's own work counts.
static bool apply(const double *of, const double *base, double *counters) {
    for (int c = 0; of && c < DIP_COST_COUNTER_COUNT; c++) {
        counters[c] = base[c] > 0.0 ? counters[c] * of[c] / base[c] : fmax(counters[c], of[c]);
    }
    return of != NULL;
}

bool dip_work_compose(DipWorkFind *find, const void *context, const DipQuality *base,
                      const DipQuality *quality, double counters[DIP_COST_COUNTER_COUNT]) {
    const double *of_base = find(context, base);
    if (!of_base || dip_work_count_groups(base, quality) < 0) {
        return false;
    }
    memcpy(counters, of_base, DIP_COST_COUNTER_COUNT * sizeof *counters);
    const DipQuality sampling = dip_cost_take_settings(base, quality, group_mask(0));
    const DipQuality filtering = dip_cost_take_settings(base, quality, ~group_mask(0));
    if (!apply(find(context, &sampling), of_base, counters)) {
        return false;
    }
    const double *of_filtering = find(context, &filtering);
    if (of_filtering) {
        return apply(of_filtering, of_base, counters);
    }
    bool known = true;
    for (int g = 1; known && g < GROUPS; g++) {
        const DipQuality alone = dip_cost_take_settings(base, quality, group_mask(g));
        known = apply(find(context, &alone), of_base, counters);
    }
    return known;
}
