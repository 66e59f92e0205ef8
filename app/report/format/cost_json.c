// Writes and reads cost.json.
#include "app/report/format/cost_fields.h"
#include "app/report/format/formats.h"
#include "renderer/base/file.h"

#include <cjson/cJSON.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { MAX_FILE_BYTES = 1 << 29, TIMED_NUMBERS = 3 };

bool dip_cost_write_json(const DipCostReport *report, const char *file, DipError *err) {
    return dip_fields_write_json(&dip_cost_report_record, report, file, err);
}

// --- the previous format -------------------------------------------------------------------------

static cJSON *add_empty_text(cJSON *const object, const char *const name) {
    return cJSON_AddStringToObject(object, name, "");
}

static cJSON *add_zero(cJSON *const object, const char *const name) {
    return cJSON_AddNumberToObject(object, name, 0.0);
}

static cJSON *add_false(cJSON *const object, const char *const name) {
    return cJSON_AddFalseToObject(object, name);
}

static void add_missing(cJSON *object, const char *name,
                        cJSON *(*add)(cJSON *const object, const char *const name)) {
    if (object && !cJSON_GetObjectItemCaseSensitive(object, name)) {
        add(object, name);
    }
}

// Replaces the ends of an interval by null unless both are there and the lower one is below the
// upper one. Files of format 2 have equal ends where an interval is not known.
static void forget_no_interval(cJSON *object) {
    static const char *const names[] = {"ms_low", "ms_high"};
    const cJSON *low = cJSON_GetObjectItemCaseSensitive(object, "ms_low");
    const cJSON *high = cJSON_GetObjectItemCaseSensitive(object, "ms_high");
    const bool known =
        cJSON_IsNumber(low) && cJSON_IsNumber(high) && low->valuedouble < high->valuedouble;
    for (int i = 0; i < 2 && !known; i++) {
        cJSON_DeleteItemFromObjectCaseSensitive(object, names[i]);
        cJSON_AddNullToObject(object, names[i]);
    }
}

// Adds the counters that files of older versions lack, with the value 0. They count work that
// those versions did not do, such as blending, filters and shadows.
static void add_counters(cJSON *counters) {
    static const char *const later[] = {"fragments_pbr",          "fragments_occluded",
                                        "fragments_emitting",     "fragments_coated",
                                        "fragments_blended",      "fragments_copied",
                                        "pixels_filtered",        "edges_found",
                                        "vertices_posed",         "fragments_shadowed",
                                        "shadow_texels",          "shadow_bytes",
                                        "pixels_reprojected",     "history_bytes",
                                        "fragments_surrounded",   "fragments_sheen",
                                        "fragments_transmitting", "fragments_scattering",
                                        "fragments_behind",       "backdrop_texels",
                                        "backdrop_bytes"};
    for (size_t i = 0; i < sizeof later / sizeof *later && cJSON_IsObject(counters); i++) {
        add_missing(counters, later[i], add_zero);
    }
}

static void add_counters_of(cJSON *items) {
    cJSON *item;
    cJSON_ArrayForEach(item, items) {
        add_counters(cJSON_GetObjectItemCaseSensitive(item, "counters"));
    }
}

// Adds the number of searched combinations that files of older versions lack, with the value 0.
static void add_searched(cJSON *predicted) {
    if (cJSON_IsObject(predicted)) {
        add_missing(predicted, "searched", add_zero);
    }
}

// Adds the members that format 3 always has and format 2 leaves out: they are null, 0 or empty.
// Also forgets the intervals of `smaller` that are not known.
static void upgrade(cJSON *root) {
    static const char *const nulls[] = {"machine", "predicted", "smaller"};
    static const char *const lists[] = {"left_out", "floors", "same_pictures",
                                        "sweeps",   "advice", "visits"};
    cJSON *item, *place;
    for (int i = 0; i < 3; i++) {
        add_missing(root, nulls[i], cJSON_AddNullToObject);
    }
    for (int i = 0; i < 6; i++) {
        add_missing(root, lists[i], cJSON_AddArrayToObject);
    }
    add_missing(root, "date", add_empty_text);
    add_missing(cJSON_GetObjectItemCaseSensitive(root, "machine"), "starts", add_zero);
    cJSON_ArrayForEach(item, cJSON_GetObjectItemCaseSensitive(root, "rows")) {
        add_missing(item, "counters", cJSON_AddNullToObject);
        add_missing(item, "stages_ms", cJSON_AddNullToObject);
        cJSON_ArrayForEach(place, cJSON_GetObjectItemCaseSensitive(item, "places")) {
            add_missing(place, "flip_tail", cJSON_AddNullToObject);
            add_missing(place, "pictures", add_empty_text);
        }
    }
    const cJSON *smaller = cJSON_GetObjectItemCaseSensitive(root, "smaller");
    cJSON_ArrayForEach(item, cJSON_GetObjectItemCaseSensitive(smaller, "combinations")) {
        forget_no_interval(item);
    }
}

// --- memory --------------------------------------------------------------------------------------

// Most functions of cJSON do not say that memory ran out: an object then merely lacks a part. So
// while a file is read, cJSON uses an allocator that notes in ran_out that memory ran out. This
// changes the whole process, so only one thread may read a report at a time.
static bool ran_out;

static void *allocate(size_t size_bytes) {
    void *memory = malloc(size_bytes);
    ran_out = ran_out || !memory;
    return memory;
}

// --- reading -------------------------------------------------------------------------------------

static double number_of(const cJSON *root, const char *name) {
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(root, name);
    return cJSON_IsNumber(item) ? item->valuedouble : 0.0;
}

// Returns whether a file of this size can hold the times of all rows. A time has at least
// TIMED_NUMBERS numbers, and each number takes at least two characters. This check keeps a small
// file from asking for much memory.
static bool times_fit(const cJSON *root, size_t size_bytes) {
    const int rows = cJSON_GetArraySize(cJSON_GetObjectItemCaseSensitive(root, "rows"));
    return rows * number_of(root, "rounds") * number_of(root, "timed_frames") * TIMED_NUMBERS *
               2.0 <=
           (double)size_bytes;
}

// Takes the next number of an array. Returns whether it lies between least and most.
static bool next_number(const cJSON **item, double least, double most, double *value) {
    const cJSON *from = *item;
    const bool known =
        cJSON_IsNumber(from) && from->valuedouble >= least && from->valuedouble <= most;
    *value = known ? from->valuedouble : 0.0;
    *item = from ? from->next : NULL;
    return known;
}

// Adds the times of a row to the log. Older files have them as pairs: there is an array of the
// times of the row's frames, and one of the times of the baseline's same frames. Two more arrays
// have the waiting times. A pair in which the row's time is 0 is left out. Frame f of a path
// belongs to round f % rounds.
static bool add_pairs(const cJSON *pairs, DipCostReport *report, int row, DipTimed *log) {
    static const char *const names[] = {"base_ms", "ms", "base_wait", "wait"};
    const int base = report->base_rows[report->rows[row].path];
    const cJSON *items[4];
    for (int i = 0; i < 4; i++) {
        const cJSON *array = cJSON_GetObjectItemCaseSensitive(pairs, names[i]);
        items[i] = cJSON_IsArray(array) ? array->child : NULL;
    }
    for (int f = 0; f < dip_cost_frame_count(report); f++) {
        double ms[2], wait[2];
        for (int i = 0; i < 2; i++) {
            if (!next_number(&items[i], 0.0, DIP_COST_MOST_MS, &ms[i]) ||
                !next_number(&items[2 + i], 0.0, DIP_COST_MOST_MEAN, &wait[i])) {
                return false;
            }
        }
        // A pair of the base has the base's time on both sides, which is logged once.
        for (int i = 0; i < 2 && ms[1] > 0.0 && (i == 0 || row != base); i++) {
            if (ms[i] < DIP_COST_LEAST_MS) {
                return false;
            }
            log[report->log_count++] = (DipTimed){.subject = i == 0 ? base : row,
                                                  .round = f % report->rounds,
                                                  .block = row,
                                                  .frame = f,
                                                  .ms = ms[i],
                                                  .wait = wait[i]};
        }
    }
    return !items[0] && !items[1];
}

// Makes the log of a report whose file has pairs of times (add_pairs).
static bool read_pairs(const cJSON *root, DipCostReport *report, const char *file, DipError *err) {
    const size_t values = (size_t)report->row_count * (size_t)dip_cost_frame_count(report);
    const cJSON *row = cJSON_GetObjectItemCaseSensitive(root, "rows")->child;
    report->log = malloc((2 * values + 1) * sizeof *report->log);
    if (!report->log) {
        return dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory");
    }
    report->starts = 1;
    for (int r = 0; r < report->row_count; r++, row = row->next) {
        if (!add_pairs(cJSON_GetObjectItemCaseSensitive(row, "pairs"), report, r, report->log)) {
            return dip_error_set(err, DIP_ERROR_FORMAT, file, 0, "pairs",
                                 "of row %d are missing, or are not what `diptych` writes", r);
        }
    }
    return true;
}

static bool read_report(cJSON *root, size_t size_bytes, DipCostReport *report, const char *file,
                        DipError *err) {
    const double format = number_of(root, "format");
    if (format == DIP_COST_JSON_FORMAT - 1) {
        upgrade(root);
    } else if (format != DIP_COST_JSON_FORMAT &&
               cJSON_GetObjectItemCaseSensitive(root, "version")) {
        return dip_error_set(err, DIP_ERROR_FORMAT, file, 0, "format",
                             "is that of another version of Diptych, accepted %d and %d; measure "
                             "the report again",
                             DIP_COST_JSON_FORMAT - 1, DIP_COST_JSON_FORMAT);
    }
    add_counters_of(cJSON_GetObjectItemCaseSensitive(root, "rows"));
    add_counters_of(cJSON_GetObjectItemCaseSensitive(
        cJSON_GetObjectItemCaseSensitive(root, "smaller"), "combinations"));
    add_searched(cJSON_GetObjectItemCaseSensitive(root, "predicted"));
    // Files of older versions lack these.
    add_missing(root, "several_builds", add_false);
    add_missing(root, "warnings", cJSON_AddArrayToObject);
    add_missing(root, "warnings_left_out", add_zero);
    if (!times_fit(root, size_bytes)) {
        return dip_error_set(err, DIP_ERROR_FORMAT, file, 0, "rows",
                             "are fewer than their number of rounds and frames says");
    }
    const DipFieldAt at = {report, report, 0, NULL};
    if (!dip_fields_read_json(&dip_cost_report_record, &at, root, file, err)) {
        return false;
    }
    return report->rounds == 0 || ((report->log || read_pairs(root, report, file, err)) &&
                                   dip_cost_estimate_times(report, err));
}

bool dip_cost_read_json(DipCostReport *report, const char *file, DipError *err) {
    *report = (DipCostReport){0};
    unsigned char *text;
    size_t size_bytes;
    if (!dip_file_read(file, "report", MAX_FILE_BYTES, &text, &size_bytes, err)) {
        return false;
    }
    cJSON_Hooks hooks = {.malloc_fn = allocate, .free_fn = free};
    ran_out = false;
    cJSON_InitHooks(&hooks);
    cJSON *root = cJSON_ParseWithLength((const char *)text, size_bytes);
    const bool parsed =
        root ||
        (ran_out ? dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory")
                 : dip_error_set(err, DIP_ERROR_FORMAT, file, 0, NULL, "is not a JSON file"));
    bool read = parsed && read_report(root, size_bytes, report, file, err);
    if (ran_out && parsed) { // Adding a member may have failed.
        read = dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory");
    }
    cJSON_Delete(root);
    cJSON_InitHooks(NULL);
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
