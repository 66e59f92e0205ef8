// Writing a comparison as JSON.
#include "app/cost/diff/diff.h"
#include "app/report/format/json_memory.h"
#include "app/files/whole_file.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <string.h>

static const char *const mark_names[] = {"same", "slower", "faster"};

// Takes ownership of an item, even if memory runs out.
static void add_to_array(cJSON *array, cJSON *item) {
    if (!cJSON_AddItemToArray(array, item)) {
        cJSON_Delete(item);
    }
}

// JSON has no infinity: a bound that is not finite is left out.
static void add_number(cJSON *to, const char *name, double value) {
    if (isfinite(value)) {
        cJSON_AddNumberToObject(to, name, value);
    }
}

static void add_estimate(cJSON *to, const char *name, const DipEstimate *estimate) {
    cJSON *object = cJSON_AddObjectToObject(to, name);
    add_number(object, "value", estimate->value);
    add_number(object, "low", estimate->low);
    add_number(object, "high", estimate->high);
}

static void add_sides(cJSON *root, const DipCostDiff *diff) {
    cJSON *sides = cJSON_AddArrayToObject(root, "sides");
    for (int side = 0; side < 2; side++) {
        cJSON *object = cJSON_CreateObject();
        cJSON_AddStringToObject(object, "name", diff->names[side]);
        cJSON_AddStringToObject(object, "build", diff->builds[side]);
        cJSON_AddStringToObject(object, "machine", diff->machines[side]);
        if (diff->has_times) {
            cJSON_AddStringToObject(object, "verdict",
                                    dip_cost_verdict_names[diff->verdicts[side]]);
            cJSON_AddStringToObject(object, "reason", diff->reasons[side]);
        }
        add_to_array(sides, object);
    }
}

static void add_times(cJSON *object, const DipCostDiff *diff, const DipCostDiffRow *row) {
    cJSON_AddStringToObject(object, "mark", mark_names[row->mark]);
    add_number(object, "a_ms", row->ms[0]);
    add_number(object, "b_ms", row->ms[1]);
    add_estimate(object, "change", &row->change);
    if (diff->kind == DIP_COST_DIFF_REPORTS) {
        add_estimate(object, "a_ratio", &row->ratios[0]);
        add_estimate(object, "b_ratio", &row->ratios[1]);
        return;
    }
    cJSON *stages = cJSON_AddObjectToObject(object, "stages");
    for (int stage = 0; stage < DIP_COST_DIFF_STAGES; stage++) {
        add_estimate(stages, dip_bench_stage_names[stage], &row->stages[stage]);
    }
}

static void add_differences(cJSON *object, const DipCostDiffRow *row) {
    cJSON *array = cJSON_AddArrayToObject(object, "differences");
    for (int q = 0; q < DIP_COST_DIFF_QUANTITY_COUNT; q++) {
        if (dip_cost_diff_differs(row, q)) {
            cJSON *difference = cJSON_CreateObject();
            cJSON_AddStringToObject(difference, "quantity", dip_cost_diff_title(q));
            add_number(difference, "a", row->values[0][q]);
            add_number(difference, "b", row->values[1][q]);
            add_number(difference, "growth", dip_cost_diff_growth(row, q));
            add_to_array(array, difference);
        }
    }
}

static void add_rows(cJSON *root, const DipCostDiff *diff) {
    cJSON *rows = cJSON_AddArrayToObject(root, "rows");
    for (int r = 0; r < diff->row_count; r++) {
        const DipCostDiffRow *row = &diff->rows[r];
        char settings[DIP_COST_TEXT];
        cJSON *object = cJSON_CreateObject();
        dip_cost_settings_text(&row->quality, settings);
        cJSON_AddStringToObject(object, "settings", settings);
        cJSON_AddStringToObject(object, "path", row->path);
        if (row->timed) {
            add_times(object, diff, row);
        }
        add_differences(object, row);
        add_to_array(rows, object);
    }
}

bool dip_cost_diff_write_json(const DipCostDiff *diff, const char *file, DipError *err) {
    dip_json_memory_begin();
    cJSON *root = cJSON_CreateObject();
    add_sides(root, diff);
    cJSON *notes = cJSON_AddArrayToObject(root, "notes");
    for (int i = 0; i < diff->note_count; i++) {
        add_to_array(notes, cJSON_CreateString(diff->notes[i]));
    }
    cJSON_AddBoolToObject(root, "busy", dip_cost_diff_is_busy(diff));
    cJSON_AddNumberToObject(root, "slower", diff->slower);
    cJSON_AddNumberToObject(root, "faster", diff->faster);
    cJSON_AddNumberToObject(root, "failed_times", diff->failed_times);
    cJSON_AddNumberToObject(root, "failed_errors", diff->failed_errors);
    cJSON_AddStringToObject(root, "cause", diff->cause);
    add_rows(root, diff);
    char *text = cJSON_Print(root);
    cJSON_Delete(root);
    const bool complete = text && !dip_json_memory_ran_out();
    const bool written = complete
                             ? dip_whole_file_write(file, text, strlen(text), err)
                             : dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory");
    cJSON_free(text);
    dip_json_memory_end();
    return written;
}
