// Writing, checking and reading the files of kept frames.
#include "app/report/kept_frames.h"

#include "app/files/png.h"
#include "app/files/whole_file.h"
#include "assets/picture.h"
#include "renderer/base/file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Room for the largest picture, uncompressed, with its headers.
enum { MAX_FILE_BYTES = DIP_MAX_PICTURE_SIZE * DIP_MAX_PICTURE_SIZE * 4 };

void dip_cost_kept_frames_free(DipCostKeptFrames *kept) {
    free(kept->list);
    *kept = (DipCostKeptFrames){0};
}

bool dip_cost_kept_frame_file(const char *folder, const char *hash, char file[PATH_MAX]) {
    const int length = snprintf(file, PATH_MAX, "%s/frames/%s.png", folder, hash);
    return length > 0 && length < PATH_MAX;
}

static void hash_bytes(const void *bytes, size_t size_bytes, char hex[DIP_HASH_HEX_SIZE]) {
    DipHash hash = dip_hash_begin(0);
    dip_hash_bytes(&hash, bytes, size_bytes);
    dip_hash_hex(&hash, hex);
}

bool dip_cost_kept_frame_write(DipCostKeptFrame *frame, const char *folder, const uint8_t *rgba8,
                               int width, int height, DipError *err) {
    unsigned char *bytes;
    size_t size;
    char file[PATH_MAX];
    if (!dip_png_encode(rgba8, (size_t)width * 4, width, height, &bytes, &size)) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost", "out of memory");
    }
    hash_bytes(bytes, size, frame->hash);
    const bool written = dip_cost_kept_frame_file(folder, frame->hash, file)
                             ? dip_whole_file_write(file, bytes, size, err)
                             : dip_error_set_runtime(err, DIP_ERROR_OVERSIZED, folder, 0, "--out",
                                                     "the name is too long");
    free(bytes);
    return written;
}

bool dip_cost_kept_frame_check(const DipCostKeptFrame *frame, const char *folder,
                               DipCostKeptState *state, DipError *err) {
    unsigned char *bytes = NULL;
    size_t size = 0;
    char file[PATH_MAX];
    char found[DIP_HASH_HEX_SIZE];
    DipError why = {0};
    *state = DIP_COST_KEPT_MISSING;
    if (!dip_cost_kept_frame_file(folder, frame->hash, file)) {
        return true;
    }
    if (!dip_file_read(file, "picture", MAX_FILE_BYTES, &bytes, &size, &why)) {
        return why.code != DIP_ERROR_MEMORY ||
               dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory");
    }
    hash_bytes(bytes, size, found);
    *state = strcmp(found, frame->hash) == 0 ? DIP_COST_KEPT_WHOLE : DIP_COST_KEPT_DAMAGED;
    free(bytes);
    return true;
}

bool dip_cost_kept_frame_read(const DipCostKeptFrame *frame, const char *folder, uint8_t *rgba8,
                              int width, int height, DipError *err) {
    char file[PATH_MAX];
    DipPicture picture;
    if (!dip_cost_kept_frame_file(folder, frame->hash, file)) {
        return dip_error_set(err, DIP_ERROR_OVERSIZED, folder, 0, NULL, "the name is too long");
    }
    if (!dip_picture_read_file(file, &picture, err)) {
        return false;
    }
    const bool fits = picture.width == width && picture.height == height;
    if (fits) {
        memcpy(rgba8, picture.rgba8, (size_t)width * (size_t)height * 4);
    } else {
        dip_error_set(err, DIP_ERROR_FORMAT, file, 0, NULL,
                      "has %dx%d pixels, but the report's pictures have %dx%d", picture.width,
                      picture.height, width, height);
    }
    dip_picture_free(&picture);
    return fits;
}
