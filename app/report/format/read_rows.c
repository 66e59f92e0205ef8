// Reading the rows of a report from JSON: settings, errors, times and counters.
#include "app/report/format/read_parts.h"

#include "app/report/format/json_fields.h"
#include "app/report/format/json_read.h"
#include "app/report/format/json_tail.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stddef.h>
#include <string.h>

// True if there are no or at least one counted things (pixels or bursts), and if the mean of the
// sum over them is possible.
static bool is_sum(double sum, double count) {
    return (count == 0.0 || count >= 1.0) && fabs(sum) <= DIP_JSON_MAX_MEAN * count;
}

static bool are_sums(const DipMetricSums *sums) {
    const double bursts = sums->bursts;
    bool ok = is_sum(sums->squared_static, bursts) && is_sum(sums->squared_flicker, bursts) &&
              is_sum(sums->squared_step, bursts) && is_sum(sums->squared_two_mean, bursts);
    for (int i = 0; i < DIP_METRIC_REGION_COUNT; i++) {
        const DipMetricRegionSums *region = &sums->regions[i];
        ok = ok && is_sum(region->squared_lin, region->pixels) &&
             is_sum(region->squared_codes, region->pixels) &&
             is_sum(region->flip, region->pixels) && is_sum(region->ssim, region->ssim_pixels);
    }
    return ok;
}

bool dip_cost_read_sums(const cJSON *object, const char *name, DipMetricSums *sums) {
    double values[DIP_METRIC_SUM_COUNT];
    const double most = DIP_JSON_MAX_MEAN * DIP_JSON_MAX_COUNT;
    if (!dip_json_numbers(cJSON_GetObjectItemCaseSensitive(object, name), DIP_METRIC_SUM_COUNT,
                          -most, most, values)) {
        return false;
    }
    memcpy(sums, values, sizeof values);
    return are_sums(sums);
}

// Reads the array `name` into the field of each pair that is `offset` bytes from the pair's start.
static bool read_pair_field(const cJSON *object, const char *name, int frames, DipTimePair *pairs,
                            size_t offset) {
    const cJSON *array = cJSON_GetObjectItemCaseSensitive(object, name);
    const cJSON *item;
    if (!cJSON_IsArray(array) || cJSON_GetArraySize(array) != frames) {
        return false;
    }
    cJSON_ArrayForEach(item, array) {
        if (!cJSON_IsNumber(item) ||
            !(item->valuedouble >= 0.0 && item->valuedouble <= DIP_JSON_MAX_MS)) {
            return false;
        }
        memcpy((char *)pairs++ + offset, &item->valuedouble, sizeof item->valuedouble);
    }
    return true;
}

static bool read_pairs(const cJSON *object, int frames, DipTimePair *pairs) {
    bool ok = true;
#define READ_PAIRS(field)                                                                          \
    ok = ok && read_pair_field(object, #field, frames, pairs, offsetof(DipTimePair, field));
    DIP_COST_PAIR_FIELDS(READ_PAIRS)
#undef READ_PAIRS
    for (int f = 0; ok && f < frames; f++) {
        ok = pairs[f].ms >= DIP_JSON_MIN_MS && pairs[f].base_ms >= DIP_JSON_MIN_MS;
    }
    return ok;
}

static bool read_row(const cJSON *object, DipCostReport *report, DipCostRow *row) {
    bool ok = true;
    const cJSON *settings = cJSON_GetObjectItemCaseSensitive(object, "settings");
    row->path = dip_json_integer(object, "path", 0, report->path_count - 1, &ok);
    ok = ok && cJSON_IsString(settings) &&
         dip_quality_parse(settings->valuestring, &row->quality, NULL);
    const cJSON *viewpoint;
    cJSON_ArrayForEach(viewpoint, cJSON_GetObjectItemCaseSensitive(object, "places")) {
        const int p = dip_json_integer(viewpoint, "place", 0, report->options.places - 1, &ok);
        if (!ok || !dip_cost_read_sums(viewpoint, "sums", &row->viewpoints[p]) ||
            !dip_cost_tail_read(viewpoint, &row->tails[p])) {
            return false;
        }
        row->judged[p] = true;
        const cJSON *pictures = cJSON_GetObjectItemCaseSensitive(viewpoint, "pictures");
        if (pictures) {
            dip_json_copy_text(pictures, row->pictures[p], sizeof row->pictures[p], &ok);
        }
    }
    if (ok && report->rounds > 0) {
        const cJSON *counters = cJSON_GetObjectItemCaseSensitive(object, "counters");
        for (int c = 0; c < DIP_COST_COUNTER_COUNT; c++) {
            row->counters[c] =
                dip_json_number(counters, dip_cost_counter_names[c], DIP_JSON_MAX_COUNT, &ok);
        }
        const cJSON *stages = cJSON_GetObjectItemCaseSensitive(object, "stages_ms");
        for (int i = 0; stages && i < DIP_COST_STAGE_COUNT; i++) {
            row->stage_ms[i] =
                dip_json_number(stages, dip_cost_stage_names[i], DIP_JSON_MAX_MS, &ok);
        }
        ok = ok && read_pairs(cJSON_GetObjectItemCaseSensitive(object, "pairs"),
                              dip_cost_frame_count(report), row->pairs);
    }
    return ok;
}

bool dip_cost_read_rows(const cJSON *root, DipCostReport *report) {
    const cJSON *object;
    int row = 0;
    cJSON_ArrayForEach(object, cJSON_GetObjectItemCaseSensitive(root, "rows")) {
        if (!read_row(object, report, &report->rows[row++])) {
            return false;
        }
    }
    bool ok = report->combined_first <= row;
    for (int p = 0; p < report->path_count; p++) {
        ok = ok && report->base_rows[p] < row && report->same_rows[p] < row &&
             report->rows[report->base_rows[p]].path == p &&
             report->rows[report->same_rows[p]].path == p;
    }
    return ok;
}
