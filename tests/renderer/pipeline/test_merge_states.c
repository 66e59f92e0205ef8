// Tests draw states, attachments and formats (renderer/pipeline/state.h) against closed forms:
// published blend results, wireframes by distances to edges, depth bias, shadow maps by brute
// force, formats, viewports, and the fields that a pass check refuses.
#include "renderer/base/srgb.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/catalogue/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 96, HEIGHT = 72 };

typedef struct Colour {
    float channel[4];
} Colour;

static DipPool *pool;
static DipPipeline *pipeline;

static int open_pipeline(void **state) {
    (void)state;
    pool = dip_pool_create(2, NULL);
    pipeline = dip_pipeline_create(pool, dip_isa_best(), WIDTH, HEIGHT, NULL);
    return pipeline ? 0 : 1;
}

static int close_pipeline(void **state) {
    (void)state;
    dip_pipeline_destroy(&pipeline);
    dip_pool_destroy(&pool);
    return 0;
}

// Positions are pixels and a depth. Varying 0 is the depth.
static void in_pixels(const DipVertexBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        batch->clip[0][i] = batch->in[0][i] * (2.0f / WIDTH) - 1.0f;
        batch->clip[1][i] = 1.0f - batch->in[1][i] * (2.0f / HEIGHT);
        batch->clip[2][i] = batch->in[2][i];
        batch->clip[3][i] = 1.0f;
        batch->varying[0][i] = batch->in[2][i];
    }
}

static void one_colour(DipFragmentBatch *batch) {
    const Colour *colour = batch->uniforms;
    for (int i = 0; i < batch->count; i++) {
        for (int c = 0; c < 3; c++) {
            batch->colour[c][i] = colour->channel[c];
        }
        batch->alpha[i] = colour->channel[3];
    }
}

static DipMesh *triangles(const float *corners, uint32_t count) {
    uint32_t indices[64];
    for (uint32_t i = 0; i < count; i++) {
        indices[i] = i;
    }
    const DipMeshData data = {"triangles", corners, 3, count, indices, count};
    DipMesh *mesh = dip_mesh_create(&data, NULL);
    assert_non_null(mesh);
    return mesh;
}

// A rectangle of two triangles from (x0, y0) to (x1, y1).
static DipMesh *rectangle(float x0, float y0, float x1, float y1, float depth) {
    const float corners[6][3] = {{x0, y0, depth}, {x0, y1, depth}, {x1, y1, depth},
                                 {x0, y0, depth}, {x1, y1, depth}, {x1, y0, depth}};
    return triangles(&corners[0][0], 6);
}

static DipDraw draw_of(const DipMesh *mesh, const Colour *colour, const DipDrawState *state) {
    return (DipDraw){.mesh = mesh,
                     .vertex_shader = in_pixels,
                     .fragment_shader = one_colour,
                     .varying_count = 1,
                     .uniforms = colour,
                     .state = state};
}

static uint8_t picture[HEIGHT][WIDTH][4];

static DipPass pass_of(const DipDraw *draws, int count, int sample_count) {
    return (DipPass){.draws = draws,
                     .draw_count = count,
                     .sample_count = sample_count,
                     .target = {.rgba8 = &picture[0][0][0],
                                .stride_bytes = sizeof picture[0],
                                .width = WIDTH,
                                .height = HEIGHT}};
}

static void run(const DipPass *pass) {
    DipPipelineCounters counters = {0};
    DipStageTimes times = {0};
    DipError err = {0};
    if (!dip_pipeline_draw(pipeline, pass, &counters, &times, &err)) {
        fail_msg("%s: %s", err.key, err.message);
    }
}

// --- blending ------------------------------------------------------------------------------------

// Two overlapping rectangles, blue with alpha 1 and yellow with alpha 1/2, over grey 128. The codes
// are those of blue alone, yellow alone and both, blended in linear light and in codes.
typedef struct Mode {
    DipBlend blend;
    int linear_light[3][3];
    int codes[3][3];
} Mode;

static void draw_mode(const Mode *mode, bool in_codes) {
    static const Colour colours[2] = {{{0, 0, 1, 1}}, {{1, 1, 0, 0.5f}}};
    const DipDrawState state = {.blend = mode->blend, .depth_test = DIP_DEPTH_ALWAYS};
    DipMesh *meshes[2] = {rectangle(8, 8, 48, 48, 0.5f), rectangle(32, 8, 80, 48, 0.5f)};
    const DipDraw draws[2] = {draw_of(meshes[0], &colours[0], &state),
                              draw_of(meshes[1], &colours[1], &state)};
    DipPass pass = pass_of(draws, 2, 1);
    DipSrgbDecodeTable table;
    dip_srgb_decode_table(&table);
    pass.target.format = in_codes ? DIP_FORMAT_LINEAR8 : DIP_FORMAT_SRGB8;
    for (int c = 0; c < 3; c++) {
        pass.clear_lin[c] = in_codes ? 128.0f / 255.0f : (float)table.linear[128];
    }
    run(&pass);
    static const int at[3] = {16, 64, 40};
    for (int k = 0; k < 3; k++) {
        for (int c = 0; c < 3; c++) {
            const int expected = in_codes ? mode->codes[k][c] : mode->linear_light[k][c];
            const int found = picture[20][at[k]][c];
            if (abs(found - expected) > (in_codes ? 1 : 0)) {
                fail_msg("place %d, channel %d: code %d, expected %d", k, c, found, expected);
            }
        }
    }
    dip_mesh_destroy(&meshes[0]);
    dip_mesh_destroy(&meshes[1]);
}

static void published_modes(void **state) {
    (void)state;
    static const Mode modes[] = {
        {DIP_BLEND_MODE_ADDITIVE,
         {{128, 128, 255}, {220, 220, 128}, {220, 220, 255}},
         {{128, 128, 255}, {255, 255, 128}, {255, 255, 255}}},
        {DIP_BLEND_MODE_MULTIPLICATIVE,
         {{0, 0, 128}, {128, 128, 0}, {0, 0, 0}},
         {{0, 0, 128}, {128, 128, 0}, {0, 0, 0}}},
        {DIP_BLEND_MODE_DOUBLE_MULTIPLICATIVE,
         {{0, 0, 176}, {176, 176, 0}, {0, 0, 0}},
         {{0, 0, 255}, {255, 255, 0}, {0, 0, 0}}},
        {DIP_BLEND_MODE_ALPHA,
         {{0, 0, 255}, {205, 205, 92}, {188, 188, 188}},
         {{0, 0, 255}, {191, 191, 64}, {128, 128, 128}}},
        {DIP_BLEND_MODE_PREMULTIPLIED,
         {{0, 0, 255}, {255, 255, 92}, {255, 255, 188}},
         {{0, 0, 255}, {255, 255, 64}, {255, 255, 128}}},
    };
    for (size_t i = 0; i < sizeof modes / sizeof *modes; i++) {
        draw_mode(&modes[i], false);
        draw_mode(&modes[i], true);
    }
}

// Two premultiplied colours over a transparent layer, and the layer over a background, are the same
// as both over the background.
static void premultiplied_layers(void **state) {
    (void)state;
    static float floats[HEIGHT][WIDTH][4];
    static const Colour colours[2] = {{{0.3f, 0.1f, 0.05f, 0.4f}}, {{0.02f, 0.2f, 0.3f, 0.75f}}};
    static const DipDrawState layer = {.blend = DIP_BLEND_MODE_PREMULTIPLIED,
                                       .depth_test = DIP_DEPTH_ALWAYS};
    DipMesh *mesh = rectangle(8, 8, 48, 48, 0.5f);
    const DipDraw draws[2] = {draw_of(mesh, &colours[0], &layer),
                              draw_of(mesh, &colours[1], &layer)};
    DipPass pass = pass_of(draws, 2, 1);
    pass.target.format = DIP_FORMAT_RGBA32F;
    pass.target.floats = &floats[0][0][0];
    pass.target.stride_bytes = sizeof floats[0];
    pass.attachments.clear_transparent = true;
    run(&pass);
    const float *found = floats[20][20];
    assert_true(fabs((double)found[3] - (1.0 - 0.6 * 0.25)) < 1e-6);
    for (int c = 0; c < 3; c++) {
        const double background = 0.5 + 0.1 * c;
        const double first = (double)colours[0].channel[c] + background * 0.6;
        const double both = (double)colours[1].channel[c] + first * 0.25;
        const double of_layer = (double)found[c] + background * (1.0 - (double)found[3]);
        assert_true(fabs(of_layer - both) < 1e-6);
    }
    assert_true(floats[60][20][3] == 0.0f);
    dip_mesh_destroy(&mesh);
}

// A pass that keeps the target's colours stores every code unchanged, also where a draw has touched
// them without effect.
static void kept_codes(void **state) {
    (void)state;
    static const Colour colour = {{0.3f, 0.6f, 0.9f, 0.2f}};
    const DipDrawState invisible = {
        .blend = {.enabled = true,
                  .colour = {DIP_BLEND_ZERO, DIP_BLEND_ONE, DIP_BLEND_ADD},
                  .alpha = {DIP_BLEND_ZERO, DIP_BLEND_ONE, DIP_BLEND_ADD}}};
    DipMesh *mesh = rectangle(3, 3, 90, 40, 0.5f);
    const DipDraw draw = draw_of(mesh, &colour, &invisible);
    for (int format = DIP_FORMAT_SRGB8; format <= DIP_FORMAT_LINEAR8; format++) {
        for (int samples = 1; samples <= 8; samples += 7) {
            for (int i = 0; i < WIDTH * HEIGHT * 4; i++) {
                (&picture[0][0][0])[i] = (uint8_t)(i * 7 + i / 251);
            }
            static uint8_t before[HEIGHT][WIDTH][4];
            memcpy(before, picture, sizeof before);
            DipPass pass = pass_of(&draw, 1, samples);
            pass.target.format = (DipFormat)format;
            pass.attachments.colour_load = DIP_LOAD_KEEP;
            run(&pass);
            assert_memory_equal(before, picture, sizeof before);
        }
    }
    dip_mesh_destroy(&mesh);
}

// --- ordered and plain ---------------------------------------------------------------------------

static void depth_colour(DipFragmentBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        batch->colour[0][i] = batch->varying[0][i];
        batch->colour[1][i] = 0.5f + 0.2f * batch->varying_dx[0][i] * 64.0f;
        batch->colour[2][i] = 1.0f - batch->varying[0][i];
    }
}

// Plain draws that are marked as ordered have the same bits.
static void ordered_like_plain(void **state) {
    (void)state;
    static uint8_t plain[HEIGHT][WIDTH][4];
    static const DipDrawState ordered = {.ordered = true};
    Random random = {7};
    for (int round = 0; round < 60; round++) {
        DipMesh *meshes[4];
        DipDraw draws[4];
        float corners[12][3];
        for (int d = 0; d < 4; d++) {
            for (int i = 0; i < 12; i++) {
                corners[i][0] = (float)random_int(&random, -2000, WIDTH * 256 + 2000) / 256.0f;
                corners[i][1] = (float)random_int(&random, -2000, HEIGHT * 256 + 2000) / 256.0f;
                corners[i][2] = (float)random_real(&random, 0.1, 0.9);
            }
            meshes[d] = triangles(&corners[0][0], 12);
            draws[d] = draw_of(meshes[d], NULL, NULL);
            draws[d].fragment_shader = depth_colour;
        }
        DipPass pass = pass_of(draws, 4, 1);
        run(&pass);
        memcpy(plain, picture, sizeof plain);
        for (int first = 0; first < 4; first++) {
            for (int d = 0; d < 4; d++) {
                draws[d].state = d >= first ? &ordered : NULL;
            }
            run(&pass);
            assert_memory_equal(plain, picture, sizeof plain);
        }
        for (int d = 0; d < 4; d++) {
            dip_mesh_destroy(&meshes[d]);
        }
    }
}

// --- wireframes ----------------------------------------------------------------------------------

static double distance_to_line(const float a[3], const float b[3], double x, double y) {
    const double dx = (double)b[0] - a[0];
    const double dy = (double)b[1] - a[1];
    return fabs(dx * (y - a[1]) - dy * (x - a[0])) / sqrt(dx * dx + dy * dy);
}

static bool inside(const float *c, double x, double y) {
    int sides[2] = {0, 0};
    for (int i = 0; i < 3; i++) {
        const float *a = c + 3 * i;
        const float *b = c + 3 * ((i + 1) % 3);
        const double side = ((double)b[0] - a[0]) * (y - a[1]) - ((double)b[1] - a[1]) * (x - a[0]);
        sides[side > 0.0]++;
    }
    return !sides[0] || !sides[1];
}

// cut: the pixels x < 40 are clipped away. The new edge must not be drawn. What clipping leaves is
// divided into triangles, and a line ends where its triangle ends, so up to a third of the pixels
// near the edges may be missing.
static void check_wires(Random *random, bool cut) {
    static const Colour white = {{1, 1, 1, 1}};
    float c[3][3];
    for (int i = 0; i < 3; i++) {
        c[i][0] = (float)random_int(random, 0, WIDTH * 256) / 256.0f;
        c[i][1] = (float)random_int(random, 0, HEIGHT * 256) / 256.0f;
        c[i][2] = 0.5f;
    }
    const DipDrawState state = {.fill = DIP_FILL_WIREFRAME,
                                .line_width = (float)random_real(random, 0.5, cut ? 4.0 : 12.0)};
    DipMesh *mesh = triangles(&c[0][0], 3);
    const DipDraw draw = draw_of(mesh, &white, &state);
    DipPass pass = pass_of(&draw, 1, 1);
    if (cut) {
        pass.clip_plane_count = 1;
        pass.clip_planes[0][0] = 1.0f;
        pass.clip_planes[0][3] = 1.0f - 80.0f / WIDTH;
    }
    run(&pass);
    int expected_count = 0;
    int missing = 0;
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = cut ? 41 : 0; x < WIDTH; x++) {
            double nearest = 1e9;
            for (int i = 0; i < 3; i++) {
                nearest = fmin(nearest, distance_to_line(c[i], c[(i + 1) % 3], x + 0.5, y + 0.5));
            }
            const double from_line = nearest - 0.5 * (double)state.line_width;
            // Edge values are rounded, so nothing is said about samples within 1/32 pixel.
            if (fabs(from_line) < 1.0 / 32.0 || nearest < 1.0 / 32.0) {
                continue;
            }
            const bool expected = inside(&c[0][0], x + 0.5, y + 0.5) && from_line < 0.0;
            const bool drawn = picture[y][x][0] == 255;
            expected_count += expected;
            missing += expected && !drawn;
            if ((drawn && !expected) || (expected && !drawn && !cut)) {
                fail_msg("pixel %d, %d: distance %g, width %g, %s drawn", x, y, nearest,
                         (double)state.line_width, expected ? "not" : "wrongly");
            }
        }
    }
    assert_true(missing <= 8 + expected_count / 3);
    dip_mesh_destroy(&mesh);
}

static void wireframes(void **state) {
    (void)state;
    Random random = {5};
    for (int i = 0; i < 300; i++) {
        check_wires(&random, i % 2);
    }
}

// --- depth bias ----------------------------------------------------------------------------------

static void depth_bias(void **state) {
    (void)state;
    static const Colour white = {{1, 1, 1, 1}};
    Random random = {3};
    DipDepth *depth = dip_depth_create(WIDTH, HEIGHT, 1, NULL);
    for (int i = 0; i < 50; i++) {
        const double dx = random_real(&random, -0.004, 0.004);
        const double dy = random_real(&random, -0.004, 0.004);
        float c[6][3] = {{0, 0, 0}, {0, HEIGHT, 0},     {WIDTH, HEIGHT, 0},
                         {0, 0, 0}, {WIDTH, HEIGHT, 0}, {WIDTH, 0, 0}};
        for (int k = 0; k < 6; k++) {
            c[k][2] = (float)(0.5 + dx * ((double)c[k][0] - WIDTH / 2) +
                              dy * ((double)c[k][1] - HEIGHT / 2));
        }
        const DipDrawState biased = {.depth_bias = {(float)random_real(&random, -3.0, 3.0),
                                                    (float)random_real(&random, -2e5, 2e5),
                                                    (float)random_real(&random, -0.2, 0.2)}};
        DipMesh *mesh = triangles(&c[0][0], 6);
        const DipDraw draw = draw_of(mesh, &white, &biased);
        DipPass pass = pass_of(&draw, 1, 1);
        pass.attachments.depth = depth;
        run(&pass);
        for (int y = 0; y < HEIGHT; y++) {
            for (int x = 0; x < WIDTH; x++) {
                const double z = 0.5 + dx * (x + 0.5 - WIDTH / 2) + dy * (y + 0.5 - HEIGHT / 2);
                const double moved = z +
                                     (double)biased.depth_bias.slope * fmax(fabs(dx), fabs(dy)) +
                                     (double)biased.depth_bias.constant +
                                     (double)biased.depth_bias.relative * 0x1p-23 * z;
                const double found = dip_depth_row(depth, 0, y)[x];
                if (fabs(found - fmin(fmax(moved, 0.0), 1.0)) > 2e-6) {
                    for (int yy = 0; yy < 20; yy++) {
                        for (int xx = 0; xx < 96; xx++)
                            putchar(picture[yy][xx][0] ? 35 : 46);
                        putchar(10);
                    }
                    fail_msg("pixel %d, %d: depth %.8g, expected %.8g", x, y, found, moved);
                }
            }
        }
        dip_mesh_destroy(&mesh);
    }
    dip_depth_destroy(&depth);
}

// --- copies of depths ----------------------------------------------------------------------------

static void depths_are_copied(void **state) {
    (void)state;
    DipDepth *depth = dip_depth_create(5, 3, 4, NULL);
    DipDepth *copy = dip_depth_create(5, 3, 4, NULL);
    for (int s = 0; s < 4; s++) {
        for (int y = 0; y < 3; y++) {
            for (int x = 0; x < 5; x++) {
                dip_depth_row(depth, s, y)[x] = (float)(s * 100 + y * 10 + x) / 512.0f;
                dip_stencil_row(depth, s, y)[x] = (uint8_t)(s * 50 + y * 10 + x);
            }
        }
    }
    assert_true(dip_depth_copy(copy, depth, NULL));
    for (int s = 0; s < 4; s++) {
        for (int y = 0; y < 3; y++) {
            assert_memory_equal(dip_depth_row(copy, s, y), dip_depth_row(depth, s, y), 5 * 4);
            assert_memory_equal(dip_stencil_row(copy, s, y), dip_stencil_row(depth, s, y), 5);
        }
    }
    static const int others[3][3] = {{6, 3, 4}, {5, 4, 4}, {5, 3, 2}};
    for (int k = 0; k < 3; k++) {
        DipDepth *other = dip_depth_create(others[k][0], others[k][1], others[k][2], NULL);
        DipError err = {0};
        assert_false(dip_depth_copy(other, depth, &err));
        assert_int_equal(err.code, DIP_ERROR_CONFLICT);
        assert_true(dip_depth_row(other, 1, 2)[4] == 0.0f);
        dip_depth_destroy(&other);
    }
    dip_depth_destroy(&copy);
    dip_depth_destroy(&depth);
}

// --- passes without colours, shadow maps ---------------------------------------------------------

// A pass without colours leaves the depths that the same pass with colours leaves, and runs no
// fragment shader.
static void depth_only(void **state) {
    (void)state;
    static const Colour white = {{1, 1, 1, 1}};
    const float c[3][3] = {{-20, 5, 0.1f}, {90, 10, 0.9f}, {30, 80, 0.4f}};
    DipMesh *mesh = triangles(&c[0][0], 3);
    DipDepth *depths[2];
    for (int i = 0; i < 2; i++) {
        depths[i] = dip_depth_create(WIDTH, HEIGHT, 4, NULL);
        DipDraw draw = draw_of(mesh, &white, NULL);
        DipPass pass = pass_of(&draw, 1, 4);
        pass.attachments.depth = depths[i];
        if (i == 1) {
            draw.fragment_shader = NULL;
            pass.target.rgba8 = NULL;
        }
        run(&pass);
    }
    int covered = 0;
    for (int s = 0; s < 4; s++) {
        for (int y = 0; y < HEIGHT; y++) {
            assert_memory_equal(dip_depth_row(depths[0], s, y), dip_depth_row(depths[1], s, y),
                                WIDTH * sizeof(float));
            for (int x = 0; x < WIDTH; x++) {
                covered += dip_depth_row(depths[0], s, y)[x] > 0.0f;
            }
        }
    }
    assert_in_range(covered, 4 * 2000, 4 * WIDTH * HEIGHT);
    dip_depth_destroy(&depths[0]);
    dip_depth_destroy(&depths[1]);
    dip_mesh_destroy(&mesh);
}

enum { MAP_WIDTH = 13, MAP_HEIGHT = 9, READS = 64 };

typedef struct ShadowReads {
    DipShadowMap map;
    float u[READS], v[READS], z[READS];
    float lit[READS];
} ShadowReads;

// Runs the reads in one fragment, whatever its position.
static void read_shadow(DipFragmentBatch *batch) {
    ShadowReads *reads = *(ShadowReads *const *)batch->uniforms;
    float lit[READS];
    const int count = batch->count;
    batch->count = READS;
    batch->sample_shadow(batch, &reads->map, reads->u, reads->v, reads->z, lit);
    batch->count = count;
    memcpy(reads->lit, lit, sizeof lit);
}

static double texel_lit(DipDepth *depth, int x, int y, double z) {
    x = x < 0 ? 0 : x >= MAP_WIDTH ? MAP_WIDTH - 1 : x;
    y = y < 0 ? 0 : y >= MAP_HEIGHT ? MAP_HEIGHT - 1 : y;
    return z >= (double)dip_depth_row(depth, 0, y)[x];
}

// Returns the mean over a square of 2x2 texels around a point, in texels. Each texel has the weight
// of the area that it has in common with the square.
static double wide_light(DipDepth *depth, double x, double y, double z) {
    double sum = 0.0;
    for (int row = (int)floor(y - 1.0); row < y + 1.0; row++) {
        const double height = fmin(row + 1.0, y + 1.0) - fmax(row, y - 1.0);
        for (int column = (int)floor(x - 1.0); column < x + 1.0; column++) {
            const double width = fmin(column + 1.0, x + 1.0) - fmax(column, x - 1.0);
            sum += width * height * texel_lit(depth, column, row, z);
        }
    }
    return sum / 4.0;
}

static double expected_light(const ShadowReads *reads, DipDepth *depth, int i) {
    const double u = reads->u[i];
    const double v = reads->v[i];
    const double z = fmax(reads->z[i], 0.0); // behind the far plane: as if on it
    if (u < 0.0 || u > 1.0 || v < 0.0 || v > 1.0) {
        return 1.0;
    }
    if (reads->map.filter == DIP_SHADOW_NEAREST) {
        return texel_lit(depth, (int)(u * MAP_WIDTH), (int)(v * MAP_HEIGHT), z);
    }
    if (reads->map.filter == DIP_SHADOW_WIDE) {
        return wide_light(depth, u * MAP_WIDTH, v * MAP_HEIGHT, z);
    }
    const double x = u * MAP_WIDTH - 0.5;
    const double y = v * MAP_HEIGHT - 0.5;
    const int x0 = (int)floor(x);
    const int y0 = (int)floor(y);
    const double fx = x - x0;
    const double fy = y - y0;
    return texel_lit(depth, x0, y0, z) * (1 - fx) * (1 - fy) +
           texel_lit(depth, x0 + 1, y0, z) * fx * (1 - fy) +
           texel_lit(depth, x0, y0 + 1, z) * (1 - fx) * fy +
           texel_lit(depth, x0 + 1, y0 + 1, z) * fx * fy;
}

static void shadow_maps(void **state) {
    (void)state;
    Random random = {21};
    DipDepth *depth = dip_depth_create(MAP_WIDTH, MAP_HEIGHT, 1, NULL);
    for (int y = 0; y < MAP_HEIGHT; y++) {
        for (int x = 0; x < MAP_WIDTH; x++) {
            dip_depth_row(depth, 0, y)[x] = (float)random_int(&random, 0, 8) / 8.0f;
        }
    }
    static ShadowReads reads;
    ShadowReads *pointer = &reads;
    DipMesh *mesh = rectangle(10, 10, 11, 11, 0.5f);
    DipDraw draw = draw_of(mesh, NULL, NULL);
    draw.fragment_shader = read_shadow;
    draw.uniforms = &pointer;
    const DipPass pass = pass_of(&draw, 1, 1);
    for (int round = 0; round < 200; round++) {
        reads.map = (DipShadowMap){depth, (DipShadowFilter)(round % 3)};
        for (int i = 0; i < READS; i++) {
            reads.u[i] = (float)random_real(&random, -0.1, 1.1);
            reads.v[i] = (float)random_real(&random, -0.1, 1.1);
            reads.z[i] = (float)random_int(&random, -4, 16) / 16.0f;
        }
        run(&pass);
        for (int i = 0; i < READS; i++) {
            const double expected = expected_light(&reads, depth, i);
            // Weights are whole 1/256; nearest reads are rounded to 1/256 texel.
            if (fabs((double)reads.lit[i] - expected) > 1.0 / 128.0) {
                const double x = (double)reads.u[i] * MAP_WIDTH;
                const double y = (double)reads.v[i] * MAP_HEIGHT;
                const bool between = reads.map.filter == DIP_SHADOW_NEAREST &&
                                     (fabs(x - rint(x)) < 1e-4 || fabs(y - rint(y)) < 1e-4);
                if (!between) {
                    fail_msg("u %.6f, v %.6f: light %.5f, expected %.5f", (double)reads.u[i],
                             (double)reads.v[i], (double)reads.lit[i], expected);
                }
            }
        }
    }
    dip_mesh_destroy(&mesh);
    dip_depth_destroy(&depth);
}

// --- formats -------------------------------------------------------------------------------------

// A caller's format: characters by brightness.
typedef struct Characters {
    char text[HEIGHT][WIDTH];
} Characters;

static void store_characters(void *context, int x, int y, int count, const float *const colour[4]) {
    Characters *characters = context;
    for (int i = 0; i < count; i++) {
        characters->text[y][x + i] = colour[1][i] > 2.0f ? '#' : colour[1][i] > 0.2f ? 'o' : '.';
    }
}

static void formats(void **state) {
    (void)state;
    static const Colour bright = {{0.25f, 3.5f, -1.0f, 0.5f}};
    static float floats[HEIGHT][WIDTH][4];
    static float single[HEIGHT][WIDTH];
    static Characters characters;
    const DipDrawState ordered = {.ordered = true};
    DipMesh *mesh = rectangle(10, 10, 50, 30, 0.5f);
    const DipDraw draw = draw_of(mesh, &bright, &ordered);
    for (int samples = 1; samples <= 8; samples += 7) {
        DipPass pass = pass_of(&draw, 1, samples);
        pass.clear_lin[1] = 0.5f;
        pass.target.format = DIP_FORMAT_RGBA32F;
        pass.target.floats = &floats[0][0][0];
        pass.target.stride_bytes = sizeof floats[0];
        run(&pass);
        assert_memory_equal(floats[20][20], bright.channel, sizeof bright.channel);
        const float cleared[4] = {0.0f, 0.5f, 0.0f, 1.0f};
        assert_memory_equal(floats[50][70], cleared, sizeof cleared);
        pass.target.format = DIP_FORMAT_R32F;
        pass.target.floats = &single[0][0];
        pass.target.stride_bytes = sizeof single[0];
        run(&pass);
        assert_true(single[20][20] == 0.25f && single[50][70] == 0.0f);
        pass.target = (DipTarget){.width = WIDTH,
                                  .height = HEIGHT,
                                  .format = DIP_FORMAT_CALLER,
                                  .store = store_characters,
                                  .context = &characters};
        run(&pass);
        assert_true(characters.text[20][20] == '#' && characters.text[50][70] == 'o');
    }
    // A plain draw of a format of 8 bits: the shader's values are clamped.
    const DipDraw plain = draw_of(mesh, &bright, NULL);
    DipPass pass = pass_of(&plain, 1, 4);
    pass.target.format = DIP_FORMAT_LINEAR8;
    run(&pass);
    static const uint8_t codes[4] = {64, 255, 0, 255};
    assert_memory_equal(picture[20][20], codes, sizeof codes);
    dip_mesh_destroy(&mesh);
}

// --- viewports and scissors ----------------------------------------------------------------------

static void viewports(void **state) {
    (void)state;
    static const Colour white = {{1, 1, 1, 1}};
    const float c[3][3] = {{-30, -10, 0.5f}, {110, 20, 0.5f}, {40, 90, 0.5f}};
    DipMesh *mesh = triangles(&c[0][0], 3);
    const DipDraw draw = draw_of(mesh, &white, NULL);
    memset(picture, 77, sizeof picture);
    DipPass pass = pass_of(&draw, 1, 1);
    pass.viewport = (DipTargetRegion){11, 7, 11 + WIDTH / 2, 7 + HEIGHT / 2};
    pass.scissor = (DipTargetRegion){13, 5, 50, 37};
    run(&pass);
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            const bool stored = x >= 13 && x < 50 && y >= 7 && y < 37 && x < 11 + WIDTH / 2;
            const double px = (x + 0.5 - 11) * 2.0;
            const double py = (y + 0.5 - 7) * 2.0;
            const int expected = !stored ? 77 : inside(&c[0][0], px, py) ? 255 : 0;
            bool near_edge = false;
            for (int i = 0; i < 3; i++) {
                near_edge |= distance_to_line(c[i], c[(i + 1) % 3], px, py) < 0.02;
            }
            if (!near_edge) {
                assert_int_equal(picture[y][x][0], expected);
            }
        }
    }
    dip_mesh_destroy(&mesh);
}

// --- stencil masks -------------------------------------------------------------------------------

static DipStencil masked(DipCompare function, DipStencilOp passed, int reference, int read,
                         int write) {
    const DipStencilFace face = {.function = function, .passed = passed};
    return (DipStencil){.enabled = true,
                        .reference = (uint8_t)reference,
                        .read_mask = (uint8_t)read,
                        .write_mask = (uint8_t)write,
                        .front = face,
                        .back = face};
}

// A mask of 0 is legal if the other is not: with a read mask of 0 a test compares 0 with 0, and
// with a write mask of 0 the stored values stay. Each row draws over the one before it.
static void masks_of_zero(void **test_state) {
    (void)test_state;
    const struct {
        DipStencil stencil;
        bool is_drawn;
    } rows[] = {
        // The values are 9 at first, and 5 from here on.
        {masked(DIP_COMPARE_EQUAL, DIP_STENCIL_REPLACE, 5, 0, 255), true},
        {masked(DIP_COMPARE_NOT_EQUAL, DIP_STENCIL_ZERO, 5, 0, 255), false},
        {masked(DIP_COMPARE_EQUAL, DIP_STENCIL_ZERO, 9, 255, 0), false},
        {masked(DIP_COMPARE_EQUAL, DIP_STENCIL_ZERO, 5, 255, 0), true},
        {masked(DIP_COMPARE_EQUAL, DIP_STENCIL_ZERO, 5, 255, 0), true},
    };
    enum { ROWS = sizeof rows / sizeof *rows };
    DipMesh *mesh = rectangle(1, 1, 5, 5, 0.5f);
    Colour colours[ROWS];
    DipDrawState states[ROWS];
    DipDraw draws[ROWS];
    int red = 0; // of the last row that is drawn
    for (int i = 0; i < ROWS; i++) {
        colours[i] = (Colour){{(float)(i + 1) / ROWS, 0, 0, 1}};
        states[i] = (DipDrawState){
            .ordered = true, .depth_test = DIP_DEPTH_ALWAYS, .stencil = rows[i].stencil};
        draws[i] = draw_of(mesh, &colours[i], &states[i]);
        DipPass pass = pass_of(draws, i + 1, 1);
        pass.attachments.clear_stencil = 9;
        pass.target.format = DIP_FORMAT_LINEAR8;
        run(&pass);
        red = rows[i].is_drawn ? 255 * (i + 1) / ROWS : red;
        assert_int_equal(picture[3][3][0], red);
    }
    dip_mesh_destroy(&mesh);
}

// --- bad fields ----------------------------------------------------------------------------------

typedef struct BadField {
    const char *field;
    DipErrorCode code;
    void (*spoil)(DipPass *pass, DipDrawState *state);
} BadField;

static void spoil_factor(DipPass *pass, DipDrawState *state) {
    (void)pass;
    state->blend.colour.source = DIP_BLEND_FACTOR_COUNT;
}

static void spoil_op(DipPass *pass, DipDrawState *state) {
    (void)pass;
    state->blend.alpha.op = DIP_BLEND_OP_COUNT;
}

static void spoil_constant(DipPass *pass, DipDrawState *state) {
    (void)pass;
    state->blend.constant[2] = NAN;
}

static void spoil_channels(DipPass *pass, DipDrawState *state) {
    (void)pass;
    state->kept_channels = 16;
}

static void spoil_depth_test(DipPass *pass, DipDrawState *state) {
    (void)pass;
    state->depth_test = DIP_DEPTH_TEST_COUNT;
}

static void spoil_bias(DipPass *pass, DipDrawState *state) {
    (void)pass;
    state->depth_bias.slope = INFINITY;
}

static void spoil_constant_bias(DipPass *pass, DipDrawState *state) {
    (void)pass;
    state->depth_bias.constant = NAN;
}

static void spoil_stencil(DipPass *pass, DipDrawState *state) {
    (void)pass;
    state->stencil.back.passed = DIP_STENCIL_OP_COUNT;
}

static void spoil_fill(DipPass *pass, DipDrawState *state) {
    (void)pass;
    state->fill = DIP_FILL_COUNT;
}

static void spoil_width(DipPass *pass, DipDrawState *state) {
    (void)pass;
    state->line_width = -1.0f;
}

static void spoil_format(DipPass *pass, DipDrawState *state) {
    (void)state;
    pass->target.format = DIP_FORMAT_COUNT;
}

static void spoil_stride(DipPass *pass, DipDrawState *state) {
    (void)state;
    pass->target.format = DIP_FORMAT_RGBA32F; // a row has 16 bytes per pixel
}

static void spoil_store(DipPass *pass, DipDrawState *state) {
    (void)state;
    pass->target.format = DIP_FORMAT_CALLER;
}

static void spoil_load(DipPass *pass, DipDrawState *state) {
    (void)state;
    pass->target.format = DIP_FORMAT_CALLER;
    pass->target.store = store_characters;
    pass->attachments.colour_load = DIP_LOAD_KEEP;
}

static void spoil_clear_depth(DipPass *pass, DipDrawState *state) {
    (void)state;
    pass->attachments.clear_depth = 1.5f;
}

static void spoil_colour_load(DipPass *pass, DipDrawState *state) {
    (void)state;
    pass->attachments.colour_load = (DipLoad)3;
}

static void spoil_viewport(DipPass *pass, DipDrawState *state) {
    (void)state;
    pass->viewport = (DipTargetRegion){0, 0, WIDTH + 1, HEIGHT};
}

static void spoil_scissor(DipPass *pass, DipDrawState *state) {
    (void)state;
    pass->scissor = (DipTargetRegion){5, 5, 5, 9};
}

static void spoil_target(DipPass *pass, DipDrawState *state) {
    (void)state;
    pass->target.rgba8 = NULL;
}

static void spoil_equations(DipPass *pass, DipDrawState *state) {
    (void)pass;
    state->blend.enabled = true;
}

static void spoil_masks(DipPass *pass, DipDrawState *state) {
    (void)pass;
    state->stencil = (DipStencil){.enabled = true, .front = {.function = DIP_COMPARE_EQUAL}};
}

static void spoil_depth_load(DipPass *pass, DipDrawState *state) {
    (void)state;
    pass->attachments.depth_load = DIP_LOAD_KEEP;
}

static void spoil_stencil_load(DipPass *pass, DipDrawState *state) {
    (void)state;
    pass->attachments.stencil_load = DIP_LOAD_KEEP;
}

static void bad_fields(void **test_state) {
    (void)test_state;
    static const BadField bad[] = {
        {"draws[0].state.blend.colour", DIP_ERROR_RANGE, spoil_factor},
        {"draws[0].state.blend.alpha", DIP_ERROR_RANGE, spoil_op},
        {"draws[0].state.blend.constant", DIP_ERROR_RANGE, spoil_constant},
        {"draws[0].state.kept_channels", DIP_ERROR_RANGE, spoil_channels},
        {"draws[0].state.depth_test", DIP_ERROR_RANGE, spoil_depth_test},
        {"draws[0].state.depth_bias.slope", DIP_ERROR_RANGE, spoil_bias},
        {"draws[0].state.depth_bias.constant", DIP_ERROR_RANGE, spoil_constant_bias},
        {"draws[0].state.stencil.back", DIP_ERROR_RANGE, spoil_stencil},
        {"draws[0].state.fill", DIP_ERROR_RANGE, spoil_fill},
        {"draws[0].state.line_width", DIP_ERROR_RANGE, spoil_width},
        {"target.format", DIP_ERROR_RANGE, spoil_format},
        {"target.stride_bytes", DIP_ERROR_RANGE, spoil_stride},
        {"target.store", DIP_ERROR_MISSING, spoil_store},
        {"target.load", DIP_ERROR_MISSING, spoil_load},
        {"attachments.clear_depth", DIP_ERROR_RANGE, spoil_clear_depth},
        {"attachments.colour_load", DIP_ERROR_RANGE, spoil_colour_load},
        {"viewport", DIP_ERROR_RANGE, spoil_viewport},
        {"scissor", DIP_ERROR_RANGE, spoil_scissor},
        {"target.rgba8", DIP_ERROR_MISSING, spoil_target},
        {"draws[0].state.blend.colour", DIP_ERROR_MISSING, spoil_equations},
        {"draws[0].state.stencil.read_mask", DIP_ERROR_MISSING, spoil_masks},
        {"attachments.depth", DIP_ERROR_MISSING, spoil_depth_load},
        {"attachments.depth", DIP_ERROR_MISSING, spoil_stencil_load},
    };
    static const Colour white = {{1, 1, 1, 1}};
    DipMesh *mesh = rectangle(1, 1, 5, 5, 0.5f);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        DipDrawState state = {.ordered = true};
        const DipDraw draw = draw_of(mesh, &white, &state);
        DipPass pass = pass_of(&draw, 1, 1);
        bad[i].spoil(&pass, &state);
        DipPipelineCounters counters = {0};
        DipStageTimes times = {0};
        DipError err = {0};
        assert_false(dip_pipeline_draw(pipeline, &pass, &counters, &times, &err));
        assert_string_equal(err.key, bad[i].field);
        assert_int_equal(err.code, bad[i].code);
    }
    // Depths of another size or another number of samples.
    for (int i = 0; i < 2; i++) {
        DipDepth *depth = dip_depth_create(WIDTH - i, HEIGHT, i ? 1 : 4, NULL);
        const DipDraw draw = draw_of(mesh, &white, NULL);
        DipPass pass = pass_of(&draw, 1, 1);
        pass.attachments.depth = depth;
        DipPipelineCounters counters = {0};
        DipStageTimes times = {0};
        DipError err = {0};
        assert_false(dip_pipeline_draw(pipeline, &pass, &counters, &times, &err));
        assert_string_equal(err.key, "attachments.depth");
        dip_depth_destroy(&depth);
    }
    dip_mesh_destroy(&mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(published_modes),    cmocka_unit_test(premultiplied_layers),
        cmocka_unit_test(depths_are_copied),  cmocka_unit_test(kept_codes),
        cmocka_unit_test(ordered_like_plain), cmocka_unit_test(wireframes),
        cmocka_unit_test(depth_bias),         cmocka_unit_test(depth_only),
        cmocka_unit_test(shadow_maps),        cmocka_unit_test(formats),
        cmocka_unit_test(viewports),          cmocka_unit_test(masks_of_zero),
        cmocka_unit_test(bad_fields),
    };
    return cmocka_run_group_tests(tests, open_pipeline, close_pipeline);
}
