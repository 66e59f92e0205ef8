// Tests patches. A patch is a group of connected triangles that are shaded as one surface. Tests
// which triangles form a patch, and that pixels are shaded once per patch.
#include "renderer/pipeline/patch.h"
#include "renderer/pipeline/pipeline.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { SIDE = 24, VERTICES = (SIDE + 1) * (SIDE + 1), TRIANGLES = 2 * SIDE * SIDE };

// A grid of quads over the unit square, with a height at each vertex.
typedef struct Grid {
    float positions[3 * VERTICES];
    uint32_t indices[3 * TRIANGLES];
    uint32_t patches[TRIANGLES];
    uint32_t count;
} Grid;

static void make_grid(Grid *grid, double (*height)(double x, double y)) {
    for (int i = 0; i < VERTICES; i++) {
        const double x = (double)(i % (SIDE + 1)) / SIDE, y = (double)(i / (SIDE + 1)) / SIDE;
        float *position = grid->positions + (size_t)3 * (size_t)i;
        position[0] = (float)x;
        position[1] = (float)y;
        position[2] = (float)height(x, y);
    }
    uint32_t *index = grid->indices;
    for (uint32_t q = 0; q < SIDE * SIDE; q++) {
        const uint32_t a = q / SIDE * (SIDE + 1) + q % SIDE;
        const uint32_t corners[6] = {a, a + 1, a + SIDE + 2, a, a + SIDE + 2, a + SIDE + 1};
        memcpy(index, corners, sizeof corners);
        index += 6;
    }
    assert_true(dip_patches_find(grid->positions, 3, VERTICES, grid->indices, 3 * TRIANGLES,
                                 grid->patches, &grid->count));
}

static double flat(double x, double y) {
    (void)x;
    (void)y;
    return 0.25;
}

static double roof(double x, double y) {
    (void)y;
    return x < 0.5 ? x : 1.0 - x; // the slope rises by 45 degrees, then falls by 45 degrees
}

static double dome(double x, double y) {
    return 0.6 * sqrt(2.0 - (x - 0.5) * (x - 0.5) - (y - 0.5) * (y - 0.5)) + 0.1 * sin(9.0 * x);
}

static void normal_of(const Grid *grid, uint32_t triangle, double normal[3]) {
    const float *v[3];
    for (int k = 0; k < 3; k++) {
        v[k] = grid->positions + (size_t)3 * grid->indices[3 * triangle + (uint32_t)k];
    }
    double a[3], b[3];
    for (int i = 0; i < 3; i++) {
        a[i] = (double)v[1][i] - v[0][i];
        b[i] = (double)v[2][i] - v[0][i];
    }
    const double n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                         a[0] * b[1] - a[1] * b[0]};
    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int i = 0; i < 3; i++) {
        normal[i] = n[i] / length;
    }
}

static double degrees_between(const Grid *grid, uint32_t a, uint32_t b) {
    double n[2][3];
    normal_of(grid, a, n[0]);
    normal_of(grid, b, n[1]);
    const double cosine = n[0][0] * n[1][0] + n[0][1] * n[1][1] + n[0][2] * n[1][2];
    return acos(fmin(cosine, 1.0)) * (180.0 / 3.14159265358979323846);
}

static bool neighbours(const Grid *grid, uint32_t a, uint32_t b) {
    int shared = 0;
    for (uint32_t i = 0; i < 9; i++) {
        shared += grid->indices[3 * a + i / 3] == grid->indices[3 * b + i % 3];
    }
    return shared == 2;
}

// Checks everything that patch.h promises about a patch. The check uses nothing but the grid.
static void check_patch(const Grid *grid, uint32_t patch) {
    uint32_t members[TRIANGLES];
    uint32_t count = 0;
    for (uint32_t t = 0; t < TRIANGLES; t++) {
        if (grid->patches[t] == patch) {
            members[count++] = t;
        }
    }
    assert_in_range(count, 1, DIP_PATCH_TRIANGLES);
    bool reached[TRIANGLES] = {true};
    for (uint32_t round = 0; round < count; round++) {
        for (uint32_t i = 0; i < count; i++) {
            for (uint32_t k = 0; k < count && !reached[i]; k++) {
                reached[i] = reached[k] && neighbours(grid, members[i], members[k]);
            }
        }
    }
    for (uint32_t i = 0; i < count; i++) {
        assert_true(reached[i]);
        assert_true(degrees_between(grid, members[0], members[i]) < 20.001);
    }
}

static void patches_are_small_connected_and_smooth(void **state) {
    (void)state;
    static Grid grid;
    double (*const heights[])(double, double) = {flat, roof, dome};
    for (size_t i = 0; i < sizeof heights / sizeof heights[0]; i++) {
        make_grid(&grid, heights[i]);
        for (uint32_t t = 0; t < TRIANGLES; t++) {
            assert_true(grid.patches[t] < grid.count);
        }
        for (uint32_t p = 0; p < grid.count; p++) {
            check_patch(&grid, p);
        }
        // On average, a patch has more than half of the triangles that it may have.
        assert_true(grid.count < 2 * TRIANGLES / DIP_PATCH_TRIANGLES);
    }
}

static void patches_do_not_cross_a_crease(void **state) {
    (void)state;
    static Grid grid;
    make_grid(&grid, roof);
    for (uint32_t t = 0; t < TRIANGLES; t++) {
        for (uint32_t u = 0; u < TRIANGLES; u++) {
            const bool same_side = (t / 2 % SIDE < SIDE / 2) == (u / 2 % SIDE < SIDE / 2);
            assert_true(same_side || grid.patches[t] != grid.patches[u]);
        }
    }
}

static void triangles_without_area_or_neighbours_form_their_own_patches(void **state) {
    (void)state;
    const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 0, 5, 5, 5, 6, 5, 5, 5, 6, 5};
    // Four triangles. The second one has no area and shares an edge with the first. The third
    // shares an edge only with the second. The fourth lies far away and shares only a corner with
    // the third.
    const uint32_t indices[] = {0, 1, 2, 0, 1, 3, 1, 3, 4, 4, 5, 6};
    uint32_t patches[4], count;
    assert_true(dip_patches_find(positions, 3, 7, indices, 12, patches, &count));
    assert_int_equal(count, 4);
    assert_true(dip_patches_find(positions, 3, 7, indices, 0, patches, &count));
    assert_int_equal(count, 0);
}

// Very many triangles share a vertex or an edge. It would take hours to visit all of them for each
// triangle.
static void patches_of_wide_fans_are_found_quickly(void **state) {
    (void)state;
    enum { FAN = 400000 };
    float *positions = malloc(3 * (FAN + 2) * sizeof *positions);
    uint32_t *indices = malloc(3 * FAN * sizeof *indices);
    uint32_t *patches = malloc(FAN * sizeof *patches);
    assert_true(positions && indices && patches);
    for (int i = 0; i < FAN + 2; i++) {
        positions[3 * i] = i ? (float)cos(1e-5 * i) : 0.0f;
        positions[3 * i + 1] = i ? (float)sin(1e-5 * i) : 0.0f;
        positions[3 * i + 2] = 0.0f;
    }
    uint32_t count;
    for (uint32_t book = 0; book < 2; book++) {
        for (uint32_t t = 0; t < FAN; t++) {
            const uint32_t corners[3] = {0, book ? 1 : t + 1, t + 2};
            memcpy(indices + 3 * (size_t)t, corners, sizeof corners);
        }
        assert_true(dip_patches_find(positions, 3, FAN + 2, indices, 3 * FAN, patches, &count));
        assert_int_equal(count, book ? FAN : FAN / DIP_PATCH_TRIANGLES);
    }
    free(positions);
    free(indices);
    free(patches);
}

// --- in a picture ------------------------------------------------------------------------------

enum { WIDTH = 128, HEIGHT = 96 };

static uint8_t picture[WIDTH * HEIGHT * 4];

// Stretches the grid over the whole picture.
static void cover(const DipVertexBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        batch->clip[0][i] = 2.0f * batch->in[0][i] - 1.0f;
        batch->clip[1][i] = 2.0f * batch->in[1][i] - 1.0f;
        batch->clip[2][i] = 0.5f;
        batch->clip[3][i] = 1.0f;
        batch->varying[0][i] = batch->in[0][i];
    }
}

static void red_ramp(DipFragmentBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        batch->colour[0][i] = batch->varying[0][i];
        batch->colour[1][i] = batch->colour[2][i] = 0.0f;
    }
}

static uint64_t fragments_of(const DipMesh *mesh, int samples) {
    const DipDraw draw = {.mesh = mesh,
                          .vertex_shader = cover,
                          .fragment_shader = red_ramp,
                          .varying_count = 1,
                          .cull = DIP_CULL_NONE};
    const DipPass pass = {
        .draws = &draw,
        .draw_count = 1,
        .sample_count = samples,
        .target = {
            .rgba8 = picture, .stride_bytes = (size_t)WIDTH * 4, .width = WIDTH, .height = HEIGHT}};
    DipPipelineCounters counters = {0};
    DipStageTimes times = {0};
    DipPool *pool = dip_pool_create(1, NULL);
    DipPipeline *pipeline = dip_pipeline_create(pool, dip_isa_best(), WIDTH, HEIGHT, NULL);
    assert_non_null(pipeline);
    assert_true(dip_pipeline_draw(pipeline, &pass, &counters, &times, NULL));
    dip_pipeline_destroy(&pipeline);
    dip_pool_destroy(&pool);
    return counters.fragments_shaded;
}

// For each pixel, counts the patches that cover samples of the pixel. Returns the sum over all
// pixels. The grid's lines are straight, so the position of a sample determines its triangle.
static uint64_t expected_fragments(const Grid *grid, int samples) {
    const DipSamplePattern *pattern = dip_sample_pattern(samples);
    uint64_t fragments = 0;
    for (int pixel = 0; pixel < WIDTH * HEIGHT; pixel++) {
        uint32_t seen[DIP_MAX_SAMPLES];
        for (int s = 0; s < samples; s++) {
            const double x = (pixel % WIDTH + pattern->x[s] / 256.0) / WIDTH * SIDE;
            const double y = (HEIGHT - (pixel / WIDTH + pattern->y[s] / 256.0)) / HEIGHT * SIDE;
            const uint32_t quad = (uint32_t)y * SIDE + (uint32_t)x;
            seen[s] = grid->patches[2 * quad + (x - floor(x) < y - floor(y))];
            bool again = false;
            for (int other = 0; other < s; other++) {
                again |= seen[other] == seen[s];
            }
            fragments += !again;
        }
    }
    return fragments;
}

static void a_pixel_is_shaded_once_per_patch(void **state) {
    (void)state;
    static Grid grid;
    make_grid(&grid, flat);
    const DipMeshData data = {"grid", grid.positions, 3, VERTICES, grid.indices, 3 * TRIANGLES};
    DipMesh *mesh = dip_mesh_create(&data, NULL);
    assert_non_null(mesh);
    for (int samples = 2; samples <= DIP_MAX_SAMPLES; samples += 2) {
        // Samples on the grid's lines may belong to either side because of rounding.
        const double expected = (double)expected_fragments(&grid, samples);
        const double found = (double)fragments_of(mesh, samples);
        assert_true(found >= WIDTH * HEIGHT && fabs(found - expected) <= 0.005 * expected);
        assert_true(expected < 1.25 * WIDTH * HEIGHT);
        // The picture is a ramp, which must show no seams: no pixel may be darker than its left
        // neighbour.
        for (int x = 8; x < WIDTH; x++) {
            assert_true(picture[4 * (40 * WIDTH + x)] >= picture[4 * (40 * WIDTH + x - 1)]);
        }
    }
    dip_mesh_destroy(&mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(patches_are_small_connected_and_smooth),
        cmocka_unit_test(patches_do_not_cross_a_crease),
        cmocka_unit_test(triangles_without_area_or_neighbours_form_their_own_patches),
        cmocka_unit_test(patches_of_wide_fans_are_found_quickly),
        cmocka_unit_test(a_pixel_is_shaded_once_per_patch),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
