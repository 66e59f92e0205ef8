// Writing and reading the combinations that were timed at a smaller size.
#include "app/report/format/json_smaller.h"

#include "app/report/format/json_read.h"

#include <cjson/cJSON.h>

#include <math.h>

enum { MOST_SIDE = 16384 }; // Pixels.

// An end that no reader accepts tells nothing.
static double end_of(double high) {
    return high <= DIP_JSON_MAX_MS ? high : NAN;
}

void dip_cost_elsewhere_add_times(struct cJSON *object, const DipCostElsewhere *row) {
    cJSON_AddNumberToObject(object, "ms", row->ms.value);
    // cJSON writes null for what is not a number, which stands for an end that is not known.
    cJSON_AddNumberToObject(object, "ms_low", row->ms.low);
    cJSON_AddNumberToObject(object, "ms_high", end_of(row->ms.high));
    cJSON *stages = cJSON_AddObjectToObject(object, "stages_ms");
    for (int i = 0; i < DIP_COST_STAGE_COUNT; i++) {
        cJSON_AddNumberToObject(stages, dip_cost_stage_names[i], row->stage_ms[i]);
    }
    cJSON *counters = cJSON_AddObjectToObject(object, "counters");
    for (int c = 0; c < DIP_COST_COUNTER_COUNT; c++) {
        cJSON_AddNumberToObject(counters, dip_cost_counter_names[c], row->counters[c]);
    }
}

static void add_combination(cJSON *list, const DipCostElsewhere *row) {
    char settings[256];
    cJSON *object = cJSON_CreateObject();
    dip_quality_format(&row->quality, settings, sizeof settings);
    cJSON_AddStringToObject(object, "settings", settings);
    dip_cost_elsewhere_add_times(object, row);
    if (!cJSON_AddItemToArray(list, object)) {
        cJSON_Delete(object);
    }
}

void dip_cost_smaller_add(struct cJSON *root, const DipCostReport *report) {
    if (report->smaller_count == 0) {
        return;
    }
    cJSON *smaller = cJSON_AddObjectToObject(root, "smaller");
    cJSON_AddNumberToObject(smaller, "width", report->smaller_width);
    cJSON_AddNumberToObject(smaller, "height", report->smaller_height);
    cJSON *list = cJSON_AddArrayToObject(smaller, "combinations");
    for (int i = 0; i < report->smaller_count; i++) {
        add_combination(list, &report->smaller[i]);
    }
}

static double read_end(const cJSON *object, const char *name, bool *ok) {
    const bool known = !cJSON_IsNull(cJSON_GetObjectItemCaseSensitive(object, name));
    return known ? dip_json_number(object, name, DIP_JSON_MAX_MS, ok) : NAN;
}

bool dip_cost_elsewhere_read_times(const struct cJSON *object, DipCostElsewhere *row) {
    bool ok = true;
    const cJSON *stages = cJSON_GetObjectItemCaseSensitive(object, "stages_ms");
    const cJSON *counters = cJSON_GetObjectItemCaseSensitive(object, "counters");
    row->ms.value = dip_json_number(object, "ms", DIP_JSON_MAX_MS, &ok);
    row->ms = dip_estimate_unknown(row->ms.value);
    row->ms.low = read_end(object, "ms_low", &ok);
    row->ms.high = read_end(object, "ms_high", &ok);
    for (int i = 0; i < DIP_COST_STAGE_COUNT; i++) {
        row->stage_ms[i] = dip_json_number(stages, dip_cost_stage_names[i], DIP_JSON_MAX_MS, &ok);
    }
    for (int c = 0; c < DIP_COST_COUNTER_COUNT; c++) {
        row->counters[c] =
            dip_json_number(counters, dip_cost_counter_names[c], DIP_JSON_MAX_COUNT, &ok);
    }
    return ok && row->ms.value >= DIP_JSON_MIN_MS;
}

static bool read_combination(const cJSON *object, DipCostElsewhere *row) {
    const cJSON *settings = cJSON_GetObjectItemCaseSensitive(object, "settings");
    return cJSON_IsString(settings) &&
           dip_quality_parse(settings->valuestring, &row->quality, NULL) &&
           dip_cost_elsewhere_read_times(object, row);
}

bool dip_cost_smaller_read(const struct cJSON *root, DipCostReport *report) {
    bool ok = true;
    const cJSON *smaller = cJSON_GetObjectItemCaseSensitive(root, "smaller");
    if (!smaller) {
        return true;
    }
    report->smaller_width = dip_json_integer(smaller, "width", 1, MOST_SIDE, &ok);
    report->smaller_height = dip_json_integer(smaller, "height", 1, MOST_SIDE, &ok);
    const cJSON *object;
    cJSON_ArrayForEach(object, cJSON_GetObjectItemCaseSensitive(smaller, "combinations")) {
        if (report->smaller_count == DIP_COST_MAX_SMALLER ||
            !read_combination(object, &report->smaller[report->smaller_count])) {
            return false;
        }
        report->smaller_count++;
    }
    return ok && report->smaller_count > 0;
}
