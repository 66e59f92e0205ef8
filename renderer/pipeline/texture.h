// Textures: pictures with mip chains, and the samplers that say how shaders read them.
//
// A texture is immutable. Any number of pipelines on any thread may read it.
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

typedef enum DipWrap { DIP_WRAP_REPEAT, DIP_WRAP_CLAMP } DipWrap;

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
} DipTextureDef;

typedef struct DipTexture DipTexture;

// Makes a texture with its whole mip chain from a copy of the texels. Runs on the caller's thread.
// Fails with RANGE (the size is out of range) or MEMORY.
DIP_API DipTexture *dip_texture_create(const DipTextureDef *def, DipError *err);

// Makes textures[0..count-1] with their mip chains. Runs on the pool, or on the caller's thread if
// the pool is NULL. The texels are the same for every number of threads. Fails with RANGE (a size
// is out of range) or MEMORY; then it makes no texture at all.
// used: textures[i] becomes NULL where used[i] is false; NULL means all are used.
// keep_alpha: textures[i] has an alpha plane only if keep_alpha[i] is true and some texel is not
// opaque; NULL means true for all.
DIP_API bool dip_textures_create(const DipTextureDef *defs, const bool *used,
                                 const bool *keep_alpha, int count, DipPool *pool,
                                 DipTexture **textures, DipError *err);

// Makes a texture whose mip levels are the given pictures, instead of a filtered chain. The
// pictures may have any sizes. level_count: 1..DIP_MAX_LEVELS. The texture has no alpha, and it
// takes its address modes from levels[0]. Fails with RANGE (a size is out of range) or MEMORY.
DIP_API DipTexture *dip_texture_create_from_levels(const DipTextureDef *levels, int level_count,
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

// Returns the bytes of the texture's colours. If the texture has an alpha plane of its own, the
// plane's bytes are added. Returns 0 for NULL.
DIP_API uint64_t dip_texture_colour_bytes(const DipTexture *texture);
DIP_API uint64_t dip_texture_alpha_bytes(const DipTexture *texture);

// How a shader reads a texture. A footprint is the area of the texture that a pixel covers. A read
// takes probes (bilinear reads) along the footprint's long axis. Levels of detail are in units of
// 1/256 level.
typedef struct DipSampler {
    const DipTexture *texture;
    int max_anisotropy; // most probes along a footprint's long axis: 1 (trilinear) .. 16
    // True: the long axis is the major axis of the footprint's exact ellipse. False: the long axis
    // is estimated from the screen derivatives, so the level of detail depends on the surface's
    // angle on the screen.
    bool exact_footprint;
    int32_t bias_lod8; // added to the level of detail
    int32_t min_lod8;  // smallest level of detail
    // True saves time: two levels are blended only in the middle quarter of the way from one to the
    // other, and a footprint gets half the number of probes, rounded up.
    bool cheap;
    // Mip debugging: where a shader reads level l of `texture`, it gets level shown_level[l] of
    // `shown`. If `shown` is NULL, it gets `texture` itself.
    const DipTexture *shown;
    int32_t shown_level[DIP_LEVEL_TABLE];
} DipSampler;

#ifdef __cplusplus
}
#endif

#endif
