// Draws a textured cube that is sunk into a textured floor. The example shows how a caller makes
// its own projection with a near and a far plane. It also shows how near surfaces hide far ones,
// and how to use mip chains and anisotropic filtering.
//
// Usage: textured FILE.ppm
#include "renderer/pipeline/pipeline.h"

#include <stdio.h>

enum { WIDTH = 320, HEIGHT = 240, TEXELS = 128, CUBE_FACES = 6 };

// The camera stands above the floor and looks along -z, a little down. Distances are in metres.
static const float eye_height = 1.7f;
static const float near_m = 0.1f;
static const float far_m = 60.0f;
static const float focal = 1.6f; // 1 / tan(half the vertical field of view)
static const float down_sin = 0.2f;
static const float down_cos = 0.9797959f;

// Takes positions (attributes 0..2) to clip space. Depth falls from 1 at the near plane to 0 at the
// far plane. Attributes 3 and 4, the texture coordinates, become varyings 0 and 1.
static void vertex_shader(const DipVertexBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        const float y = batch->in[1][i] - eye_height;
        const float up = y * down_cos - batch->in[2][i] * down_sin;
        const float ahead = -(batch->in[2][i] * down_cos + y * down_sin);
        batch->clip[0][i] = batch->in[0][i] * focal * ((float)HEIGHT / WIDTH);
        batch->clip[1][i] = up * focal;
        batch->clip[2][i] = (far_m - ahead) * (near_m / (far_m - near_m));
        batch->clip[3][i] = ahead;
        batch->varying[0][i] = batch->in[3][i];
        batch->varying[1][i] = batch->in[4][i];
    }
}

// Multiplies the texture's colour by the colour in the draw's uniforms.
static void fragment_shader(DipFragmentBatch *batch) {
    const float *tint = batch->uniforms;
    batch->sample_colour(batch, &batch->samplers[0], 0, batch->colour);
    for (int c = 0; c < 3; c++) {
        for (int i = 0; i < batch->count; i++) {
            batch->colour[c][i] *= tint[c];
        }
    }
}

// Makes a chequered texture with a dark line around each field.
static DipTexture *make_texture(DipError *err) {
    static uint8_t rgba8[TEXELS][TEXELS][4];
    for (int y = 0; y < TEXELS; y++) {
        for (int x = 0; x < TEXELS; x++) {
            const int line = x % 32 < 2 || y % 32 < 2;
            const uint8_t light = line ? 40 : (x / 32 + y / 32) % 2 ? 235 : 150;
            rgba8[y][x][0] = rgba8[y][x][1] = rgba8[y][x][2] = light;
            rgba8[y][x][3] = 255;
        }
    }
    const DipTextureDef def = {
        .name = "chequers", .width = TEXELS, .height = TEXELS, .rgba8 = &rgba8[0][0][0]};
    return dip_texture_create(&def, err);
}

static DipMesh *make_floor(DipError *err) {
    static const float vertices[4][5] = {{-30.0f, 0.0f, 5.0f, 0.0f, 0.0f},
                                         {30.0f, 0.0f, 5.0f, 30.0f, 0.0f},
                                         {30.0f, 0.0f, -50.0f, 30.0f, 27.5f},
                                         {-30.0f, 0.0f, -50.0f, 0.0f, 27.5f}};
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    const DipMeshData data = {"floor", &vertices[0][0], 5, 4, indices, 6};
    return dip_mesh_create(&data, err);
}

// Makes a cube with sides of 1.6 m, turned about the vertical axis. The floor hides its lower part.
static DipMesh *make_cube(DipError *err) {
    static const float corners[8][3] = {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1},
                                        {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    static const int faces[CUBE_FACES][4] = {{0, 1, 2, 3}, {1, 5, 6, 2}, {5, 4, 7, 6},
                                             {4, 0, 3, 7}, {3, 2, 6, 7}, {4, 5, 1, 0}};
    float vertices[CUBE_FACES * 4][5];
    uint32_t indices[CUBE_FACES * 6];
    for (int f = 0; f < CUBE_FACES; f++) {
        for (int k = 0; k < 4; k++) {
            const float *corner = corners[faces[f][k]];
            const float x = 1.6f * (corner[0] - 0.5f);
            const float z = 1.6f * (corner[2] - 0.5f);
            float *vertex = vertices[4 * f + k];
            vertex[0] = 0.8f * x + 0.6f * z;
            vertex[1] = 1.6f * corner[1] - 0.4f;
            vertex[2] = 0.8f * z - 0.6f * x - 5.0f;
            vertex[3] = k == 1 || k == 2 ? 1.0f : 0.0f;
            vertex[4] = k < 2 ? 1.0f : 0.0f;
        }
        for (int k = 0; k < 6; k++) {
            static const uint32_t order[6] = {0, 1, 2, 0, 2, 3};
            indices[6 * f + k] = (uint32_t)(4 * f) + order[k];
        }
    }
    const DipMeshData data = {"cube", &vertices[0][0], 5, CUBE_FACES * 4, indices, CUBE_FACES * 6};
    return dip_mesh_create(&data, err);
}

static bool write_ppm(const char *file, const uint8_t *rgba8) {
    FILE *out = fopen(file, "wb");
    if (!out) {
        return false;
    }
    fprintf(out, "P6\n%d %d\n255\n", WIDTH, HEIGHT);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        fwrite(rgba8 + 4 * i, 1, 3, out);
    }
    return fclose(out) == 0;
}

static bool draw(DipPipeline *pipeline, const DipMesh *floor, const DipMesh *cube,
                 const DipTexture *texture, uint8_t *rgba8, DipError *err) {
    static const float stone[3] = {0.55f, 0.6f, 0.65f};
    static const float red[3] = {0.9f, 0.25f, 0.15f};
    const DipSampler sampler = {.texture = texture, .max_anisotropy = 16, .exact_footprint = true};
    const DipDraw draws[2] = {
        {.mesh = cube,
         .vertex_shader = vertex_shader,
         .fragment_shader = fragment_shader,
         .varying_count = 2,
         .uniforms = red,
         .samplers = &sampler,
         .cull = DIP_CULL_BACK},
        {.mesh = floor,
         .vertex_shader = vertex_shader,
         .fragment_shader = fragment_shader,
         .varying_count = 2,
         .uniforms = stone,
         .samplers = &sampler,
         .cull = DIP_CULL_BACK},
    };
    const DipPass pass = {
        .draws = draws,
        .draw_count = 2,
        .sample_count = 4,
        .clear_lin = {0.35f, 0.5f, 0.75f},
        .target = {.rgba8 = rgba8,
                   .stride_bytes = (size_t)WIDTH * 4,
                   .width = WIDTH,
                   .height = HEIGHT},
    };
    DipPipelineCounters counters = {0};
    DipStageTimes times = {0};
    const bool drawn = dip_pipeline_draw(pipeline, &pass, &counters, &times, err);
    printf("%llu fragments shaded\n", (unsigned long long)counters.fragments_shaded);
    return drawn;
}

int main(int argc, char **argv) {
    static uint8_t rgba8[WIDTH * HEIGHT * 4];
    if (argc != 2) {
        fprintf(stderr, "usage: textured FILE.ppm\n");
        return 2;
    }
    DipError err = {0};
    DipMesh *floor = make_floor(&err);
    DipMesh *cube = make_cube(&err);
    DipTexture *texture = make_texture(&err);
    DipPool *pool = dip_pool_create(0, &err);
    DipPipeline *pipeline =
        pool ? dip_pipeline_create(pool, dip_isa_best(), WIDTH, HEIGHT, &err) : NULL;
    bool done =
        floor && cube && texture && pipeline && draw(pipeline, floor, cube, texture, rgba8, &err);
    if (!done) {
        char text[512];
        dip_error_format(&err, text, sizeof text);
        fprintf(stderr, "textured: %s\n", text);
    } else if (!write_ppm(argv[1], rgba8)) {
        fprintf(stderr, "textured: %s: cannot be written\n", argv[1]);
        done = false;
    }
    dip_pipeline_destroy(&pipeline);
    dip_pool_destroy(&pool);
    dip_texture_destroy(&texture);
    dip_mesh_destroy(&cube);
    dip_mesh_destroy(&floor);
    return done ? 0 : 1;
}
