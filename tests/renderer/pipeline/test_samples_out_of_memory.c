// Tests what samples that outlive a pass (renderer/pipeline/samples.h) do when memory runs out:
// they are made whole or not at all, and a pass that cannot be drawn leaves them and the depths as
// they were.
#include "renderer/pipeline/pipeline.h"
#include "tests/support/out_of_memory.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 70, HEIGHT = 9, SAMPLES = 4 };

typedef struct Fixture {
    DipPipeline *pipeline;
    DipMesh *mesh;
    DipSamples *samples;
    DipDepth *depth;
    uint8_t rgba8[HEIGHT][WIDTH][4];
} Fixture;

static bool make_samples(void *context, DipError *err) {
    Fixture *fixture = context;
    fixture->samples = dip_samples_create(WIDTH, HEIGHT, SAMPLES, DIP_FORMAT_SRGB8, err);
    return fixture->samples != NULL;
}

static void check_made(void *context, bool succeeded) {
    Fixture *fixture = context;
    assert_int_equal(fixture->samples != NULL, succeeded);
}

static void must_make_all(void *context) {
    static const float corners[3][3] = {{-1, -1, 0.5f}, {3, -1, 0.5f}, {-1, 3, 0.5f}};
    static const uint32_t indices[3] = {0, 1, 2};
    Fixture *fixture = context;
    const DipMeshData data = {"cover", &corners[0][0], 3, 3, indices, 3};
    fixture->pipeline = dip_pipeline_create(NULL, dip_isa_best(), WIDTH, HEIGHT, NULL);
    fixture->mesh = dip_mesh_create(&data, NULL);
    fixture->depth = dip_depth_create(WIDTH, HEIGHT, SAMPLES, NULL);
    assert_true(make_samples(fixture, NULL) && fixture->pipeline && fixture->mesh &&
                fixture->depth);
}

static void cover(const DipVertexBatch *batch) {
    for (int c = 0; c < 3; c++) {
        memcpy(batch->clip[c], batch->in[c], (size_t)batch->count * sizeof(float));
    }
    for (int i = 0; i < batch->count; i++) {
        batch->clip[3][i] = 1.0f;
    }
}

static void white(DipFragmentBatch *batch) {
    for (int c = 0; c < 3; c++) {
        for (int i = 0; i < batch->count; i++) {
            batch->colour[c][i] = 1.0f;
        }
    }
}

static bool draw(void *context, DipError *err) {
    Fixture *fixture = context;
    const DipDraw cover_all = {
        .mesh = fixture->mesh, .vertex_shader = cover, .fragment_shader = white};
    const DipPass pass = {
        .draws = &cover_all,
        .draw_count = 1,
        .sample_count = SAMPLES,
        .target = {.rgba8 = &fixture->rgba8[0][0][0],
                   .stride_bytes = sizeof fixture->rgba8[0],
                   .width = WIDTH,
                   .height = HEIGHT},
        .attachments = {.samples = fixture->samples, .depth = fixture->depth},
    };
    return dip_pipeline_draw(fixture->pipeline, &pass, NULL, NULL, err);
}

static void check_drawn(void *context, bool succeeded) {
    Fixture *fixture = context;
    for (int s = 0; s < SAMPLES; s++) {
        for (int y = 0; y < HEIGHT; y++) {
            float row[4][WIDTH];
            float *const colour[4] = {row[0], row[1], row[2], row[3]};
            dip_samples_read_row(fixture->samples, s, y, colour);
            for (int x = 0; x < WIDTH; x++) {
                assert_true(row[2][x] == (succeeded ? 1.0f : 0.0f));
                assert_true(dip_depth_row(fixture->depth, s, y)[x] == (succeeded ? 0.5f : 0.0f));
            }
        }
    }
}

static void finish(void *context) {
    Fixture *fixture = context;
    dip_samples_destroy(&fixture->samples);
    dip_depth_destroy(&fixture->depth);
    dip_mesh_destroy(&fixture->mesh);
    dip_pipeline_destroy(&fixture->pipeline);
}

static void samples_are_made_and_drawn_whole_or_not_at_all(void **state) {
    (void)state;
    static Fixture fixture;
    const DipOutOfMemory operations[] = {
        {.name = "samples", .run = make_samples, .check = check_made},
        {.name = "a pass with samples",
         .prepare = must_make_all,
         .run = draw,
         .check = check_drawn},
    };
    for (size_t i = 0; i < sizeof operations / sizeof *operations; i++) {
        DipOutOfMemory operation = operations[i];
        operation.context = &fixture;
        operation.finish = finish;
        operation.needs_every_allocation = true;
        dip_out_of_memory_check(&operation);
    }
}

int main(int argc, char **argv) {
    dip_out_of_memory_read_options(argc, argv);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samples_are_made_and_drawn_whole_or_not_at_all)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
