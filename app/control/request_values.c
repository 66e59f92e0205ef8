// Reads the values of a request's fields.
#include "app/control/request_values_private.h"

#include "renderer/base/utf8.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

// --- words of messages ---------------------------------------------------------------------------

void dip_words_add(DipWords *words, const char *word) {
    const size_t length = strlen(words->text);
    snprintf(words->text + length, sizeof words->text - length, "%s%s", length ? " " : "", word);
}

DipWords dip_words_list(const char *const *names, size_t count) {
    DipWords words = {""};
    for (size_t i = 0; i < count; ++i) {
        dip_words_add(&words, names[i]);
    }
    return words;
}

DipWords dip_words_describe(const cJSON *item) {
    DipWords words = {""};
    if (cJSON_IsString(item)) {
        const size_t length = strlen(item->valuestring);
        const size_t cut = dip_utf8_valid_bytes(item->valuestring, length < 40 ? length : 40);
        snprintf(words.text, sizeof words.text, "'%.*s%s'", (int)cut, item->valuestring,
                 cut < length ? "..." : "");
    } else if (cJSON_IsNumber(item)) {
        snprintf(words.text, sizeof words.text, "%.17g", item->valuedouble);
    } else {
        dip_words_add(&words, cJSON_IsArray(item)    ? "an array"
                              : cJSON_IsObject(item) ? "an object"
                              : cJSON_IsNull(item)   ? "null"
                                                     : "a truth value");
    }
    return words;
}

bool dip_field_refuse_type(const char *name, const cJSON *item, const char *accepted,
                           DipError *err) {
    const DipWords found = dip_words_describe(item);
    return dip_error_set(err, DIP_ERROR_TYPE, NULL, 0, name, "%s found, accepted %s", found.text,
                         accepted);
}

// --- values --------------------------------------------------------------------------------------

bool dip_field_read_text(const DipField *field, const cJSON *item, char *text, DipError *err) {
    if (!cJSON_IsString(item)) {
        return dip_field_refuse_type(field->name, item, "a text", err);
    }
    const size_t length = strlen(item->valuestring);
    if (length == 0) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, field->name,
                             "an empty text found, accepted a text of 1 to %zu bytes",
                             field->size - 1);
    }
    if (length >= field->size) {
        return dip_error_set(err, DIP_ERROR_OVERSIZED, NULL, 0, field->name,
                             "a text of %zu bytes found, accepted 1 to %zu bytes", length,
                             field->size - 1);
    }
    memcpy(text, item->valuestring, length + 1);
    return true;
}

bool dip_field_read_number(const DipField *field, const cJSON *item, double *number,
                           DipError *err) {
    const bool whole = field->kind == DIP_FIELD_INTEGER;
    if (!cJSON_IsNumber(item)) {
        return dip_field_refuse_type(field->name, item, whole ? "a whole number" : "a number", err);
    }
    const double value = item->valuedouble;
    if (!(value >= field->least && value <= field->most)) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, field->name,
                             "%.17g is out of range, accepted %g..%g", value, field->least,
                             field->most);
    }
    if (whole && floor(value) != value) {
        return dip_field_refuse_type(field->name, item, "a whole number", err);
    }
    *number = value;
    return true;
}

bool dip_field_read_name(const DipField *field, const char *what, const cJSON *item, unsigned *bits,
                         DipError *err) {
    const DipWords accepted = dip_words_list(field->names, field->size);
    if (!cJSON_IsString(item)) {
        return dip_field_refuse_type(field->name, item, accepted.text, err);
    }
    for (size_t i = 0; i < field->size; ++i) {
        if (strcmp(item->valuestring, field->names[i]) == 0) {
            *bits |= 1u << i;
            return true;
        }
    }
    const DipWords found = dip_words_describe(item);
    return dip_error_set(err, DIP_ERROR_UNKNOWN, NULL, 0, field->name, "%s is no %s, accepted %s",
                         found.text, what, accepted.text);
}

// Reads a name, or an array of at least one name.
static bool read_names(const DipField *field, const cJSON *item, unsigned *bits, DipError *err) {
    if (!cJSON_IsArray(item)) {
        return dip_field_read_name(field, "name", item, bits, err);
    }
    const cJSON *name;
    cJSON_ArrayForEach(name, item) {
        if (!dip_field_read_name(field, "name", name, bits, err)) {
            return false;
        }
    }
    if (*bits == 0) {
        const DipWords accepted = dip_words_list(field->names, field->size);
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, field->name,
                             "an empty array found, accepted %s", accepted.text);
    }
    return true;
}

bool dip_field_read(const DipField *field, const cJSON *item, void *values, DipError *err) {
    char *to = (char *)values + field->offset;
    double number = 0.0;
    unsigned bits = 0;
    switch (field->kind) {
    case DIP_FIELD_TEXT:
        return dip_field_read_text(field, item, to, err);
    case DIP_FIELD_NAMES:
        if (!read_names(field, item, &bits, err)) {
            return false;
        }
        memcpy(to, &bits, sizeof bits);
        return true;
    case DIP_FIELD_NUMBER:
        if (!dip_field_read_number(field, item, &number, err)) {
            return false;
        }
        memcpy(to, &number, sizeof number);
        return true;
    case DIP_FIELD_INTEGER:
        if (!dip_field_read_number(field, item, &number, err)) {
            return false;
        }
        memcpy(to, &(int){(int)number}, sizeof(int));
        return true;
    }
    return false;
}
