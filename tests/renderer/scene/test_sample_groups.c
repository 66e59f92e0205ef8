// Tests the sample patterns of temporal AA and the sample groups of adaptive AA. (Adaptive AA
// divides the samples of a pixel into groups and shades clipped surfaces once per group.) Compares
// pictures with coverage computed in exact integers and with shading computed in this file.
#include "renderer/base/srgb.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/reference/reference.h"
#include "renderer/catalogue/oracle.h"
#include "tests/renderer/pipeline/screen.h"
#include "tests/renderer/scene/stage.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/renderer/pipeline/near.h"

enum { SIDE = DIP_SCREEN, PIXELS = SIDE * SIDE }; // one tile

static const DipOracleRegion region = {0, 0, SIDE, SIDE};

// The allowed pairs of samples per pixel and samples per group, from the table in docs/picture.md,
// Adaptive AA.
static const int pairs[][2] = {{1, 1}, {2, 1}, {2, 2}, {4, 1}, {4, 2}, {6, 1},
                               {6, 2}, {6, 3}, {8, 1}, {8, 2}, {8, 4}};
enum { PAIRS = sizeof pairs / sizeof pairs[0] };

// --- tables ------------------------------------------------------------------------------------

// The samples of both patterns of temporal antialiasing. Positions are in units of 1/steps pixel.
typedef struct Union {
    int count; // samples of each pattern
    int steps;
    int places[16][2];
} Union;

static const Union unions[] = {
    {2, 16, {{6, 2}, {14, 6}, {2, 10}, {10, 14}}}, // together, the standard pattern of 4 samples
    {4, 16, {{1, 7}, {3, 11}, {5, 3}, {7, 15}, {9, 1}, {11, 13}, {13, 5}, {15, 9}}},
    {6,
     24,
     {{1, 19},
      {3, 15},
      {5, 1},
      {7, 13},
      {9, 3},
      {11, 7},
      {13, 17},
      {15, 21},
      {17, 11},
      {19, 23},
      {21, 9},
      {23, 5}}},
    {8,
     256,
     {{8, 104},
      {24, 184},
      {40, 216},
      {56, 56},
      {72, 24},
      {88, 120},
      {104, 248},
      {120, 168},
      {136, 88},
      {152, 8},
      {168, 136},
      {184, 232},
      {200, 200},
      {216, 40},
      {232, 72},
      {248, 152}}},
};
enum { UNIONS = sizeof unions / sizeof unions[0] };

static int union_place(const Union *both, int i, int axis) {
    return (int)lround(both->places[i][axis] * 256.0 / both->steps);
}

static void temporal_patterns_have_a_sample_per_row_and_column(void **state) {
    (void)state;
    for (int u = 0; u < UNIONS; u++) {
        const int count = unions[u].count;
        bool met[16] = {false};
        for (int frame = 0; frame < 2; frame++) {
            const DipSamplePattern *pattern =
                dip_sample_pattern_of(count, dip_pattern_kind(true, (uint64_t)frame));
            int sum[2] = {0};
            unsigned rows[2] = {0};
            for (int s = 0; s < count; s++) {
                const int at[2] = {pattern->x[s], pattern->y[s]};
                for (int axis = 0; axis < 2; axis++) {
                    sum[axis] += at[axis];
                    rows[axis] |= 1u << at[axis] * count / 256;
                }
                for (int i = 0; i < 2 * count; i++) {
                    met[i] |= at[0] == union_place(&unions[u], i, 0) &&
                              at[1] == union_place(&unions[u], i, 1);
                }
            }
            for (int axis = 0; axis < 2; axis++) {
                assert_int_equal(sum[axis], 128 * count);
                assert_int_equal(rows[axis], (1u << count) - 1);
            }
        }
        for (int i = 0; i < 2 * count; i++) {
            assert_true(met[i]);
        }
    }
    assert_ptr_equal(dip_sample_pattern(4), dip_sample_pattern_of(4, dip_pattern_kind(false, 1)));
    assert_int_equal(dip_sample_pattern_of(1, DIP_PATTERN_ODD)->x[0], 128);
}

static void sample_groups_divide_all_samples_and_lie_apart(void **state) {
    (void)state;
    for (int i = 0; i < PAIRS * DIP_PATTERN_KINDS; i++) {
        const int *pair = pairs[i % PAIRS];
        const DipSamplePattern *pattern =
            dip_sample_pattern_of(pair[0], (DipPatternKind)(i / PAIRS));
        static DipSampleGroups groups;
        assert_true(dip_sample_groups_exist(pair[0], pair[1]));
        dip_sample_groups_make(&groups, pattern, pair[1]);
        assert_int_equal(groups.count, pair[0] / pair[1]);
        unsigned all = 0;
        int sum[2] = {0};
        for (int p = 0; p < groups.count; p++) {
            assert_int_equal(__builtin_popcount(groups.samples[p]), pair[1]);
            assert_int_equal(all & groups.samples[p], 0);
            all |= groups.samples[p];
            const int at = groups.centroid[groups.samples[p]];
            sum[0] += at & 255;
            sum[1] += at >> 8;
            for (int q = 0; q < p; q++) {
                const int other = groups.centroid[groups.samples[q]];
                const double distance = hypot((at & 255) - (other & 255), (at >> 8) - (other >> 8));
                assert_true(distance >= 64.0); // a quarter of a pixel
            }
            for (int s = 0; s < pair[0]; s++) {
                assert_true(!(groups.samples[p] >> s & 1) ||
                            groups.sharing[s] == groups.samples[p]);
            }
        }
        assert_int_equal(all, (1 << pair[0]) - 1);
        for (int axis = 0; axis < 2; axis++) { // positions are rounded down
            assert_true(abs(sum[axis] - 128 * groups.count) <= groups.count);
        }
    }
}

// --- temporal antialiasing ---------------------------------------------------------------------

enum { TRIANGLES = 5 };

// Makes white triangles on black. Counts, for each pixel, how many samples of both patterns
// together the triangles cover.
static void make_triangles(Random *random, const Union *both, DipTestScene *scene,
                           int covered[PIXELS]) {
    dip_screen_begin(scene);
    const int material = dip_screen_add_white(scene);
    static uint8_t masks[2][TRIANGLES][PIXELS];
    for (int t = 0; t < TRIANGLES; t++) {
        DipOracleTriangle triangle;
        DipScreenPoint points[3];
        for (int i = 0; i < 3; i++) {
            triangle.x[i] = random_int(random, -4 * 256, (SIDE + 4) * 256);
            triangle.y[i] = random_int(random, -4 * 256, (SIDE + 4) * 256);
            points[i] = (DipScreenPoint){triangle.x[i] / 256.0, triangle.y[i] / 256.0, 1.0};
        }
        dip_screen_add_polygon(scene, material, points, 3, 0);
        for (int half = 0; half < 2; half++) {
            DipSamplePattern pattern = {.count = both->count};
            for (int s = 0; s < both->count; s++) {
                pattern.x[s] = (uint8_t)union_place(both, half * both->count + s, 0);
                pattern.y[s] = (uint8_t)union_place(both, half * both->count + s, 1);
            }
            dip_oracle_cover(&triangle, &pattern, &region, masks[half][t]);
        }
    }
    for (int p = 0; p < PIXELS; p++) {
        unsigned held[2] = {0};
        for (int t = 0; t < TRIANGLES; t++) {
            held[0] |= masks[0][t][p];
            held[1] |= masks[1][t][p];
        }
        covered[p] = __builtin_popcount(held[0]) + __builtin_popcount(held[1]);
    }
}

// Draws a frame with the fast renderer and adds the number of white samples of each pixel to found.
// This number follows exactly from the pixel's 8-bit value.
static void add_fast_frame(const DipTestScene *scene, const DipQuality *quality, int frame_index,
                           int found[PIXELS]) {
    DipRendererDef def = stage_def(SIDE, SIDE, "");
    def.quality = *quality;
    Stage stage = stage_open(&scene->def, def, 1);
    dip_renderer_set_frame_index(stage.renderer, (uint64_t)frame_index);
    const DipFrame frame = stage_draw(&stage, &scene->pose, 0);
    for (int p = 0; p < PIXELS; p++) {
        const int code = *dip_image_pixel(&frame, p % SIDE, p / SIDE);
        found[p] += (int)lround(dip_srgb_decode(code / 255.0) * dip_quality_sample_count(quality));
    }
    stage_close(&stage);
}

static void the_mean_of_two_frames_has_the_samples_of_both_patterns(void **state) {
    (void)state;
    static DipTestScene scene;
    static int covered[PIXELS];
    static int found[PIXELS];
    static double pictures[2][PIXELS][3];
    Random random = {77};
    for (int i = 0; i < 3 * UNIONS; i++) {
        const Union *both = &unions[i % UNIONS];
        DipQuality quality = dip_quality_default();
        quality.step[DIP_SETTING_AA] = (uint8_t)(both->count / 2);
        quality.step[DIP_SETTING_TAA] = 1;
        make_triangles(&random, both, &scene, covered);
        DipReference *reference = dip_reference_create(&scene.def, NULL);
        memset(found, 0, sizeof found);
        for (int f = 0; f < 2; f++) {
            dip_reference_set_frame_index(reference, (uint64_t)(i + f));
            assert_true(dip_reference_draw(reference, &quality, &scene.pose, SIDE, SIDE,
                                           &pictures[f][0][0], NULL));
            add_fast_frame(&scene, &quality, i + f, found);
        }
        for (int p = 0; p < PIXELS; p++) {
            assert_near((pictures[0][p][0] + pictures[1][p][0]) / 2,
                        covered[p] / (2.0 * both->count), 1e-12);
            assert_int_equal(found[p], covered[p]);
        }
        dip_reference_destroy(&reference);
        dip_test_scene_free(&scene);
    }
}

// --- adaptive antialiasing ---------------------------------------------------------------------

static void vertex_shader(const DipVertexBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        for (int c = 0; c < 3; c++) {
            batch->clip[c][i] = batch->in[c][i];
        }
        batch->clip[3][i] = 1.0f;
    }
}

static void black(DipFragmentBatch *batch) {
    memset(batch->colour, 0, sizeof batch->colour);
}

// Red and green hold the square of the position within the pixel. Because of the squares, the mean
// over the sample groups differs from the value at the centre.
static void place_as_colour(DipFragmentBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        const float x = batch->x[i] - (float)(int)batch->x[i];
        const float y = batch->y[i] - (float)(int)batch->y[i];
        batch->colour[0][i] = x * x;
        batch->colour[1][i] = y * y;
        batch->colour[2][i] = 1.0f;
    }
}

// Returns the result of a clip test at a position, in units of 1/256 pixel. The result depends on
// every bit of the position.
static bool is_there(int x, int y) {
    return ((uint32_t)(x * 40503 + y * 10007) * 2654435761u) >> 31;
}

static void ask(DipFragmentBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        batch->keep[i] = is_there((int)(batch->x[i] * 256.0f), (int)(batch->y[i] * 256.0f));
    }
}

static DipMesh *mesh_of(const DipOracleTriangle *triangle, float z) {
    float positions[3][3];
    for (int i = 0; i < 3; i++) {
        positions[i][0] = (float)triangle->x[i] / (SIDE / 2 * 256.0f) - 1.0f;
        positions[i][1] = 1.0f - (float)triangle->y[i] / (SIDE / 2 * 256.0f);
        positions[i][2] = z;
    }
    const DipMeshData data = {"test", &positions[0][0], 3, 3, (const uint32_t[]){0, 1, 2}, 3};
    return dip_mesh_create(&data, NULL);
}

typedef struct Expected {
    double rgb[PIXELS][3];
    uint64_t asked;
    uint64_t whole; // number of samples that the clipped triangle covers
} Expected;

// Computes the mean position of some samples, in units of 1/256 pixel, rounded down.
static void centroid_of(const DipSamplePattern *pattern, unsigned samples, int at[2]) {
    int n = 0;
    at[0] = at[1] = 0;
    for (int s = 0; s < pattern->count; s++) {
        if (samples >> s & 1) {
            at[0] += pattern->x[s];
            at[1] += pattern->y[s];
            n++;
        }
    }
    at[0] /= n;
    at[1] /= n;
}

// Computes the expected picture of a clipped triangle behind an opaque one that is drawn first.
static void expect(const DipSamplePattern *pattern, int samples_per_group, const uint8_t *front,
                   const uint8_t *clipped, Expected *out) {
    static DipSampleGroups groups;
    dip_sample_groups_make(&groups, pattern, samples_per_group);
    memset(out, 0, sizeof *out);
    for (int p = 0; p < PIXELS; p++) {
        for (int i = 0; i < groups.count; i++) {
            const unsigned covered = clipped[p] & groups.samples[i];
            const unsigned held = covered & (unsigned)~front[p];
            int at[2];
            out->whole += (uint64_t)__builtin_popcount(covered);
            if (!held) {
                continue;
            }
            out->asked++;
            centroid_of(pattern, covered, at);
            if (!is_there(p % SIDE * 256 + at[0], p / SIDE * 256 + at[1])) {
                continue;
            }
            centroid_of(pattern, held, at);
            const double weight = (double)__builtin_popcount(held) / pattern->count;
            out->rgb[p][0] += weight * at[0] * at[0] / 65536.0;
            out->rgb[p][1] += weight * at[1] * at[1] / 65536.0;
            out->rgb[p][2] += weight;
        }
    }
}

static uint8_t picture[PIXELS * 4];

static DipPipelineCounters run(DipIsa isa, const DipDraw *draws, int count, const int *pair,
                               DipPatternKind kind) {
    const DipPass pass = {
        .draws = draws,
        .draw_count = count,
        .sample_count = pair[0],
        .pattern = kind,
        .samples_per_group = pair[1],
        .target = {
            .rgba8 = picture, .stride_bytes = (size_t)SIDE * 4, .width = SIDE, .height = SIDE}};
    DipPipelineCounters counters = {0};
    DipStageTimes times = {0};
    DipPool *pool = dip_pool_create(1, NULL);
    DipPipeline *pipeline = dip_pipeline_create(pool, isa, SIDE, SIDE, NULL);
    assert_non_null(pipeline);
    assert_true(dip_pipeline_draw(pipeline, &pass, &counters, &times, NULL));
    dip_pipeline_destroy(&pipeline);
    dip_pool_destroy(&pool);
    return counters;
}

static void check_picture(const Expected *expected) {
    static DipSrgbEncodeTable table;
    dip_srgb_encode_table(&table);
    for (int p = 0; p < PIXELS; p++) {
        for (int c = 0; c < 3; c++) {
            const int code =
                dip_srgb_code(&table, (int32_t)lround(expected->rgb[p][c] * DIP_LINEAR16_MAX));
            assert_in_range(picture[4 * p + c] + 1, code,
                            code + 2); // the value is rounded twice, first to 16 bits
        }
    }
}

// Tests every pair that gives several groups, with every pattern, on random triangles.
static void every_sample_group_is_clipped_and_shaded_at_its_centroid(void **state) {
    (void)state;
    static uint8_t masks[2][PIXELS];
    static Expected expected;
    Random random = {5};
    for (int t = 0; t < 8 * PAIRS * DIP_PATTERN_KINDS; t++) {
        const int *pair = pairs[t % PAIRS];
        const DipPatternKind kind = (DipPatternKind)(t / PAIRS % DIP_PATTERN_KINDS);
        const DipSamplePattern *pattern = dip_sample_pattern_of(pair[0], kind);
        if (pair[0] == pair[1]) {
            continue; // the next test shows that one group equals drawing without groups
        }
        DipMesh *meshes[2];
        for (int i = 0; i < 2; i++) {
            const DipOracleTriangle triangle =
                dip_oracle_make((DipOracleKind)random_int(&random, 0, DIP_ORACLE_KINDS - 1),
                                &random, pattern, &region, 1 << 18);
            dip_oracle_cover(&triangle, pattern, &region, masks[i]);
            meshes[i] = mesh_of(&triangle, i ? 0.25f : 0.5f);
            assert_non_null(meshes[i]);
        }
        const DipDraw draws[2] = {
            {.mesh = meshes[0], .vertex_shader = vertex_shader, .fragment_shader = black},
            {.mesh = meshes[1],
             .vertex_shader = vertex_shader,
             .fragment_shader = place_as_colour,
             .clip_shader = ask}};
        expect(pattern, pair[1], masks[0], masks[1], &expected);
        for (int isa = 0; isa < DIP_ISA_COUNT; isa++) {
            if (dip_isa_available((DipIsa)isa)) {
                const DipPipelineCounters counters = run((DipIsa)isa, draws, 2, pair, kind);
                check_picture(&expected);
                assert_int_equal(counters.fragments_clip_tested, expected.asked);
                assert_true(!expected.whole ||
                            counters.clip_sample_groups == (uint64_t)(pair[0] / pair[1]));
            }
        }
        dip_mesh_destroy(&meshes[0]);
        dip_mesh_destroy(&meshes[1]);
    }
}

// Opaque surfaces, and clipped surfaces with one group per pixel, take the same work and give the
// same picture as without adaptive AA.
static void one_sample_group_takes_no_extra_work(void **state) {
    (void)state;
    static uint8_t plain[sizeof picture];
    const DipOracleTriangle triangle = {{500, 16000, 3000}, {700, 4000, 15000}};
    DipMesh *mesh = mesh_of(&triangle, 0.5f);
    for (int i = 0; i < PAIRS; i++) {
        for (int clipped = 0; clipped < 2; clipped++) {
            if (clipped && pairs[i][0] != pairs[i][1]) {
                continue;
            }
            const DipDraw draw = {.mesh = mesh,
                                  .vertex_shader = vertex_shader,
                                  .fragment_shader = place_as_colour,
                                  .clip_shader = clipped ? ask : NULL};
            const DipPipelineCounters without =
                run(dip_isa_best(), &draw, 1, (const int[]){pairs[i][0], 0}, DIP_PATTERN_STANDARD);
            memcpy(plain, picture, sizeof plain);
            const DipPipelineCounters with =
                run(dip_isa_best(), &draw, 1, pairs[i], DIP_PATTERN_STANDARD);
            assert_memory_equal(picture, plain, sizeof plain);
            assert_memory_equal(&with, &without, sizeof with);
            assert_int_equal(with.clip_sample_groups, clipped);
        }
    }
    dip_mesh_destroy(&mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(temporal_patterns_have_a_sample_per_row_and_column),
        cmocka_unit_test(sample_groups_divide_all_samples_and_lie_apart),
        cmocka_unit_test(the_mean_of_two_frames_has_the_samples_of_both_patterns),
        cmocka_unit_test(every_sample_group_is_clipped_and_shaded_at_its_centroid),
        cmocka_unit_test(one_sample_group_takes_no_extra_work),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
