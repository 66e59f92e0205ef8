// Reading the predictions and the budgets of a report from JSON. Advice is computed again.
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

void dip_cost_read_advice(const cJSON *root, DipCostReport *report) {
    DipCostOptions *options = &report->options;
    const cJSON *object;
    cJSON_ArrayForEach(object, cJSON_GetObjectItemCaseSensitive(root, "advice")) {
        bool ok = true;
        const double ms = dip_json_number(object, "budget_ms", DIP_JSON_MAX_MS, &ok);
        if (ok && ms > 0.0 && options->budget_count < DIP_COST_MAX_BUDGETS) {
            options->budgets_ms[options->budget_count++] = ms;
        }
    }
}
