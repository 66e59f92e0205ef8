// Appends poses to a path file, and names saved files.
#include "app/preview/state/poses.h"

#include "app/files/whole_file.h"
#include "app/session/picture_texts.h"
#include "campaths/campath.h"
#include "renderer/base/file.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char header[] = "diptych-path 1\n"
                             "# poses saved in the preview; seconds from key to key\n"
                             "period 1\n"
                             "# x y z qx qy qz qw\n";

enum { MAX_KEY_LINE = 400, MAX_SHOWN_FOLDER = 90 };

// Reads the file, or makes the beginning of a new one. The caller frees *bytes.
static bool read_poses(const char *file, unsigned char **bytes, size_t *size_bytes, DipError *err) {
    if (access(file, F_OK) == 0) {
        return dip_file_read(file, "camera path", DIP_CAMPATH_MAX_FILE_BYTES, bytes, size_bytes,
                             err);
    }
    const size_t length = strlen(header);
    *bytes = malloc(length + 1);
    if (!*bytes) {
        return dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory");
    }
    memcpy(*bytes, header, length + 1);
    *size_bytes = length;
    return true;
}

// Appends the pose as a line of the file's text. *bytes may move.
static bool append_line(const DipPose *pose, unsigned char **bytes, size_t *size_bytes,
                        const char *file, DipError *err) {
    char numbers[MAX_KEY_LINE - 64];
    unsigned char *grown = realloc(*bytes, *size_bytes + MAX_KEY_LINE);
    if (!grown) {
        return dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory");
    }
    *bytes = grown;
    dip_pose_format(pose, numbers, sizeof numbers);
    const bool ends = *size_bytes > 0 && grown[*size_bytes - 1] == '\n';
    const int length = snprintf((char *)grown + *size_bytes, MAX_KEY_LINE, "%s%s  # fov %.9g\n",
                                ends ? "" : "\n", numbers, pose->fov_y_deg);
    *size_bytes += (size_t)length;
    return true;
}

// Checks that the bytes are a path, and counts its keys.
static bool check(const unsigned char *bytes, size_t size_bytes, const char *file, size_t *count,
                  DipError *err) {
    DipCamPath *path;
    if (!dip_campath_parse(bytes, size_bytes, file, &path, err)) {
        return false;
    }
    *count = dip_campath_info(path).key_count;
    dip_campath_destroy(&path);
    return true;
}

bool dip_poses_append(const char *file, const DipPose *pose, size_t *count, DipError *err) {
    unsigned char *bytes = NULL;
    size_t size_bytes = 0;
    // A path file in the binary format ends after its keys. With a line appended, check() refuses
    // it, so the file stays as it is.
    const bool saved = read_poses(file, &bytes, &size_bytes, err) &&
                       append_line(pose, &bytes, &size_bytes, file, err) &&
                       check(bytes, size_bytes, file, count, err) &&
                       dip_whole_file_write(file, bytes, size_bytes, err);
    free(bytes);
    return saved;
}

void dip_saved_describe(const char *what, const char *file, char *text, size_t size_bytes) {
    char folder[PATH_MAX];
    if (!getcwd(folder, sizeof folder)) {
        snprintf(text, size_bytes, "%s %s", what, file);
        return;
    }
    const size_t length = strlen(folder);
    const char *shown = folder;
    if (length > MAX_SHOWN_FOLDER) {
        shown = folder + length - MAX_SHOWN_FOLDER;
        while ((*shown & 0xc0) == 0x80) { // Do not begin inside a UTF-8 sequence.
            ++shown;
        }
    }
    snprintf(text, size_bytes, "%s %s in %s%s", what, file, shown == folder ? "" : "...", shown);
}

bool dip_saved_free_name(const char *name, const char *ending, char *file, size_t size_bytes) {
    for (int i = 1; i <= 9999; ++i) {
        snprintf(file, size_bytes, "%s-%04d.%s", name, i, ending);
        if (access(file, F_OK) != 0) {
            return true;
        }
    }
    return false;
}
