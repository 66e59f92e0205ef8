// Finds a combination's time of a frame: as measured, as predicted, or as the known time of the
// base or of a similar combination plus the prices of the steps in which the two differ. Lists the
// candidates for a choice from these times.
#include "app/report/prices/prices.h"

#include "app/report/report.h"
#include "app/report/combinations.h"
#include "app/report/prices/view.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// The prices of the settings in which a combination differs from the base.
typedef struct Parts {
    DipPrice prices[DIP_SETTING_COUNT];
    bool is_part[DIP_SETTING_COUNT];
} Parts;

static Parts list_parts(const DipPriceView *view, const DipQuality *normal) {
    Parts parts = {.is_part = {false}};
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        if (normal->step[s] != view->base.step[s] && s != DIP_SETTING_ASD) {
            parts.is_part[s] = true;
            parts.prices[s] = dip_price_step(view, (DipSetting)s, normal->step[s], normal);
        }
    }
    return parts;
}

// Returns `whole`, the time and error of the combination `from`, plus the parts that `from` lacks.
static DipPriceWhole add_parts(const DipPriceView *view, const DipPriceWhole *whole,
                               const DipQuality *from, const Parts *parts) {
    DipPriceWhole sum = *whole;
    double below = sum.time.value - sum.time.low, above = sum.time.high - sum.time.value;
    sum.state = sum.state == DIP_PRICE_UNKNOWN ? DIP_PRICE_UNKNOWN : DIP_PRICE_ROUGH;
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        const DipPrice *part = &parts->prices[s];
        if (!parts->is_part[s] || from->step[s] != view->base.step[s]) {
            continue;
        }
        sum.state = part->state == DIP_PRICE_UNKNOWN ? DIP_PRICE_UNKNOWN : sum.state;
        sum.time.value += part->ms;
        below = hypot(below, part->ms - part->ms_low);
        above = hypot(above, part->ms_high - part->ms);
        sum.has_flip = sum.has_flip && part->has_flip;
        sum.flip += part->flip;
    }
    sum.flip = fmax(sum.flip, 0.0);
    sum.time.low = sum.time.value - below;
    sum.time.high = sum.time.value + above;
    sum.time.log_error =
        sum.time.low > 0.0 ? log(sum.time.high / sum.time.low) / (2.0 * 1.96) : NAN;
    return sum;
}

// Returns the combination with some settings put back to their step in the base: those whose price
// was measured on another path than path 0.
static DipQuality without_other_paths(const DipPriceView *view, const DipQuality *normal,
                                      const Parts *parts) {
    DipQuality rest = *normal;
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        const char *path = parts->prices[s].path;
        if (parts->is_part[s] && path[0] && strcmp(path, view->report->paths[0]) != 0) {
            rest.step[s] = view->base.step[s];
        }
    }
    return dip_price_normal(&view->base, &rest);
}

// Finds the whole time of a combination: as measured, as predicted, or as the time of the base (or
// of a measured combination that is more like this one) plus the prices of the steps in which the
// two differ.
static DipPriceWhole whole_of(const DipPriceView *view, const DipQuality *normal,
                              const Parts *parts) {
    const DipPriceEntry *entry = dip_price_find(view, 0, normal);
    DipPriceWhole whole = dip_price_known(view, entry);
    DipQuality from = *normal;
    if (whole.state != DIP_PRICE_UNKNOWN || dip_price_predict(view, normal, &whole)) {
        return whole;
    }
    if (!entry) {
        from = without_other_paths(view, normal, parts);
        entry = dip_price_find(view, 0, &from);
    }
    if (!entry) {
        from = view->base;
        entry = dip_price_find(view, 0, &from);
    }
    whole = dip_price_known(view, entry);
    return add_parts(view, &whole, &from, parts);
}

// Finds the time that is compared with a budget. sum->ms must be known.
static void find_judged_time(const DipPriceView *view, const DipPriceEntry *entry,
                             DipPriceSum *sum) {
    const DipCostReport *report = view->report;
    const DipTimeKind kind = report->options.budget_of;
    sum->judged_by = DIP_TIME_MEAN;
    sum->judged_ms = sum->ms;
    if (!entry || dip_cost_is_view(report)) {
        return;
    }
    if (entry->row >= 0 && dip_cost_is_timed(report, entry->row)) {
        sum->judged_by = kind;
        sum->judged_ms = dip_candidate_of_row(report, entry->row, kind).time.value;
    } else if (entry->row < 0 && kind == DIP_TIME_P95) {
        sum->judged_by = kind;
        sum->judged_ms = report->predicted.list[entry->prediction].p95_ms;
    }
}

DipPriceSum dip_price_sum(const DipPriceView *view, const DipQuality *quality) {
    const DipQuality normal = dip_price_normal(&view->base, quality);
    const DipPriceWhole alone = dip_price_known(view, dip_price_find(view, 0, &view->base));
    const Parts parts = list_parts(view, &normal);
    const DipPriceWhole whole = whole_of(view, &normal, &parts);
    DipPriceSum sum = {
        .state = whole.state,
        .ms_low = whole.time.low,
        .ms_high = whole.time.high,
        .has_flip = whole.has_flip,
        .flip = whole.flip,
        .base_ms = alone.time.value,
        .doubtful = dip_price_is_doubtful(view),
    };
    const DipPriceSum base = {.state = alone.state,
                              .ms = alone.time.value,
                              .ms_low = alone.time.low,
                              .ms_high = alone.time.high,
                              .doubtful = sum.doubtful};
    sum.base_trust = dip_price_sum_trust(&base);
    double known_ms = sum.base_ms;
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        sum.parts_ms[s] = parts.is_part[s] ? parts.prices[s].ms : 0.0;
        sum.parts_trust[s] =
            parts.is_part[s] ? dip_price_trust(&parts.prices[s]) : DIP_PRICE_TRUST_ZERO;
        known_ms += sum.parts_ms[s];
    }
    sum.together_ms = whole.time.value - known_ms;
    sum.ms = known_ms + sum.together_ms; // So the parts add up to ms to the last bit.
    find_judged_time(view, dip_price_find(view, 0, &normal), &sum);
    return sum;
}

// --- candidates ----------------------------------------------------------------------------------

enum { MOST_COMBINATIONS = 4096 };

static const unsigned settings = 1u << DIP_SETTING_AA | 1u << DIP_SETTING_AAA |
                                 1u << DIP_SETTING_AF | 1u << DIP_SETTING_AAF |
                                 1u << DIP_SETTING_OPT | 1u << DIP_SETTING_MIPLOD;

// Returns whether a choice must wait for the price of a step. Steps that reports of earlier
// versions lack take part in the choice only if their prices are known.
static bool is_required(DipSetting setting, int step) {
    return setting == DIP_SETTING_AAA      ? step == DIP_AAA_OFF || step == DIP_AAA_ON
           : setting == DIP_SETTING_MIPLOD ? step <= DIP_MIPLOD_HIGH_QUALITY
                                           : true;
}

// Returns how much is known of the prices of all required steps (is_required) for a pane with the
// settings `like`. For steps of AF and advanced AF, the price with the base's AA suffices, since it
// stands for the price with any other AA that was not measured.
static DipPricesKnown known_of(const DipPriceView *view, const DipQuality *like) {
    DipQuality plain = *like;
    plain.step[DIP_SETTING_AA] = view->base.step[DIP_SETTING_AA];
    bool has_times = true, has_errors = true;
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        for (int i = 0; settings >> s & 1 && i < dip_setting_info((DipSetting)s)->step_count; i++) {
            if (!is_required((DipSetting)s, i)) {
                continue;
            }
            const DipPrice price = dip_price_step(view, (DipSetting)s, i,
                                                  dip_price_filters((DipSetting)s) ? &plain : like);
            has_times &= price.needs_company || price.state != DIP_PRICE_UNKNOWN;
            has_errors &= price.needs_company || price.has_flip;
        }
    }
    return !has_times ? DIP_PRICES_NO_TIMES : has_errors ? DIP_PRICES_KNOWN : DIP_PRICES_NO_ERRORS;
}

// Adds a combination if its time and its error are known. All combinations share the error of the
// base's time.
static void add_candidate(const DipPriceView *view, const DipQuality *quality,
                          DipCandidates *candidates) {
    const DipCostReport *report = view->report;
    const DipQuality normal = dip_price_normal(&view->base, quality);
    const DipPriceEntry *entry = dip_price_find(view, 0, &normal);
    const Parts parts = list_parts(view, &normal);
    const DipPriceWhole whole = whole_of(view, &normal, &parts);
    if (whole.state == DIP_PRICE_UNKNOWN || !whole.has_flip) {
        return;
    }
    DipCandidate *candidate = &candidates->list[candidates->count++];
    if (entry && entry->row >= 0 && dip_cost_is_timed(report, entry->row)) {
        *candidate = dip_candidate_of_row(report, entry->row, candidates->kind);
    } else {
        *candidate = (DipCandidate){
            .time = whole.time,
            .common_error = report->rows[report->base_rows[0]].time.level_error,
            .loss = fmax(whole.flip, dip_cost_floor_flip(report, 0)),
            .flip = whole.flip,
            .row = -1,
        };
    }
    candidate->quality = *quality;
}

DipPricesKnown dip_price_candidates(const DipPriceView *view, const DipQuality *like,
                                    DipCandidates *candidates) {
    const DipPricesKnown known = known_of(view, like);
    DipQuality list[MOST_COMBINATIONS];
    *candidates = (DipCandidates){.kind = DIP_TIME_MEAN, .disturbed = dip_price_is_doubtful(view)};
    if (known != DIP_PRICES_KNOWN) {
        return known;
    }
    int count = dip_cost_list_combinations(&view->base, settings, list, MOST_COMBINATIONS);
    count = count < MOST_COMBINATIONS ? count : MOST_COMBINATIONS;
    candidates->list = calloc((size_t)count + 1, sizeof *candidates->list);
    for (int i = 0; candidates->list && i < count; i++) {
        add_candidate(view, &list[i], candidates);
    }
    return candidates->list ? DIP_PRICES_KNOWN : DIP_PRICES_NO_TIMES;
}
