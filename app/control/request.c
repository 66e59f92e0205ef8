// Reads the requests of the control channel (request.h) with the help of two tables. One describes
// all fields, and the other says which fields each request has.
#include "app/control/request.h"

#include "renderer/base/assert.h"
#include "renderer/base/utf8.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

// --- the tables ----------------------------------------------------------------------------------

#define NAME_OF(name, NAME) #name,
static const char *const pane_names[] = {"current", "requested"};
static const char *const switch_names[] = {"on", "off"};
const char *const dip_control_verb_names[] = {DIP_CONTROL_VERB_LIST(NAME_OF)};
const char *const dip_control_topic_names[] = {DIP_CONTROL_TOPIC_LIST(NAME_OF)};
const char *const dip_control_part_names[] = {DIP_CONTROL_PART_LIST(NAME_OF)};

// The type of a field in DipControlRequest.
typedef enum FieldKind {
    TEXT,   // char[size], not empty
    NUMBER, // double
    WHOLE,  // int
    NAMES   // unsigned with a bit per name; in JSON a name or an array of names
} FieldKind;

typedef struct Field {
    const char *name;
    FieldKind kind;
    size_t offset; // Offset of the field in DipControlRequest.
    size_t size;   // TEXT: bytes of the array. NAMES: number of names.
    double least;  // NUMBER and WHOLE: the range of accepted values.
    double most;
    const char *const *names; // NAMES: the accepted names.
} Field;

#define AT(field) offsetof(DipControlRequest, field)
#define TEXT_FIELD(name)                                                                           \
    { #name, TEXT, AT(name), sizeof((DipControlRequest *)0)->name, 0, 0, NULL }
#define NUMBER_FIELD(name, kind, least, most)                                                      \
    { #name, kind, AT(name), 0, least, most, NULL }
#define NAMES_FIELD(name, field, names)                                                            \
    { name, NAMES, AT(field), DIP_ARRAY_COUNT(names), 0, 0, names }

// Lists the fields as X(FIELD, description).
#define FIELD_LIST(X)                                                                              \
    X(PANE, NAMES_FIELD("pane", panes, pane_names))                                                \
    X(SETTINGS, TEXT_FIELD(settings))                                                              \
    X(CHANGE, TEXT_FIELD(change))                                                                  \
    X(NOTICES, NAMES_FIELD("notices", notices, switch_names))                                      \
    X(CATEGORY, TEXT_FIELD(category))                                                              \
    X(SCENE, TEXT_FIELD(name))                                                                     \
    X(FILE_NAME, TEXT_FIELD(file))                                                                 \
    X(TIME, NUMBER_FIELD(time_s, NUMBER, 0, 86400))                                                \
    X(WIDTH, NUMBER_FIELD(width, WHOLE, 1, DIP_CONTROL_MAX_SIZE_PX))                               \
    X(HEIGHT, NUMBER_FIELD(height, WHOLE, 1, DIP_CONTROL_MAX_SIZE_PX))                             \
    X(SHOW, NAMES_FIELD("show", show, switch_names))                                               \
    X(X_PIXEL, NUMBER_FIELD(x, WHOLE, 0, DIP_CONTROL_MAX_SIZE_PX - 1))                             \
    X(Y_PIXEL, NUMBER_FIELD(y, WHOLE, 0, DIP_CONTROL_MAX_SIZE_PX - 1))                             \
    X(TO, NAMES_FIELD("to", topics, dip_control_topic_names))                                      \
    X(WHAT, NAMES_FIELD("what", parts, dip_control_part_names))

#define ENUMERATOR(field, ...)  field,
#define DESCRIPTION(field, ...) __VA_ARGS__,
enum { FIELD_LIST(ENUMERATOR) FIELD_COUNT };
static const Field fields[FIELD_COUNT] = {FIELD_LIST(DESCRIPTION)};

#define BIT(field) (1u << (field))

// Says which fields a request has besides "request" and "id", as bits of fields. Requests without
// further fields have an empty row.
typedef struct Row {
    unsigned needs;    // Fields that must be present.
    unsigned may_have; // Further fields, which may be missing.
} Row;

static const Row rows[DIP_CONTROL_VERB_COUNT] = {
    [DIP_CONTROL_SET] = {BIT(PANE), BIT(SETTINGS) | BIT(CHANGE) | BIT(NOTICES)},
    [DIP_CONTROL_PATH] = {BIT(CATEGORY), 0},
    [DIP_CONTROL_ANIMATION] = {BIT(SCENE), 0},
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

// The parts that the reply to `get` has if the request names no part.
static const unsigned usual_parts = BIT(DIP_CONTROL_PART_STATE) | BIT(DIP_CONTROL_PART_SETTINGS) |
                                    BIT(DIP_CONTROL_PART_TIMES) | BIT(DIP_CONTROL_PART_ERRORS);

// --- words of messages ---------------------------------------------------------------------------

// A text of words that are separated by spaces. If they do not fit, the end is cut off.
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
    for (int f = 0; f < FIELD_COUNT; ++f) {
        if (bits & BIT(f)) {
            add_word(&words, fields[f].name);
        }
    }
    return words;
}

// Describes a value for a message by its text in quotes, its number or its type. Cuts long texts.
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

// --- values of fields ----------------------------------------------------------------------------

static bool read_text(const char *name, const cJSON *item, char *text, size_t size, DipError *err) {
    if (!cJSON_IsString(item)) {
        return refuse_type(name, item, "a text", err);
    }
    const size_t length = strlen(item->valuestring);
    if (length == 0) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, name,
                             "an empty text found, accepted a text of 1 to %zu bytes", size - 1);
    }
    if (length >= size) {
        return dip_error_set(err, DIP_ERROR_OVERSIZED, NULL, 0, name,
                             "a text of %zu bytes found, accepted 1 to %zu bytes", length,
                             size - 1);
    }
    memcpy(text, item->valuestring, length + 1);
    return true;
}

static bool is_whole(const cJSON *item) {
    return cJSON_IsNumber(item) && floor(item->valuedouble) == item->valuedouble;
}

static bool check_number(const Field *field, const cJSON *item, DipError *err) {
    const bool whole = field->kind == WHOLE;
    const double value = item->valuedouble;
    if (cJSON_IsNumber(item) && !(value >= field->least && value <= field->most)) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, field->name,
                             "%.17g is out of range, accepted %g..%g", value, field->least,
                             field->most);
    }
    return (whole ? is_whole(item) : cJSON_IsNumber(item)) ||
           refuse_type(field->name, item, whole ? "a whole number" : "a number", err);
}

// Reads a text that is one of the field's names, and sets this name's bit. `what` is the word
// for such a name in the message: "request" in "'x' is no request, accepted ...".
static bool read_name(const Field *field, const char *what, const cJSON *item, unsigned *bits,
                      DipError *err) {
    const Words accepted = list_names(field->names, field->size);
    if (!cJSON_IsString(item)) {
        return refuse_type(field->name, item, accepted.text, err);
    }
    for (size_t i = 0; i < field->size; ++i) {
        if (strcmp(item->valuestring, field->names[i]) == 0) {
            *bits |= 1u << i;
            return true;
        }
    }
    const Words found = describe(item);
    return dip_error_set(err, DIP_ERROR_UNKNOWN, NULL, 0, field->name, "%s is no %s, accepted %s",
                         found.text, what, accepted.text);
}

// Reads a name, or an array of at least one name.
static bool read_names(const Field *field, const cJSON *item, unsigned *bits, DipError *err) {
    if (!cJSON_IsArray(item)) {
        return read_name(field, "name", item, bits, err);
    }
    const cJSON *name;
    cJSON_ArrayForEach(name, item) {
        if (!read_name(field, "name", name, bits, err)) {
            return false;
        }
    }
    const Words accepted = list_names(field->names, field->size);
    return *bits || dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, field->name,
                                  "an empty array found, accepted %s", accepted.text);
}

static bool read_value(const Field *field, const cJSON *item, DipControlRequest *request,
                       DipError *err) {
    char *to = (char *)request + field->offset;
    if (field->kind == TEXT) {
        return read_text(field->name, item, to, field->size, err);
    }
    if (field->kind == NAMES) {
        return read_names(field, item, (unsigned *)to, err);
    }
    if (!check_number(field, item, err)) {
        return false;
    }
    if (field->kind == WHOLE) {
        *(int *)to = (int)item->valuedouble;
    } else {
        *(double *)to = item->valuedouble;
    }
    return true;
}

// --- requests ------------------------------------------------------------------------------------

static bool given_twice(const char *name, DipError *err) {
    return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, name, "is given twice, accepted once");
}

static bool is_envelope(const char *name) {
    return strcmp(name, "id") == 0 || strcmp(name, "request") == 0;
}

static bool unknown_field(DipControlVerb verb, const char *name, DipError *err) {
    const Words accepted = list_fields(rows[verb].needs | rows[verb].may_have);
    return dip_error_set(err, DIP_ERROR_UNKNOWN, NULL, 0, name,
                         "is no field of the request %s, accepted id request%s%s",
                         dip_control_verb_names[verb], accepted.text[0] ? " " : "", accepted.text);
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
        if (!read_value(&fields[f], item, request, err)) {
            return false;
        }
        given |= BIT(f);
    }
    const Words missing = list_fields(row->needs & ~given);
    return !missing.text[0] ||
           dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, missing.text,
                         "is missing from the request %s", dip_control_verb_names[request->verb]);
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
    static const Field field = {
        .name = "request", .size = DIP_CONTROL_VERB_COUNT, .names = dip_control_verb_names};
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, "request");
    unsigned bit = 0;
    if (!item) {
        const Words accepted = list_names(dip_control_verb_names, DIP_CONTROL_VERB_COUNT);
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "request", "is missing, accepted %s",
                             accepted.text);
    }
    if (!read_name(&field, "request", item, &bit, err)) {
        return false;
    }
    for (*verb = (DipControlVerb)0; bit > 1; bit >>= 1) {
        ++*verb;
    }
    return true;
}

static bool read_id(const cJSON *object, DipControlId *id, DipError *err) {
    static const double largest = 9007199254740992.0; // Doubles hold all whole numbers up to 2^53.
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, "id");
    if (!item || cJSON_IsNull(item)) {
        return true;
    }
    if (cJSON_IsString(item)) {
        DipControlId found = {.kind = DIP_CONTROL_ID_TEXT};
        const bool done = read_text("id", item, found.text, sizeof found.text, err);
        *id = done ? found : *id;
        return done;
    }
    if (!cJSON_IsNumber(item)) {
        return refuse_type("id", item, "a whole number or a text", err);
    }
    if (!(fabs(item->valuedouble) <= largest)) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "id",
                             "is out of range, accepted whole numbers from -2^53 to 2^53");
    }
    if (!is_whole(item)) {
        return refuse_type("id", item, "a whole number", err);
    }
    *id = (DipControlId){.kind = DIP_CONTROL_ID_NUMBER, .number = item->valuedouble};
    return true;
}

// Refuses a second "id" or "request".
static bool check_once(const cJSON *object, const char *key, DipError *err) {
    const cJSON *item, *first = cJSON_GetObjectItemCaseSensitive(object, key);
    cJSON_ArrayForEach(item, object) {
        if (item != first && strcmp(item->string, key) == 0) {
            return given_twice(key, err);
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
    if (!check_once(object, "id", err) || !read_id(object, &request->id, err) ||
        !check_once(object, "request", err) || !read_verb(object, &request->verb, err) ||
        !read_fields(object, request, err)) {
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

// Refuses bytes that are not UTF-8, control characters below U+0020 other than a tab, and the
// escape \u0000, which would end a text early.
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
    char text[DIP_CONTROL_MAX_LINE_BYTES + 1];
    memset(request, 0, sizeof *request);
    length -= length > 0 && line[length - 1] == '\r';
    if (length > DIP_CONTROL_MAX_LINE_BYTES) {
        return dip_error_set(err, DIP_ERROR_OVERSIZED, NULL, 0, "line", "is longer than %d bytes",
                             DIP_CONTROL_MAX_LINE_BYTES);
    }
    if (!check_bytes(line, length, err)) {
        return false;
    }
    memcpy(text, line, length);
    text[length] = '\0';
    return read_line(text, request, err);
}

// --- changes of settings -------------------------------------------------------------------------

// Returns whether a text of settings such as "aa=4,af=16" names the setting `key`.
static bool names_key(const char *text, const char *key) {
    const size_t length = strlen(key);
    while (*text) {
        const size_t part = strcspn(text, ",");
        if (strcspn(text, "=,") == length && strncmp(text, key, length) == 0) {
            return true;
        }
        text += part + (text[part] == ',');
    }
    return false;
}

// Writes all settings as one text: the old values of the settings that the change does not name,
// then the change. Parses this text with dip_quality_parse, which finds every mistake in the
// change.
bool dip_control_change_settings(const DipQuality *from, const char *change, DipQuality *to,
                                 DipError *err) {
    char text[DIP_CONTROL_TEXT_SIZE + 256];
    size_t length = 0;
    for (int s = 0; s < DIP_SETTING_COUNT; ++s) {
        const DipSettingInfo *info = dip_setting_info((DipSetting)s);
        if (!names_key(change, info->key) && length < sizeof text) {
            length += (size_t)snprintf(text + length, sizeof text - length, "%s=%s,", info->key,
                                       info->steps[from->step[s]]);
        }
    }
    if (length + strlen(change) >= sizeof text) {
        return dip_error_set(err, DIP_ERROR_OVERSIZED, NULL, 0, "change",
                             "is a text of %zu bytes, accepted at most %d", strlen(change),
                             DIP_CONTROL_TEXT_SIZE - 1);
    }
    strcpy(text + length, change);
    return dip_quality_parse(text, to, err);
}
