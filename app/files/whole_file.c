// Writes a file under a temporary name and then renames it. Makes the missing folders of a path,
// beginning with the outermost one.
#include "app/files/whole_file.h"

#include <errno.h>
#include <limits.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool write_all(const char *name, const void *bytes, size_t size_bytes) {
    FILE *out = fopen(name, "wb");
    if (!out) {
        return false;
    }
    const bool written = fwrite(bytes, 1, size_bytes, out) == size_bytes;
    const bool closed = fclose(out) == 0;
    return written && closed;
}

bool dip_whole_file_write(const char *file, const void *bytes, size_t size_bytes, DipError *err) {
    static atomic_uint serial; // Keeps the temporary names of two threads apart.
    const size_t room = strlen(file) + 48;
    char *temporary = malloc(room);
    if (!temporary) {
        return dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory");
    }
    snprintf(temporary, room, "%s.%ld.%u.tmp", file, (long)getpid(), atomic_fetch_add(&serial, 1));
    bool written = write_all(temporary, bytes, size_bytes) && rename(temporary, file) == 0;
    if (!written) {
        const int reason = errno;
        remove(temporary);
        dip_error_set_runtime(err, DIP_ERROR_IO, file, 0, NULL, "cannot be written: %s",
                              strerror(reason));
    }
    free(temporary);
    return written;
}

bool dip_whole_file_print(const char *file, bool (*print)(const void *context, FILE *out),
                          const void *context, DipError *err) {
    char *text = NULL;
    size_t size_bytes = 0;
    FILE *out = open_memstream(&text, &size_bytes);
    bool made = out && print(context, out) && !ferror(out);
    // If memory runs out while the stream is closed, glibc sets the text to NULL.
    made = out && fclose(out) == 0 && made && text;
    const bool written = made
                             ? dip_whole_file_write(file, text, size_bytes, err)
                             : dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory");
    free(text);
    return written;
}

bool dip_folder_make(const char *folder, const char *option, DipError *err) {
    char part[PATH_MAX];
    const size_t length = strlen(folder);
    if (length >= sizeof part) {
        return dip_error_set_runtime(err, DIP_ERROR_OVERSIZED, folder, 0, option,
                                     "the name is too long");
    }
    for (size_t i = 1; i <= length; i++) {
        if (folder[i] == '/' || folder[i] == '\0') {
            memcpy(part, folder, i);
            part[i] = '\0';
            if (mkdir(part, 0777) != 0 && errno != EEXIST) {
                return dip_error_set_runtime(err, DIP_ERROR_IO, part, 0, option,
                                             "cannot make this folder: %s", strerror(errno));
            }
        }
    }
    struct stat status;
    if (stat(folder, &status) != 0 || !S_ISDIR(status.st_mode)) {
        return dip_error_set_runtime(err, DIP_ERROR_IO, folder, 0, option, "is not a folder");
    }
    return true;
}
