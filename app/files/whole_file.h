// Writing a file whole or not at all.
#ifndef DIP_APP_FILES_WHOLE_FILE_H
#define DIP_APP_FILES_WHOLE_FILE_H

#include "renderer/base/error.h"

#include <stddef.h>

// Writes to a temporary name beside the file, then renames: under the final name there is never
// half a file. Fails with IO, naming the file and the system's reason; then nothing is left.
bool dip_whole_file_write(const char *file, const void *bytes, size_t size_bytes, DipError *err);

#endif
