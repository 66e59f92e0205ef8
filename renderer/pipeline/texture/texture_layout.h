// The layout of textures in memory: mip chains in linear light, packed for filtering.
//
// A texel has 32 bits, which hold the square roots of red, green and blue in linear light. The
// upper 16 bits are red and the lower 16 bits are green, but the five lowest bits of each half
// belong to blue. Blue has ten bits: the higher five are in red's half, the lower five in green's
// half. The filter reads a half as a 16-bit number, including blue's bits. The upper 11 bits of a
// half are rounded so that this number is within 16 of the channel's 16-bit root. Square roots
// distribute precision over dark and bright colours about as the eye does. The error is below 0.06
// of a step between 8-bit sRGB values (0.12 for blue; 0.11 for full red or green without blue).
// Alpha is a separate plane of bytes, which exists only if some texel is not opaque.
//
// Every level has one padding column and one padding row. The padding repeats the first column or
// row (DIP_WRAP_REPEAT) or the last one (other modes). If an axis has DIP_WRAP_BORDER, every level
// has one padding column before its first column, one padding row above its first row, and two of
// each behind the last one; along axes with DIP_WRAP_BORDER, the padding has the border's colour.
//
// Every texel is stored together with the texel below it. So the four texels of a bilinear read,
// its quad, are neighbours in memory: a pair and the next one, which one load of 16 bytes reads.
// This takes twice the bytes of plain rows. The last padding row has no texels below it and starts
// no read, so it is stored only as the lower half of the row above it.
#ifndef DIP_RENDERER_PIPELINE_TEXTURE_TEXTURE_LAYOUT_H
#define DIP_RENDERER_PIPELINE_TEXTURE_TEXTURE_LAYOUT_H

#include "renderer/pipeline/texture.h"

#include <stdint.h>

// The mask of blue's two parts, and the factors with which vu_dot16 joins the parts into one 16-bit
// root.
#define DIP_TEXEL_BLUE         0x001f001fu
#define DIP_TEXEL_BLUE_FACTORS 0x08000040u

// A texel's colour, and the colour of the texel below it.
typedef struct DipTexelPair {
    uint32_t here;
    uint32_t below;
} DipTexelPair;

// A texel's alpha, and the alpha of the texel below it.
typedef struct DipAlphaPair {
    uint8_t here;
    uint8_t below;
} DipAlphaPair;

struct DipTexture {
    int width; // width of level 0, in texels
    int height;
    int level_count;
    DipWrap wrap_u;
    DipWrap wrap_v;
    DipEncoding encoding; // of the codes that the texture was made from
    int32_t padding;      // number of padding columns, and of padding rows: 1, or 3 with a border
    // True if an axis mirrors or has a border. The kernels then use their general addresses.
    bool special_wrap;
    bool keeps_alpha;   // texels that are not opaque get an alpha plane
    bool stored_levels; // the levels are given pictures, not a filtered chain
    uint32_t border;    // colour of the border, packed
    uint8_t border_alpha;
    int32_t level_offset[DIP_LEVEL_TABLE]; // index of the level's texel (0, 0)
    int32_t level_width[DIP_LEVEL_TABLE];  // width in texels, without padding
    int32_t level_height[DIP_LEVEL_TABLE];
    // True if both axes repeat and the sizes of every level are powers of two. Coordinates can then
    // be 32-bit fixed-point fractions of the texture's size, which wrap by overflow.
    bool wraps_in_bits;
    int32_t level_log2_width[DIP_LEVEL_TABLE];
    int32_t level_log2_height[DIP_LEVEL_TABLE];
    // The pairs of all levels. Behind the last one stands a quad of zeroes, at texel_count.
    DipTexelPair *texels;
    // Alpha plane, with the same layout as the texels. NULL if all texels are opaque or the texture
    // was made without alpha.
    DipAlphaPair *alpha;
    bool shares_alpha;  // the alpha plane belongs to the texture that this one was made from
    size_t texel_count; // number of pairs of all levels, padding included
};

// Returns the distance from a texel of a level to the texel below it.
static inline size_t dip_texture_stride(const DipTexture *texture, int level) {
    return (size_t)(texture->level_width[level] + texture->padding);
}

// Sets the address modes of a texture that has no levels yet.
void dip_texture_set_wrap(DipTexture *texture, const DipTextureDef *def);

// Appends a level to the texture's tables.
void dip_texture_add_level(DipTexture *texture, int width, int height);

// Allocates the texels of all levels. Returns false if memory runs out.
bool dip_texture_allocate(DipTexture *texture);

// Allocates an alpha plane; the texture does not own it yet. Returns NULL if memory runs out.
DipAlphaPair *dip_texture_allocate_alpha(const DipTexture *texture);

// Completes row y of a level, whose own texels (`here`) the caller has written. Fills in the
// padding that repeats texels of the row, with row 0 also the rows of the border, and enters all
// these texels below the texels of the rows above them. Different threads may complete different
// rows at the same time.
void dip_texture_finish_row(DipTexture *texture, int level, int y);

// Returns whether some texel of a picture is not opaque.
bool dip_texture_has_alpha(const DipTextureDef *def);

// Makes the whole chain of an existing texture again, from a picture of the same size and encoding.
// Fails with MEMORY; the texture is then unchanged.
bool dip_texture_rebuild(DipTexture *texture, const DipTextureDef *def, DipPool *pool,
                         DipError *err);

#endif
