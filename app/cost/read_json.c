// Reading a report from JSON.
#include "app/cost/formats.h"

#include "app/cost/json_fields.h"
#include "app/cost/json_memory.h"
#include "app/cost/json_tail.h"
#include "renderer/base/file.h"

#include <cjson/cJSON.h>
#include <limits.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_FILE_BYTES = 1 << 29 };

// Ranges of measurements, far beyond what can be measured. They keep all values that are computed
// from measurements finite.
static const double min_ms = 1e-6;
static const double max_ms = 1e9;
static const double max_count = 1e15;
static const double max_mean = 1e6;

static bool missing(const char *file, const char *what, DipError *err) {
    return dip_error_set(err, DIP_ERROR_FORMAT, file, 0, what,
                         "is missing, or is not what `diptych cost` writes");
}

// --- fields ------------------------------------------------------------------------------------

// Reads a whole number in least..most. Sets *ok to false and returns -1 if there is none.
static int integer(const cJSON *object, const char *name, int least, int most, bool *ok) {
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, name);
    const bool good = cJSON_IsNumber(item) && item->valuedouble >= least &&
                      item->valuedouble <= most && floor(item->valuedouble) == item->valuedouble;
    *ok = *ok && good;
    return good ? (int)item->valuedouble : -1;
}

// Returns a number, or 0 if there is none. A number outside of 0..most sets *ok to false.
static double number(const cJSON *object, const char *name, double most, bool *ok) {
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, name);
    const double value = cJSON_IsNumber(item) ? item->valuedouble : 0.0;
    *ok = *ok && value >= 0.0 && value <= most;
    return value;
}

static void copy_text(const cJSON *item, char *to, size_t size, bool *ok) {
    if (cJSON_IsString(item)) {
        snprintf(to, size, "%s", item->valuestring);
    } else {
        *ok = false;
    }
}

// Reads an array of exactly `count` numbers in least..most.
static bool numbers(const cJSON *array, int count, double least, double most, double *to) {
    if (!cJSON_IsArray(array) || cJSON_GetArraySize(array) != count) {
        return false;
    }
    const cJSON *item;
    cJSON_ArrayForEach(item, array) {
        if (!cJSON_IsNumber(item) || !(item->valuedouble >= least && item->valuedouble <= most)) {
            return false;
        }
        *to++ = item->valuedouble;
    }
    return true;
}

// True if there are no or at least one counted things (pixels or bursts), and if the mean of the
// sum over them is possible.
static bool is_sum(double sum, double count) {
    return (count == 0.0 || count >= 1.0) && fabs(sum) <= max_mean * count;
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

static bool read_sums(const cJSON *object, const char *name, DipMetricSums *sums) {
    double values[DIP_METRIC_SUM_COUNT];
    const double most = max_mean * max_count;
    if (!numbers(cJSON_GetObjectItemCaseSensitive(object, name), DIP_METRIC_SUM_COUNT, -most, most,
                 values)) {
        return false;
    }
    memcpy(sums, values, sizeof values);
    return are_sums(sums);
}

// --- parts -------------------------------------------------------------------------------------

static bool read_paths(const cJSON *root, DipCostReport *report) {
    bool ok = true;
    const cJSON *item;
    cJSON_ArrayForEach(item, cJSON_GetObjectItemCaseSensitive(root, "paths")) {
        const int p = report->path_count;
        if (p == DIP_COST_MAX_PATHS) {
            return false;
        }
        copy_text(cJSON_GetObjectItemCaseSensitive(item, "name"), report->paths[p],
                  sizeof report->paths[p], &ok);
        copy_text(cJSON_GetObjectItemCaseSensitive(item, "poses"), report->path_hashes[p],
                  sizeof report->path_hashes[p], &ok);
        report->base_rows[p] = integer(item, "base_row", 0, DIP_COST_MAX_ROWS - 1, &ok);
        report->same_rows[p] = integer(item, "same_row", 0, DIP_COST_MAX_ROWS - 1, &ok);
        report->path_count++;
    }
    return ok;
}

static bool read_machine(const cJSON *root, DipCostReport *report) {
    bool ok = true;
    const cJSON *machine = cJSON_GetObjectItemCaseSensitive(root, "machine");
    report->machine.wait = number(machine, "wait", max_mean, &ok);
    report->machine.repeated = integer(machine, "repeated", 0, INT_MAX, &ok);
    report->machine.has_wait = cJSON_IsTrue(cJSON_GetObjectItemCaseSensitive(machine, "has_wait"));
    report->machine.settled = cJSON_IsTrue(cJSON_GetObjectItemCaseSensitive(machine, "settled"));
    const cJSON *level = cJSON_GetObjectItemCaseSensitive(machine, "runs");
    if (level) {
        report->level_spread = (DipCostLevelSpread){
            .runs = integer(level, "runs", 0, INT_MAX, &ok),
            .least_ms = number(level, "least_ms", max_ms, &ok),
            .most_ms = number(level, "most_ms", max_ms, &ok),
            .deviation = number(level, "deviation", max_ms, &ok),
            .factor = number(level, "factor", max_ms, &ok),
        };
    }
    return ok;
}

static bool read_header(const cJSON *root, DipCostReport *report) {
    bool ok = true;
    DipCostOptions *options = &report->options;
#define READ_TEXT(field)                                                                           \
    copy_text(cJSON_GetObjectItemCaseSensitive(root, #field), report->field, sizeof report->field, \
              &ok);
    DIP_COST_HEADER_TEXTS(READ_TEXT)
#undef READ_TEXT
    const cJSON *date = cJSON_GetObjectItemCaseSensitive(root, "date");
    if (date) { // Older reports have no date.
        copy_text(date, report->date, sizeof report->date, &ok);
    }
#define READ_NUMBER(field, most) report->field = integer(root, #field, 0, most, &ok);
    DIP_COST_HEADER_NUMBERS(READ_NUMBER)
#undef READ_NUMBER
#define READ_OPTION(field, most) options->field = integer(root, #field, 0, most, &ok);
    DIP_COST_OPTION_NUMBERS(READ_OPTION)
#undef READ_OPTION
    ok = ok && options->places > 0 && options->burst > 0 && options->timed_frames > 0 &&
         report->rounds != 1; // One round has no interval.
    options->rounds = report->rounds;
    options->end_place = options->places;
    options->pixels_per_degree = number(root, "pixels_per_degree", max_count, &ok);
    const cJSON *baseline = cJSON_GetObjectItemCaseSensitive(root, "baseline");
    ok = ok && cJSON_IsString(baseline) &&
         dip_quality_parse(baseline->valuestring, &options->baseline, NULL);
    const cJSON *item;
    ok = ok && read_paths(root, report);
    cJSON_ArrayForEach(item, cJSON_GetObjectItemCaseSensitive(root, "left_out")) {
        if (report->refused_count < DIP_COST_MAX_REFUSED) {
            copy_text(item, report->refused[report->refused_count++], DIP_COST_REASON, &ok);
        }
    }
    return ok && report->path_count > 0;
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
        if (!cJSON_IsNumber(item) || !(item->valuedouble >= 0.0 && item->valuedouble <= max_ms)) {
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
        ok = pairs[f].ms >= min_ms && pairs[f].base_ms >= min_ms;
    }
    return ok;
}

static bool read_row(const cJSON *object, DipCostReport *report, DipCostRow *row) {
    bool ok = true;
    const cJSON *settings = cJSON_GetObjectItemCaseSensitive(object, "settings");
    row->path = integer(object, "path", 0, report->path_count - 1, &ok);
    ok = ok && cJSON_IsString(settings) &&
         dip_quality_parse(settings->valuestring, &row->quality, NULL);
    const cJSON *viewpoint;
    cJSON_ArrayForEach(viewpoint, cJSON_GetObjectItemCaseSensitive(object, "places")) {
        const int p = integer(viewpoint, "place", 0, report->options.places - 1, &ok);
        if (!ok || !read_sums(viewpoint, "sums", &row->viewpoints[p]) ||
            !dip_cost_tail_read(viewpoint, &row->tails[p])) {
            return false;
        }
        row->judged[p] = true;
        const cJSON *pictures = cJSON_GetObjectItemCaseSensitive(viewpoint, "pictures");
        if (pictures) {
            copy_text(pictures, row->pictures[p], sizeof row->pictures[p], &ok);
        }
    }
    if (ok && report->rounds > 0) {
        const cJSON *counters = cJSON_GetObjectItemCaseSensitive(object, "counters");
        for (int c = 0; c < DIP_COST_COUNTER_COUNT; c++) {
            row->counters[c] = number(counters, dip_cost_counter_names[c], max_count, &ok);
        }
        const cJSON *stages = cJSON_GetObjectItemCaseSensitive(object, "stages_ms");
        for (int i = 0; stages && i < DIP_COST_STAGE_COUNT; i++) {
            row->stage_ms[i] = number(stages, dip_cost_stage_names[i], max_ms, &ok);
        }
        ok = ok && read_pairs(cJSON_GetObjectItemCaseSensitive(object, "pairs"),
                              dip_cost_frame_count(report), row->pairs);
    }
    return ok;
}

static bool read_rows(const cJSON *root, DipCostReport *report) {
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

static bool read_same(const cJSON *root, DipCostReport *report, const char *file, DipError *err) {
    const cJSON *list = cJSON_GetObjectItemCaseSensitive(root, "same_pictures");
    const int count = cJSON_GetArraySize(list);
    if (count > DIP_COST_MAX_ROWS) {
        return missing(file, "same_pictures", err);
    }
    report->same = calloc((size_t)count + 1, sizeof *report->same);
    if (!report->same) {
        return dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory");
    }
    bool ok = true;
    const cJSON *object;
    cJSON_ArrayForEach(object, list) {
        const cJSON *settings = cJSON_GetObjectItemCaseSensitive(object, "settings");
        DipCostSame *same = ok ? &report->same[report->same_count++] : NULL;
        ok = same && cJSON_IsString(settings) &&
             dip_quality_parse(settings->valuestring, &same->quality, NULL);
        if (ok) {
            same->row = integer(object, "row", 0, report->row_count - 1, &ok);
        }
    }
    return ok || missing(file, "same_pictures", err);
}

static bool read_sweep(const cJSON *object, DipCostReport *report, DipCostSweep *sweep) {
    bool ok = true;
    const cJSON *setting = cJSON_GetObjectItemCaseSensitive(object, "setting");
    copy_text(cJSON_GetObjectItemCaseSensitive(object, "title"), sweep->title, sizeof sweep->title,
              &ok);
    sweep->path = integer(object, "path", 0, report->path_count - 1, &ok);
    sweep->base = integer(object, "base", 0, report->row_count - 1, &ok);
    int found = -1;
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        if (cJSON_IsString(setting) &&
            strcmp(setting->valuestring, dip_setting_info((DipSetting)s)->key) == 0) {
            found = s;
        }
    }
    sweep->setting = found >= 0 ? (DipSetting)found : DIP_SETTING_AA;
    const cJSON *step;
    cJSON_ArrayForEach(step, cJSON_GetObjectItemCaseSensitive(object, "steps")) {
        if (sweep->row_count == DIP_COST_MAX_SWEEP_ROWS) {
            return false;
        }
        sweep->rows[sweep->row_count++] = integer(step, "row", 0, report->row_count - 1, &ok);
    }
    return ok && found >= 0;
}

static bool read_sweeps(const cJSON *root, DipCostReport *report) {
    const cJSON *object;
    cJSON_ArrayForEach(object, cJSON_GetObjectItemCaseSensitive(root, "sweeps")) {
        if (report->sweep_count == DIP_COST_MAX_SWEEPS ||
            !read_sweep(object, report, &report->sweeps[report->sweep_count])) {
            return false;
        }
        report->sweep_count++;
    }
    return true;
}

static bool read_floors(const cJSON *root, DipCostReport *report) {
    bool ok = true;
    const cJSON *object;
    cJSON_ArrayForEach(object, cJSON_GetObjectItemCaseSensitive(root, "floors")) {
        const int path = integer(object, "path", 0, report->path_count - 1, &ok);
        const int viewpoint = integer(object, "place", 0, report->options.places - 1, &ok);
        const int index = path * report->options.places + viewpoint;
        if (!ok || !read_sums(object, "half_against_half", &report->floors[index])) {
            return false;
        }
        report->has_floor[index] = true;
    }
    return ok;
}

static DipCostMisses read_misses(const cJSON *misses, const char *name, bool *ok) {
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(misses, name);
    return (DipCostMisses){
        .rows = integer(item, "rows", 0, DIP_COST_MAX_ROWS, ok),
        .median = number(item, "median", max_mean, ok),
        .p90 = number(item, "p90", max_mean, ok),
        .within_5 = number(item, "within_5_percent", 1.0, ok),
        .within_10 = number(item, "within_10_percent", 1.0, ok),
    };
}

static bool read_prediction(const cJSON *object, const DipCostReport *report,
                            DipCostPrediction *prediction) {
    bool ok = true;
    const cJSON *settings = cJSON_GetObjectItemCaseSensitive(object, "settings");
    *prediction = (DipCostPrediction){
        .ms = number(object, "ms", max_ms, &ok),
        .p95_ms = number(object, "p95_ms", max_ms, &ok),
        .flip = number(object, "flip", max_mean, &ok),
        .row = integer(object, "row", -1, report->row_count - 1, &ok),
    };
    return ok && cJSON_IsString(settings) &&
           dip_quality_parse(settings->valuestring, &prediction->quality, NULL);
}

// The counters of combinations that were not measured are not in the file.
static bool read_predictions(const cJSON *root, DipCostReport *report, const char *file,
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
        return missing(file, "predicted", err);
    }
    predicted->list = calloc((size_t)count + 1, sizeof *predicted->list);
    if (!predicted->list) {
        return dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory");
    }
    bool ok = true;
    predicted->trained = integer(object, "trained", 0, DIP_COST_MAX_ROWS, &ok);
    predicted->times = read_misses(misses, "times", &ok);
    predicted->errors = read_misses(misses, "flip", &ok);
    predicted->times_left_out = read_misses(misses, "times_left_out", &ok);
    predicted->errors_left_out = read_misses(misses, "flip_left_out", &ok);
    const cJSON *item;
    cJSON_ArrayForEach(item, list) {
        ok = ok && read_prediction(item, report, &predicted->list[predicted->count++]);
    }
    return ok || missing(file, "predicted", err);
}

static bool read_one_advice(const cJSON *object, const DipCostReport *report,
                            DipCostAdvice *advice) {
    bool ok = true;
    *advice = (DipCostAdvice){
        .budget_ms = number(object, "budget_ms", max_ms, &ok),
        .row = integer(object, "row", -1, report->row_count - 1, &ok),
        .ms = number(object, "ms", max_ms, &ok),
        .ms_low = number(object, "ms_low", max_ms, &ok),
        .ms_high = number(object, "ms_high", max_ms, &ok),
        .runner_up = -1,
    };
    if (cJSON_GetObjectItemCaseSensitive(object, "probability")) {
        advice->probability = number(object, "probability", 1.0, &ok);
        advice->runner_up = integer(object, "runner_up", -1, report->row_count - 1, &ok);
        advice->runner_up_probability = number(object, "runner_up_probability", 1.0, &ok);
    }
    return ok;
}

// Advice that cannot be read is left out.
static void read_advice(const cJSON *root, DipCostReport *report) {
    const cJSON *object;
    cJSON_ArrayForEach(object, cJSON_GetObjectItemCaseSensitive(root, "advice")) {
        if (report->advice_count < DIP_COST_MAX_BUDGETS &&
            read_one_advice(object, report, &report->advice[report->advice_count])) {
            report->advice_count++;
        }
    }
}

enum {
#define COUNT_FIELD(field) +1
    PAIR_FIELDS = 0 DIP_COST_PAIR_FIELDS(COUNT_FIELD)
#undef COUNT_FIELD
};

// True if a file of this size can hold the times of all rows, of which each has six numbers of at
// least two characters. If it cannot, memory for the times would be out of proportion to the file.
static bool times_fit(const DipCostReport *report, int row_count, size_t size_bytes) {
    return (double)row_count * report->rounds * report->options.timed_frames * PAIR_FIELDS * 2.0 <=
           (double)size_bytes;
}

static bool read_report(const cJSON *root, size_t size_bytes, DipCostReport *report,
                        const char *file, DipError *err) {
    bool ok = true;
    if (number(root, "format", max_count, &ok) != DIP_COST_JSON_FORMAT &&
        cJSON_GetObjectItemCaseSensitive(root, "version")) {
        return dip_error_set(err, DIP_ERROR_FORMAT, file, 0, "format",
                             "is that of another version of Diptych, accepted %d; measure the "
                             "report again",
                             DIP_COST_JSON_FORMAT);
    }
    if (!read_header(root, report)) {
        return missing(file, "header", err);
    }
    const cJSON *rows = cJSON_GetObjectItemCaseSensitive(root, "rows");
    const int count = cJSON_GetArraySize(rows);
    if (count < 1 || count > DIP_COST_MAX_ROWS || !times_fit(report, count, size_bytes)) {
        return missing(file, "rows", err);
    }
    report->rows = calloc((size_t)count, sizeof *report->rows);
    report->row_count = report->rows ? count : 0;
    if (!report->rows) {
        return dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory");
    }
    if (!dip_cost_report_alloc(report, err)) {
        return false;
    }
    if (!read_rows(root, report)) {
        return missing(file, "rows", err);
    }
    if (!read_same(root, report, file, err)) {
        return false;
    }
    if (!read_sweeps(root, report)) {
        return missing(file, "sweeps", err);
    }
    if (!read_floors(root, report)) {
        return missing(file, "floors", err);
    }
    if (!read_predictions(root, report, file, err)) {
        return false;
    }
    read_advice(root, report);
    if (report->rounds == 0) {
        return true;
    }
    return (read_machine(root, report) || missing(file, "machine", err)) &&
           dip_cost_estimate_times(report, err);
}

bool dip_cost_read_json(DipCostReport *report, const char *file, DipError *err) {
    *report = (DipCostReport){0};
    unsigned char *text;
    size_t size_bytes;
    if (!dip_file_read(file, "report", MAX_FILE_BYTES, &text, &size_bytes, err)) {
        return false;
    }
    dip_json_memory_begin();
    cJSON *root = cJSON_ParseWithLength((const char *)text, size_bytes);
    const bool parsed =
        root || (dip_json_memory_ran_out()
                     ? dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory")
                     : dip_error_set(err, DIP_ERROR_FORMAT, file, 0, NULL, "is not a JSON file"));
    const bool read = parsed && read_report(root, size_bytes, report, file, err);
    cJSON_Delete(root);
    dip_json_memory_end();
    free(text);
    if (!read) {
        dip_cost_report_free(report);
    }
    return read;
}
