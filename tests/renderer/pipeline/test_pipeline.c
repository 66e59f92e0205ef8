// Tests the pipeline as its callers use it. Uses shaders of this file, and tests culling, user clip
// planes, clip shaders, the near plane, and input that must draw nothing.
#include "renderer/base/srgb.h"
#include "renderer/pipeline/pipeline.h"
#include "tests/support/srgb.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 100, HEIGHT = 70 };

// A vertex is a clip position x, y, z, w and one varying.
typedef struct Vertex {
    float clip[4];
    float value;
} Vertex;

static void vertex_shader(const DipVertexBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        for (int c = 0; c < 4; c++) {
            batch->clip[c][i] = batch->in[c][i];
        }
        batch->varying[0][i] = batch->in[4][i];
    }
}

static void white(DipFragmentBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        batch->colour[0][i] = batch->colour[1][i] = batch->colour[2][i] = 1.0f;
    }
}

static void grey(DipFragmentBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        batch->colour[0][i] = batch->colour[1][i] = batch->colour[2][i] = 0.2f;
    }
}

// Shows the varying as red, and its derivatives, scaled by the uniforms, as green and blue.
static void varying(DipFragmentBatch *batch) {
    const float scale = *(const float *)batch->uniforms;
    for (int i = 0; i < batch->count; i++) {
        batch->colour[0][i] = batch->varying[0][i];
        batch->colour[1][i] = batch->varying_dx[0][i] * scale;
        batch->colour[2][i] = batch->varying_dy[0][i] * scale;
    }
}

// Keeps a fragment if its varying is at least one half.
static void keep_upper_half(DipFragmentBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        batch->keep[i] = batch->varying[0][i] >= 0.5f;
    }
}

static uint8_t picture[WIDTH * HEIGHT * 4];

// Makes a draw of a mesh with this fragment shader and with defaults in all other fields.
static DipDraw draw_of(const DipMesh *mesh, DipFragmentShader *shader) {
    return (DipDraw){.mesh = mesh,
                     .vertex_shader = vertex_shader,
                     .fragment_shader = shader,
                     .varying_count = 1,
                     .cull = DIP_CULL_NONE};
}

static DipPass pass_of(const DipDraw *draws, int count, int samples) {
    return (DipPass){
        .draws = draws,
        .draw_count = count,
        .sample_count = samples,
        .target = {
            .rgba8 = picture, .stride_bytes = (size_t)WIDTH * 4, .width = WIDTH, .height = HEIGHT}};
}

static DipPipelineCounters run(const DipPass *pass) {
    DipPipelineCounters counters = {0};
    DipStageTimes times = {0};
    DipPool *pool = dip_pool_create(2, NULL);
    DipPipeline *pipeline = dip_pipeline_create(pool, dip_isa_best(), WIDTH, HEIGHT, NULL);
    assert_non_null(pipeline);
    memset(picture, 77, sizeof picture);
    assert_true(dip_pipeline_draw(pipeline, pass, &counters, &times, NULL));
    dip_pipeline_destroy(&pipeline);
    dip_pool_destroy(&pool);
    return counters;
}

static DipMesh *mesh_of(const Vertex *vertices, uint32_t vertex_count, const uint32_t *indices,
                        uint32_t index_count) {
    const DipMeshData data = {"test", &vertices[0].clip[0], 5, vertex_count, indices, index_count};
    DipMesh *mesh = dip_mesh_create(&data, NULL);
    assert_non_null(mesh);
    return mesh;
}

// Makes a quad over the whole picture at depth z, counter-clockwise to the eye. The varying runs
// from 0 at the left to 1 at the right.
static DipMesh *screen(float z) {
    const Vertex vertices[4] = {
        {{-1, -1, z, 1}, 0}, {{1, -1, z, 1}, 1}, {{1, 1, z, 1}, 1}, {{-1, 1, z, 1}, 0}};
    return mesh_of(vertices, 4, (const uint32_t[]){0, 1, 2, 0, 2, 3}, 6);
}

static int red(int x, int y) {
    return picture[4 * (y * WIDTH + x)];
}

static int lit_pixels(void) {
    int count = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        count += picture[4 * i] == 255;
    }
    return count;
}

static void every_pixel_is_drawn_once(void **state) {
    (void)state;
    DipMesh *mesh = screen(0.5f);
    for (int samples = 1; samples <= 8; samples += samples == 1 ? 1 : 2) {
        const DipDraw draw = draw_of(mesh, white);
        const DipPass pass = pass_of(&draw, 1, samples);
        const DipPipelineCounters counters = run(&pass);
        assert_int_equal(lit_pixels(), WIDTH * HEIGHT);
        // Pixels on the diagonal hold samples of both triangles, but both triangles belong to one
        // patch.
        assert_int_equal(counters.fragments_shaded, WIDTH * HEIGHT);
        assert_int_equal(counters.triangles_drawn, 2);
        assert_int_equal(counters.samples_shown, WIDTH * HEIGHT * samples);
        assert_int_equal(counters.target_bytes, WIDTH * HEIGHT * 4);
    }
    dip_mesh_destroy(&mesh);
}

// A pass of plain draws that does not store its colours leaves its target as it was, and counts no
// bytes.
static void a_pass_that_stores_no_colours_writes_nothing(void **state) {
    (void)state;
    DipMesh *mesh = screen(0.5f);
    const DipDraw draw = draw_of(mesh, white);
    for (int store = DIP_STORE_DISCARD; store <= DIP_STORE_REVERT; store++) {
        DipPass pass = pass_of(&draw, 1, 4);
        pass.attachments.colour_store = (DipStore)store;
        const DipPipelineCounters counters = run(&pass);
        assert_int_equal(counters.target_bytes, 0);
        assert_int_equal(counters.fragments_shaded, WIDTH * HEIGHT);
        for (size_t b = 0; store == DIP_STORE_REVERT && b < sizeof picture; b++) {
            assert_int_equal(picture[b], 77);
        }
    }
    dip_mesh_destroy(&mesh);
}

// A white triangle lies on black. The counter of visible samples must equal the number of white
// samples in the picture.
static void visible_samples_are_counted(void **state) {
    (void)state;
    const Vertex vertices[3] = {
        {{-0.9f, -0.7f, 0.5f, 1}, 0}, {{0.8f, -0.4f, 0.5f, 1}, 0}, {{-0.2f, 0.9f, 0.5f, 1}, 0}};
    DipMesh *mesh = mesh_of(vertices, 3, (const uint32_t[]){0, 1, 2}, 3);
    const DipDraw draw = draw_of(mesh, white);
    const DipPass single = pass_of(&draw, 1, 1);
    const uint64_t shown = run(&single).samples_shown;
    assert_int_equal(shown, lit_pixels());
    for (int samples = 2; samples <= 8; samples += 2) {
        const DipPass pass = pass_of(&draw, 1, samples);
        const DipPipelineCounters counters = run(&pass);
        uint64_t expected =
            0; // sum over all pixels; a pixel's light shows how many of its samples are white
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            expected += (uint64_t)lround(samples * dip_srgb_decode(picture[4 * i] / 255.0));
        }
        assert_int_equal(counters.samples_shown, expected);
    }
    dip_mesh_destroy(&mesh);
}

// Back-face culling keeps a counter-clockwise mesh; front-face culling removes it.
static void back_and_front_faces_are_culled_by_winding(void **state) {
    (void)state;
    DipMesh *mesh = screen(0.5f);
    DipDraw draw = draw_of(mesh, white);
    const DipPass pass = pass_of(&draw, 1, 1);
    draw.cull = DIP_CULL_BACK;
    run(&pass);
    assert_int_equal(lit_pixels(), WIDTH * HEIGHT);
    draw.cull = DIP_CULL_FRONT;
    run(&pass);
    assert_int_equal(lit_pixels(), 0);
    dip_mesh_destroy(&mesh);
}

// The plane x * 1 + w * c >= 0 keeps the part of the picture to the right of x = -c.
static void user_planes_cut_exactly_where_they_lie(void **state) {
    (void)state;
    DipMesh *mesh = screen(0.5f);
    const DipDraw draw = draw_of(mesh, white);
    DipPass pass = pass_of(&draw, 1, 1);
    // The last offset cuts off only two columns, so the vertices outside the plane are just
    // outside.
    const float offsets[4] = {0.0f, 0.5f, -0.5f, 0.96f};
    for (int i = 0; i < 4; i++) {
        pass.clip_plane_count = 1;
        memcpy(pass.clip_planes[0], (const float[]){1, 0, 0, offsets[i]}, sizeof(float[4]));
        run(&pass);
        const int first = (int)lround((1.0 - (double)offsets[i]) * WIDTH / 2);
        assert_int_equal(lit_pixels(), (WIDTH - first) * HEIGHT);
        assert_int_equal(red(first - 1, 9), 0);
        assert_int_equal(red(first, 9), 255);
    }
    // The six planes together keep only the rectangle between them.
    const float planes[6][4] = {{1, 0, 0, 0.5f},  {-1, 0, 0, 0.5f}, {0, 1, 0, 0.6f},
                                {0, -1, 0, 0.6f}, {1, 0, 0, 0.9f},  {0, 0, 1, 0}};
    pass.clip_plane_count = 6;
    memcpy(pass.clip_planes, planes, sizeof planes);
    run(&pass);
    assert_int_equal(lit_pixels(), WIDTH / 2 * (HEIGHT * 6 / 10));
    dip_mesh_destroy(&mesh);
}

static void a_clip_shader_removes_fragments_before_depth(void **state) {
    (void)state;
    DipMesh *front = screen(0.8f);
    DipMesh *back = screen(0.2f);
    DipDraw draws[2] = {draw_of(front, white), draw_of(back, grey)};
    draws[0].clip_shader = keep_upper_half;
    draws[0].clip_varying_count = 1;
    for (int samples = 1; samples <= 8; samples += samples == 1 ? 1 : 2) {
        const DipPass pass = pass_of(draws, 2, samples);
        const DipPipelineCounters counters = run(&pass);
        // Where the front quad is clipped away, the back quad must be visible, although it is drawn
        // later.
        assert_int_equal(lit_pixels(), WIDTH / 2 * HEIGHT);
        assert_true(red(0, 0) > 0 && red(0, 0) < 255);
        assert_true(counters.fragments_clip_tested >= WIDTH * HEIGHT);
    }
    dip_mesh_destroy(&front);
    dip_mesh_destroy(&back);
}

static void nearer_surfaces_win_and_the_first_of_equals_stays(void **state) {
    (void)state;
    DipMesh *front = screen(0.8f);
    DipMesh *back = screen(0.2f);
    DipMesh *same = screen(0.8f);
    const DipDraw draws[3] = {draw_of(back, grey), draw_of(front, white), draw_of(same, grey)};
    const DipPass pass = pass_of(draws, 3, 4);
    run(&pass);
    assert_int_equal(lit_pixels(), WIDTH * HEIGHT);
    dip_mesh_destroy(&front);
    dip_mesh_destroy(&back);
    dip_mesh_destroy(&same);
}

// w rises from 1 at the left to 3 at the right. The varying is therefore u(x) = (x / 3) / ((1 - x)
// + x / 3) for x = 0..1.
static void varyings_are_interpolated_in_perspective(void **state) {
    (void)state;
    const Vertex vertices[4] = {
        {{-1, -1, 0.5f, 1}, 0}, {{3, -3, 0.5f, 3}, 1}, {{3, 3, 0.5f, 3}, 1}, {{-1, 1, 0.5f, 1}, 0}};
    DipMesh *mesh = mesh_of(vertices, 4, (const uint32_t[]){0, 1, 2, 0, 2, 3}, 6);
    const float scale = 20.0f;
    DipDraw draw = draw_of(mesh, varying);
    draw.uniforms = &scale;
    const DipPass pass = pass_of(&draw, 1, 1);
    run(&pass);
    for (int x = 0; x < WIDTH; x++) {
        const double t = (x + 0.5) / WIDTH;
        const double below = 1.0 - t + t / 3.0;
        const double u = t / 3.0 / below;
        const double du = 1.0 / 3.0 / (below * below) / WIDTH * scale;
        const double expected[3] = {u, du, 0.0};
        for (int c = 0; c < 3; c++) {
            const double code = 255.0 * srgb_encode(expected[c]);
            assert_true(fabs(picture[4 * (30 * WIDTH + x) + c] - code) <= 0.6);
        }
    }
    dip_mesh_destroy(&mesh);
}

// Makes triangles in perspective that cross the picture and its borders.
static DipMesh *wide(void) {
    const Vertex vertices[4] = {{{-3, -1.5f, 0.2f, 2}, 0},
                                {{2, -2, 0.3f, 1}, 1},
                                {{9, 14, 0.1f, 8}, 0.7f},
                                {{-1, 1, 1, 1}, 0}};
    return mesh_of(vertices, 4, (const uint32_t[]){0, 1, 2, 0, 2, 3, 1, 3, 0}, 9);
}

// With a region, blocks inside the region get the same pixels as without a region. Blocks outside
// the region keep their old pixels.
static void blocks_outside_a_region_are_left_untouched(void **state) {
    (void)state;
    enum { TILE = 64, BLOCK = 8 };
    static uint8_t whole[sizeof picture];
    const float scale = 50.0f;
    DipMesh *mesh = wide();
    const Vertex small[3] = {
        {{0.4f, 0.1f, 0.9f, 1}, 0}, {{0.5f, 0.2f, 0.9f, 1}, 1}, {{0.3f, 0.6f, 0.8f, 1}, 0}};
    DipMesh *bounded = mesh_of(small, 3, (const uint32_t[]){0, 1, 2}, 3);
    DipDraw draws[2] = {draw_of(mesh, varying), draw_of(bounded, varying)};
    draws[0].uniforms = draws[1].uniforms = &scale;
    static const float as_it_is[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    draws[1].bounds_to_clip = as_it_is;
    DipPass pass = pass_of(draws, 2, 4);
    run(&pass);
    memcpy(whole, picture, sizeof whole);
    static const DipTargetRegion regions[] = {{0, 0, 1, 1},      {70, 0, 71, 3},   {3, 66, 60, 70},
                                              {64, 64, 100, 70}, {63, 63, 65, 65}, {65, 8, 80, 40}};
    for (size_t r = 0; r < sizeof regions / sizeof *regions; r++) {
        pass.region = regions[r];
        const DipPipelineCounters counters = run(&pass);
        const int across = (regions[r].x1 - 1) / TILE - regions[r].x0 / TILE + 1;
        const int down = (regions[r].y1 - 1) / TILE - regions[r].y0 / TILE + 1;
        const int x0 = regions[r].x0 / BLOCK;
        const int y0 = regions[r].y0 / BLOCK;
        const int x1 = (regions[r].x1 - 1) / BLOCK;
        const int y1 = (regions[r].y1 - 1) / BLOCK;
        assert_int_equal(counters.tiles_drawn, across * down);
        assert_int_equal(counters.tiles_spared, 4 - counters.tiles_drawn);
        // Only the last region contains the small triangle.
        const bool last = r + 1 == sizeof regions / sizeof *regions;
        assert_int_equal(counters.triangles_in, last ? 4 : 3);
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            const int x = i % WIDTH / BLOCK;
            const int y = i / WIDTH / BLOCK;
            for (int c = 0; c < 4; c++) {
                const bool within = x >= x0 && x <= x1 && y >= y0 && y <= y1;
                assert_int_equal(picture[4 * i + c], within ? whole[4 * i + c] : 77);
            }
        }
    }
    dip_mesh_destroy(&mesh);
    dip_mesh_destroy(&bounded);
}

// The caller may restrict each tile to a part, which is a rectangle of blocks. Drawing must not
// touch the blocks outside this part. Tests triangles in the bins of tiles and triangles in the
// list of wide triangles.
static void blocks_outside_tile_parts_are_left_untouched(void **state) {
    (void)state;
    enum { TILE = 64, BLOCK = 8, TILES_X = (WIDTH + TILE - 1) / TILE };
    enum { TILES = TILES_X * ((HEIGHT + TILE - 1) / TILE) };
    static uint8_t whole[sizeof picture];
    const float scale = 50.0f;
    DipMesh *mesh = wide();
    DipDraw draw = draw_of(mesh, varying);
    draw.uniforms = &scale;
    DipPass pass = pass_of(&draw, 1, 4);
    run(&pass);
    memcpy(whole, picture, sizeof whole);
    static const DipTileRegion choice[] = {
        {0, 0, 0, 0}, {0, 0, TILE, TILE}, {8, 16, 24, 40}, {56, 0, TILE, 8}};
    DipTileRegion parts[TILES];
    pass.tile_regions = parts;
    for (int first = 0; first < 4; first++) {
        uint64_t drawn = 0;
        for (int t = 0; t < TILES; t++) {
            parts[t] = choice[(first + t) % 4];
            drawn += parts[t].x1 != 0;
        }
        const DipPipelineCounters counters = run(&pass);
        assert_int_equal(counters.tiles_drawn, drawn);
        assert_int_equal(counters.tiles_spared, TILES - drawn);
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            const int x = i % WIDTH;
            const int y = i / WIDTH;
            const DipTileRegion *part = &parts[y / TILE * TILES_X + x / TILE];
            const bool within = x % TILE >= part->x0 && x % TILE < part->x1 &&
                                y % TILE >= part->y0 && y % TILE < part->y1;
            for (int c = 0; c < 4; c++) {
                assert_int_equal(picture[4 * i + c], within ? whole[4 * i + c] : 77);
            }
        }
    }
    dip_mesh_destroy(&mesh);
}

// Samples the target that the uniforms point to, rotated by 180 degrees.
static void turned_copy(DipFragmentBatch *batch) {
    float u[DIP_FRAGMENT_BATCH] = {0};
    float v[DIP_FRAGMENT_BATCH] = {0};
    for (int i = 0; i < batch->count; i++) {
        u[i] = 1.0f - batch->x[i] / WIDTH;
        v[i] = 1.0f - batch->y[i] / HEIGHT;
    }
    batch->sample_target(batch, batch->uniforms, u, v, batch->colour);
}

// Samples the first row: halfway between two texel centres in the left half of the picture, and far
// outside the target in the right half.
static void halfway(DipFragmentBatch *batch) {
    float u[DIP_FRAGMENT_BATCH] = {0};
    float v[DIP_FRAGMENT_BATCH] = {0};
    for (int i = 0; i < batch->count; i++) {
        const float far = batch->y[i] < 10.0f ? NAN : batch->y[i] < 20.0f ? 1e30f : -INFINITY;
        u[i] = batch->x[i] < 50.0f ? 1.0f / WIDTH : far;
        v[i] = 0.5f / HEIGHT;
    }
    batch->sample_target(batch, batch->uniforms, u, v, batch->colour);
}

static void a_pass_samples_the_target_of_an_earlier_pass(void **state) {
    (void)state;
    static uint8_t before[sizeof picture];
    for (size_t i = 0; i < sizeof before; i++) {
        before[i] = i % 4 == 3 ? 255 : (uint8_t)(i * 2654435761u >> 13);
    }
    before[0] = 0; // the first row's red begins with 0 and 255 and ends with 200
    before[4] = 255;
    before[4 * (WIDTH - 1)] = 200;
    const DipTarget target = {
        .rgba8 = before, .stride_bytes = (size_t)WIDTH * 4, .width = WIDTH, .height = HEIGHT};
    DipMesh *mesh = screen(0.5f);
    DipDraw draw = draw_of(mesh, turned_copy);
    draw.uniforms = &target;
    const DipPass pass = pass_of(&draw, 1, 1);
    const DipPipelineCounters counters = run(&pass);
    assert_int_equal(counters.texture_probes, WIDTH * HEIGHT); // One bilinear read per fragment.
    assert_int_equal(counters.texels_fetched, 4 * WIDTH * HEIGHT);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        assert_memory_equal(picture + 4 * i, before + 4 * (WIDTH * HEIGHT - 1 - i), 4);
    }
    draw.fragment_shader = halfway;
    run(&pass);
    assert_int_equal(red(10, 30), 188); // half of white's linear light
    assert_int_equal(red(60, 5), 0);
    assert_int_equal(red(60, 15), 200);
    assert_int_equal(red(60, 50), 0);
    dip_mesh_destroy(&mesh);
}

// The drawn floor begins behind the eye. Only its part beyond the near plane (z = w) is visible.
static void the_near_plane_cuts_exactly(void **state) {
    (void)state;
    // y is -1/2 everywhere, and w runs from -1 (behind the eye) to 3. z is 1 everywhere, so the
    // floor is cut at w = 1. In the picture, w = 1 lies at y = -1/2, and w = 3 at y = -1/6.
    const Vertex vertices[4] = {{{-9, -0.5f, 1, -1}, 0},
                                {{9, -0.5f, 1, -1}, 0},
                                {{9, -0.5f, 1, 3}, 1},
                                {{-9, -0.5f, 1, 3}, 1}};
    DipMesh *mesh = mesh_of(vertices, 4, (const uint32_t[]){0, 1, 2, 0, 2, 3}, 6);
    const DipDraw draw = draw_of(mesh, white);
    const DipPass pass = pass_of(&draw, 1, 1);
    run(&pass);
    const double far_edge = (1.0 + 1.0 / 6.0) / 2.0 * HEIGHT;
    const double cut = (1.0 + 1.0 / 2.0) / 2.0 * HEIGHT;
    for (int y = 0; y < HEIGHT; y++) {
        const double centre = y + 0.5;
        if (fabs(centre - far_edge) > 0.01 && fabs(centre - cut) > 0.01) {
            assert_int_equal(red(WIDTH / 2, y), centre > far_edge && centre < cut ? 255 : 0);
        }
    }
    dip_mesh_destroy(&mesh);
}

// The index of a clip coordinate of the third vertex, and the bad value that replaces this
// coordinate.
typedef struct Bad {
    int coordinate;
    float value;
} Bad;

static void bad_vertex_shader(const DipVertexBatch *batch) {
    const Bad *bad = batch->uniforms;
    vertex_shader(batch);
    batch->clip[bad->coordinate][2] = bad->value;
}

static void triangles_with_impossible_vertices_are_not_drawn(void **state) {
    (void)state;
    const float values[] = {NAN, INFINITY, -INFINITY, 3e38f};
    const Vertex vertices[6] = {{{-1, -1, 0.5f, 1}, 0},      {{1, -1, 0.5f, 1}, 0},
                                {{0, 1, 0.5f, 1}, 0},        {{-0.1f, -0.1f, 0.5f, 1}, 0},
                                {{0.1f, -0.1f, 0.5f, 1}, 0}, {{0, 0.1f, 0.5f, 1}, 0}};
    DipMesh *mesh = mesh_of(vertices, 6, (const uint32_t[]){0, 1, 2, 3, 4, 5}, 6);
    for (int i = 0; i < 16; i++) {
        const Bad bad = {i / 4, values[i % 4]};
        DipDraw draw = draw_of(mesh, white);
        draw.vertex_shader = bad_vertex_shader;
        draw.uniforms = &bad;
        const DipPass pass = pass_of(&draw, 1, 1);
        const DipPipelineCounters counters = run(&pass);
        // The triangle with the bad vertex is not drawn; the other one is drawn completely.
        assert_int_equal(counters.triangles_drawn, 1);
        assert_int_equal(red(WIDTH / 2, HEIGHT / 2), 255);
        assert_int_equal(red(WIDTH / 2, HEIGHT - 2), 0);
    }
    dip_mesh_destroy(&mesh);
}

static void invalid_mesh_data_is_refused(void **state) {
    (void)state;
    const float good[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    const float nan[9] = {0, 0, 0, 1, NAN, 0, 0, 1, 0};
    static const struct {
        int attributes;
        uint32_t index_count;
        uint32_t indices[3];
        bool nan;
        DipErrorCode code;
        const char *key;
    } rows[] = {
        {2, 3, {0, 1, 2}, false, DIP_ERROR_RANGE, "attributes"},
        {DIP_MAX_ATTRIBUTES + 1, 3, {0, 1, 2}, false, DIP_ERROR_RANGE, "attributes"},
        {3, 2, {0, 1, 2}, false, DIP_ERROR_FORMAT, "indices"},
        {3, 3, {0, 1, 3}, false, DIP_ERROR_RANGE, "indices[2]"},
        {3, 3, {0, 1, 0xffffffffu}, false, DIP_ERROR_RANGE, "indices[2]"},
        {3, 3, {0, 1, 2}, true, DIP_ERROR_RANGE, "vertices"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        DipError err = {0};
        const DipMeshData data = {"bad", rows[i].nan ? nan : good, rows[i].attributes,
                                  3,     rows[i].indices,          rows[i].index_count};
        assert_null(dip_mesh_create(&data, &err));
        assert_int_equal(err.code, rows[i].code);
        assert_string_equal(err.key, rows[i].key);
        assert_string_equal(err.file, "bad");
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_pixel_is_drawn_once),
        cmocka_unit_test(a_pass_that_stores_no_colours_writes_nothing),
        cmocka_unit_test(visible_samples_are_counted),
        cmocka_unit_test(back_and_front_faces_are_culled_by_winding),
        cmocka_unit_test(user_planes_cut_exactly_where_they_lie),
        cmocka_unit_test(a_clip_shader_removes_fragments_before_depth),
        cmocka_unit_test(nearer_surfaces_win_and_the_first_of_equals_stays),
        cmocka_unit_test(varyings_are_interpolated_in_perspective),
        cmocka_unit_test(the_near_plane_cuts_exactly),
        cmocka_unit_test(blocks_outside_a_region_are_left_untouched),
        cmocka_unit_test(blocks_outside_tile_parts_are_left_untouched),
        cmocka_unit_test(a_pass_samples_the_target_of_an_earlier_pass),
        cmocka_unit_test(triangles_with_impossible_vertices_are_not_drawn),
        cmocka_unit_test(invalid_mesh_data_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
