// Reading the predictions and the advice of a report from JSON.
#include "app/report/format/read_parts.h"

#include "app/report/format/json_read.h"

#include <cjson/cJSON.h>
#include <stdlib.h>

static DipCostMisses read_misses(const cJSON *misses, const char *name, bool *ok) {
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(misses, name);
    return (DipCostMisses){
        .rows = dip_json_integer(item, "rows", 0, DIP_COST_MAX_ROWS, ok),
        .median = dip_json_number(item, "median", DIP_JSON_MAX_MEAN, ok),
        .p90 = dip_json_number(item, "p90", DIP_JSON_MAX_MEAN, ok),
        .within_5 = dip_json_number(item, "within_5_percent", 1.0, ok),
        .within_10 = dip_json_number(item, "within_10_percent", 1.0, ok),
    };
}

static bool read_prediction(const cJSON *object, const DipCostReport *report,
                            DipCostPrediction *prediction) {
    bool ok = true;
    const cJSON *settings = cJSON_GetObjectItemCaseSensitive(object, "settings");
    *prediction = (DipCostPrediction){
        .ms = dip_json_number(object, "ms", DIP_JSON_MAX_MS, &ok),
        .p95_ms = dip_json_number(object, "p95_ms", DIP_JSON_MAX_MS, &ok),
        .flip = dip_json_number(object, "flip", DIP_JSON_MAX_MEAN, &ok),
        .row = dip_json_integer(object, "row", -1, report->row_count - 1, &ok),
    };
    return ok && cJSON_IsString(settings) &&
           dip_quality_parse(settings->valuestring, &prediction->quality, NULL);
}

bool dip_cost_read_predictions(const cJSON *root, DipCostReport *report, const char *file,
                               DipError *err) {
    DipCostPredictions *predicted = &report->predicted;
    const cJSON *object = cJSON_GetObjectItemCaseSensitive(root, "predicted");
    const cJSON *list = cJSON_GetObjectItemCaseSensitive(object, "combinations");
    const cJSON *misses = cJSON_GetObjectItemCaseSensitive(object, "misses");
    const int count = cJSON_GetArraySize(list);
    if (!object) {
        return true;
    }
    if (count > DIP_COST_MAX_ROWS) {
        return dip_json_missing(file, "predicted", err);
    }
    predicted->list = calloc((size_t)count + 1, sizeof *predicted->list);
    if (!predicted->list) {
        return dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory");
    }
    bool ok = true;
    predicted->trained = dip_json_integer(object, "trained", 0, DIP_COST_MAX_ROWS, &ok);
    predicted->times = read_misses(misses, "times", &ok);
    predicted->errors = read_misses(misses, "flip", &ok);
    predicted->times_left_out = read_misses(misses, "times_left_out", &ok);
    predicted->errors_left_out = read_misses(misses, "flip_left_out", &ok);
    const cJSON *item;
    cJSON_ArrayForEach(item, list) {
        ok = ok && read_prediction(item, report, &predicted->list[predicted->count++]);
    }
    return ok || dip_json_missing(file, "predicted", err);
}

static bool read_one_advice(const cJSON *object, const DipCostReport *report,
                            DipCostAdvice *advice) {
    bool ok = true;
    *advice = (DipCostAdvice){
        .budget_ms = dip_json_number(object, "budget_ms", DIP_JSON_MAX_MS, &ok),
        .row = dip_json_integer(object, "row", -1, report->row_count - 1, &ok),
        .ms = dip_json_number(object, "ms", DIP_JSON_MAX_MS, &ok),
        .ms_low = dip_json_number(object, "ms_low", DIP_JSON_MAX_MS, &ok),
        .ms_high = dip_json_number(object, "ms_high", DIP_JSON_MAX_MS, &ok),
        .runner_up = -1,
    };
    if (cJSON_GetObjectItemCaseSensitive(object, "probability")) {
        advice->probability = dip_json_number(object, "probability", 1.0, &ok);
        advice->runner_up = dip_json_integer(object, "runner_up", -1, report->row_count - 1, &ok);
        advice->runner_up_probability = dip_json_number(object, "runner_up_probability", 1.0, &ok);
    }
    return ok;
}

void dip_cost_read_advice(const cJSON *root, DipCostReport *report) {
    const cJSON *object;
    cJSON_ArrayForEach(object, cJSON_GetObjectItemCaseSensitive(root, "advice")) {
        if (report->advice_count < DIP_COST_MAX_BUDGETS &&
            read_one_advice(object, report, &report->advice[report->advice_count])) {
            report->advice_count++;
        }
    }
}
