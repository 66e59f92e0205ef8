// Tests colours of samples that outlive a pass (renderer/pipeline/samples.h): lists of draws that
// are cut into passes have the bits of one pass, and every sample has the colour of the plain model
// (merge_model.h), which draws one sample at a time.
//
//     test_samples [--lists N]    (default 150)
#include "renderer/base/srgb.h"
#include "tests/renderer/pipeline/merge_draws.h"
#include "tests/renderer/pipeline/merge_list.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { DRAWS = MODEL_PASSES * MODEL_DRAWS, ODD_WIDTH = 61, ODD_HEIGHT = 35 };

static int list_total = 150;

// Pipelines of the model's size, and one whose size is no multiple of a block's.
static DipPool *pools[2];
static DipPipeline *pipelines[2 * DIP_ISA_COUNT];
static int pipeline_count;
static DipPipeline *odd_pipeline;

static int open_pipelines(void **state) {
    (void)state;
    for (int p = 0; p < 2; p++) {
        pools[p] = dip_pool_create(p ? 3 : 1, NULL);
        for (int isa = 0; isa < DIP_ISA_COUNT; isa++) {
            if (dip_isa_available((DipIsa)isa)) {
                pipelines[pipeline_count++] =
                    dip_pipeline_create(pools[p], (DipIsa)isa, MODEL_WIDTH, MODEL_HEIGHT, NULL);
                assert_non_null(pipelines[pipeline_count - 1]);
            }
        }
    }
    odd_pipeline = dip_pipeline_create(pools[1], dip_isa_best(), ODD_WIDTH, ODD_HEIGHT, NULL);
    assert_non_null(odd_pipeline);
    return 0;
}

static int close_pipelines(void **state) {
    (void)state;
    for (int i = 0; i < pipeline_count; i++) {
        dip_pipeline_destroy(&pipelines[i]);
    }
    dip_pipeline_destroy(&odd_pipeline);
    dip_pool_destroy(&pools[0]);
    dip_pool_destroy(&pools[1]);
    return 0;
}

static void run(DipPipeline *pipeline, const DipPass *pass) {
    DipError err = {0};
    if (!dip_pipeline_draw(pipeline, pass, NULL, NULL, &err)) {
        fail_msg("%s: %s", err.key, err.message);
    }
}

// --- what the pipeline draws ---------------------------------------------------------------------

typedef struct Drawn {
    int width;
    int height;
    int sample_count;
    DipFormat format;
    DipSamples *samples;
    DipDepth *depth;
    union {
        uint8_t rgba8[MODEL_HEIGHT][MODEL_WIDTH][4];
        float floats[MODEL_HEIGHT][MODEL_WIDTH][4];
    };
} Drawn;

static void begin_drawn(Drawn *drawn, int width, int height, int sample_count, DipFormat format) {
    memset(drawn, 0, sizeof *drawn);
    drawn->width = width;
    drawn->height = height;
    drawn->sample_count = sample_count;
    drawn->format = format;
    drawn->samples = dip_samples_create(width, height, sample_count, format, NULL);
    drawn->depth = dip_depth_create(width, height, sample_count, NULL);
    assert_true(drawn->samples && drawn->depth);
}

static void end_drawn(Drawn *drawn) {
    dip_samples_destroy(&drawn->samples);
    dip_depth_destroy(&drawn->depth);
}

static DipTarget target_of(Drawn *drawn) {
    DipTarget target = {.width = drawn->width, .height = drawn->height, .format = drawn->format};
    if (drawn->format == DIP_FORMAT_RGBA32F) {
        target.floats = &drawn->floats[0][0][0];
        target.stride_bytes = sizeof drawn->floats[0];
    } else {
        target.rgba8 = &drawn->rgba8[0][0][0];
        target.stride_bytes = sizeof drawn->rgba8[0];
    }
    return target;
}

// Reads all colours of one row of a sample.
static void read_row(const DipSamples *samples, int s, int y, float row[4][MODEL_WIDTH]) {
    memset(row, 0, 4 * sizeof row[0]);
    float *const colour[4] = {row[0], row[1], row[2], row[3]};
    dip_samples_read_row(samples, s, y, colour);
}

// The bits of a NaN depend on the instruction set.
static void assert_same_floats(const float *a, const float *b, int count) {
    for (int i = 0; i < count; i++) {
        if (memcmp(&a[i], &b[i], sizeof *a) != 0 && !(a[i] != a[i] && b[i] != b[i])) {
            fail_msg("number %d: %.9g, expected %.9g", i, (double)b[i], (double)a[i]);
        }
    }
}

static void assert_same_targets(const Drawn *expected, const Drawn *found) {
    if (expected->format == DIP_FORMAT_RGBA32F) {
        assert_same_floats(&expected->floats[0][0][0], &found->floats[0][0][0],
                           MODEL_HEIGHT * MODEL_WIDTH * 4);
    } else {
        assert_memory_equal(expected->rgba8, found->rgba8, sizeof expected->rgba8);
    }
}

static void assert_same(const Drawn *expected, const Drawn *found) {
    assert_same_targets(expected, found);
    for (int s = 0; s < expected->sample_count; s++) {
        for (int y = 0; y < expected->height; y++) {
            float rows[2][4][MODEL_WIDTH];
            read_row(expected->samples, s, y, rows[0]);
            read_row(found->samples, s, y, rows[1]);
            assert_same_floats(&rows[0][0][0], &rows[1][0][0], 4 * MODEL_WIDTH);
            const size_t width = (size_t)expected->width;
            assert_memory_equal(dip_depth_row(expected->depth, s, y),
                                dip_depth_row(found->depth, s, y), width * sizeof(float));
            assert_memory_equal(dip_stencil_row(expected->depth, s, y),
                                dip_stencil_row(found->depth, s, y), width);
        }
    }
}

// Begins a pass over everything that `drawn` has. Its clear values are those of the list.
static DipPass pass_of(const ModelList *list, Drawn *drawn) {
    return (DipPass){
        .sample_count = list->sample_count,
        .clear_lin = {list->clear[0], list->clear[1], list->clear[2]},
        .target = target_of(drawn),
        .attachments = {.samples = drawn->samples,
                        .depth = drawn->depth,
                        .clear_transparent = list->clear[3] < 0.5f,
                        .clear_depth = list->clear_depth,
                        .clear_stencil = list->clear_stencil},
    };
}

static void keep(DipPass *pass) {
    pass->attachments.colour_load = DIP_LOAD_KEEP;
    pass->attachments.depth_load = DIP_LOAD_KEEP;
    pass->attachments.stencil_load = DIP_LOAD_KEEP;
}

// --- lists that are cut into passes --------------------------------------------------------------

// A list of draws and the passes that it is cut into.
typedef struct CutList {
    const ModelList *list;
    DipDraw draws[DRAWS];
    DipMesh *meshes[DRAWS];
    DipTargetRegion viewport;
    DipTargetRegion scissor;
    DipTargetRegion region;
    bool ends_pass[DRAWS]; // a pass ends after the draw
} CutList;

static void limit(const CutList *cut, DipPass *pass) {
    pass->viewport = cut->viewport;
    pass->scissor = cut->scissor;
    pass->region = cut->region;
}

static void draw_at_once(DipPipeline *pipeline, const CutList *cut, Drawn *drawn) {
    DipPass pass = pass_of(cut->list, drawn);
    limit(cut, &pass);
    pass.draws = cut->draws;
    pass.draw_count = DRAWS;
    run(pipeline, &pass);
}

// Only the last pass must store means. Some of the others do, too, and some have no pixels.
static void draw_cut(DipPipeline *pipeline, const CutList *cut, Random *random, Drawn *drawn) {
    for (int first = 0, d = 0; d < DRAWS; d++) {
        if (!cut->ends_pass[d] && d < DRAWS - 1) {
            continue;
        }
        DipPass pass = pass_of(cut->list, drawn);
        limit(cut, &pass);
        pass.draws = cut->draws + first;
        pass.draw_count = d + 1 - first;
        pass.attachments.keep_target = d < DRAWS - 1 && random_int(random, 0, 2);
        if (pass.attachments.keep_target && random_int(random, 0, 1)) {
            pass.target.rgba8 = NULL;
        }
        if (first) {
            keep(&pass);
        }
        run(pipeline, &pass);
        first = d + 1;
    }
}

// Draws a cut list in one pass, with and without samples that outlive it, and then in its passes.
static void check_cut(DipPipeline *whole, DipPipeline *const *cutting, int cutting_count,
                      const CutList *cut, Random *random, const int size[2]) {
    static Drawn expected;
    static Drawn found;
    const ModelList *list = cut->list;
    begin_drawn(&expected, size[0], size[1], list->sample_count, list->format);
    draw_at_once(whole, cut, &expected);
    for (int i = 0; i <= cutting_count; i++) {
        begin_drawn(&found, size[0], size[1], list->sample_count, list->format);
        if (i == cutting_count) {
            dip_samples_destroy(&found.samples);
            draw_at_once(whole, cut, &found);
            assert_same_targets(&expected, &found);
        } else {
            draw_cut(cutting[i], cut, random, &found);
            assert_same(&expected, &found);
        }
        end_drawn(&found);
    }
    end_drawn(&expected);
}

static DipTargetRegion random_rectangle(Random *random, const int size[2]) {
    const int x = random_int(random, 0, size[0] - 2);
    const int y = random_int(random, 0, size[1] - 2);
    if (random_int(random, 0, 2)) {
        return (DipTargetRegion){0, 0, 0, 0};
    }
    return (DipTargetRegion){x, y, random_int(random, x + 1, size[0]),
                             random_int(random, y + 1, size[1])};
}

// Varyings 0 and 1 are the position in pixels of the whole target.
static void vertex_with_place(const DipVertexBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        batch->clip[0][i] = batch->in[0][i] * (2.0f / MODEL_WIDTH) - 1.0f;
        batch->clip[1][i] = 1.0f - batch->in[1][i] * (2.0f / MODEL_HEIGHT);
        batch->clip[2][i] = batch->in[2][i];
        batch->clip[3][i] = 1.0f;
        batch->varying[0][i] = batch->in[0][i];
        batch->varying[1][i] = batch->in[1][i];
    }
}

// A colour that depends on where in its pixel a fragment is shaded.
static void shade_place(DipFragmentBatch *batch) {
    const ModelDraw *draw = batch->uniforms;
    for (int i = 0; i < batch->count; i++) {
        batch->colour[0][i] = draw->colour[0] * batch->varying[0][i] * (1.0f / MODEL_WIDTH);
        batch->colour[1][i] = draw->colour[1] * batch->varying[1][i] * (1.0f / MODEL_HEIGHT);
        batch->colour[2][i] = draw->colour[2];
        batch->alpha[i] = draw->colour[3];
    }
}

// by_place: the fragments' colours depend on where in a pixel they are shaded, and every cut lies
// next to an ordered draw. Otherwise the cuts lie anywhere.
static void make_cut(CutList *cut, const ModelList *list, Random *random, bool by_place,
                     const int size[2]) {
    cut->list = list;
    for (int p = 0; p < MODEL_PASSES; p++) {
        model_make_draws(list->draws[p], MODEL_DRAWS, cut->draws + p * MODEL_DRAWS,
                         cut->meshes + p * MODEL_DRAWS);
    }
    cut->viewport = random_rectangle(random, size);
    cut->scissor = random_rectangle(random, size);
    cut->region = random_rectangle(random, size);
    const int odds = random_int(random, 0, 6);
    for (int d = 0; d < DRAWS; d++) {
        cut->ends_pass[d] = random_int(random, 0, odds) == 0;
    }
    for (int d = 0; by_place && d < DRAWS; d++) {
        cut->draws[d].vertex_shader = vertex_with_place;
        cut->draws[d].fragment_shader = shade_place;
        cut->draws[d].varying_count = 2;
        cut->ends_pass[d] &= d + 1 < DRAWS && (dip_state_is_ordered(cut->draws[d].state) ||
                                               dip_state_is_ordered(cut->draws[d + 1].state));
    }
}

static void passes_of_a_cut_list_have_the_bits_of_one_pass(void **state) {
    (void)state;
    static const int sizes[2][2] = {{MODEL_WIDTH, MODEL_HEIGHT}, {ODD_WIDTH, ODD_HEIGHT}};
    static ModelList list;
    static CutList cut;
    Random random = {31};
    for (int round = 0; round < list_total; round++) {
        const bool odd = round % 3 == 2;
        model_random_list(&random, &list);
        make_cut(&cut, &list, &random, round % 2, sizes[odd]);
        if (odd) {
            check_cut(odd_pipeline, &odd_pipeline, 1, &cut, &random, sizes[1]);
        } else {
            check_cut(pipelines[round % pipeline_count], pipelines, pipeline_count, &cut, &random,
                      sizes[0]);
        }
        model_free_meshes(cut.meshes, DRAWS);
    }
}

// --- the plain model -----------------------------------------------------------------------------

static void compare_samples(const Model *model, const Drawn *drawn, int y) {
    for (int s = 0; s < drawn->sample_count; s++) {
        float row[4][MODEL_WIDTH];
        read_row(drawn->samples, s, y, row);
        for (int x = 0; x < MODEL_WIDTH; x++) {
            for (int c = 0; c < 4; c++) {
                model_assert_float((double)row[c][x], model->colour[y][x][s][c], x, y, c);
            }
            assert_true((double)dip_depth_row(drawn->depth, s, y)[x] == model->depth[y][x][s]);
            assert_int_equal(dip_stencil_row(drawn->depth, s, y)[x], model->stencil[y][x][s]);
        }
    }
}

static void compare_target(const Model *model, const Drawn *drawn, int y) {
    for (int x = 0; x < MODEL_WIDTH; x++) {
        for (int c = 0; c < 4; c++) {
            const ModelValue expected = model->colour[y][x][0][c];
            if (drawn->format == DIP_FORMAT_RGBA32F) {
                model_assert_float((double)drawn->floats[y][x][c], expected, x, y, c);
            } else {
                model_assert_code(drawn->rgba8[y][x][c], expected, x, y, c);
            }
        }
    }
}

// Draws a list in two passes, each with a scissor of its own, by the model and by the pipeline.
static void check_model(DipPipeline *pipeline, const ModelList *list, bool keeps_samples) {
    static Model model;
    static Drawn drawn;
    memset(&model, 0, sizeof model);
    begin_drawn(&drawn, MODEL_WIDTH, MODEL_HEIGHT, list->sample_count, list->format);
    model.sample_count = list->sample_count;
    model.clamps = list->format == DIP_FORMAT_SRGB8;
    for (int p = 0; p < MODEL_PASSES; p++) {
        DipDraw draws[MODEL_DRAWS];
        DipMesh *meshes[MODEL_DRAWS];
        model_make_draws(list->draws[p], MODEL_DRAWS, draws, meshes);
        DipPass pass = pass_of(list, &drawn);
        pass.draws = draws;
        pass.draw_count = MODEL_DRAWS;
        pass.scissor = list->scissor[p];
        const bool keeps_depth = p && list->keeps_depth;
        if (p && keeps_samples) {
            pass.attachments.colour_load = DIP_LOAD_KEEP;
        }
        if (keeps_depth) {
            pass.attachments.depth_load = pass.attachments.stencil_load = DIP_LOAD_KEEP;
        }
        run(pipeline, &pass);
        model_free_meshes(meshes, MODEL_DRAWS);
        model.stored =
            pass.scissor.x1 ? pass.scissor : (DipTargetRegion){0, 0, MODEL_WIDTH, MODEL_HEIGHT};
        model_clear(&model, p && keeps_samples ? NULL : list->clear,
                    keeps_depth ? -1.0f : list->clear_depth, list->clear_stencil);
        for (int d = 0; d < MODEL_DRAWS; d++) {
            model_draw(&model, &list->draws[p][d]);
        }
    }
    for (int y = 0; y < MODEL_HEIGHT; y++) {
        compare_samples(&model, &drawn, y);
    }
    model_resolve(&model);
    for (int y = 0; y < MODEL_HEIGHT; y++) {
        compare_target(&model, &drawn, y);
    }
    end_drawn(&drawn);
}

static void samples_are_those_of_the_model(void **state) {
    (void)state;
    static ModelList list;
    Random random = {47};
    for (int round = 0; round < list_total; round++) {
        model_random_list(&random, &list);
        check_model(pipelines[round % pipeline_count], &list, random_int(&random, 0, 3) > 0);
    }
}

// --- edges of opaque surfaces --------------------------------------------------------------------

typedef struct Colour {
    float channel[4];
} Colour;

static void one_colour(DipFragmentBatch *batch) {
    const Colour *colour = batch->uniforms;
    for (int i = 0; i < batch->count; i++) {
        for (int c = 0; c < 3; c++) {
            batch->colour[c][i] = colour->channel[c];
        }
        batch->alpha[i] = colour->channel[3];
    }
}

// Makes a draw of everything left of column `right`, which may lie within a pixel.
static DipDraw draw_left_of(float right, float depth, const Colour *colour,
                            const DipDrawState *state, DipMesh **mesh) {
    const float corners[4][3] = {{0.0f, 0.0f, depth},
                                 {0.0f, MODEL_HEIGHT, depth},
                                 {right, MODEL_HEIGHT, depth},
                                 {right, 0.0f, depth}};
    const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    const DipMeshData data = {"left", &corners[0][0], 3, 4, indices, 6};
    *mesh = dip_mesh_create(&data, NULL);
    assert_non_null(*mesh);
    return (DipDraw){.mesh = *mesh,
                     .vertex_shader = vertex_with_place,
                     .fragment_shader = one_colour,
                     .varying_count = 2,
                     .uniforms = colour,
                     .state = state};
}

static const Colour black = {{0.0f, 0.0f, 0.0f, 1.0f}};
static const Colour half_black = {{0.0f, 0.0f, 0.0f, 0.5f}};
static const DipDrawState blended = {.blend = DIP_BLEND_MODE_ALPHA, .keep_depth = true};

// The first pass draws a black surface over a white background; its edge leaves some samples of a
// pixel white. The second pass draws half-transparent black behind the surface. The pixel becomes
// half as bright as the share of its white samples. A pass that keeps the target's colours instead
// darkens the mean of white and black in the white samples, and leaves the others too bright.
static void blending_behind_an_edge_leaves_no_halo(void **state) {
    (void)state;
    static Drawn drawn;
    DipSrgbEncodeTable table;
    dip_srgb_encode_table(&table);
    for (int count = 1; count <= 8; count += count == 1 ? 1 : 2) {
        DipMesh *meshes[2];
        const DipDraw draws[2] = {
            draw_left_of(20.4f, 0.75f, &black, NULL, &meshes[0]),
            draw_left_of(MODEL_WIDTH, 0.25f, &half_black, &blended, &meshes[1])};
        begin_drawn(&drawn, MODEL_WIDTH, MODEL_HEIGHT, count, DIP_FORMAT_SRGB8);
        const ModelList list = {.sample_count = count, .clear = {1.0f, 1.0f, 1.0f, 1.0f}};
        DipPass pass = pass_of(&list, &drawn);
        pass.draws = &draws[0];
        pass.draw_count = 1;
        pass.attachments.keep_target = true;
        run(pipelines[0], &pass);
        keep(&pass);
        pass.draws = &draws[1];
        pass.attachments.keep_target = false;
        run(pipelines[0], &pass);
        const DipSamplePattern *pattern = dip_sample_pattern(count);
        int white = 0;
        for (int s = 0; s < count; s++) {
            white += pattern->x[s] > 102; // 0.4 pixels
        }
        const int mean16 = (white * 32768 + count / 2) / count;
        for (int c = 0; c < 3; c++) {
            assert_int_equal(drawn.rgba8[10][20][c], dip_srgb_code(&table, mean16));
            assert_int_equal(drawn.rgba8[10][19][c], 0);
            assert_int_equal(drawn.rgba8[10][21][c], dip_srgb_code(&table, 32768));
        }
        end_drawn(&drawn);
        model_free_meshes(meshes, 2);
    }
}

// --- what becomes of attachments -----------------------------------------------------------------

static const ModelList four_samples = {.sample_count = 4, .clear = {0.25f, 0.5f, 0.75f, 1.0f}};

// Draws a list's first draws into everything that `drawn` has.
static void draw_something(Drawn *drawn, const DipDraw *draws, int count) {
    DipPass pass = pass_of(&four_samples, drawn);
    pass.draws = draws;
    pass.draw_count = count;
    pass.attachments.keep_target = true;
    run(pipelines[0], &pass);
}

static void new_samples_are_zero(void **state) {
    (void)state;
    DipSamples *samples = dip_samples_create(ODD_WIDTH, ODD_HEIGHT, 6, DIP_FORMAT_R32F, NULL);
    assert_int_equal(dip_samples_width(samples), ODD_WIDTH);
    assert_int_equal(dip_samples_height(samples), ODD_HEIGHT);
    assert_int_equal(dip_samples_sample_count(samples), 6);
    assert_int_equal(dip_samples_format(samples), DIP_FORMAT_R32F);
    static const float zeros[4][MODEL_WIDTH];
    for (int s = 0; s < 6; s++) {
        for (int y = 0; y < ODD_HEIGHT; y++) {
            float row[4][MODEL_WIDTH];
            read_row(samples, s, y, row);
            assert_memory_equal(row, zeros, sizeof zeros);
        }
    }
    dip_samples_destroy(&samples);
    assert_null(samples);
    dip_samples_destroy(&samples);
}

// A pass with keep_target writes nothing to the target, and counts no bytes. A pass without draws
// stores the means, within its scissor.
static void means_are_stored_when_a_pass_asks(void **state) {
    (void)state;
    static Drawn drawn;
    static uint8_t before[MODEL_HEIGHT][MODEL_WIDTH][4];
    DipMesh *mesh;
    const DipDraw draw = draw_left_of(30.5f, 0.5f, &black, NULL, &mesh);
    begin_drawn(&drawn, MODEL_WIDTH, MODEL_HEIGHT, 4, DIP_FORMAT_SRGB8);
    for (int i = 0; i < MODEL_HEIGHT * MODEL_WIDTH * 4; i++) {
        (&drawn.rgba8[0][0][0])[i] = (uint8_t)(i * 7 + i / 251);
    }
    memcpy(before, drawn.rgba8, sizeof before);
    DipPass pass = pass_of(&four_samples, &drawn);
    pass.draws = &draw;
    pass.draw_count = 1;
    pass.attachments.keep_target = true;
    DipPipelineCounters counters = {0};
    assert_true(dip_pipeline_draw(pipelines[0], &pass, &counters, NULL, NULL));
    assert_memory_equal(before, drawn.rgba8, sizeof before);
    assert_int_equal(counters.target_bytes, 0);
    keep(&pass);
    pass.draw_count = 0;
    pass.attachments.keep_target = false;
    pass.scissor = (DipTargetRegion){3, 5, 69, 31};
    assert_true(dip_pipeline_draw(pipelines[0], &pass, &counters, NULL, NULL));
    assert_int_equal(counters.target_bytes, MODEL_WIDTH * MODEL_HEIGHT * 4);
    DipSrgbEncodeTable table;
    dip_srgb_encode_table(&table);
    for (int y = 0; y < MODEL_HEIGHT; y++) {
        for (int x = 0; x < MODEL_WIDTH; x++) {
            const bool stored = x >= 3 && x < 69 && y >= 5 && y < 31;
            for (int c = 0; c < 3; c++) {
                const int light = (int)(four_samples.clear[c] * 65535.0f + 0.5f);
                const int shown = x < 30 ? 0 : x == 30 ? light / 2 + (light & 1) : light;
                assert_int_equal(drawn.rgba8[y][x][c],
                                 stored ? dip_srgb_code(&table, shown) : before[y][x][c]);
            }
        }
    }
    end_drawn(&drawn);
    dip_mesh_destroy(&mesh);
}

// A pass that reverts its attachments shows its draws in the target alone, so that it can be drawn
// again over the same samples and depths.
static void reverted_attachments_are_what_they_were(void **state) {
    (void)state;
    static Drawn expected;
    static Drawn found;
    DipMesh *meshes[3];
    const DipDraw draws[3] = {draw_left_of(30.4f, 0.5f, &black, NULL, &meshes[0]),
                              draw_left_of(50.2f, 0.25f, &half_black, &blended, &meshes[1]),
                              draw_left_of(10.3f, 0.75f, &half_black, NULL, &meshes[2])};
    begin_drawn(&expected, MODEL_WIDTH, MODEL_HEIGHT, 4, DIP_FORMAT_SRGB8);
    begin_drawn(&found, MODEL_WIDTH, MODEL_HEIGHT, 4, DIP_FORMAT_SRGB8);
    draw_something(&expected, draws, 1);
    draw_something(&found, draws, 1);
    for (int times = 0; times < 2; times++) {
        DipPass pass = pass_of(&four_samples, &found);
        keep(&pass);
        pass.draws = draws + 1;
        pass.draw_count = 2;
        pass.attachments.colour_store = DIP_STORE_REVERT;
        pass.attachments.depth_store = pass.attachments.stencil_store = DIP_STORE_REVERT;
        run(pipelines[0], &pass);
        DipPass whole = pass_of(&four_samples, &expected);
        DipSamples *own = whole.attachments.samples;
        whole.attachments.samples = NULL;
        whole.attachments.depth = NULL;
        whole.draws = draws;
        whole.draw_count = 3;
        run(pipelines[0], &whole);
        whole.attachments.samples = own;
        assert_same(&expected, &found);
    }
    end_drawn(&expected);
    end_drawn(&found);
    model_free_meshes(meshes, 3);
}

static void read_target(DipFragmentBatch *batch) {
    const DipTarget *target = *(const DipTarget *const *)batch->uniforms;
    float u[DIP_FRAGMENT_BATCH], v[DIP_FRAGMENT_BATCH];
    float read[3][DIP_FRAGMENT_BATCH];
    for (int i = 0; i < batch->count; i++) {
        u[i] = v[i] = 0.5f;
    }
    batch->sample_target(batch, target, u, v, read);
    for (int c = 0; c < 3; c++) {
        memcpy(batch->colour[c], read[c], sizeof read[c]);
    }
}

// A pass with keep_target may read the picture that earlier passes have left in the target.
static void a_target_that_is_kept_may_be_read(void **state) {
    (void)state;
    static Drawn drawn;
    DipMesh *mesh;
    DipDraw draw = draw_left_of(MODEL_WIDTH, 0.5f, NULL, NULL, &mesh);
    begin_drawn(&drawn, MODEL_WIDTH, MODEL_HEIGHT, 4, DIP_FORMAT_SRGB8);
    memset(drawn.rgba8, 255, sizeof drawn.rgba8);
    DipPass pass = pass_of(&four_samples, &drawn);
    const DipTarget *target = &pass.target;
    draw.fragment_shader = read_target;
    draw.uniforms = &target;
    pass.draws = &draw;
    pass.draw_count = 1;
    pass.attachments.keep_target = true;
    run(pipelines[0], &pass);
    float row[4][MODEL_WIDTH];
    read_row(drawn.samples, 3, 7, row);
    assert_true(row[0][9] == 1.0f);
    pass.attachments.keep_target = false;
    DipError err = {0};
    assert_false(dip_pipeline_draw(pipelines[0], &pass, NULL, NULL, &err));
    assert_string_equal(err.key, "draws[0].sample_target");
    end_drawn(&drawn);
    dip_mesh_destroy(&mesh);
}

// --- formats -------------------------------------------------------------------------------------

static float stored_green[MODEL_WIDTH];

static void store_green(void *context, int x, int y, int count, const float *const colour[4]) {
    (void)context;
    for (int i = 0; y == 7 && i < count; i++) {
        stored_green[x + i] = colour[1][i];
    }
}

// A pass that keeps samples of a caller's format needs no function that loads the target's pixels,
// and one that keeps the target no function that stores them.
static void a_callers_format_needs_no_loads(void **state) {
    (void)state;
    static Drawn drawn;
    DipMesh *meshes[2];
    static const Colour bright = {{0.0f, 6.0f, 0.0f, 1.0f}};
    const DipDraw draws[2] = {draw_left_of(40.0f, 0.5f, &bright, NULL, &meshes[0]),
                              draw_left_of(MODEL_WIDTH, 0.25f, &half_black, &blended, &meshes[1])};
    begin_drawn(&drawn, MODEL_WIDTH, MODEL_HEIGHT, 4, DIP_FORMAT_CALLER);
    draw_something(&drawn, draws, 1);
    DipPass pass = pass_of(&four_samples, &drawn);
    keep(&pass);
    pass.draws = draws + 1;
    pass.draw_count = 1;
    pass.target.store = store_green;
    run(pipelines[0], &pass);
    assert_true(stored_green[39] == 6.0f && stored_green[40] == 0.25f);
    end_drawn(&drawn);
    model_free_meshes(meshes, 2);
}

// --- what is refused -----------------------------------------------------------------------------

static void assert_refused(const DipPass *pass, DipErrorCode code, const char *key) {
    DipError err = {0};
    assert_false(dip_pipeline_draw(pipelines[0], pass, NULL, NULL, &err));
    assert_int_equal(err.code, code);
    assert_string_equal(err.key, key);
}

static void wrong_samples_are_refused(void **state) {
    (void)state;
    static Drawn drawn;
    begin_drawn(&drawn, MODEL_WIDTH, MODEL_HEIGHT, 4, DIP_FORMAT_SRGB8);
    const DipPass good = pass_of(&four_samples, &drawn);
    run(pipelines[0], &good);
    static const struct {
        int width, height, sample_count;
        DipFormat format;
    } wrong[] = {
        {MODEL_WIDTH - 1, MODEL_HEIGHT, 4, DIP_FORMAT_SRGB8},
        {MODEL_WIDTH, MODEL_HEIGHT + 1, 4, DIP_FORMAT_SRGB8},
        {MODEL_WIDTH, MODEL_HEIGHT, 8, DIP_FORMAT_SRGB8},
        {MODEL_WIDTH, MODEL_HEIGHT, 4, DIP_FORMAT_RGBA32F},
        {MODEL_WIDTH, MODEL_HEIGHT, 4, DIP_FORMAT_LINEAR8},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        DipPass pass = good;
        pass.attachments.samples = dip_samples_create(wrong[i].width, wrong[i].height,
                                                      wrong[i].sample_count, wrong[i].format, NULL);
        assert_refused(&pass, DIP_ERROR_CONFLICT, "attachments.samples");
        dip_samples_destroy(&pass.attachments.samples);
    }
    DipPass pass = good;
    pass.attachments.samples = NULL;
    pass.attachments.keep_target = true;
    assert_refused(&pass, DIP_ERROR_MISSING, "attachments.samples");
    // Means cannot be stored in a target without pixels, also if the pass has depths.
    pass = good;
    pass.target.rgba8 = NULL;
    assert_refused(&pass, DIP_ERROR_MISSING, "target.rgba8");
    pass = good;
    pass.attachments.colour_store = (DipStore)3;
    assert_refused(&pass, DIP_ERROR_RANGE, "attachments.colour_store");
    // A pass with samples is merged, and merged passes have no readback.
    DipSampleValue values[DIP_READBACK_STRIDE];
    const DipSampleReadback readback = {{0, 0, 1, 1}, values};
    pass = good;
    pass.attachments.depth = NULL;
    pass.readback = &readback;
    assert_refused(&pass, DIP_ERROR_CONFLICT, "readback");
    // Draws need fragment shaders even if the target has no pixels.
    DipMesh *mesh;
    DipDraw draw = draw_left_of(9.0f, 0.5f, &black, NULL, &mesh);
    draw.fragment_shader = NULL;
    pass = good;
    pass.attachments.keep_target = true;
    pass.target.rgba8 = NULL;
    pass.draws = &draw;
    pass.draw_count = 1;
    assert_refused(&pass, DIP_ERROR_MISSING, "draws[0].fragment_shader");
    dip_mesh_destroy(&mesh);
    end_drawn(&drawn);
}

// Two passes that are drawn at once have no order, so they may not share samples.
static void passes_at_once_share_no_samples(void **state) {
    (void)state;
    static Drawn drawn[2];
    DipPass passes[2];
    DipPassWork works[2];
    for (int i = 0; i < 2; i++) {
        begin_drawn(&drawn[i], MODEL_WIDTH, MODEL_HEIGHT, 4, DIP_FORMAT_SRGB8);
        passes[i] = pass_of(&four_samples, &drawn[i]);
        works[i] = (DipPassWork){pipelines[i], &passes[i], NULL, NULL, NULL};
    }
    DipError err = {0};
    assert_true(dip_pipeline_draw_passes(works, 2, false, &err));
    passes[1].attachments.samples = passes[0].attachments.samples;
    assert_false(dip_pipeline_draw_passes(works, 2, false, &err));
    assert_int_equal(err.code, DIP_ERROR_CONFLICT);
    assert_string_equal(err.key, "attachments.samples");
    end_drawn(&drawn[0]);
    end_drawn(&drawn[1]);
}

static void samples_of_wrong_sizes_are_not_made(void **state) {
    (void)state;
    static const struct {
        int width, height, sample_count, format;
        const char *key;
    } wrong[] = {
        {0, 9, 4, 0, "size"},          {9, DIP_MAX_TARGET_SIZE + 1, 4, 0, "size"},
        {9, 9, 0, 0, "sample_count"},  {9, 9, 3, 0, "sample_count"},
        {9, 9, 10, 0, "sample_count"}, {9, 9, 4, DIP_FORMAT_COUNT, "format"},
        {9, 9, 4, -1, "format"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        DipError err = {0};
        assert_null(dip_samples_create(wrong[i].width, wrong[i].height, wrong[i].sample_count,
                                       (DipFormat)wrong[i].format, &err));
        assert_int_equal(err.code, DIP_ERROR_RANGE);
        assert_string_equal(err.key, wrong[i].key);
    }
}

int main(int argc, char **argv) {
    if (argc == 3 && strcmp(argv[1], "--lists") == 0) {
        list_total = atoi(argv[2]);
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(passes_of_a_cut_list_have_the_bits_of_one_pass),
        cmocka_unit_test(samples_are_those_of_the_model),
        cmocka_unit_test(blending_behind_an_edge_leaves_no_halo),
        cmocka_unit_test(new_samples_are_zero),
        cmocka_unit_test(means_are_stored_when_a_pass_asks),
        cmocka_unit_test(reverted_attachments_are_what_they_were),
        cmocka_unit_test(a_target_that_is_kept_may_be_read),
        cmocka_unit_test(a_callers_format_needs_no_loads),
        cmocka_unit_test(wrong_samples_are_refused),
        cmocka_unit_test(passes_at_once_share_no_samples),
        cmocka_unit_test(samples_of_wrong_sizes_are_not_made),
    };
    return cmocka_run_group_tests(tests, open_pipelines, close_pipelines);
}
