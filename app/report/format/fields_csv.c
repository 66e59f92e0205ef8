// Fields as comma-separated values (RFC 4180).
#include "app/files/put.h"
#include "app/report/format/fields.h"
#include "renderer/scene/quality.h"

#include <math.h>
#include <string.h>

enum { NAME_ROOM = 96 };

typedef struct Cells {
    FILE *out;
    const DipColumn *column;
    bool is_head;
    bool is_first;
} Cells;

static void begin_cell(Cells *cells) {
    fputs(cells->is_first ? "" : ",", cells->out);
    cells->is_first = false;
}

// Writes a name, "flip" and "_low".
static void put_name(Cells *cells, const char *name, const char *end) {
    begin_cell(cells);
    for (const char *c = name; *c; c++) {
        fputc(*c == '.' ? '_' : *c, cells->out);
    }
    fputs(end, cells->out);
}

static void put_number(Cells *cells, double value) {
    begin_cell(cells);
    if (isfinite(value)) {
        fprintf(cells->out, "%.9g", value);
    }
}

static void put_text(Cells *cells, const char *text) {
    begin_cell(cells);
    dip_put_csv_text(cells->out, text);
}

static void visit_head(void *context, const DipField *field, const void *value) {
    Cells *cells = context;
    const char *name = cells->column->title ? cells->column->title : cells->column->path;
    (void)value;
    if (field->kind == DIP_FIELD_NUMBERS) {
        for (size_t i = 0; i < field->size / sizeof(double); i++) {
            char full[NAME_ROOM];
            snprintf(full, sizeof full, "%s%s%s", name, *name ? "_" : "", field->names[i]);
            put_name(cells, full, "");
        }
        return;
    }
    put_name(cells, name, "");
    if (field->kind == DIP_FIELD_ESTIMATE) {
        put_name(cells, name, "_low");
        put_name(cells, name, "_high");
    }
}

static void put_estimate(Cells *cells, const DipEstimate *estimate) {
    const bool has = estimate && dip_field_has_interval(estimate);
    put_number(cells, estimate ? estimate->value : NAN);
    put_number(cells, has ? estimate->low : NAN);
    put_number(cells, has ? estimate->high : NAN);
}

static void visit_cell(void *context, const DipField *field, const void *value) {
    Cells *cells = context;
    char settings[256];
    switch (value ? field->kind : DIP_FIELD_NUMBER) {
    case DIP_FIELD_TEXT:
        put_text(cells, value);
        break;
    case DIP_FIELD_NAMED:
        put_text(cells, field->names[*(const int *)value]);
        break;
    case DIP_FIELD_SETTINGS:
        dip_quality_format(value, settings, sizeof settings);
        put_text(cells, settings);
        break;
    case DIP_FIELD_WHOLE:
        put_number(cells, *(const int *)value);
        break;
    case DIP_FIELD_FLAG:
        put_text(cells, *(const bool *)value ? "true" : "false");
        break;
    default: // A number, or a value that is not known.
        if (field->kind == DIP_FIELD_ESTIMATE) {
            put_estimate(cells, value);
            break;
        }
        const size_t count = field->kind == DIP_FIELD_NUMBERS ? field->size / sizeof(double) : 1;
        for (size_t i = 0; i < count; i++) {
            put_number(cells, value ? ((const double *)value)[i] : NAN);
        }
    }
}

void dip_fields_print_csv(const DipRecord *record, const DipFieldAt *at, const DipColumn *columns,
                          int count, FILE *out) {
    Cells cells = {.out = out, .is_head = !at->item, .is_first = true};
    for (int c = 0; c < count; c++) {
        cells.column = &columns[c];
        dip_field_visit(record, at, columns[c].path, at->item ? visit_cell : visit_head, &cells);
    }
    fputc('\n', out);
}
