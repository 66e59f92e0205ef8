// Tests two numbers that must stay within their limits: the vertices of a clipped polygon, and the
// triangles of a pass.
#include "renderer/pipeline/geometry/clip.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/catalogue/random.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include <math.h>

enum { ROUNDS = 100000, BIG_MESH_TRIANGLES = 1 << 17, BIG_PASS_DRAWS = 2000 };

static float symmetric(Random *random) {
    return (float)random_real(random, -1.0, 1.0);
}

// A clipped polygon lies within the bounds of its triangle, but for a rounding to float.
static void assert_within(const DipClipPolygon *polygon, const double *least, const double *most) {
    for (int v = 0; v < polygon->count; v++) {
        for (int i = 0; i < 4; i++) {
            assert_true(polygon->vertex[v].position[i] >= least[i] - 1e-6);
            assert_true(polygon->vertex[v].position[i] <= most[i] + 1e-6);
        }
    }
}

// Six user planes are equal except for rounding. Each plane may add at most one vertex to a convex
// polygon, no matter how vertices that lie on the plane are rounded, and the vertices that it adds
// lie on the polygon's edges.
static void coincident_planes_add_one_vertex_each(void **state) {
    (void)state;
    Random random = {1};
    for (int round = 0; round < ROUNDS; round++) {
        DipScreenMapping map = {.clip_plane_count = DIP_MAX_CLIP_PLANES};
        const float normal[4] = {symmetric(&random), symmetric(&random), symmetric(&random),
                                 symmetric(&random)};
        for (int plane = 0; plane < DIP_MAX_CLIP_PLANES; plane++) {
            for (int i = 0; i < 4; i++) {
                map.clip_planes[plane][i] =
                    normal[i] * (float)(plane + 1) * (1.0f + 1e-7f * symmetric(&random));
            }
        }
        DipClipPolygon polygon = {.count = 3};
        double least[4] = {1.0, 1.0, 1.0, 1.0}, most[4] = {-1.0, -1.0, -1.0, -1.0};
        for (int v = 0; v < 3; v++) {
            for (int i = 0; i < 4; i++) {
                const double value = (double)symmetric(&random);
                polygon.vertex[v].position[i] = value;
                least[i] = fmin(least[i], value);
                most[i] = fmax(most[i], value);
            }
        }
        dip_clip_polygon(&polygon, DIP_CLIP_ALL_USER, &map, &(DipClipVaryings){0});
        assert_in_range(polygon.count, 0, 3 + DIP_MAX_CLIP_PLANES);
        assert_within(&polygon, least, most);
    }
}

static void vertex_shader(const DipVertexBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        for (int c = 0; c < 4; c++) {
            batch->clip[c][i] = 0.0f;
        }
    }
}

static void fragment_shader(DipFragmentBatch *batch) {
    (void)batch;
}

// 2000 draws of one mesh have 262 million triangles but take hardly any memory. The pass must be
// refused, because it accepts only about 2^31 / 44, or 48 million, triangles. With 12 varyings, the
// plane equations of a triangle take 44 floats. The kernels index these floats with signed 32-bit
// integers.
static void passes_with_too_many_triangles_are_refused(void **state) {
    (void)state;
    const float point[3] = {0};
    uint32_t *indices = calloc(3 * BIG_MESH_TRIANGLES, sizeof *indices);
    const DipMeshData data = {.name = "many",
                              .attributes = point,
                              .attribute_count = 3,
                              .vertex_count = 1,
                              .indices = indices,
                              .index_count = 3 * BIG_MESH_TRIANGLES};
    DipMesh *mesh = dip_mesh_create(&data, NULL);
    DipDraw *draws = calloc(BIG_PASS_DRAWS, sizeof *draws);
    DipPool *pool = dip_pool_create(1, NULL);
    DipPipeline *pipeline = dip_pipeline_create(pool, dip_isa_best(), 8, 8, NULL);
    assert_true(indices && mesh && draws && pool && pipeline);
    for (int i = 0; i < BIG_PASS_DRAWS; i++) {
        draws[i] = (DipDraw){.mesh = mesh,
                             .vertex_shader = vertex_shader,
                             .fragment_shader = fragment_shader,
                             .varying_count = DIP_MAX_VARYINGS};
    }
    uint8_t rgba8[8 * 8 * 4];
    DipPass pass = {.draws = draws,
                    .draw_count = BIG_PASS_DRAWS,
                    .sample_count = 1,
                    .target = {.rgba8 = rgba8, .stride_bytes = 8 * 4, .width = 8, .height = 8}};
    DipPipelineCounters counters = {0};
    DipStageTimes times = {0};
    DipError err = {0};
    assert_false(dip_pipeline_draw(pipeline, &pass, &counters, &times, &err));
    assert_int_equal(err.code, DIP_ERROR_OVERSIZED);
    pass.draw_count = 1;
    assert_true(dip_pipeline_draw(pipeline, &pass, &counters, &times, &err));
    assert_int_equal(counters.triangles_in, BIG_MESH_TRIANGLES);
    dip_pipeline_destroy(&pipeline);
    dip_pool_destroy(&pool);
    dip_mesh_destroy(&mesh);
    free(draws);
    free(indices);
}

// One triangle covers the whole picture, so that it goes to the bin of wide triangles, and a small
// one lies in the last tile.
static void cover_and_corner(const DipVertexBatch *batch) {
    static const float x[6] = {-1.0f, 3.0f, -1.0f, 1.0f, 1.0f, 0.9961f};
    static const float y[6] = {-1.0f, -1.0f, 3.0f, -1.0f, -0.9961f, -1.0f};
    for (int i = 0; i < batch->count; i++) {
        const int vertex = (int)batch->in[0][i];
        batch->clip[0][i] = x[vertex];
        batch->clip[1][i] = y[vertex];
        batch->clip[2][i] = vertex < 3 ? 0.25f : 0.5f;
        batch->clip[3][i] = 1.0f;
        batch->varying[0][i] = vertex < 3 ? 0.0f : 1.0f;
    }
}

static void varying_as_colour(DipFragmentBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        batch->colour[0][i] = batch->varying[0][i];
        batch->colour[1][i] = 1.0f;
        batch->colour[2][i] = 0.0f;
    }
}

// The largest target has a bin for each of its 128 x 128 tiles and one for wide triangles. Arrays
// that are one bin too small are found by the sanitizers.
static void the_largest_target_has_a_bin_for_every_tile(void **state) {
    (void)state;
    enum { SIZE = DIP_MAX_TARGET_SIZE };
    const float numbers[6][3] = {{0}, {1}, {2}, {3}, {4}, {5}};
    const uint32_t indices[6] = {0, 1, 2, 3, 4, 5};
    const DipMeshData data = {.name = "two",
                              .attributes = &numbers[0][0],
                              .attribute_count = 3,
                              .vertex_count = 6,
                              .indices = indices,
                              .index_count = 6};
    DipMesh *mesh = dip_mesh_create(&data, NULL);
    DipPool *pool = dip_pool_create(2, NULL);
    DipPipeline *pipeline = dip_pipeline_create(pool, dip_isa_best(), SIZE, SIZE, NULL);
    uint8_t *rgba8 = malloc((size_t)SIZE * SIZE * 4);
    assert_true(mesh && pool && pipeline && rgba8);
    const DipDraw draw = {.mesh = mesh,
                          .vertex_shader = cover_and_corner,
                          .fragment_shader = varying_as_colour,
                          .varying_count = 1};
    const DipPass pass = {
        .draws = &draw,
        .draw_count = 1,
        .sample_count = 1,
        .target = {
            .rgba8 = rgba8, .stride_bytes = (size_t)SIZE * 4, .width = SIZE, .height = SIZE}};
    DipPipelineCounters counters = {0};
    DipStageTimes times = {0};
    assert_true(dip_pipeline_draw(pipeline, &pass, &counters, &times, NULL));
    assert_int_equal(counters.tiles_drawn, SIZE / 64 * (SIZE / 64));
    for (int y = 0; y < SIZE; y += 64) {
        for (int x = 0; x < SIZE; x += 64) { // Each tile shows the wide triangle.
            assert_int_equal(rgba8[((size_t)y * SIZE + (size_t)x) * 4 + 1], 255);
        }
    }
    assert_int_equal(rgba8[(size_t)SIZE * SIZE * 4 - 4], 255); // The last pixel is the small one's.
    assert_int_equal(rgba8[0], 0);
    free(rgba8);
    dip_pipeline_destroy(&pipeline);
    dip_pool_destroy(&pool);
    dip_mesh_destroy(&mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(coincident_planes_add_one_vertex_each),
        cmocka_unit_test(passes_with_too_many_triangles_are_refused),
        cmocka_unit_test(the_largest_target_has_a_bin_for_every_tile),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
