// Makes each missing folder of a path, from the outermost inwards.
#include "app/files/folder.h"

#include <errno.h>
#include <limits.h>
#include <string.h>
#include <sys/stat.h>

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
