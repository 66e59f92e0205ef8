// Reading the log of timed frames.
#include "app/report/format/json_read.h"
#include "app/report/format/read_parts.h"

#include <cjson/cJSON.h>

#include <limits.h>
#include <math.h>
#include <stdlib.h>

// A frame is timed a few times for the advice, and a baseline's in every block.
enum { MOST_TIMES = 64 };

static bool read_visit(const cJSON *object, const DipCostReport *report, DipTimed *to, int count) {
    bool ok = true;
    const cJSON *frame = cJSON_GetObjectItemCaseSensitive(object, "frames")->child;
    const cJSON *ms = cJSON_GetObjectItemCaseSensitive(object, "ms");
    const cJSON *wait = cJSON_GetObjectItemCaseSensitive(object, "wait");
    const int rounds = report->options.rounds / report->starts;
    const DipTimed visit = {
        .subject = dip_json_integer(object, "row", 0, report->row_count - 1, &ok),
        .start = dip_json_integer(object, "start", 0, report->starts - 1, &ok),
        .round = dip_json_integer(object, "round", 0, rounds - 1, &ok),
        .block = dip_json_integer(object, "block", 0, INT_MAX - 1, &ok),
        .begin_ns = (int64_t)(1e6 * dip_json_number(object, "begin_ms", DIP_JSON_MAX_MS, &ok)),
    };
    if (!ok || cJSON_GetArraySize(ms) != count || cJSON_GetArraySize(wait) != count) {
        return false;
    }
    ms = ms->child;
    wait = wait->child;
    for (int i = 0; i < count;
         i++, frame = frame->next, ms = ms->next, wait = wait->next) {
        to[i] = visit;
        if (!cJSON_IsNumber(frame) || !cJSON_IsNumber(ms) ||
            !(frame->valuedouble >= 0.0 && frame->valuedouble < dip_cost_frame_count(report)) ||
            !(ms->valuedouble >= DIP_JSON_MIN_MS && ms->valuedouble <= DIP_JSON_MAX_MS) ||
            !(cJSON_IsNull(wait) ||
              (wait->valuedouble >= 0.0 && wait->valuedouble <= DIP_JSON_MAX_MEAN))) {
            return false;
        }
        to[i].frame = frame->valueint;
        to[i].ms = ms->valuedouble;
        to[i].wait = cJSON_IsNull(wait) ? NAN : wait->valuedouble;
    }
    return true;
}

bool dip_cost_read_visits(const cJSON *root, DipCostReport *report, const char *file,
                          DipError *err) {
    const cJSON *visits = cJSON_GetObjectItemCaseSensitive(root, "visits");
    const cJSON *machine = cJSON_GetObjectItemCaseSensitive(root, "machine");
    const cJSON *object;
    int count = 0;
    bool ok = true;
    if (!visits) { // An older report, which has pairs only.
        return true;
    }
    report->starts = dip_json_integer(machine, "starts", 1, DIP_TIMED_MOST_STARTS, &ok);
    if (!ok || report->options.rounds % report->starts != 0) {
        return dip_json_missing(file, "machine", err);
    }
    cJSON_ArrayForEach(object, visits) {
        count += cJSON_GetArraySize(cJSON_GetObjectItemCaseSensitive(object, "frames"));
    }
    if (count > MOST_TIMES * report->row_count * dip_cost_frame_count(report)) {
        return dip_json_missing(file, "visits", err);
    }
    report->log = malloc(((size_t)count + 1) * sizeof *report->log);
    if (!report->log) {
        return dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory");
    }
    cJSON_ArrayForEach(object, visits) {
        const int frames = cJSON_GetArraySize(cJSON_GetObjectItemCaseSensitive(object, "frames"));
        if (frames < 1 || !read_visit(object, report, report->log + report->log_count, frames)) {
            return dip_json_missing(file, "visits", err);
        }
        report->log_count += frames;
    }
    return true;
}
