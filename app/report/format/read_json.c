// Reading a report from JSON.
#include "app/report/format/formats.h"

#include "app/report/format/json_fields.h"
#include "app/report/format/json_memory.h"
#include "app/report/format/json_read.h"
#include "app/report/format/json_smaller.h"
#include "app/report/format/read_parts.h"
#include "renderer/base/file.h"

#include <cjson/cJSON.h>
#include <limits.h>
#include <stdlib.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

enum { MAX_FILE_BYTES = 1 << 29 };

// Names of paths are those of categories, or of an option's value.
static bool is_name(const char *text) {
    return *text && strspn(text, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
                                 "0123456789_-") == strlen(text);
}

static bool read_paths(const cJSON *root, DipCostReport *report) {
    bool ok = true;
    const cJSON *item;
    cJSON_ArrayForEach(item, cJSON_GetObjectItemCaseSensitive(root, "paths")) {
        const int p = report->path_count;
        if (p == DIP_COST_MAX_PATHS) {
            return false;
        }
        dip_json_copy_text(cJSON_GetObjectItemCaseSensitive(item, "name"), report->paths[p],
                           sizeof report->paths[p], &ok);
        dip_json_copy_text(cJSON_GetObjectItemCaseSensitive(item, "poses"), report->path_hashes[p],
                           sizeof report->path_hashes[p], &ok);
        ok = ok && is_name(report->paths[p]);
        report->base_rows[p] = dip_json_integer(item, "base_row", 0, DIP_COST_MAX_ROWS - 1, &ok);
        report->same_rows[p] = dip_json_integer(item, "same_row", 0, DIP_COST_MAX_ROWS - 1, &ok);
        report->path_count++;
    }
    return ok;
}

static bool read_machine(const cJSON *root, DipCostReport *report) {
    bool ok = true;
    const cJSON *machine = cJSON_GetObjectItemCaseSensitive(root, "machine");
    report->machine.wait = dip_json_number(machine, "wait", DIP_JSON_MAX_MEAN, &ok);
    report->machine.repeated = dip_json_integer(machine, "repeated", 0, INT_MAX, &ok);
    report->machine.has_wait = cJSON_IsTrue(cJSON_GetObjectItemCaseSensitive(machine, "has_wait"));
    report->machine.settled = cJSON_IsTrue(cJSON_GetObjectItemCaseSensitive(machine, "settled"));
    const cJSON *level = cJSON_GetObjectItemCaseSensitive(machine, "runs");
    if (level) {
        report->level_spread = (DipCostLevelSpread){
            .runs = dip_json_integer(level, "runs", 0, INT_MAX, &ok),
            .least_ms = dip_json_number(level, "least_ms", DIP_JSON_MAX_MS, &ok),
            .most_ms = dip_json_number(level, "most_ms", DIP_JSON_MAX_MS, &ok),
            .deviation = dip_json_number(level, "deviation", DIP_JSON_MAX_MS, &ok),
            .factor = dip_json_number(level, "factor", DIP_JSON_MAX_MS, &ok),
        };
        if (cJSON_GetObjectItemCaseSensitive(level, "ratio_factor")) { // Not in older reports.
            report->level_spread.ratio_deviation =
                dip_json_number(level, "ratio_deviation", DIP_JSON_MAX_MS, &ok);
            report->level_spread.ratio_factor =
                dip_json_number(level, "ratio_factor", DIP_JSON_MAX_MS, &ok);
        }
    }
    return ok;
}

static bool read_header(const cJSON *root, DipCostReport *report) {
    bool ok = true;
    DipCostOptions *options = &report->options;
#define READ_TEXT(field)                                                                           \
    dip_json_copy_text(cJSON_GetObjectItemCaseSensitive(root, #field), report->field,              \
                       sizeof report->field, &ok);
    DIP_COST_HEADER_TEXTS(READ_TEXT)
#undef READ_TEXT
    const cJSON *date = cJSON_GetObjectItemCaseSensitive(root, "date");
    if (date) { // Older reports have no date.
        dip_json_copy_text(date, report->date, sizeof report->date, &ok);
    }
#define READ_NUMBER(field, most) report->field = dip_json_integer(root, #field, 0, most, &ok);
    DIP_COST_HEADER_NUMBERS(READ_NUMBER)
#undef READ_NUMBER
#define READ_OPTION(field, most) options->field = dip_json_integer(root, #field, 0, most, &ok);
    DIP_COST_OPTION_NUMBERS(READ_OPTION)
#undef READ_OPTION
    ok = ok && report->threads > 0 && report->width > 0 && report->height > 0 &&
         options->places > 0 && options->burst > 0 && options->timed_frames > 0 &&
         report->rounds != 1; // One round has no interval.
    options->rounds = report->rounds;
    options->end_place = options->places;
    options->pixels_per_degree =
        dip_json_number(root, "pixels_per_degree", DIP_JSON_MAX_COUNT, &ok);
    const cJSON *baseline = cJSON_GetObjectItemCaseSensitive(root, "baseline");
    ok = ok && cJSON_IsString(baseline) &&
         dip_quality_parse(baseline->valuestring, &options->baseline, NULL);
    const cJSON *item;
    ok = ok && read_paths(root, report);
    cJSON_ArrayForEach(item, cJSON_GetObjectItemCaseSensitive(root, "left_out")) {
        if (report->refused_count < DIP_COST_MAX_REFUSED) {
            dip_json_copy_text(item, report->refused[report->refused_count++], DIP_COST_REASON,
                               &ok);
        }
    }
    return ok && report->path_count > 0;
}

static bool read_same(const cJSON *root, DipCostReport *report, const char *file, DipError *err) {
    const cJSON *list = cJSON_GetObjectItemCaseSensitive(root, "same_pictures");
    const int count = cJSON_GetArraySize(list);
    if (count > DIP_COST_MAX_ROWS) {
        return dip_json_missing(file, "same_pictures", err);
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
            same->row = dip_json_integer(object, "row", 0, report->row_count - 1, &ok);
        }
    }
    return ok || dip_json_missing(file, "same_pictures", err);
}

static bool read_sweep(const cJSON *object, DipCostReport *report, DipCostSweep *sweep) {
    bool ok = true;
    const cJSON *setting = cJSON_GetObjectItemCaseSensitive(object, "setting");
    sweep->path = dip_json_integer(object, "path", 0, report->path_count - 1, &ok);
    sweep->base = dip_json_integer(object, "base", 0, report->row_count - 1, &ok);
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
        sweep->rows[sweep->row_count++] =
            dip_json_integer(step, "row", 0, report->row_count - 1, &ok);
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
        const int path = dip_json_integer(object, "path", 0, report->path_count - 1, &ok);
        const int viewpoint = dip_json_integer(object, "place", 0, report->options.places - 1, &ok);
        const int index = path * report->options.places + viewpoint;
        if (!ok || !dip_cost_read_sums(object, "half_against_half", &report->floors[index])) {
            return false;
        }
        report->has_floor[index] = true;
    }
    return ok;
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
    if (dip_json_number(root, "format", DIP_JSON_MAX_COUNT, &ok) != DIP_COST_JSON_FORMAT &&
        cJSON_GetObjectItemCaseSensitive(root, "version")) {
        return dip_error_set(err, DIP_ERROR_FORMAT, file, 0, "format",
                             "is that of another version of Diptych, accepted %d; measure the "
                             "report again",
                             DIP_COST_JSON_FORMAT);
    }
    if (!read_header(root, report)) {
        return dip_json_missing(file, "header", err);
    }
    const cJSON *rows = cJSON_GetObjectItemCaseSensitive(root, "rows");
    const int count = cJSON_GetArraySize(rows);
    if (count < 1 || count > DIP_COST_MAX_ROWS || !times_fit(report, count, size_bytes)) {
        return dip_json_missing(file, "rows", err);
    }
    report->rows = calloc((size_t)count, sizeof *report->rows);
    report->row_count = report->rows ? count : 0;
    if (!report->rows) {
        return dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory");
    }
    if (!dip_cost_report_alloc(report, err)) {
        return false;
    }
    if (!dip_cost_read_rows(root, report)) {
        return dip_json_missing(file, "rows", err);
    }
    if (!read_same(root, report, file, err)) {
        return false;
    }
    if (!read_sweeps(root, report)) {
        return dip_json_missing(file, "sweeps", err);
    }
    if (!read_floors(root, report)) {
        return dip_json_missing(file, "floors", err);
    }
    if (!dip_cost_read_predictions(root, report, file, err)) {
        return false;
    }
    if (!dip_cost_smaller_read(root, report)) {
        return dip_json_missing(file, "smaller", err);
    }
    dip_cost_read_advice(root, report);
    if (report->rounds == 0) {
        return true;
    }
    return (read_machine(root, report) || dip_json_missing(file, "machine", err)) &&
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

bool dip_cost_read_report(const char *name, DipCostReport *report, DipError *err) {
    struct stat status;
    char file[PATH_MAX];
    const bool is_folder = stat(name, &status) == 0 && S_ISDIR(status.st_mode);
    const int length = snprintf(file, sizeof file, is_folder ? "%s/cost.json" : "%s", name);
    if (length < 0 || (size_t)length >= sizeof file) {
        *report = (DipCostReport){0};
        return dip_error_set(err, DIP_ERROR_OVERSIZED, name, 0, NULL, "the name is too long");
    }
    return dip_cost_read_json(report, file, err);
}
