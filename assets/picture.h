// Decodes pictures (PNG, JPEG, BMP, TGA, DDS, PCX, PPM, PGM, HDR) to 8-bit RGBA texels.
//
// A scene that needs one picture reads it with dip_picture_read_file, or with dip_picture_import
// (importer.h) if the file is not trusted, and hands its levels to the pipeline:
//     DipTextureDef levels[DIP_MAX_LEVELS];
//     const int count = dip_picture_levels(&picture, "stone", DIP_ENCODING_SRGB, levels);
//     DipTexture *texture = dip_texture_create_from_levels(levels, count, err); // levels of a DDS
//     DipTexture *filtered = dip_texture_create(&levels[0], err); // Diptych's own mip chain
//
// Linear light of an HDR file is cut off at 1 and encoded as sRGB, except in an environment.
//
// Every function that fills a DipPicture gives the caller ownership of its texels, which
// dip_picture_free frees. On failure it returns false, leaves rgba8 NULL and fills *err (may be
// NULL).
//
// Threads: the functions share no state and may run at the same time on different pictures.
#ifndef DIP_ASSETS_PICTURE_H
#define DIP_ASSETS_PICTURE_H

#include "renderer/base/api.h"
#include "renderer/base/error.h"
#include "renderer/pipeline/texture.h"
#include "renderer/scene/lights.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { DIP_MAX_PICTURE_SIZE = 8192 }; // greatest width and height, pixels

typedef struct DipPicture {
    // Texels, row-major, the top row first, rows tightly packed; owned. The texels of level 0 come
    // first, and those of every smaller level follow without a gap.
    uint8_t *rgba8;
    int width;       // Width of level 0, in pixels.
    int height;      // Height of level 0, in pixels.
    bool has_alpha;  // True if the alpha of some texel of level 0 is below 255.
    int level_count; // Number of mip levels; 1 unless a DDS file stores more.
} DipPicture;

// Returns the texels of a level, and its size: half of the size of the level before, rounded down,
// but at least 1. level: 0..level_count - 1.
DIP_API const uint8_t *dip_picture_level(const DipPicture *picture, int level, int *width,
                                         int *height);

// Describes every level of the picture as a texture that repeats. `levels` has room for
// level_count items; DIP_MAX_LEVELS are always enough. They point to the picture's texels and to
// the name. Returns level_count.
DIP_API int dip_picture_levels(const DipPicture *picture, const char *name, DipEncoding encoding,
                               DipTextureDef *levels);

// Decodes the bytes of a picture file. Messages call the file `name`. Codes: FORMAT, TRUNCATED,
// RANGE (size), UNSUPPORTED (a variant of DDS or PCX), MEMORY.
DIP_API bool dip_picture_decode(const uint8_t *bytes, size_t size_bytes, const char *name,
                                DipPicture *picture, DipError *err);

// Reads and decodes a file. Code MISSING: there is no such file. Other codes (IO, OVERSIZED, MEMORY
// and those of dip_picture_decode): the file exists, but it cannot be used.
DIP_API bool dip_picture_read_file(const char *path, DipPicture *picture, DipError *err);

// Copies texels that are stored as b, g, r, a. Codes: RANGE (size), MEMORY.
DIP_API bool dip_picture_from_bgra(const uint8_t *bgra8, uint32_t width, uint32_t height,
                                   const char *name, DipPicture *picture, DipError *err);

// Copies the texels of textures, which are the levels of one picture. Codes: FORMAT (the sizes are
// not those of levels), MEMORY.
DIP_API bool dip_picture_copy(const DipTextureDef *levels, int level_count, DipPicture *picture,
                              DipError *err);

// Makes a new picture in which factor x factor texels stand for each texel of a picture's largest
// level. Returns false when memory runs out.
DIP_API bool dip_picture_enlarge(const DipPicture *picture, int factor, DipPicture *enlarged);

// Makes a new picture from the colours of one picture (NULL: white) and the opacity of another. The
// opacity is the alpha channel of the opacity picture if it has one, otherwise its brightness. If
// the sizes differ, the nearest texel of the opacity picture is used. Returns false when memory
// runs out.
DIP_API bool dip_picture_with_opacity(const DipPicture *colour, const DipPicture *opacity,
                                      DipPicture *picture);

// Frees the texels and zeroes the picture. Accepts a zeroed picture.
DIP_API void dip_picture_free(DipPicture *picture);

// Decodes the bytes of an HDR file, or reads such a file, as the surroundings of a scene. Light
// above DIP_MAX_ENVIRONMENT_LIN is cut off. The caller frees the environment, texels included, with
// free(). Return NULL and fill *err (may be NULL) on failure, with the codes of dip_picture_decode
// and dip_picture_read_file; RANGE also if the width is not twice the height.
DIP_API DipEnvironmentDef *dip_environment_decode(const uint8_t *bytes, size_t size_bytes,
                                                  const char *name, DipError *err);
DIP_API DipEnvironmentDef *dip_environment_read_file(const char *path, DipError *err);

#ifdef __cplusplus
}
#endif

#endif
