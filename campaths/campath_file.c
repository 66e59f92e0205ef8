// Loads and saves camera path files, and recognises their format.
#include "campaths/campath_private.h"

#include "renderer/base/fp_mode.h"
#include "renderer/base/file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

bool dip_campath_parse(const void *bytes, size_t size_bytes, const char *name, DipCamPath **path,
                       DipError *err) {
    DIP_FP_MODE_SCOPE();
    *path = NULL;
    if (size_bytes == 0) {
        return dip_error_set(err, DIP_ERROR_TRUNCATED, name, 0, NULL,
                             "the file is empty, accepted a .pth or .bth camera path");
    }
    // No text begins with this byte, not even in UTF-8.
    if (*(const unsigned char *)bytes == dip_campath_magic[0]) {
        return dip_campath_parse_binary(bytes, size_bytes, name, path, err);
    }
    return dip_campath_parse_text(bytes, size_bytes, name, path, err);
}

bool dip_campath_load(const char *file, DipCamPath **path, DipError *err) {
    *path = NULL;
    unsigned char *bytes;
    size_t size_bytes = 0;
    if (!dip_file_read(file, "camera path", DIP_CAMPATH_MAX_FILE_BYTES, &bytes, &size_bytes, err)) {
        return false;
    }
    const bool loaded = dip_campath_parse(bytes, size_bytes, file, path, err);
    free(bytes);
    return loaded;
}

static bool save(const DipCamPath *path, const char *file,
                 void (*write)(const DipCamPath *, FILE *), DipError *err) {
    DIP_FP_MODE_SCOPE();
    FILE *stream = fopen(file, "wb");
    if (!stream) {
        return dip_error_set_runtime(err, DIP_ERROR_IO, file, 0, NULL, "cannot be written (%s)",
                                     strerror(errno));
    }
    write(path, stream);
    const bool failed = ferror(stream) != 0;
    struct stat status;
    const bool is_regular = fstat(fileno(stream), &status) == 0 && S_ISREG(status.st_mode);
    if (fclose(stream) != 0 || failed) {
        if (is_regular) { // A device must not be removed.
            remove(file);
        }
        return dip_error_set_runtime(err, DIP_ERROR_IO, file, 0, NULL,
                                     "cannot be written to its end");
    }
    return true;
}

bool dip_campath_save_pth(const DipCamPath *path, const char *file, DipError *err) {
    return save(path, file, dip_campath_write_text, err);
}

bool dip_campath_save_bth(const DipCamPath *path, const char *file, DipError *err) {
    return save(path, file, dip_campath_write_binary, err);
}
