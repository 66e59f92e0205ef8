// BC1 (S3TC): 4x4 colours in 8 bytes. docs/picture.md defines the blocks (Textures, Texture
// optimisation).
//
// A block stores two colours with 5 bits of red, 6 of green and 5 of blue, low byte first, and two
// bits per texel. These bits choose one of four colours: the two that are stored and two that are
// computed from the stored ones. All functions are thread-safe.
#ifndef DIP_RENDERER_PIPELINE_BC1_H
#define DIP_RENDERER_PIPELINE_BC1_H

#include "renderer/base/api.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Number of texels along a side of a block, and number of bytes of a block.
enum { DIP_BC1_SIDE = 4, DIP_BC1_BYTES = 8 };

// Encodes 4x4 texels of 8-bit sRGB values, row-major. Their alpha is ignored. The block has the
// same bytes on every machine.
DIP_API void dip_bc1_encode(const uint8_t rgba8[64], uint8_t block[DIP_BC1_BYTES]);

// Packs a colour in linear light, clamped to 0..1, into the 32 bits of a texel: the rounded square
// roots of red, green and blue. texture/texture_layout.h describes the layout.
DIP_API uint32_t dip_texel_pack(const double rgb_lin[3]);

// Tables that convert the parts of a packed texel to the nearest 8-bit sRGB values (codes), which
// the encoder takes.
typedef struct DipRootCodes {
    uint8_t of16[65536]; // index: the 16-bit square root of red or green
    uint8_t of10[1024];  // index: the 10-bit square root of blue
} DipRootCodes;

// Fills in the tables.
DIP_API void dip_root_codes_fill(DipRootCodes *codes);

// Returns the sRGB codes nearest to a packed texel's colour.
static inline void dip_root_codes_read(const DipRootCodes *codes, uint32_t texel, uint8_t rgb8[3]) {
    rgb8[0] = codes->of16[texel >> 16];
    rgb8[1] = codes->of16[texel & 0xffff];
    rgb8[2] = codes->of10[(texel >> 16 & 31) << 5 | (texel & 31)];
}

// Tables of linear light for the channels of a block's colours. Each of the four colours is s / 6
// of one stored colour plus (6 - s) / 6 of the other. A channel with 5 bits (red, blue) is
// therefore a multiple of 1/(6*31), and a channel with 6 bits (green) is a multiple of 1/(6*63).
// of5[i] is the linear light of the sRGB value i / (6 * 31), and of6[i] is the linear light of the
// sRGB value i / (6 * 63).
typedef struct DipBc1Light {
    double of5[6 * 31 + 1];
    double of6[6 * 63 + 1];
} DipBc1Light;

// Fills in the tables.
DIP_API void dip_bc1_light_fill(DipBc1Light *light);

// Computes the four colours that a block's texels choose from, as packed texels.
DIP_API void dip_bc1_palette(const DipBc1Light *light, const uint8_t block[DIP_BC1_BYTES],
                             uint32_t texels[4]);

// Returns the index, 0..3, of the colour that texel i = 4 y + x of the block has.
static inline int dip_bc1_choice(const uint8_t block[DIP_BC1_BYTES], int i) {
    return block[4 + (i >> 2)] >> 2 * (i & 3) & 3;
}

#ifdef __cplusplus
}
#endif

#endif
