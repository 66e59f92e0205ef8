// Reads whole files, with the checks and messages that every kind of input needs.
#ifndef DIP_RENDERER_BASE_FILE_H
#define DIP_RENDERER_BASE_FILE_H

#include "renderer/base/api.h"
#include "renderer/base/error.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// Reads a regular file of at most max_bytes. Messages call the file by `kind`, for example "camera
// path" or "picture". On success *bytes is the content followed by a zero byte, and *size_bytes is
// the size without this zero. The caller frees *bytes. On failure *bytes is NULL and the error's
// code is MISSING (no such file), IO (the file cannot be read, or is a folder or device),
// OVERSIZED, MEMORY or RUNTIME (the machine has no memory or open files left). Thread-safe.
DIP_API bool dip_file_read(const char *file, const char *kind, size_t max_bytes,
                           unsigned char **bytes, size_t *size_bytes, DipError *err);

// Returns the code of the error after a file could not be opened for reading: MISSING, IO or
// RUNTIME, as in dip_file_read. error_number is the value of errno.
DIP_API DipErrorCode dip_file_open_code(int error_number);

#ifdef __cplusplus
}
#endif

#endif
