// Writes files whole or not at all, and makes the folders for them.
#ifndef DIP_APP_FILES_WHOLE_FILE_H
#define DIP_APP_FILES_WHOLE_FILE_H

#include "renderer/base/api.h"
#include "renderer/base/error.h"

#include <stddef.h>
#include <stdio.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

// Returns the file's name without its folder, as a part of `file`.
static inline const char *dip_base_name(const char *file) {
    const char *slash = strrchr(file, '/');
    return slash ? slash + 1 : file;
}

// Writes to a temporary file beside `file` and renames it, so that a half-written file never has
// the final name. Fails with DIP_ERROR_IO and the system's reason, or with DIP_ERROR_MEMORY.
// *err then has the file's name, and no temporary file is left. Thread-safe for different files.
DIP_API bool dip_whole_file_write(const char *file, const void *bytes, size_t size_bytes,
                                  DipError *err);

// Calls `print` and writes the text that it prints to the file, whole or not at all. Fails as
// dip_whole_file_write does, and with DIP_ERROR_MEMORY if memory runs out or `print` returns false.
DIP_API bool dip_whole_file_print(const char *file, bool (*print)(const void *context, FILE *out),
                                  const void *context, DipError *err);

// Makes the folder and its missing parents, if they do not exist. Fails with DIP_ERROR_OVERSIZED or
// DIP_ERROR_IO. The message names `option`, the option that gave the folder. Thread-safe.
DIP_API bool dip_folder_make(const char *folder, const char *option, DipError *err);

#ifdef __cplusplus
}
#endif

#endif
