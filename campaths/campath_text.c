// Reads and writes the text format of camera paths.
#include "campaths/campath_private.h"

#include "renderer/base/number.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

typedef struct Token {
    const char *text;
    size_t length;
} Token;

enum { MAX_TOKENS = 8 }; // One more than a key has, so that a line with too many tokens is noticed.

typedef struct TextReader {
    const char *name; // the file, in messages
    const char *at;   // next byte to read
    const char *end;
    int line; // number of the last line that was read, 1-based
    bool has_header;
    int64_t period_ns; // 0 until the period is read
    DipCamPath *path;  // the keys so far; reallocated as they grow
    size_t capacity;   // keys that path has room for
    size_t count;      // keys read so far
    DipError *err;
} TextReader;

static bool fault(const TextReader *reader, DipErrorCode code, const char *key,
                  const char *message) {
    return dip_error_set(reader->err, code, reader->name, reader->line, key, "%s", message);
}

// Reports a file that is not a camera path at all. `found` says what the file has instead of a
// header. If the file's name ends like that of a model, the message adds a hint, because model
// files and path files are easily confused on the command line.
static bool not_a_path(const TextReader *reader, const char *found) {
    static const char *const model_endings[] = {".gltf", ".glb", ".obj", ".ply", ".stl", ".x",
                                                ".dae",  ".fbx", ".3ds", ".md2", ".off"};
    const char *ending = strrchr(reader->name, '.');
    const char *hint = "";
    for (size_t i = 0; ending && i < sizeof model_endings / sizeof *model_endings; i++) {
        hint = strcasecmp(ending, model_endings[i]) == 0 ? "; load a model with --model" : hint;
    }
    return dip_error_set(reader->err, DIP_ERROR_FORMAT, reader->name, reader->line, "diptych-path",
                         "the file %s, so it is not a camera path, accepted .pth text that begins "
                         "with 'diptych-path 1' or .bth binary%s",
                         found, hint);
}

// Refuses a line that is too long or binary. Before the header, such a line means that the file is
// of another kind.
static bool check_line(const TextReader *reader, const char *at, const char *end) {
    const bool may_be_path = reader->has_header || *at == '#';
    const bool is_long = end - at > DIP_CAMPATH_MAX_LINE;
    if (!is_long && !memchr(at, '\0', (size_t)(end - at))) {
        return true;
    }
    if (!may_be_path) {
        return not_a_path(reader, is_long ? "has a line of over 1000 bytes" : "contains NUL bytes");
    }
    if (is_long) {
        return dip_error_set(reader->err, DIP_ERROR_OVERSIZED, reader->name, reader->line, NULL,
                             "the line has %zu bytes, accepted up to %d", (size_t)(end - at),
                             DIP_CAMPATH_MAX_LINE);
    }
    return fault(reader, DIP_ERROR_FORMAT, NULL, "the line contains a NUL byte, accepted text");
}

// Splits the text between at and end at spaces and tabs. Returns the number of tokens.
static int split(const char *at, const char *end, Token tokens[MAX_TOKENS]) {
    int count = 0;
    while (count < MAX_TOKENS) {
        while (at < end && (*at == ' ' || *at == '\t')) {
            at++;
        }
        if (at == end) {
            break;
        }
        const char *start = at;
        while (at < end && *at != ' ' && *at != '\t') {
            at++;
        }
        tokens[count++] = (Token){start, (size_t)(at - start)};
    }
    return count;
}

// Reads the next line and splits it into tokens, without its comment.
static bool next_line(TextReader *reader, Token tokens[MAX_TOKENS], int *count) {
    const size_t left = (size_t)(reader->end - reader->at);
    const char *newline = memchr(reader->at, '\n', left);
    const char *at = reader->at;
    const char *end = newline ? newline : reader->end;
    reader->line++;
    reader->at = newline ? newline + 1 : reader->end;
    if (!check_line(reader, at, end)) {
        return false;
    }
    if (end > at && end[-1] == '\r') {
        end--;
    }
    const char *comment = memchr(at, '#', (size_t)(end - at));
    *count = split(at, comment ? comment : end, tokens);
    return true;
}

static bool token_is(Token token, const char *word) {
    return token.length == strlen(word) && memcmp(token.text, word, token.length) == 0;
}

// Copies a token for a message: at most 40 bytes, with '?' for every byte that is not printable
// ASCII.
static const char *show(Token token, char buffer[41]) {
    const size_t length = token.length < 40 ? token.length : 40;
    for (size_t i = 0; i < length; i++) {
        const char c = token.text[i];
        buffer[i] = c >= ' ' && c <= '~' ? c : '?';
    }
    buffer[length] = '\0';
    return buffer;
}

static bool read_number(const TextReader *reader, Token token, const char *key, double *value) {
    if (dip_number_parse(token.text, token.length, value)) {
        return true;
    }
    char shown[41];
    return dip_error_set(reader->err, DIP_ERROR_TYPE, reader->name, reader->line, key,
                         "'%s' is not a number, accepted a finite decimal such as -1.25e-3",
                         show(token, shown));
}

static bool read_header(TextReader *reader, const Token *tokens, int count) {
    char shown[41];
    if (!token_is(tokens[0], "diptych-path")) {
        char found[64];
        snprintf(found, sizeof found, "begins with '%s'", show(tokens[0], shown));
        return not_a_path(reader, found);
    }
    if (count != 2 || !token_is(tokens[1], "1")) {
        return dip_error_set(reader->err, DIP_ERROR_FORMAT, reader->name, reader->line,
                             "diptych-path", "the version is '%s', accepted 1",
                             count > 1 ? show(tokens[count - 1], shown) : "");
    }
    reader->has_header = true;
    return true;
}

static bool read_period(TextReader *reader, const Token *tokens, int count) {
    double seconds;
    if (reader->period_ns) {
        return fault(reader, DIP_ERROR_CONFLICT, "period",
                     "the period is given twice, accepted one");
    }
    if (count != 2) {
        return fault(reader, DIP_ERROR_FORMAT, "period",
                     "does not have exactly one value, accepted 'period' and a number of seconds");
    }
    if (!read_number(reader, tokens[1], "period", &seconds)) {
        return false;
    }
    // The range is checked before the conversion to an integer, which is undefined for values that
    // do not fit.
    const double ns = seconds * 1e9 + 0.5;
    if (!(ns >= (double)DIP_CAMPATH_MIN_PERIOD_NS) ||
        !(ns < (double)DIP_CAMPATH_MAX_PERIOD_NS + 1.0)) {
        return dip_error_set(reader->err, DIP_ERROR_RANGE, reader->name, reader->line, "period",
                             "%.9g s is out of range, accepted %g..%g", seconds,
                             (double)DIP_CAMPATH_MIN_PERIOD_NS * 1e-9,
                             (double)DIP_CAMPATH_MAX_PERIOD_NS * 1e-9);
    }
    reader->period_ns = (int64_t)ns;
    return true;
}

static bool grow(TextReader *reader) {
    if (reader->count < reader->capacity) {
        return true;
    }
    if (reader->count == DIP_CAMPATH_MAX_KEYS) {
        return dip_error_set(reader->err, DIP_ERROR_OVERSIZED, reader->name, reader->line, "keys",
                             "the path has too many keys, accepted up to %d", DIP_CAMPATH_MAX_KEYS);
    }
    size_t capacity = reader->capacity ? 2 * reader->capacity : 256;
    capacity = capacity < DIP_CAMPATH_MAX_KEYS ? capacity : DIP_CAMPATH_MAX_KEYS;
    DipCamPath *path = realloc(reader->path, sizeof *path + capacity * sizeof path->keys[0]);
    if (!path) {
        return fault(reader, DIP_ERROR_MEMORY, "keys", "out of memory");
    }
    reader->path = path;
    reader->capacity = capacity;
    return true;
}

static bool read_key(TextReader *reader, const Token *tokens, int count) {
    if (count != 7) {
        return dip_error_set(reader->err, DIP_ERROR_FORMAT, reader->name, reader->line, "keys",
                             "the line has %s%d values, accepted 7: x y z qx qy qz qw",
                             count >= MAX_TOKENS ? "more than " : "",
                             count >= MAX_TOKENS ? 7 : count);
    }
    if (!grow(reader)) {
        return false;
    }
    DipCamKey *key = &reader->path->keys[reader->count];
    for (int i = 0; i < 7; i++) {
        double *to = i < 3 ? &key->position_world[i] : &key->orientation[i - 3];
        if (!read_number(reader, tokens[i], dip_campath_key_names[i], to)) {
            return false;
        }
    }
    const DipCamKey *before = reader->count ? key - 1 : NULL;
    if (!dip_campath_admit(key, before, reader->name, reader->line, reader->err)) {
        return false;
    }
    reader->count++;
    return true;
}

static bool read_line(TextReader *reader, const Token *tokens, int count) {
    if (!reader->has_header) {
        return read_header(reader, tokens, count);
    }
    if (token_is(tokens[0], "period")) {
        return read_period(reader, tokens, count);
    }
    if (!reader->period_ns) {
        return fault(
            reader, DIP_ERROR_MISSING, "period",
            "there is no period before the keys, accepted 'period' and a number of seconds");
    }
    return read_key(reader, tokens, count);
}

static bool read_text(TextReader *reader) {
    while (reader->at < reader->end) {
        Token tokens[MAX_TOKENS];
        int count;
        if (!next_line(reader, tokens, &count) ||
            (count > 0 && !read_line(reader, tokens, count))) {
            return false;
        }
    }
    reader->line = reader->line ? reader->line : 1;
    if (!reader->has_header) {
        return fault(reader, DIP_ERROR_MISSING, "diptych-path",
                     "the file has nothing but comments, accepted 'diptych-path 1' or a .bth file");
    }
    if (!reader->period_ns) {
        return fault(reader, DIP_ERROR_MISSING, "period",
                     "there is no period, accepted 'period' and a number of seconds");
    }
    if (reader->count == 0) {
        return fault(reader, DIP_ERROR_MISSING, "keys",
                     "there are no keys, accepted lines of x y z qx qy qz qw");
    }
    return true;
}

bool dip_campath_parse_text(const char *text, size_t size_bytes, const char *name,
                            DipCamPath **path, DipError *err) {
    TextReader reader = {.name = name, .at = text, .end = text + size_bytes, .err = err};
    static const char bom[] = "\xef\xbb\xbf";
    if (size_bytes >= 3 && memcmp(text, bom, 3) == 0) {
        reader.at += 3;
    }
    DipCamPath *made = NULL;
    if (read_text(&reader)) {
        made = dip_campath_allocate(reader.count, reader.period_ns, name, err);
    }
    if (made) {
        memcpy(made->keys, reader.path->keys, reader.count * sizeof made->keys[0]);
        dip_campath_finish(made);
    }
    free(reader.path);
    *path = made;
    return made != NULL;
}

// Writes the period in seconds with up to nine decimals. The decimals come from integers, so the
// text is exact.
static void write_period(FILE *stream, int64_t period_ns) {
    char decimals[16];
    snprintf(decimals, sizeof decimals, "%09d", (int)(period_ns % 1000000000));
    int length = 9;
    while (length > 0 && decimals[length - 1] == '0') {
        length--;
    }
    fprintf(stream, "period %lld%s%.*s\n", (long long)(period_ns / 1000000000), length ? "." : "",
            length, decimals);
}

void dip_campath_write_text(const DipCamPath *path, FILE *stream) {
    fprintf(stream, "diptych-path %d\n# seconds from key to key\n", DIP_CAMPATH_VERSION);
    write_period(stream, path->period_ns);
    fprintf(stream, "# x y z qx qy qz qw\n");
    for (size_t k = 0; k < path->key_count; k++) {
        for (int i = 0; i < 7; i++) {
            char number[DIP_NUMBER_TEXT_SIZE];
            dip_number_format(dip_campath_component(&path->keys[k], i), number);
            fputs(number, stream);
            fputc(i < 6 ? ' ' : '\n', stream);
        }
    }
}
