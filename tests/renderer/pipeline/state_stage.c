// What the tests of draw states share.
#include "state_stage.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static DipPool *pool;
DipPipeline *pipeline;

int open_pipeline(void **state) {
    (void)state;
    pool = dip_pool_create(2, NULL);
    pipeline = dip_pipeline_create(pool, dip_isa_best(), WIDTH, HEIGHT, NULL);
    return pipeline ? 0 : 1;
}

int close_pipeline(void **state) {
    (void)state;
    dip_pipeline_destroy(&pipeline);
    dip_pool_destroy(&pool);
    return 0;
}

// Positions are pixels and a depth. Varying 0 is the depth.
void in_pixels(const DipVertexBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        batch->clip[0][i] = batch->in[0][i] * (2.0f / WIDTH) - 1.0f;
        batch->clip[1][i] = 1.0f - batch->in[1][i] * (2.0f / HEIGHT);
        batch->clip[2][i] = batch->in[2][i];
        batch->clip[3][i] = 1.0f;
        batch->varying[0][i] = batch->in[2][i];
    }
}

void one_colour(DipFragmentBatch *batch) {
    const Colour *colour = batch->uniforms;
    for (int i = 0; i < batch->count; i++) {
        for (int c = 0; c < 3; c++) {
            batch->colour[c][i] = colour->channel[c];
        }
        batch->alpha[i] = colour->channel[3];
    }
}

DipMesh *triangles(const float *corners, uint32_t count) {
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
DipMesh *rectangle(float x0, float y0, float x1, float y1, float depth) {
    const float corners[6][3] = {{x0, y0, depth}, {x0, y1, depth}, {x1, y1, depth},
                                 {x0, y0, depth}, {x1, y1, depth}, {x1, y0, depth}};
    return triangles(&corners[0][0], 6);
}

DipDraw draw_of(const DipMesh *mesh, const Colour *colour, const DipDrawState *state) {
    return (DipDraw){.mesh = mesh,
                     .vertex_shader = in_pixels,
                     .fragment_shader = one_colour,
                     .varying_count = 1,
                     .uniforms = colour,
                     .state = state};
}

uint8_t picture[HEIGHT][WIDTH][4];

DipPass pass_of(const DipDraw *draws, int count, int sample_count) {
    return (DipPass){.draws = draws,
                     .draw_count = count,
                     .sample_count = sample_count,
                     .target = {.rgba8 = &picture[0][0][0],
                                .stride_bytes = sizeof picture[0],
                                .width = WIDTH,
                                .height = HEIGHT}};
}

void run(const DipPass *pass) {
    DipPipelineCounters counters = {0};
    DipStageTimes times = {0};
    DipError err = {0};
    if (!dip_pipeline_draw(pipeline, pass, &counters, &times, &err)) {
        fail_msg("%s: %s", err.key, err.message);
    }
}
