// Builds the record with cJSON.
#include "app/dump/record.h"

#include "app/files/whole_file.h"

#include <cjson/cJSON.h>
#include <stdlib.h>
#include <string.h>

struct DipRecord {
    cJSON *root;
    cJSON *frames;
};

DipRecord *dip_record_create(DipError *err) {
    DipRecord *record = calloc(1, sizeof *record);
    if (record) {
        record->root = cJSON_CreateObject();
        record->frames = cJSON_AddArrayToObject(record->root, "frames");
    }
    if (!record || !record->frames) {
        dip_record_destroy(&record);
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "record", "out of memory");
    }
    return record;
}

void dip_record_destroy(DipRecord **record) {
    if (*record) {
        cJSON_Delete((*record)->root);
        free(*record);
        *record = NULL;
    }
}

static bool add_numbers(cJSON *object, const char *name, const double *values, int count) {
    cJSON *array = cJSON_CreateDoubleArray(values, count);
    if (!array || !cJSON_AddItemToObject(object, name, array)) {
        cJSON_Delete(array);
        return false;
    }
    return true;
}

static bool add_pose(cJSON *frame, const DipPose *pose) {
    cJSON *object = cJSON_AddObjectToObject(frame, "pose");
    return object && add_numbers(object, "position", pose->position_world, 3) &&
           add_numbers(object, "orientation", pose->orientation, 4) &&
           cJSON_AddNumberToObject(object, "fov_y_deg", pose->fov_y_deg);
}

static bool add_stages(cJSON *pane, const DipStageTimes *stages) {
    cJSON *object = cJSON_AddObjectToObject(pane, "stages_ms");
    bool added = object != NULL;
#define ADD_STAGE(name, text)                                                                      \
    added = added && cJSON_AddNumberToObject(object, #name, stages->name##_ms);
    DIP_STAGE_LIST(ADD_STAGE)
#undef ADD_STAGE
    return added;
}

static bool add_counters(cJSON *pane, const DipCounters *counters) {
    cJSON *object = cJSON_AddObjectToObject(pane, "counters");
    bool added = object != NULL;
#define ADD_COUNTER(name, text)                                                                    \
    added = added && cJSON_AddNumberToObject(object, #name, (double)counters->name);
    DIP_COUNTER_LIST(ADD_COUNTER)
#undef ADD_COUNTER
    return added;
}

static bool add_effect(cJSON *effects, const char *name, const DipEffect *effect) {
    cJSON *object = cJSON_AddObjectToObject(effects, name);
    return object && cJSON_AddBoolToObject(object, "run", effect->run) &&
           cJSON_AddStringToObject(object, "why", effect->why);
}

static bool add_effects(cJSON *pane, const DipEffects *effects) {
    cJSON *object = cJSON_AddObjectToObject(pane, "effects");
    bool added = object != NULL;
#define ADD_EFFECT(name, text) added = added && add_effect(object, #name, &effects->name);
    DIP_EFFECT_LIST(ADD_EFFECT)
#undef ADD_EFFECT
    return added;
}

static bool add_pane(cJSON *frame, const char *name, const DipRecordPane *pane) {
    char settings[256];
    dip_quality_format(pane->quality, settings, sizeof settings);
    cJSON *object = cJSON_AddObjectToObject(frame, name);
    return object && cJSON_AddStringToObject(object, "settings", settings) &&
           cJSON_AddStringToObject(object, "hash", pane->hash) &&
           cJSON_AddBoolToObject(object, "copied", pane->copied) &&
           cJSON_AddNumberToObject(object, "ms", pane->frame->stages.total_ms) &&
           add_stages(object, &pane->frame->stages) &&
           add_counters(object, &pane->frame->counters) &&
           add_effects(object, &pane->frame->effects);
}

bool dip_record_add(DipRecord *record, int index, double time_s, const DipPose *pose, double ms,
                    const DipRecordPane panes[2], DipError *err) {
    cJSON *frame = cJSON_CreateObject();
    const bool made = frame && cJSON_AddNumberToObject(frame, "index", index) &&
                      cJSON_AddNumberToObject(frame, "time_s", time_s) && add_pose(frame, pose) &&
                      cJSON_AddNumberToObject(frame, "ms", ms) &&
                      add_pane(frame, "current", &panes[0]) &&
                      add_pane(frame, "requested", &panes[1]);
    if (!made || !cJSON_AddItemToArray(record->frames, frame)) {
        cJSON_Delete(frame);
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "record", "out of memory");
    }
    return true;
}

bool dip_record_set_start(DipRecord *record, const DipStartTimes *times, size_t peak_rss_bytes,
                          DipError *err) {
    cJSON *object = cJSON_AddObjectToObject(record->root, "load_ms");
    bool added = object != NULL;
#define ADD_PART(name, text)                                                                       \
    added = added && cJSON_AddNumberToObject(object, #name, times->name##_ms);
    DIP_START_TIME_LIST(ADD_PART)
#undef ADD_PART
    added =
        added && cJSON_AddNumberToObject(record->root, "peak_rss_bytes", (double)peak_rss_bytes);
    return added || dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "record", "out of memory");
}

bool dip_record_write(const DipRecord *record, const char *file, DipError *err) {
    char *text = cJSON_Print(record->root);
    const bool written = text
                             ? dip_whole_file_write(file, text, strlen(text), err)
                             : dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory");
    cJSON_free(text);
    return written;
}

bool dip_record_print(const DipRecord *record, FILE *out, DipError *err) {
    char *text = cJSON_Print(record->root);
    if (!text) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "record", "out of memory");
    }
    fprintf(out, "%s\n", text);
    cJSON_free(text);
    return true;
}
