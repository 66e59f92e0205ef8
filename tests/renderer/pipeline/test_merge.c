// Compares merged passes (ordered draws, kept colours, depths and stencil values, viewports and
// scissors) with a plain model that draws one sample at a time: random lists of draws, in every
// number of samples, with every instruction set. Depths and stencil values must be equal, colours
// within the rounding of their floats.
//
//     test_merge [--draws N]    (default 4000; the long run draws 100,000)
#include "tests/renderer/pipeline/merge_draws.h"
#include "tests/renderer/pipeline/merge_list.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static int draw_total = 4000;

// --- drawing by the pipeline ---------------------------------------------------------------------

// What the pipeline has drawn.
typedef struct Drawn {
    DipDepth *depth;
    uint8_t rgba8[MODEL_HEIGHT][MODEL_WIDTH][4];
    float floats[MODEL_HEIGHT][MODEL_WIDTH][4];
} Drawn;

static void draw_pass(DipPipeline *pipeline, const ModelList *list, int p, Drawn *drawn) {
    DipDraw draws[MODEL_DRAWS];
    DipMesh *meshes[MODEL_DRAWS];
    model_make_draws(list->draws[p], MODEL_DRAWS, draws, meshes);
    const bool floats = list->format == DIP_FORMAT_RGBA32F;
    DipPass pass = {
        .draws = draws,
        .draw_count = MODEL_DRAWS,
        .sample_count = list->sample_count,
        .clear_lin = {list->clear[0], list->clear[1], list->clear[2]},
        .target = {.stride_bytes = sizeof drawn->rgba8[0],
                   .width = MODEL_WIDTH,
                   .height = MODEL_HEIGHT,
                   .format = list->format},
        .attachments = {.colour_load = p && list->keeps_colour ? DIP_LOAD_KEEP : DIP_LOAD_CLEAR,
                        .clear_transparent = list->clear[3] < 0.5f,
                        .depth = drawn->depth,
                        .depth_load = p && list->keeps_depth ? DIP_LOAD_KEEP : DIP_LOAD_CLEAR,
                        .clear_depth = list->clear_depth,
                        .stencil_load = p && list->keeps_depth ? DIP_LOAD_KEEP : DIP_LOAD_CLEAR,
                        .clear_stencil = list->clear_stencil},
        .scissor = list->scissor[p],
    };
    if (floats) {
        pass.target.floats = &drawn->floats[0][0][0];
        pass.target.stride_bytes = sizeof drawn->floats[0];
    } else {
        pass.target.rgba8 = &drawn->rgba8[0][0][0];
    }
    DipPipelineCounters counters = {0};
    DipStageTimes times = {0};
    DipError err = {0};
    if (!dip_pipeline_draw(pipeline, &pass, &counters, &times, &err)) {
        fail_msg("%s: %s", err.key, err.message);
    }
    model_free_meshes(meshes, MODEL_DRAWS);
}

// --- comparing -----------------------------------------------------------------------------------

static DipTargetRegion stored_of(const DipTargetRegion *scissor) {
    return scissor->x1 ? *scissor : (DipTargetRegion){0, 0, MODEL_WIDTH, MODEL_HEIGHT};
}

static void compare_colour(const ModelList *list, const Model *model, const Drawn *drawn, int x,
                           int y) {
    const ModelValue *expected = model->colour[y][x][0];
    for (int c = 0; c < 4; c++) {
        if (list->format == DIP_FORMAT_RGBA32F) {
            model_assert_float(drawn->floats[y][x][c], expected[c], x, y, c);
        } else {
            model_assert_code(drawn->rgba8[y][x][c], expected[c], x, y, c);
        }
    }
}

static void compare_pixel(const ModelList *list, const Model *model, const Drawn *drawn, int x,
                          int y) {
    for (int s = 0; s < list->sample_count; s++) {
        const double depth = dip_depth_row(drawn->depth, s, y)[x];
        const int stencil = dip_stencil_row(drawn->depth, s, y)[x];
        if (depth != model->depth[y][x][s] || stencil != model->stencil[y][x][s]) {
            fail_msg("pixel %d, %d, sample %d: depth %g, stencil %d, expected %g and %d", x, y, s,
                     depth, stencil, model->depth[y][x][s], model->stencil[y][x][s]);
        }
    }
    compare_colour(list, model, drawn, x, y);
}

static void run_list(DipPipeline *pipeline, const ModelList *list) {
    static Model model;
    static Drawn drawn;
    memset(&drawn, 0, sizeof drawn);
    memset(&model, 0, sizeof model);
    model.sample_count = list->sample_count;
    model.clamps = list->format == DIP_FORMAT_SRGB8;
    drawn.depth = dip_depth_create(MODEL_WIDTH, MODEL_HEIGHT, list->sample_count, NULL);
    assert_non_null(drawn.depth);
    for (int p = 0; p < MODEL_PASSES; p++) {
        model.stored = stored_of(&list->scissor[p]);
        const bool keeps_depth = p && list->keeps_depth;
        model_clear(&model, p && list->keeps_colour ? NULL : list->clear,
                    keeps_depth ? -1.0f : list->clear_depth, list->clear_stencil);
        for (int d = 0; d < MODEL_DRAWS; d++) {
            model_draw(&model, &list->draws[p][d]);
        }
        model_resolve(&model);
        draw_pass(pipeline, list, p, &drawn);
    }
    for (int y = 0; y < MODEL_HEIGHT; y++) {
        for (int x = 0; x < MODEL_WIDTH; x++) {
            // Pixels outside both scissors hold what was there: zeros.
            compare_pixel(list, &model, &drawn, x, y);
        }
    }
    dip_depth_destroy(&drawn.depth);
}

static void random_lists(void **state) {
    (void)state;
    Random random = {13};
    DipPool *pool = dip_pool_create(2, NULL);
    DipPipeline *pipelines[DIP_ISA_COUNT] = {NULL};
    for (int isa = 0; isa < DIP_ISA_COUNT; isa++) {
        if (dip_isa_available((DipIsa)isa)) {
            pipelines[isa] =
                dip_pipeline_create(pool, (DipIsa)isa, MODEL_WIDTH, MODEL_HEIGHT, NULL);
            assert_non_null(pipelines[isa]);
        }
    }
    static ModelList list;
    for (int drawn = 0, isa = 0; drawn < draw_total; isa = (isa + 1) % DIP_ISA_COUNT) {
        if (pipelines[isa]) {
            model_random_list(&random, &list);
            run_list(pipelines[isa], &list);
            drawn += MODEL_PASSES * MODEL_DRAWS;
        }
    }
    for (int isa = 0; isa < DIP_ISA_COUNT; isa++) {
        dip_pipeline_destroy(&pipelines[isa]);
    }
    dip_pool_destroy(&pool);
}

int main(int argc, char **argv) {
    if (argc == 3 && strcmp(argv[1], "--draws") == 0) {
        draw_total = atoi(argv[2]);
    }
    const struct CMUnitTest tests[] = {cmocka_unit_test(random_lists)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
