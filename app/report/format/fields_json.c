// Writes fields as JSON to a stream, and reads them from cJSON's tree.
#include "app/files/put.h"
#include "app/files/whole_file.h"
#include "app/report/format/fields.h"
#include "renderer/scene/quality.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PATH_ROOM = 96, NAME_ROOM = 64 };

// --- writing -------------------------------------------------------------------------------------

// Prints a number with 15 significant digits, or with 16 or 17 if fewer would be read as another
// number. Prints null for a number that is not finite.
static void print_number(double value, FILE *out) {
    char text[32] = "null";
    for (int digits = 15; isfinite(value) && digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, value);
        if (strtod(text, NULL) == value) {
            break;
        }
    }
    fputs(text, out);
}

static void print_name(const char *name, FILE *out) {
    dip_put_script_string(out, name);
    fputc(':', out);
}

static void print_estimate(const DipField *field, const DipEstimate *estimate, FILE *out) {
    const bool has = estimate && dip_field_has_interval(estimate);
    print_number(estimate ? estimate->value : NAN, out);
    fprintf(out, ",\"%s_low\":", field->name);
    print_number(has ? estimate->low : NAN, out);
    fprintf(out, ",\"%s_high\":", field->name);
    print_number(has ? estimate->high : NAN, out);
}

static void print_numbers(const DipField *field, const double *values, FILE *out) {
    const int count = (int)(field->size / sizeof *values);
    fputs(field->names ? "{" : "[", out);
    for (int i = 0; i < count; i++) {
        fputs(i ? "," : "", out);
        if (field->names) {
            print_name(field->names[i], out);
        }
        print_number(values[i], out);
    }
    fputs(field->names ? "}" : "]", out);
}

// Returns the DipFieldAt of item `index` of a list. Its member `item` is this item: a struct, or a
// single value that list->item returned. If list->item is NULL and the items are no structs of
// their own, `item` is instead the array or the struct that holds the values of all items, and
// `index` selects among them.
static DipFieldAt list_item(const DipFieldList *list, const DipFieldAt *at, int index,
                            DipFieldScratch *scratch) {
    DipFieldAt within = {at->context, NULL, index, at};
    if (list->item) {
        within.item = list->item(at, index, scratch);
    } else {
        const char *items = (const char *)at->item + list->items;
        within.item = (list->points ? *(const char *const *)items : items) +
                      (list->record ? (size_t)index * list->record->size : 0);
    }
    return within;
}

static void print_value(const DipField *field, const DipFieldAt *at, const void *value, FILE *out);

static void print_list(const DipFieldList *list, const DipFieldAt *at, FILE *out) {
    const int count =
        list->count ? list->count(at) : *(const int *)((const char *)at->item + list->counted);
    DipFieldScratch scratch, of_element;
    fputc('[', out);
    for (int i = 0; i < count; i++) {
        const DipFieldAt within = list_item(list, at, i, &scratch);
        fputs(i ? "," : "", out);
        if (list->record) {
            fputc('\n', out);
            dip_fields_print_json(list->record, &within, out);
        } else {
            print_value(list->element, &within,
                        dip_field_value(list->element, &within, &of_element), out);
        }
    }
    fputc(']', out);
}

// Prints a value. NULL means that it is not known.
static void print_value(const DipField *field, const DipFieldAt *at, const void *value, FILE *out) {
    char settings[DIP_SETTINGS_BYTES];
    const char *text = value ? dip_field_as_text(field, value, settings) : NULL;
    if (field->kind == DIP_FIELD_ESTIMATE) {
        print_estimate(field, value, out);
    } else if (text) {
        dip_put_script_string(out, text);
    } else if (!value) {
        fputs("null", out);
    } else if (field->kind == DIP_FIELD_WHOLE) {
        fprintf(out, "%d", *(const int *)value);
    } else if (field->kind == DIP_FIELD_FLAG) {
        fputs(*(const bool *)value ? "true" : "false", out);
    } else if (field->kind == DIP_FIELD_NUMBER) {
        print_number(*(const double *)value, out);
    } else if (field->kind == DIP_FIELD_NUMBERS) {
        print_numbers(field, value, out);
    } else if (field->kind == DIP_FIELD_RECORD) {
        dip_fields_print_json(field->record, &(DipFieldAt){at->context, value, at->index, at}, out);
    } else {
        print_list(field->list, at, out);
    }
}

void dip_fields_print_json(const DipRecord *record, const DipFieldAt *at, FILE *out) {
    bool first = true;
    fputc('{', out);
    for (int f = 0; f < record->count; f++) {
        const DipField *field = &record->fields[f];
        DipFieldScratch scratch;
        if (field->where & DIP_FIELD_JSON) {
            fputs(first ? "" : ",", out);
            print_name(field->name, out);
            print_value(field, at, dip_field_value(field, at, &scratch), out);
            first = false;
        }
    }
    fputc('}', out);
}

// An item that is written as a whole file.
typedef struct Whole {
    const DipRecord *record;
    DipFieldAt at;
} Whole;

static bool print_whole(const void *context, FILE *out) {
    const Whole *whole = context;
    dip_fields_print_json(whole->record, &whole->at, out);
    return true;
}

bool dip_fields_write_json(const DipRecord *record, const void *item, const char *file,
                           DipError *err) {
    const Whole whole = {record, {(void *)item, item, 0, NULL}};
    return dip_whole_file_print(file, print_whole, &whole, err);
}

// --- reading -------------------------------------------------------------------------------------

typedef struct Reader {
    char fault[PATH_ROOM]; // Path of the field at fault.
    DipErrorCode code;
} Reader;

// Puts a name before the path of the field at fault, and returns false. When a field cannot be
// read, this function is called for the field, and then for each record, item and list that it lies
// in, from the innermost to the outermost. So the path grows at its front.
static bool fail(Reader *reader, DipErrorCode code, const char *name) {
    char rest[PATH_ROOM];
    reader->code = code;
    snprintf(rest, sizeof rest, "%s", reader->fault);
    snprintf(reader->fault, PATH_ROOM, "%.40s%s%.50s", name, *rest && *rest != '[' ? "." : "",
             rest);
    return false;
}

static bool is_in_range(const DipField *field, double value) {
    return value >= field->least && value <= field->most;
}

// Reads a number, or NAN where null is accepted.
static bool read_number(const cJSON *item, const DipField *field, double *value) {
    *value = cJSON_IsNumber(item) ? item->valuedouble : NAN;
    return (field->known && cJSON_IsNull(item)) || is_in_range(field, *value);
}

static bool read_estimate(const cJSON *object, const DipField *field, DipEstimate *to) {
    static const char *const ends[] = {"_low", "_high"};
    *to = dip_estimate_unknown(NAN);
    double *const values[] = {&to->low, &to->high};
    for (int i = 0; i < 2; i++) { // The ends may lie beyond the range of values, or be unknown.
        char name[NAME_ROOM];
        snprintf(name, sizeof name, "%s%s", field->name, ends[i]);
        const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, name);
        *values[i] = cJSON_IsNumber(item) ? item->valuedouble : NAN;
        if (!cJSON_IsNull(item) && !isfinite(*values[i])) {
            return false;
        }
    }
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, field->name);
    return read_number(item, field, &to->value) &&
           ((isnan(to->low) && isnan(to->high)) || dip_field_has_interval(to));
}

static bool read_numbers(const cJSON *item, const DipField *field, double *to) {
    const int count = (int)(field->size / sizeof *to);
    if (field->names ? !cJSON_IsObject(item) : cJSON_GetArraySize(item) != count) {
        return false;
    }
    const cJSON *next = item->child; // The next number of an array.
    for (int i = 0; i < count; i++) {
        const cJSON *number =
            field->names ? cJSON_GetObjectItemCaseSensitive(item, field->names[i]) : next;
        if (!cJSON_IsNumber(number) || !is_in_range(field, number->valuedouble)) {
            return false;
        }
        to[i] = number->valuedouble;
        next = next ? next->next : NULL;
    }
    return true;
}

static bool read_named(const cJSON *item, const DipField *field, int *to) {
    for (int i = 0; cJSON_IsString(item) && i < field->name_count; i++) {
        if (strcmp(item->valuestring, field->names[i]) == 0) {
            *to = i;
            return true;
        }
    }
    return false;
}

static bool read_text(const cJSON *item, const DipField *field, char *to) {
    const bool fits = cJSON_IsString(item) && strlen(item->valuestring) < field->size;
    if (fits) {
        strcpy(to, item->valuestring);
        dip_put_clean(to); // A report stays the same when it is written and read again.
    }
    return fits;
}

// Reads a value of any kind but an estimate, a record or a list. Returns false if the item of JSON
// is wrong.
static bool read_plain(const cJSON *item, const DipField *field, void *to) {
    switch (field->kind) {
    case DIP_FIELD_TEXT:
        return read_text(item, field, to);
    case DIP_FIELD_WHOLE:
        if (!cJSON_IsNumber(item) || !is_in_range(field, item->valuedouble) ||
            floor(item->valuedouble) != item->valuedouble) {
            return false;
        }
        *(int *)to = (int)item->valuedouble;
        return true;
    case DIP_FIELD_FLAG:
        *(bool *)to = cJSON_IsTrue(item);
        return cJSON_IsBool(item);
    case DIP_FIELD_NUMBER:
        return read_number(item, field, to);
    case DIP_FIELD_SETTINGS:
        return cJSON_IsString(item) && dip_quality_parse(item->valuestring, to, NULL);
    case DIP_FIELD_NAMED:
        return read_named(item, field, to);
    default:
        return read_numbers(item, field, to);
    }
}

static bool read_record(Reader *reader, const DipRecord *record, const DipFieldAt *at,
                        const cJSON *object);

static bool read_item(Reader *reader, const DipFieldList *list, const DipFieldAt *at, int index,
                      const cJSON *from) {
    DipFieldScratch scratch;
    memset(&scratch, 0, sizeof scratch);
    const DipFieldAt within = list->put ? (DipFieldAt){at->context, &scratch, index, at}
                                        : list_item(list, at, index, &scratch);
    char name[24];
    snprintf(name, sizeof name, "[%d]", index);
    if (list->record ? !read_record(reader, list->record, &within, from)
                     : !read_plain(from, list->element, dip_field_member(list->element, &within))) {
        return fail(reader, list->record ? reader->code : DIP_ERROR_FORMAT, name);
    }
    return !list->put || list->put(at, index, within.item) || fail(reader, DIP_ERROR_FORMAT, name);
}

static DipErrorCode open_list(const DipFieldList *list, const DipFieldAt *at, int count) {
    if (list->open) {
        return list->open(at, count);
    }
    if (count < list->least || count > list->most) {
        return DIP_ERROR_FORMAT;
    }
    if (list->points) {
        void *items = calloc((size_t)count + 1, list->record->size);
        memcpy((char *)at->item + list->items, &items, sizeof items);
        if (!items) {
            return DIP_ERROR_MEMORY;
        }
    }
    *(int *)((char *)at->item + list->counted) = count;
    return DIP_ERROR_NONE;
}

static bool read_list(Reader *reader, const DipField *field, const DipFieldAt *at,
                      const cJSON *array) {
    const DipFieldList *list = field->list;
    const DipErrorCode opened =
        cJSON_IsArray(array) ? open_list(list, at, cJSON_GetArraySize(array)) : DIP_ERROR_FORMAT;
    if (opened != DIP_ERROR_NONE) {
        return fail(reader, opened, field->name);
    }
    const cJSON *item;
    int index = 0;
    cJSON_ArrayForEach(item, array) {
        if (!read_item(reader, list, at, index++, item)) {
            return fail(reader, reader->code, field->name);
        }
    }
    return true;
}

static bool read_field(Reader *reader, const DipField *field, const DipFieldAt *at,
                       const cJSON *object) {
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, field->name);
    void *to = dip_field_member(field, at);
    if (field->kind == DIP_FIELD_LIST) {
        return read_list(reader, field, at, item);
    }
    if (field->known && cJSON_IsNull(item) && field->kind != DIP_FIELD_ESTIMATE) {
        return true;
    }
    if (field->kind == DIP_FIELD_RECORD) {
        const DipFieldAt within = {at->context, to, at->index, at};
        return read_record(reader, field->record, &within, item) ||
               fail(reader, reader->code, field->name);
    }
    const bool read = field->kind == DIP_FIELD_ESTIMATE ? read_estimate(object, field, to)
                                                        : read_plain(item, field, to);
    return read || fail(reader, DIP_ERROR_FORMAT, field->name);
}

static bool read_record(Reader *reader, const DipRecord *record, const DipFieldAt *at,
                        const cJSON *object) {
    if (!cJSON_IsObject(object)) {
        return fail(reader, DIP_ERROR_FORMAT, "");
    }
    for (int f = 0; f < record->count; f++) {
        const DipField *field = &record->fields[f];
        if (field->where & DIP_FIELD_JSON && !(field->where & DIP_FIELD_DERIVED) &&
            !field->derive && !read_field(reader, field, at, object)) {
            return false;
        }
    }
    return !record->check || record->check(at) || fail(reader, DIP_ERROR_FORMAT, "");
}

bool dip_fields_read_json(const DipRecord *record, const DipFieldAt *at, const cJSON *object,
                          const char *file, DipError *err) {
    Reader reader = {.code = DIP_ERROR_NONE};
    if (read_record(&reader, record, at, object)) {
        return true;
    }
    return reader.code == DIP_ERROR_MEMORY
               ? dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory")
               : dip_error_set(err, DIP_ERROR_FORMAT, file, 0,
                               *reader.fault ? reader.fault : record->name,
                               "is missing, or is not what `diptych` writes");
}
