// Textures as the fast path stores them: mip chains in linear light, packed for filtering.
//
// A texel is 32 bits: square roots of linear light. The upper half is red in 16 bits, the lower
// half green, but their five lowest bits are blue's ten, the higher five with red; red and green
// are rounded with blue's bits in position, so that they are read as they are, within 16. The
// square root spreads the codes as the eye does; the error is below 0.06 sRGB codes (blue 0.12;
// 0.11 for full red or green without blue). Alpha is a separate plane of bytes, kept only when some
// texel is not opaque.
//
// Every level has one column and one row more than its size, which repeat the first (DIP_WRAP_
// REPEAT) or the last (DIP_WRAP_CLAMP), so the four texels of a bilinear read are always at
// offset, +1, +stride, +stride+1.
#ifndef DIP_RENDERER_PIPELINE_TEXTURE_TEXTURE_LAYOUT_H
#define DIP_RENDERER_PIPELINE_TEXTURE_TEXTURE_LAYOUT_H

#include "renderer/pipeline/texture.h"

#include <stdint.h>

// Mask of blue's bits, and what its parts are multiplied by to make a number of 16 bits.
#define DIP_TEXEL_BLUE        0x001f001fu
#define DIP_TEXEL_BLUE_PLACES 0x08000040u

struct DipTexture {
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
};

// Fills in the padding that repeats texels of a level's row; the row is complete.
void dip_texture_pad_row(DipTexture *texture, int level, int y);

#endif
