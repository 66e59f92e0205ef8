// Culling by bounds never changes a picture, leaves out what is out of view, and passes that need
// more room than expected are drawn all the same.
#include "renderer/pipeline.h"
#include "tests/renderer/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 320, HEIGHT = 256, FLOATS = 4, CAMERAS = 60, CLUSTERS = 200, PER_CLUSTER = 300 };

static uint8_t pictures[2][WIDTH * HEIGHT * 4];

// --- a mesh of positions and one varying, projected by the matrix that is the uniforms ---------

static void project(const DipVertexBatch *batch) {
    const float *m = batch->uniforms;
    for (int i = 0; i < batch->count; i++) {
        for (int r = 0; r < 4; r++) {
            const float *row = m + 4 * r;
            batch->clip[r][i] =
                ((row[0] * batch->in[0][i] + row[1] * batch->in[1][i]) + row[2] * batch->in[2][i]) +
                row[3];
        }
        batch->slot[0][i] = batch->in[3][i];
    }
}

static void varying(DipFragmentBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        batch->colour[0][i] = batch->slot[0][i];
        batch->colour[1][i] = 0.5f;
        batch->colour[2][i] = 1.0f - batch->slot[0][i];
    }
}

typedef struct Soup {
    float *vertices;
    uint32_t *indices;
    uint32_t count; // of vertices; no two triangles share one
} Soup;

static Soup make_soup(uint32_t triangles) {
    Soup soup = {malloc(sizeof(float) * FLOATS * 3 * triangles),
                 malloc(sizeof(uint32_t) * 3 * triangles), 0};
    assert_true(soup.vertices && soup.indices);
    return soup;
}

static void add_corner(Soup *soup, double x, double y, double z, double value) {
    const double row[FLOATS] = {x, y, z, value};
    for (int i = 0; i < FLOATS; i++) {
        soup->vertices[(size_t)FLOATS * soup->count + (size_t)i] = (float)row[i];
    }
    soup->indices[soup->count] = soup->count;
    soup->count++;
}

static DipMesh *mesh_of(Soup *soup) {
    const DipMeshData data = {.name = "soup",
                              .attributes = soup->vertices,
                              .attribute_count = FLOATS,
                              .vertex_count = soup->count,
                              .indices = soup->indices,
                              .index_count = soup->count};
    DipMesh *mesh = dip_mesh_create(&data, NULL);
    assert_non_null(mesh);
    free(soup->vertices);
    free(soup->indices);
    return mesh;
}

static DipCounters draw(const DipMesh *mesh, const float *matrix, bool culled, int threads,
                        const float *user_plane, uint8_t *picture) {
    const DipDraw one = {.mesh = mesh,
                         .vertex_shader = project,
                         .fragment_shader = varying,
                         .slot_count = 1,
                         .uniforms = matrix,
                         .bounds_to_clip = culled ? matrix : NULL};
    DipPass pass = {.draws = &one,
                    .draw_count = 1,
                    .sample_count = 2,
                    .target = {picture, (size_t)WIDTH * 4, WIDTH, HEIGHT}};
    if (user_plane) {
        memcpy(pass.clip_planes[0], user_plane, sizeof pass.clip_planes[0]);
        pass.clip_plane_count = 1;
    }
    DipPool *pool = dip_pool_create(threads, NULL);
    DipPipeline *pipeline = dip_pipeline_create(pool, dip_isa_best(), WIDTH, HEIGHT, NULL);
    assert_non_null(pipeline);
    DipCounters counters[2] = {{0}, {0}};
    for (int again = 0; again < 2; again++) {
        DipStageTimes times = {0};
        memset(picture, 77, sizeof pictures[0]);
        assert_true(dip_pipeline_draw(pipeline, &pass, &counters[again], &times, NULL));
    }
    assert_memory_equal(&counters[0], &counters[1], sizeof counters[0]);
    dip_pipeline_destroy(&pipeline);
    dip_pool_destroy(&pool);
    return counters[0];
}

// --- cameras -----------------------------------------------------------------------------------

// Looks from `eye` along a random direction: an orthonormal frame times a perspective matrix.
static void random_camera(Random *random, float m[16]) {
    double axis[3][3];
    for (int a = 0; a < 2; a++) {
        for (int c = 0; c < 3; c++) {
            axis[a][c] = random_real(random, -1.0, 1.0);
        }
    }
    for (int a = 0; a < 2; a++) {
        const double along =
            a ? axis[1][0] * axis[0][0] + axis[1][1] * axis[0][1] + axis[1][2] * axis[0][2] : 0.0;
        for (int c = 0; c < 3; c++) {
            axis[a][c] -= along * axis[0][c];
        }
        const double length =
            sqrt(axis[a][0] * axis[a][0] + axis[a][1] * axis[a][1] + axis[a][2] * axis[a][2]);
        for (int c = 0; c < 3; c++) {
            axis[a][c] /= length;
        }
    }
    for (int c = 0; c < 3; c++) {
        axis[2][c] = axis[0][(c + 1) % 3] * axis[1][(c + 2) % 3] -
                     axis[0][(c + 2) % 3] * axis[1][(c + 1) % 3];
    }
    const double zoom = random_real(random, 0.5, 4.0);
    const double scale[4] = {zoom, zoom, 0.0, -1.0};
    const int from[4] = {0, 1, 0, 2};
    double eye[3];
    for (int c = 0; c < 3; c++) {
        eye[c] = random_real(random, -12.0, 12.0);
    }
    for (int r = 0; r < 4; r++) {
        const double *a = axis[from[r]];
        for (int c = 0; c < 3; c++) {
            m[4 * r + c] = (float)(scale[r] * a[c]);
        }
        m[4 * r + 3] = (float)(-scale[r] * (a[0] * eye[0] + a[1] * eye[1] + a[2] * eye[2]));
    }
    m[11] = 0.1f; // the near plane
}

// Clusters of triangles of all sizes, one after another, so that chunks are small in space.
static DipMesh *random_clusters(Random *random) {
    Soup soup = make_soup(CLUSTERS * PER_CLUSTER);
    for (int cluster = 0; cluster < CLUSTERS; cluster++) {
        double centre[3];
        for (int c = 0; c < 3; c++) {
            centre[c] = random_real(random, -10.0, 10.0);
        }
        for (int t = 0; t < PER_CLUSTER; t++) {
            const double size = pow(10.0, random_real(random, -3.0, 0.3));
            for (int k = 0; k < 3; k++) {
                add_corner(&soup, centre[0] + random_real(random, -size, size),
                           centre[1] + random_real(random, -size, size),
                           centre[2] + random_real(random, -size, size),
                           random_real(random, 0.0, 1.0));
            }
        }
    }
    return mesh_of(&soup);
}

static void culling_changes_no_picture(void **state) {
    (void)state;
    Random random = {4711};
    DipMesh *mesh = random_clusters(&random);
    const uint64_t all = dip_mesh_triangle_count(mesh);
    uint64_t read = 0;
    uint64_t drawn = 0;
    for (int i = 0; i < CAMERAS; i++) {
        float m[16];
        random_camera(&random, m);
        const float plane[4] = {0.4f, 0.1f, 0.0f, (float)random_real(&random, -0.5, 0.5)};
        const float *user_plane = i % 3 == 0 ? plane : NULL;
        const DipCounters whole = draw(mesh, m, false, 1, user_plane, pictures[0]);
        const DipCounters culled = draw(mesh, m, true, 1 + i % 3, user_plane, pictures[1]);
        assert_memory_equal(pictures[0], pictures[1], sizeof pictures[0]);
        assert_int_equal(culled.triangles_drawn, whole.triangles_drawn);
        assert_int_equal(culled.tile_triangles, whole.tile_triangles);
        assert_int_equal(whole.triangles_in, all);
        read += culled.triangles_in;
        drawn += culled.triangles_drawn;
    }
    // It culls, and there is something to see.
    assert_true(read < all * CAMERAS / 2);
    assert_true(drawn > all * CAMERAS / 100);
    dip_mesh_destroy(&mesh);
}

// --- more room than expected -------------------------------------------------------------------

static const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

// Each triangle has a corner nearer than the near plane (z > w = 1), so that two come of it.
static void clipping_may_double_the_triangles(void **state) {
    (void)state;
    enum { COUNT = 40000 };
    for (int threads = 1; threads <= 3; threads++) {
        Soup soup = make_soup(COUNT);
        for (int t = 0; t < COUNT; t++) {
            const double x = t % 200 / 100.0 - 0.995;
            const double y = t / 200 / 100.0 - 0.995;
            add_corner(&soup, x - 0.02, y - 0.02, 0.5, 0.0);
            add_corner(&soup, x + 0.02, y - 0.02, 0.5, 1.0);
            add_corner(&soup, x, y + 0.04, 1.5, 1.0);
        }
        DipMesh *mesh = mesh_of(&soup);
        const DipCounters counters = draw(mesh, identity, true, threads, NULL, pictures[0]);
        assert_int_equal(counters.triangles_in, COUNT);
        assert_int_equal(counters.triangles_drawn, 2 * COUNT);
        if (threads > 1) {
            assert_memory_equal(pictures[0], pictures[1], sizeof pictures[0]);
        }
        memcpy(pictures[1], pictures[0], sizeof pictures[0]);
        dip_mesh_destroy(&mesh);
    }
}

// Each triangle's box is the picture less one row of tiles: 5 x 3 tiles, all in bins.
static void triangles_may_lie_in_many_tiles(void **state) {
    (void)state;
    enum { COUNT = 30000, TILES = 5 * 3 };
    Soup soup = make_soup(COUNT);
    for (int t = 0; t < COUNT; t++) {
        const double z = t / (double)COUNT;
        add_corner(&soup, -0.99, -0.4, z, z);
        add_corner(&soup, 0.99, -0.4, z, z);
        add_corner(&soup, -0.99, 0.99, z, z);
    }
    DipMesh *mesh = mesh_of(&soup);
    const DipCounters counters = draw(mesh, identity, true, 2, NULL, pictures[0]);
    assert_int_equal(counters.triangles_drawn, COUNT);
    assert_int_equal(counters.tile_triangles, (uint64_t)COUNT * TILES);
    // The nearest, drawn last, is on top.
    assert_int_equal(pictures[0][4 * (WIDTH * 150 + 20)], 255);
    dip_mesh_destroy(&mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(culling_changes_no_picture),
        cmocka_unit_test(clipping_may_double_the_triangles),
        cmocka_unit_test(triangles_may_lie_in_many_tiles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
