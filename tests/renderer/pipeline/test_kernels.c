// Compares every kernel of every instruction set with the scalar kernel, bit for bit. The random
// input includes special values: zeros, infinities, NaN, huge and tiny numbers.
#include "renderer/base/assert.h"
#include "renderer/base/srgb.h"
#include "renderer/pipeline/geometry/setup.h"
#include "renderer/pipeline/kernels/kernels.h"
#include "renderer/pipeline/shading/tile_shading.h"
#include "renderer/pipeline/texture/texture_layout.h"
#include "renderer/scene/materials/surface.h"
#include "renderer/catalogue/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { ROUNDS = 300, SEED = 20261 };

// Returns a random number within +-magnitude or, once in 16 calls on average, a special value.
static float awkward(Random *random, double magnitude) {
    static const float specials[] = {0.0f, -0.0f,  1.0f,   -1.0f, INFINITY, -INFINITY,
                                     NAN,  1e-38f, 1e-45f, 3e38f, -3e38f,   0.5f};
    if (random_int(random, 0, 15) == 0) {
        return specials[random_int(random, 0, (int)DIP_ARRAY_COUNT(specials) - 1)];
    }
    return (float)random_real(random, -magnitude, magnitude);
}

typedef void CompareIsa(const DipKernels *scalar, const DipKernels *other, Random *random);

static void compare_all(CompareIsa *compare) {
    int compared = 0;
    for (int isa = DIP_ISA_SCALAR + 1; isa < DIP_ISA_COUNT; isa++) {
        if (!dip_isa_available((DipIsa)isa)) {
            continue;
        }
        Random random = {SEED};
        for (int round = 0; round < ROUNDS; round++) {
            compare(dip_kernels(DIP_ISA_SCALAR), dip_kernels((DipIsa)isa), &random);
        }
        compared++;
    }
    if (!compared) {
        skip();
    }
}

// --- projection --------------------------------------------------------------------------------

static void compare_project(const DipKernels *scalar, const DipKernels *other, Random *random) {
    static float clip[4][DIP_VERTEX_BATCH];
    static DipScreenBatch expected;
    static DipScreenBatch found;
    for (int i = 0; i < DIP_VERTEX_BATCH; i++) {
        for (int c = 0; c < 4; c++) {
            clip[c][i] = awkward(random, c == 3 ? 10.0 : 30.0);
        }
    }
    const DipScreenMapping map = {
        .half_width = (float)random_int(random, 1, 4096),
        .half_height = (float)random_int(random, 1, 4096),
        .left = -1.0f,
        .right = 0.25f,
        .bottom = -0.5f,
        .top = 1.0f,
        .guard_left = 20.0f,
        .guard_right = 18.0f,
        .guard_top = 20.0f,
        .guard_bottom = 18.0f,
        .clip_planes = {{0.1f, 0.9f, -0.3f, 0.2f}},
        .clip_plane_count = 1,
    };
    float *const rows[4] = {clip[0], clip[1], clip[2], clip[3]};
    const int count = random_int(random, 1, DIP_VERTEX_BATCH);
    scalar->dip_kernel_project(&map, count, rows, &expected);
    other->dip_kernel_project(&map, count, rows, &found);
    const size_t n = (size_t)count;
    for (size_t i = 0; i < n; i++) {
        assert_int_equal(found.code[i], expected.code[i]);
        assert_int_equal(found.x[i], expected.x[i]);
        assert_int_equal(found.y[i], expected.y[i]);
        assert_true(abs(found.x[i]) <= 1 << 22 && abs(found.y[i]) <= 1 << 22);
        if (expected.code[i] & (DIP_CLIP_INVALID | DIP_CLIP_NEEDED)) {
            continue; // the depth of such a vertex has no meaning
        }
        assert_memory_equal(&found.z[i], &expected.z[i], sizeof(float));
        assert_memory_equal(&found.rw[i], &expected.rw[i], sizeof(float));
    }
}

static void projection_is_the_same_for_every_isa(void **state) {
    (void)state;
    compare_all(compare_project);
}

// --- set-up ------------------------------------------------------------------------------------

enum { SETUP_ROOM = DIP_SETUP_BATCH + DIP_SETUP_EXCESS };

// Makes random vertices. Sometimes they lie on a coarse lattice, so that edges pass through samples
// and some triangles have no area.
static void random_screen(Random *random, DipScreenBatch *screen) {
    const int far = 1 << random_int(random, 4, 22);
    const int step = 1 << random_int(random, 0, 8);
    for (int i = 0; i < DIP_VERTEX_BATCH; i++) {
        screen->x[i] = random_int(random, -far, far) / step * step;
        screen->y[i] = random_int(random, -far, far) / step * step;
        screen->z[i] = (float)random_real(random, 0.0, 1.0);
        screen->rw[i] = (float)random_real(random, 0.0, 10.0);
    }
}

static void compare_setup(const DipKernels *scalar, const DipKernels *other, Random *random) {
    static DipScreenBatch screen;
    static float varyings[DIP_MAX_VARYINGS][DIP_VERTEX_BATCH];
    static uint8_t corner[3][DIP_SETUP_BATCH];
    static uint32_t patch[DIP_SETUP_BATCH + DIP_BATCH_ALIGN];
    static DipTriangle triangles[2][SETUP_ROOM];
    static float planes[2][SETUP_ROOM * 64];
    random_screen(random, &screen);
    for (int i = 0; i < DIP_VERTEX_BATCH; i++) {
        for (int s = 0; s < DIP_MAX_VARYINGS; s++) {
            varyings[s][i] = awkward(random, 3.0);
        }
    }
    for (int t = 0; t < DIP_SETUP_BATCH; t++) {
        for (int k = 0; k < 3; k++) {
            corner[k][t] = (uint8_t)random_u64(random);
        }
        patch[t] = (uint32_t)random_int(random, 0, 999);
    }
    const int varying_count = random_int(random, 0, DIP_MAX_VARYINGS);
    DipSamplePositions samples = {.count = 0};
    dip_sample_positions_add(&samples, dip_sample_pattern(8));
    const DipSetupTarget target = {.width = random_int(random, 1, 8192),
                                   .height = random_int(random, 1, 8192),
                                   .region_first = {random_int(random, 0, 99), 0},
                                   .region_last = {random_int(random, 99, 8191), 8191},
                                   .varying_count = varying_count,
                                   .plane_stride = dip_plane_stride(varying_count),
                                   .draw = 17,
                                   .first_patch = 1000,
                                   .cull = (DipCull)random_int(random, 0, 2),
                                   .samples = &samples,
                                   .sample_min = {16, 16},
                                   .sample_max = {240, 240}};
    const DipSetupBatch batch = {.count = random_int(random, 1, DIP_SETUP_BATCH),
                                 .corner = {corner[0], corner[1], corner[2]},
                                 .patch = patch,
                                 .screen = &screen,
                                 .varyings = varyings[0],
                                 .varying_stride = DIP_VERTEX_BATCH};
    const int expected = scalar->dip_kernel_setup(&target, &batch, triangles[0], planes[0]);
    const int found = other->dip_kernel_setup(&target, &batch, triangles[1], planes[1]);
    assert_int_equal(found, expected);
    assert_memory_equal(triangles[0], triangles[1], (size_t)found * sizeof triangles[0][0]);
    for (int t = 0; t < found; t++) {
        const int at = t * target.plane_stride;
        for (int f = 0; f < dip_plane_floats(varying_count); f++) {
            const float a = planes[0][at + f];
            const float b = planes[1][at + f];
            assert_true(memcmp(&a, &b, sizeof a) == 0 || (isnan(a) && isnan(b)));
        }
    }
}

static void setup_is_the_same_for_every_isa(void **state) {
    (void)state;
    compare_all(compare_setup);
}

// --- textures ----------------------------------------------------------------------------------

static DipTexture *random_texture(Random *random) {
    static uint8_t rgba8[64 * 64 * 4];
    const int sizes[] = {1, 2, 5, 7, 16, 64};
    for (size_t i = 0; i < sizeof rgba8; i++) {
        rgba8[i] = (uint8_t)random_u64(random);
    }
    const DipTextureDef def = {
        .name = "random",
        .width = sizes[random_int(random, 0, 5)],
        .height = sizes[random_int(random, 0, 5)],
        .rgba8 = rgba8,
        .wrap_u = (DipWrap)random_int(random, 0, DIP_WRAP_COUNT - 1),
        .wrap_v = (DipWrap)random_int(random, 0, DIP_WRAP_COUNT - 1),
        .border_rgba8 = {200, 30, 90, 128},
    };
    DipTexture *texture = dip_texture_create(&def, NULL);
    assert_non_null(texture);
    return texture;
}

static void random_coordinates(DipFragmentBatch *batch, Random *random) {
    const double spread = pow(10.0, random_real(random, -5.0, 2.0));
    batch->count = random_int(random, 1, DIP_FRAGMENT_BATCH);
    for (int i = 0; i < DIP_FRAGMENT_BATCH; i++) {
        for (int s = 0; s < 2; s++) {
            batch->varying[s][i] = awkward(random, 3.0);
            batch->varying_dx[s][i] = awkward(random, spread);
            batch->varying_dy[s][i] = awkward(random, spread);
        }
    }
    batch->work = (DipShaderWork){0};
}

static void compare_sampling(const DipKernels *scalar, const DipKernels *other, Random *random) {
    static DipFragmentBatch batch;
    float expected[3][DIP_FRAGMENT_BATCH];
    float found[3][DIP_FRAGMENT_BATCH];
    DipTexture *texture = random_texture(random);
    const DipSampler sampler = {
        .texture = texture,
        .max_anisotropy = 1 << random_int(random, 0, 4),
        .exact_footprint = random_int(random, 0, 1) != 0,
        .bias_lod8 = random_int(random, -256, 512),
        .min_lod8 = 256 * random_int(random, 0, 2),
        .cheap = random_int(random, 0, 1) != 0,
        .filter = (DipFilter)random_int(random, 0, DIP_FILTER_COUNT - 1),
        .no_mips = random_int(random, 0, 3) == 0,
    };
    random_coordinates(&batch, random);
    scalar->dip_kernel_sample_colour(&batch, &sampler, 0, expected);
    const DipShaderWork work = batch.work;
    batch.work = (DipShaderWork){0};
    other->dip_kernel_sample_colour(&batch, &sampler, 0, found);
    assert_int_equal(batch.work.probes, work.probes);
    assert_int_equal(batch.work.texels, work.texels);
    const size_t bytes = (size_t)batch.count * sizeof(float);
    for (int c = 0; c < 3; c++) {
        assert_memory_equal(found[c], expected[c], bytes);
        for (int i = 0; i < batch.count; i++) {
            assert_true(expected[c][i] >= 0.0f && expected[c][i] <= 1.0001f);
        }
    }
    scalar->dip_kernel_sample_alpha(&batch, &sampler, 0, expected[0]);
    other->dip_kernel_sample_alpha(&batch, &sampler, 0, found[0]);
    assert_memory_equal(found[0], expected[0], bytes);
    dip_texture_destroy(&texture);
}

// Reading two textures at once gives the same values as reading each texture alone, whether or not
// their sizes and samplers are equal.
static void compare_two_textures(const DipKernels *scalar, const DipKernels *other,
                                 Random *random) {
    static DipFragmentBatch batch;
    float expected[2][3][DIP_FRAGMENT_BATCH];
    float found[2][3][DIP_FRAGMENT_BATCH];
    DipTexture *textures[2] = {random_texture(random), NULL};
    do {
        dip_texture_destroy(&textures[1]);
        textures[1] = random_texture(random);
    } while (random_int(random, 0, 3) && textures[1]->width != textures[0]->width);
    DipSampler samplers[2] = {{.texture = textures[0],
                               .max_anisotropy = 1 << random_int(random, 0, 4),
                               .min_lod8 = 256 * random_int(random, 0, 1)}};
    samplers[1] = samplers[0];
    samplers[1].texture = textures[1];
    samplers[1].cheap = random_int(random, 0, 7) == 0;
    samplers[0].filter = samplers[1].filter =
        (DipFilter)random_int(random, 0, DIP_FILTER_COUNT - 1);
    samplers[1].no_mips = random_int(random, 0, 7) == 0;
    random_coordinates(&batch, random);
    for (int t = 0; t < 2; t++) {
        scalar->dip_kernel_sample_colour(&batch, &samplers[t], 0, expected[t]);
    }
    const DipShaderWork work = batch.work;
    batch.work = (DipShaderWork){0};
    other->dip_kernel_sample_colours(&batch, (const DipSampler *const[2]){samplers, samplers + 1},
                                     0, (float(*const[2])[DIP_FRAGMENT_BATCH]){found[0], found[1]});
    assert_int_equal(batch.work.probes, work.probes);
    assert_int_equal(batch.work.texels, work.texels);
    for (int t = 0; t < 2; t++) {
        for (int c = 0; c < 3; c++) {
            assert_memory_equal(found[t][c], expected[t][c], (size_t)batch.count * sizeof(float));
        }
        dip_texture_destroy(&textures[t]);
    }
}

static void reading_two_textures_at_once_equals_reading_each_alone(void **state) {
    (void)state;
    compare_all(compare_two_textures);
}

static void sampling_is_the_same_for_every_isa(void **state) {
    (void)state;
    compare_all(compare_sampling);
}

// --- fragments ---------------------------------------------------------------------------------

enum { TRIANGLES = 40, VARYINGS = 5 };

static void compare_fragments(const DipKernels *scalar, const DipKernels *other, Random *random) {
    static DipTriangle triangles[TRIANGLES];
    static float planes[TRIANGLES * (DIP_PLANES_VARYINGS + 3 * VARYINGS + DIP_PLANES_ALIGN)];
    static DipFragmentBatch expected;
    static DipFragmentBatch found;
    static DipSrgbEncodeTable srgb;
    static DipFragmentList list;
    if (!srgb.runs[DIP_LINEAR16_MAX / DIP_SRGB_RUN]) {
        dip_srgb_encode_table(&srgb);
    }
    for (size_t i = 0; i < DIP_ARRAY_COUNT(planes); i++) {
        planes[i] = awkward(random, 2.0);
    }
    list.count = random_int(random, 1, DIP_FRAGMENT_BATCH);
    // Vectors of one, a few and many triangles are interpolated in different ways.
    const int first = random_int(random, 0, TRIANGLES - 8);
    const int different = random_int(random, 0, 7);
    for (int i = 0; i < DIP_FRAGMENT_BATCH; i++) {
        list.triangle[i] = (uint32_t)(first + random_int(random, 0, different));
        list.position[i] = (uint32_t)random_int(random, 0, (1 << 28) - 1);
    }
    const DipShadingInput input = {triangles, planes, dip_plane_stride(VARYINGS), 576, 448};
    scalar->dip_kernel_interpolate(&input, &list, VARYINGS, 0, &expected);
    other->dip_kernel_interpolate(&input, &list, VARYINGS, 0, &found);
    for (int s = 0; s < VARYINGS; s++) {
        for (int i = 0; i < list.count; i++) {
            // Two NaNs count as equal: the bits of a NaN depend on the order of an instruction's
            // operands.
            const float *pairs[3][2] = {{&found.varying[s][i], &expected.varying[s][i]},
                                        {&found.varying_dx[s][i], &expected.varying_dx[s][i]},
                                        {&found.varying_dy[s][i], &expected.varying_dy[s][i]}};
            for (int k = 0; k < 3; k++) {
                if (!isnan(*pairs[k][0]) || !isnan(*pairs[k][1])) {
                    assert_memory_equal(pairs[k][0], pairs[k][1], sizeof(float));
                }
            }
        }
    }
    DipEncodedBatch expected_code;
    DipEncodedBatch found_code;
    for (int c = 0; c < 3; c++) {
        for (int i = 0; i < DIP_FRAGMENT_BATCH; i++) {
            expected.colour[c][i] = awkward(random, 1.5);
        }
    }
    scalar->dip_kernel_encode(&expected, &srgb, &expected_code);
    other->dip_kernel_encode(&expected, &srgb, &found_code);
    const size_t n = (size_t)list.count;
    assert_memory_equal(found_code.rgba8, expected_code.rgba8, n * sizeof(uint32_t));
    for (int c = 0; c < 3; c++) {
        assert_memory_equal(found_code.linear16[c], expected_code.linear16[c], n * sizeof(int32_t));
    }
}

static void interpolation_and_encoding_are_the_same_for_every_isa(void **state) {
    (void)state;
    compare_all(compare_fragments);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(projection_is_the_same_for_every_isa),
        cmocka_unit_test(setup_is_the_same_for_every_isa),
        cmocka_unit_test(sampling_is_the_same_for_every_isa),
        cmocka_unit_test(reading_two_textures_at_once_equals_reading_each_alone),
        cmocka_unit_test(interpolation_and_encoding_are_the_same_for_every_isa),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
