// Encodes the BC1 blocks of every mip level, and decodes their colours as BC1 is defined.
#include "renderer/reference/internal/differences.h"
#include "renderer/reference/internal/texture.h"

#include "renderer/pipeline/bc1.h"

#include <stdlib.h>

static size_t blocks_across(int size) {
    return (size_t)(size + 3) / 4;
}

// Encodes the block at texel (x, y). The encoder's input is rounded in the same way as the fast
// renderer's texels, because a difference of 1 in a rounded value may produce another block.
// Colours that are read from the block are not rounded.
static void encode_block(const DipRefTexture *texture, int level, int x, int y,
                         const DipRootCodes *codes, uint8_t *block) {
    uint8_t rgba8[64];
    for (int i = 0; i < 16; i++) {
        const int column = x + i % 4;
        const int row = y + i / 4;
        double rgba[4];
        dip_reference_texel(
            texture, level, column < texture->widths[level] ? column : texture->widths[level] - 1,
            row < texture->heights[level] ? row : texture->heights[level] - 1, rgba);
        dip_root_codes_read(codes, dip_texel_pack(rgba), rgba8 + 4 * i);
        rgba8[4 * i + 3] = 255;
    }
    dip_bc1_encode(rgba8, block);
}

static bool encode_level(DipRefTexture *texture, int level, const DipRootCodes *codes) {
    const size_t across = blocks_across(texture->widths[level]);
    const size_t down = blocks_across(texture->heights[level]);
    texture->blocks[level] = malloc(across * down * DIP_BC1_BYTES);
    for (size_t b = 0; texture->blocks[level] && b < across * down; b++) {
        encode_block(texture, level, (int)(4 * (b % across)), (int)(4 * (b / across)), codes,
                     texture->blocks[level] + b * DIP_BC1_BYTES);
    }
    return texture->blocks[level] != NULL;
}

bool dip_reference_texture_compress(DipRefTexture *texture, DipError *err) {
    DipRootCodes *codes = malloc(sizeof *codes);
    bool made = codes != NULL;
    if (made) {
        dip_root_codes_fill(codes);
    }
    for (int level = 0; made && level < texture->level_count; level++) {
        made = encode_level(texture, level, codes);
    }
    free(codes);
    return made || dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, texture->def->name,
                                 "no memory for its blocks");
}

// Converts a colour of 5, 6 and 5 bits to sRGB, 0..1.
static void unpack(unsigned colour, double srgb[3]) {
    srgb[0] = (colour >> 11) / 31.0;
    srgb[1] = (colour >> 5 & 63) / 63.0;
    srgb[2] = (colour & 31) / 31.0;
}

void dip_reference_block_colour(const uint8_t block[8], int x, int y, double rgb[3]) {
    const unsigned first = block[0] + 256u * block[1];
    const unsigned second = block[2] + 256u * block[3];
    const int choice = block[4 + y] >> 2 * x & 3;
    double a[3], b[3];
    unpack(first, a);
    unpack(second, b);
    for (int c = 0; c < 3; c++) {
        double srgb = choice == 0 ? a[c] : b[c];
        if (choice == 2) {
            srgb = first > second ? (2.0 * a[c] + b[c]) / 3.0 : (a[c] + b[c]) / 2.0;
        } else if (choice == 3) {
            srgb = first > second ? (a[c] + 2.0 * b[c]) / 3.0 : 0.0;
        }
        rgb[c] = dip_reference_decode_srgb(srgb);
    }
}

void dip_reference_compressed_texel(const DipRefTexture *texture, int level, int x, int y,
                                    double rgba[4]) {
    const size_t across = blocks_across(texture->widths[level]);
    const size_t index = (size_t)(y / 4) * across + (size_t)(x / 4);
    dip_reference_texel(texture, level, x, y, rgba); // keeps the texture's own alpha
    dip_reference_block_colour(texture->blocks[level] + index * DIP_BC1_BYTES, x % 4, y % 4, rgba);
    if (texture->rounded) {
        dip_reference_round_colour(rgba);
    }
}
