// Writes binary PPM files.
#include "tests/peer/pictures.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

static bool write_ppm(const char *file, const uint8_t *rgba8, size_t stride_bytes, int width,
                      int height, DipError *err) {
    FILE *out = fopen(file, "wb");
    bool written = out && fprintf(out, "P6\n%d %d\n255\n", width, height) > 0;
    for (int y = 0; written && y < height; y++) {
        const uint8_t *pixel = rgba8 + stride_bytes * (size_t)y;
        for (int x = 0; written && x < width; x++) {
            written = fwrite(pixel + 4 * x, 3, 1, out) == 1;
        }
    }
    if (out && fclose(out) != 0) {
        written = false;
    }
    return written ||
           dip_error_set(err, DIP_ERROR_IO, file, 0, "--pictures", "%s", strerror(errno));
}

bool dip_pictures_write(const char *folder, const char *row, int index, const DipFrame *ours,
                        const uint8_t *peer_rgba8, DipError *err) {
    char file[4096];
    snprintf(file, sizeof file, "%s/%s_%04d_ours.ppm", folder, row, index);
    if (!write_ppm(file, ours->rgba8, ours->stride_bytes, ours->width, ours->height, err)) {
        return false;
    }
    snprintf(file, sizeof file, "%s/%s_%04d_peer.ppm", folder, row, index);
    return !peer_rgba8 ||
           write_ppm(file, peer_rgba8, (size_t)ours->width * 4, ours->width, ours->height, err);
}
