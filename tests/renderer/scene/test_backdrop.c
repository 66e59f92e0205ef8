// Tests the levels of what lies behind rough glass: each against means of the level before it in
// whole numbers, at sizes that halve evenly and at others, and against means of the pixels.
#include "renderer/base/pool.h"
#include "renderer/scene/draw/backdrop.h"
#include "tests/support/srgb.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const int sizes[][2] = {{64, 32}, {37, 23}, {1, 9}, {130, 1}, {1, 1}, {65, 129}};
enum { SIZES = sizeof sizes / sizeof *sizes };

static uint32_t next_random(uint32_t *state) {
    *state = *state * 1664525U + 1013904223U;
    return *state >> 8;
}

static void make(DipBackdropParts *backdrop, int width, int height) {
    DipError err = {0};
    uint32_t state = 1;
    assert_true(dip_backdrop_make(backdrop, width, height, &err));
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < 4 * width; x++) {
            backdrop->target.rgba8[(size_t)y * backdrop->target.stride_bytes + (size_t)x] =
                (uint8_t)next_random(&state);
        }
    }
}

static uint32_t channel_of(const DipBackdrop *levels, int level, int x, int y, int c) {
    const int32_t *texel =
        levels->texels + 2 * (levels->first[level] + y * levels->width[level] + x);
    return c == 2 ? (uint32_t)texel[1] : (uint32_t)texel[0] >> 16 * c & 65535U;
}

// Returns which part of a texel of `to` along an axis lies in texel i of `from`, in units that add
// up to `from`.
static int part_in(int from, int to, int texel, int i) {
    const int begin = texel * from > i * to ? texel * from : i * to;
    const int end = (texel + 1) * from < (i + 1) * to ? (texel + 1) * from : (i + 1) * to;
    return end > begin ? end - begin : 0;
}

static void check_texel(const DipBackdrop *levels, int level, int x, int y) {
    const int from[2] = {levels->width[level - 1], levels->height[level - 1]};
    const int to[2] = {levels->width[level], levels->height[level]};
    for (int c = 0; c < 3; c++) {
        uint64_t sum = 0;
        for (int j = 0; j < from[1]; j++) {
            for (int i = 0; i < from[0]; i++) {
                const int part = part_in(from[0], to[0], x, i) * part_in(from[1], to[1], y, j);
                sum += (uint64_t)part * (part ? channel_of(levels, level - 1, i, j, c) : 0);
            }
        }
        const double mean = (double)sum / ((double)from[0] * from[1]);
        assert_int_equal(channel_of(levels, level, x, y, c), (int)floor(mean + 0.5));
    }
}

static void check_level(const DipBackdrop *levels, int level) {
    for (int y = 0; y < levels->height[level]; y++) {
        for (int x = 0; x < levels->width[level]; x++) {
            check_texel(levels, level, x, y);
        }
    }
}

static void each_level_is_the_mean_of_the_one_before(void **state) {
    (void)state;
    for (int s = 0; s < SIZES; s++) {
        DipBackdropParts backdrop;
        make(&backdrop, sizes[s][0], sizes[s][1]);
        const DipTargetRegion whole = {0, 0, sizes[s][0], sizes[s][1]};
        const DipBackdrop *levels = &backdrop.levels;
        const uint64_t texels = dip_backdrop_fill(&backdrop, &whole, NULL);
        uint64_t expected = 0;
        for (int i = 0; i < levels->count; i++) {
            expected += (uint64_t)levels->width[i] * (uint64_t)levels->height[i];
        }
        assert_int_equal(texels, expected);
        assert_int_equal(levels->width[levels->count - 1], 1);
        assert_int_equal(levels->height[levels->count - 1], 1);
        for (int y = 0; y < sizes[s][1]; y++) {
            for (int x = 0; x < 3 * sizes[s][0]; x++) {
                const uint8_t *row =
                    backdrop.target.rgba8 + (size_t)y * backdrop.target.stride_bytes;
                const double light = 65535.0 * srgb_light(row[x / 3 * 4 + x % 3]);
                assert_true(fabs(channel_of(levels, 0, x / 3, y, x % 3) - light) <= 0.501);
            }
        }
        for (int i = 1; i < levels->count; i++) {
            check_level(levels, i);
        }
        dip_backdrop_free(&backdrop);
        assert_int_equal(dip_backdrop_bytes(&backdrop), 0);
    }
}

// A texel of a level is the mean of all its pixels, up to the rounding of the levels between.
static void a_level_is_the_mean_of_the_pixels(void **state) {
    (void)state;
    enum { SIDE = 64, LEVEL = 4, CELL = 1 << LEVEL };
    DipBackdropParts backdrop;
    make(&backdrop, SIDE, SIDE);
    const DipTargetRegion whole = {0, 0, SIDE, SIDE};
    dip_backdrop_fill(&backdrop, &whole, NULL);
    for (int texel = 0; texel < SIDE / CELL * (SIDE / CELL); texel++) {
        const int x0 = texel % (SIDE / CELL) * CELL;
        const int y0 = texel / (SIDE / CELL) * CELL;
        for (int c = 0; c < 3; c++) {
            double sum = 0.0;
            for (int i = 0; i < CELL * CELL; i++) {
                const size_t y = (size_t)(y0 + i / CELL);
                const size_t x = (size_t)(x0 + i % CELL);
                const uint8_t *row = backdrop.target.rgba8 + y * backdrop.target.stride_bytes;
                sum += 65535.0 * srgb_light(row[4 * x + (size_t)c]);
            }
            const double found = channel_of(&backdrop.levels, LEVEL, x0 / CELL, y0 / CELL, c);
            assert_true(fabs(found - sum / (CELL * CELL)) <= 0.5 * (LEVEL + 1));
        }
    }
    dip_backdrop_free(&backdrop);
}

// The texels whose pixels all lie in a region are those of the whole picture, for any number of
// threads.
static void a_region_has_the_texels_of_the_whole(void **state) {
    (void)state;
    enum { WIDTH = 131, HEIGHT = 77 };
    const DipTargetRegion whole = {0, 0, WIDTH, HEIGHT};
    const DipTargetRegion part = {19, 8, 99, 77};
    DipPool *pool = dip_pool_create(3, NULL);
    DipBackdropParts all;
    DipBackdropParts some;
    make(&all, WIDTH, HEIGHT);
    make(&some, WIDTH, HEIGHT);
    const uint64_t texels = dip_backdrop_fill(&all, &whole, NULL);
    assert_true(dip_backdrop_fill(&some, &part, pool) < texels);
    int compared = 0;
    for (int level = 0; level < all.levels.count; level++) {
        for (int y = 0; y < all.levels.height[level]; y++) {
            for (int x = 0; x < all.levels.width[level]; x++) {
                const double wide = (double)WIDTH / all.levels.width[level];
                const double high = (double)HEIGHT / all.levels.height[level];
                const bool inside = (x - 1) * wide >= part.x0 && (x + 2) * wide <= part.x1 &&
                                    (y - 1) * high >= part.y0 && (y + 1) * high <= part.y1;
                for (int c = 0; c < 3 && inside; c++, compared++) {
                    assert_int_equal(channel_of(&all.levels, level, x, y, c),
                                     channel_of(&some.levels, level, x, y, c));
                }
            }
        }
    }
    assert_true(compared > 3 * 76 * 66);
    dip_backdrop_free(&all);
    dip_backdrop_free(&some);
    dip_pool_destroy(&pool);
}

// Glass of roughness r reads the level of which a texel has 5120^(r - 1) of the picture's width.
static void the_blur_is_a_share_of_the_width(void **state) {
    (void)state;
    static const int widths[] = {1, 320, 640, 1000, 5120, 8192};
    for (int i = 0; i < 6; i++) {
        DipBackdropParts backdrop;
        DipError err = {0};
        assert_true(dip_backdrop_make(&backdrop, widths[i], 2, &err));
        const DipBackdrop *levels = &backdrop.levels;
        for (double r = 0.0; r <= 1.0; r += 0.125) {
            const double texel = widths[i] * pow(5120.0, r - 1.0);
            const double found = (double)levels->least_level + r * (double)levels->level_range;
            assert_true(fabs(found - log2(texel)) < 1e-5);
            // The four texels of the coarser level that are read, and one more, lie within the
            // margin.
            const double coarser = fmax(floor(found), 0.0) + 1.0;
            const double texels = fmax(floor(widths[i] / exp2(coarser)), 1.0);
            assert_true(dip_backdrop_margin(widths[i], 2, r) >= 3.5 * widths[i] / texels + 1.0);
        }
        dip_backdrop_free(&backdrop);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_level_is_the_mean_of_the_one_before),
        cmocka_unit_test(a_level_is_the_mean_of_the_pixels),
        cmocka_unit_test(a_region_has_the_texels_of_the_whole),
        cmocka_unit_test(the_blur_is_a_share_of_the_width),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
