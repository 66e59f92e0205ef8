// Writing a report as JSON.
#include "app/report/format/formats.h"

#include "app/report/fit.h"
#include "app/report/interaction.h"
#include "app/report/format/json_fields.h"
#include "app/report/format/json_memory.h"
#include "app/report/format/json_smaller.h"
#include "app/report/format/json_tail.h"
#include "app/report/viewpoints.h"
#include "app/files/whole_file.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// These two functions take ownership of an item, even if memory runs out. The object or array may
// be NULL. cJSON's own functions leave the item to the caller if they fail.
static void add_to_object(cJSON *object, const char *name, cJSON *item) {
    if (!cJSON_AddItemToObject(object, name, item)) {
        cJSON_Delete(item);
    }
}

static void add_to_array(cJSON *array, cJSON *item) {
    if (!cJSON_AddItemToArray(array, item)) {
        cJSON_Delete(item);
    }
}

static void add_sums(cJSON *to, const char *name, const DipMetricSums *sums) {
    double values[DIP_METRIC_SUM_COUNT];
    memcpy(values, sums, sizeof values);
    add_to_object(to, name, cJSON_CreateDoubleArray(values, DIP_METRIC_SUM_COUNT));
}

static void add_figures(cJSON *to, const DipMetricSums *sums) {
    for (int r = 0; r < DIP_METRIC_REGION_COUNT; r++) {
        const DipMetrics figures = dip_metrics_of(sums, r);
        cJSON *region = cJSON_AddObjectToObject(to, dip_metric_region_names[r]);
        cJSON_AddNumberToObject(region, "pixels", sums->regions[r].pixels);
        if (sums->regions[r].pixels > 0.0) {
            cJSON_AddNumberToObject(region, "rmse_lin", figures.rmse_lin);
            cJSON_AddNumberToObject(region, "psnr_db", figures.psnr_db);
            cJSON_AddNumberToObject(region, "ssim", figures.ssim);
            cJSON_AddNumberToObject(region, "flip", figures.flip);
        }
    }
}

static void add_flicker(cJSON *to, const DipMetricSums *sums) {
    const DipFlickerMetrics flicker = dip_flicker_metrics_of(sums);
    cJSON_AddNumberToObject(to, "static_rms_lin", flicker.steady);
    cJSON_AddNumberToObject(to, "flicker_rms_lin", flicker.flicker);
    cJSON_AddNumberToObject(to, "step_rms_lin", flicker.step);
    cJSON_AddNumberToObject(to, "two_frame_mean_rms_lin", flicker.two_mean);
}

static void add_estimate(cJSON *to, const char *name, const DipStatsEstimate *estimate) {
    char low[48], high[48];
    snprintf(low, sizeof low, "%s_low", name);
    snprintf(high, sizeof high, "%s_high", name);
    cJSON_AddNumberToObject(to, name, estimate->value);
    cJSON_AddNumberToObject(to, low, estimate->low);
    cJSON_AddNumberToObject(to, high, estimate->high);
}

// Adds the ends of the interval over runs, or null if too few runs are known.
static void add_over_runs(cJSON *to, const DipCostReport *report, const DipStatsEstimate *ratio) {
    DipStatsEstimate over_runs;
    if (dip_cost_ratio_over_runs(report, ratio, &over_runs)) {
        const double ends[2] = {over_runs.low, over_runs.high};
        cJSON_AddItemToObject(to, "ratio_over_runs", cJSON_CreateDoubleArray(ends, 2));
    } else {
        cJSON_AddNullToObject(to, "ratio_over_runs");
    }
}

// Adds an estimate of a metric. Without an interval, nothing is added.
static void add_metric(cJSON *to, const char *what, int metric, DipStatsEstimate estimate) {
    char name[40];
    if (isfinite(estimate.low) && isfinite(estimate.high)) {
        snprintf(name, sizeof name, "%s_%s", dip_cost_metric_names[metric], what);
        add_estimate(to, name, &estimate);
    }
}

static void add_errors(cJSON *object, const DipCostReport *report, int row) {
    int viewpoints;
    const DipMetricSums sums = dip_cost_row_sums(report, row, &viewpoints);
    cJSON *array = cJSON_AddArrayToObject(object, "places");
    for (int p = 0; p < report->options.places; p++) {
        if (report->rows[row].judged[p]) {
            cJSON *viewpoint = cJSON_CreateObject();
            cJSON_AddNumberToObject(viewpoint, "place", p);
            cJSON_AddStringToObject(viewpoint, "pictures", report->rows[row].pictures[p]);
            add_sums(viewpoint, "sums", &report->rows[row].viewpoints[p]);
            dip_cost_tail_add(viewpoint, &report->rows[row].tails[p]);
            add_to_array(array, viewpoint);
        }
    }
    if (viewpoints > 0) {
        add_figures(cJSON_AddObjectToObject(object, "figures"), &sums);
        add_flicker(cJSON_AddObjectToObject(object, "over_time"), &sums);
        for (int m = 0; viewpoints > 1 && m < DIP_COST_METRIC_COUNT; m++) {
            add_metric(object, "of_viewpoints", m, dip_cost_metric(report, row, (DipCostMetric)m));
        }
        const DipCostTail tail = dip_cost_row_tail(report, row);
        if (tail.viewpoints > 0) {
            cJSON_AddNumberToObject(dip_cost_tail_add(object, &tail.flip), "worst_viewpoint",
                                    tail.worst_viewpoint);
        }
        cJSON_AddBoolToObject(object, "at_floor", dip_cost_at_floor(report, row));
    }
}

static void add_times(cJSON *object, const DipCostReport *report, int row) {
    if (!dip_cost_is_timed(report, row)) {
        return;
    }
    const DipPathEstimate *time = &report->rows[row].time;
    add_estimate(object, "ms", &time->mean_ms);
    add_estimate(object, "p95_ms", &time->p95_ms);
    add_estimate(object, "worst_ms", &time->worst_ms);
    cJSON *stages = cJSON_AddObjectToObject(object, "stages_ms");
    for (int i = 0; i < DIP_COST_STAGE_COUNT; i++) {
        cJSON_AddNumberToObject(stages, dip_cost_stage_names[i], report->rows[row].stage_ms[i]);
    }
    cJSON *counters = cJSON_AddObjectToObject(object, "counters");
    for (int c = 0; c < DIP_COST_COUNTER_COUNT; c++) {
        cJSON_AddNumberToObject(counters, dip_cost_counter_names[c], report->rows[row].counters[c]);
    }
    cJSON *pairs = cJSON_AddObjectToObject(object, "pairs");
#define ADD_PAIRS(field)                                                                           \
    cJSON *field = cJSON_AddArrayToObject(pairs, #field);                                          \
    for (int f = 0; f < dip_cost_frame_count(report); f++) {                                       \
        add_to_array(field, cJSON_CreateNumber(report->rows[row].pairs[f].field));                 \
    }
    DIP_COST_PAIR_FIELDS(ADD_PAIRS)
#undef ADD_PAIRS
}

static void add_rows(cJSON *root, const DipCostReport *report) {
    cJSON *rows = cJSON_AddArrayToObject(root, "rows");
    for (int r = 0; r < report->row_count; r++) {
        char settings[256];
        char text[DIP_COST_TEXT];
        cJSON *object = cJSON_CreateObject();
        dip_quality_format(&report->rows[r].quality, settings, sizeof settings);
        dip_cost_settings_text(&report->rows[r].quality, text);
        cJSON_AddStringToObject(object, "settings", settings);
        cJSON_AddStringToObject(object, "text", text);
        cJSON_AddNumberToObject(object, "path", report->rows[r].path);
        add_errors(object, report, r);
        add_times(object, report, r);
        add_to_array(rows, object);
    }
}

static void add_same(cJSON *root, const DipCostReport *report) {
    cJSON *same = cJSON_AddArrayToObject(root, "same_pictures");
    for (int i = 0; i < report->same_count; i++) {
        char settings[256];
        cJSON *object = cJSON_CreateObject();
        dip_quality_format(&report->same[i].quality, settings, sizeof settings);
        cJSON_AddStringToObject(object, "settings", settings);
        cJSON_AddNumberToObject(object, "row", report->same[i].row);
        add_to_array(same, object);
    }
}

static void add_interactions(cJSON *root, const DipCostReport *report) {
    DipCostInteraction list[DIP_COST_MAX_INTERACTIONS];
    const int count = dip_cost_interactions(report, list);
    cJSON *array = cJSON_AddArrayToObject(root, "interactions");
    for (int i = 0; i < count; i++) {
        cJSON *object = cJSON_CreateObject();
        cJSON_AddStringToObject(object, "a", dip_setting_info(list[i].a)->key);
        cJSON_AddStringToObject(object, "b", dip_setting_info(list[i].b)->key);
        cJSON_AddNumberToObject(object, "combinations", list[i].contexts);
        cJSON_AddNumberToObject(object, "flip", list[i].flip);
        cJSON_AddNumberToObject(object, "time", list[i].time);
        add_to_array(array, object);
    }
}

static void add_sweeps(cJSON *root, const DipCostReport *report) {
    cJSON *sweeps = cJSON_AddArrayToObject(root, "sweeps");
    for (int s = 0; s < report->sweep_count; s++) {
        const DipCostSweep *sweep = &report->sweeps[s];
        cJSON *object = cJSON_CreateObject();
        char title[DIP_COST_TEXT];
        dip_cost_sweep_title(report, sweep, title);
        cJSON_AddStringToObject(object, "title", title);
        cJSON_AddStringToObject(object, "setting", dip_setting_info(sweep->setting)->key);
        cJSON_AddNumberToObject(object, "path", sweep->path);
        cJSON_AddNumberToObject(object, "base", sweep->base);
        cJSON *steps = cJSON_AddArrayToObject(object, "steps");
        for (int i = 0; i < sweep->row_count; i++) {
            cJSON *step = cJSON_CreateObject();
            cJSON_AddNumberToObject(step, "row", sweep->rows[i]);
            if (dip_cost_is_timed(report, sweep->rows[i])) {
                add_estimate(step, "ratio", &sweep->ratios[i]);
                add_over_runs(step, report, &sweep->ratios[i]);
            }
            for (int m = 0; m < DIP_COST_METRIC_COUNT; m++) {
                add_metric(
                    step, "change", m,
                    dip_cost_metric_change(report, sweep->rows[i], sweep->base, (DipCostMetric)m));
            }
            add_to_array(steps, step);
        }
        add_to_array(sweeps, object);
    }
}

static void add_floors(cJSON *root, const DipCostReport *report) {
    cJSON *floors = cJSON_AddArrayToObject(root, "floors");
    for (int path = 0; path < report->path_count; path++) {
        for (int p = 0; p < report->options.places; p++) {
            const int index = path * report->options.places + p;
            if (report->has_floor[index]) {
                cJSON *object = cJSON_CreateObject();
                cJSON_AddNumberToObject(object, "path", path);
                cJSON_AddNumberToObject(object, "place", p);
                add_sums(object, "half_against_half", &report->floors[index]);
                add_to_array(floors, object);
            }
        }
    }
}

static void add_fit(cJSON *root, const DipCostReport *report) {
    const DipCostFit fit = dip_cost_fit(report);
    if (fit.rows == 0) {
        return;
    }
    cJSON *object = cJSON_AddObjectToObject(root, "fit");
    cJSON *costs = cJSON_AddObjectToObject(object, "ns_per");
    cJSON *stage = NULL;
    for (int i = 0; i < fit.count; i++) {
        if (i == 0 || fit.stages[i] != fit.stages[i - 1]) {
            stage = cJSON_AddObjectToObject(costs, fit.stages[i]);
        }
        cJSON_AddNumberToObject(stage, fit.names[i], fit.ns[i]);
    }
    cJSON_AddNumberToObject(object, "r2", fit.r2);
    cJSON_AddNumberToObject(object, "median_miss", fit.median_miss);
    cJSON_AddNumberToObject(object, "median_miss_of_others", fit.others.median);
    cJSON_AddNumberToObject(object, "within_10_percent_of_others", fit.others.within_10);
}

static void add_misses(cJSON *to, const char *name, const DipCostMisses *misses) {
    cJSON *object = cJSON_AddObjectToObject(to, name);
    cJSON_AddNumberToObject(object, "rows", misses->rows);
    cJSON_AddNumberToObject(object, "median", misses->median);
    cJSON_AddNumberToObject(object, "p90", misses->p90);
    cJSON_AddNumberToObject(object, "within_5_percent", misses->within_5);
    cJSON_AddNumberToObject(object, "within_10_percent", misses->within_10);
}

static void add_predictions(cJSON *root, const DipCostReport *report) {
    const DipCostPredictions *predicted = &report->predicted;
    if (predicted->count == 0) {
        return;
    }
    cJSON *object = cJSON_AddObjectToObject(root, "predicted");
    cJSON_AddNumberToObject(object, "trained", predicted->trained);
    cJSON *misses = cJSON_AddObjectToObject(object, "misses");
    add_misses(misses, "times", &predicted->times);
    add_misses(misses, "flip", &predicted->errors);
    add_misses(misses, "times_left_out", &predicted->times_left_out);
    add_misses(misses, "flip_left_out", &predicted->errors_left_out);
    cJSON *list = cJSON_AddArrayToObject(object, "combinations");
    for (int i = 0; i < predicted->count; i++) {
        const DipCostPrediction *p = &predicted->list[i];
        char settings[256];
        cJSON *item = cJSON_CreateObject();
        dip_quality_format(&p->quality, settings, sizeof settings);
        cJSON_AddStringToObject(item, "settings", settings);
        cJSON_AddNumberToObject(item, "ms", p->ms);
        cJSON_AddNumberToObject(item, "p95_ms", p->p95_ms);
        cJSON_AddNumberToObject(item, "flip", p->flip);
        cJSON_AddNumberToObject(item, "row", p->row);
        add_to_array(list, item);
    }
}

static void add_advice(cJSON *root, const DipCostReport *report) {
    cJSON *advice = cJSON_AddArrayToObject(root, "advice");
    for (int i = 0; i < report->advice_count; i++) {
        const DipCostAdvice *a = &report->advice[i];
        cJSON *object = cJSON_CreateObject();
        cJSON_AddNumberToObject(object, "budget_ms", a->budget_ms);
        cJSON_AddNumberToObject(object, "row", a->row);
        cJSON_AddNumberToObject(object, "ms", a->ms);
        cJSON_AddNumberToObject(object, "ms_low", a->ms_low);
        cJSON_AddNumberToObject(object, "ms_high", a->ms_high);
        cJSON_AddNumberToObject(object, "probability", a->probability);
        cJSON_AddNumberToObject(object, "runner_up", a->runner_up);
        cJSON_AddNumberToObject(object, "runner_up_probability", a->runner_up_probability);
        add_to_array(advice, object);
    }
}

// What the timing tells about the machine.
static void add_machine(cJSON *root, const DipCostReport *report) {
    if (report->rounds == 0) {
        return;
    }
    cJSON *machine = cJSON_AddObjectToObject(root, "machine");
    cJSON_AddStringToObject(machine, "verdict", dip_cost_verdict_names[report->verdict]);
    cJSON_AddStringToObject(machine, "reason", report->verdict_reason);
    cJSON_AddNumberToObject(machine, "wait", report->machine.wait);
    cJSON_AddNumberToObject(machine, "repeated", (double)report->machine.repeated);
    cJSON_AddBoolToObject(machine, "has_wait", report->machine.has_wait);
    cJSON_AddBoolToObject(machine, "settled", report->machine.settled);
    cJSON *level = cJSON_AddObjectToObject(machine, "runs");
    cJSON_AddNumberToObject(level, "runs", report->level_spread.runs);
    cJSON_AddNumberToObject(level, "least_ms", report->level_spread.least_ms);
    cJSON_AddNumberToObject(level, "most_ms", report->level_spread.most_ms);
    cJSON_AddNumberToObject(level, "deviation", report->level_spread.deviation);
    cJSON_AddNumberToObject(level, "factor", report->level_spread.factor);
    cJSON_AddNumberToObject(level, "ratio_deviation", report->level_spread.ratio_deviation);
    cJSON_AddNumberToObject(level, "ratio_factor", report->level_spread.ratio_factor);
}

// Adds the noise floor of a path's truths in every metric.
static void add_floor(cJSON *to, const DipCostReport *report, int path) {
    const DipMetrics noise = dip_cost_floor_metrics(report, path);
    cJSON *object = cJSON_AddObjectToObject(to, "floor");
    cJSON_AddNumberToObject(object, "rmse_lin", noise.rmse_lin);
    cJSON_AddNumberToObject(object, "psnr_db", noise.psnr_db);
    cJSON_AddNumberToObject(object, "ssim", noise.ssim);
    cJSON_AddNumberToObject(object, "flip", noise.flip);
}

static void add_header(cJSON *root, const DipCostReport *report) {
    char baseline[256];
    cJSON_AddNumberToObject(root, "format", DIP_COST_JSON_FORMAT);
#define ADD_TEXT(field) cJSON_AddStringToObject(root, #field, report->field);
    DIP_COST_HEADER_TEXTS(ADD_TEXT)
#undef ADD_TEXT
    if (report->date[0]) {
        cJSON_AddStringToObject(root, "date", report->date);
    }
#define ADD_NUMBER(field, most) cJSON_AddNumberToObject(root, #field, report->field);
    DIP_COST_HEADER_NUMBERS(ADD_NUMBER)
#undef ADD_NUMBER
#define ADD_OPTION(field, most) cJSON_AddNumberToObject(root, #field, report->options.field);
    DIP_COST_OPTION_NUMBERS(ADD_OPTION)
#undef ADD_OPTION
    cJSON_AddNumberToObject(root, "pixels_per_degree", report->options.pixels_per_degree);
    dip_quality_format(&report->options.baseline, baseline, sizeof baseline);
    cJSON_AddStringToObject(root, "baseline", baseline);
    cJSON *paths = cJSON_AddArrayToObject(root, "paths");
    for (int p = 0; p < report->path_count; p++) {
        cJSON *path = cJSON_CreateObject();
        cJSON_AddStringToObject(path, "name", report->paths[p]);
        cJSON_AddStringToObject(path, "poses", report->path_hashes[p]);
        cJSON_AddNumberToObject(path, "base_row", report->base_rows[p]);
        cJSON_AddNumberToObject(path, "same_row", report->same_rows[p]);
        add_floor(path, report, p);
        add_to_array(paths, path);
    }
    add_machine(root, report);
    cJSON *refused = cJSON_AddArrayToObject(root, "left_out");
    for (int i = 0; i < report->refused_count; i++) {
        add_to_array(refused, cJSON_CreateString(report->refused[i]));
    }
}

bool dip_cost_write_json(const DipCostReport *report, const char *file, DipError *err) {
    dip_json_memory_begin();
    cJSON *root = cJSON_CreateObject();
    add_header(root, report);
    add_floors(root, report);
    add_rows(root, report);
    add_same(root, report);
    add_sweeps(root, report);
    add_interactions(root, report);
    add_fit(root, report);
    add_predictions(root, report);
    dip_cost_smaller_add(root, report);
    add_advice(root, report);
    char *text = cJSON_PrintUnformatted(root);
    cJSON_Delete(root);
    const bool complete = !dip_json_memory_ran_out();
    const bool written = complete && text
                             ? dip_whole_file_write(file, text, strlen(text), err)
                             : dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory");
    cJSON_free(text);
    dip_json_memory_end();
    return written;
}
