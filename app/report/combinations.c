// Lists combinations of settings, and composes the counters of a combination that was not counted.
// It composes them from counters of a base combination, and of combinations that differ from the
// base only in some groups of settings.
#include "app/report/combinations.h"

#include <math.h>
#include <string.h>

typedef struct List {
    unsigned settings;
    DipQuality *items;
    int room;
    int count;
} List;

static void add_from(List *list, DipQuality quality, int setting) {
    while (setting < DIP_SETTING_COUNT && !(list->settings >> setting & 1)) {
        setting++;
    }
    if (setting < DIP_SETTING_COUNT) {
        for (int step = 0; step < dip_setting_info((DipSetting)setting)->step_count; step++) {
            quality.step[setting] = (uint8_t)step;
            add_from(list, quality, setting + 1);
        }
        return;
    }
    const DipQuality effective = dip_quality_effective(&quality);
    if (list->settings >> DIP_SETTING_ASD & 1 && quality.step[DIP_SETTING_ASD] &&
        quality.step[DIP_SETTING_AAA] == DIP_AAA_ALL) {
        return;
    }
    if (dip_quality_check(&quality, NULL) && dip_quality_equal(&quality, &effective)) {
        if (list->count < list->room) {
            list->items[list->count] = quality;
        }
        list->count++;
    }
}

int dip_cost_list_combinations(const DipQuality *baseline, unsigned settings, DipQuality *list,
                               int room) {
    List all = {.settings = settings, .items = list, .room = room};
    add_from(&all, *baseline, 0);
    return all.count;
}

DipQuality dip_cost_take_settings(const DipQuality *from, const DipQuality *with, unsigned mask) {
    DipQuality taken = *from;
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        if (mask >> s & 1) {
            taken.step[s] = with->step[s];
        }
    }
    return taken;
}

// --- composed work -------------------------------------------------------------------------------

// The groups of settings. The first group decides which samples and fragments are drawn.
static const unsigned groups[] = {
    1u << DIP_SETTING_AA | 1u << DIP_SETTING_TAA | 1u << DIP_SETTING_AAA | 1u << DIP_SETTING_ASD,
    1u << DIP_SETTING_AF | 1u << DIP_SETTING_AAF,
    1u << DIP_SETTING_OPT,
    1u << DIP_SETTING_MIPLOD,
    1u << DIP_SETTING_SCALE | 1u << DIP_SETTING_UPSCALE,
    1u << DIP_SETTING_POST,
    1u << DIP_SETTING_SHARPEN,
    1u << DIP_SETTING_SHADOWS,
    1u << DIP_SETTING_GI,
};
enum { GROUPS = sizeof groups / sizeof *groups };

unsigned dip_cost_sampling_settings(void) {
    return groups[0];
}

int dip_work_count_groups(const DipQuality *base, const DipQuality *quality) {
    DipQuality rest = *quality;
    int count = 0;
    for (int g = 0; g < GROUPS; g++) {
        const DipQuality without = dip_cost_take_settings(&rest, base, groups[g]);
        count += !dip_quality_equal(&without, &rest);
        rest = without;
    }
    return dip_quality_equal(&rest, base) ? count : -1;
}

double dip_cost_pixels_filtered(const DipQuality *quality) {
    const double scale = dip_quality_scale(quality);
    // A history and antialiasing filter the picture that is drawn, before it is enlarged.
    const double drawn = fmin(1.0, scale * scale);
    return (dip_quality_has_history(quality) ? drawn : 0.0) +
           (quality->step[DIP_SETTING_POST] ? drawn : 0.0) +
           (dip_quality_upscales(quality) ? 1.0 : 0.0) +
           (quality->step[DIP_SETTING_SHARPEN] ? 1.0 : 0.0);
}

// Multiplies each counter by the ratio of a combination's counter (`of`) to the base's counter.
// Where the base's counter is 0, there is no ratio, and the combination's own counter is taken.
// Returns false if the combination was not counted.
static bool apply(const double *of, const double *base, double *counters) {
    for (int c = 0; of && c < DIP_COST_COUNTER_COUNT; c++) {
        counters[c] = base[c] > 0.0 ? counters[c] * of[c] / base[c] : fmax(counters[c], of[c]);
    }
    return of != NULL;
}

// Returns the number of pixels of a frame, as it follows from a combination's counters; 0 if the
// combination filters none or was not counted. Filters of the finished picture are applied one
// after the other to pictures of known sizes, so their pixels need not be composed.
static double pixels_of_frame(const double *of, const DipQuality *quality) {
    const double filtered = dip_cost_pixels_filtered(quality);
    return of && filtered > 0.0 ? of[DIP_COST_COUNTER_pixels_filtered] / filtered : 0.0;
}

// Adds the work of shadows. The shadow map is drawn by itself, so its work does not depend on the
// other settings. The fragments that read it are a share of all fragments.
static void add_shadows(const double *of, const double *base, double *counters) {
    const int all = DIP_COST_COUNTER_fragments_shaded;
    const int reading = DIP_COST_COUNTER_fragments_shadowed;
    const double growth = base[all] > 0.0 ? counters[all] / base[all] : 1.0;
    for (int c = 0; c < DIP_COST_COUNTER_COUNT; c++) {
        counters[c] = c == reading ? of[c] * growth : counters[c] + (of[c] - base[c]);
    }
}

// Composes the counters of a combination that has the base's shadows.
static bool compose_without_shadows(DipWorkFind *find, const void *context, const DipQuality *base,
                                    const DipQuality *quality, const double *of_base,
                                    double counters[DIP_COST_COUNTER_COUNT]) {
    memcpy(counters, of_base, DIP_COST_COUNTER_COUNT * sizeof *counters);
    const DipQuality sampling = dip_cost_take_settings(base, quality, groups[0]);
    const DipQuality filtering = dip_cost_take_settings(base, quality, ~groups[0]);
    if (!apply(find(context, &sampling), of_base, counters)) {
        return false;
    }
    const double *of_filtering = find(context, &filtering);
    double pixels =
        fmax(pixels_of_frame(of_base, base), pixels_of_frame(find(context, &sampling), &sampling));
    bool known = true;
    if (of_filtering) {
        pixels = fmax(pixels, pixels_of_frame(of_filtering, &filtering));
        known = apply(of_filtering, of_base, counters);
    }
    for (int g = 1; !of_filtering && known && g < GROUPS; g++) {
        const DipQuality alone = dip_cost_take_settings(base, quality, groups[g]);
        const double *of_alone = find(context, &alone);
        pixels = fmax(pixels, pixels_of_frame(of_alone, &alone));
        known = apply(of_alone, of_base, counters);
    }
    counters[DIP_COST_COUNTER_pixels_filtered] = pixels * dip_cost_pixels_filtered(quality);
    return known;
}

bool dip_work_compose(DipWorkFind *find, const void *context, const DipQuality *base,
                      const DipQuality *quality, double counters[DIP_COST_COUNTER_COUNT]) {
    const unsigned shadows = 1u << DIP_SETTING_SHADOWS;
    const DipQuality rest = dip_cost_take_settings(quality, base, shadows);
    const DipQuality alone = dip_cost_take_settings(base, quality, shadows);
    const double *of_base = find(context, base);
    if (!of_base || dip_work_count_groups(base, quality) < 0 ||
        !compose_without_shadows(find, context, base, &rest, of_base, counters)) {
        return false;
    }
    if (dip_quality_equal(&rest, quality)) {
        return true;
    }
    const double *of_alone = find(context, &alone);
    if (of_alone) {
        add_shadows(of_alone, of_base, counters);
    }
    return of_alone != NULL;
}
