// Pictures (PNG, JPEG, BMP, TGA) to 8-bit RGBA texels.
#ifndef DIP_ASSETS_PICTURE_H
#define DIP_ASSETS_PICTURE_H

#include "renderer/base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { DIP_MAX_PICTURE_SIZE = 8192 }; // width and height, pixels

typedef struct DipPicture {
    uint8_t *rgba8; // row-major, the top row first; owned
    int width;
    int height;
    bool has_alpha; // some texel's alpha is below 255
} DipPicture;

// name: for messages. Thread-safe.
bool dip_picture_decode(const uint8_t *bytes, size_t size_bytes, const char *name,
                        DipPicture *picture, DipError *err);

// DIP_ERROR_MISSING when there is no such file; any other code means it is there and broken.
bool dip_picture_read_file(const char *path, DipPicture *picture, DipError *err);

// Takes over texels stored as b, g, r, a.
bool dip_picture_from_bgra(const uint8_t *bgra8, uint32_t width, uint32_t height, const char *name,
                           DipPicture *picture, DipError *err);

// Replaces the alpha by the opacity picture's: its own alpha where it has any, else its
// brightness; sampled at the nearest texel when sizes differ. colour NULL: white. The result is a
// picture of its own; false when memory runs out.
bool dip_picture_with_opacity(const DipPicture *colour, const DipPicture *opacity,
                              DipPicture *picture);

void dip_picture_free(DipPicture *picture);

#endif
