// Prints prices as JSON.
#include "tests/app/preview/price_lines.h"

#include <stdio.h>
#include <string.h>

static const char *const state_names[] = {"unknown", "base", "measured", "predicted", "rough"};

static int find_setting(const char *key) {
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        if (strcmp(dip_setting_info((DipSetting)s)->key, key) == 0) {
            return s;
        }
    }
    return -1;
}

static void print_flip(bool known, double flip) {
    if (known) {
        printf(",\"flip\":%.17g", flip);
    }
}

static void print_step(const DipPrices *prices, int setting, int step, const DipQuality *pane) {
    const DipPrice price = dip_prices_step(prices, (DipSetting)setting, step, pane);
    printf("{\"state\":\"%s\",\"ms\":%.17g,\"low\":%.17g,\"high\":%.17g,\"zero\":%s,"
           "\"floor\":%s,\"needs\":\"%s\",\"path\":\"%s\"",
           state_names[price.state], price.ms, price.ms_low, price.ms_high,
           dip_price_trust(&price) == DIP_PRICE_TRUST_ZERO ? "true" : "false",
           price.flip_at_floor ? "true" : "false", price.needs, price.path);
    print_flip(price.has_flip, price.flip);
    printf("}\n");
}

static void print_sum(const DipPrices *prices, const DipQuality *pane) {
    const DipPriceSum sum = dip_prices_sum(prices, pane);
    printf("{\"state\":\"%s\",\"ms\":%.17g,\"low\":%.17g,\"high\":%.17g,\"base\":%.17g,"
           "\"together\":%.17g,\"parts\":[",
           state_names[sum.state], sum.ms, sum.ms_low, sum.ms_high, sum.base_ms, sum.together_ms);
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        printf("%s%.17g", s > 0 ? "," : "", sum.parts_ms[s]);
    }
    printf("]");
    print_flip(sum.has_flip, sum.flip);
    printf("}\n");
}

bool dip_print_price(const DipPrices *prices, const char *line) {
    char key[32], text[256];
    int step;
    DipQuality pane;
    if (sscanf(line, "step %31s %d %255s", key, &step, text) == 3 && find_setting(key) >= 0 &&
        dip_quality_parse(text, &pane, NULL)) {
        print_step(prices, find_setting(key), step, &pane);
        return true;
    }
    if (sscanf(line, "sum %255s", text) == 1 && dip_quality_parse(text, &pane, NULL)) {
        print_sum(prices, &pane);
        return true;
    }
    return false;
}
