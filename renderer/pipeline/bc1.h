// BC1 (S3TC): 4x4 colours in 8 bytes. docs/picture.md defines the blocks (Textures, Texture
// optimisation).
//
// A block stores two colours with 5 bits of red, 6 of green and 5 of blue, low byte first, and two
// bits per texel. These bits choose one of the two colours or one of two more that are computed
// from them. All functions are thread-safe.
#ifndef DIP_RENDERER_PIPELINE_BC1_H
#define DIP_RENDERER_PIPELINE_BC1_H

#include "renderer/base/api.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Texels per side of a block, and bytes of a block.
enum { DIP_BC1_SIDE = 4, DIP_BC1_BYTES = 8 };

// Encodes 4x4 sRGB codes, row-major; alpha is ignored. The block has the same bytes on every
// machine.
DIP_API void dip_bc1_encode(const uint8_t rgba8[64], uint8_t block[DIP_BC1_BYTES]);

// Packs a colour in linear light, clamped to 0..1, as textures store it: 32 bits of rounded square
// roots. texture/texture_layout.h describes the layout.
DIP_API uint32_t dip_texel_pack(const double rgb_lin[3]);

// Tables from the parts of a packed texel to the nearest sRGB codes, which the encoder takes.
typedef struct DipRootCodes {
    uint8_t of16[65536]; // by the 16-bit square root of red or green
    uint8_t of10[1024];  // by the 10-bit square root of blue
} DipRootCodes;

// Fills in the tables.
DIP_API void dip_root_codes_fill(DipRootCodes *codes);

// Returns the sRGB codes nearest to a packed texel's colour.
static inline void dip_root_codes_read(const DipRootCodes *codes, uint32_t texel, uint8_t rgb8[3]) {
    rgb8[0] = codes->of16[texel >> 16];
    rgb8[1] = codes->of16[texel & 0xffff];
    rgb8[2] = codes->of10[(texel >> 16 & 31) << 5 | (texel & 31)];
}

// Linear light of the channels of a block's colours. Each colour is a sum of sixths of the two that
// the block stores, so a channel of 5 bits (red, blue) is a multiple of 1/(6 * 31) and one of 6
// bits (green) a multiple of 1/(6 * 63). of5[i] is the linear light of the sRGB value i / (6 * 31),
// of6[i] that of i / (6 * 63).
typedef struct DipBc1Light {
    double of5[6 * 31 + 1];
    double of6[6 * 63 + 1];
} DipBc1Light;

// Fills in the tables.
DIP_API void dip_bc1_light_fill(DipBc1Light *light);

// Returns the four packed texels that a block's texels choose from.
DIP_API void dip_bc1_palette(const DipBc1Light *light, const uint8_t block[DIP_BC1_BYTES],
                             uint32_t texels[4]);

// Returns which of these four, 0..3, texel i = 4 y + x shows.
static inline int dip_bc1_choice(const uint8_t block[DIP_BC1_BYTES], int i) {
    return block[4 + (i >> 2)] >> 2 * (i & 3) & 3;
}

#ifdef __cplusplus
}
#endif

#endif
