// Prices without a source.
#include "app/preview/prices.h"

#include <stdio.h>
#include <stdlib.h>

struct DipPrices {
    int unused;
};

DipPrices *dip_prices_create(DipError *err) {
    DipPrices *prices = calloc(1, sizeof *prices);
    if (!prices) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "preview", "out of memory");
    }
    return prices;
}

void dip_prices_destroy(DipPrices **prices) {
    free(*prices);
    *prices = NULL;
}

DipPrice dip_prices_step(const DipPrices *prices, DipSetting setting, int step,
                         const DipQuality *quality) {
    (void)prices, (void)setting, (void)step, (void)quality;
    return (DipPrice){.state = DIP_PRICE_UNKNOWN};
}

DipPriceSum dip_prices_sum(const DipPrices *prices, const DipQuality *quality) {
    (void)prices, (void)quality;
    return (DipPriceSum){.state = DIP_PRICE_UNKNOWN};
}

bool dip_prices_source(const DipPrices *prices, int width, int height, char *text,
                       size_t size_bytes) {
    (void)prices, (void)width, (void)height;
    snprintf(text, size_bytes, "No prices are known.");
    return false;
}
