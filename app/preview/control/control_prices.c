// Tells the prices of settings in replies and events.
#include "app/preview/control/control_reply.h"

#include <cjson/cJSON.h>

static const char *state_name(DipPriceState state) {
    static const char *const names[] = {
        [DIP_PRICE_UNKNOWN] = "unknown",   [DIP_PRICE_BASE] = "base",
        [DIP_PRICE_MEASURED] = "measured", [DIP_PRICE_PREDICTED] = "predicted",
        [DIP_PRICE_ROUGH] = "rough",
    };
    return names[state];
}

static const char *trust_name(DipPriceTrust trust) {
    static const char *const names[] = {
        [DIP_PRICE_TRUST_UNKNOWN] = "unknown",
        [DIP_PRICE_TRUST_DOUBTFUL] = "doubtful",
        [DIP_PRICE_TRUST_ZERO] = "zero",
        [DIP_PRICE_TRUST_KNOWN] = "known",
    };
    return names[trust];
}

static void add_time(cJSON *object, DipPriceState state, DipPriceTrust trust, double ms, double low,
                     double high) {
    cJSON_AddStringToObject(object, "state", state_name(state));
    cJSON_AddStringToObject(object, "trust", trust_name(trust));
    if (state != DIP_PRICE_UNKNOWN) {
        cJSON_AddNumberToObject(object, "ms", ms);
        cJSON_AddNumberToObject(object, "ms_low", low);
        cJSON_AddNumberToObject(object, "ms_high", high);
    }
}

static void add_pane(cJSON *object, const char *name, const DipPriceSum *sum) {
    cJSON *pane = cJSON_AddObjectToObject(object, name);
    add_time(pane, sum->state, dip_price_sum_trust(sum), sum->ms, sum->ms_low, sum->ms_high);
    if (sum->has_flip) {
        cJSON_AddNumberToObject(pane, "flip", sum->flip);
    }
}

static void add_step(cJSON *steps, const char *name, const DipPrice *price) {
    cJSON *step = cJSON_CreateObject();
    cJSON_AddStringToObject(step, "step", name);
    add_time(step, price->state, dip_price_trust(price), price->ms, price->ms_low, price->ms_high);
    if (price->has_flip) {
        cJSON_AddNumberToObject(step, "flip", price->flip);
    }
    if (price->beside[0]) {
        cJSON_AddStringToObject(step, "beside", price->beside);
    }
    if (!cJSON_AddItemToArray(steps, step)) {
        cJSON_Delete(step);
    }
}

static const char *source_name(const DipPrices *prices, const DipPriceSum *requested) {
    return dip_prices_has_report(prices) && !dip_prices_are_rough(prices) ? "report"
           : requested->state == DIP_PRICE_UNKNOWN                        ? "none"
                                                                          : "rough";
}

void dip_reply_prices(cJSON *object, const DipPreviewMoment *moment) {
    const DipQuality *quality = moment->state->quality;
    const DipPriceSum requested = dip_prices_sum(moment->prices, &quality[DIP_PANE_REQUESTED]);
    const DipPriceSum current = dip_prices_sum(moment->prices, &quality[DIP_PANE_CURRENT]);
    cJSON_AddStringToObject(object, "source", source_name(moment->prices, &requested));
    cJSON_AddStringToObject(object, "progress", dip_prices_progress(moment->prices));
    add_pane(object, dip_pane_names[DIP_PANE_CURRENT], &current);
    add_pane(object, dip_pane_names[DIP_PANE_REQUESTED], &requested);
    cJSON *settings = cJSON_AddObjectToObject(object, "settings");
    for (int s = 0; s < DIP_SETTING_COUNT; ++s) {
        const DipSettingInfo *info = dip_setting_info((DipSetting)s);
        cJSON *steps = cJSON_AddArrayToObject(settings, info->key);
        for (int i = 0; i < info->step_count; ++i) {
            const DipPrice price =
                dip_prices_step(moment->prices, (DipSetting)s, i, &quality[DIP_PANE_REQUESTED]);
            add_step(steps, info->steps[i], &price);
        }
    }
}
