// Compares the reference's decoding, mip chains and filtering with closed forms.
#include "renderer/reference/internal/texture.h"
#include "renderer/catalogue/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "tests/renderer/pipeline/near.h"

enum { MAX_TEXELS = 1024 * 1024 };

static uint8_t texels[4 * MAX_TEXELS];

static DipTextureDef make_def(int width, int height, DipEncoding encoding, DipWrap wrap) {
    return (DipTextureDef){.name = "test",
                           .width = width,
                           .height = height,
                           .rgba8 = texels,
                           .encoding = encoding,
                           .wrap_u = wrap,
                           .wrap_v = wrap};
}

static void open_texture(DipRefTexture *texture, const DipTextureDef *def) {
    DipError err;
    assert_true(dip_reference_texture_init(texture, def, DIP_REF_MAX_LEVELS, &err));
}

static void fill_noise(int width, int height) {
    Random random = {(uint64_t)(width * 10000 + height)};
    for (int i = 0; i < 4 * width * height; i++) {
        texels[i] = (uint8_t)random_u64(&random);
    }
}

// Fills texels: red is the column, green the row, blue 0, and alpha 255 minus the column.
static void fill_ramp(int width, int height) {
    for (int i = 0; i < width * height; i++) {
        const uint8_t texel[4] = {(uint8_t)(i % width), (uint8_t)(i / width), 0,
                                  (uint8_t)(255 - i % width)};
        memcpy(texels + 4 * i, texel, 4);
    }
}

static void srgb_is_the_published_curve(void **state) {
    (void)state;
    // Values of IEC 61966-2-1, computed to ten digits independently of this code.
    static const double pairs[][2] = {{0, 0.0},
                                      {1, 0.0003035269835},
                                      {10, 0.0030352698355},
                                      {11, 0.0033465357639},
                                      {128, 0.2158605001},
                                      {188, 0.5028864580},
                                      {255, 1.0}};
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++) {
        assert_near(dip_reference_decode_srgb(pairs[i][0] / 255.0), pairs[i][1], 1e-10);
    }
    for (int code = 0; code < 256; code++) {
        const double linear = dip_reference_decode_srgb(code / 255.0);
        assert_near(dip_reference_encode_srgb(linear) * 255.0, code, 1e-5);
    }
}

static void mean_of_level(const DipRefTexture *texture, int level, double mean[4]) {
    memset(mean, 0, 4 * sizeof *mean);
    const int count = texture->widths[level] * texture->heights[level];
    for (int i = 0; i < count; i++) {
        double texel[4];
        dip_reference_texel(texture, level, i % texture->widths[level], i / texture->widths[level],
                            texel);
        for (int c = 0; c < 4; c++) {
            mean[c] += texel[c] / count;
        }
    }
}

// Every texel of a level covers the same area of the texture, so the plain mean must stay the same.
static void mip_levels_keep_the_mean(void **state) {
    (void)state;
    static const int sizes[][2] = {{7, 5}, {1, 1}, {1, 9}, {13, 1}, {5, 5}, {64, 64}, {127, 33}};
    for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++) {
        fill_noise(sizes[s][0], sizes[s][1]);
        const DipTextureDef def =
            make_def(sizes[s][0], sizes[s][1], DIP_ENCODING_SRGB, DIP_WRAP_REPEAT);
        DipRefTexture texture;
        open_texture(&texture, &def);
        double first[4];
        mean_of_level(&texture, 0, first);
        for (int level = 1; level < texture.level_count; level++) {
            double mean[4];
            mean_of_level(&texture, level, mean);
            for (int c = 0; c < 4; c++) {
                assert_near(mean[c], first[c], 1e-12);
            }
            assert_int_equal(texture.widths[level], fmax(1, sizes[s][0] >> level));
            assert_int_equal(texture.heights[level], fmax(1, sizes[s][1] >> level));
        }
        assert_int_equal(texture.widths[texture.level_count - 1], 1);
        assert_int_equal(texture.heights[texture.level_count - 1], 1);
        dip_reference_texture_free(&texture);
    }
}

// From 7 columns to 3: the first target column takes columns 0 and 1 and a third of column 2. The
// second takes two thirds of column 2, column 3 and two thirds of column 4. From 5 rows to 2: the
// first target row takes rows 0 and 1 and half of row 2.
static void odd_sizes_are_weighted_by_area(void **state) {
    (void)state;
    fill_ramp(7, 5);
    const DipTextureDef def = make_def(7, 5, DIP_ENCODING_LINEAR, DIP_WRAP_REPEAT);
    DipRefTexture texture;
    open_texture(&texture, &def);
    double texel[4];
    dip_reference_texel(&texture, 1, 0, 0, texel);
    assert_near(texel[0] * 255.0, (0.0 + 1.0 + 2.0 / 3.0) / (7.0 / 3.0), 1e-12);
    assert_near(texel[1] * 255.0, (0.0 + 1.0 + 2.0 * 0.5) / 2.5, 1e-12);
    dip_reference_texel(&texture, 1, 1, 1, texel);
    assert_near(texel[0] * 255.0, 3.0, 1e-12);
    assert_near(texel[1] * 255.0, (2.0 * 0.5 + 3.0 + 4.0) / 2.5, 1e-12);
    dip_reference_texture_free(&texture);
}

// Reads with a square footprint whose sides are 2^lambda texels long.
static void read_at(const DipRefTexture *texture, const DipRefFilter *filter, double u, double v,
                    double lambda, double rgba[4]) {
    const double uv[2] = {u, v};
    const double dx[2] = {exp2(lambda) / texture->widths[0], 0.0};
    const double dy[2] = {0.0, exp2(lambda) / texture->heights[0]};
    dip_reference_sample(texture, filter, uv, dx, dy, rgba);
}

static void a_ramp_is_read_exactly(void **state) {
    (void)state;
    fill_ramp(256, 256);
    const DipTextureDef def = make_def(256, 256, DIP_ENCODING_LINEAR, DIP_WRAP_CLAMP);
    DipRefTexture texture;
    open_texture(&texture, &def);
    const DipRefFilter trilinear = {.max_anisotropy = 1};
    Random random = {5};
    for (int i = 0; i < 5000; i++) {
        // The column is far enough from the edges for level 3 to be linear.
        const double column = random_real(&random, 16.0, 240.0);
        const double row = random_real(&random, 16.0, 240.0);
        const double uv[2] = {(column + 0.5) / 256.0, (row + 0.5) / 256.0};
        double rgba[4];
        dip_reference_sample_finest(&texture, uv, rgba);
        assert_near(rgba[0] * 255.0, column, 1e-9);
        assert_near(rgba[1] * 255.0, row, 1e-9);
        assert_near(rgba[3] * 255.0, 255.0 - column, 1e-9);
        const double grid[2] = {(floor(column * 256.0) / 256.0 + 0.5) / 256.0, uv[1]};
        read_at(&texture, &trilinear, uv[0], uv[1], 0.0, rgba);
        assert_near(rgba[0] * 255.0, grid[0] * 256.0 - 0.5, 1e-9);
        // Every level of the ramp is the same ramp. So every blend of levels gives the same value,
        // except that positions are rounded down by less than 1/256 texel of the coarser level.
        const double lambda = random_real(&random, 0.0, 3.0);
        read_at(&texture, &trilinear, uv[0], uv[1], lambda, rgba);
        const double low = column - exp2(floor(lambda) + 1.0) / 256.0;
        assert_true(rgba[0] * 255.0 <= column + 1e-9 && rgba[0] * 255.0 >= low);
    }
    dip_reference_texture_free(&texture);
}

// Fills texels with a step: black up to column 31, white from column 32 on.
static void fill_step(void) {
    for (int i = 0; i < 64 * 64; i++) {
        memset(texels + 4 * i, i % 64 < 32 ? 0 : 255, 4);
    }
}

// The 16 probes of a read lie one texel apart, on texel centres, at -7.5..7.5 texels around the
// read position. For example, if the read position is seven texels left of the step (the left edge
// of column 32), only the last probe lies right of the step. With another spacing, for example
// 16/17 texel, probes would read values between black and white.
static void probes_lie_at_interval_midpoints(void **state) {
    (void)state;
    fill_step();
    const DipTextureDef def = make_def(64, 64, DIP_ENCODING_LINEAR, DIP_WRAP_CLAMP);
    DipRefTexture texture;
    open_texture(&texture, &def);
    for (int exact_footprint = 0; exact_footprint < 2; exact_footprint++) {
        const DipRefFilter filter = {.max_anisotropy = 16, .exact_footprint = exact_footprint};
        for (int shift = -8; shift <= 8; shift++) {
            const double uv[2] = {(32.0 + shift) / 64.0, 0.5};
            const double along[2] = {16.0 / 64.0, 0.0};
            const double across[2] = {0.0, 1.0 / 64.0};
            double rgba[4];
            dip_reference_sample(&texture, &filter, uv, along, across, rgba);
            assert_near(rgba[0], (8.0 + shift) / 16.0, 1e-12);
            dip_reference_sample(&texture, &filter, uv, across, along, rgba);
            assert_near(rgba[3], (8.0 + shift) / 16.0, 1e-12);
        }
    }
    dip_reference_texture_free(&texture);
}

static void coordinates_repeat_or_clamp_according_to_the_address_mode(void **state) {
    (void)state;
    fill_noise(7, 5);
    DipTextureDef def = make_def(7, 5, DIP_ENCODING_SRGB, DIP_WRAP_REPEAT);
    DipRefTexture texture;
    open_texture(&texture, &def);
    double here[4], there[4];
    for (int i = 0; i < 64; i++) {
        const double uv[2] = {i / 64.0, i / 32.0 - 1.0};
        const double shifted[2] = {uv[0] - 3.0, uv[1] + 1024.0};
        dip_reference_sample_finest(&texture, uv, here);
        dip_reference_sample_finest(&texture, shifted, there);
        for (int c = 0; c < 4; c++) {
            assert_near(here[c], there[c], 1e-9);
        }
    }
    def.wrap_u = def.wrap_v = DIP_WRAP_CLAMP;
    const double outside[2] = {1.0 + 1e30, -7.0};
    dip_reference_sample_finest(&texture, outside, there);
    dip_reference_texel(&texture, 0, 6, 0, here);
    assert_memory_equal(here, there, sizeof here);
    dip_reference_texture_free(&texture);
}

// Returns the texel 0..size - 1 that a walk along the texture in one direction meets at place t,
// back and forth for a mirrored axis; -1 for a border.
static int walk_to(int t, int size, DipWrap wrap) {
    int at = 0, step = t < 0 ? -1 : 1;
    bool outside = false, back = false;
    for (int k = 0; k != t; k += step) {
        const int next = at + (back ? -step : step);
        if (next >= 0 && next < size) {
            at = next;
            continue;
        }
        outside = true;
        back = wrap == DIP_WRAP_MIRROR ? !back : back; // The last texel is met twice.
        at = wrap == DIP_WRAP_REPEAT ? (next + size) % size : at;
    }
    return wrap == DIP_WRAP_BORDER && outside ? -1 : at;
}

static void centres_of_texels_are_met_as_by_a_walk(void **state) {
    (void)state;
    static const DipWrap wraps[] = {DIP_WRAP_REPEAT, DIP_WRAP_CLAMP, DIP_WRAP_MIRROR,
                                    DIP_WRAP_BORDER};
    fill_ramp(7, 5);
    for (int w = 0; w < 16; w++) {
        DipTextureDef def = make_def(7, 5, DIP_ENCODING_LINEAR, wraps[w % 4]);
        def.wrap_v = wraps[w / 4];
        memcpy(def.border_rgba8, (uint8_t[4]){250, 251, 252, 9}, 4);
        DipRefTexture texture;
        open_texture(&texture, &def);
        for (int i = 0; i < 35 * 25; i++) {
            const int x = i % 35 - 14, y = i / 35 - 10;
            const double uv[2] = {(x + 0.5) / 7.0, (y + 0.5) / 5.0};
            const int column = walk_to(x, 7, def.wrap_u), row = walk_to(y, 5, def.wrap_v);
            const bool border = column < 0 || row < 0;
            double rgba[4];
            dip_reference_sample_finest(&texture, uv, rgba);
            assert_near(255.0 * rgba[0], border ? 250 : column, 1e-9);
            assert_near(255.0 * rgba[1], border ? 251 : row, 1e-9);
            assert_near(255.0 * rgba[3], border ? 9 : 255 - column, 1e-9);
        }
        dip_reference_texture_free(&texture);
    }
}

static void any_coordinate_is_read_from_inside_the_texture(void **state) {
    (void)state;
    static const double awkward[] = {0.0,    -1e-18,   1.0,       -1.0, 1e30,
                                     -1e300, INFINITY, -INFINITY, NAN};
    fill_noise(7, 5);
    for (int wrap = 0; wrap < 4; wrap++) {
        const DipTextureDef def = make_def(7, 5, DIP_ENCODING_SRGB, (DipWrap)wrap);
        DipRefTexture texture;
        open_texture(&texture, &def);
        const DipRefFilter filter = {.max_anisotropy = 16, .exact_footprint = wrap % 2};
        for (int i = 0; i < 9 * 9 * 9; i++) {
            const double uv[2] = {awkward[i % 9], awkward[i / 9 % 9]};
            const double dx[2] = {awkward[i / 81], 0.5};
            double rgba[4];
            dip_reference_sample(&texture, &filter, uv, dx, uv, rgba);
            for (int c = 0; c < 4; c++) {
                assert_true(rgba[c] >= 0.0 && rgba[c] <= 1.0);
            }
        }
        dip_reference_texture_free(&texture);
    }
}

static void mip_colours_follow_the_level_size(void **state) {
    (void)state;
    static const uint8_t codes[][3] = {{0, 0, 0},     {128, 0, 0},  {255, 0, 0}, {255, 128, 0},
                                       {255, 255, 0}, {0, 255, 0},  {0, 0, 255}, {128, 0, 128},
                                       {128, 0, 128}, {128, 0, 128}};
    memset(texels, 77, sizeof texels);
    const DipTextureDef def = make_def(1024, 512, DIP_ENCODING_SRGB, DIP_WRAP_REPEAT);
    DipRefTexture texture;
    open_texture(&texture, &def);
    const DipRefFilter filter = {.max_anisotropy = 1, .mip_colours = true};
    for (int level = 0; level < 9; level++) {
        double rgba[4];
        read_at(&texture, &filter, 0.3, 0.7, level + 0.25, rgba);
        for (int c = 0; c < 3; c++) {
            const double expected = dip_reference_decode_srgb(codes[level][c] / 255.0) * 0.75 +
                                    dip_reference_decode_srgb(codes[level + 1][c] / 255.0) * 0.25;
            assert_near(rgba[c], expected, 1e-12);
        }
        assert_near(rgba[3], 77.0 / 255.0, 1e-12);
    }
    dip_reference_texture_free(&texture);
}

static void high_performance_drops_levels_by_size(void **state) {
    (void)state;
    static const int sizes[][3] = {{512, 64, 1}, {1024, 8, 2}, {8, 1024, 2}, {1, 1, 0}, {2, 1, 1}};
    DipQuality quality = dip_quality_default();
    quality.step[DIP_SETTING_MIPLOD] = DIP_MIPLOD_HIGH_PERFORMANCE;
    const DipRefFilter filter = dip_reference_colour_filter(&quality);
    assert_near(filter.bias, 1.5, 0.0);
    for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++) {
        fill_noise(sizes[s][0], sizes[s][1]);
        const DipTextureDef def =
            make_def(sizes[s][0], sizes[s][1], DIP_ENCODING_LINEAR, DIP_WRAP_CLAMP);
        DipRefTexture texture;
        open_texture(&texture, &def);
        const int level = sizes[s][2];
        // This position lies between the texture's corner and the centre of the level's first
        // texel. A finer level would read another texel there.
        double expected[4], got[4];
        dip_reference_texel(&texture, level, 0, 0, expected);
        read_at(&texture, &filter, 0.25 / texture.widths[level], 0.25 / texture.heights[level],
                -9.0, got);
        for (int c = 0; c < 4; c++) {
            assert_near(got[c], expected[c], 1e-12);
        }
        dip_reference_texture_free(&texture);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(srgb_is_the_published_curve),
        cmocka_unit_test(mip_levels_keep_the_mean),
        cmocka_unit_test(odd_sizes_are_weighted_by_area),
        cmocka_unit_test(a_ramp_is_read_exactly),
        cmocka_unit_test(probes_lie_at_interval_midpoints),
        cmocka_unit_test(coordinates_repeat_or_clamp_according_to_the_address_mode),
        cmocka_unit_test(centres_of_texels_are_met_as_by_a_walk),
        cmocka_unit_test(any_coordinate_is_read_from_inside_the_texture),
        cmocka_unit_test(mip_colours_follow_the_level_size),
        cmocka_unit_test(high_performance_drops_levels_by_size),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
