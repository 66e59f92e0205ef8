// Writes fields as comma-separated values (RFC 4180).
#include "app/files/put.h"
#include "app/report/format/fields.h"

#include <math.h>

// Writes the names of a column's cells. A cell's name is the column's name with '_' in place of
// '.', and an ending such as "_low" if the column has several cells.
static void put_names(const DipColumn *column, const DipField *field, FILE *out) {
    static const char *const of_estimate[] = {"", "low", "high"};
    const char *name = column->has_title ? column->title : column->path;
    const bool is_object = field->kind == DIP_FIELD_NUMBERS;
    const char *const *ends = is_object ? field->names : of_estimate;
    const int count = is_object                           ? (int)(field->size / sizeof(double))
                      : field->kind == DIP_FIELD_ESTIMATE ? 3
                                                          : 1;
    for (int i = 0; i < count; i++) {
        fputs(i > 0 ? "," : "", out);
        for (const char *c = name; *c; c++) {
            fputc(*c == '.' ? '_' : *c, out);
        }
        fprintf(out, "%s%s", *name && *ends[i] ? "_" : "", ends[i]);
    }
}

static void put_numbers(const double *values, int count, FILE *out) {
    for (int i = 0; i < count; i++) {
        fputs(i > 0 ? "," : "", out);
        if (values && isfinite(values[i])) {
            fprintf(out, "%.9g", values[i]);
        }
    }
}

static void put_value(const DipField *field, const void *value, FILE *out) {
    const DipEstimate unknown = dip_estimate_unknown(NAN);
    const DipEstimate *estimate = value ? value : &unknown;
    char settings[DIP_SETTINGS_BYTES];
    const char *text = value ? dip_field_as_text(field, value, settings) : NULL;
    if (field->kind == DIP_FIELD_ESTIMATE) {
        const bool has = dip_field_has_interval(estimate);
        const double ends[] = {estimate->value, has ? estimate->low : NAN,
                               has ? estimate->high : NAN};
        put_numbers(ends, 3, out);
    } else if (field->kind == DIP_FIELD_NUMBERS) {
        put_numbers(value, (int)(field->size / sizeof(double)), out);
    } else if (text) {
        dip_put_csv_text(out, text);
    } else if (value && field->kind == DIP_FIELD_FLAG) {
        dip_put_csv_text(out, *(const bool *)value ? "true" : "false");
    } else if (value) {
        const double number =
            field->kind == DIP_FIELD_WHOLE ? *(const int *)value : *(const double *)value;
        put_numbers(&number, 1, out);
    }
}

void dip_fields_print_csv(const DipRecord *record, const DipFieldAt *at, const char *columns,
                          FILE *out) {
    const char *between = "";
    for (DipColumn column; dip_column_take(&columns, &column); between = ",") {
        DipFieldFound found;
        dip_field_find(record, at, column.path, &found);
        fputs(between, out);
        if (at->item) {
            put_value(&found.field, found.value, out);
        } else {
            put_names(&column, &found.field, out);
        }
    }
    fputc('\n', out);
}
