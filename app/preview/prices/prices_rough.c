// Keeping the whole times and errors that were measured live.
#include "app/preview/prices/prices_private.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>

bool dip_prices_add_rough(DipPrices *prices, const DipQuality *quality, double ms, double ms_low,
                          double ms_high, double flip) {
    const DipQuality base = dip_prices_base(prices);
    DipPriceKnown known = {
        .quality = dip_price_normal(&base, quality),
        .state = DIP_PRICE_ROUGH,
        .ms = ms,
        .ms_low = ms_low,
        .ms_high = ms_high,
        .has_flip = flip >= 0.0,
        .flip = flip,
        .next_samples = flip >= 0.0 ? INT_MAX : 0,
        .next_flip = flip,
    };
    ++prices->changes;
    const DipPriceKnown *before = dip_price_list_find(&prices->rough, &known.quality);
    if (!before) {
        return dip_price_list_add(&prices->rough, &known);
    }
    if (!known.has_flip) {
        known.has_flip = before->has_flip;
        known.flip = before->flip;
        known.next_samples = before->next_samples;
        known.next_flip = before->next_flip;
    }
    prices->rough.items[before - prices->rough.items] = known;
    return true;
}

// Returns whether errors show that were measured against a coarser truth.
static bool shows_coarser(const DipPrices *prices, int samples) {
    for (int i = 0; i < prices->rough.count; i++) {
        const DipPriceKnown *item = &prices->rough.items[i];
        if (item->has_flip && item->next_samples < samples) {
            return true;
        }
    }
    return false;
}

void dip_prices_add_rough_flip(DipPrices *prices, const DipQuality *quality, double flip,
                               int samples) {
    const DipQuality base = dip_prices_base(prices);
    const DipQuality normal = dip_price_normal(&base, quality);
    const DipPriceKnown *known = dip_price_list_find(&prices->rough, &normal);
    if (!known) {
        return;
    }
    DipPriceKnown *added = &prices->rough.items[known - prices->rough.items];
    ++prices->changes;
    added->next_flip = flip;
    added->next_samples = samples;
    for (int i = 0; !shows_coarser(prices, samples) && i < prices->rough.count; i++) {
        DipPriceKnown *item = &prices->rough.items[i];
        if (item->next_samples == samples) {
            item->has_flip = true;
            item->flip = item->next_flip;
        }
    }
}

int dip_prices_list_without_flip(const DipPrices *prices, int samples, DipQuality *list, int room) {
    int count = 0;
    for (int i = 0; i < prices->rough.count && count < room; i++) {
        if (prices->rough.items[i].next_samples < samples) {
            list[count++] = prices->rough.items[i].quality;
        }
    }
    return count;
}

int dip_prices_rough_count(const DipPrices *prices) {
    return prices->rough.count;
}

bool dip_prices_has_rough(const DipPrices *prices, const DipQuality *quality) {
    const DipQuality base = dip_prices_base(prices);
    const DipQuality normal = dip_price_normal(&base, quality);
    return dip_price_list_find(&prices->rough, &normal) != NULL;
}

void dip_prices_forget_rough(DipPrices *prices) {
    prices->rough.count = 0;
    ++prices->changes;
}

bool dip_prices_set_progress(DipPrices *prices, const char *text) {
    char before[DIP_PRICE_PROGRESS];
    memcpy(before, prices->progress, sizeof before);
    snprintf(prices->progress, sizeof prices->progress, "%s", text);
    return strcmp(before, prices->progress) != 0;
}

const char *dip_prices_progress(const DipPrices *prices) {
    return prices->progress;
}

void dip_prices_set_rough_doubtful(DipPrices *prices, bool doubtful) {
    prices->rough_doubtful = doubtful;
}
