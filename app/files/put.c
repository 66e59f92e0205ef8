// Writes text and escapes it for HTML, scripts, CSV or a terminal (put.h).
#include "app/files/put.h"

#include "renderer/base/assert.h"
#include "renderer/base/utf8.h"

#include <stdarg.h>
#include <stdbool.h>
#include <string.h>

enum { SPEC_ROOM = 32, PADDED_ROOM = 1024 };

// Wraps a va_list, so that a pointer to it can be passed on. On some systems va_list is an array
// type. A va_list parameter is then a pointer, so its address would have another type.
typedef struct Arguments {
    va_list list;
} Arguments;

// Returns the length of the character at the beginning of a text in UTF-8, or 0 if it is a control
// character or malformed.
static size_t character_bytes(const char *text) {
    uint32_t code = 0;
    const size_t length = dip_utf8_read(text, DIP_UTF8_MOST_BYTES, &code);
    return code < ' ' || (code >= 0x7f && code < 0xa0) ? 0 : length;
}

// A character and the text that is written instead. An array of escapes ends with the character 0.
typedef struct Escape {
    char character;
    const char *instead;
} Escape;

static const Escape html_escapes[] = {{'&', "&amp;"},  {'<', "&lt;"},   {'>', "&gt;"},
                                      {'"', "&quot;"}, {'\'', "&#39;"}, {0, NULL}};
// "</script" ends a script element even within a string, so '<' must not be written.
static const Escape script_escapes[] = {{'&', "\\u0026"},  {'<', "\\u003c"}, {'>', "\\u003e"},
                                        {'\'', "\\u0027"}, {'"', "\\\""},    {'\\', "\\\\"},
                                        {0, NULL}};
static const Escape csv_escapes[] = {{'"', "\"\""}, {0, NULL}};
static const Escape no_escapes[] = {{0, NULL}};

static void put_escaped(FILE *out, const char *text, const Escape *escapes) {
    const char *begin = text; // The first character that has not been written yet.
    while (*text) {
        const size_t length = character_bytes(text);
        const Escape *escape = escapes;
        while (escape->character && escape->character != *text) {
            ++escape;
        }
        const char *instead = length ? escape->instead : "?";
        const char *next = text + (length ? length : 1);
        if (instead) {
            fwrite(begin, 1, (size_t)(text - begin), out);
            fputs(instead, out);
            begin = next;
        }
        text = next;
    }
    fwrite(begin, 1, (size_t)(text - begin), out);
}

// --- formats -------------------------------------------------------------------------------------

// Copies a printf conversion such as "%-12.*f" to `spec`, and replaces each '*' by the next
// argument. Returns a pointer to the conversion's last character.
static const char *read_spec(const char *format, Arguments *arguments, char spec[SPEC_ROOM]) {
    size_t length = 1;
    spec[0] = '%';
    for (format++; strchr("-+ #0123456789.*lz", *format); format++) {
        DIP_ASSERT(*format && length + 12 < SPEC_ROOM);
        if (*format == '*') {
            length += (size_t)snprintf(spec + length, 12, "%d", va_arg(arguments->list, int));
        } else {
            spec[length++] = *format;
        }
    }
    spec[length] = *format;
    spec[length + 1] = '\0';
    return format;
}

static void put_value(FILE *out, const Escape *escapes, const char *spec, char kind,
                      Arguments *arguments) {
    char padded[PADDED_ROOM];
    switch (kind) {
    case '%':
        fputc('%', out);
        break;
    case 'c':
    case 'd':
        if (strstr(spec, "ll")) {
            fprintf(out, spec, va_arg(arguments->list, long long));
        } else {
            fprintf(out, spec, va_arg(arguments->list, int));
        }
        break;
    case 'u':
        if (strchr(spec, 'z')) {
            fprintf(out, spec, va_arg(arguments->list, size_t));
        } else {
            fprintf(out, spec, va_arg(arguments->list, unsigned));
        }
        break;
    case 's':
        if (strcmp(spec, "%s") == 0) {
            put_escaped(out, va_arg(arguments->list, const char *), escapes);
        } else {
            snprintf(padded, sizeof padded, spec, va_arg(arguments->list, const char *));
            put_escaped(out, padded, escapes);
        }
        break;
    default:
        DIP_ASSERT(kind == 'f' || kind == 'g' || kind == 'e');
        fprintf(out, spec, va_arg(arguments->list, double));
    }
}

static void put_format(FILE *out, const Escape *escapes, const char *format, Arguments *arguments) {
    char spec[SPEC_ROOM];
    while (*format) {
        const size_t plain = strcspn(format, "%");
        fwrite(format, 1, plain, out);
        format += plain;
        if (*format) {
            format = read_spec(format, arguments, spec);
            put_value(out, escapes, spec, *format++, arguments);
        }
    }
}

void dip_put_html(FILE *out, const char *format, ...) {
    Arguments arguments;
    va_start(arguments.list, format);
    put_format(out, html_escapes, format, &arguments);
    va_end(arguments.list);
}

void dip_put_text(FILE *out, const char *format, ...) {
    Arguments arguments;
    va_start(arguments.list, format);
    put_format(out, no_escapes, format, &arguments);
    va_end(arguments.list);
}

void dip_put_clean(char *text) {
    while (*text) {
        const size_t length = character_bytes(text);
        *text = length ? *text : '?';
        text += length ? length : 1;
    }
}

void dip_put_markup(FILE *out, const char *markup) {
    fputs(markup, out);
}

void dip_put_script_string(FILE *out, const char *text) {
    fputc('"', out);
    put_escaped(out, text, script_escapes);
    fputc('"', out);
}

void dip_put_csv_text(FILE *out, const char *text) {
    fputs(*text && strchr("=+-@\t\r", *text) ? "\"'" : "\"", out);
    put_escaped(out, text, csv_escapes);
    fputc('"', out);
}

void dip_put_append(char *text, size_t size_bytes, const char *format, ...) {
    const size_t length = strlen(text);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text + length, size_bytes - length, format, arguments);
    va_end(arguments);
}
