// Tests alpha to coverage: how many samples a surface keeps, against the closed form of a plane of
// alpha, and which ones, against all orders of a pattern's samples.
#include "renderer/catalogue/random.h"
#include "renderer/pipeline/pipeline.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { SIDE = 8, AT = 4, TEXELS = 16, STEP = 16, GRADIENTS = 10000 };

static uint8_t picture[SIDE][SIDE][4];

// How much alpha grows from column to column and from row to row of a ramp, in 1/255.
typedef struct Ramp {
    DipWrap wrap;
    int step[2];
} Ramp;

static const Ramp ramps[] = {{DIP_WRAP_REPEAT, {STEP, 0}}, {DIP_WRAP_MIRROR, {10, 6}}};

enum { RAMPS = sizeof ramps / sizeof *ramps };

// A plane of alpha over the picture, and what the clip shader does with it.
typedef struct Plane {
    int ramp; // index of the texture
    // Texture coordinates, in texels, are `middle` in the middle of pixel (AT, AT), in copy `lap`
    // of the texture, and change by `per_x` and `per_y` from pixel to pixel. In odd copies, which
    // are mirrored, `middle` is the place within the texture.
    double middle[2];
    int lap[2];
    double per_x[2];
    double per_y[2];
    float cutoff;
    int samples;
} Plane;

static void vertex_shader(const DipVertexBatch *batch) {
    const Plane *plane = batch->uniforms;
    for (int i = 0; i < batch->count; i++) {
        const double x = (double)batch->in[0][i], y = (double)batch->in[1][i]; // in pixels
        batch->clip[0][i] = (float)(2.0 * x / SIDE - 1.0);
        batch->clip[1][i] = (float)(1.0 - 2.0 * y / SIDE);
        batch->clip[2][i] = batch->in[2][i];
        batch->clip[3][i] = 1.0f;
        for (int k = 0; k < 2; k++) {
            const double place = plane->lap[k] % 2 ? TEXELS - plane->middle[k] : plane->middle[k];
            const double texels = plane->lap[k] * TEXELS + place +
                                  (x - (AT + 0.5)) * plane->per_x[k] +
                                  (y - (AT + 0.5)) * plane->per_y[k];
            batch->varying[k][i] = (float)(texels / TEXELS);
        }
    }
}

static void clip_shader(DipFragmentBatch *batch) {
    const Plane *plane = batch->uniforms;
    float alpha[DIP_FRAGMENT_BATCH], slope[DIP_FRAGMENT_BATCH];
    batch->sample_alpha_slope(batch, &batch->samplers[0], 0, alpha, slope);
    for (int i = 0; i < batch->count; i++) {
        batch->keep[i] =
            (uint8_t)dip_alpha_to_coverage(alpha[i], slope[i], plane->cutoff, plane->samples);
    }
}

static void white(DipFragmentBatch *batch) {
    for (int c = 0; c < 3; c++) {
        for (int i = 0; i < batch->count; i++) {
            batch->colour[c][i] = 1.0f;
        }
    }
}

// Makes the texture of a ramp. Its mip levels lie on the same plane.
static DipTexture *make_ramp(const Ramp *ramp) {
    static uint8_t rgba8[TEXELS][TEXELS][4];
    for (int y = 0; y < TEXELS; y++) {
        for (int x = 0; x < TEXELS; x++) {
            memset(rgba8[y][x], 255, 3);
            rgba8[y][x][3] = (uint8_t)(ramp->step[0] * x + ramp->step[1] * y);
        }
    }
    const DipTextureDef def = {.name = "ramp",
                               .width = TEXELS,
                               .height = TEXELS,
                               .rgba8 = &rgba8[0][0][0],
                               .wrap_u = ramp->wrap,
                               .wrap_v = ramp->wrap};
    DipTexture *texture = dip_texture_create(&def, NULL);
    assert_non_null(texture);
    return texture;
}

// Makes a triangle that covers the picture, at a depth.
static DipMesh *make_cover(float depth) {
    const float vertices[3][3] = {{-8, -8, depth}, {-8, 40, depth}, {40, -8, depth}};
    static const uint32_t indices[3] = {0, 1, 2};
    DipMesh *mesh =
        dip_mesh_create(&(DipMeshData){"cover", &vertices[0][0], 3, 3, indices, 3}, NULL);
    assert_non_null(mesh);
    return mesh;
}

typedef struct Bench {
    DipPipeline *pipeline;
    DipTexture *ramps[RAMPS];
    DipMesh *front;
    DipMesh *back;
} Bench;

static void open_bench(Bench *bench, DipIsa isa) {
    bench->pipeline = dip_pipeline_create(NULL, isa, SIDE, SIDE, NULL);
    for (int i = 0; i < RAMPS; i++) {
        bench->ramps[i] = make_ramp(&ramps[i]);
    }
    bench->front = make_cover(0.5f);
    bench->back = make_cover(0.25f);
    assert_non_null(bench->pipeline);
}

static void close_bench(Bench *bench) {
    dip_pipeline_destroy(&bench->pipeline);
    for (int i = 0; i < RAMPS; i++) {
        dip_texture_destroy(&bench->ramps[i]);
    }
    dip_mesh_destroy(&bench->front);
    dip_mesh_destroy(&bench->back);
}

// Draws the plane before an opaque surface, and returns the samples of pixel (AT, AT) that show the
// plane. Checks that the others show the surface behind it.
static unsigned draw(const Bench *bench, const Plane *plane, DipPatternKind kind, int anisotropy) {
    DipSampleValue samples[DIP_READBACK_STRIDE] = {{.patch = 0}};
    const DipSampleReadback readback = {{AT, AT, AT + 1, AT + 1}, samples};
    const DipSampler sampler = {.texture = bench->ramps[plane->ramp], .max_anisotropy = anisotropy};
    const DipDraw draws[2] = {{.mesh = bench->front,
                               .vertex_shader = vertex_shader,
                               .fragment_shader = white,
                               .clip_shader = clip_shader,
                               .varying_count = 2,
                               .clip_varying_count = 2,
                               .uniforms = plane,
                               .samplers = &sampler},
                              {.mesh = bench->back,
                               .vertex_shader = vertex_shader,
                               .fragment_shader = white,
                               .uniforms = plane}};
    const DipPass pass = {.draws = draws,
                          .draw_count = 2,
                          .sample_count = plane->samples,
                          .pattern = kind,
                          .alpha_to_coverage = true,
                          .target = {.rgba8 = &picture[0][0][0],
                                     .stride_bytes = SIDE * 4,
                                     .width = SIDE,
                                     .height = SIDE},
                          .readback = &readback};
    assert_true(dip_pipeline_draw(bench->pipeline, &pass, NULL, NULL, NULL));
    unsigned held = 0;
    for (int s = 0; s < plane->samples; s++) {
        held |= (unsigned)(samples[s].depth == 0.5f) << s;
        assert_true(samples[s].depth == 0.5f || samples[s].depth == 0.25f);
    }
    return held;
}

// Chooses a plane whose gradient is at most two texels per pixel in each direction. All texels that
// are read lie on the plane: no read wraps from the last column to the first.
static Plane random_plane(Random *random, int samples) {
    Plane plane = {.samples = samples, .cutoff = (float)random_real(random, 0.3, 0.7)};
    const double size = random_real(random, 0.05, 1.4);
    for (int k = 0; k < 2; k++) {
        plane.per_x[k] = random_real(random, -size, size);
        plane.per_y[k] = random_real(random, -size, size);
    }
    // Most planes cross the cutoff in or near the pixel.
    const double slope = fabs(plane.per_x[0]) + fabs(plane.per_y[0]);
    const double edge = (double)plane.cutoff * 255.0 / STEP + 0.5;
    const double at = edge + random_real(random, -0.7, 0.7) * fmax(slope, 0.02 * 255.0 / STEP);
    // A multiple of 1/256 texel, and a little more, since positions are rounded down to such ones.
    plane.middle[0] = floor(at * 256.0) / 256.0 + 1.0 / 1024.0;
    plane.middle[1] = random_int(random, 0, 16 * 256) / 256.0 + 1.0 / 1024.0;
    return plane;
}

// Returns how fast alpha changes along both axes of the screen, |d alpha / dx| + |d alpha / dy|.
static double slope_of(const Plane *plane) {
    double by_x = 0.0, by_y = 0.0;
    for (int k = 0; k < 2; k++) {
        const double per_texel = ramps[plane->ramp].step[k] / 255.0;
        const double by_coordinate = plane->lap[k] % 2 ? -per_texel : per_texel;
        by_x += by_coordinate * plane->per_x[k];
        by_y += by_coordinate * plane->per_y[k];
    }
    return fmax(fabs(by_x) + fabs(by_y), 0.02);
}

static double alpha_of(const Plane *plane) {
    double alpha = 0.0;
    for (int k = 0; k < 2; k++) {
        const double texel = floor(plane->middle[k] * 256.0) / 256.0 - 0.5;
        alpha += ramps[plane->ramp].step[k] / 255.0 * texel;
    }
    return alpha;
}

// Chooses a plane in a copy of the mirrored ramp, with a gradient as random_plane chooses it. Both
// axes change alpha, so that their changes add up in some copies and cancel in others.
static Plane random_mirrored_plane(Random *random, int samples) {
    Plane plane = random_plane(random, samples);
    plane.ramp = 1;
    for (int k = 0; k < 2; k++) {
        plane.lap[k] = random_int(random, -3, 3);
        plane.middle[k] = random_int(random, 4 * 256, 12 * 256) / 256.0 + 1.0 / 1024.0;
    }
    plane.cutoff = (float)(alpha_of(&plane) + random_real(random, -0.7, 0.7) * slope_of(&plane));
    return plane;
}

// The share of a pixel that an edge at the cutoff leaves to the surface.
static double share_of(const Plane *plane) {
    const double share = (alpha_of(plane) - (double)plane->cutoff) / slope_of(plane) + 0.5;
    return fmin(fmax(share, 0.0), 1.0);
}

static unsigned first_samples(const DipSamplePattern *pattern, int count) {
    unsigned samples = 0;
    for (int i = 0; i < count; i++) {
        samples |= 1u << pattern->order[i];
    }
    return samples;
}

typedef Plane ChoosePlane(Random *random, int samples);

static void check_coverage(ChoosePlane *choose) {
    static const int counts[] = {1, 2, 4, 6, 8};
    for (int isa = 0; isa < DIP_ISA_COUNT; isa++) {
        if (!dip_isa_available((DipIsa)isa)) {
            continue;
        }
        Bench bench;
        Random random = {2007};
        double sum = 0.0;
        int partly = 0;
        open_bench(&bench, (DipIsa)isa);
        for (int i = 0; i < GRADIENTS; i++) {
            const int samples = counts[i % 5];
            const DipPatternKind kind = (DipPatternKind)(i / 5 % DIP_PATTERN_KINDS);
            const Plane plane = choose(&random, samples);
            const unsigned held = draw(&bench, &plane, kind, i % 2 ? 1 : 8);
            const int count = __builtin_popcount(held);
            const double share = share_of(&plane);
            // The slope is rounded to 1/65536, and levels between two whole ones round alpha.
            assert_true(fabs((double)count / samples - share) <= 0.5 / samples + 0.02);
            assert_int_equal(held, first_samples(dip_sample_pattern_of(samples, kind), count));
            sum += samples > 1 ? (double)count / samples - share : 0.0;
            partly += count > 0 && count < samples;
        }
        close_bench(&bench);
        assert_true(fabs(sum / GRADIENTS) < 0.002);
        assert_true(partly > GRADIENTS / 10);
    }
}

static void coverage_is_within_half_a_sample_of_alpha(void **state) {
    (void)state;
    check_coverage(random_plane);
}

static void so_it_is_in_mirrored_copies(void **state) {
    (void)state;
    check_coverage(random_mirrored_plane);
}

// With one sample, the rule is the alpha test.
static void one_sample_is_the_alpha_test(void **state) {
    (void)state;
    Random random = {11};
    for (int i = 0; i < 1000000; i++) {
        const float cutoff = (float)random_real(&random, 0.0, 1.0);
        float alpha = (float)random_real(&random, 0.0, 1.0);
        for (int step = random_int(&random, 0, 5); step < 3; step++) {
            alpha = step == 0 ? cutoff : step == 1 ? nextafterf(cutoff, 0.0f) : alpha;
        }
        const float slope = (float)exp2(random_real(&random, -20.0, 40.0));
        assert_int_equal(dip_alpha_to_coverage(alpha, slope, cutoff, 1), alpha >= cutoff);
    }
    assert_int_equal(dip_alpha_to_coverage(0.5f, (float)NAN, 0.5f, 1), 1);
    assert_int_equal(dip_alpha_to_coverage(0.5f, (float)INFINITY, 0.5f, 8), 4);
}

// A surface far above the cutoff covers all samples and one far below it covers none, also where
// the difference does not fit in an integer. Where it is NaN, the surface covers none.
static void any_numbers_cover_all_or_none(void **state) {
    (void)state;
    static const float slopes[] = {0.0f, 0.02f, 1.0f, 1024.0f, 1e30f, INFINITY, NAN, -1.0f};
    static const float far[] = {600.0f, 1.5e4f, 32768.0f, 70000.0f, 1e9f, 1e30f, INFINITY};
    for (int samples = 1; samples <= DIP_MAX_SAMPLES; samples++) {
        for (size_t s = 0; s < sizeof slopes / sizeof *slopes; s++) {
            const float slope = slopes[s];
            for (size_t i = 0; i < sizeof far / sizeof *far; i++) {
                assert_int_equal(dip_alpha_to_coverage(far[i], slope, 0.5f, samples), samples);
                assert_int_equal(dip_alpha_to_coverage(-far[i], slope, 0.5f, samples), 0);
                assert_int_equal(dip_alpha_to_coverage(0.5f, slope, far[i], samples), 0);
                assert_int_equal(dip_alpha_to_coverage(0.5f, slope, -far[i], samples), samples);
            }
            assert_int_equal(dip_alpha_to_coverage(NAN, slope, 0.5f, samples), 0);
            assert_int_equal(dip_alpha_to_coverage(0.5f, slope, NAN, samples), 0);
            assert_int_equal(dip_alpha_to_coverage(INFINITY, slope, INFINITY, samples), 0);
        }
    }
}

// --- the order of samples ------------------------------------------------------------------------

typedef struct Search {
    const DipSamplePattern *pattern;
    double least; // least sum of an order
    bool used[DIP_MAX_SAMPLES];
} Search;

static double add_sample(const DipSamplePattern *pattern, int sample, int count, int sum[2]) {
    sum[0] += pattern->x[sample] - 128;
    sum[1] += pattern->y[sample] - 128;
    return (double)(sum[0] * sum[0] + sum[1] * sum[1]) / (count * count);
}

static void try_orders(Search *search, int count, const int sum[2], double cost) {
    if (count == search->pattern->count) {
        search->least = fmin(search->least, cost);
        return;
    }
    for (int s = 0; s < search->pattern->count; s++) {
        if (!search->used[s]) {
            int with[2] = {sum[0], sum[1]};
            const double more = add_sample(search->pattern, s, count + 1, with);
            search->used[s] = true;
            try_orders(search, count + 1, with, cost + more);
            search->used[s] = false;
        }
    }
}

static void the_first_samples_stay_nearest_to_the_centre(void **state) {
    (void)state;
    static const int counts[] = {1, 2, 4, 6, 8};
    for (int kind = 0; kind < DIP_PATTERN_KINDS; kind++) {
        for (int i = 0; i < 5; i++) {
            const DipSamplePattern *pattern =
                dip_sample_pattern_of(counts[i], (DipPatternKind)kind);
            Search search = {.pattern = pattern, .least = INFINITY};
            int sum[2] = {0, 0};
            unsigned met = 0;
            double cost = 0.0;
            try_orders(&search, 0, sum, 0.0);
            for (int s = 0; s < counts[i]; s++) {
                met |= 1u << pattern->order[s];
                cost += add_sample(pattern, pattern->order[s], s + 1, sum);
            }
            assert_int_equal(met, (1u << counts[i]) - 1);
            assert_true(cost <= search.least + 1e-9);
        }
    }
}

static void groups_and_alpha_to_coverage_exclude_each_other(void **state) {
    (void)state;
    Bench bench;
    DipError err = {0};
    open_bench(&bench, dip_isa_best());
    const DipPass pass = {
        .sample_count = 4,
        .samples_per_group = 2,
        .alpha_to_coverage = true,
        .target = {
            .rgba8 = &picture[0][0][0], .stride_bytes = SIDE * 4, .width = SIDE, .height = SIDE}};
    assert_false(dip_pipeline_draw(bench.pipeline, &pass, NULL, NULL, &err));
    assert_int_equal(err.code, DIP_ERROR_CONFLICT);
    assert_string_equal(err.key, "alpha_to_coverage");
    close_bench(&bench);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(coverage_is_within_half_a_sample_of_alpha),
        cmocka_unit_test(so_it_is_in_mirrored_copies),
        cmocka_unit_test(one_sample_is_the_alpha_test),
        cmocka_unit_test(any_numbers_cover_all_or_none),
        cmocka_unit_test(the_first_samples_stay_nearest_to_the_centre),
        cmocka_unit_test(groups_and_alpha_to_coverage_exclude_each_other),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
