// Prices of steps: from the report's tags, or from the differences of whole times.
#include "app/preview/prices/prices.h"

#include "app/measure/metrics/flip.h"
#include "app/report/format/formats.h"
#include "app/preview/prices/prices_private.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// The widest interval that holds 0 and stands for a price of 0, as a share of the time without the
// step. A wider interval comes from a busy machine or from a prediction, and tells nothing.
static const double widest_zero = 0.2;
// The widest interval of a time that is not doubtful, as a share of the time; and the interval that
// is always narrow enough, because the panel shows times to a tenth of a millisecond.
static const double widest_share = 0.5;
static const double narrow_ms = 0.2;
static const double least_shown_ms = 0.05; // Smaller times would be shown as 0.0.

DipPrices *dip_prices_create(DipError *err) {
    DipPrices *prices = calloc(1, sizeof *prices);
    if (!prices) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "prices", "out of memory");
    }
    return prices;
}

void dip_prices_destroy(DipPrices **prices) {
    if (*prices) {
        dip_price_report_free(&(*prices)->report);
        free((*prices)->rough.items);
        free(*prices);
        *prices = NULL;
    }
}

static bool is_wide(double ms, double low, double high) {
    return !(high - low <= fmax(widest_share * fabs(ms), narrow_ms));
}

DipPriceTrust dip_price_trust(const DipPrice *price) {
    const double width = price->ms_high - price->ms_low;
    if (price->state == DIP_PRICE_UNKNOWN) {
        return DIP_PRICE_TRUST_UNKNOWN;
    }
    if (price->doubtful) {
        return DIP_PRICE_TRUST_DOUBTFUL;
    }
    if (price->state != DIP_PRICE_BASE && price->ms_low <= 0.0 && price->ms_high >= 0.0) {
        return width <= widest_zero * price->without_ms ? DIP_PRICE_TRUST_ZERO
                                                        : DIP_PRICE_TRUST_DOUBTFUL;
    }
    return is_wide(price->ms, price->ms_low, price->ms_high) ? DIP_PRICE_TRUST_DOUBTFUL
           : fabs(price->ms) < least_shown_ms                ? DIP_PRICE_TRUST_ZERO
                                                             : DIP_PRICE_TRUST_KNOWN;
}

DipPriceTrust dip_price_sum_trust(const DipPriceSum *sum) {
    return sum->state == DIP_PRICE_UNKNOWN                                ? DIP_PRICE_TRUST_UNKNOWN
           : sum->doubtful || is_wide(sum->ms, sum->ms_low, sum->ms_high) ? DIP_PRICE_TRUST_DOUBTFUL
                                                                          : DIP_PRICE_TRUST_KNOWN;
}

void dip_prices_set_conditions(DipPrices *prices, const DipPriceConditions *conditions) {
    prices->conditions = *conditions;
}

void dip_prices_set_viewing(DipPrices *prices, double pixels_per_degree) {
    prices->pixels_per_degree = pixels_per_degree;
}

double dip_prices_viewing(const DipPrices *prices) {
    return prices->pixels_per_degree > 0.0 ? prices->pixels_per_degree
           : prices->has_report            ? prices->report.pixels_per_degree
                                           : DIP_FLIP_PIXELS_PER_DEGREE;
}

bool dip_prices_set_report(DipPrices *prices, const DipCostReport *report, DipError *err) {
    ++prices->changes;
    dip_price_report_free(&prices->report);
    prices->has_report = dip_price_report_make(&prices->report, report, err);
    return prices->has_report;
}

bool dip_prices_load_report(DipPrices *prices, const char *file, DipError *err) {
    DipCostReport report;
    if (!dip_cost_read_json(&report, file, err)) {
        return false;
    }
    const bool taken = dip_prices_set_report(prices, &report, err);
    dip_cost_report_free(&report);
    return taken;
}

bool dip_prices_has_report(const DipPrices *prices) {
    return prices->has_report;
}

void dip_prices_prefer_rough(DipPrices *prices, bool prefer) {
    prices->changes += prices->prefers_rough != prefer;
    prices->prefers_rough = prefer;
}

unsigned dip_prices_changes(const DipPrices *prices) {
    return prices->changes;
}

bool dip_prices_are_rough(const DipPrices *prices) {
    return !prices->has_report || prices->prefers_rough;
}

const DipPriceList *dip_prices_list(const DipPrices *prices) {
    return dip_prices_are_rough(prices) ? &prices->rough : &prices->report.known;
}

DipQuality dip_prices_base(const DipPrices *prices) {
    return prices->has_report ? prices->report.base : dip_quality_default();
}

// Makes the price of the base's own step from its whole time.
static DipPrice whole_price(const DipPriceKnown *known) {
    return (DipPrice){
        .state = known->state == DIP_PRICE_UNKNOWN ? DIP_PRICE_UNKNOWN : DIP_PRICE_BASE,
        .ms = known->ms,
        .ms_low = known->ms_low,
        .ms_high = known->ms_high,
        .has_flip = known->has_flip,
        .flip = known->flip,
        .flip_at_floor = known->flip_at_floor,
    };
}

// Makes a price of two whole times, whose errors are independent.
static DipPrice difference(const DipPriceKnown *with, const DipPriceKnown *without) {
    DipPrice price = {.has_flip = with->has_flip && without->has_flip};
    if (with->state != DIP_PRICE_UNKNOWN && without->state != DIP_PRICE_UNKNOWN) {
        price.state = with->state > without->state ? with->state : without->state;
        price.ms = with->ms - without->ms;
        price.ms_low = price.ms - hypot(with->ms - with->ms_low, without->ms_high - without->ms);
        price.ms_high = price.ms + hypot(with->ms_high - with->ms, without->ms - without->ms_low);
        price.without_ms = without->ms;
    }
    if (price.has_flip) {
        price.flip = with->flip - without->flip;
        price.flip_at_floor = with->flip_at_floor;
    }
    return price;
}

// Answers from whole times: rough prices, and those that a report predicted.
static DipPrice price_of_list(const DipPrices *prices, const DipPriceQuestion *question) {
    const DipPriceKnown *with = dip_price_list_find(dip_prices_list(prices), &question->with);
    const DipPriceKnown *without = dip_price_list_find(dip_prices_list(prices), &question->without);
    if (!with || !without) {
        return (DipPrice){.state = DIP_PRICE_UNKNOWN};
    }
    DipPrice price = question->is_base ? whole_price(with) : difference(with, without);
    price.doubtful = dip_prices_are_doubtful(prices);
    if (!dip_prices_are_rough(prices)) {
        snprintf(price.path, sizeof price.path, "%s", prices->report.path);
    }
    return price;
}

static DipPrice answer(const DipPrices *prices, DipSetting setting,
                       const DipPriceQuestion *question) {
    const DipPrice *tag = dip_prices_are_rough(prices)
                              ? NULL
                              : dip_price_report_find(&prices->report, setting, question);
    return tag ? *tag : price_of_list(prices, question);
}

// The companies that a price may have, the pane's own first.
enum { WITHOUT_ADAPTIVE_AA = 1, WITHOUT_AA, COMPANIES };

static DipQuality simpler_company(const DipQuality *base, const DipQuality *quality, int company) {
    DipQuality simpler = *quality;
    if (company >= WITHOUT_ADAPTIVE_AA) {
        simpler.step[DIP_SETTING_AAA] = base->step[DIP_SETTING_AAA];
        simpler.step[DIP_SETTING_ASD] = base->step[DIP_SETTING_ASD];
    }
    if (company >= WITHOUT_AA) {
        simpler.step[DIP_SETTING_AA] = base->step[DIP_SETTING_AA];
    }
    return simpler;
}

// Returns how much is known of a price: nothing, its error, a prediction, or a measured time.
static int knowledge(const DipPrice *price) {
    return price->state == DIP_PRICE_UNKNOWN     ? price->has_flip
           : price->state == DIP_PRICE_PREDICTED ? 2
                                                 : 3;
}

static void name_company(DipPrice *price, const DipQuality *base, const DipQuality *without) {
    size_t length = 0;
    for (int s = 0; s < DIP_SETTING_COUNT && length < sizeof price->beside; s++) {
        const DipSettingInfo *info = dip_setting_info((DipSetting)s);
        if (without->step[s] != base->step[s]) {
            length +=
                (size_t)snprintf(price->beside + length, sizeof price->beside - length, "%s%s=%s",
                                 length > 0 ? "," : "", info->key, info->steps[without->step[s]]);
        }
    }
}

DipPrice dip_prices_step(const DipPrices *prices, DipSetting setting, int step,
                         const DipQuality *quality) {
    const DipQuality base = dip_prices_base(prices);
    const DipPriceQuestion question = dip_price_question(&base, setting, step, quality);
    DipPrice price = answer(prices, setting, &question);
    const bool filters = setting == DIP_SETTING_AF || setting == DIP_SETTING_AAF;
    DipQuality without = question.without;
    for (int company = WITHOUT_ADAPTIVE_AA; filters && company < COMPANIES; company++) {
        const DipQuality pane = simpler_company(&base, quality, company);
        const DipPriceQuestion other = dip_price_question(&base, setting, step, &pane);
        const DipPrice otherwise = answer(prices, setting, &other);
        if (knowledge(&otherwise) > knowledge(&price)) {
            price = otherwise;
            without = other.without;
        }
    }
    if (price.state != DIP_PRICE_BASE) {
        name_company(&price, &base, &without);
    }
    price.needs_company = question.needs[0] != '\0';
    snprintf(price.needs, sizeof price.needs, "%s", question.needs);
    return price;
}
