// Reads requests by two tables: one of fields, one of the fields that each request has.
#include "app/control/request.h"

#include "app/control/request_values_private.h"
#include "renderer/base/utf8.h"
#include "renderer/base/assert.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double largest_id = 9007199254740992.0; // 2^53: doubles hold all whole numbers to it.

// --- the tables ----------------------------------------------------------------------------------

#define NAME_OF(name, NAME) #name,
static const char *const pane_names[] = {"current", "requested"};
static const char *const switch_names[] = {"on", "off"};
static const char *const verb_names[] = {DIP_CONTROL_VERB_LIST(NAME_OF)};
static const char *const topic_names[] = {DIP_CONTROL_TOPIC_LIST(NAME_OF)};
static const char *const part_names[] = {DIP_CONTROL_PART_LIST(NAME_OF)};

#define AT(field) offsetof(DipControlRequest, field)
#define TEXT_FIELD(name)                                                                           \
    { #name, DIP_FIELD_TEXT, AT(name), sizeof((DipControlRequest *)0)->name, 0, 0, NULL }
#define NUMBER_FIELD(name, kind, least, most)                                                      \
    { #name, kind, AT(name), 0, least, most, NULL }
#define NAMES_FIELD(name, field, names)                                                            \
    { name, DIP_FIELD_NAMES, AT(field), DIP_ARRAY_COUNT(names), 0, 0, names }

// X(FIELD, its description)
#define FIELD_LIST(X)                                                                              \
    X(PANE, NAMES_FIELD("pane", panes, pane_names))                                                \
    X(SETTINGS, TEXT_FIELD(settings))                                                              \
    X(CHANGE, TEXT_FIELD(change))                                                                  \
    X(NOTICES, NAMES_FIELD("notices", notices, switch_names))                                      \
    X(CATEGORY, TEXT_FIELD(category))                                                              \
    X(SCENE, TEXT_FIELD(name))                                                                     \
    X(FILE_NAME, TEXT_FIELD(file))                                                                 \
    X(TIME, NUMBER_FIELD(time_s, DIP_FIELD_NUMBER, 0, 86400))                                      \
    X(WIDTH, NUMBER_FIELD(width, DIP_FIELD_INTEGER, 1, DIP_CONTROL_MAX_SIZE_PX))                   \
    X(HEIGHT, NUMBER_FIELD(height, DIP_FIELD_INTEGER, 1, DIP_CONTROL_MAX_SIZE_PX))                 \
    X(SHOW, NAMES_FIELD("show", show, switch_names))                                               \
    X(X_PIXEL, NUMBER_FIELD(x, DIP_FIELD_INTEGER, 0, DIP_CONTROL_MAX_SIZE_PX - 1))                 \
    X(Y_PIXEL, NUMBER_FIELD(y, DIP_FIELD_INTEGER, 0, DIP_CONTROL_MAX_SIZE_PX - 1))                 \
    X(TO, NAMES_FIELD("to", topics, topic_names))                                                  \
    X(WHAT, NAMES_FIELD("what", parts, part_names))

#define ENUMERATOR(field, ...)  field,
#define DESCRIPTION(field, ...) __VA_ARGS__,
enum { FIELD_LIST(ENUMERATOR) FIELD_COUNT };
static const DipField fields[FIELD_COUNT] = {FIELD_LIST(DESCRIPTION)};

#define BIT(field) (1u << (field))

// The fields of each request besides "request" and "id", as bits. Requests without fields have no
// row.
typedef struct Row {
    unsigned needs;
    unsigned may_have; // Besides those that it needs.
} Row;

static const Row rows[DIP_CONTROL_VERB_COUNT] = {
    [DIP_CONTROL_SET] = {BIT(PANE), BIT(SETTINGS) | BIT(CHANGE) | BIT(NOTICES)},
    [DIP_CONTROL_PATH] = {BIT(CATEGORY), 0},
    [DIP_CONTROL_SEEK] = {BIT(TIME), 0},
    [DIP_CONTROL_SCENE] = {BIT(SCENE), 0},
    [DIP_CONTROL_SIZE] = {BIT(WIDTH) | BIT(HEIGHT), 0},
    [DIP_CONTROL_PANEL] = {BIT(SHOW), 0},
    [DIP_CONTROL_SUBSCRIBE] = {BIT(TO), 0},
    [DIP_CONTROL_UNSUBSCRIBE] = {BIT(TO), 0},
    [DIP_CONTROL_PICK] = {BIT(X_PIXEL) | BIT(Y_PIXEL), 0},
    [DIP_CONTROL_GET] = {0, BIT(WHAT)},
    [DIP_CONTROL_SCREENSHOT] = {BIT(FILE_NAME), 0},
};

// The parts that `get` answers with if the request does not say which.
static const unsigned usual_parts = BIT(DIP_CONTROL_PART_STATE) | BIT(DIP_CONTROL_PART_SETTINGS) |
                                    BIT(DIP_CONTROL_PART_TIMES) | BIT(DIP_CONTROL_PART_ERRORS);

// --- words of messages ---------------------------------------------------------------------------

static DipWords list_fields(unsigned bits) {
    DipWords words = {""};
    for (int f = 0; f < FIELD_COUNT; ++f) {
        if (bits & BIT(f)) {
            dip_words_add(&words, fields[f].name);
        }
    }
    return words;
}

// --- names -------------------------------------------------------------------------------------

const char *dip_control_verb_name(int verb) {
    DIP_ASSERT(verb >= 0 && verb < DIP_CONTROL_VERB_COUNT);
    return verb_names[verb];
}

const char *dip_control_topic_name(int topic) {
    DIP_ASSERT(topic >= 0 && topic < DIP_CONTROL_TOPIC_COUNT);
    return topic_names[topic];
}

const char *dip_control_part_name(int part) {
    DIP_ASSERT(part >= 0 && part < DIP_CONTROL_PART_COUNT);
    return part_names[part];
}

// --- requests ------------------------------------------------------------------------------------

static bool given_twice(const char *name, DipError *err) {
    return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, name, "is given twice, accepted once");
}

static bool is_envelope(const char *name) {
    return strcmp(name, "id") == 0 || strcmp(name, "request") == 0;
}

static bool unknown_field(DipControlVerb verb, const char *name, DipError *err) {
    const DipWords accepted = list_fields(rows[verb].needs | rows[verb].may_have);
    return dip_error_set(err, DIP_ERROR_UNKNOWN, NULL, 0, name,
                         "is no field of the request %s, accepted id request%s%s", verb_names[verb],
                         accepted.text[0] ? " " : "", accepted.text);
}

static int find_field(unsigned bits, const char *name) {
    for (int f = 0; f < FIELD_COUNT; ++f) {
        if ((bits & BIT(f)) && strcmp(name, fields[f].name) == 0) {
            return f;
        }
    }
    return -1;
}

static bool read_fields(const cJSON *object, DipControlRequest *request, DipError *err) {
    const Row *row = &rows[request->verb];
    unsigned given = 0;
    const cJSON *item;
    cJSON_ArrayForEach(item, object) {
        if (is_envelope(item->string)) {
            continue;
        }
        const int f = find_field(row->needs | row->may_have, item->string);
        if (f < 0) {
            return unknown_field(request->verb, item->string, err);
        }
        if (given & BIT(f)) {
            return given_twice(item->string, err);
        }
        if (!dip_field_read(&fields[f], item, request, err)) {
            return false;
        }
        given |= BIT(f);
    }
    const DipWords missing = list_fields(row->needs & ~given);
    return !missing.text[0] ||
           dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, missing.text,
                         "is missing from the request %s", verb_names[request->verb]);
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
    static const DipField field = {"request", DIP_FIELD_NAMES, 0, DIP_CONTROL_VERB_COUNT, 0,
                                   0,         verb_names};
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, "request");
    if (!item) {
        const DipWords accepted = dip_words_list(verb_names, DIP_CONTROL_VERB_COUNT);
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "request", "is missing, accepted %s",
                             accepted.text);
    }
    unsigned bits = 0;
    if (!dip_field_read_name(&field, "request", item, &bits, err)) {
        return false;
    }
    for (*verb = (DipControlVerb)0; bits > 1; bits >>= 1) {
        ++*verb;
    }
    return true;
}

static bool read_id(const cJSON *object, DipControlId *id, DipError *err) {
    static const DipField text_field = {"id", DIP_FIELD_TEXT, 0, sizeof id->text, 0, 0, NULL};
    static const DipField number_field = {
        "id", DIP_FIELD_INTEGER, 0, 0, -9007199254740992.0, 9007199254740992.0, NULL};
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
        if (!dip_field_read_number(&number_field, item, &found.number, err)) {
            return false;
        }
    } else if (!cJSON_IsString(item)) {
        return dip_field_refuse_type("id", item, "a whole number or a text", err);
    } else if (!dip_field_read_text(&text_field, item, found.text, err)) {
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
        const DipWords found = dip_words_describe(object);
        return dip_error_set(err, DIP_ERROR_TYPE, NULL, 0, "line",
                             "%s found, accepted an object such as {\"request\":\"get\"}",
                             found.text);
    }
    if (!check_envelope(object, err) || !read_id(object, &request->id, err) ||
        !read_verb(object, &request->verb, err) || !read_fields(object, request, err)) {
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
