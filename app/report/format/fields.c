// What all forms ask of a field.
#include "app/report/format/fields.h"

#include "renderer/base/assert.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const void *dip_field_value(const DipField *field, const DipFieldAt *at, DipFieldScratch *scratch) {
    return !at->item || (field->known && !field->known(at)) ? NULL
           : field->derive                                  ? field->derive(at, scratch)
                           : (const char *)at->item + field->offset;
}

int dip_field_list_count(const DipFieldList *list, const DipFieldAt *at) {
    return list->count ? list->count(at) : *(const int *)((const char *)at->item + list->counted);
}

const void *dip_field_list_item(const DipFieldList *list, const DipFieldAt *at, int index,
                                DipFieldScratch *scratch) {
    if (list->item) {
        return list->item(at, index, scratch);
    }
    const char *items = (const char *)at->item + list->items;
    const size_t size = list->record ? list->record->size : list->element->size;
    return (list->points ? *(const char *const *)items : items) +
           (size_t)index * (list->stride ? list->stride : size) + list->within;
}

bool dip_field_has_interval(const DipEstimate *estimate) {
    return isfinite(estimate->low) && isfinite(estimate->high) && estimate->low < estimate->high;
}

void dip_field_format_exact(double value, char text[32]) {
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, 32, "%.*g", digits, value);
        if (strtod(text, NULL) == value) {
            return;
        }
    }
}

void dip_field_visit(const DipRecord *record, const DipFieldAt *at, const char *path,
                     DipFieldVisit *visit, void *context) {
    const size_t length = strcspn(path, ".");
    for (int f = 0; f < record->count; f++) {
        const DipField *field = &record->fields[f];
        DipFieldScratch scratch;
        if (strlen(field->name) != length || memcmp(field->name, path, length) != 0) {
            continue;
        }
        const void *value = dip_field_value(field, at, &scratch);
        if (!path[length]) {
            visit(context, field, value);
        } else if (field->kind == DIP_FIELD_ESTIMATE) {
            DipField number = *field;
            const bool is_value = strcmp(path + length, ".value") == 0;
            DIP_ASSERT(is_value);
            (void)is_value;
            number.kind = DIP_FIELD_NUMBER;
            visit(context, &number, value ? &((const DipEstimate *)value)->value : NULL);
        } else {
            DIP_ASSERT(field->kind == DIP_FIELD_RECORD);
            const DipFieldAt within = {at->context, value, at->index, at};
            dip_field_visit(field->record, &within, path + length + 1, visit, context);
        }
        return;
    }
    DIP_ASSERT(false && "no such field");
}
