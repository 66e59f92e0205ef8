// Writes the record (record.h) as JSON, with a line for each pane of a frame.
#include "app/dump/record.h"

#include "app/files/put.h"
#include "app/files/whole_file.h"

#include <stdlib.h>
#include <string.h>

struct DipRecord {
    FILE *out; // A stream in memory that writes to `text`.
    char *text;
    size_t size; // Bytes of the text.
    int count;   // Number of frames.
};

DipRecord *dip_record_create(DipError *err) {
    DipRecord *record = calloc(1, sizeof *record);
    if (record) {
        record->out = open_memstream(&record->text, &record->size);
    }
    if (!record || !record->out) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "record", "out of memory");
        dip_record_destroy(&record);
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

// Writes `before` and a number. 15 digits are enough for most numbers; if reading them back gives
// another number, writes 17.
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

static void put_pane(FILE *out, const DipDrawnFrame *drawn, int pane) {
    char settings[DIP_SETTINGS_BYTES];
    const DipFrame *frame = &drawn->frame.panes[pane];
    const bool copied = pane == DIP_PANE_REQUESTED && drawn->frame.copied;
    const char *between = "";
    dip_quality_format(&drawn->qualities[pane], settings, sizeof settings);
    fprintf(out, ",\n \"%s\": {\"settings\": \"%s\", \"hash\": \"%s\", \"copied\": %s",
            dip_pane_names[pane], settings, drawn->hashes[pane], copied ? "true" : "false");
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

static bool finish(FILE *out, DipError *err) {
    return (fflush(out) == 0 && !ferror(out)) ||
           dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "record", "out of memory");
}

bool dip_record_add(DipRecord *record, const DipDrawnFrame *drawn, DipError *err) {
    FILE *out = record->out;
    fprintf(out, "%s\n{\"index\": %d", record->count++ ? "," : "", drawn->index);
    put_number(out, ", \"time_s\": ", 1e-9 * (double)drawn->time_ns);
    put_numbers(out, ", \"pose\": {\"position\": [", drawn->pose.position_world, 3);
    put_numbers(out, ", \"orientation\": [", drawn->pose.orientation, 4);
    put_number(out, ", \"fov_y_deg\": ", drawn->pose.fov_y_deg);
    put_number(out, "}, \"ms\": ", drawn->frame.ms);
    put_pane(out, drawn, DIP_PANE_CURRENT);
    put_pane(out, drawn, DIP_PANE_REQUESTED);
    fputs("}", out);
    return finish(out, err);
}

// Writes a text, or null if it is empty.
static void put_text(FILE *out, const char *before, const char *text) {
    fputs(before, out);
    if (text[0]) {
        dip_put_script_string(out, text);
    } else {
        fputs("null", out);
    }
}

bool dip_record_set_warnings(DipRecord *record, const DipErrorList *warnings, int left_out,
                             DipError *err) {
    FILE *out = record->out;
    fputs("],\n\"warnings\": [", out);
    for (size_t i = 0; i < warnings->count; i++) {
        const DipError *warning = &warnings->items[i];
        put_text(out, i ? ",\n{\"file\": " : "\n{\"file\": ", warning->file);
        if (warning->line > 0) {
            fprintf(out, ", \"line\": %d", warning->line);
        } else {
            fputs(", \"line\": null", out);
        }
        put_text(out, ", \"key\": ", warning->key);
        put_text(out, ", \"message\": ", warning->message);
        fputs("}", out);
    }
    fprintf(out, "],\n\"warnings_left_out\": %d", left_out);
    return finish(out, err);
}

bool dip_record_set_start(DipRecord *record, const DipStartTimes *times, size_t peak_rss_bytes,
                          DipError *err) {
    const char *between = ",\n\"load_ms\": {";
#define PUT_PART(name, text)                                                                       \
    fprintf(record->out, "%s\"%s\": ", between, #name);                                            \
    put_number(record->out, "", times->name##_ms);                                                 \
    between = ", ";
    DIP_START_TIME_LIST(PUT_PART)
#undef PUT_PART
    fprintf(record->out, "},\n\"peak_rss_bytes\": %zu}\n", peak_rss_bytes);
    return finish(record->out, err);
}

bool dip_record_write(const DipRecord *record, const char *file, DipError *err) {
    return dip_whole_file_write(file, record->text, record->size, err);
}

void dip_record_print(const DipRecord *record, FILE *out) {
    fwrite(record->text, 1, record->size, out);
}
