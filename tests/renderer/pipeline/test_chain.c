// Compares mip chains (all levels of textures) with their definition, which this file computes one
// texel at a time. All bits must be equal for every size, address mode and number of threads.
#include "renderer/base/pool.h"
#include "renderer/base/srgb.h"
#include "renderer/pipeline/bc1.h"
#include "renderer/pipeline/texture/texture_layout.h"
#include "renderer/catalogue/random.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

typedef struct Plain {
    int width;
    int height;
    float *texels; // r, g, b, a
} Plain;

static Plain allocate(int width, int height) {
    Plain level = {width, height, malloc((size_t)width * (size_t)height * 4 * sizeof(float))};
    assert_non_null(level.texels);
    return level;
}

static Plain decode(const DipTextureDef *def) {
    Plain level = allocate(def->width, def->height);
    for (int i = 0; i < 4 * def->width * def->height; i++) {
        const double encoded = def->rgba8[i] / 255.0;
        const bool linear = def->encoding == DIP_ENCODING_LINEAR || i % 4 == 3;
        level.texels[i] = (float)(linear ? encoded : dip_srgb_decode(encoded));
    }
    return level;
}

// Along one axis, target texel i covers one to three source texels, starting with source texel 2i.
// Stores the weight of each source texel in `share` and returns their number.
static int shares(int i, int size, int next, float share[3]) {
    if (size == next) {
        share[0] = 1.0f;
        return 1;
    }
    if (size == 2 * next) {
        share[0] = share[1] = 0.5f;
        return 2;
    }
    share[0] = (float)((next - i) / (double)size);
    share[1] = (float)(next / (double)size);
    share[2] = (float)((i + 1) / (double)size);
    return 3;
}

static Plain halve(const Plain *from) {
    Plain to =
        allocate(from->width > 1 ? from->width / 2 : 1, from->height > 1 ? from->height / 2 : 1);
    for (int i = 0; i < 4 * to.width * to.height; i++) {
        const int x = i / 4 % to.width;
        const int y = i / 4 / to.width;
        float across[3];
        float down[3];
        const int columns = shares(x, from->width, to.width, across);
        const int rows = shares(y, from->height, to.height, down);
        const int left = columns == 1 ? x : 2 * x;
        const int top = rows == 1 ? y : 2 * y;
        float sum = 0.0f;
        for (int j = 0; j < rows; j++) {
            for (int k = 0; k < columns; k++) {
                sum += down[j] * across[k] *
                       from->texels[4 * ((top + j) * from->width + left + k) + i % 4];
            }
        }
        to.texels[i] = sum;
    }
    return to;
}

static bool is_here(const DipTexture *texture, int at, uint32_t colour, uint8_t alpha) {
    return texture->texels[at].here == colour &&
           (!texture->alpha || texture->alpha[at].here == alpha);
}

static bool is_below(const DipTexture *texture, int at, uint32_t colour, uint8_t alpha) {
    return texture->texels[at].below == colour &&
           (!texture->alpha || texture->alpha[at].below == alpha);
}

// Every texel except those of the padding row is stored itself, and every texel except those of the
// first row is stored below its upper neighbour.
static void check_level(const DipTexture *texture, int level, const Plain *plain) {
    assert_int_equal(texture->level_width[level], plain->width);
    assert_int_equal(texture->level_height[level], plain->height);
    for (int y = 0; y <= plain->height; y++) {
        for (int x = 0; x <= plain->width; x++) {
            const int from_x = x < plain->width                     ? x
                               : texture->wrap_u == DIP_WRAP_REPEAT ? 0
                                                                    : plain->width - 1;
            const int from_y = y < plain->height                    ? y
                               : texture->wrap_v == DIP_WRAP_REPEAT ? 0
                                                                    : plain->height - 1;
            const float *texel = plain->texels + 4 * (from_y * plain->width + from_x);
            const double rgb[3] = {texel[0], texel[1], texel[2]};
            const int at = texture->level_offset[level] + y * (plain->width + 1) + x;
            const uint32_t colour = dip_texel_pack(rgb);
            const uint8_t alpha = (uint8_t)(texel[3] * 255.0f + 0.5f);
            if ((y < plain->height && !is_here(texture, at, colour, alpha)) ||
                (y > 0 && !is_below(texture, at - (plain->width + 1), colour, alpha))) {
                fail_msg("level %d differs from the definition at texel (%d, %d)", level, x, y);
            }
        }
    }
}

static void check_chain(const DipTexture *texture, const DipTextureDef *def) {
    Plain level = decode(def);
    for (int i = 0; i < texture->level_count; i++) {
        check_level(texture, i, &level);
        Plain next = halve(&level);
        free(level.texels);
        level = next;
    }
    assert_int_equal(texture->level_width[texture->level_count - 1], 1);
    assert_int_equal(texture->level_height[texture->level_count - 1], 1);
    free(level.texels);
}

static const int sizes[][2] = {{1, 1},   {2, 1},     {1, 7},     {5, 3},    {8, 8},
                               {33, 64}, {127, 255}, {300, 301}, {512, 256}};
enum { COUNT = sizeof sizes / sizeof *sizes };

static uint8_t *noise(int width, int height, bool opaque) {
    uint8_t *codes = malloc((size_t)width * (size_t)height * 4);
    Random random = {(uint64_t)(width * 1000 + height)};
    for (int i = 0; codes && i < 4 * width * height; i++) {
        codes[i] = opaque && i % 4 == 3 ? 255 : (uint8_t)random_u64(&random);
    }
    assert_non_null(codes);
    return codes;
}

static void check_all(DipPool *pool) {
    DipTextureDef defs[COUNT];
    bool used[COUNT];
    DipTexture *textures[COUNT];
    for (int i = 0; i < COUNT; i++) {
        defs[i] = (DipTextureDef){.name = "noise",
                                  .width = sizes[i][0],
                                  .height = sizes[i][1],
                                  .rgba8 = noise(sizes[i][0], sizes[i][1], i % 3 == 0),
                                  .encoding = i % 2 ? DIP_ENCODING_LINEAR : DIP_ENCODING_SRGB,
                                  .wrap_u = i % 2 ? DIP_WRAP_CLAMP : DIP_WRAP_REPEAT,
                                  .wrap_v = i % 4 < 2 ? DIP_WRAP_CLAMP : DIP_WRAP_REPEAT};
        used[i] = i != 4;
    }
    assert_true(dip_textures_create(defs, used, NULL, COUNT, pool, textures, NULL));
    for (int i = 0; i < COUNT; i++) {
        assert_int_equal(textures[i] != NULL, used[i]);
        if (textures[i]) {
            assert_int_equal(textures[i]->alpha == NULL, i % 3 == 0);
            check_chain(textures[i], &defs[i]);
        }
        dip_texture_destroy(&textures[i]);
        free((void *)defs[i].rgba8);
    }
}

static void chains_are_exact_on_one_thread(void **state) {
    (void)state;
    check_all(NULL);
}

static void chains_are_exact_on_many_threads(void **state) {
    (void)state;
    for (int threads = 1; threads <= 4; threads++) {
        DipPool *pool = dip_pool_create(threads, NULL);
        check_all(pool);
        dip_pool_destroy(&pool);
    }
}

// Among several textures, one has an invalid size. The error must name this texture, and no texture
// may be created.
static void one_bad_texture_prevents_the_creation_of_all(void **state) {
    (void)state;
    const uint8_t codes[4 * 4] = {0};
    const DipTextureDef defs[] = {{.name = "a", .width = 2, .height = 2, .rgba8 = codes},
                                  {.name = "b", .width = 2, .height = 0, .rgba8 = codes},
                                  {.name = "c", .width = 2, .height = 2, .rgba8 = codes}};
    DipTexture *textures[3];
    DipError err = {0};
    assert_false(dip_textures_create(defs, NULL, NULL, 3, NULL, textures, &err));
    assert_int_equal(err.code, DIP_ERROR_RANGE);
    assert_string_equal(err.file, "b");
    for (int i = 0; i < 3; i++) {
        assert_null(textures[i]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(chains_are_exact_on_one_thread),
        cmocka_unit_test(chains_are_exact_on_many_threads),
        cmocka_unit_test(one_bad_texture_prevents_the_creation_of_all),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
