// Keeping the whole times and errors that were measured live.
#include "app/preview/prices/prices_private.h"

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
    };
    const DipPriceKnown *before = dip_price_list_find(&prices->rough, &known.quality);
    if (!before) {
        return dip_price_list_add(&prices->rough, &known);
    }
    if (!known.has_flip) {
        known.has_flip = before->has_flip;
        known.flip = before->flip;
    }
    prices->rough.items[before - prices->rough.items] = known;
    return true;
}

void dip_prices_add_rough_flip(DipPrices *prices, const DipQuality *quality, double flip) {
    const DipQuality base = dip_prices_base(prices);
    const DipQuality normal = dip_price_normal(&base, quality);
    const DipPriceKnown *known = dip_price_list_find(&prices->rough, &normal);
    if (known) {
        DipPriceKnown *item = &prices->rough.items[known - prices->rough.items];
        item->has_flip = true;
        item->flip = flip;
    }
}

void dip_prices_forget_rough_flip(DipPrices *prices) {
    for (int i = 0; i < prices->rough.count; i++) {
        prices->rough.items[i].has_flip = false;
    }
}

int dip_prices_list_without_flip(const DipPrices *prices, DipQuality *list, int room) {
    int count = 0;
    for (int i = 0; i < prices->rough.count && count < room; i++) {
        if (!prices->rough.items[i].has_flip) {
            list[count++] = prices->rough.items[i].quality;
        }
    }
    return count;
}

bool dip_prices_has_rough(const DipPrices *prices, const DipQuality *quality) {
    const DipQuality base = dip_prices_base(prices);
    const DipQuality normal = dip_price_normal(&base, quality);
    return dip_price_list_find(&prices->rough, &normal) != NULL;
}

void dip_prices_forget_rough(DipPrices *prices) {
    prices->rough.count = 0;
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
