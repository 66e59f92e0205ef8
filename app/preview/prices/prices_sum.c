// Whole times of combinations: as measured, as predicted, or prices added up.
#include "app/preview/prices/prices_private.h"

#include <math.h>
#include <string.h>

// What is added to a whole time: the prices of some settings.
typedef struct Parts {
    DipPrice prices[DIP_SETTING_COUNT];
    bool is_part[DIP_SETTING_COUNT];
} Parts;

static Parts list_parts(const DipPrices *prices, const DipQuality *base, const DipQuality *normal) {
    Parts parts = {.is_part = {false}};
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        if (normal->step[s] != base->step[s] && s != DIP_SETTING_ASD) {
            parts.is_part[s] = true;
            parts.prices[s] = dip_prices_step(prices, (DipSetting)s, normal->step[s], normal);
        }
    }
    return parts;
}

// Adds the parts that `from` lacks to the whole time of `from`.
static DipPriceKnown add_parts(const DipPriceKnown *from, const Parts *parts,
                               const DipQuality *base) {
    DipPriceKnown sum = *from;
    double below = sum.ms - sum.ms_low, above = sum.ms_high - sum.ms;
    sum.state = sum.state == DIP_PRICE_UNKNOWN ? DIP_PRICE_UNKNOWN : DIP_PRICE_ROUGH;
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        const DipPrice *part = &parts->prices[s];
        if (!parts->is_part[s] || from->quality.step[s] != base->step[s]) {
            continue;
        }
        sum.state = part->state == DIP_PRICE_UNKNOWN ? DIP_PRICE_UNKNOWN : sum.state;
        sum.ms += part->ms;
        below = hypot(below, part->ms - part->ms_low);
        above = hypot(above, part->ms_high - part->ms);
        sum.has_flip = sum.has_flip && part->has_flip;
        sum.flip += part->flip;
    }
    sum.flip = fmax(sum.flip, 0.0);
    sum.ms_low = sum.ms - below;
    sum.ms_high = sum.ms + above;
    return sum;
}

// Returns the combination with the settings that path 0 does not have as in the base: those whose
// price was measured on another path.
static DipQuality without_other_paths(const DipPrices *prices, const DipQuality *base,
                                      const DipQuality *normal, const Parts *parts) {
    DipQuality rest = *normal;
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        if (parts->is_part[s] && strcmp(parts->prices[s].path, prices->report.path) != 0) {
            rest.step[s] = base->step[s];
        }
    }
    return dip_price_normal(base, &rest);
}

static bool predict(const DipPrices *prices, const DipQuality *normal, DipPriceKnown *known) {
    DipPricePrediction prediction;
    if (dip_prices_are_rough(prices) || !prices->report.model ||
        !dip_price_model_predict(prices->report.model, normal, &prediction)) {
        return false;
    }
    *known = (DipPriceKnown){
        .quality = *normal,
        .state = DIP_PRICE_PREDICTED,
        .ms = prediction.ms,
        .ms_low = prediction.ms * (1.0 - prediction.miss),
        .ms_high = prediction.ms * (1.0 + prediction.miss),
        .has_flip = prediction.has_flip,
        .flip = prediction.flip,
    };
    return true;
}

// Finds the whole time of a combination: as measured, as predicted, or as the sum of its parts.
static DipPriceKnown whole_time(const DipPrices *prices, const DipQuality *base,
                                const DipQuality *normal, const Parts *parts) {
    const DipPriceKnown *known = dip_price_list_find(dip_prices_list(prices), normal);
    const DipPriceKnown nothing = {.quality = *base};
    DipPriceKnown predicted;
    if (known && known->state != DIP_PRICE_UNKNOWN) {
        return *known;
    }
    if (predict(prices, normal, &predicted)) {
        return predicted;
    }
    if (!known && !dip_prices_are_rough(prices)) {
        const DipQuality rest = without_other_paths(prices, base, normal, parts);
        known = dip_price_list_find(dip_prices_list(prices), &rest);
    }
    if (!known) {
        known = dip_price_list_find(dip_prices_list(prices), base);
    }
    return add_parts(known ? known : &nothing, parts, base);
}

DipPriceSum dip_prices_sum(const DipPrices *prices, const DipQuality *quality) {
    const DipQuality base = dip_prices_base(prices);
    const DipQuality normal = dip_price_normal(&base, quality);
    const DipPriceKnown *alone = dip_price_list_find(dip_prices_list(prices), &base);
    const Parts parts = list_parts(prices, &base, &normal);
    const DipPriceKnown whole = whole_time(prices, &base, &normal, &parts);
    DipPriceSum sum = {
        .state = whole.state,
        .ms_low = whole.ms_low,
        .ms_high = whole.ms_high,
        .has_flip = whole.has_flip,
        .flip = whole.flip,
        .base_ms = alone ? alone->ms : 0.0,
        .doubtful = dip_prices_are_doubtful(prices),
    };
    double known_ms = sum.base_ms;
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        sum.parts_ms[s] = parts.is_part[s] ? parts.prices[s].ms : 0.0;
        sum.parts_trust[s] =
            parts.is_part[s] ? dip_price_trust(&parts.prices[s]) : DIP_PRICE_TRUST_ZERO;
        known_ms += sum.parts_ms[s];
    }
    sum.together_ms = whole.ms - known_ms;
    sum.ms = known_ms + sum.together_ms; // Rounded as a reader who adds the parts rounds it.
    return sum;
}
