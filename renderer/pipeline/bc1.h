// BC1: 4x4 colours in 8 bytes, what opt=standard and opt=advanced show. docs/picture.md, Textures.
//
// A block is two colours of 5, 6 and 5 bits, least byte first, and two bits per texel, which choose
// one of them or one that lies between.
#ifndef DIP_RENDERER_PIPELINE_TEXTURE_BC1_H
#define DIP_RENDERER_PIPELINE_TEXTURE_BC1_H

#include "renderer/base/api.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { DIP_BC1_SIDE = 4, DIP_BC1_BYTES = 8 };

// rgba8: 4x4 sRGB codes, row-major, alpha ignored. The same bytes on every machine.
DIP_API void dip_bc1_encode(const uint8_t rgba8[64], uint8_t block[DIP_BC1_BYTES]);

// Packs linear light, 0..1, as textures store it: 32 bits of square roots, rounded (the layout is
// in texture/texture_layout.h).
DIP_API uint32_t dip_texel_pack(const double rgb_lin[3]);

// The sRGB codes nearest to what a packed texel (texture.h) holds: what the encoder is given.
typedef struct DipRootCodes {
    uint8_t of16[65536]; // red and green
    uint8_t of10[1024];  // blue
} DipRootCodes;

DIP_API void dip_root_codes_fill(DipRootCodes *codes);

static inline void dip_root_codes_read(const DipRootCodes *codes, uint32_t texel, uint8_t rgb8[3]) {
    rgb8[0] = codes->of16[texel >> 16];
    rgb8[1] = codes->of16[texel & 0xffff];
    rgb8[2] = codes->of10[(texel >> 16 & 31) << 5 | (texel & 31)];
}

// Linear light of a block's colours. All of them are sums of sixths of the two it names: of 6 * 31
// steps for red and blue, of 6 * 63 for green.
typedef struct DipBc1Light {
    double of5[6 * 31 + 1];
    double of6[6 * 63 + 1];
} DipBc1Light;

DIP_API void dip_bc1_light_fill(DipBc1Light *light);

// The four packed texels that a block chooses from.
DIP_API void dip_bc1_palette(const DipBc1Light *light, const uint8_t block[DIP_BC1_BYTES],
                             uint32_t texels[4]);

// Which of them texel i = 4 y + x shows.
static inline int dip_bc1_choice(const uint8_t block[DIP_BC1_BYTES], int i) {
    return block[4 + (i >> 2)] >> 2 * (i & 3) & 3;
}

#ifdef __cplusplus
}
#endif

#endif
