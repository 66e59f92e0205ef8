// Reads lines for inih: counts and cleans them, and refuses what inih would silently ignore or
// misread.
#include "config/config_private.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void dip_config_add_fault(DipConfigReader *reader, DipErrorCode code, DipSeverity severity,
                          int line, const char *key, const char *format, ...) {
    char message[sizeof((DipError *)0)->message];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    DipError fault;
    dip_error_set(&fault, code, reader->file, line, key, "%s", message);
    fault.severity = severity;
    dip_error_list_add(reader->faults, &fault);
}

static void refuse(DipConfigReader *reader, DipErrorCode code, const char *key,
                   const char *message) {
    dip_config_add_fault(reader, code, DIP_SEVERITY_ERROR, reader->line, key, "%s", message);
}

// A line without its indentation and comment.
typedef struct Line {
    char text[DIP_CONFIG_MAX_LINE + 1];
    int length;      // bytes so far, even beyond the limit; text holds only the first `limit` bytes
    int limit;       // DIP_CONFIG_MAX_LINE, or less where inih's buffer is smaller
    bool in_comment; // true: a comment has begun; it lasts to the end of the line
    bool has_bad_control; // true: the line contains a control character that is not white space
    bool after_space;     // true: the last byte was white space
    int ended_length;     // length without trailing white space
} Line;

static void append(Line *line, char c) {
    if (line->length < line->limit) {
        line->text[line->length] = c;
    }
    line->length++;
}

// Adds a byte of the file to the line, unless it is indentation or part of a comment.
static void add_byte(Line *line, int c) {
    const bool is_space = c == ' ' || c == '\t' || c == '\v' || c == '\f';
    if (line->in_comment || (is_space && line->length == 0)) {
        return;
    }
    if ((c == ';' && (line->length == 0 || line->after_space)) || (c == '#' && line->length == 0)) {
        line->in_comment = true;
        return;
    }
    if ((c < ' ' || c == 0x7f) && !is_space) {
        line->has_bad_control = true;
    }
    line->after_space = is_space;
    append(line, (char)c);
    if (!is_space) {
        line->ended_length = line->length;
    }
}

static int next_byte(DipConfigReader *reader) {
    const int c = getc(reader->stream);
    if (c != EOF && ++reader->size_bytes > DIP_CONFIG_MAX_FILE_BYTES) {
        dip_config_add_fault(reader, DIP_ERROR_OVERSIZED, DIP_SEVERITY_ERROR, reader->line, NULL,
                             "the file is too long, accepted up to %d bytes",
                             DIP_CONFIG_MAX_FILE_BYTES);
        reader->stopped = true;
        return EOF;
    }
    return c;
}

// Reads one line. Returns false at the end of the file and where reading must stop.
static bool scan(DipConfigReader *reader, Line *line) {
    reader->line++;
    int c = next_byte(reader);
    if (c == EOF) {
        return false;
    }
    if (reader->line == 1 && c == 0xef) { // UTF-8 byte order mark EF BB BF
        const int second = next_byte(reader);
        const int third = next_byte(reader);
        if (second != 0xbb || third != 0xbf) {
            refuse(reader, DIP_ERROR_FORMAT, NULL, "begins with stray bytes, accepted a text file");
            reader->stopped = true;
            return false;
        }
        c = next_byte(reader);
    }
    for (; c != EOF && c != '\n'; c = next_byte(reader)) {
        if (c == '\0') {
            refuse(reader, DIP_ERROR_FORMAT, NULL, "contains a NUL byte, accepted a text file");
            reader->stopped = true;
            return false;
        }
        if (c == '\r') {
            const int after = getc(reader->stream);
            ungetc(after, reader->stream);
            if (after == '\n' || after == EOF) {
                continue;
            }
        }
        add_byte(line, c);
    }
    return !reader->stopped;
}

// Copies the key that a faulty line seems to set. The message about the line names this key.
static void guess_key(const char *text, char key[64]) {
    const size_t length = strcspn(text, ":= \t");
    snprintf(key, 64, "%.*s", (int)(length < 63 ? length : 63), text);
}

static bool check(DipConfigReader *reader, const Line *line) {
    char key[64];
    guess_key(line->text, key);
    if (line->has_bad_control) {
        refuse(reader, DIP_ERROR_FORMAT, NULL,
               "contains a control character, accepted printable text");
        return false;
    }
    if (line->ended_length > line->limit) {
        dip_config_add_fault(reader, DIP_ERROR_OVERSIZED, DIP_SEVERITY_ERROR, reader->line, key,
                             "the line has %d bytes, accepted up to %d without its comment",
                             line->ended_length, line->limit);
        return false;
    }
    if (line->text[0] == '[') {
        dip_config_add_fault(reader, DIP_ERROR_FORMAT, DIP_SEVERITY_ERROR, reader->line, NULL,
                             "'%.60s' begins a section, accepted keys without sections",
                             line->text);
        return false;
    }
    if (!strpbrk(line->text, ":=")) {
        dip_config_add_fault(reader, DIP_ERROR_FORMAT, DIP_SEVERITY_ERROR, reader->line, key,
                             "'%.60s' has no value, accepted KEY: value", line->text);
        return false;
    }
    return true;
}

static bool may_go_on(DipConfigReader *reader) {
    if (!reader->stopped && reader->faults->count >= DIP_CONFIG_MAX_FAULTS) {
        refuse(reader, DIP_ERROR_OVERSIZED, NULL,
               "has too many faults, so the rest is not read, accepted an ini file");
        reader->stopped = true;
    }
    return !reader->stopped;
}

char *dip_config_read_line(char *to, int room, void *context) {
    DipConfigReader *reader = context;
    Line line = {.limit = room - 2 < DIP_CONFIG_MAX_LINE ? room - 2 : DIP_CONFIG_MAX_LINE};
    if (!may_go_on(reader) || !scan(reader, &line)) {
        return NULL;
    }
    // inih gets an empty line in place of a refused one, so that it reports no second error.
    const int kept = line.ended_length < line.limit ? line.ended_length : line.limit;
    line.text[kept] = '\0';
    const bool is_good = line.ended_length == 0 || check(reader, &line);
    snprintf(to, (size_t)room, "%s\n", is_good ? line.text : "");
    return to;
}
