// Reading a file whole, with the checks and the messages that every kind of input needs.
#ifndef DIP_RENDERER_BASE_FILE_H
#define DIP_RENDERER_BASE_FILE_H

#include "renderer/base/api.h"
#include "renderer/base/error.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// Reads a regular file of at most max_bytes. `kind` names what the file is in messages, "camera
// path" or "picture". On success *bytes is the content with a terminating zero after it, to be
// freed by the caller, and *size_bytes its size without that zero. Otherwise *bytes is NULL and
// the code is MISSING (no such file), IO (cannot be read, or is a folder or device), OVERSIZED or
// MEMORY. Thread-safe.
DIP_API bool dip_file_read(const char *file, const char *kind, size_t max_bytes,
                           unsigned char **bytes, size_t *size_bytes, DipError *err);

#ifdef __cplusplus
}
#endif

#endif
