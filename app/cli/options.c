// Reads options as their tables describe them.
#include "app/cli/options.h"

#include "renderer/base/assert.h"
#include "renderer/base/nearest.h"
#include "renderer/base/number.h"
#include "renderer/scene/renderer.h"

#include <stdio.h>
#include <string.h>

enum {
    MAX_ROWS = 64, // Greatest number of options of one command.
    MAX_VALUE = 80 // Most bytes of one value in a list, with its terminator.
};

// --- reading values ------------------------------------------------------------------------------

bool dip_option_refuse(DipError *err, DipErrorCode code, const char *key, const char *value,
                       const char *what) {
    return dip_error_set(err, code, NULL, 0, key, "'%.120s' is not %s", value, what);
}

static bool refuse_row(const DipOptionRow *row, const char *value, const char *what,
                       DipError *err) {
    return dip_option_refuse(err, DIP_ERROR_RANGE, row->name, value,
                             row->accepted ? row->accepted : what);
}

static bool read_integer(const DipOptionRow *row, const char *value, int *number, DipError *err) {
    int found;
    if (!dip_integer_parse(value, strlen(value), &found) || found < row->least ||
        found > row->most) {
        char what[64];
        snprintf(what, sizeof what, "a whole number from %.0f to %.0f", row->least, row->most);
        return refuse_row(row, value, what, err);
    }
    *number = found;
    return true;
}

static bool read_number(const DipOptionRow *row, const char *value, double *number, DipError *err) {
    double found;
    if (!dip_number_parse(value, strlen(value), &found) ||
        !(found >= row->least && found <= row->most)) {
        char what[64];
        snprintf(what, sizeof what, "a number from %g to %g", row->least, row->most);
        return refuse_row(row, value, what, err);
    }
    *number = found;
    return true;
}

int dip_option_integers(const char *text, char separator, int count, int *values) {
    int found = 0;
    for (;;) {
        const char *end = strchr(text, separator);
        const size_t length = end ? (size_t)(end - text) : strlen(text);
        if (found == count || !dip_integer_parse(text, length, &values[found])) {
            return 0;
        }
        found++;
        if (!end) {
            return found;
        }
        text = end + 1;
    }
}

static bool read_size(const DipOptionRow *row, const char *value, DipOptionSize *size,
                      DipError *err) {
    int found[2];
    if (dip_option_integers(value, 'x', 2, found) != 2 || found[0] < 1 || found[1] < 1 ||
        found[0] > DIP_MAX_FRAME_SIZE || found[1] > DIP_MAX_FRAME_SIZE) {
        char what[80];
        snprintf(what, sizeof what, "WIDTHxHEIGHT in pixels, each from 1 to %d, such as 640x480",
                 DIP_MAX_FRAME_SIZE);
        return refuse_row(row, value, what, err);
    }
    *size = (DipOptionSize){found[0], found[1]};
    return true;
}

static bool read_set(const char *value, DipOptionSet *set, DipError *err) {
    snprintf(set->text, sizeof set->text, "%s", value);
    return dip_quality_parse(value, &set->quality, err);
}

static bool read_choice(const DipOptionRow *row, const char *value, int *choice, DipError *err) {
    for (int i = 0; i < (int)row->most; i++) {
        if (strcmp(value, row->names[i]) == 0) {
            *choice = i;
            return true;
        }
    }
    return dip_option_refuse(err, DIP_ERROR_UNKNOWN, row->name, value, row->accepted);
}

// Appends a value to the values of a LIST.
static bool read_item(const DipOptionRow *row, const char *value, void *fields, DipError *err) {
    int *count = (int *)((char *)fields + row->count);
    DipOptionRow item = *row;
    if (*count >= row->room) {
        return dip_error_set(err, DIP_ERROR_OVERSIZED, NULL, 0, row->name,
                             "lists more than %d values", row->room);
    }
    item.kind = row->read ? DIP_OPTION_CUSTOM : row->item;
    item.separator = '\0';
    item.field += (size_t)*count * (row->item == DIP_OPTION_NUMBER ? sizeof(double)
                                    : row->item == DIP_OPTION_SIZE ? sizeof(DipOptionSize)
                                    : row->item == DIP_OPTION_SET  ? sizeof(DipOptionSet)
                                                                   : sizeof(int));
    if (!dip_option_store(&item, value, fields, err)) {
        return false;
    }
    ++*count;
    return true;
}

// Splits `value` at the separators and stores each part.
static bool read_each(const DipOptionRow *row, const char *value, void *fields, DipError *err) {
    for (const char *from = value; from;) {
        const char *end = strchr(from, row->separator);
        const size_t length = end ? (size_t)(end - from) : strlen(from);
        char item[MAX_VALUE];
        if (length == 0) {
            return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, row->name,
                                 "'%.200s' holds an empty value; write one '%c' between two values",
                                 value, row->separator);
        }
        if (length >= sizeof item) {
            return dip_error_set(err, DIP_ERROR_OVERSIZED, NULL, 0, row->name,
                                 "'%.200s' holds a value of more than %d letters", value,
                                 MAX_VALUE - 1);
        }
        memcpy(item, from, length);
        item[length] = '\0';
        if (!(row->kind == DIP_OPTION_LIST ? read_item(row, item, fields, err)
                                           : row->read(fields, row, item, err))) {
            return false;
        }
        from = end ? end + 1 : NULL;
    }
    return true;
}

static bool add_text(const DipOptionRow *row, const char *value, void *fields, DipError *err) {
    const char **texts = (const char **)((char *)fields + row->field);
    int *count = (int *)((char *)fields + row->count);
    if (*count >= row->room) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, row->name,
                             "is given more than %d times", row->room);
    }
    texts[(*count)++] = value;
    return true;
}

bool dip_option_store(const DipOptionRow *row, const char *value, void *fields, DipError *err) {
    void *field = (char *)fields + row->field;
    switch (row->kind) {
    case DIP_OPTION_FLAG:
        *(bool *)field = true;
        return true;
    case DIP_OPTION_TEXT:
        *(const char **)field = value;
        return true;
    case DIP_OPTION_TEXTS:
        return add_text(row, value, fields, err);
    case DIP_OPTION_INTEGER:
        return read_integer(row, value, field, err);
    case DIP_OPTION_NUMBER:
        return read_number(row, value, field, err);
    case DIP_OPTION_SIZE:
        return read_size(row, value, field, err);
    case DIP_OPTION_SETTINGS:
        return dip_quality_parse(value, field, err);
    case DIP_OPTION_SET:
        return read_set(value, field, err);
    case DIP_OPTION_CHOICE:
        return read_choice(row, value, field, err);
    case DIP_OPTION_LIST:
        *(int *)((char *)fields + row->count) = 0;
        return read_each(row, value, fields, err);
    case DIP_OPTION_CUSTOM:
        return row->separator ? read_each(row, value, fields, err)
                              : row->read(fields, row, value, err);
    }
    return false;
}

// --- finding options -----------------------------------------------------------------------------

const DipOptionRow *dip_option_find(const DipOptionParts *parts, const char *name,
                                    const DipOptionPart **part) {
    for (size_t p = 0; p < parts->count; p++) {
        for (size_t r = 0; r < parts->items[p].table->count; r++) {
            if (strcmp(parts->items[p].table->rows[r].name, name) == 0) {
                *part = &parts->items[p];
                return &parts->items[p].table->rows[r];
            }
        }
    }
    return NULL;
}

// Fails. If an option of this command is similar enough, the message suggests that option.
static bool unknown_option(const DipOptionParts *parts, const char *command, const char *name,
                           DipError *err) {
    const char *names[MAX_ROWS];
    size_t count = 0;
    for (size_t p = 0; p < parts->count; p++) {
        for (size_t r = 0; r < parts->items[p].table->count; r++) {
            DIP_ASSERT(count < MAX_ROWS);
            names[count++] = parts->items[p].table->rows[r].name;
        }
    }
    const char *likely = dip_nearest_likely(name, names, count);
    return likely ? dip_error_set(err, DIP_ERROR_UNKNOWN, NULL, 0, name,
                                  "is not an option of `diptych %s`; did you mean %s?", command,
                                  likely)
                  : dip_error_set(err, DIP_ERROR_UNKNOWN, NULL, 0, name,
                                  "is not an option of `diptych %s`; `diptych %s --help` lists "
                                  "its options",
                                  command, command);
}

bool dip_option_parse(const DipOptionParts *parts, const char *command, int argc, char *const *argv,
                      int *index, void *options, DipError *err) {
    const char *argument = strcmp(argv[*index], "-h") == 0 ? "--help" : argv[*index];
    const char *equals = strchr(argument, '=');
    char name[64];
    snprintf(name, sizeof name, "%.*s", equals ? (int)(equals - argument) : 63, argument);
    const DipOptionPart *part = NULL;
    const DipOptionRow *row = dip_option_find(parts, name, &part);
    if (!row) {
        return unknown_option(parts, command, name, err);
    }
    const char *value = NULL;
    if (row->kind == DIP_OPTION_FLAG && equals) {
        return dip_error_set(err, DIP_ERROR_TYPE, NULL, 0, row->name, "takes no value");
    }
    if (row->kind != DIP_OPTION_FLAG) {
        value = equals ? equals + 1 : *index + 1 < argc ? argv[++*index] : NULL;
        if (!value || !*value) {
            return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, row->name, "needs a value: %s %s",
                                 row->name, row->argument);
        }
    }
    char *fields = (char *)options + part->offset;
    if (row->given) {
        *(bool *)(fields + row->given) = true;
    }
    return dip_option_store(row, value, fields, err);
}
