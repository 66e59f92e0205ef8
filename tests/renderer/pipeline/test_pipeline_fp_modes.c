// Tests that the caller's floating-point mode changes nothing: the functions of renderer/pipeline/
// give the same bits in every mode and leave the mode as it was. Shaders run in Diptych's mode.
#include "renderer/pipeline/batch.h"
#include "renderer/pipeline/bc1.h"
#include "renderer/pipeline/cull.h"
#include "renderer/pipeline/patch.h"
#include "renderer/pipeline/pipeline.h"
#include "tests/support/fp_walk.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

enum {
    TEXTURE_WIDTH = 37,
    TEXTURE_HEIGHT = 21,
    TEXELS = TEXTURE_WIDTH * TEXTURE_HEIGHT,
    STEPS = 13, // of the grid, along each side
    ATTRIBUTES = 8,
    VERTICES = (STEPS + 1) * (STEPS + 1),
    INDICES = 6 * STEPS * STEPS,
    WIDTH = 70,
    HEIGHT = 45,
    SAMPLES = 4,
    HALVES = 1000
};

static uint8_t texels[TEXELS * 4];
static float grid[VERTICES][ATTRIBUTES];
static uint32_t indices[INDICES];
static double half_codes[HALVES]; // Light in the middle between two codes of a texel.
static const DipMeshData mesh_data = {"grid", &grid[0][0], ATTRIBUTES, VERTICES, indices, INDICES};

// Made in the usual mode.
static DipMesh *usual_mesh;
static DipTexture *usual_texture;

static DipTextureDef texture_def(DipEncoding encoding) {
    return (DipTextureDef){.name = "noise",
                           .width = TEXTURE_WIDTH,
                           .height = TEXTURE_HEIGHT,
                           .rgba8 = texels,
                           .encoding = encoding,
                           .wrap_u = DIP_WRAP_MIRROR,
                           .wrap_v = DIP_WRAP_BORDER,
                           .border_rgba8 = {20, 30, 40, 250}};
}

static int make_inputs(void **state) {
    (void)state;
    uint32_t random = 1;
    for (int i = 0; i < TEXELS * 4; i++) {
        random = random * 1664525u + 1013904223u;
        texels[i] = (uint8_t)(random >> 24);
    }
    for (int i = 0; i < VERTICES; i++) {
        random = random * 1664525u + 1013904223u;
        const float x = (float)(i % (STEPS + 1)) / STEPS, z = (float)(i / (STEPS + 1)) / STEPS;
        const float y = (float)(random >> 16) / 400000.0f - 0.7f;
        const float row[ATTRIBUTES] = {
            3.1f * x - 1.7f, i % 5 ? y : 1e-39f, -4.3f * z - 0.3f, 0.3f, 0.9f, 0.1f, 1.7f * x,
            2.3f * z};
        memcpy(grid[i], row, sizeof row);
    }
    for (int i = 0; i < STEPS * STEPS; i++) {
        const uint32_t first = (uint32_t)(i / STEPS * (STEPS + 1) + i % STEPS);
        const uint32_t square[6] = {first,     first + 1,         first + STEPS + 1,
                                    first + 1, first + STEPS + 2, first + STEPS + 1};
        memcpy(indices + 6 * i, square, sizeof square);
    }
    for (int i = 0; i < HALVES; i++) {
        half_codes[i] = ((i + 0.5) / 65535.0) * ((i + 0.5) / 65535.0);
    }
    const DipTextureDef def = texture_def(DIP_ENCODING_SRGB);
    usual_mesh = dip_mesh_create(&mesh_data, NULL);
    usual_texture = dip_texture_create(&def, NULL);
    return usual_mesh && usual_texture ? 0 : -1;
}

static int free_inputs(void **state) {
    (void)state;
    dip_mesh_destroy(&usual_mesh);
    dip_texture_destroy(&usual_texture);
    return 0;
}

// --- blocks and textures -------------------------------------------------------------------------

static void call_bc1(DipHash *hash) {
    static DipBc1Light light;
    dip_bc1_light_fill(&light);
    dip_hash_bytes(hash, &light, sizeof light);
    for (int i = 0; i + 64 <= TEXELS * 4; i += 4) {
        uint8_t block[DIP_BC1_BYTES];
        uint32_t palette[4];
        dip_bc1_encode(texels + i, block);
        dip_bc1_palette(&light, block, palette);
        dip_hash_bytes(hash, block, sizeof block);
        dip_hash_bytes(hash, palette, sizeof palette);
    }
}

static void call_codes(DipHash *hash) {
    static DipRootCodes codes;
    dip_root_codes_fill(&codes);
    dip_hash_bytes(hash, &codes, sizeof codes);
    for (int i = 0; i < HALVES; i++) {
        const double rgb_lin[3] = {half_codes[i], half_codes[i], 0.7};
        dip_hash_integer(hash, dip_texel_pack(rgb_lin));
    }
}

static void hash_texture(DipHash *hash, const DipTexture *texture) {
    uint8_t read[TEXELS * 4];
    assert_non_null(texture);
    for (int level = 0; level < dip_texture_level_count(texture); level++) {
        int width, height;
        dip_texture_level_size(texture, level, &width, &height);
        for (int encoding = 0; encoding < 2; encoding++) {
            assert_true(dip_texture_read(texture, level, (DipEncoding)encoding, read, NULL));
            dip_hash_bytes(hash, read, 4 * (size_t)width * (size_t)height);
        }
    }
}

static void call_textures(DipHash *hash) {
    for (int encoding = 0; encoding < 2; encoding++) {
        const DipTextureDef def = texture_def((DipEncoding)encoding);
        DipTexture *texture = dip_texture_create(&def, NULL), *compressed = NULL;
        hash_texture(hash, texture);
        assert_true(dip_textures_compress(&texture, &(bool){true}, 1, NULL, &compressed, NULL));
        hash_texture(hash, compressed);
        dip_texture_destroy(&compressed);
        const DipTextureUpdate update = {3, 2, 20, 11, texels + 44, 4 * TEXTURE_WIDTH};
        assert_true(dip_texture_update(texture, &update, NULL, NULL));
        hash_texture(hash, texture);
        dip_texture_destroy(&texture);
    }
}

static void call_texture_lists(DipHash *hash) {
    const DipTextureDef defs[2] = {texture_def(DIP_ENCODING_SRGB),
                                   texture_def(DIP_ENCODING_LINEAR)};
    DipPool *pool = dip_pool_create(2, NULL);
    DipTexture *textures[2];
    assert_true(dip_textures_create(defs, NULL, NULL, 2, pool, textures, NULL));
    for (int i = 0; i < 2; i++) {
        hash_texture(hash, textures[i]);
        dip_texture_destroy(&textures[i]);
    }
    DipTexture *levels = dip_texture_create_from_levels(defs, 2, NULL);
    hash_texture(hash, levels);
    dip_texture_destroy(&levels);
    dip_pool_destroy(&pool);
}

// Levels of a texture that was made in the usual mode.
static void call_texture_read(DipHash *hash) {
    hash_texture(hash, usual_texture);
}

// --- meshes --------------------------------------------------------------------------------------

static void hash_mesh(DipHash *hash, const DipMesh *mesh) {
    float bounds[2][3];
    assert_non_null(mesh);
    dip_mesh_bounds(mesh, bounds[0], bounds[1]);
    const DipBox box = dip_mesh_box(mesh);
    dip_hash_bytes(hash, bounds, sizeof bounds);
    dip_hash_bytes(hash, &box, sizeof box);
    for (uint32_t c = 0; c < dip_mesh_chunk_count(mesh); c++) {
        const DipBox part = dip_mesh_chunk_box(mesh, c);
        dip_hash_bytes(hash, &part, sizeof part);
        for (uint32_t t = 0; t < dip_mesh_chunk_triangle_count(mesh, c); t++) {
            float corners[3][3];
            dip_mesh_chunk_triangle(mesh, c, t, corners);
            dip_hash_bytes(hash, corners, sizeof corners);
        }
    }
}

static void call_meshes(DipHash *hash) {
    DipMesh *mesh = dip_mesh_create(&mesh_data, NULL);
    hash_mesh(hash, mesh);
    DipMesh *copy = dip_mesh_copy(mesh);
    hash_mesh(hash, copy);
    dip_mesh_destroy(&copy);
    dip_mesh_destroy(&mesh);
}

static void call_updated_mesh(DipHash *hash) {
    DipMesh *mesh = dip_mesh_create_updatable(&mesh_data, NULL);
    hash_mesh(hash, mesh);
    static float moved[VERTICES][ATTRIBUTES];
    for (int i = 0; i < VERTICES; i++) {
        memcpy(moved[i], grid[VERTICES - 1 - i], sizeof moved[i]);
    }
    assert_true(dip_mesh_update(mesh, &moved[0][0], NULL));
    hash_mesh(hash, mesh);
    dip_mesh_destroy(&mesh);
}

static void call_patches(DipHash *hash) {
    uint32_t patches[INDICES / 3], count = 0;
    assert_true(
        dip_patches_find(&grid[0][0], ATTRIBUTES, VERTICES, indices, INDICES, patches, &count));
    dip_hash_integer(hash, count);
    dip_hash_bytes(hash, patches, sizeof patches);
}

// --- culling -------------------------------------------------------------------------------------

static const double world_to_clip[16] = {1.1, 0.2,  0.3,  0.4,    -0.2, 1.3, 0.1, 0.7,
                                         0.0, 0.03, 0.01, 0.0103, 0.1,  0.2, 1.0, 5.3};

static DipPass pass_of(const DipDraw *draw, void *pixels) {
    return (DipPass){.draws = draw,
                     .draw_count = 1,
                     .sample_count = SAMPLES,
                     .clear_lin = {0.1f, 0.7f, 0.3f},
                     .clip_planes = {{0.3f, 0.7f, 0.1f, 1.9f}},
                     .clip_plane_count = 1,
                     .target = {.floats = pixels,
                                .stride_bytes = 16 * WIDTH,
                                .width = WIDTH,
                                .height = HEIGHT,
                                .format = DIP_FORMAT_RGBA32F}};
}

static void call_planes(DipHash *hash) {
    DipPass pass = pass_of(NULL, NULL);
    pass.region = (DipTargetRegion){8, 0, 48, 40};
    const DipCullPlanes planes[2] = {dip_cull_view_planes(world_to_clip),
                                     dip_cull_pass_planes(&pass, world_to_clip)};
    for (int i = 0; i < 2; i++) {
        dip_hash_bytes(hash, planes[i].normal, sizeof planes[i].normal);
    }
}

static void call_boxes(DipHash *hash) {
    static const float transform[12] = {0.7f, 0.1f, 0.2f, 3.3f, 0.3f, 1.7f,
                                        0.1f, 0.9f, 0.2f, 0.3f, 1.1f, 7.7f};
    const DipBox box = {{-1.1f, -0.3f, 1e-39f}, {1.3f, 0.9f, 0.1f}};
    const DipBox moved = dip_cull_transform_box(transform, &box);
    dip_hash_bytes(hash, &moved, sizeof moved);
    // A plane that the box's corner touches, apart from the margin that rounding decides.
    for (int i = 0; i < 4096; i++) {
        DipCullPlanes planes = {.count = 1};
        const float distance = (float)(-4194304 - i) / 4194304.0f;
        planes.normal[0][0] = 1.0f;
        planes.normal[3][0] = distance;
        const DipBox near = {{0.3f, 0.0f, 0.0f}, {0.7f, 0.1f, 0.1f}};
        dip_hash_integer(hash, dip_cull_outside(&planes, &near));
    }
}

// --- drawing -------------------------------------------------------------------------------------

static const float matrix[16] = {1.3f, 0.1f, 0.0f, 0.1f, 0.0f, 1.3f, -0.9f, -1.5f,
                                 0.0f, 0.0f, 0.0f, 0.1f, 0.0f, 0.1f, -1.0f, 0.3f};

static void vertex_shader(const DipVertexBatch *batch) {
    dip_vertices_transform(batch, matrix, 4, batch->clip);
    dip_vertices_copy(batch, 0, 0, 3);
    dip_vertices_copy(batch, 6, 3, 2);
    dip_vertices_turn(batch, 3, matrix, batch->varying + 5);
}

static void clip_shader(DipFragmentBatch *batch) {
    float alpha[DIP_FRAGMENT_BATCH], slope[DIP_FRAGMENT_BATCH];
    batch->sample_alpha_slope(batch, &batch->samplers[0], 3, alpha, slope);
    for (int i = 0; i < batch->count; i++) {
        batch->keep[i] = (uint8_t)dip_alpha_to_coverage(alpha[i], slope[i], 0.3f, SAMPLES);
    }
}

static void fragment_shader(DipFragmentBatch *batch) {
    float colour[3][DIP_FRAGMENT_BATCH];
    dip_fragments_project(batch, matrix, 0, 10);
    batch->sample_colour(batch, &batch->samplers[0], 3, colour);
    batch->sample_colour(batch, &batch->samplers[0], 10, batch->colour);
    for (int c = 0; c < 3; c++) {
        for (int i = 0; i < batch->count; i++) {
            batch->colour[c][i] += colour[c][i] * batch->varying[5 + c][i] / 3.7f;
        }
    }
}

typedef struct Drawing {
    DipPipeline *pipeline;
    DipSampler sampler;
    DipDrawState state;
    DipDraw draw;
    DipDepth *depth;
    DipSamples *samples;
    float pixels[WIDTH * HEIGHT * 4];
} Drawing;

static Drawing drawing;

// Makes what a pass needs beside the mesh and the texture.
static void open_drawing(DipPool *pool) {
    Drawing *d = &drawing;
    d->pipeline = dip_pipeline_create(pool, dip_isa_best(), WIDTH, HEIGHT, NULL);
    d->depth = dip_depth_create(WIDTH, HEIGHT, SAMPLES, NULL);
    d->samples = dip_samples_create(WIDTH, HEIGHT, SAMPLES, DIP_FORMAT_RGBA32F, NULL);
    assert_true(d->pipeline && d->depth && d->samples);
    d->sampler =
        (DipSampler){.texture = usual_texture, .max_anisotropy = 8, .exact_footprint = true};
    d->state = (DipDrawState){.ordered = true, .depth_bias = {.slope = 0.7f}};
    d->draw = (DipDraw){.mesh = usual_mesh,
                        .vertex_shader = vertex_shader,
                        .fragment_shader = fragment_shader,
                        .clip_shader = clip_shader,
                        .varying_count = 8,
                        .clip_varying_count = 5,
                        .computed_varying_count = 2,
                        .samplers = &d->sampler,
                        .bounds_to_clip = matrix,
                        .state = &d->state};
}

static void close_drawing(void) {
    dip_pipeline_destroy(&drawing.pipeline);
    dip_depth_destroy(&drawing.depth);
    dip_samples_destroy(&drawing.samples);
}

static void hash_drawing(DipHash *hash) {
    static float colour[4][WIDTH];
    float *const rows[4] = {colour[0], colour[1], colour[2], colour[3]};
    dip_hash_bytes(hash, drawing.pixels, sizeof drawing.pixels);
    for (int y = 0; y < HEIGHT; y++) {
        for (int s = 0; s < SAMPLES; s++) {
            dip_hash_bytes(hash, dip_depth_row(drawing.depth, s, y), WIDTH * sizeof(float));
            dip_samples_read_row(drawing.samples, s, y, rows);
            dip_hash_bytes(hash, colour, sizeof colour);
        }
    }
}

static DipPass pass_of_drawing(void) {
    DipPass pass = pass_of(&drawing.draw, drawing.pixels);
    pass.alpha_to_coverage = true;
    pass.attachments.depth = drawing.depth;
    pass.attachments.samples = drawing.samples;
    return pass;
}

// Depth biases that only the usual mode tells from 0.
static void call_states(DipHash *hash) {
    const DipDrawState states[2] = {{.depth_bias = {.slope = 1e-39f}}, {.kept_channels = 0}};
    for (int i = 0; i < 2; i++) {
        dip_hash_integer(hash, dip_state_is_ordered(&states[i]));
    }
}

static void call_draw(DipHash *hash) {
    DipError err = {0};
    DipPool *pool = dip_pool_create(2, NULL);
    for (int threads = 0; threads < 2; threads++) {
        open_drawing(threads ? pool : NULL);
        const DipPass pass = pass_of_drawing();
        DipPipelineCounters counters = {0};
        if (!dip_pipeline_reserve(drawing.pipeline, &pass, &err) ||
            !dip_pipeline_draw(drawing.pipeline, &pass, &counters, NULL, &err)) {
            fail_msg("%s: %s", err.key, err.message);
        }
        assert_true(counters.fragments_ordered > 1000);
        hash_drawing(hash);
        close_drawing();
    }
    dip_pool_destroy(&pool);
}

static void call_draw_passes(DipHash *hash) {
    DipError err = {0};
    open_drawing(NULL);
    const DipPass pass = pass_of_drawing();
    const DipPassWork work = {.pipeline = drawing.pipeline, .pass = &pass};
    if (!dip_pipeline_draw_passes(&work, 1, false, &err)) {
        fail_msg("%s: %s", err.key, err.message);
    }
    hash_drawing(hash);
    close_drawing();
}

// --- the test ------------------------------------------------------------------------------------

static const FpWalkEntry entries[] = {
    {"blocks of BC1", call_bc1},
    {"codes of texels", call_codes},
    {"textures", call_textures},
    {"lists of textures", call_texture_lists},
    {"reading a texture", call_texture_read},
    {"meshes", call_meshes},
    {"updated mesh", call_updated_mesh},
    {"patches", call_patches},
    {"planes", call_planes},
    {"boxes", call_boxes},
    {"states", call_states},
    {"drawing", call_draw},
    {"drawing several passes", call_draw_passes},
};

int main(void) {
    return fp_walk_main(entries, sizeof entries / sizeof *entries, make_inputs, free_inputs);
}
