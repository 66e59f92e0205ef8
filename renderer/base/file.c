// Opens, checks and reads files.
#include "renderer/base/file.h"

#include <errno.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

// Finds the size of an open file. Fails if it is not a regular file or is larger than max_bytes.
static bool find_size(FILE *stream, const char *file, const char *kind, size_t max_bytes,
                      size_t *size_bytes, DipError *err) {
    struct stat status;
    if (fstat(fileno(stream), &status) != 0 || !S_ISREG(status.st_mode)) {
        return dip_error_set(err, DIP_ERROR_IO, file, 0, NULL, "%s is not a file", kind);
    }
    if ((uint64_t)status.st_size > max_bytes) {
        return dip_error_set(err, DIP_ERROR_OVERSIZED, file, 0, NULL,
                             "%s file has %lld bytes, accepted at most %zu", kind,
                             (long long)status.st_size, max_bytes);
    }
    *size_bytes = (size_t)status.st_size;
    return true;
}

static unsigned char *read_bytes(FILE *stream, const char *file, const char *kind,
                                 size_t size_bytes, DipError *err) {
    unsigned char *bytes = malloc(size_bytes + 1);
    if (!bytes) {
        dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory");
        return NULL;
    }
    if (fread(bytes, 1, size_bytes, stream) != size_bytes) {
        free(bytes);
        dip_error_set(err, DIP_ERROR_IO, file, 0, NULL, "%s file cannot be read to its end", kind);
        return NULL;
    }
    bytes[size_bytes] = '\0';
    return bytes;
}

// Returns whether the name belongs to something that is not a regular file. To open a named pipe
// would wait until another program writes to it.
static bool is_no_file(const char *file) {
    struct stat status;
    return stat(file, &status) == 0 && !S_ISREG(status.st_mode);
}

DipErrorCode dip_file_open_code(int error_number) {
    switch (error_number) {
    case ENOENT:
    case ENOTDIR:
        return DIP_ERROR_MISSING;
    case ENOMEM:
    case EMFILE:
    case ENFILE:
        return DIP_ERROR_RUNTIME;
    default:
        return DIP_ERROR_IO;
    }
}

bool dip_file_read(const char *file, const char *kind, size_t max_bytes, unsigned char **bytes,
                   size_t *size_bytes, DipError *err) {
    *bytes = NULL;
    if (is_no_file(file)) {
        return dip_error_set(err, DIP_ERROR_IO, file, 0, NULL, "%s is not a file", kind);
    }
    FILE *stream = fopen(file, "rb");
    if (!stream) {
        return dip_error_set(err, dip_file_open_code(errno), file, 0, NULL, "cannot open %s: %s",
                             kind, strerror(errno));
    }
    if (find_size(stream, file, kind, max_bytes, size_bytes, err)) {
        *bytes = read_bytes(stream, file, kind, *size_bytes, err);
    }
    fclose(stream);
    return *bytes != NULL;
}
