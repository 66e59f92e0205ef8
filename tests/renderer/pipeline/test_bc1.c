// Compares decoded BC1 blocks (compressed 4x4 texels) with the published definition, which this
// file computes in whole numbers. Also compares compressed textures with their decoded blocks.
#include "renderer/base/srgb.h"
#include "renderer/pipeline/bc1.h"
#include "renderer/pipeline/texture/texture_layout.h"
#include "renderer/reference/internal/texture.h"
#include "renderer/catalogue/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// The greatest rounding error of a packed texel, as an sRGB value 0..1. Blue has this error,
// because it has the fewest bits (ten): half a step where the sRGB curve is steepest.
static const double texel_tolerance_srgb = 0.19 / 255.0;

static void light_of_texel(uint32_t texel, double rgb[3]) {
    const double roots[3] = {(texel >> 16) / 65535.0, (texel & 0xffff) / 65535.0,
                             ((texel >> 16 & 31) << 5 | (texel & 31)) / 1023.0};
    for (int c = 0; c < 3; c++) {
        rgb[c] = roots[c] * roots[c];
    }
}

static void expect_srgb(const double rgb_lin[3], const double srgb[3], double tolerance) {
    for (int c = 0; c < 3; c++) {
        assert_true(fabs(dip_reference_encode_srgb(rgb_lin[c]) - srgb[c]) <= tolerance);
    }
}

// Checks that both decoders decode texel (x, y) of a block to srgb.
static void expect_texel(const DipBc1Light *light, const uint8_t block[8], int x, int y,
                         const double srgb[3]) {
    double rgb[3];
    uint32_t palette[4];
    dip_reference_block_colour(block, x, y, rgb);
    expect_srgb(rgb, srgb, 1e-9);
    dip_bc1_palette(light, block, palette);
    light_of_texel(palette[dip_bc1_choice(block, 4 * y + x)], rgb);
    expect_srgb(rgb, srgb, texel_tolerance_srgb);
}

// The parts of a block: two colours, each with 5 bits of red, 6 of green and 5 of blue, and a code
// of 2 bits for each texel.
typedef struct Parts {
    int colour[2][3];
    int code[16];
} Parts;

static Parts random_parts(Random *random, bool alike) {
    Parts parts;
    for (int c = 0; c < 3; c++) {
        const int last = c == 1 ? 63 : 31;
        parts.colour[0][c] = random_int(random, 0, last);
        parts.colour[1][c] = alike ? parts.colour[0][c] : random_int(random, 0, last);
    }
    for (int i = 0; i < 16; i++) {
        parts.code[i] = random_int(random, 0, 3);
    }
    return parts;
}

// Packs the parts into bytes. Returns true if the first colour is the greater number.
static bool pack_parts(const Parts *parts, uint8_t block[8]) {
    int number[2];
    for (int i = 0; i < 2; i++) {
        const int *colour = parts->colour[i];
        number[i] = colour[0] * 2048 + colour[1] * 32 + colour[2];
        block[2 * i] = (uint8_t)(number[i] % 256);
        block[2 * i + 1] = (uint8_t)(number[i] / 256);
    }
    for (int y = 0; y < 4; y++) {
        const int *code = parts->code + 4 * y;
        block[4 + y] = (uint8_t)(code[0] + 4 * code[1] + 16 * code[2] + 64 * code[3]);
    }
    return number[0] > number[1];
}

// S3TC's definition: colours are little-endian, with red in the highest bits. If the first colour
// is the greater number, codes 0 to 3 stand for the first colour, the second, 2/3 of the first plus
// 1/3 of the second, and 1/3 of the first plus 2/3 of the second. Otherwise they stand for the
// first colour, the second, their mean, and black.
static void decoders_follow_the_definition(void **state) {
    (void)state;
    static const double shares[2][4][2] = {
        {{1.0, 0.0}, {0.0, 1.0}, {0.5, 0.5}, {0.0, 0.0}},
        {{1.0, 0.0}, {0.0, 1.0}, {2 / 3.0, 1 / 3.0}, {1 / 3.0, 2 / 3.0}}};
    static DipBc1Light light;
    dip_bc1_light_fill(&light);
    Random random = {1};
    for (int n = 0; n < 2000; n++) {
        const Parts parts = random_parts(&random, n % 10 == 0);
        uint8_t block[8];
        const bool greater = pack_parts(&parts, block);
        for (int i = 0; i < 16; i++) {
            const double *share = shares[greater][parts.code[i]];
            double srgb[3];
            for (int c = 0; c < 3; c++) {
                srgb[c] = (share[0] * parts.colour[0][c] + share[1] * parts.colour[1][c]) /
                          (c == 1 ? 63.0 : 31.0);
            }
            expect_texel(&light, block, i % 4, i / 4, srgb);
        }
    }
}

// A packed texel is precise enough: 8-bit values stay the same when packed and unpacked.
static void packed_texels_keep_8_bit_values(void **state) {
    (void)state;
    static DipRootCodes codes;
    dip_root_codes_fill(&codes);
    for (int i = 0; i < 65536; i++) {
        const int mix = i * 37; // so every red value meets every blue value
        const uint8_t rgb8[3] = {(uint8_t)i, (uint8_t)(i >> 8), (uint8_t)(mix >> 4)};
        double light[3];
        uint8_t back[3];
        for (int c = 0; c < 3; c++) {
            light[c] = dip_srgb_decode(rgb8[c] / 255.0);
        }
        dip_root_codes_read(&codes, dip_texel_pack(light), back);
        assert_memory_equal(back, rgb8, 3);
    }
}

// Colours that a block can represent stay the same when they are encoded and decoded. The error of
// a gradient stays below one step of 5 bits.
static void the_encoder_keeps_colours_that_a_block_can_hold(void **state) {
    (void)state;
    uint8_t rgba8[64];
    uint8_t block[8];
    for (int i = 0; i < 16; i++) {
        const uint8_t texel[4] = {i & 1 ? 255 : 0, i & 1 ? 255 : 0, i & 1 ? 0 : 255, 255};
        memcpy(rgba8 + 4 * i, texel, 4);
    }
    dip_bc1_encode(rgba8, block);
    for (int i = 0; i < 16; i++) {
        double rgb[3];
        dip_reference_block_colour(block, i % 4, i / 4, rgb);
        expect_srgb(rgb, (const double[]){i & 1, i & 1, !(i & 1)}, 1e-9);
    }
    for (int i = 0; i < 16; i++) {
        memset(rgba8 + 4 * i, 100 + 2 * i, 3);
    }
    dip_bc1_encode(rgba8, block);
    for (int i = 0; i < 16; i++) {
        double rgb[3];
        const double grey = (100 + 2 * i) / 255.0;
        dip_reference_block_colour(block, i % 4, i / 4, rgb);
        expect_srgb(rgb, (const double[]){grey, grey, grey}, 1.0 / 31.0);
    }
}

static void expect_level(const DipTexture *compressed, const DipRefTexture *reference, int level) {
    const int columns = compressed->level_width[level];
    const int rows = compressed->level_height[level];
    const DipTexelPair *texels = compressed->texels + compressed->level_offset[level];
    const int after_last = compressed->wrap_u == DIP_WRAP_CLAMP ? columns - 1 : 0;
    for (int y = 0; y <= rows; y++) {
        for (int x = 0; x <= columns; x++) {
            double expected[4], found[3], srgb[3];
            dip_reference_compressed_texel(reference, level, x < columns ? x : after_last,
                                           y < rows ? y : 0, expected);
            for (int c = 0; c < 3; c++) {
                srgb[c] = dip_reference_encode_srgb(expected[c]);
            }
            const DipTexelPair *texel = texels + y * (columns + 1) + x;
            if (y < rows) {
                light_of_texel(texel->here, found);
                expect_srgb(found, srgb, texel_tolerance_srgb);
            }
            if (y > 0) {
                light_of_texel((texel - (columns + 1))->below, found);
                expect_srgb(found, srgb, texel_tolerance_srgb);
            }
        }
    }
}

static void expect_texture(const DipTextureDef *def, DipPool *pool) {
    DipTexture *texture = dip_texture_create(def, NULL);
    DipTexture *compressed = NULL;
    DipRefTexture reference;
    const bool wanted = true;
    assert_true(dip_textures_compress(&texture, &wanted, 1, pool, &compressed, NULL));
    assert_true(dip_reference_texture_init(&reference, def, DIP_REF_MAX_LEVELS, NULL));
    assert_true(dip_reference_texture_compress(&reference, NULL));
    assert_ptr_equal(compressed->alpha, texture->alpha);
    for (int level = 0; level < texture->level_count; level++) {
        expect_level(compressed, &reference, level);
    }
    dip_reference_texture_free(&reference);
    dip_texture_destroy(&compressed);
    dip_texture_destroy(&texture);
}

// Compares every texel of every level, including padding and alpha. Some sizes are not multiples of
// 4. Textures are compressed both with and without a pool.
static void compressed_textures_equal_their_decoded_blocks(void **state) {
    (void)state;
    static const int sizes[][2] = {{64, 64}, {1, 1}, {7, 5}, {2, 9}, {33, 16}};
    static uint8_t rgba8[64 * 64 * 4];
    Random random = {2};
    for (size_t i = 0; i < sizeof rgba8; i++) {
        rgba8[i] = (uint8_t)random_int(&random, 0, 255);
    }
    DipPool *pool = dip_pool_create(2, NULL);
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        const DipTextureDef def = {.name = "noise",
                                   .width = sizes[s][0],
                                   .height = sizes[s][1],
                                   .rgba8 = rgba8,
                                   .wrap_u = s & 1 ? DIP_WRAP_CLAMP : DIP_WRAP_REPEAT};
        expect_texture(&def, s & 1 ? NULL : pool);
    }
    dip_pool_destroy(&pool);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(decoders_follow_the_definition),
        cmocka_unit_test(packed_texels_keep_8_bit_values),
        cmocka_unit_test(the_encoder_keeps_colours_that_a_block_can_hold),
        cmocka_unit_test(compressed_textures_equal_their_decoded_blocks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
