// Camera path files: the text format, read and written.
#include "campaths/campath_private.h"

#include "renderer/base/number.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct Token {
    const char *text;
    size_t length;
} Token;

enum { MAX_TOKENS = 8 }; // one more than a key has, to notice what is too many

typedef struct TextReader {
    const char *name;
    const char *at;
    const char *end;
    int line;
    bool has_header;
    int64_t period_ns; // 0: not met yet
    DipCamPath *path;  // grows
    size_t capacity;
    size_t count;
    DipError *err;
} TextReader;

static bool fault(const TextReader *reader, DipErrorCode code, const char *key,
                  const char *message) {
    return dip_error_set(reader->err, code, reader->name, reader->line, key, "%s", message);
}

// Cuts the next line into tokens, without its comment.
static bool next_line(TextReader *reader, Token tokens[MAX_TOKENS], int *count) {
    const size_t left = (size_t)(reader->end - reader->at);
    const char *newline = memchr(reader->at, '\n', left);
    const char *at = reader->at;
    const char *end = newline ? newline : reader->end;
    reader->line++;
    reader->at = newline ? newline + 1 : reader->end;
    *count = 0;
    if (end - at > DIP_CAMPATH_MAX_LINE) {
        return dip_error_set(reader->err, DIP_ERROR_OVERSIZED, reader->name, reader->line, NULL,
                             "a line of %zu characters, accepted up to %d", (size_t)(end - at),
                             DIP_CAMPATH_MAX_LINE);
    }
    if (memchr(at, '\0', (size_t)(end - at))) {
        return fault(reader, DIP_ERROR_FORMAT, NULL,
                     "a NUL byte, accepted a text or a .bth file with its magic bytes");
    }
    if (end > at && end[-1] == '\r') {
        end--;
    }
    const char *comment = memchr(at, '#', (size_t)(end - at));
    end = comment ? comment : end;
    while (*count < MAX_TOKENS) {
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
        tokens[(*count)++] = (Token){start, (size_t)(at - start)};
    }
    return true;
}

static bool token_is(Token token, const char *word) {
    return token.length == strlen(word) && memcmp(token.text, word, token.length) == 0;
}

// A token as it may be shown: cut, and with '?' for what is not printable ASCII.
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
                         "'%s' is no number, accepted a finite decimal such as -1.25e-3",
                         show(token, shown));
}

static bool read_header(TextReader *reader, const Token *tokens, int count) {
    char shown[41];
    if (!token_is(tokens[0], "diptych-path")) {
        return dip_error_set(
            reader->err, DIP_ERROR_FORMAT, reader->name, reader->line, "diptych-path",
            "begins with '%s', accepted 'diptych-path 1' or a .bth file", show(tokens[0], shown));
    }
    if (count != 2 || !token_is(tokens[1], "1")) {
        return dip_error_set(reader->err, DIP_ERROR_FORMAT, reader->name, reader->line,
                             "diptych-path", "version '%s', accepted 1",
                             count > 1 ? show(tokens[count - 1], shown) : "");
    }
    reader->has_header = true;
    return true;
}

static bool read_period(TextReader *reader, const Token *tokens, int count) {
    double seconds;
    if (reader->period_ns) {
        return fault(reader, DIP_ERROR_CONFLICT, "period", "a second period, accepted one");
    }
    if (count != 2) {
        return fault(reader, DIP_ERROR_FORMAT, "period",
                     "not one value, accepted 'period' and a number of seconds");
    }
    if (!read_number(reader, tokens[1], "period", &seconds)) {
        return false;
    }
    // Compared before the conversion, which is undefined for what does not fit.
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
                             "more keys than %d, accepted up to %d", DIP_CAMPATH_MAX_KEYS,
                             DIP_CAMPATH_MAX_KEYS);
    }
    size_t capacity = reader->capacity ? 2 * reader->capacity : 256;
    capacity = capacity < DIP_CAMPATH_MAX_KEYS ? capacity : DIP_CAMPATH_MAX_KEYS;
    DipCamPath *path = realloc(reader->path, sizeof *path + capacity * sizeof path->keys[0]);
    if (!path) {
        return fault(reader, DIP_ERROR_MEMORY, "keys", "no memory for more keys");
    }
    reader->path = path;
    reader->capacity = capacity;
    return true;
}

static bool read_key(TextReader *reader, const Token *tokens, int count) {
    if (count != 7) {
        return dip_error_set(reader->err, DIP_ERROR_FORMAT, reader->name, reader->line, "keys",
                             "%s%d values, accepted 7: x y z qx qy qz qw",
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
        return fault(reader, DIP_ERROR_MISSING, "period",
                     "no period before the keys, accepted 'period' and a number of seconds");
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
                     "nothing but comments, accepted 'diptych-path 1' or a .bth file");
    }
    if (!reader->period_ns) {
        return fault(reader, DIP_ERROR_MISSING, "period",
                     "no period, accepted 'period' and a number of seconds");
    }
    if (reader->count == 0) {
        return fault(reader, DIP_ERROR_MISSING, "keys",
                     "no keys, accepted lines of x y z qx qy qz qw");
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

// Seconds with as many of nine decimals as are needed, exact where a double would not be.
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
