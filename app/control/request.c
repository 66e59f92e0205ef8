// Reads requests by two tables: one of fields, one of the fields that each request has.
#include "app/control/request.h"

#include "app/control/utf8_private.h"
#include "renderer/base/assert.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double largest_id = 9007199254740992.0; // 2^53: doubles hold all whole numbers to it.

// --- the tables ----------------------------------------------------------------------------------

typedef enum FieldKind {
    TEXT,    // char[size], not empty
    NUMBER,  // double
    INTEGER, // int
    NAMES    // unsigned: bits of the names; a text or an array of texts
} FieldKind;

typedef struct Field {
    const char *name;
    FieldKind kind;
    size_t offset; // In DipControlRequest.
    size_t size;   // TEXT: bytes of the array. NAMES: number of names.
    double least;  // NUMBER and INTEGER.
    double most;
    const char *const *names; // NAMES.
} Field;

#define NAME_OF(name, NAME) #name,
static const char *const pane_names[] = {"current", "requested"};
static const char *const topic_names[] = {DIP_CONTROL_TOPIC_LIST(NAME_OF)};
static const char *const part_names[] = {DIP_CONTROL_PART_LIST(NAME_OF)};

#define AT(field) offsetof(DipControlRequest, field)
#define TEXT_FIELD(name)                                                                           \
    { #name, TEXT, AT(name), sizeof((DipControlRequest *)0)->name, 0, 0, NULL }
#define NUMBER_FIELD(name, kind, least, most)                                                      \
    { #name, kind, AT(name), 0, least, most, NULL }
#define NAMES_FIELD(name, field, names)                                                            \
    { name, NAMES, AT(field), DIP_ARRAY_COUNT(names), 0, 0, names }

enum { PANE, SETTINGS, CHANGE, CATEGORY, SCENE, FILE_NAME, TIME, WIDTH, HEIGHT, X, Y, TO, WHAT };

static const Field fields[] = {
    [PANE] = NAMES_FIELD("pane", panes, pane_names),
    [SETTINGS] = TEXT_FIELD(settings),
    [CHANGE] = TEXT_FIELD(change),
    [CATEGORY] = TEXT_FIELD(category),
    [SCENE] = TEXT_FIELD(name),
    [FILE_NAME] = TEXT_FIELD(file),
    [TIME] = NUMBER_FIELD(time_s, NUMBER, 0, 86400),
    [WIDTH] = NUMBER_FIELD(width, INTEGER, 1, DIP_CONTROL_MAX_SIZE_PX),
    [HEIGHT] = NUMBER_FIELD(height, INTEGER, 1, DIP_CONTROL_MAX_SIZE_PX),
    [X] = NUMBER_FIELD(x, INTEGER, 0, DIP_CONTROL_MAX_SIZE_PX - 1),
    [Y] = NUMBER_FIELD(y, INTEGER, 0, DIP_CONTROL_MAX_SIZE_PX - 1),
    [TO] = NAMES_FIELD("to", topics, topic_names),
    [WHAT] = NAMES_FIELD("what", parts, part_names),
};

#define BIT(field) (1u << (field))

// The fields of each request besides "request" and "id", as bits.
typedef struct Row {
    const char *name;
    unsigned needs;
    unsigned takes; // Also includes all that it needs.
} Row;

static const Row rows[DIP_CONTROL_VERB_COUNT] = {
    [DIP_CONTROL_SET] = {"set", BIT(PANE), BIT(PANE) | BIT(SETTINGS) | BIT(CHANGE)},
    [DIP_CONTROL_APPLY] = {"apply", 0, 0},
    [DIP_CONTROL_PATH] = {"path", BIT(CATEGORY), BIT(CATEGORY)},
    [DIP_CONTROL_PAUSE] = {"pause", 0, 0},
    [DIP_CONTROL_PLAY] = {"play", 0, 0},
    [DIP_CONTROL_SEEK] = {"seek", BIT(TIME), BIT(TIME)},
    [DIP_CONTROL_SCENE] = {"scene", BIT(SCENE), BIT(SCENE)},
    [DIP_CONTROL_SIZE] = {"size", BIT(WIDTH) | BIT(HEIGHT), BIT(WIDTH) | BIT(HEIGHT)},
    [DIP_CONTROL_SUBSCRIBE] = {"subscribe", BIT(TO), BIT(TO)},
    [DIP_CONTROL_UNSUBSCRIBE] = {"unsubscribe", BIT(TO), BIT(TO)},
    [DIP_CONTROL_PICK] = {"pick", BIT(X) | BIT(Y), BIT(X) | BIT(Y)},
    [DIP_CONTROL_GET] = {"get", 0, BIT(WHAT)},
    [DIP_CONTROL_SCREENSHOT] = {"screenshot", BIT(FILE_NAME), BIT(FILE_NAME)},
    [DIP_CONTROL_QUIT] = {"quit", 0, 0},
};

// The parts that `get` answers with if the request does not say which.
static const unsigned usual_parts = BIT(DIP_CONTROL_PART_STATE) | BIT(DIP_CONTROL_PART_SETTINGS) |
                                    BIT(DIP_CONTROL_PART_TIMES) | BIT(DIP_CONTROL_PART_ERRORS);

// --- words of messages ---------------------------------------------------------------------------

typedef struct Words {
    char text[224];
} Words;

static void add_word(Words *words, const char *word) {
    const size_t length = strlen(words->text);
    snprintf(words->text + length, sizeof words->text - length, "%s%s", length ? " " : "", word);
}

static Words list_names(const char *const *names, size_t count) {
    Words words = {""};
    for (size_t i = 0; i < count; ++i) {
        add_word(&words, names[i]);
    }
    return words;
}

static Words list_fields(unsigned bits) {
    Words words = {""};
    for (size_t f = 0; f < DIP_ARRAY_COUNT(fields); ++f) {
        if (bits & BIT(f)) {
            add_word(&words, fields[f].name);
        }
    }
    return words;
}

static Words list_requests(void) {
    Words words = {""};
    for (int v = 0; v < DIP_CONTROL_VERB_COUNT; ++v) {
        add_word(&words, rows[v].name);
    }
    return words;
}

// Describes a value for a message: 'text', a number, or its type. Long texts are cut.
static Words describe(const cJSON *item) {
    Words words = {""};
    if (cJSON_IsString(item)) {
        const size_t length = strlen(item->valuestring);
        const size_t cut = dip_utf8_valid_bytes(item->valuestring, length < 40 ? length : 40);
        snprintf(words.text, sizeof words.text, "'%.*s%s'", (int)cut, item->valuestring,
                 cut < length ? "..." : "");
    } else if (cJSON_IsNumber(item)) {
        snprintf(words.text, sizeof words.text, "%.17g", item->valuedouble);
    } else {
        add_word(&words, cJSON_IsArray(item)    ? "an array"
                         : cJSON_IsObject(item) ? "an object"
                         : cJSON_IsNull(item)   ? "null"
                                                : "a truth value");
    }
    return words;
}

static bool refuse_type(const char *name, const cJSON *item, const char *accepted, DipError *err) {
    const Words found = describe(item);
    return dip_error_set(err, DIP_ERROR_TYPE, NULL, 0, name, "%s found, accepted %s", found.text,
                         accepted);
}

// --- values --------------------------------------------------------------------------------------

static bool read_text(const Field *field, const cJSON *item, char *text, DipError *err) {
    if (!cJSON_IsString(item)) {
        return refuse_type(field->name, item, "a text", err);
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

static bool read_number(const Field *field, const cJSON *item, double *number, DipError *err) {
    const bool whole = field->kind == INTEGER;
    if (!cJSON_IsNumber(item)) {
        return refuse_type(field->name, item, whole ? "a whole number" : "a number", err);
    }
    const double value = item->valuedouble;
    if (!(value >= field->least && value <= field->most)) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, field->name,
                             "%.17g is out of range, accepted %g..%g", value, field->least,
                             field->most);
    }
    if (whole && floor(value) != value) {
        return refuse_type(field->name, item, "a whole number", err);
    }
    *number = value;
    return true;
}

static bool read_name(const Field *field, const cJSON *item, unsigned *bits, DipError *err) {
    const Words accepted = list_names(field->names, field->size);
    if (!cJSON_IsString(item)) {
        return refuse_type(field->name, item, accepted.text, err);
    }
    for (size_t i = 0; i < field->size; ++i) {
        if (strcmp(item->valuestring, field->names[i]) == 0) {
            *bits |= BIT(i);
            return true;
        }
    }
    const Words found = describe(item);
    return dip_error_set(err, DIP_ERROR_UNKNOWN, NULL, 0, field->name, "%s is no name, accepted %s",
                         found.text, accepted.text);
}

// Reads a name, or an array of at least one name.
static bool read_names(const Field *field, const cJSON *item, unsigned *bits, DipError *err) {
    if (!cJSON_IsArray(item)) {
        return read_name(field, item, bits, err);
    }
    const cJSON *name;
    cJSON_ArrayForEach(name, item) {
        if (!read_name(field, name, bits, err)) {
            return false;
        }
    }
    if (*bits == 0) {
        const Words accepted = list_names(field->names, field->size);
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, field->name,
                             "an empty array found, accepted %s", accepted.text);
    }
    return true;
}

static bool read_field(const Field *field, const cJSON *item, DipControlRequest *request,
                       DipError *err) {
    char *to = (char *)request + field->offset;
    double number = 0.0;
    unsigned bits = 0;
    switch (field->kind) {
    case TEXT:
        return read_text(field, item, to, err);
    case NAMES:
        if (!read_names(field, item, &bits, err)) {
            return false;
        }
        memcpy(to, &bits, sizeof bits);
        return true;
    case NUMBER:
        if (!read_number(field, item, &number, err)) {
            return false;
        }
        memcpy(to, &number, sizeof number);
        return true;
    case INTEGER:
        if (!read_number(field, item, &number, err)) {
            return false;
        }
        memcpy(to, &(int){(int)number}, sizeof(int));
        return true;
    }
    return false;
}

// --- requests ------------------------------------------------------------------------------------

static bool given_twice(const char *name, DipError *err) {
    return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, name, "is given twice, accepted once");
}

static bool is_envelope(const char *name) {
    return strcmp(name, "id") == 0 || strcmp(name, "request") == 0;
}

static bool unknown_field(const Row *row, const char *name, DipError *err) {
    const Words accepted = list_fields(row->takes);
    return dip_error_set(err, DIP_ERROR_UNKNOWN, NULL, 0, name,
                         "is no field of the request %s, accepted id request%s%s", row->name,
                         accepted.text[0] ? " " : "", accepted.text);
}

static int find_field(unsigned bits, const char *name) {
    for (int f = 0; f < (int)DIP_ARRAY_COUNT(fields); ++f) {
        if ((bits & BIT(f)) && strcmp(name, fields[f].name) == 0) {
            return f;
        }
    }
    return -1;
}

static bool read_fields(const cJSON *object, const Row *row, DipControlRequest *request,
                        DipError *err) {
    unsigned given = 0;
    const cJSON *item;
    cJSON_ArrayForEach(item, object) {
        if (is_envelope(item->string)) {
            continue;
        }
        const int f = find_field(row->takes, item->string);
        if (f < 0) {
            return unknown_field(row, item->string, err);
        }
        if (given & BIT(f)) {
            return given_twice(item->string, err);
        }
        if (!read_field(&fields[f], item, request, err)) {
            return false;
        }
        given |= BIT(f);
    }
    const Words missing = list_fields(row->needs & ~given);
    return !missing.text[0] || dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, missing.text,
                                             "is missing from the request %s", row->name);
}

static bool check_settings(const DipControlRequest *request, DipError *err) {
    DipQuality quality;
    const bool whole = request->settings[0] != '\0';
    const bool change = request->change[0] != '\0';
    if (whole == change) {
        return dip_error_set(err, change ? DIP_ERROR_CONFLICT : DIP_ERROR_MISSING, NULL, 0,
                             "settings",
                             "the request set takes either settings (all of them) or change (some "
                             "of them)");
    }
    return !whole || dip_quality_parse(request->settings, &quality, err);
}

static bool read_verb(const cJSON *object, DipControlVerb *verb, DipError *err) {
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, "request");
    const Words accepted = list_requests();
    if (!item) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "request", "is missing, accepted %s",
                             accepted.text);
    }
    if (!cJSON_IsString(item)) {
        return refuse_type("request", item, accepted.text, err);
    }
    for (int v = 0; v < DIP_CONTROL_VERB_COUNT; ++v) {
        if (strcmp(item->valuestring, rows[v].name) == 0) {
            *verb = (DipControlVerb)v;
            return true;
        }
    }
    const Words found = describe(item);
    return dip_error_set(err, DIP_ERROR_UNKNOWN, NULL, 0, "request",
                         "%s is no request, accepted %s", found.text, accepted.text);
}

static bool read_id(const cJSON *object, DipControlId *id, DipError *err) {
    static const Field text_field = {"id", TEXT, 0, sizeof id->text, 0, 0, NULL};
    static const Field number_field = {"id", INTEGER, 0, 0, -9007199254740992.0, 9007199254740992.0,
                                       NULL};
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, "id");
    if (!item || cJSON_IsNull(item)) {
        return true;
    }
    DipControlId found = {.kind = DIP_CONTROL_ID_TEXT};
    if (cJSON_IsNumber(item)) {
        found.kind = DIP_CONTROL_ID_NUMBER;
        if (!(fabs(item->valuedouble) <= largest_id)) {
            return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "id",
                                 "is out of range, accepted whole numbers from -2^53 to 2^53");
        }
        if (!read_number(&number_field, item, &found.number, err)) {
            return false;
        }
    } else if (!cJSON_IsString(item)) {
        return refuse_type("id", item, "a whole number or a text", err);
    } else if (!read_text(&text_field, item, found.text, err)) {
        return false;
    }
    *id = found;
    return true;
}

// Refuses a second "id" or "request".
static bool check_envelope(const cJSON *object, DipError *err) {
    const cJSON *item;
    cJSON_ArrayForEach(item, object) {
        if (is_envelope(item->string) &&
            cJSON_GetObjectItemCaseSensitive(object, item->string) != item) {
            return given_twice(item->string, err);
        }
    }
    return true;
}

static bool read_object(const cJSON *object, DipControlRequest *request, DipError *err) {
    if (!cJSON_IsObject(object)) {
        const Words found = describe(object);
        return dip_error_set(err, DIP_ERROR_TYPE, NULL, 0, "line",
                             "%s found, accepted an object such as {\"request\":\"get\"}",
                             found.text);
    }
    if (!check_envelope(object, err) || !read_id(object, &request->id, err) ||
        !read_verb(object, &request->verb, err) ||
        !read_fields(object, &rows[request->verb], request, err)) {
        return false;
    }
    if (request->verb == DIP_CONTROL_GET && request->parts == 0) {
        request->parts = usual_parts;
    }
    return request->verb != DIP_CONTROL_SET || check_settings(request, err);
}

// --- lines ---------------------------------------------------------------------------------------

static bool refuse_line(size_t at, const char *found, DipError *err) {
    return dip_error_set(err, DIP_ERROR_FORMAT, NULL, 0, "line",
                         "%s at byte %zu, accepted one JSON object in UTF-8", found, at);
}

// Refuses bytes that are not UTF-8, control characters, and the escape \u0000, which would end a
// text early.
static bool check_bytes(const char *line, size_t length, DipError *err) {
    const size_t valid = dip_utf8_valid_bytes(line, length);
    if (valid < length) {
        return refuse_line(valid, "a byte that is not UTF-8", err);
    }
    for (size_t i = 0; i < length; ++i) {
        if ((unsigned char)line[i] < 0x20 && line[i] != '\t') {
            return refuse_line(i, "a control character", err);
        }
        if (line[i] == '\\') {
            if (length - i >= 6 && memcmp(line + i, "\\u0000", 6) == 0) {
                return refuse_line(i, "the character \\u0000", err);
            }
            ++i; // An escaped backslash does not begin another escape.
        }
    }
    return true;
}

static bool read_line(const char *line, DipControlRequest *request, DipError *err) {
    const char *end = line;
    if (line[strspn(line, " \t")] == '\0') {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "line",
                             "is empty, accepted an object such as {\"request\":\"get\"}");
    }
    cJSON *object = cJSON_ParseWithOpts(line, &end, 1);
    if (!object) {
        return refuse_line((size_t)(end - line), "no JSON", err);
    }
    const bool done = read_object(object, request, err);
    cJSON_Delete(object);
    return done;
}

bool dip_control_request_read(const char *line, size_t length, DipControlRequest *request,
                              DipError *err) {
    memset(request, 0, sizeof *request);
    length -= length > 0 && line[length - 1] == '\r';
    if (length > DIP_CONTROL_MAX_LINE_BYTES) {
        return dip_error_set(err, DIP_ERROR_OVERSIZED, NULL, 0, "line", "is longer than %d bytes",
                             DIP_CONTROL_MAX_LINE_BYTES);
    }
    if (!check_bytes(line, length, err)) {
        return false;
    }
    char *text = malloc(length + 1);
    if (!text) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "line", "out of memory");
    }
    memcpy(text, line, length);
    text[length] = '\0';
    const bool done = read_line(text, request, err);
    free(text);
    return done;
}
