// Tests culling by bounding boxes. Culling must not change any picture, and it must reject objects
// that are out of view. Also tests that the pipeline correctly draws passes that need more memory
// than it first allocates.
#include "renderer/pipeline/cull.h"
#include "renderer/pipeline/geometry/chunk_cull.h"
#include "renderer/pipeline/geometry/mesh_layout.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/catalogue/random.h"
#include "tests/renderer/scene/random_view.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 320, HEIGHT = 256, FLOATS = 4, CAMERAS = 60, CLUSTERS = 200, PER_CLUSTER = 300 };

static uint8_t pictures[2][WIDTH * HEIGHT * 4];

// --- a mesh of positions and one varying, projected by a matrix in the uniforms -----------------

static void project(const DipVertexBatch *batch) {
    const float *m = batch->uniforms;
    for (int i = 0; i < batch->count; i++) {
        for (int r = 0; r < 4; r++) {
            const float *row = m + 4 * r;
            batch->clip[r][i] =
                ((row[0] * batch->in[0][i] + row[1] * batch->in[1][i]) + row[2] * batch->in[2][i]) +
                row[3];
        }
        batch->varying[0][i] = batch->in[3][i];
    }
}

static void varying(DipFragmentBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        batch->colour[0][i] = batch->varying[0][i];
        batch->colour[1][i] = 0.5f;
        batch->colour[2][i] = 1.0f - batch->varying[0][i];
    }
}

typedef struct Soup {
    float *vertices;
    uint32_t *indices;
    uint32_t count; // number of vertices; each belongs to one triangle only
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

static DipPipelineCounters draw(const DipMesh *mesh, const float *matrix, bool culled, int threads,
                                const float *user_plane, const DipTargetRegion *region,
                                uint8_t *picture) {
    const DipDraw one = {.mesh = mesh,
                         .vertex_shader = project,
                         .fragment_shader = varying,
                         .varying_count = 1,
                         .uniforms = matrix,
                         .bounds_to_clip = culled ? matrix : NULL};
    DipPass pass = {
        .draws = &one,
        .draw_count = 1,
        .sample_count = 2,
        .target = {
            .rgba8 = picture, .stride_bytes = (size_t)WIDTH * 4, .width = WIDTH, .height = HEIGHT}};
    pass.region = region ? *region : (DipTargetRegion){0};
    if (user_plane) {
        memcpy(pass.clip_planes[0], user_plane, sizeof pass.clip_planes[0]);
        pass.clip_plane_count = 1;
    }
    DipPool *pool = dip_pool_create(threads, NULL);
    DipPipeline *pipeline = dip_pipeline_create(pool, dip_isa_best(), WIDTH, HEIGHT, NULL);
    assert_non_null(pipeline);
    DipPipelineCounters counters[2] = {{0}, {0}};
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

// Makes a camera at a random position that looks in a random direction. Its matrix is an
// orthonormal frame times a perspective matrix.
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

// Makes clusters of triangles of all sizes, one after another. Each of the mesh's chunks (groups of
// successive triangles) therefore covers only a small part of space.
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

static void culling_never_changes_a_picture(void **state) {
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
        const DipPipelineCounters whole = draw(mesh, m, false, 1, user_plane, NULL, pictures[0]);
        const DipPipelineCounters culled =
            draw(mesh, m, true, 1 + i % 3, user_plane, NULL, pictures[1]);
        assert_memory_equal(pictures[0], pictures[1], sizeof pictures[0]);
        assert_int_equal(culled.triangles_drawn, whole.triangles_drawn);
        assert_int_equal(culled.tile_triangles, whole.tile_triangles);
        assert_int_equal(whole.triangles_in, all);
        assert_int_equal(whole.draws_in_view, 1);
        assert_int_equal(culled.draws_in_view, culled.triangles_in > 0);
        assert_int_equal(culled.draws_in_view + culled.draws_culled, 1);
        read += culled.triangles_in;
        drawn += culled.triangles_drawn;
    }
    // Culling must reject some triangles, and some triangles must be visible.
    assert_true(read < all * CAMERAS / 2);
    assert_true(drawn > all * CAMERAS / 100);
    dip_mesh_destroy(&mesh);
}

static void assert_same_blocks(const DipTargetRegion *region) {
    enum { BLOCK = 8 };
    for (int y = region->y0 / BLOCK; y <= (region->y1 - 1) / BLOCK; y++) {
        for (int x = region->x0 / BLOCK; x <= (region->x1 - 1) / BLOCK; x++) {
            for (int row = 0; row < BLOCK; row++) {
                const size_t at = 4 * (size_t)(WIDTH * (y * BLOCK + row) + x * BLOCK);
                assert_memory_equal(pictures[0] + at, pictures[1] + at, 4 * BLOCK);
            }
        }
    }
}

// With a region, the pipeline may reject every box, chunk and clipped triangle that does not reach
// the region. Inside the region, the picture must equal the picture without a region.
static void a_region_equals_the_same_part_of_the_whole_picture(void **state) {
    (void)state;
    enum { REGIONS = 6 };
    Random random = {42};
    DipMesh *mesh = random_clusters(&random);
    for (int i = 0; i < CAMERAS / 3; i++) {
        float m[16];
        random_camera(&random, m);
        const float plane[4] = {0.4f, 0.1f, 0.0f, (float)random_real(&random, -0.5, 0.5)};
        const DipPipelineCounters whole = draw(mesh, m, false, 1, plane, NULL, pictures[0]);
        for (int r = 0; r < REGIONS; r++) {
            const int x0 = random_int(&random, 0, WIDTH - 1);
            const int y0 = random_int(&random, 0, HEIGHT - 1);
            const DipTargetRegion region = {x0, y0, random_int(&random, x0 + 1, WIDTH),
                                            random_int(&random, y0 + 1, HEIGHT)};
            const DipPipelineCounters part =
                draw(mesh, m, r % 2, 1 + r % 2, plane, &region, pictures[1]);
            assert_true(part.triangles_drawn <= whole.triangles_drawn);
            assert_same_blocks(&region);
        }
    }
    dip_mesh_destroy(&mesh);
}

// --- visible parts of objects --------------------------------------------------------------------

enum { PLACED = 40, VIEWS = 400, POINTS = 6 }; // POINTS: points tested per triangle

// Makes clusters of triangles around the origin, some of them far away from it.
static DipMesh *random_mesh(Random *random) {
    enum { CLUMPS = 5, PER_CLUMP = 150 };
    Soup soup = make_soup(CLUMPS * PER_CLUMP);
    for (int part = 0; part < CLUMPS; part++) {
        const double far = pow(10.0, random_real(random, -1.0, 2.0));
        const double centre[3] = {random_real(random, -far, far), random_real(random, -far, far),
                                  random_real(random, -far, far)};
        for (int k = 0; k < 3 * PER_CLUMP; k++) {
            add_corner(&soup, centre[0] + random_real(random, -1.0, 1.0),
                       centre[1] + random_real(random, -1.0, 1.0),
                       centre[2] + random_real(random, -1.0, 1.0), 0.0);
        }
    }
    return mesh_of(&soup);
}

// Makes a transform with a random 3x3 part. Some transforms mirror or flatten the object. Every
// second transform does not rotate, so that the transformed boxes are tight.
static void random_transform(Random *random, float transform[12]) {
    const double scale = pow(10.0, random_real(random, -2.0, 0.5));
    for (int i = 0; i < 12; i++) {
        transform[i] =
            (float)(i % 4 == 3 ? random_real(random, -20.0, 20.0) : random_real(random, -1.0, 1.0));
        transform[i] *= i % 4 == 3 ? 1.0f : (float)scale;
    }
    if (random_int(random, 0, 1)) {
        for (int i = 0; i < 12; i++) {
            transform[i] = i % 4 == 3 || i % 5 == 0 ? transform[i] : 0.0f;
        }
    }
}

static DipPass random_part(Random *random, const DipView *view) {
    DipPass pass = {
        .target = {
            .rgba8 = NULL, .stride_bytes = (size_t)WIDTH * 4, .width = WIDTH, .height = HEIGHT}};
    if (random_int(random, 0, 3)) {
        const int x0 = random_int(random, 0, WIDTH - 1);
        const int y0 = random_int(random, 0, HEIGHT - 1);
        pass.region = (DipTargetRegion){x0, y0, x0 + 1 + random_int(random, 0, WIDTH - 1 - x0),
                                        y0 + 1 + random_int(random, 0, HEIGHT - 1 - y0)};
    }
    pass.clip_plane_count = random_int(random, 0, 2);
    for (int p = 0; p < pass.clip_plane_count; p++) {
        double plane[4];
        double clip[4];
        for (int i = 0; i < 4; i++) {
            plane[i] = random_real(random, -1.0, 1.0) * (i == 3 ? 20.0 : 1.0);
        }
        dip_view_plane(view, plane, clip);
        for (int i = 0; i < 4; i++) {
            pass.clip_planes[p][i] = (float)clip[i];
        }
    }
    return pass;
}

// Returns true if a point, in world space, lies in the part of the picture that a pass draws.
static bool shows(const DipPass *pass, const DipView *view, const double world[3]) {
    double clip[4];
    for (int r = 0; r < 4; r++) {
        const double *m = view->world_to_clip + 4 * r;
        clip[r] = m[0] * world[0] + m[1] * world[1] + m[2] * world[2] + m[3];
    }
    for (int p = 0; p < pass->clip_plane_count; p++) {
        const float *plane = pass->clip_planes[p];
        if (plane[0] * clip[0] + plane[1] * clip[1] + plane[2] * clip[2] + plane[3] * clip[3] < 0) {
            return false;
        }
    }
    const DipTargetRegion whole = {0, 0, WIDTH, HEIGHT};
    const DipTargetRegion *region = pass->region.x1 ? &pass->region : &whole;
    const double x = (clip[0] / clip[3] + 1.0) * 0.5 * WIDTH;
    const double y = (1.0 - clip[1] / clip[3]) * 0.5 * HEIGHT;
    return clip[3] >= clip[2] && x >= region->x0 && x <= region->x1 && y >= region->y0 &&
           y <= region->y1;
}

// Picks a random point of one of a chunk's triangles. Half of the time the point is a corner.
static void random_point(Random *random, const DipMesh *mesh, const DipChunk *chunk, uint32_t t,
                         const float transform[12], double world[3]) {
    const double u = random_real(random, 0.0, 1.0);
    const double v = random_real(random, 0.0, 1.0 - u);
    const bool corner = random_int(random, 0, 1);
    const double weight[3] = {corner ? 1.0 : u, corner ? 0.0 : v, corner ? 0.0 : 1.0 - u - v};
    double local[3] = {0.0, 0.0, 0.0};
    for (uint32_t k = 0; k < 3; k++) {
        const uint32_t vertex =
            chunk->first_vertex +
            mesh->indices[chunk->first_index + k * dip_corner_stride(chunk) + t];
        for (uint32_t c = 0; c < 3; c++) {
            local[c] += weight[k] * mesh->attributes[c * mesh->vertex_total + vertex];
        }
    }
    for (int axis = 0; axis < 3; axis++) {
        const float *m = transform + 4 * axis;
        world[axis] = m[0] * local[0] + m[1] * local[1] + m[2] * local[2] + m[3];
    }
}

static bool shows_some(Random *random, const DipPass *pass, const DipView *view,
                       const float transform[12], const DipMesh *mesh, uint32_t chunk) {
    for (uint32_t t = 0; t < mesh->chunks[chunk].triangle_count; t++) {
        for (int i = 0; i < POINTS; i++) {
            double world[3];
            random_point(random, mesh, &mesh->chunks[chunk], t, transform, world);
            if (shows(pass, view, world)) {
                return true;
            }
        }
    }
    return false;
}

typedef struct Kept {
    int seen;    // chunks with a visible point
    int objects; // objects that culling keeps
    int chunks;  // chunks that culling keeps
} Kept;

static void check_object(Random *random, DipPass *pass, const DipView *view, const DipMesh *mesh,
                         Kept *kept) {
    DipVisibleChunk visible[64];
    float transform[12];
    float to_clip[16];
    random_transform(random, transform);
    double exact_to_clip[16];
    dip_view_object_to_clip(view, transform, (const float[3]){0.0f, 0.0f, 0.0f}, exact_to_clip);
    for (int i = 0; i < 16; i++) {
        to_clip[i] = (float)exact_to_clip[i];
    }
    const DipDraw draw = {.mesh = mesh, .bounds_to_clip = to_clip};
    pass->draws = &draw;
    pass->draw_count = 1;
    const DipCullPlanes planes = dip_cull_pass_planes(pass, view->world_to_clip);
    const DipBox bounds = dip_cull_transform_box(transform, &mesh->box);
    const bool object = !dip_cull_outside(&planes, &bounds);
    uint64_t in_view = 0;
    uint64_t culled = 0;
    const uint32_t count = dip_cull_chunks(pass, NULL, NULL, visible, &in_view, &culled);
    assert_int_equal(in_view, count > 0);
    assert_int_equal(culled, count == 0);
    uint32_t next = 0;
    for (uint32_t c = 0; c < mesh->chunk_count; c++) {
        const bool chunk = next < count && visible[next].chunk == c;
        next += chunk;
        if (shows_some(random, pass, view, transform, mesh, c)) {
            assert_true(object && chunk);
            kept->seen++;
        }
    }
    assert_int_equal(next, count);
    kept->objects += object;
    kept->chunks += (int)count;
}

static void culling_keeps_everything_visible(void **state) {
    (void)state;
    Random random = {1234};
    Kept kept = {0};
    int chunks = 0;
    for (int m = 0; m < PLACED; m++) {
        DipMesh *mesh = random_mesh(&random);
        for (int i = 0; i < VIEWS / PLACED; i++) {
            const DipView view = random_view(&random, (double)WIDTH / HEIGHT);
            DipPass pass = random_part(&random, &view);
            for (int object = 0; object < PLACED; object++) {
                check_object(&random, &pass, &view, mesh, &kept);
                chunks += (int)mesh->chunk_count;
            }
        }
        dip_mesh_destroy(&mesh);
    }
    printf("%d objects, %d kept; %d chunks, %d kept, %d seen\n", VIEWS * PLACED, kept.objects,
           chunks, kept.chunks, kept.seen);
    assert_true(kept.seen > 1000);
    assert_true(kept.objects < VIEWS * PLACED / 2);
}

enum { DRAWS = 1000, THREADS = 3 };

// Returns the chunks of one draw that are in view.
static uint32_t cull_alone(const DipPass *pass, uint32_t draw, DipVisibleChunk *visible,
                           uint64_t *in_view, uint64_t *culled) {
    DipPass alone = *pass;
    alone.draws = &pass->draws[draw];
    alone.draw_count = 1;
    const uint32_t count = dip_cull_chunks(&alone, NULL, NULL, visible, in_view, culled);
    for (uint32_t i = 0; i < count; i++) {
        visible[i].draw = draw;
    }
    return count;
}

// Makes DRAWS draws of a mesh at random places. All of every third hundred is in view.
static void place_draws(Random *random, const DipView *view, const DipMesh *mesh, DipDraw *draws,
                        float (*matrices)[16]) {
    for (int d = 0; d < DRAWS; d++) {
        float transform[12];
        double to_clip[16];
        random_transform(random, transform);
        dip_view_object_to_clip(view, transform, (const float[3]){0.0f, 0.0f, 0.0f}, to_clip);
        for (int i = 0; i < 16; i++) {
            matrices[d][i] = (float)to_clip[i];
        }
        draws[d] = (DipDraw){.mesh = mesh, .bounds_to_clip = d / 100 % 3 ? matrices[d] : NULL};
    }
}

// Several threads cull the draws of a pass part by part. The chunks are those of each draw alone,
// in the given order.
static void threads_keep_the_order_of_draws(void **state) {
    (void)state;
    static DipDraw draws[DRAWS];
    static float matrices[DRAWS][16];
    static uint32_t order[DRAWS];
    Random random = {77};
    DipMesh *mesh = random_mesh(&random);
    DipPool *pool = dip_pool_create(THREADS, NULL);
    const DipPose pose = {.orientation = {0.0, 0.0, 0.0, 1.0}, .fov_y_deg = 60.0};
    const DipView view = dip_view_make(&pose, 0.1, (double)WIDTH / HEIGHT);
    DipPass pass = {.target = {.width = WIDTH, .height = HEIGHT}};
    place_draws(&random, &view, mesh, draws, matrices);
    pass.draws = draws;
    DipVisibleChunk *found = calloc(mesh->chunk_count * DRAWS, sizeof *found);
    DipVisibleChunk *expected = calloc(mesh->chunk_count * DRAWS, sizeof *expected);
    assert_true(pool && found && expected);
    for (pass.draw_count = DRAWS; pass.draw_count > 0; pass.draw_count -= 111) {
        const uint32_t draw_count = (uint32_t)pass.draw_count;
        uint64_t counts[4] = {0};
        uint32_t count = 0;
        for (uint32_t i = 0; i < draw_count; i++) {
            order[i] = (i + draw_count / 2) % draw_count;
        }
        for (uint32_t i = 0; i < draw_count; i++) {
            count += cull_alone(&pass, order[i], expected + count, &counts[0], &counts[1]);
        }
        assert_int_equal(dip_cull_chunks(&pass, order, pool, found, &counts[2], &counts[3]), count);
        assert_memory_equal(found, expected, count * sizeof *found);
        assert_int_equal(counts[2], counts[0]);
        assert_int_equal(counts[3], counts[1]);
        assert_true(draw_count < DRAWS || (counts[0] > 20 && counts[1] > 20));
    }
    free(found);
    free(expected);
    dip_pool_destroy(&pool);
    dip_mesh_destroy(&mesh);
}

// --- more memory than first allocated ----------------------------------------------------------

static const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

// One corner of each triangle is nearer than the near plane (z > w = 1), so clipping turns each
// triangle into two.
// With the identity as matrix and w = 1, the view volume is -1..1, -1..1, 0..1, and user planes are
// those of the pass. A box that only one plane cuts away is culled by that plane alone.
static void each_plane_culls_by_itself(void **state) {
    (void)state;
    const double unchanged[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const float outside[DIP_VIEW_PLANES][3] = {{-3.0f, 0.1f, 0.5f}, {3.0f, -0.1f, 0.5f},
                                               {0.1f, -3.0f, 0.5f}, {0.1f, 3.0f, 0.5f},
                                               {0.1f, 0.2f, -2.0f}, {0.1f, 0.2f, 3.0f}};
    const DipCullPlanes view = dip_cull_view_planes(unchanged);
    for (int p = 0; p < DIP_VIEW_PLANES; p++) {
        DipBox box = {.extent = {0.4f, 0.4f, 0.4f}};
        memcpy(box.centre, outside[p], sizeof outside[p]);
        assert_true(dip_cull_outside(&view, &box));
        for (int c = 0; c < 3; c++) {
            box.extent[c] = 4.0f; // Reaches into the view.
        }
        assert_false(dip_cull_outside(&view, &box));
    }
    for (int p = 0; p < DIP_MAX_CLIP_PLANES; p++) {
        DipPass pass = {.clip_plane_count = DIP_MAX_CLIP_PLANES,
                        .target = {.rgba8 = NULL, .stride_bytes = 256, .width = 64, .height = 64}};
        for (int i = 0; i < DIP_MAX_CLIP_PLANES; i++) {
            pass.clip_planes[i][3] = 1.0f; // Cuts nothing away.
        }
        pass.clip_planes[p][0] = 1.0f;
        pass.clip_planes[p][3] = -0.5f; // Keeps x >= 0.5.
        const DipCullPlanes planes = dip_cull_pass_planes(&pass, unchanged);
        const DipBox left = {.centre = {-0.2f, 0.0f, 0.5f}, .extent = {0.3f, 0.3f, 0.3f}};
        const DipBox right = {.centre = {0.7f, 0.0f, 0.5f}, .extent = {0.3f, 0.3f, 0.3f}};
        assert_true(dip_cull_outside(&planes, &left));
        assert_false(dip_cull_outside(&planes, &right));
    }
}

// The first pixel of the viewport begins at -1, and its last one ends at 1; +y is up. A small box
// in the middle of a pixel is culled if, and only if, the pixel lies outside what the pass draws.
static void what_a_pass_draws_bounds_the_view(void **state) {
    (void)state;
    const double unchanged[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    static const DipTargetRegion rectangles[][2] = {
        {{8, 16, 40, 56}, {8, 16, 40, 56}},
        {{8, 16, 40, 56}, {12, 30, 33, 41}},
        {{3, 5, 60, 61}, {3, 20, 9, 61}},
        {{0, 0, 64, 64}, {10, 0, 11, 64}},
    };
    for (size_t i = 0; i < sizeof rectangles / sizeof *rectangles; i++) {
        const DipTargetRegion *viewport = &rectangles[i][0], *region = &rectangles[i][1];
        const DipPass pass = {
            .target = {.rgba8 = NULL, .stride_bytes = 256, .width = 64, .height = 64},
            .viewport = *viewport,
            .region = *region};
        const DipCullPlanes planes = dip_cull_pass_planes(&pass, unchanged);
        const double width = viewport->x1 - viewport->x0, height = viewport->y1 - viewport->y0;
        for (int pixel = 0; pixel < 64 * 64; pixel++) {
            const int x = pixel % 64, y = pixel / 64;
            const bool drawn = x / 8 >= region->x0 / 8 && x / 8 <= (region->x1 - 1) / 8 &&
                               y / 8 >= region->y0 / 8 && y / 8 <= (region->y1 - 1) / 8;
            const DipBox box = {.centre = {(float)(2.0 * (x + 0.5 - viewport->x0) / width - 1.0),
                                           (float)(1.0 - 2.0 * (y + 0.5 - viewport->y0) / height),
                                           0.5f},
                                .extent = {0.001f, 0.001f, 0.001f}};
            assert_int_equal(dip_cull_outside(&planes, &box), !drawn);
        }
    }
}

static void clipping_can_double_the_triangles(void **state) {
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
        const DipPipelineCounters counters =
            draw(mesh, identity, true, threads, NULL, NULL, pictures[0]);
        assert_int_equal(counters.triangles_in, COUNT);
        assert_int_equal(counters.triangles_drawn, 2 * COUNT);
        if (threads > 1) {
            assert_memory_equal(pictures[0], pictures[1], sizeof pictures[0]);
        }
        memcpy(pictures[1], pictures[0], sizeof pictures[0]);
        dip_mesh_destroy(&mesh);
    }
}

// The bounding box of each triangle covers all tiles of the picture except one row. So every
// triangle is in the bin (list of triangles) of each of 5 x 3 tiles.
static void many_triangles_can_lie_in_many_tiles(void **state) {
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
    const DipPipelineCounters counters = draw(mesh, identity, true, 2, NULL, NULL, pictures[0]);
    assert_int_equal(counters.triangles_drawn, COUNT);
    assert_int_equal(counters.tile_triangles, (uint64_t)COUNT * TILES);
    // The nearest triangle, which is drawn last, is on top.
    assert_int_equal(pictures[0][4 * (WIDTH * 150 + 20)], 255);
    dip_mesh_destroy(&mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(culling_never_changes_a_picture),
        cmocka_unit_test(a_region_equals_the_same_part_of_the_whole_picture),
        cmocka_unit_test(culling_keeps_everything_visible),
        cmocka_unit_test(threads_keep_the_order_of_draws),
        cmocka_unit_test(each_plane_culls_by_itself),
        cmocka_unit_test(what_a_pass_draws_bounds_the_view),
        cmocka_unit_test(clipping_can_double_the_triangles),
        cmocka_unit_test(many_triangles_can_lie_in_many_tiles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
