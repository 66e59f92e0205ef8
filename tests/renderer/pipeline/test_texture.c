// Tests texture reads of every address mode and filter against their definition (docs/picture.md,
// Textures), which this file evaluates in double precision, one texel at a time. Also tests that
// textures are read back and updated exactly.
#include "renderer/base/pool.h"
#include "renderer/base/srgb.h"
#include "renderer/pipeline/kernels/kernels.h"
#include "renderer/pipeline/texture/texture_layout.h"
#include "renderer/catalogue/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/renderer/pipeline/near.h"

enum { LANES = DIP_FRAGMENT_BATCH, MAX_SIZE = 256 };

static const int sizes[][2] = {{1, 1}, {2, 1},   {1, 7},   {5, 3},
                               {8, 8}, {33, 64}, {127, 5}, {100, 256}};
enum { SIZE_COUNT = sizeof sizes / sizeof *sizes };

static const uint8_t border[4] = {250, 5, 130, 70};

static uint8_t noise[4 * MAX_SIZE * MAX_SIZE];

static void fill_noise(uint64_t seed) {
    Random random = {seed};
    for (size_t i = 0; i < sizeof noise; i++) {
        noise[i] = (uint8_t)random_u64(&random);
    }
}

static DipTextureDef def_of(int size, DipEncoding encoding, int wrap_u, int wrap_v) {
    DipTextureDef def = {.name = "noise",
                         .width = sizes[size][0],
                         .height = sizes[size][1],
                         .rgba8 = noise,
                         .encoding = encoding,
                         .wrap_u = (DipWrap)wrap_u,
                         .wrap_v = (DipWrap)wrap_v};
    memcpy(def.border_rgba8, border, sizeof border);
    return def;
}

// --- the definition ------------------------------------------------------------------------------

// A level in linear light.
typedef struct TrueLevel {
    int width;
    int height;
    double texels[MAX_SIZE * MAX_SIZE][4];
} TrueLevel;

typedef struct Truth {
    const DipTextureDef *def;
    int level_count;
    TrueLevel levels[DIP_MAX_LEVELS];
} Truth;

static double decode(const DipTextureDef *def, const uint8_t *code, int c) {
    const double encoded = code[c] / 255.0;
    return c < 3 && def->encoding == DIP_ENCODING_SRGB ? dip_srgb_decode(encoded) : encoded;
}

// Length that the source texel i shares with the target texel j of a level of another size.
static double shared_length(int i, int size, int j, int next) {
    const double low = fmax((double)i / size, (double)j / next);
    const double high = fmin((i + 1.0) / size, (j + 1.0) / next);
    return fmax(high - low, 0.0) * next;
}

static void halve(const TrueLevel *from, TrueLevel *to) {
    to->width = from->width > 1 ? from->width / 2 : 1;
    to->height = from->height > 1 ? from->height / 2 : 1;
    for (int y = 0; y < to->height; y++) {
        for (int x = 0; x < to->width; x++) {
            double *sum = to->texels[y * to->width + x];
            memset(sum, 0, sizeof to->texels[0]);
            for (int j = 2 * y; j < 2 * y + 3 && j < from->height; j++) {
                for (int i = 2 * x; i < 2 * x + 3 && i < from->width; i++) {
                    const double area = shared_length(i, from->width, x, to->width) *
                                        shared_length(j, from->height, y, to->height);
                    for (int c = 0; c < 4; c++) {
                        sum[c] += area * from->texels[j * from->width + i][c];
                    }
                }
            }
        }
    }
}

static Truth *make_truth(const DipTextureDef *def) {
    Truth *truth = malloc(sizeof *truth);
    assert_non_null(truth);
    truth->def = def;
    truth->level_count = 1;
    TrueLevel *level = &truth->levels[0];
    level->width = def->width;
    level->height = def->height;
    for (int i = 0; i < def->width * def->height; i++) {
        for (int c = 0; c < 4; c++) {
            level->texels[i][c] = decode(def, def->rgba8 + 4 * i, c);
        }
    }
    for (; level->width > 1 || level->height > 1; level++) {
        halve(level, level + 1);
        truth->level_count++;
    }
    return truth;
}

// Maps the index of a texel into 0..size - 1, or to -1 for the border.
static int64_t map_index(int64_t i, int64_t size, DipWrap wrap) {
    const int64_t lap = i >= 0 ? i / size : -((-i + size - 1) / size); // rounded down
    const int64_t rest = i - lap * size;
    switch (wrap) {
    case DIP_WRAP_CLAMP:
        return i < 0 ? 0 : i < size ? i : size - 1;
    case DIP_WRAP_MIRROR:
        return lap % 2 != 0 ? size - 1 - rest : rest;
    case DIP_WRAP_BORDER:
        return lap == 0 ? i : -1;
    default:
        return rest;
    }
}

static void true_texel(const Truth *truth, int l, int64_t i, int64_t j, double rgba[4]) {
    const TrueLevel *level = &truth->levels[l];
    const int64_t x = map_index(i, level->width, truth->def->wrap_u);
    const int64_t y = map_index(j, level->height, truth->def->wrap_v);
    for (int c = 0; c < 4; c++) {
        rgba[c] =
            x < 0 || y < 0 ? decode(truth->def, border, c) : level->texels[y * level->width + x][c];
    }
}

static void true_bilinear(const Truth *truth, int l, double u, double v, double rgba[4]) {
    const double x = floor((u * truth->levels[l].width - 0.5) * 256.0) / 256.0;
    const double y = floor((v * truth->levels[l].height - 0.5) * 256.0) / 256.0;
    const double fx = x - floor(x);
    const double fy = y - floor(y);
    memset(rgba, 0, 4 * sizeof *rgba);
    for (int k = 0; k < 4; k++) {
        double texel[4];
        true_texel(truth, l, (int64_t)floor(x) + k % 2, (int64_t)floor(y) + k / 2, texel);
        const double weight = (k % 2 ? fx : 1.0 - fx) * (k / 2 ? fy : 1.0 - fy);
        for (int c = 0; c < 4; c++) {
            rgba[c] += weight * texel[c];
        }
    }
}

// Reads with one probe. lod8: the level of detail in 1/256.
static void true_read(const Truth *truth, const DipSampler *sampler, int lod8, double u, double v,
                      double rgba[4]) {
    const int last = (truth->level_count - 1) * 256;
    int at = lod8 + sampler->bias_lod8;
    at = at < sampler->min_lod8 ? sampler->min_lod8 : at;
    at = sampler->no_mips ? sampler->min_lod8 / 256 * 256 : at;
    at = at > last ? last : at;
    if (sampler->filter != DIP_FILTER_TRILINEAR) {
        at = (int)floor(at / 256.0 + 0.5) * 256;
    }
    const int level = at / 256;
    if (sampler->filter == DIP_FILTER_POINT) {
        true_texel(truth, level, (int64_t)floor(u * truth->levels[level].width),
                   (int64_t)floor(v * truth->levels[level].height), rgba);
        return;
    }
    true_bilinear(truth, level, u, v, rgba);
    if (at % 256) {
        double coarser[4];
        true_bilinear(truth, level + 1, u, v, coarser);
        for (int c = 0; c < 4; c++) {
            rgba[c] += (coarser[c] - rgba[c]) * (at % 256 / 256.0);
        }
    }
}

// --- reads ---------------------------------------------------------------------------------------

// Returns whether rounding in float may choose another nearest texel.
static bool is_between_texels(const Truth *truth, double u, double v) {
    for (int l = 0; l < truth->level_count; l++) {
        const double x = u * truth->levels[l].width;
        const double y = v * truth->levels[l].height;
        const double margin = 1e-4;
        if (fabs(x - floor(x + 0.5)) < margin || fabs(y - floor(y + 0.5)) < margin) {
            return true;
        }
    }
    return false;
}

static float random_coordinate(Random *random, int size) {
    switch (random_int(random, 0, 4)) {
    case 0: // about the edges, where address modes differ
        return (float)(random_int(random, -2, 2) + random_real(random, -2.0, 2.0) / size);
    case 1:
        return (float)random_int(random, -3 * size, 3 * size) / (float)size;
    case 2:
        return (float)random_real(random, -3000.0, 3000.0);
    default:
        return (float)random_real(random, -3.0, 4.0);
    }
}

static DipFragmentBatch batch;
static int lods[LANES];

// Fills the batch with footprints whose level of detail is exactly lods[i] / 256.
static void place_footprints(const DipTextureDef *def, Random *random) {
    batch.count = random_int(random, 1, LANES);
    for (int i = 0; i < LANES; i++) {
        lods[i] = random_int(random, -300, 8 * 256);
        batch.varying[0][i] = random_coordinate(random, def->width);
        batch.varying[1][i] = random_coordinate(random, def->height);
        const float length = (float)exp2(lods[i] / 256.0);
        const bool along_u = random_int(random, 0, 1);
        batch.varying_dx[0][i] = along_u ? length / (float)def->width : 0.0f;
        batch.varying_dx[1][i] = along_u ? 0.0f : length / (float)def->height;
        batch.varying_dy[0][i] = 0.0f;
        batch.varying_dy[1][i] = 0.0f;
    }
}

static DipSampler random_sampler(Random *random, const DipTexture *texture) {
    return (DipSampler){.texture = texture,
                        .max_anisotropy = 1,
                        .bias_lod8 = random_int(random, 0, 2) ? 0 : random_int(random, -300, 300),
                        .min_lod8 = random_int(random, 0, 2) ? 0 : random_int(random, 0, 700),
                        .filter = (DipFilter)random_int(random, 0, DIP_FILTER_COUNT - 1),
                        .no_mips = random_int(random, 0, 3) == 0};
}

// Compares the lanes of the batch with the definition.
static void check_lanes(const Truth *truth, const DipSampler *sampler, float colour[3][LANES],
                        const float *alpha) {
    for (int i = 0; i < batch.count; i++) {
        const double u = batch.varying[0][i];
        const double v = batch.varying[1][i];
        if (sampler->filter == DIP_FILTER_POINT && is_between_texels(truth, u, v)) {
            continue;
        }
        double expected[4];
        true_read(truth, sampler, lods[i], u, v, expected);
        for (int c = 0; c < 4; c++) {
            // Tolerance: texels have about 11 bits of the square root, and rounding in float may
            // move a position by 1/256 texel.
            const double found = c < 3 ? colour[c][i] : alpha[i];
            if (!(fabs(found - expected[c]) < 0.008)) {
                fail_msg(
                    "%dx%d, wrap %d %d, filter %d, no_mips %d, lod %d, at (%.9g, %.9g): channel "
                    "%d is %g, expected %g",
                    truth->def->width, truth->def->height, truth->def->wrap_u, truth->def->wrap_v,
                    sampler->filter, sampler->no_mips, lods[i], u, v, c, found, expected[c]);
            }
        }
    }
}

static void check_reads(const DipTextureDef *def, uint64_t seed) {
    static float colour[3][LANES];
    static float alpha[LANES];
    Truth *truth = make_truth(def);
    DipTexture *texture = dip_texture_create(def, NULL);
    assert_non_null(texture);
    assert_int_equal(texture->level_count, truth->level_count);
    for (int isa = DIP_ISA_SCALAR; isa < DIP_ISA_COUNT; isa++) {
        if (!dip_isa_available((DipIsa)isa)) {
            continue;
        }
        const DipKernels *kernels = dip_kernels((DipIsa)isa);
        Random random = {seed};
        for (int round = 0; round < 12; round++) {
            const DipSampler sampler = random_sampler(&random, texture);
            place_footprints(def, &random);
            kernels->dip_kernel_sample_colour(&batch, &sampler, 0, colour);
            kernels->dip_kernel_sample_alpha(&batch, &sampler, 0, alpha);
            check_lanes(truth, &sampler, colour, alpha);
        }
    }
    dip_texture_destroy(&texture);
    free(truth);
}

static void reads_follow_the_definition(void **state) {
    (void)state;
    fill_noise(3);
    for (int s = 0; s < SIZE_COUNT; s++) {
        for (int wraps = 0; wraps < DIP_WRAP_COUNT * DIP_WRAP_COUNT; wraps++) {
            const DipTextureDef def = def_of(s, wraps % 3 ? DIP_ENCODING_SRGB : DIP_ENCODING_LINEAR,
                                             wraps % DIP_WRAP_COUNT, wraps / DIP_WRAP_COUNT);
            check_reads(&def, (uint64_t)(s * 100 + wraps));
        }
    }
}

// An opaque picture with a border that is not opaque has an alpha.
static void a_transparent_border_gives_alpha(void **state) {
    (void)state;
    fill_noise(4);
    for (int i = 0; i < MAX_SIZE * MAX_SIZE; i++) {
        noise[4 * i + 3] = 255;
    }
    const DipTextureDef def = def_of(4, DIP_ENCODING_SRGB, DIP_WRAP_REPEAT, DIP_WRAP_BORDER);
    check_reads(&def, 5);
}

static void coordinates_that_are_not_numbers_stay_inside(void **state) {
    (void)state;
    static const float awkward[] = {NAN, INFINITY, -INFINITY, 3e38f, -3e38f, 1e-40f, -1e-40f, 0.0f};
    float colour[3][LANES];
    float alpha[LANES];
    fill_noise(6);
    for (int wraps = 0; wraps < DIP_WRAP_COUNT * DIP_WRAP_COUNT; wraps++) {
        const DipTextureDef def =
            def_of(3, DIP_ENCODING_SRGB, wraps % DIP_WRAP_COUNT, wraps / DIP_WRAP_COUNT);
        DipTexture *texture = dip_texture_create(&def, NULL);
        for (int isa = DIP_ISA_SCALAR; isa < DIP_ISA_COUNT; isa++) {
            for (int filter = 0; filter < DIP_FILTER_COUNT && dip_isa_available((DipIsa)isa);
                 filter++) {
                const DipSampler sampler = {.texture = texture,
                                            .max_anisotropy = 1 << wraps % 3,
                                            .filter = (DipFilter)filter};
                batch.count = LANES;
                for (int i = 0; i < LANES; i++) {
                    batch.varying[0][i] = awkward[i % 8];
                    batch.varying[1][i] = awkward[i / 8 % 8];
                    batch.varying_dx[0][i] = awkward[(i + 3) % 8];
                    batch.varying_dy[1][i] = awkward[(i / 8 + filter) % 8];
                }
                const DipKernels *kernels = dip_kernels((DipIsa)isa);
                kernels->dip_kernel_sample_colour(&batch, &sampler, 0, colour);
                kernels->dip_kernel_sample_alpha(&batch, &sampler, 0, alpha);
                for (int i = 0; i < LANES; i++) {
                    assert_true(colour[0][i] >= 0.0f && colour[0][i] <= 1.0001f);
                    assert_true(alpha[i] >= 0.0f && alpha[i] <= 1.0001f);
                }
            }
        }
        dip_texture_destroy(&texture);
    }
}

// --- reading back --------------------------------------------------------------------------------

static void level_0_is_read_back_exactly(void **state) {
    (void)state;
    static uint8_t found[4 * 256 * 256];
    for (int i = 0; i < 256 * 256; i++) {
        // Each pair of red and blue, and of green and blue, since they share bits.
        const uint8_t texel[4] = {(uint8_t)i, (uint8_t)(i * 7 + (i >> 8)), (uint8_t)(i >> 8),
                                  (uint8_t)(i * 3)};
        memcpy(noise + 4 * i, texel, 4);
    }
    for (int encoding = DIP_ENCODING_SRGB; encoding <= DIP_ENCODING_LINEAR; encoding++) {
        for (int wrap = 0; wrap < DIP_WRAP_COUNT; wrap++) {
            DipTextureDef def = def_of(0, (DipEncoding)encoding, wrap, wrap);
            def.width = def.height = 256;
            DipTexture *texture = dip_texture_create(&def, NULL);
            assert_true(dip_texture_read(texture, 0, def.encoding, found, NULL));
            assert_memory_equal(found, noise, sizeof found);
            DipError err;
            assert_false(dip_texture_read(texture, 9, def.encoding, found, &err));
            assert_int_equal(err.code, DIP_ERROR_RANGE);
            assert_string_equal(err.key, "level");
            assert_false(dip_texture_read(texture, -1, def.encoding, found, &err));
            dip_texture_destroy(&texture);
        }
    }
}

static void coarser_levels_are_read_back_as_they_are(void **state) {
    (void)state;
    static uint8_t found[4 * MAX_SIZE * MAX_SIZE];
    fill_noise(8);
    for (int s = 0; s < SIZE_COUNT; s++) {
        const DipTextureDef def = def_of(s, DIP_ENCODING_LINEAR, s % 4, s / 2 % 4);
        Truth *truth = make_truth(&def);
        DipTexture *texture = dip_texture_create(&def, NULL);
        for (int l = 0; l < truth->level_count; l++) {
            assert_true(dip_texture_read(texture, l, DIP_ENCODING_LINEAR, found, NULL));
            for (int i = 0; i < truth->levels[l].width * truth->levels[l].height; i++) {
                for (int c = 0; c < 4; c++) {
                    assert_near(found[4 * i + c], truth->levels[l].texels[i][c] * 255.0, 0.8);
                }
            }
        }
        dip_texture_destroy(&texture);
        free(truth);
    }
}

// --- stored levels -------------------------------------------------------------------------------

static void stored_levels_keep_their_texels_and_alpha(void **state) {
    (void)state;
    static uint8_t found[4 * MAX_SIZE * MAX_SIZE];
    float alpha[LANES];
    fill_noise(9);
    DipTextureDef levels[4];
    for (int l = 0; l < 4; l++) {
        levels[l] = def_of(4, l % 2 ? DIP_ENCODING_LINEAR : DIP_ENCODING_SRGB, DIP_WRAP_MIRROR,
                           DIP_WRAP_BORDER);
        levels[l].width = 8 >> l;
        levels[l].height = 8 >> l;
        levels[l].rgba8 = noise + 400 * l;
    }
    DipTexture *texture = dip_texture_create_from_levels(levels, 4, NULL);
    assert_non_null(texture);
    for (int l = 0; l < 4; l++) {
        const size_t bytes = 4 * (size_t)(8 >> l) * (size_t)(8 >> l);
        assert_true(dip_texture_read(texture, l, levels[l].encoding, found, NULL));
        assert_memory_equal(found, levels[l].rgba8, bytes);
    }
    // At the centre of a texel of a level, the read is that texel.
    const DipSampler sampler = {.texture = texture, .max_anisotropy = 1};
    batch.count = LANES;
    for (int l = 0; l < 4; l++) {
        const int size = 8 >> l;
        for (int i = 0; i < LANES; i++) {
            batch.varying[0][i] = ((float)(i % size) + 0.5f) / (float)size;
            batch.varying[1][i] = ((float)(i / size % size) + 0.5f) / (float)size;
            batch.varying_dx[0][i] = (float)(1 << l) / 8.0f;
            batch.varying_dx[1][i] = batch.varying_dy[0][i] = batch.varying_dy[1][i] = 0.0f;
        }
        dip_kernels(dip_isa_best())->dip_kernel_sample_alpha(&batch, &sampler, 0, alpha);
        for (int i = 0; i < LANES; i++) {
            const int at = i / size % size * size + i % size;
            assert_near(alpha[i], levels[l].rgba8[4 * at + 3] / 255.0, 1e-6);
        }
    }
    dip_texture_destroy(&texture);
    DipError err;
    assert_null(dip_texture_create_from_levels(levels, 0, &err));
    assert_string_equal(err.key, "level_count");
    assert_null(dip_texture_create_from_levels(levels, DIP_MAX_LEVELS + 1, &err));
    assert_string_equal(err.key, "level_count");
}

// --- updates -------------------------------------------------------------------------------------

static void check_same_texels(const DipTexture *found, const DipTexture *expected) {
    assert_int_equal(found->texel_count, expected->texel_count);
    assert_memory_equal(found->texels, expected->texels,
                        expected->texel_count * sizeof *expected->texels);
    assert_true(found->alpha || !expected->alpha);
    for (size_t i = 0; found->alpha && i < found->texel_count; i++) {
        const DipAlphaPair opaque = {255, 255};
        const DipAlphaPair *alpha = expected->alpha ? &expected->alpha[i] : &opaque;
        assert_memory_equal(&found->alpha[i], alpha, sizeof *alpha);
    }
}

static void updates_equal_new_textures(void **state) {
    (void)state;
    static uint8_t patch[4 * MAX_SIZE * MAX_SIZE];
    Random random = {10};
    DipPool *pool = dip_pool_create(2, NULL);
    for (int round = 0; round < 160; round++) {
        fill_noise((uint64_t)round);
        const bool opaque = round % 3 == 0;
        for (int i = 0; opaque && i < MAX_SIZE * MAX_SIZE; i++) {
            noise[4 * i + 3] = 255;
        }
        // A border has the same alpha as an opaque picture in every third round.
        DipTextureDef def = def_of(round % SIZE_COUNT, (DipEncoding)(round / 8 % 2),
                                   random_int(&random, 0, 3), random_int(&random, 0, 3));
        def.border_rgba8[3] = opaque ? 255 : 70;
        DipTexture *texture = dip_texture_create(&def, NULL);
        DipTextureUpdate update = {.rgba8 = patch, .stride_bytes = (size_t)MAX_SIZE * 4};
        update.width = round % 5 ? random_int(&random, 1, def.width) : def.width;
        update.height = round % 5 ? random_int(&random, 1, def.height) : def.height;
        update.x = random_int(&random, 0, def.width - update.width);
        update.y = random_int(&random, 0, def.height - update.height);
        for (size_t i = 0; i < sizeof patch; i++) {
            patch[i] = i % 4 == 3 && round % 2 ? 255 : (uint8_t)random_u64(&random);
        }
        assert_true(dip_texture_update(texture, &update, round % 4 ? pool : NULL, NULL));
        for (int y = 0; y < update.height; y++) {
            memcpy(noise + 4 * ((update.y + y) * def.width + update.x), patch + 4 * MAX_SIZE * y,
                   4 * (size_t)update.width);
        }
        DipTexture *fresh = dip_texture_create(&def, NULL);
        check_same_texels(texture, fresh);
        dip_texture_destroy(&fresh);
        dip_texture_destroy(&texture);
    }
    dip_pool_destroy(&pool);
}

static void check_refused(DipTexture *texture, DipTextureUpdate update, DipErrorCode code,
                          const char *key) {
    DipError err;
    assert_false(dip_texture_update(texture, &update, NULL, &err));
    assert_int_equal(err.code, code);
    assert_string_equal(err.key, key);
}

static void bad_input_is_refused_by_name(void **state) {
    (void)state;
    fill_noise(11);
    DipTextureDef def = def_of(4, DIP_ENCODING_SRGB, DIP_WRAP_REPEAT, DIP_WRAP_CLAMP);
    DipTexture *texture = dip_texture_create(&def, NULL);
    DipTexture *before = dip_texture_create(&def, NULL);
    const DipTextureUpdate good = {0, 0, 8, 8, noise + 100, 32};
    DipTextureUpdate bad = good;
    bad.x = 1;
    check_refused(texture, bad, DIP_ERROR_RANGE, "width");
    bad = good;
    bad.y = -1;
    check_refused(texture, bad, DIP_ERROR_RANGE, "width");
    bad = good;
    bad.height = 0;
    check_refused(texture, bad, DIP_ERROR_RANGE, "width");
    bad = good;
    bad.width = INT32_MAX;
    check_refused(texture, bad, DIP_ERROR_RANGE, "width");
    bad = good;
    bad.stride_bytes = 31;
    check_refused(texture, bad, DIP_ERROR_RANGE, "stride_bytes");
    bad = good;
    bad.rgba8 = NULL;
    check_refused(texture, bad, DIP_ERROR_MISSING, "rgba8");
    check_same_texels(texture, before);
    DipTexture *stored = dip_texture_create_from_levels(&def, 1, NULL);
    check_refused(stored, good, DIP_ERROR_CONFLICT, "texture");
    DipTexture *compressed = NULL;
    assert_true(dip_textures_compress(&texture, &(bool){true}, 1, NULL, &compressed, NULL));
    check_refused(compressed, good, DIP_ERROR_CONFLICT, "texture");
    dip_texture_destroy(&compressed);
    dip_texture_destroy(&stored);
    dip_texture_destroy(&before);
    dip_texture_destroy(&texture);

    DipError err;
    def.wrap_v = DIP_WRAP_COUNT;
    assert_null(dip_texture_create(&def, &err));
    assert_int_equal(err.code, DIP_ERROR_RANGE);
    assert_string_equal(err.key, "wrap_v");
    def.wrap_v = DIP_WRAP_CLAMP;
    def.rgba8 = NULL;
    assert_null(dip_texture_create(&def, &err));
    assert_int_equal(err.code, DIP_ERROR_MISSING);
    assert_string_equal(err.key, "rgba8");
}

// A texture with a border can be compressed: the border keeps its colour.
static void compressed_textures_keep_their_border(void **state) {
    (void)state;
    fill_noise(12);
    const DipTextureDef def = def_of(5, DIP_ENCODING_SRGB, DIP_WRAP_BORDER, DIP_WRAP_BORDER);
    DipTexture *texture = dip_texture_create(&def, NULL);
    DipTexture *compressed = NULL;
    assert_true(dip_textures_compress(&texture, &(bool){true}, 1, NULL, &compressed, NULL));
    float colour[3][LANES];
    float alpha[LANES];
    memset(&batch, 0, sizeof batch);
    batch.count = LANES;
    for (int i = 0; i < LANES; i++) {
        batch.varying[i % 2][i] = i % 4 < 2 ? -0.1f - (float)i : 1.1f + (float)i;
    }
    const DipSampler sampler = {.texture = compressed, .max_anisotropy = 1};
    dip_kernels(dip_isa_best())->dip_kernel_sample_colour(&batch, &sampler, 0, colour);
    dip_kernels(dip_isa_best())->dip_kernel_sample_alpha(&batch, &sampler, 0, alpha);
    for (int i = 0; i < LANES; i++) {
        for (int c = 0; c < 3; c++) {
            assert_near(colour[c][i], decode(&def, border, c), 0.002);
        }
        assert_near(alpha[i], border[3] / 255.0, 1e-6);
    }
    dip_texture_destroy(&compressed);
    dip_texture_destroy(&texture);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_follow_the_definition),
        cmocka_unit_test(a_transparent_border_gives_alpha),
        cmocka_unit_test(coordinates_that_are_not_numbers_stay_inside),
        cmocka_unit_test(level_0_is_read_back_exactly),
        cmocka_unit_test(coarser_levels_are_read_back_as_they_are),
        cmocka_unit_test(stored_levels_keep_their_texels_and_alpha),
        cmocka_unit_test(updates_equal_new_textures),
        cmocka_unit_test(bad_input_is_refused_by_name),
        cmocka_unit_test(compressed_textures_keep_their_border),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
