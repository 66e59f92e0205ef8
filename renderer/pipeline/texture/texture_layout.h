// Textures as the fast path stores them: mip chains in linear light, packed for filtering.
//
// A texel is 32 bits: square roots of linear light. The upper half is red in 16 bits, the lower
// half green, but their five lowest bits are blue's ten, the higher five with red; red and green
// are rounded with blue's bits in place, so that they are read as they are, within 16. The square
// root spreads the codes as the eye does; the error is below 0.06 sRGB codes (blue 0.12; 0.11 for
// full red or green without blue). Alpha is a separate plane of bytes, kept only when some texel is
// not opaque.
//
// Every level has one column and one row more than its size, which repeat the first (DIP_WRAP_
// REPEAT) or the last (DIP_WRAP_CLAMP), so the four texels of a bilinear read are always at
// offset, +1, +stride, +stride+1.
#ifndef DIP_RENDERER_PIPELINE_TEXTURE_TEXTURE_LAYOUT_H
#define DIP_RENDERER_PIPELINE_TEXTURE_TEXTURE_LAYOUT_H

#include "renderer/scene/scene.h"

#include <stdint.h>

enum {
    DIP_MAX_LEVELS = 14, // 8192 has 14
    DIP_LEVEL_TABLE = 16 // entries of a table of levels: what a kernel looks up at once
};

// Mask of blue's bits, and what its parts are multiplied by to make a number of 16 bits.
#define DIP_TEXEL_BLUE        0x001f001fu
#define DIP_TEXEL_BLUE_PLACES 0x08000040u

typedef struct DipTexture {
    int width; // of level 0, texels
    int height;
    int level_count;
    DipWrap wrap_u;
    DipWrap wrap_v;
    int32_t level_offset[DIP_LEVEL_TABLE]; // of the level's first texel, in texels
    int32_t level_width[DIP_LEVEL_TABLE];  // texels; a row takes one more, see above
    int32_t level_height[DIP_LEVEL_TABLE];
    // Both axes repeat and every level's sizes are powers of two: coordinates may be fractions in
    // 32 bits, which wrap by themselves.
    bool wraps_in_bits;
    int32_t level_log2_width[DIP_LEVEL_TABLE];
    int32_t level_log2_height[DIP_LEVEL_TABLE];
    uint32_t *texels;
    uint8_t *alpha;     // the same layout; NULL when all texels are opaque or nothing asks
    bool shares_alpha;  // with the texture it was made from
    size_t texel_count; // padding included
} DipTexture;

// Builds textures with their whole mip chains into textures[0..count-1], all or none. defs are only
// read; those that are not used (NULL: all are) are left out and their textures are NULL, and alpha
// is kept of those that clip (NULL: of all that have any). On the pool (may be NULL), across
// textures and within them: the same texels for every number of threads.
bool dip_textures_create(const DipTextureDef *defs, const bool *used, const bool *clip, int count,
                         DipPool *pool, DipTexture **textures, DipError *err);

// One texture, on the caller's thread.
DipTexture *dip_texture_create(const DipTextureDef *def, DipError *err);

// A texture whose levels are given pictures of any size instead of a chain (mip debugging):
// 1..DIP_MAX_LEVELS of them.
DipTexture *dip_texture_create_from_levels(const DipTextureDef *levels, int level_count,
                                           DipError *err);
void dip_texture_destroy(DipTexture **texture);

// Fills in the padding that repeats texels of a level's row; the row is complete.
void dip_texture_pad_row(DipTexture *texture, int level, int y);

// Linear light 0..1 to a packed texel, rounded.
uint32_t dip_texel_pack(const double rgb_lin[3]);

#endif
