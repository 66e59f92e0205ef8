// Writes the record as JSON, a line per pane.
#include "app/dump/record.h"

#include "app/files/put.h"
#include "app/files/whole_file.h"

#include <stdlib.h>
#include <string.h>

struct DipRecord {
    FILE *out; // Writes to the text.
    char *text;
    size_t size;
    int count; // Frames.
};

static bool out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "record", "out of memory");
}

DipRecord *dip_record_create(DipError *err) {
    DipRecord *record = calloc(1, sizeof *record);
    if (record) {
        record->out = open_memstream(&record->text, &record->size);
    }
    if (!record || !record->out) {
        dip_record_destroy(&record);
        out_of_memory(err);
        return NULL;
    }
    fputs("{\"frames\": [", record->out);
    return record;
}

void dip_record_destroy(DipRecord **record) {
    if (*record) {
        if ((*record)->out) {
            fclose((*record)->out);
        }
        free((*record)->text);
        free(*record);
        *record = NULL;
    }
}

// Writes `before` and a number, with as few digits as tell it from all others.
static void put_number(FILE *out, const char *before, double value) {
    char text[32];
    snprintf(text, sizeof text, "%.15g", value);
    if (strtod(text, NULL) != value) {
        snprintf(text, sizeof text, "%.17g", value);
    }
    fprintf(out, "%s%s", before, text);
}

static void put_numbers(FILE *out, const char *before, const double *values, int count) {
    for (int i = 0; i < count; i++) {
        put_number(out, i ? ", " : before, values[i]);
    }
    fputs("]", out);
}

static void put_pane(FILE *out, const char *name, const DipRecordPane *pane) {
    char settings[256];
    const DipFrame *frame = pane->frame;
    const char *between = "";
    dip_quality_format(pane->quality, settings, sizeof settings);
    fprintf(out, ",\n \"%s\": {\"settings\": \"%s\", \"hash\": \"%s\", \"copied\": %s", name,
            settings, pane->hash, pane->copied ? "true" : "false");
    put_number(out, ", \"ms\": ", frame->stages.total_ms);
    fputs(", \"stages_ms\": {", out);
#define PUT_STAGE(name, text)                                                                      \
    fprintf(out, "%s\"%s\": ", between, #name);                                                    \
    put_number(out, "", frame->stages.name##_ms);                                                  \
    between = ", ";
    DIP_STAGE_LIST(PUT_STAGE)
#undef PUT_STAGE
    fputs("}, \"counters\": {", out);
    between = "";
#define PUT_COUNTER(name, text)                                                                    \
    fprintf(out, "%s\"%s\": %llu", between, #name, (unsigned long long)frame->counters.name);      \
    between = ", ";
    DIP_COUNTER_LIST(PUT_COUNTER)
#undef PUT_COUNTER
    fputs("}, \"effects\": {", out);
    between = "";
#define PUT_EFFECT(name, text)                                                                     \
    fprintf(out, "%s\"%s\": {\"run\": %s, \"why\": ", between, #name,                              \
            frame->effects.name.run ? "true" : "false");                                           \
    dip_put_script_string(out, frame->effects.name.why);                                           \
    between = "}, ";
    DIP_EFFECT_LIST(PUT_EFFECT)
#undef PUT_EFFECT
    fputs("}}}", out);
}

bool dip_record_add(DipRecord *record, int index, double time_s, const DipPose *pose, double ms,
                    const DipRecordPane panes[2], DipError *err) {
    FILE *out = record->out;
    fprintf(out, "%s\n{\"index\": %d", record->count++ ? "," : "", index);
    put_number(out, ", \"time_s\": ", time_s);
    put_numbers(out, ", \"pose\": {\"position\": [", pose->position_world, 3);
    put_numbers(out, ", \"orientation\": [", pose->orientation, 4);
    put_number(out, ", \"fov_y_deg\": ", pose->fov_y_deg);
    put_number(out, "}, \"ms\": ", ms);
    put_pane(out, "current", &panes[0]);
    put_pane(out, "requested", &panes[1]);
    fputs("}", out);
    return (fflush(out) == 0 && !ferror(out)) || out_of_memory(err);
}

bool dip_record_set_start(DipRecord *record, const DipStartTimes *times, size_t peak_rss_bytes,
                          DipError *err) {
    const char *between = "],\n\"load_ms\": {";
#define PUT_PART(name, text)                                                                       \
    fprintf(record->out, "%s\"%s\": ", between, #name);                                            \
    put_number(record->out, "", times->name##_ms);                                                 \
    between = ", ";
    DIP_START_TIME_LIST(PUT_PART)
#undef PUT_PART
    fprintf(record->out, "},\n\"peak_rss_bytes\": %zu}\n", peak_rss_bytes);
    return (fflush(record->out) == 0 && !ferror(record->out)) || out_of_memory(err);
}

bool dip_record_write(const DipRecord *record, const char *file, DipError *err) {
    return dip_whole_file_write(file, record->text, record->size, err);
}

void dip_record_print(const DipRecord *record, FILE *out) {
    fwrite(record->text, 1, record->size, out);
}
