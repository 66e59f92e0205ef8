// Decodes blocks of BC1, BC2 and BC3 (DXT1, DXT3, DXT5) to 8-bit texels.
//
// Colours and alphas between the stored ones are the nearest 8-bit values to the exact fractions
// that the formats define (Direct3D 11.3 functional specification, section 19.5). Many decoders
// round the stored colours first and cut off fractions, so they differ by up to two codes.
#include "assets/picture/picture_private.h"

#include <string.h>

// The colours that a block's texels choose from.
typedef struct Palette {
    uint8_t rgba8[4][4];
} Palette;

// Returns the nearest 8-bit value to (s * a + (6 - s) * b) / 6, where a and b are fractions of max.
static uint8_t mix(int a, int b, int s, int max) {
    return (uint8_t)((255 * (s * a + (6 - s) * b) + 3 * max) / (6 * max));
}

// four: the block has four colours whatever the order of the stored ones is, as in BC2 and BC3.
// Otherwise a block whose first number is not the greater one has three colours and clear black.
static Palette palette_of(const uint8_t *block, bool four) {
    static const int shares[2][4] = {{6, 0, 3, 0}, {6, 0, 4, 2}}; // sixths of the first colour
    const int a = block[0] | block[1] << 8;
    const int b = block[2] | block[3] << 8;
    four = four || a > b;
    Palette palette = {{{0}}};
    for (int i = 0; i < (four ? 4 : 3); ++i) {
        uint8_t *to = palette.rgba8[i];
        const int s = shares[four][i];
        to[0] = mix(a >> 11, b >> 11, s, 31);
        to[1] = mix(a >> 5 & 63, b >> 5 & 63, s, 63);
        to[2] = mix(a & 31, b & 31, s, 31);
        to[3] = 255;
    }
    return palette;
}

static void decode_colours(const uint8_t *block, bool four, uint8_t rgba8[64]) {
    const Palette palette = palette_of(block, four);
    for (int i = 0; i < 16; ++i) {
        const int choice = block[4 + i / 4] >> 2 * (i % 4) & 3;
        memcpy(rgba8 + 4 * i, palette.rgba8[choice], 4);
    }
}

void dip_picture_decode_bc1(const uint8_t *block, uint8_t rgba8[64]) {
    decode_colours(block, false, rgba8);
}

void dip_picture_decode_bc2(const uint8_t *block, uint8_t rgba8[64]) {
    decode_colours(block + 8, true, rgba8);
    for (int i = 0; i < 16; ++i) {
        const int alpha = block[i / 2] >> 4 * (i % 2) & 15;
        rgba8[4 * i + 3] = (uint8_t)(17 * alpha);
    }
}

// Fills the eight alphas of a BC3 block: two that are stored, and six between them, or four between
// them and both ends of the range.
static void alphas_of(int a, int b, uint8_t alphas[8]) {
    const int steps = a > b ? 7 : 5;
    alphas[0] = (uint8_t)a;
    alphas[1] = (uint8_t)b;
    for (int i = 1; i < steps; ++i) {
        alphas[i + 1] = (uint8_t)(((steps - i) * a + i * b + steps / 2) / steps);
    }
    if (steps == 5) {
        alphas[6] = 0;
        alphas[7] = 255;
    }
}

void dip_picture_decode_bc3(const uint8_t *block, uint8_t rgba8[64]) {
    uint8_t alphas[8];
    uint64_t choices = 0;
    alphas_of(block[0], block[1], alphas);
    for (int i = 0; i < 6; ++i) {
        choices |= (uint64_t)block[2 + i] << 8 * i;
    }
    decode_colours(block + 8, true, rgba8);
    for (int i = 0; i < 16; ++i) {
        rgba8[4 * i + 3] = alphas[choices >> 3 * i & 7];
    }
}
