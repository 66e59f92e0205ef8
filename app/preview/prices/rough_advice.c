// Adds up the prices of steps.
#include "app/preview/prices/rough_advice.h"

#include "app/report/combinations.h"

#include <math.h>

enum { MOST_STEPS = 8, MOST_COMBINATIONS = 2048 };

static const unsigned settings = 1u << DIP_SETTING_AA | 1u << DIP_SETTING_AAA |
                                 1u << DIP_SETTING_AF | 1u << DIP_SETTING_AAF |
                                 1u << DIP_SETTING_OPT | 1u << DIP_SETTING_MIPLOD;

// What every step adds to the base.
typedef struct Table {
    double base_ms;
    double base_flip;
    double ms[DIP_SETTING_COUNT][MOST_STEPS];
    double flip[DIP_SETTING_COUNT][MOST_STEPS];
    bool has_times;
    bool has_errors;
} Table;

static void take_price(const DipPrice *price, double *ms, double *flip, Table *table) {
    *ms = price->ms;
    *flip = price->flip;
    table->has_times &= price->state != DIP_PRICE_UNKNOWN;
    table->has_errors &= price->has_flip;
}

// Looks the prices up.
static Table make_table(const DipPrices *prices, const DipQuality *like) {
    Table table = {.has_times = true, .has_errors = true};
    const DipQuality base = dip_prices_base(prices);
    const DipPrice start =
        dip_prices_step(prices, DIP_SETTING_AA, base.step[DIP_SETTING_AA], &base);
    take_price(&start, &table.base_ms, &table.base_flip, &table);
    DipQuality plain = *like; // Filtering without antialiasing: it is added to any.
    plain.step[DIP_SETTING_AA] = base.step[DIP_SETTING_AA];
    for (int s = 0; s < DIP_SETTING_COUNT; ++s) {
        for (int i = 0; settings >> s & 1 && i < dip_setting_info((DipSetting)s)->step_count; ++i) {
            if (i != base.step[s]) {
                const bool filters = s == DIP_SETTING_AF || s == DIP_SETTING_AAF;
                const DipPrice price =
                    dip_prices_step(prices, (DipSetting)s, i, filters ? &plain : like);
                if (price.needs_company) {
                    table.ms[s][i] = table.flip[s][i] = NAN; // Without a price, not to be chosen.
                } else {
                    take_price(&price, &table.ms[s][i], &table.flip[s][i], &table);
                }
            }
        }
    }
    return table;
}

static void add_up(const Table *table, const DipQuality *quality, double *ms, double *flip) {
    *ms = table->base_ms;
    *flip = table->base_flip;
    for (int s = 0; s < DIP_SETTING_COUNT; ++s) {
        *ms += table->ms[s][quality->step[s]];
        *flip += table->flip[s][quality->step[s]];
    }
    *flip = *flip < 0.0 ? 0.0 : *flip;
}

static void choose(const Table *table, const DipQuality *list, int count, double budget_ms,
                   DipRoughAdvice *advice) {
    double least_ms = INFINITY;
    advice->state = DIP_ROUGH_ADVICE_TOO_SLOW;
    for (int i = 0; i < count; ++i) {
        double ms, flip;
        add_up(table, &list[i], &ms, &flip);
        const bool found = advice->state == DIP_ROUGH_ADVICE_FOUND;
        const bool fits = ms <= budget_ms;
        const bool better =
            !found || flip < 0.99 * advice->flip || (flip < 1.01 * advice->flip && ms < advice->ms);
        if (fits ? better : !found && ms < least_ms) {
            advice->state = fits ? DIP_ROUGH_ADVICE_FOUND : DIP_ROUGH_ADVICE_TOO_SLOW;
            advice->quality = list[i];
            advice->ms = least_ms = ms;
            advice->flip = flip;
        }
    }
}

DipRoughAdvice dip_rough_advice(const DipPrices *prices, const DipQuality *like, double budget_ms) {
    DipQuality list[MOST_COMBINATIONS];
    const Table table = make_table(prices, like);
    DipRoughAdvice advice = {.base_flip = table.base_flip};
    if (!table.has_times || !table.has_errors) {
        advice.state = table.has_times ? DIP_ROUGH_ADVICE_NO_ERRORS : DIP_ROUGH_ADVICE_NO_TIMES;
        return advice;
    }
    const DipQuality base = dip_prices_base(prices);
    const int count = dip_cost_list_combinations(&base, settings, list, MOST_COMBINATIONS);
    choose(&table, list, count < MOST_COMBINATIONS ? count : MOST_COMBINATIONS, budget_ms, &advice);
    return advice;
}
