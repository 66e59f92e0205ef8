// Lists combinations of settings, and composes the counters of a combination that was not counted.
// The sources are the counters of a base combination and those of combinations that differ from the
// base only in some groups of settings.
#include "app/report/combinations.h"

#include "renderer/base/assert.h"

#include <math.h>
#include <string.h>

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
_Static_assert(sizeof groups / sizeof *groups == DIP_WORK_GROUPS, "the number of groups");

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

// Whether a setting has an effect depends only on the settings of its group, so the numbers of all
// groups multiply.
int64_t dip_cost_count_combinations_of(const DipQuality *baseline, unsigned settings) {
    int64_t count = 1;
    for (int g = 0; g < DIP_WORK_GROUPS; g++) {
        count *= dip_cost_list_combinations(baseline, settings & groups[g], NULL, 0);
    }
    return count * (settings >> DIP_SETTING_MIPDEBUG & 1 ? 2 : 1);
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

unsigned dip_work_group(int group) {
    return groups[group];
}

int dip_work_count_groups(const DipQuality *base, const DipQuality *quality) {
    DipQuality rest = *quality;
    int count = 0;
    for (int g = 0; g < DIP_WORK_GROUPS; g++) {
        const DipQuality without = dip_cost_take_settings(&rest, base, groups[g]);
        count += !dip_quality_equal(&without, &rest);
        rest = without;
    }
    return dip_quality_equal(&rest, base) ? count : -1;
}

double dip_cost_pixels_filtered(const DipQuality *quality) {
    const double scale = dip_quality_scale(quality);
    // Temporal AA and post-process AA filter a small picture (scale below 1) before it is enlarged,
    // and a large one (scale above 1) after it is averaged.
    const double drawn = fmin(1.0, scale * scale);
    return (dip_quality_has_history(quality) ? drawn : 0.0) +
           (quality->step[DIP_SETTING_POST] ? drawn : 0.0) +
           (dip_quality_upscales(quality) ? 1.0 : 0.0) +
           (quality->step[DIP_SETTING_SHARPEN] ? 1.0 : 0.0);
}

// Multiplies each counter by the ratio of a combination's counter (`of`) to the base's counter.
// Where the base's counter is 0, there is no ratio, and the counter becomes the combination's own
// counter if this is greater.
static void apply(const double *of, const double *base, double *counters) {
    for (int c = 0; c < DIP_COUNTER_COUNT; c++) {
        counters[c] = base[c] > 0.0 ? counters[c] * of[c] / base[c] : fmax(counters[c], of[c]);
    }
}

// Returns the number of pixels of a frame, as it follows from a combination's counters; 0 if the
// combination filters none. Filters of the finished picture are applied one after the other to
// pictures of known sizes, so their pixels need not be composed.
static double pixels_of_frame(const double *of, const DipQuality *quality) {
    const double filtered = dip_cost_pixels_filtered(quality);
    return filtered > 0.0 ? of[DIP_COUNTER_pixels_filtered] / filtered : 0.0;
}

// Adds the work of shadows. The shadow map is drawn by itself, so its work does not depend on the
// other settings. The fragments that read it are a share of all fragments.
static void add_shadows(const double *of, const double *base, double *counters) {
    const int all = DIP_COUNTER_fragments_shaded;
    const int reading = DIP_COUNTER_fragments_shadowed;
    const double growth = base[all] > 0.0 ? counters[all] / base[all] : 1.0;
    for (int c = 0; c < DIP_COUNTER_COUNT; c++) {
        counters[c] = c == reading ? of[c] * growth : counters[c] + (of[c] - base[c]);
    }
}

// --- corners -------------------------------------------------------------------------------------

// The settings of each pair, in the order of DipSetting.
static const DipSetting pairs[DIP_WORK_PAIRS][2] = {
    {DIP_SETTING_AA, DIP_SETTING_SCALE},
    {DIP_SETTING_SCALE, DIP_SETTING_POST},
};

unsigned dip_work_pair(int pair) {
    return 1u << pairs[pair][0] | 1u << pairs[pair][1];
}

// Returns whether a combination differs from the base at most in the settings of a pair.
static bool is_near_corner(const DipQuality *base, const DipQuality *quality, int pair) {
    const DipQuality alone = dip_cost_take_settings(base, quality, dip_work_pair(pair));
    return dip_quality_equal(&alone, quality);
}

static bool differ_in(const DipQuality *base, const DipQuality *quality, int pair) {
    const DipSetting first = pairs[pair][0], second = pairs[pair][1];
    return quality->step[first] != base->step[first] && quality->step[second] != base->step[second];
}

bool dip_work_is_corner(const DipQuality *base, const DipQuality *quality) {
    bool is = false;
    for (int p = 0; p < DIP_WORK_PAIRS; p++) {
        is |= is_near_corner(base, quality, p) && differ_in(base, quality, p);
    }
    return is;
}

void dip_work_note_corner(DipWorkCorners *corners, const DipQuality *base,
                          const DipQuality *quality, const double *counters) {
    for (int p = 0; p < DIP_WORK_PAIRS; p++) {
        const int first = quality->step[pairs[p][0]], second = quality->step[pairs[p][1]];
        DIP_ASSERT(first < DIP_WORK_MOST_STEPS && second < DIP_WORK_MOST_STEPS);
        if (is_near_corner(base, quality, p)) {
            corners->of[p][first][second] = counters;
        }
    }
}

// Corrects counters that were composed as if the two settings of a pair did not depend on each
// other. Does nothing if the corners that this needs were not counted.
static void join_corner(const DipWorkSum *sum, const DipQuality *quality, int pair,
                        double *counters) {
    if (!sum->corners || !differ_in(sum->base, quality, pair)) {
        return;
    }
    const DipSetting a = pairs[pair][0], b = pairs[pair][1];
    const double *const(*of)[DIP_WORK_MOST_STEPS] = sum->corners->of[pair];
    const double *corner = of[quality->step[a]][quality->step[b]];
    const double *of_first = of[quality->step[a]][sum->base->step[b]];
    const double *of_second = of[sum->base->step[a]][quality->step[b]];
    if (!corner || !of_first || !of_second) {
        return;
    }
    double composed[DIP_COUNTER_COUNT];
    memcpy(composed, of_first, sizeof composed);
    apply(of_second, sum->of_base, composed);
    for (int c = 0; c < DIP_COUNTER_COUNT; c++) {
        counters[c] *= composed[c] > 0.0 ? corner[c] / composed[c] : 1.0;
    }
}

DipWorkSum dip_work_begin(const DipQuality *base, const double *of_base) {
    DipWorkSum sum = {.base = base, .of_base = of_base, .pixels = pixels_of_frame(of_base, base)};
    memcpy(sum.counters, of_base, sizeof sum.counters);
    return sum;
}

void dip_work_add(DipWorkSum *sum, const DipQuality *part, const double *of_part) {
    if (part->step[DIP_SETTING_SHADOWS] != sum->base->step[DIP_SETTING_SHADOWS]) {
        sum->of_shadows = of_part;
        return;
    }
    apply(of_part, sum->of_base, sum->counters);
    sum->pixels = fmax(sum->pixels, pixels_of_frame(of_part, part));
}

void dip_work_end(const DipWorkSum *sum, const DipQuality *quality,
                  double counters[DIP_COUNTER_COUNT]) {
    memcpy(counters, sum->counters, DIP_COUNTER_COUNT * sizeof *counters);
    for (int p = 0; p < DIP_WORK_PAIRS; p++) {
        join_corner(sum, quality, p, counters);
    }
    counters[DIP_COUNTER_pixels_filtered] = sum->pixels * dip_cost_pixels_filtered(quality);
    if (sum->of_shadows) {
        add_shadows(sum->of_shadows, sum->of_base, counters);
    }
}

// Adds a part: the base with the settings of a mask taken from a combination. Returns false if this
// part was not counted.
static bool add_part(DipWorkSum *sum, DipWorkFind *find, const void *context,
                     const DipQuality *quality, unsigned settings) {
    const DipQuality part = dip_cost_take_settings(sum->base, quality, settings);
    const double *of_part = find(context, &part);
    if (of_part) {
        dip_work_add(sum, &part, of_part);
    }
    return of_part != NULL;
}

// Notes the counters of the base with either setting of a pair taken from a combination, and with
// both, as far as they were counted.
static void find_corners(DipWorkFind *find, const void *context, const DipQuality *base,
                         const DipQuality *quality, int pair, DipWorkCorners *corners) {
    const unsigned settings[] = {1u << pairs[pair][0], 1u << pairs[pair][1], dip_work_pair(pair)};
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        const DipQuality part = dip_cost_take_settings(base, quality, settings[i]);
        dip_work_note_corner(corners, base, &part, find(context, &part));
    }
}

bool dip_work_compose(DipWorkFind *find, const void *context, const DipQuality *base,
                      const DipQuality *quality, double counters[DIP_COUNTER_COUNT]) {
    const unsigned shadows = 1u << DIP_SETTING_SHADOWS;
    const double *of_base = find(context, base);
    if (!of_base || dip_work_count_groups(base, quality) < 0) {
        return false;
    }
    DipWorkSum sum = dip_work_begin(base, of_base);
    bool known = add_part(&sum, find, context, quality, groups[0]) &&
                 (quality->step[DIP_SETTING_SHADOWS] == base->step[DIP_SETTING_SHADOWS] ||
                  add_part(&sum, find, context, quality, shadows));
    const unsigned others = ~groups[0] & ~shadows;
    const bool as_one = known && add_part(&sum, find, context, quality, others);
    for (int g = 1; known && !as_one && g < DIP_WORK_GROUPS; g++) {
        known = groups[g] == shadows || add_part(&sum, find, context, quality, groups[g]);
    }
    // What the settings of a pair do together is known already if they belong to one part.
    DipWorkCorners corners = {0};
    for (int p = 0; known && p < DIP_WORK_PAIRS; p++) {
        const bool in_one_part = as_one && (dip_work_pair(p) & ~others) == 0;
        if (!in_one_part && differ_in(base, quality, p)) {
            find_corners(find, context, base, quality, p, &corners);
        }
    }
    sum.corners = &corners;
    if (known) {
        dip_work_end(&sum, quality, counters);
    }
    return known;
}
