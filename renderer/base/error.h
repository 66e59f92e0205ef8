// Errors as values: faults in the user's input, and failures of the machine. Mistakes in Diptych's
// own code are not reported as a DipError; DIP_ASSERT (assert.h) catches them.
//
// A function that can fail returns false or NULL and fills its last parameter, a DipError. The
// caller may pass NULL for this parameter. Functions that read a whole file collect every fault in
// a DipErrorList instead.
#ifndef DIP_RENDERER_BASE_ERROR_H
#define DIP_RENDERER_BASE_ERROR_H

#include "renderer/base/api.h"

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// The error codes, as X(name, what went wrong in a few words). Tests check the code; users read the
// error's message.
#define DIP_ERROR_LIST(X)                                                                          \
    X(NONE, "no error")                                                                            \
    X(IO, "a file cannot be opened, read or written")                                              \
    X(FORMAT, "a file does not have the expected format")                                          \
    X(TRUNCATED, "a file ends too early")                                                          \
    X(OVERSIZED, "a file or line is longer than is accepted")                                      \
    X(RANGE, "a number is outside its range, or not finite")                                       \
    X(TYPE, "a value does not have the type of its key")                                           \
    X(UNKNOWN, "a key, setting or name is not known")                                              \
    X(MISSING, "a key, value or file that is required is missing")                                 \
    X(CONFLICT, "two values contradict each other")                                                \
    X(UNSUPPORTED, "a feature that this version does not support")                                 \
    X(BUSY, "other programs kept the machine too busy to measure")                                 \
    X(MEMORY, "out of memory")                                                                     \
    X(RUNTIME, "a failure while running")

typedef enum DipErrorCode {
#define DIP_ERROR_ENUM(name, text) DIP_ERROR_##name,
    DIP_ERROR_LIST(DIP_ERROR_ENUM)
#undef DIP_ERROR_ENUM
} DipErrorCode;

// Who can mend the fault. The program's exit code follows from it: 2 for INPUT, 1 for RUNTIME, but
// 3 for the code BUSY.
typedef enum DipOrigin {
    DIP_ORIGIN_INPUT,  // The user, who gave a wrong command line or a file that cannot be used.
    DIP_ORIGIN_RUNTIME // The machine: it is out of memory, a file cannot be written, ...
} DipOrigin;

typedef enum DipSeverity { DIP_SEVERITY_ERROR, DIP_SEVERITY_WARNING } DipSeverity;

// One fault: its place, what was found and what is accepted. `file` and `key` are empty, and `line`
// is 0, if they do not apply.
typedef struct DipError {
    DipErrorCode code;
    DipOrigin origin;
    DipSeverity severity;
    char file[256];    // File name as the user wrote it; if it is too long, the end of the name.
    int line;          // Line in the file, from 1; 0 when the fault has no line.
    char key[64];      // Key, setting or argument at fault.
    char message[320]; // What was found and what is accepted, without a full stop.
} DipError;

// Fills *err and returns false, so that a caller can write `return dip_error_set(...)`. err, file
// and key may be NULL. A message that does not fit is cut. The origin is RUNTIME for the codes
// MEMORY and RUNTIME, and INPUT for all others.
DIP_API bool dip_error_set(DipError *err, DipErrorCode code, const char *file, int line,
                           const char *key, const char *format, ...) DIP_PRINTF(6, 7);

// Does the same as dip_error_set, but sets the origin RUNTIME for every code. Use it, for example,
// if a file cannot be written or another program broke off.
DIP_API bool dip_error_set_runtime(DipError *err, DipErrorCode code, const char *file, int line,
                                   const char *key, const char *format, ...) DIP_PRINTF(6, 7);

// Writes "file:line: [key] message", without the parts that the error does not have. Returns the
// length of the whole text, as snprintf does, even if the buffer is too small for the text.
DIP_API size_t dip_error_format(const DipError *err, char *buffer, size_t size_bytes);

// Returns the name of a code: "IO", "RANGE", ...
DIP_API const char *dip_error_code_name(DipErrorCode code);

// A list of the faults in one file, in the order of the file. Zero-initialise it; free it with
// dip_error_list_free. Callers may read the items but not change them.
typedef struct DipErrorList {
    DipError *items;
    size_t count;
    size_t capacity;
    size_t error_count; // Number of items that are errors; the others are warnings.
} DipErrorList;

// Appends a copy of *err. If memory runs out, the list still counts an error but does not keep it,
// unless it is the first one: a failure is never without a message. The first error then takes the
// place of the last warning or, in an empty list, becomes an error with the code MEMORY.
DIP_API void dip_error_list_add(DipErrorList *list, const DipError *err);
DIP_API void dip_error_list_free(DipErrorList *list);

#ifdef __cplusplus
}
#endif

#endif
