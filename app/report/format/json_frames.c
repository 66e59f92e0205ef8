// Writing and reading the list of kept frames.
#include "app/report/format/json_frames.h"

#include "app/report/format/json_read.h"

#include <cjson/cJSON.h>
#include <stdlib.h>
#include <string.h>

void dip_cost_frames_add(cJSON *root, const DipCostReport *report) {
    if (report->kept.count == 0) {
        return;
    }
    cJSON *frames = cJSON_AddObjectToObject(root, "frames");
    cJSON_AddNumberToObject(frames, "place", report->kept.viewpoint);
    cJSON *files = cJSON_AddArrayToObject(frames, "files");
    for (int i = 0; i < report->kept.count; i++) {
        const DipCostKeptFrame *frame = &report->kept.list[i];
        char settings[256];
        cJSON *item = cJSON_CreateObject();
        cJSON_AddNumberToObject(item, "path", frame->path);
        if (!frame->is_truth) {
            dip_quality_format(&frame->quality, settings, sizeof settings);
            cJSON_AddStringToObject(item, "settings", settings);
        }
        cJSON_AddStringToObject(item, "hash", frame->hash);
        if (!cJSON_AddItemToArray(files, item)) {
            cJSON_Delete(item);
        }
    }
}

// The hash is part of a file name, so it must be one.
static bool is_hash(const char *text) {
    return strlen(text) == DIP_HASH_HEX_SIZE - 1 &&
           strspn(text, "0123456789abcdef") == DIP_HASH_HEX_SIZE - 1;
}

static bool read_frame(const cJSON *item, const DipCostReport *report, DipCostKeptFrame *frame) {
    bool ok = true;
    const cJSON *settings = cJSON_GetObjectItemCaseSensitive(item, "settings");
    const cJSON *hash = cJSON_GetObjectItemCaseSensitive(item, "hash");
    frame->path = dip_json_integer(item, "path", 0, report->path_count - 1, &ok);
    frame->is_truth = !settings;
    if (settings) {
        ok = ok && cJSON_IsString(settings) &&
             dip_quality_parse(settings->valuestring, &frame->quality, NULL);
    }
    ok = ok && cJSON_IsString(hash) && is_hash(hash->valuestring);
    if (ok) {
        memcpy(frame->hash, hash->valuestring, sizeof frame->hash);
    }
    return ok;
}

bool dip_cost_frames_read(const cJSON *root, DipCostReport *report, const char *file,
                          DipError *err) {
    const cJSON *frames = cJSON_GetObjectItemCaseSensitive(root, "frames");
    const cJSON *files = cJSON_GetObjectItemCaseSensitive(frames, "files");
    const int count = cJSON_GetArraySize(files);
    bool ok = true;
    if (!frames) {
        return true;
    }
    DipCostKeptFrames *kept = &report->kept;
    kept->viewpoint = dip_json_integer(frames, "place", 0, report->options.places - 1, &ok);
    if (!ok || count > DIP_COST_MAX_ROWS + DIP_COST_MAX_PATHS) {
        return dip_json_missing(file, "frames", err);
    }
    kept->list = calloc((size_t)count + 1, sizeof *kept->list);
    if (!kept->list) {
        return dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory");
    }
    const cJSON *item;
    cJSON_ArrayForEach(item, files) {
        ok = ok && read_frame(item, report, &kept->list[kept->count++]);
    }
    return ok || dip_json_missing(file, "frames", err);
}
