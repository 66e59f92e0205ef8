// Finds fields and their values, for JSON, CSV and tables.
#include "app/report/format/fields.h"

#include "renderer/base/assert.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

void *dip_field_member(const DipField *field, const DipFieldAt *at) {
    return (char *)at->item + field->offset + (size_t)at->index * field->stride;
}

const void *dip_field_value(const DipField *field, const DipFieldAt *at, DipFieldScratch *scratch) {
    return !at->item || (field->known && !field->known(at)) ? NULL
           : field->derive                                  ? field->derive(at, scratch)
                                                            : dip_field_member(field, at);
}

const char *dip_field_as_text(const DipField *field, const void *value,
                              char settings[DIP_SETTINGS_BYTES]) {
    if (field->kind == DIP_FIELD_SETTINGS) {
        dip_quality_format(value, settings, DIP_SETTINGS_BYTES);
        return settings;
    }
    return field->kind == DIP_FIELD_TEXT    ? value
           : field->kind == DIP_FIELD_NAMED ? field->names[*(const int *)value]
                                            : NULL;
}

bool dip_field_has_interval(const DipEstimate *estimate) {
    return isfinite(estimate->low) && isfinite(estimate->high) && estimate->low < estimate->high;
}

// Returns the field whose name is the first `length` characters of `name`. The rest of a dotted
// path such as "figures.all.flip" may follow them.
static const DipField *field_of(const DipRecord *record, const char *name, size_t length) {
    for (int f = 0; f < record->count; f++) {
        const DipField *field = &record->fields[f];
        if (strlen(field->name) == length && memcmp(field->name, name, length) == 0) {
            return field;
        }
    }
    DIP_ASSERT(false); // There is no such field.
    return record->fields;
}

void dip_field_find(const DipRecord *record, const DipFieldAt *at, const char *path,
                    DipFieldFound *found) {
    DipFieldAt within[DIP_FIELD_DEPTH + 1] = {*at};
    for (int level = 0;; level++) {
        DIP_ASSERT(level < DIP_FIELD_DEPTH);
        const size_t length = strcspn(path, ".");
        const DipField *field = field_of(record, path, length);
        found->field = *field;
        found->value = dip_field_value(field, &within[level], &found->scratch[level]);
        path += length;
        if (field->kind != DIP_FIELD_RECORD || !*path) {
            break;
        }
        record = field->record;
        within[level + 1] =
            (DipFieldAt){at->context, found->value, within[level].index, &within[level]};
        path++;
    }
    if (*path) {
        const bool is_value =
            found->field.kind == DIP_FIELD_ESTIMATE && strcmp(path, ".value") == 0;
        DIP_ASSERT(is_value);
        (void)is_value;
        found->field.kind = DIP_FIELD_NUMBER;
        found->value = found->value ? &((const DipEstimate *)found->value)->value : NULL;
    }
}

bool dip_column_take(const char **columns, DipColumn *column) {
    const char *list = *columns + strspn(*columns, "; ");
    const int length = (int)strcspn(list, ";"), path = (int)strcspn(list, ";=");
    const int title = path < length ? path + 1 : length;
    snprintf(column->path, sizeof column->path, "%.*s", path, list);
    snprintf(column->title, sizeof column->title, "%.*s", length - title, list + title);
    column->has_title = path < length;
    *columns = list + length;
    return length > 0;
}
