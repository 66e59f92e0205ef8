// Writing the rows of `diptych cost axes` as JSON.
#include "app/cost/axes/axes.h"

#include "app/report/format/json_memory.h"
#include "app/report/viewpoints.h"
#include "app/files/whole_file.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <string.h>

enum { JSON_FORMAT = 1 };

// Takes ownership of an item, even if memory runs out.
static void add_to_array(cJSON *array, cJSON *item) {
    if (!cJSON_AddItemToArray(array, item)) {
        cJSON_Delete(item);
    }
}

// JSON has no infinity and no NAN: what is not known is left out.
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

static void add_heading(cJSON *root, const DipCostAxes *axes) {
    const DipCostReport *report = &axes->report;
    const DipCostOptions *o = &report->options;
    char settings[DIP_COST_TEXT];
    dip_cost_settings_text(&o->baseline, settings);
    cJSON_AddStringToObject(root, "what", "diptych cost axes");
    cJSON_AddNumberToObject(root, "format", JSON_FORMAT);
    cJSON_AddStringToObject(root, "version", report->version);
    cJSON_AddStringToObject(root, "build", report->build);
    cJSON_AddStringToObject(root, "date", report->date);
    cJSON_AddStringToObject(root, "scene", report->scene);
    cJSON_AddStringToObject(root, "scene_hash", report->scene_hash);
    cJSON_AddStringToObject(root, "path", report->paths[0]);
    cJSON_AddStringToObject(root, "processor", report->processor);
    cJSON_AddStringToObject(root, "settings", settings);
    cJSON_AddNumberToObject(root, "rounds", o->rounds);
    cJSON_AddNumberToObject(root, "timed_frames", o->timed_frames);
    cJSON_AddNumberToObject(root, "seed", o->seed);
    cJSON_AddNumberToObject(root, "places", o->end_place);
    cJSON_AddNumberToObject(root, "samples", o->samples);
    cJSON_AddNumberToObject(root, "pixels_per_degree", o->pixels_per_degree);
    cJSON_AddStringToObject(root, "verdict", dip_cost_verdict_names[report->verdict]);
    cJSON_AddStringToObject(root, "reason", report->verdict_reason);
    add_number(root, "wait", report->machine.wait);
    cJSON_AddStringToObject(root, "energy", axes->energy);
    cJSON_AddStringToObject(root, "note", axes->note);
    add_number(root, "scene_texture_bytes", (double)axes->scene_texture_bytes);
    add_number(root, "checked_pictures", (double)axes->checked_pictures);
}

static void add_errors(cJSON *object, const DipCostReport *report, int row) {
    if (!report->rows[row].judged[0]) {
        return;
    }
    cJSON *errors = cJSON_AddObjectToObject(object, "errors");
    for (int m = 0; m < DIP_COST_METRIC_COUNT; m++) {
        if (m != DIP_COST_FLICKER) { // A burst of one frame has no flicker.
            const DipEstimate value = dip_cost_metric(report, row, (DipCostMetric)m);
            add_estimate(errors, dip_cost_metric_names[m], &value);
        }
    }
    if (row > 0) {
        const DipEstimate flip = dip_cost_metric_change(report, row, 0, DIP_COST_FLIP);
        const DipEstimate rmse = dip_cost_metric_change(report, row, 0, DIP_COST_RMSE);
        add_estimate(errors, "flip_change", &flip);
        add_estimate(errors, "rmse_lin_change", &rmse);
    }
}

// The times of all frames, in the order of the path.
static void add_pairs(cJSON *object, const DipCostReport *report, int row) {
    cJSON *ms = cJSON_AddArrayToObject(object, "frame_ms");
    cJSON *base = cJSON_AddArrayToObject(object, "frame_base_ms");
    cJSON *wait = cJSON_AddArrayToObject(object, "frame_wait");
    for (int f = 0; f < dip_cost_frame_count(report); f++) {
        const DipTimePair *pair = &report->rows[row].pairs[f];
        add_to_array(ms, cJSON_CreateNumber(pair->ms));
        add_to_array(base, cJSON_CreateNumber(pair->base_ms));
        add_to_array(wait, cJSON_CreateNumber(pair->wait));
    }
}

static void add_counters(cJSON *object, const DipCostReport *report, int row) {
    cJSON *counters = cJSON_AddObjectToObject(object, "counters");
    for (int c = 0; c < DIP_COST_COUNTER_COUNT; c++) {
        add_number(counters, dip_cost_counter_names[c], report->rows[row].counters[c]);
    }
}

static cJSON *make_row(const DipCostAxes *axes, int row) {
    const DipCostAxisRow *r = &axes->rows[row];
    const DipCostReport *report = &axes->report;
    const DipPathEstimate *time = &report->rows[row].time;
    cJSON *object = cJSON_CreateObject();
    cJSON_AddStringToObject(object, "axis", dip_cost_axis_names[r->axis]);
    cJSON_AddStringToObject(object, "value", r->name);
    cJSON_AddNumberToObject(object, "width", r->width);
    cJSON_AddNumberToObject(object, "height", r->height);
    cJSON_AddNumberToObject(object, "shown_width", r->shown_width);
    cJSON_AddNumberToObject(object, "shown_height", r->shown_height);
    cJSON_AddNumberToObject(object, "threads", r->threads);
    cJSON_AddStringToObject(object, "isa", dip_isa_name(r->isa));
    add_estimate(object, "ms", &time->mean_ms);
    add_estimate(object, "ratio", &time->ratio);
    add_number(object, "ns_per_pixel",
               1e6 * time->mean_ms.value / ((double)r->shown_width * r->shown_height));
    add_number(object, "memory_bytes", r->memory_bytes);
    add_number(object, "frame_mj", r->frame_mj);
    if (r->axis == DIP_COST_AXIS_SCALE) {
        add_number(object, "draw_ms", report->rows[row].stage_ms[0]);
        add_number(object, "enlarge_ms", report->rows[row].stage_ms[1]);
    }
    if (r->axis == DIP_COST_AXIS_THREADS) {
        add_estimate(object, "speed_up", &r->speed_up);
        add_number(object, "efficiency", r->efficiency);
    }
    add_errors(object, report, row);
    add_counters(object, report, row);
    add_pairs(object, report, row);
    return object;
}

bool dip_cost_axes_write_json(const DipCostAxes *axes, const char *file, DipError *err) {
    dip_json_memory_begin();
    cJSON *root = cJSON_CreateObject();
    add_heading(root, axes);
    cJSON *rows = cJSON_AddArrayToObject(root, "rows");
    for (int row = 0; row < axes->report.row_count; row++) {
        add_to_array(rows, make_row(axes, row));
    }
    char *text = cJSON_PrintUnformatted(root);
    cJSON_Delete(root);
    const bool complete = text && !dip_json_memory_ran_out();
    const bool written = complete
                             ? dip_whole_file_write(file, text, strlen(text), err)
                             : dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory");
    cJSON_free(text);
    dip_json_memory_end();
    return written;
}
