// Textures as the fast path stores them: mip chains in linear light, packed for filtering.
//
// A texel has 32 bits, which hold square roots of linear light. The upper 16 bits are red and the
// lower 16 green, but the five lowest bits of each half belong to blue, which has ten: the higher
// five stand in red's half, the lower five in green's. The filter reads a half as it is, with
// blue's bits in it. Red and green are rounded with that in mind, so each half is within 16 of its
// 16-bit code. The square root distributes the codes about as the eye does. The error is below 0.06
// sRGB codes (0.12 for blue; 0.11 for full red or green without blue). Alpha is a separate plane of
// bytes, kept only if some texel is not opaque.
//
// Every level has one column and one row more than its size. They repeat the first ones
// (DIP_WRAP_REPEAT) or the last ones (DIP_WRAP_CLAMP), so the four texels of a bilinear read are
// always at offset, offset + 1, offset + stride and offset + stride + 1.
#ifndef DIP_RENDERER_PIPELINE_TEXTURE_TEXTURE_LAYOUT_H
#define DIP_RENDERER_PIPELINE_TEXTURE_TEXTURE_LAYOUT_H

#include "renderer/pipeline/texture.h"

#include <stdint.h>

// The mask of blue's two parts, and the factors by which vu_dot16 makes one 16-bit code of them.
#define DIP_TEXEL_BLUE         0x001f001fu
#define DIP_TEXEL_BLUE_FACTORS 0x08000040u

struct DipTexture {
    int width; // width of level 0, in texels
    int height;
    int level_count;
    DipWrap wrap_u;
    DipWrap wrap_v;
    int32_t level_offset[DIP_LEVEL_TABLE]; // index of the level's first texel
    int32_t level_width[DIP_LEVEL_TABLE];  // texels; a row is one texel longer, see above
    int32_t level_height[DIP_LEVEL_TABLE];
    // True if both axes repeat and the sizes of every level are powers of two. Coordinates can then
    // be fractions of 32 bits, which wrap by overflow.
    bool wraps_in_bits;
    int32_t level_log2_width[DIP_LEVEL_TABLE];
    int32_t level_log2_height[DIP_LEVEL_TABLE];
    uint32_t *texels;
    // Same layout as texels. NULL if all texels are opaque or the texture was made without alpha.
    uint8_t *alpha;
    bool shares_alpha;  // the alpha plane belongs to the texture that this one was made from
    size_t texel_count; // number of texels of all levels, padding included
};

// Fills in the padding that repeats texels of row y of a level. The row's own texels must have been
// written.
void dip_texture_pad_row(DipTexture *texture, int level, int y);

#endif
