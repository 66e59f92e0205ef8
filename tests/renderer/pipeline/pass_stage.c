// What the tests of passes share.
#include "pass_stage.h"

#include "renderer/catalogue/random.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

uint8_t pictures[2][PASSES][WIDTH * HEIGHT * 4];

void copy_vertices(const DipVertexBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        for (int c = 0; c < 3; c++) {
            batch->clip[c][i] = batch->in[c][i];
        }
        batch->clip[3][i] = 1.0f;
        batch->varying[0][i] = batch->in[0][i];
    }
}

void show_varying(DipFragmentBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        for (int c = 0; c < 3; c++) {
            batch->colour[c][i] = batch->varying[0][i] * 0.5f + 0.5f;
        }
    }
    batch->work.counts[1] += (uint64_t)batch->count;
}

// Makes one large triangle behind many triangles that are smaller than a pixel. Each small triangle
// lies between the samples of some patterns and covers a sample of others.
static DipMesh *make_mesh(void) {
    static const float large[3][3] = {
        {-0.9f, -0.8f, 0.2f}, {0.9f, -0.7f, 0.2f}, {0.1f, 0.9f, 0.2f}};
    static float vertices[3 * (1 + SMALL)][3];
    static uint32_t indices[3 * (1 + SMALL)];
    Random random = {99};
    memcpy(vertices, large, sizeof large);
    for (int t = 1; t <= SMALL; t++) {
        const float x = (float)random_real(&random, -1.0, 0.98);
        const float y = (float)random_real(&random, -1.0, 0.98);
        for (int k = 0; k < 3; k++) {
            vertices[3 * t + k][0] = x + (k == 1 ? 0.013f : 0.0f);
            vertices[3 * t + k][1] = y + (k == 2 ? 0.018f : 0.0f);
            vertices[3 * t + k][2] = 0.5f;
        }
    }
    for (uint32_t i = 0; i < 3 * (1 + SMALL); i++) {
        indices[i] = i;
    }
    const DipMeshData data = {"triangles",     &vertices[0][0], 3,
                              3 * (1 + SMALL), indices,         3 * (1 + SMALL)};
    return dip_mesh_create(&data, NULL);
}

int open_stage(void **state) {
    static Stage stage;
    stage.pool = dip_pool_create(2, NULL);
    stage.mesh = make_mesh();
    for (int i = 0; i < PASSES; i++) {
        stage.pipelines[i] = dip_pipeline_create(stage.pool, dip_isa_best(), WIDTH, HEIGHT, NULL);
        assert_non_null(stage.pipelines[i]);
    }
    stage.draw = (DipDraw){.mesh = stage.mesh,
                           .vertex_shader = copy_vertices,
                           .fragment_shader = show_varying,
                           .varying_count = 1};
    *state = &stage;
    return 0;
}

int close_stage(void **state) {
    Stage *stage = *state;
    for (int i = 0; i < PASSES; i++) {
        dip_pipeline_destroy(&stage->pipelines[i]);
    }
    dip_mesh_destroy(&stage->mesh);
    dip_pool_destroy(&stage->pool);
    return 0;
}

DipPass good_pass(const Stage *stage, int index) {
    return (DipPass){.draws = &stage->draw,
                     .draw_count = 1,
                     .sample_count = 4,
                     .target = {.rgba8 = pictures[0][index],
                                .stride_bytes = (size_t)WIDTH * 4,
                                .width = WIDTH,
                                .height = HEIGHT}};
}
