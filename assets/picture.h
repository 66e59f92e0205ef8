// Decodes pictures (PNG, JPEG, BMP, TGA) to 8-bit RGBA texels.
//
// Every function that fills a DipPicture gives the caller ownership of its texels, which
// dip_picture_free frees. On failure it returns false, leaves rgba8 NULL and fills *err (may be
// NULL).
//
// Threads: the functions share no state and may run at the same time on different pictures.
#ifndef DIP_ASSETS_PICTURE_H
#define DIP_ASSETS_PICTURE_H

#include "renderer/base/error.h"
#include "renderer/pipeline/texture.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { DIP_MAX_PICTURE_SIZE = 8192 }; // greatest width and height, pixels

typedef struct DipPicture {
    uint8_t *rgba8; // texels, row-major, the top row first, rows tightly packed; owned
    int width;      // pixels
    int height;     // pixels
    bool has_alpha; // true if the alpha of some texel is below 255
} DipPicture;

// Decodes the bytes of a picture file. Messages call the file `name`. Codes: FORMAT, TRUNCATED,
// RANGE (size).
bool dip_picture_decode(const uint8_t *bytes, size_t size_bytes, const char *name,
                        DipPicture *picture, DipError *err);

// Reads and decodes a file. Code MISSING: there is no such file. Other codes (IO, OVERSIZED, MEMORY
// and those of dip_picture_decode): the file exists, but it cannot be used.
bool dip_picture_read_file(const char *path, DipPicture *picture, DipError *err);

// Copies texels that are stored as b, g, r, a. Codes: RANGE (size), MEMORY.
bool dip_picture_from_bgra(const uint8_t *bgra8, uint32_t width, uint32_t height, const char *name,
                           DipPicture *picture, DipError *err);

// Copies the texels of a texture. Code: MEMORY.
bool dip_picture_copy(const DipTextureDef *texture, DipPicture *picture, DipError *err);

// Makes a new picture from the colours of one picture (NULL: white) and the opacity of another. The
// opacity is the alpha channel of the opacity picture if it has one, otherwise its brightness. If
// the sizes differ, the nearest texel of the opacity picture is used. Returns false when memory
// runs out.
bool dip_picture_with_opacity(const DipPicture *colour, const DipPicture *opacity,
                              DipPicture *picture);

// Frees the texels and zeroes the picture. Accepts a zeroed picture.
void dip_picture_free(DipPicture *picture);

#ifdef __cplusplus
}
#endif

#endif
