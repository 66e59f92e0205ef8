// Errors of user data and of the world, as values. Our own mistakes are DIP_ASSERTs (assert.h).
//
// A function that can fail returns false or NULL and fills its last parameter, a DipError, which
// may be NULL. A reader of a whole file collects every fault in a DipErrorList instead.
#ifndef DIP_RENDERER_BASE_ERROR_H
#define DIP_RENDERER_BASE_ERROR_H

#include "renderer/base/api.h"

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// X(name, what went wrong in a few words). Tests assert the code, users read the message.
#define DIP_ERROR_LIST(X)                                                                          \
    X(NONE, "no error")                                                                            \
    X(IO, "a file cannot be opened, read or written")                                              \
    X(FORMAT, "a file is not of the format it should have")                                        \
    X(TRUNCATED, "a file ends too early")                                                          \
    X(OVERSIZED, "a file or line is longer than is accepted")                                      \
    X(RANGE, "a number is outside its range, or not finite")                                       \
    X(TYPE, "a value is not of the type its key has")                                              \
    X(UNKNOWN, "a key, setting or name that is not known")                                         \
    X(MISSING, "a key, value or file that is required is missing")                                 \
    X(CONFLICT, "two values that cannot hold together")                                            \
    X(UNSUPPORTED, "understood, but not in this version")                                          \
    X(MEMORY, "out of memory")                                                                     \
    X(RUNTIME, "a failure while running")

typedef enum DipErrorCode {
#define DIP_ERROR_ENUM(name, text) DIP_ERROR_##name,
    DIP_ERROR_LIST(DIP_ERROR_ENUM)
#undef DIP_ERROR_ENUM
} DipErrorCode;

typedef enum DipSeverity { DIP_SEVERITY_ERROR, DIP_SEVERITY_WARNING } DipSeverity;

// One fault: where it is and what is accepted there. Empty file or key, line 0: not applicable.
typedef struct DipError {
    DipErrorCode code;
    DipSeverity severity;
    char file[256];    // as the user wrote it; an over-long name keeps its end
    int line;          // 1-based; 0 when the fault has no line
    char key[64];      // key, setting or argument at fault
    char message[320]; // "found, accepted" sentence without a full stop
} DipError;

// Fills *err (which may be NULL) and returns false, so that a caller can `return` it.
// file and key may be NULL. The format's output is cut at the message's size.
DIP_API bool dip_error_set(DipError *err, DipErrorCode code, const char *file, int line,
                           const char *key, const char *format, ...)
    __attribute__((format(printf, 6, 7)));

// Writes "file:line: [key] message" (parts that do not apply left out) and returns the length the
// whole text has, as snprintf does.
DIP_API size_t dip_error_format(const DipError *err, char *buffer, size_t size_bytes);

// "IO", "RANGE", ...
DIP_API const char *dip_error_code_name(DipErrorCode code);

// Every fault of one file, in the order met. Zero-initialise; free with dip_error_list_free.
typedef struct DipErrorList {
    DipError *items;
    size_t count;
    size_t capacity;
    size_t error_count; // items of severity error; the rest are warnings
} DipErrorList;

// Appends a copy. When memory runs out the fault is counted but its text is lost.
DIP_API void dip_error_list_add(DipErrorList *list, const DipError *err);
DIP_API void dip_error_list_free(DipErrorList *list);

#ifdef __cplusplus
}
#endif

#endif
