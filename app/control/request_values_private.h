// The values of a request's fields, and the words of messages about them. Private to the control
// channel.
#ifndef DIP_APP_CONTROL_REQUEST_VALUES_PRIVATE_H
#define DIP_APP_CONTROL_REQUEST_VALUES_PRIVATE_H

#include "renderer/base/error.h"

#include <stddef.h>

struct cJSON;

typedef enum DipFieldKind {
    DIP_FIELD_TEXT,    // char[size], not empty
    DIP_FIELD_NUMBER,  // double
    DIP_FIELD_INTEGER, // int
    DIP_FIELD_NAMES    // unsigned: a bit per name; in JSON a name or an array of names
} DipFieldKind;

typedef struct DipField {
    const char *name;
    DipFieldKind kind;
    size_t offset; // In the structure that gets the values.
    size_t size;   // TEXT: bytes of the array. NAMES: number of names.
    double least;  // NUMBER and INTEGER.
    double most;
    const char *const *names; // NAMES.
} DipField;

// Words separated by spaces. The end of a text that is too long is cut off.
typedef struct DipWords {
    char text[224];
} DipWords;

void dip_words_add(DipWords *words, const char *word);
DipWords dip_words_list(const char *const *names, size_t count);

// Describes a value for a message: 'text', a number, or its type. Long texts are cut.
DipWords dip_words_describe(const struct cJSON *item);

// Fills *err with DIP_ERROR_TYPE and "VALUE found, accepted ACCEPTED". Returns false.
bool dip_field_refuse_type(const char *name, const struct cJSON *item, const char *accepted,
                           DipError *err);

// Reads a value of kind TEXT into field->size bytes. Fails with TYPE, MISSING (an empty text) and
// OVERSIZED.
bool dip_field_read_text(const DipField *field, const struct cJSON *item, char *text,
                         DipError *err);

// Reads a value of kind NUMBER or INTEGER. Fails with TYPE and RANGE.
bool dip_field_read_number(const DipField *field, const struct cJSON *item, double *number,
                           DipError *err);

// Reads a text that is one of the names, and adds its bit. `what` says what the names stand for; it
// is the word "topic" in the message "'x' is no topic, accepted ...". Fails with TYPE and UNKNOWN.
bool dip_field_read_name(const DipField *field, const char *what, const struct cJSON *item,
                         unsigned *bits, DipError *err);

// Reads a value of any kind into its place in `values`. Fails as the functions above do, and with
// MISSING if an array of names is empty.
bool dip_field_read(const DipField *field, const struct cJSON *item, void *values, DipError *err);

#endif
