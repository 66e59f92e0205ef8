// Textures: pictures with mip chains, and the samplers that say how shaders read them.
//
// Any number of pipelines on any thread may read a texture. It does not change, unless its owner
// calls dip_texture_update.
#ifndef DIP_RENDERER_PIPELINE_TEXTURE_H
#define DIP_RENDERER_PIPELINE_TEXTURE_H

#include "renderer/base/api.h"
#include "renderer/base/error.h"
#include "renderer/base/pool.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    DIP_MAX_TEXTURE_SIZE = 8192, // largest width and height, in texels
    DIP_MAX_LEVELS = 14,         // a texture of 8192 texels has 14 mip levels
    DIP_LEVEL_TABLE = 16         // length of a table that has one value per level
};

// Address modes: what lies beyond the edges of a texture along an axis.
typedef enum DipWrap {
    DIP_WRAP_REPEAT, // copies of the texture
    DIP_WRAP_CLAMP,  // the texels at the edge
    DIP_WRAP_MIRROR, // copies of the texture, every second one mirrored
    DIP_WRAP_BORDER, // the colour border_rgba8
    DIP_WRAP_COUNT
} DipWrap;

// How a texture's colour channels are stored. Alpha is always linear.
typedef enum DipEncoding { DIP_ENCODING_SRGB, DIP_ENCODING_LINEAR } DipEncoding;

// A picture of 8-bit RGBA texels, row-major and tightly packed. The top row comes first; v = 0 is
// its upper edge.
typedef struct DipTextureDef {
    const char *name;
    int width;  // 1..DIP_MAX_TEXTURE_SIZE
    int height; // 1..DIP_MAX_TEXTURE_SIZE
    const uint8_t *rgba8;
    DipEncoding encoding;
    DipWrap wrap_u;
    DipWrap wrap_v;
    // Colour beyond the edges of axes with DIP_WRAP_BORDER, encoded as the texels are.
    uint8_t border_rgba8[4];
} DipTextureDef;

typedef struct DipTexture DipTexture;

// Makes a texture with its whole mip chain from a copy of the texels. Runs on the caller's thread.
// Fails with RANGE (a field is out of range), MISSING (no texels) or MEMORY.
DIP_API DipTexture *dip_texture_create(const DipTextureDef *def, DipError *err);

// Makes textures[0..count-1] with their mip chains. Runs on the pool, or on the caller's thread if
// the pool is NULL. The texels are the same for every number of threads. Fails as
// dip_texture_create does; then it makes no texture at all. used: textures[i] becomes NULL where
// used[i] is false; NULL means all are used. keep_alpha: textures[i] has an alpha plane only if
// keep_alpha[i] is true and some texel is not opaque; NULL means true for all.
DIP_API bool dip_textures_create(const DipTextureDef *defs, const bool *used,
                                 const bool *keep_alpha, int count, DipPool *pool,
                                 DipTexture **textures, DipError *err);

// Makes a texture whose mip levels are the given pictures, instead of a filtered chain. The
// pictures may have any sizes. level_count: 1..DIP_MAX_LEVELS. The texture takes its address modes
// and its border from levels[0]; each level has its own encoding. It has an alpha plane if some
// texel or the border is not opaque. Fails as dip_texture_create does.
DIP_API DipTexture *dip_texture_create_from_levels(const DipTextureDef *levels, int level_count,
                                                   DipError *err);

// Writes the texels of a level to rgba8, row by row and tightly packed, as the nearest 8-bit values
// in the given encoding. Level 0 of a texture that was made from texels of the same encoding gives
// exactly these texels; their alpha is 255 if the texture has no alpha plane. Fails with RANGE or
// MEMORY.
DIP_API bool dip_texture_read(const DipTexture *texture, int level, DipEncoding encoding,
                              uint8_t *rgba8, DipError *err);

// New texels for a rectangle of level 0.
typedef struct DipTextureUpdate {
    int x; // left column of the rectangle
    int y; // top row of the rectangle
    int width;
    int height;
    const uint8_t *rgba8; // 8-bit RGBA texels in the texture's encoding; the top row comes first
    size_t stride_bytes;  // distance from one row to the next
} DipTextureUpdate;

// Replaces a rectangle of level 0 and makes the mip chain again. The texture has the same bits as a
// new texture of the whole changed picture; it keeps its alpha plane even if all texels are opaque
// now. Textures that were compressed from it keep their old colours. The time is that of making
// such a texture, whatever the size of the rectangle; if the rectangle is not the whole of level 0,
// the time of reading level 0 is added. Runs on the pool, or on the caller's thread if the pool is
// NULL. No draw and no other thread may use the texture, or textures that were compressed from it,
// during the call. Fails with RANGE (the rectangle is not inside the texture, or stride_bytes is
// too small), MISSING (no texels), CONFLICT (the texture was made by dip_texture_create_from_levels
// or dip_textures_compress) or MEMORY; the texture is then unchanged.
DIP_API bool dip_texture_update(DipTexture *texture, const DipTextureUpdate *update, DipPool *pool,
                                DipError *err);

// Makes compressed[i], which shows textures[i] as BC1 would: the colours of every level are encoded
// and decoded again. The result is as large in memory as the original. compressed[i] is NULL where
// wanted[i] is false. It shares the alpha plane of textures[i], so textures[i] must outlive it.
// Runs on the pool, or on the caller's thread if the pool is NULL. The texels are the same for
// every number of threads. Fails with MEMORY; then it makes no texture at all.
DIP_API bool dip_textures_compress(DipTexture *const *textures, const bool *wanted, int count,
                                   DipPool *pool, DipTexture **compressed, DipError *err);

// Frees a texture that no draw uses any more. *texture may be NULL and becomes NULL.
DIP_API void dip_texture_destroy(DipTexture **texture);

DIP_API int dip_texture_level_count(const DipTexture *texture);

// Size of a level in texels; level 0 is the largest. level: 0..dip_texture_level_count - 1.
DIP_API void dip_texture_level_size(const DipTexture *texture, int level, int *width, int *height);

// The first function returns the bytes of the texture's colours, the second one the bytes of its
// alpha plane, or 0 if it has no alpha plane of its own. A texel of any level takes 8 bytes for its
// colour and 2 bytes for its alpha, because it is stored together with the texel below it. Both
// return 0 for NULL.
DIP_API uint64_t dip_texture_colour_bytes(const DipTexture *texture);
DIP_API uint64_t dip_texture_alpha_bytes(const DipTexture *texture);

// How the texels around a position are filtered. docs/picture.md (Textures) has the definitions.
typedef enum DipFilter {
    DIP_FILTER_TRILINEAR, // bilinearly in the two nearest mip levels, which are blended
    DIP_FILTER_BILINEAR,  // bilinearly in the nearest mip level
    DIP_FILTER_POINT,     // the nearest texel of the nearest mip level; max_anisotropy is not used
    DIP_FILTER_COUNT
} DipFilter;

// How a shader reads a texture. A footprint is the area of the texture that a pixel covers. A read
// takes probes (bilinear reads) along the footprint's long axis. Levels of detail are in units of
// 1/256 level.
typedef struct DipSampler {
    const DipTexture *texture;
    int max_anisotropy; // most probes along a footprint's long axis: 0 or 1 (trilinear) .. 16
    // True: the long axis is the major axis of the footprint's exact ellipse. False: the long axis
    // is estimated from the screen derivatives, so the level of detail depends on the surface's
    // angle on the screen.
    bool exact_footprint;
    int32_t bias_lod8; // added to the level of detail; within +-2^20
    int32_t min_lod8;  // smallest level of detail, 0..2^20
    // True saves time: two levels are blended only in the middle quarter of the way from one to the
    // other, and a footprint gets half the number of probes, rounded up.
    bool cheap;
    // Mip debugging: where a shader reads level l of `texture`, it gets level shown_level[l] of
    // `shown`. If `shown` is NULL, it gets `texture` itself.
    const DipTexture *shown;
    int32_t shown_level[DIP_LEVEL_TABLE];
    DipFilter filter;
    bool no_mips; // True: only the level min_lod8 / 256, rounded down, is read.
} DipSampler;

#ifdef __cplusplus
}
#endif

#endif
