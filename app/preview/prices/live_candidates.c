// Lists sums of live prices as candidates.
#include "app/preview/prices/live_candidates.h"

#include "app/report/combinations.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_COMBINATIONS = 2048 };

static const unsigned settings = 1u << DIP_SETTING_AA | 1u << DIP_SETTING_AAA |
                                 1u << DIP_SETTING_AF | 1u << DIP_SETTING_AAF |
                                 1u << DIP_SETTING_OPT | 1u << DIP_SETTING_MIPLOD;

// Returns how much is known of the steps that a combination could take. Filtering is priced without
// antialiasing, since it is added to any.
static DipLiveKnown known_of(const DipPrices *prices, const DipQuality *like) {
    const DipQuality base = dip_prices_base(prices);
    DipQuality plain = *like;
    plain.step[DIP_SETTING_AA] = base.step[DIP_SETTING_AA];
    bool has_times = true, has_errors = true;
    for (int s = 0; s < DIP_SETTING_COUNT; ++s) {
        for (int i = 0; settings >> s & 1 && i < dip_setting_info((DipSetting)s)->step_count; ++i) {
            const bool filters = s == DIP_SETTING_AF || s == DIP_SETTING_AAF;
            const DipPrice price =
                dip_prices_step(prices, (DipSetting)s, i, filters ? &plain : like);
            has_times &= price.needs_company || price.state != DIP_PRICE_UNKNOWN;
            has_errors &= price.needs_company || price.has_flip;
        }
    }
    return !has_times ? DIP_LIVE_NO_TIMES : !has_errors ? DIP_LIVE_NO_ERRORS : DIP_LIVE_KNOWN;
}

// An interval of 95 % as a standard error of the logarithm. What has no width tells no error.
static DipEstimate estimate_of(const DipPriceSum *sum) {
    const double error = sum->ms_low > 0.0 ? log(sum->ms_high / sum->ms_low) / (2.0 * 1.96) : NAN;
    return dip_estimate_make(sum->ms, error, INFINITY);
}

// The base has no interval of its own: all others were timed beside it. It is known at least as
// well as the best known one of them.
static void give_base_an_error(DipCandidates *candidates) {
    double least = INFINITY;
    for (int i = 0; i < candidates->count; ++i) {
        least = fmin(least, candidates->list[i].time.log_error); // Passes over NAN.
    }
    for (int i = 0; i < candidates->count; ++i) {
        DipEstimate *time = &candidates->list[i].time;
        if (candidates->list[i].row == 0 && isnan(time->log_error)) {
            *time = dip_estimate_make(time->value, least, INFINITY);
        }
    }
}

DipLiveKnown dip_live_candidates(const DipPrices *prices, const DipQuality *like,
                                 DipCandidates *candidates) {
    const DipLiveKnown known = known_of(prices, like);
    DipQuality list[MOST_COMBINATIONS];
    *candidates = (DipCandidates){.kind = DIP_TIME_MEAN};
    if (known != DIP_LIVE_KNOWN) {
        return known;
    }
    const DipQuality base = dip_prices_base(prices);
    int count = dip_cost_list_combinations(&base, settings, list, MOST_COMBINATIONS);
    count = count < MOST_COMBINATIONS ? count : MOST_COMBINATIONS;
    candidates->list = calloc((size_t)count + 1, sizeof *candidates->list);
    for (int i = 0; candidates->list && i < count; ++i) {
        const DipPriceSum sum = dip_prices_sum(prices, &list[i]);
        if (sum.state != DIP_PRICE_UNKNOWN && sum.has_flip) {
            candidates->list[candidates->count++] = (DipCandidate){
                .quality = list[i],
                .time = estimate_of(&sum),
                .loss = sum.flip,
                .flip = sum.flip,
                .row = memcmp(&list[i], &base, sizeof base) == 0 ? 0 : i + 1,
            };
        }
    }
    give_base_an_error(candidates);
    return candidates->list ? DIP_LIVE_KNOWN : DIP_LIVE_NO_TIMES;
}
