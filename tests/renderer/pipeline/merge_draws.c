// Draws the draws of the plain model by the pipeline, and compares colours with the model's.
#include "tests/renderer/pipeline/merge_draws.h"
#include "tests/support/srgb.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

enum { VERTICES = 3 * MODEL_TRIANGLES };

// Positions are pixels of the whole target, exact in floats.
static void vertex_shader(const DipVertexBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        batch->clip[0][i] = batch->in[0][i] * (2.0f / MODEL_WIDTH) - 1.0f;
        batch->clip[1][i] = 1.0f - batch->in[1][i] * (2.0f / MODEL_HEIGHT);
        batch->clip[2][i] = batch->in[2][i];
        batch->clip[3][i] = 1.0f;
    }
}

static void fragment_shader(DipFragmentBatch *batch) {
    const ModelDraw *draw = batch->uniforms;
    for (int i = 0; i < batch->count; i++) {
        const int x = (int)batch->x[i];
        const int y = (int)batch->y[i];
        for (int c = 0; c < 3; c++) {
            batch->colour[c][i] = (float)model_shade(draw, batch->front[i], x, y, c);
        }
        batch->alpha[i] = (float)model_shade(draw, batch->front[i], x, y, 3);
    }
}

static void clip_shader(DipFragmentBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        batch->keep[i] = model_keeps(batch->front[i], (int)batch->x[i], (int)batch->y[i]);
    }
}

static DipMesh *make_mesh(const ModelDraw *draw) {
    float vertices[VERTICES][3];
    uint32_t indices[VERTICES];
    for (uint32_t i = 0; i < VERTICES; i++) {
        vertices[i][0] = (float)draw->triangle[i / 3].x[i % 3] / 256.0f;
        vertices[i][1] = (float)draw->triangle[i / 3].y[i % 3] / 256.0f;
        vertices[i][2] = draw->depth[i / 3];
        indices[i] = i;
    }
    const DipMeshData data = {"draw", &vertices[0][0], 3, VERTICES, indices, VERTICES};
    return dip_mesh_create(&data, NULL);
}

void model_make_draws(const ModelDraw *models, int count, DipDraw *draws, DipMesh **meshes) {
    for (int d = 0; d < count; d++) {
        const ModelDraw *model = &models[d];
        meshes[d] = make_mesh(model);
        assert_non_null(meshes[d]);
        draws[d] = (DipDraw){.mesh = meshes[d],
                             .vertex_shader = vertex_shader,
                             .fragment_shader = fragment_shader,
                             .clip_shader = model->clips ? clip_shader : NULL,
                             .uniforms = model,
                             .cull = model->cull,
                             .state = &model->state};
    }
}

void model_free_meshes(DipMesh **meshes, int count) {
    for (int d = 0; d < count; d++) {
        dip_mesh_destroy(&meshes[d]);
    }
}

void model_assert_float(double found, ModelValue expected, int x, int y, int channel) {
    // Where nothing clamps, colours may grow beyond the range of floats.
    const bool known = expected.error < 1e30;
    if (known && !(fabs(found - expected.value) <= 1.01 * expected.error)) {
        fail_msg("pixel %d, %d, channel %d: %.9g, expected %.9g within %g", x, y, channel, found,
                 expected.value, expected.error);
    }
}

static double encoded(double light) {
    return 255.0 * srgb_encode(light > 0.0 ? fmin(light, 1.0) : 0.0);
}

void model_assert_code(int found, ModelValue expected, int x, int y, int channel) {
    const double code = channel < 3 ? encoded(expected.value) : 255.0 * expected.value;
    // Near black, a step of 16-bit linear light is a twentieth of a code.
    if (fabs(found - code) > 0.56) {
        fail_msg("pixel %d, %d, channel %d: code %d, expected %.3f", x, y, channel, found, code);
    }
}
