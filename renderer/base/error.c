// Filling, formatting and collecting errors.
#include "renderer/base/error.h"

#include "renderer/base/assert.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Copies a text. If the text is too long, only its end is copied, because different paths mostly
// differ at the end.
static void copy_tail(char *to, size_t size_bytes, const char *from) {
    const size_t length = from ? strlen(from) : 0;
    const size_t skip = length >= size_bytes ? length - size_bytes + 1 : 0;
    memcpy(to, from ? from + skip : "", length - skip + 1);
}

static void set(DipError *err, DipErrorCode code, DipOrigin origin, const char *file, int line,
                const char *key, const char *format, va_list arguments) {
    *err = (DipError){.code = code, .origin = origin, .line = line};
    copy_tail(err->file, sizeof err->file, file);
    copy_tail(err->key, sizeof err->key, key);
    vsnprintf(err->message, sizeof err->message, format, arguments);
}

static DipOrigin usual_origin(DipErrorCode code) {
    return code == DIP_ERROR_MEMORY || code == DIP_ERROR_RUNTIME ? DIP_ORIGIN_RUNTIME
                                                                 : DIP_ORIGIN_INPUT;
}

bool dip_error_set(DipError *err, DipErrorCode code, const char *file, int line, const char *key,
                   const char *format, ...) {
    if (err) {
        va_list arguments;
        va_start(arguments, format);
        set(err, code, usual_origin(code), file, line, key, format, arguments);
        va_end(arguments);
    }
    return false;
}

bool dip_error_set_runtime(DipError *err, DipErrorCode code, const char *file, int line,
                           const char *key, const char *format, ...) {
    if (err) {
        va_list arguments;
        va_start(arguments, format);
        set(err, code, DIP_ORIGIN_RUNTIME, file, line, key, format, arguments);
        va_end(arguments);
    }
    return false;
}

size_t dip_error_format(const DipError *err, char *buffer, size_t size_bytes) {
    char place[288] = "";
    if (err->file[0] && err->line > 0) {
        snprintf(place, sizeof place, "%s:%d: ", err->file, err->line);
    } else if (err->file[0]) {
        snprintf(place, sizeof place, "%s: ", err->file);
    }
    const char *open = err->key[0] ? "[" : "";
    const char *close = err->key[0] ? "] " : "";
    const char *kind = err->severity == DIP_SEVERITY_WARNING ? "warning: " : "";
    const int length = snprintf(buffer, size_bytes, "%s%s%s%s%s%s", place, kind, open, err->key,
                                close, err->message);
    return length < 0 ? 0 : (size_t)length;
}

const char *dip_error_code_name(DipErrorCode code) {
    static const char *const names[] = {
#define DIP_ERROR_NAME(name, text) #name,
        DIP_ERROR_LIST(DIP_ERROR_NAME)
#undef DIP_ERROR_NAME
    };
    return (size_t)code < DIP_ARRAY_COUNT(names) ? names[code] : "?";
}

// The only item of a list that has lost all its errors because memory ran out. Its capacity is 0.
static const DipError lost = {
    .code = DIP_ERROR_MEMORY, .origin = DIP_ORIGIN_RUNTIME, .message = "out of memory"};

// Makes room for one more item. Lists that are full double their capacity.
static bool make_room(DipErrorList *list) {
    if (list->count < list->capacity) {
        return true;
    }
    const size_t capacity = list->capacity ? 2 * list->capacity : 8;
    DipError *items = realloc(list->capacity ? list->items : NULL, capacity * sizeof *items);
    if (!items) {
        return false;
    }
    if (!list->capacity && list->count) {
        items[0] = lost;
    }
    list->items = items;
    list->capacity = capacity;
    return true;
}

void dip_error_list_add(DipErrorList *list, const DipError *err) {
    list->error_count += err->severity == DIP_SEVERITY_ERROR;
    if (make_room(list)) {
        list->items[list->count++] = *err;
    } else if (!list->count && err->severity == DIP_SEVERITY_ERROR) {
        list->items = (DipError *)&lost;
        list->count = 1;
    } else if (err->severity == DIP_SEVERITY_ERROR && list->error_count == 1) {
        list->items[list->count - 1] = *err;
    }
}

void dip_error_list_free(DipErrorList *list) {
    if (list->capacity) {
        free(list->items);
    }
    *list = (DipErrorList){0};
}

void dip_assert_failed(const char *condition, const char *file, int line) {
    fprintf(stderr, "%s:%d: assertion failed: %s\n", file, line, condition);
    abort();
}
