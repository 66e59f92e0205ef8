// Draws a triangle with the program's own shaders. This is the smallest program that uses the
// pipeline library, without a scene.
//
// Usage: triangle FILE.ppm
#include "renderer/pipeline/pipeline.h"

#include <stdio.h>
#include <string.h>

enum { WIDTH = 320, HEIGHT = 240 };

// Each vertex has a position x, y, z and two numbers u, v, from which the fragment shader computes
// the colour.
static const float vertices[3][5] = {
    {-0.8f, -0.7f, 0.5f, 0.0f, 0.0f},
    {0.8f, -0.7f, 0.5f, 1.0f, 0.0f},
    {0.0f, 0.8f, 0.5f, 0.5f, 1.0f},
};
static const uint32_t indices[3] = {0, 1, 2};

// The positions are already in clip space; w is 1. Attributes 3 and 4 become varyings 0 and 1.
static void vertex_shader(const DipVertexBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        for (int c = 0; c < 3; c++) {
            batch->clip[c][i] = batch->in[c][i];
        }
        batch->clip[3][i] = 1.0f;
        batch->varying[0][i] = batch->in[3][i];
        batch->varying[1][i] = batch->in[4][i];
    }
}

// Draws rings around the point u = 0.5, v = 0.4. The uniform is the number of rings per unit of
// squared distance from this point. The colour also depends on u and v.
static void fragment_shader(DipFragmentBatch *batch) {
    const float rings = *(const float *)batch->uniforms;
    for (int i = 0; i < batch->count; i++) {
        const float u = batch->varying[0][i];
        const float v = batch->varying[1][i];
        const float x = u - 0.5f;
        const float y = v - 0.4f;
        const float phase = (x * x + y * y) * rings;
        const float wave = phase - (float)(int)phase;
        const float light = wave < 0.5f ? 1.0f : 0.25f;
        batch->colour[0][i] = u * light;
        batch->colour[1][i] = v * light;
        batch->colour[2][i] = (1.0f - u) * light;
    }
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

static bool draw(DipPipeline *pipeline, const DipMesh *mesh, uint8_t *rgba8, DipError *err) {
    const float rings = 24.0f;
    const DipDraw triangle = {
        .mesh = mesh,
        .vertex_shader = vertex_shader,
        .fragment_shader = fragment_shader,
        .varying_count = 2,
        .uniforms = &rings,
        .cull = DIP_CULL_BACK,
    };
    const DipPass pass = {
        .draws = &triangle,
        .draw_count = 1,
        .sample_count = 8,
        .clear_lin = {0.02f, 0.02f, 0.03f},
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
        fprintf(stderr, "usage: triangle FILE.ppm\n");
        return 2;
    }
    DipError err = {0};
    const DipMeshData data = {"triangle", &vertices[0][0], 5, 3, indices, 3};
    DipMesh *mesh = dip_mesh_create(&data, &err);
    DipPool *pool = dip_pool_create(0, &err);
    DipPipeline *pipeline =
        pool ? dip_pipeline_create(pool, dip_isa_best(), WIDTH, HEIGHT, &err) : NULL;
    bool done = mesh && pipeline && draw(pipeline, mesh, rgba8, &err);
    if (!done) {
        char text[512];
        dip_error_format(&err, text, sizeof text);
        fprintf(stderr, "triangle: %s\n", text);
    } else if (!write_ppm(argv[1], rgba8)) {
        fprintf(stderr, "triangle: %s: cannot be written\n", argv[1]);
        done = false;
    }
    dip_pipeline_destroy(&pipeline);
    dip_pool_destroy(&pool);
    dip_mesh_destroy(&mesh);
    return done ? 0 : 1;
}
