// Tests that the pipeline refuses passes that it cannot draw, even in release builds. The error
// must name the field at fault. Also tests that passes drawn in one call have the same results as
// passes drawn one by one, that shaders cannot read or show what is undefined, and that threads may
// share a pool.
#include "renderer/pipeline/pipeline.h"
#include "renderer/catalogue/random.h"

#include <math.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 100, HEIGHT = 70, PASSES = DIP_MAX_PASSES_AT_ONCE, SMALL = 2000 };

static uint8_t pictures[2][PASSES][WIDTH * HEIGHT * 4];

typedef struct Stage {
    DipPool *pool;
    DipMesh *mesh;
    DipPipeline *pipelines[PASSES];
    DipDraw draw;
} Stage;

static void copy_vertices(const DipVertexBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        for (int c = 0; c < 3; c++) {
            batch->clip[c][i] = batch->in[c][i];
        }
        batch->clip[3][i] = 1.0f;
        batch->varying[0][i] = batch->in[0][i];
    }
}

static void show_varying(DipFragmentBatch *batch) {
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

static int open_stage(void **state) {
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

static int close_stage(void **state) {
    Stage *stage = *state;
    for (int i = 0; i < PASSES; i++) {
        dip_pipeline_destroy(&stage->pipelines[i]);
    }
    dip_mesh_destroy(&stage->mesh);
    dip_pool_destroy(&stage->pool);
    return 0;
}

static DipPass good_pass(const Stage *stage, int index) {
    return (DipPass){.draws = &stage->draw,
                     .draw_count = 1,
                     .sample_count = 4,
                     .target = {.rgba8 = pictures[0][index],
                                .stride_bytes = (size_t)WIDTH * 4,
                                .width = WIDTH,
                                .height = HEIGHT}};
}

// A pass with one fault, and the error that the pipeline must report.
typedef struct BadPass {
    const char *field;
    DipErrorCode code;
    void (*spoil)(DipPass *pass, DipDraw *draw);
} BadPass;

#define SPOIL(name, statement)                                                                     \
    static void name(DipPass *pass, DipDraw *draw) {                                               \
        (void)pass;                                                                                \
        (void)draw;                                                                                \
        statement;                                                                                 \
    }
SPOIL(no_pixels, pass->target.rgba8 = NULL)
SPOIL(unaligned_pixels, pass->target.rgba8 += 1)
SPOIL(short_stride, pass->target.stride_bytes = WIDTH * 4 - 4)
SPOIL(odd_stride, pass->target.stride_bytes = WIDTH * 4 + 2)
SPOIL(other_width, pass->target.width = WIDTH + 1)
SPOIL(other_height, pass->target.height = HEIGHT - 1)
SPOIL(region_outside, (pass->region = (DipTargetRegion){0, 0, WIDTH + 1, 8}))
SPOIL(region_negative, (pass->region = (DipTargetRegion){-1, 0, 8, 8}))
SPOIL(region_reversed, (pass->region = (DipTargetRegion){9, 0, 8, 8}))
SPOIL(three_samples, pass->sample_count = 3)
SPOIL(no_samples, pass->sample_count = 0)
SPOIL(unknown_pattern, pass->pattern = DIP_PATTERN_KINDS)
SPOIL(uneven_groups, pass->samples_per_group = 3)
SPOIL(too_many_planes, pass->clip_plane_count = DIP_MAX_CLIP_PLANES + 1)
SPOIL(negative_draws, pass->draw_count = -1)
SPOIL(no_draws, pass->draws = NULL)
SPOIL(no_mesh, draw->mesh = NULL)
SPOIL(no_vertex_shader, draw->vertex_shader = NULL)
SPOIL(no_fragment_shader, draw->fragment_shader = NULL)
SPOIL(too_many_varyings, draw->varying_count = DIP_MAX_VARYINGS + 1)
SPOIL(too_many_clip_varyings, draw->clip_varying_count = 2)
SPOIL(too_many_value_only_varyings, draw->value_only_varying_count = 2)
SPOIL(unknown_cull, draw->cull = (DipCull)7)
SPOIL(too_many_computed_varyings, draw->computed_varying_count = DIP_MAX_VARYINGS)
SPOIL(undefined_clear, pass->clear_lin[1] = NAN)

static DipSampleValue read_samples[2 * DIP_READBACK_STRIDE];
static const DipSampleReadback good_readback = {{0, 0, 2, 1}, read_samples};
static const DipSampleReadback empty_readback = {{0, 0, 0, 0}, read_samples};
static const DipSampleReadback readback_outside = {{0, -1, 1, 1}, read_samples};
static const DipSampleReadback nowhere_readback = {{0, 0, 2, 1}, NULL};
SPOIL(readback_of_nothing, pass->readback = &empty_readback)
SPOIL(readback_beyond, pass->readback = &readback_outside)
SPOIL(readback_without_memory, pass->readback = &nowhere_readback)
SPOIL(merged_readback,
      (pass->readback = &good_readback, pass->scissor = (DipTargetRegion){0, 0, 8, 8}))

static const BadPass bad_passes[] = {
    {"target.rgba8", DIP_ERROR_MISSING, no_pixels},
    {"target.rgba8", DIP_ERROR_RANGE, unaligned_pixels},
    {"target.stride_bytes", DIP_ERROR_RANGE, short_stride},
    {"target.stride_bytes", DIP_ERROR_RANGE, odd_stride},
    {"target.width", DIP_ERROR_CONFLICT, other_width},
    {"target.width", DIP_ERROR_CONFLICT, other_height},
    {"region", DIP_ERROR_RANGE, region_outside},
    {"region", DIP_ERROR_RANGE, region_negative},
    {"region", DIP_ERROR_RANGE, region_reversed},
    {"sample_count", DIP_ERROR_RANGE, three_samples},
    {"sample_count", DIP_ERROR_RANGE, no_samples},
    {"pattern", DIP_ERROR_RANGE, unknown_pattern},
    {"samples_per_group", DIP_ERROR_CONFLICT, uneven_groups},
    {"clip_plane_count", DIP_ERROR_RANGE, too_many_planes},
    {"readback.region", DIP_ERROR_RANGE, readback_of_nothing},
    {"readback.region", DIP_ERROR_RANGE, readback_beyond},
    {"readback.samples", DIP_ERROR_MISSING, readback_without_memory},
    {"readback", DIP_ERROR_CONFLICT, merged_readback},
    {"draw_count", DIP_ERROR_RANGE, negative_draws},
    {"draws", DIP_ERROR_MISSING, no_draws},
    {"draws[0].mesh", DIP_ERROR_MISSING, no_mesh},
    {"draws[0].vertex_shader", DIP_ERROR_MISSING, no_vertex_shader},
    {"draws[0].fragment_shader", DIP_ERROR_MISSING, no_fragment_shader},
    {"draws[0].varying_count", DIP_ERROR_RANGE, too_many_varyings},
    {"draws[0].clip_varying_count", DIP_ERROR_RANGE, too_many_clip_varyings},
    {"draws[0].value_only_varying_count", DIP_ERROR_RANGE, too_many_value_only_varyings},
    {"draws[0].cull", DIP_ERROR_RANGE, unknown_cull},
    {"draws[0].computed_varying_count", DIP_ERROR_RANGE, too_many_computed_varyings},
    {"clear_lin", DIP_ERROR_RANGE, undefined_clear},
};

static void bad_passes_are_refused_with_the_field_at_fault(void **state) {
    const Stage *stage = *state;
    for (size_t i = 0; i < sizeof bad_passes / sizeof *bad_passes; i++) {
        DipDraw draw = stage->draw;
        DipPass pass = good_pass(stage, 0);
        DipPipelineCounters counters = {0};
        DipStageTimes times = {0};
        DipError err = {0};
        pass.draws = &draw;
        bad_passes[i].spoil(&pass, &draw);
        memset(pictures[0][0], 77, sizeof pictures[0][0]);
        assert_false(dip_pipeline_draw(stage->pipelines[0], &pass, &counters, &times, &err));
        assert_string_equal(err.key, bad_passes[i].field);
        assert_int_equal(err.code, bad_passes[i].code);
        assert_int_equal(counters.passes, 0);
        for (size_t b = 0; b < sizeof pictures[0][0]; b++) {
            assert_int_equal(pictures[0][0][b], 77);
        }
    }
}

static void a_good_pass_is_drawn(void **state) {
    const Stage *stage = *state;
    const DipPass pass = good_pass(stage, 0);
    DipPipelineCounters counters = {0};
    DipStageTimes times = {0};
    assert_true(dip_pipeline_draw(stage->pipelines[0], &pass, &counters, &times, NULL));
    assert_int_equal(counters.passes, 1);
    assert_true(counters.fragments_shaded > 1000);
    assert_int_equal(counters.shader_counts[1], counters.fragments_shaded);
    assert_int_equal(counters.shader_counts[0], 0);
}

// Makes PASSES passes that differ in their samples, patterns, clear colours and targets.
static void make_passes(const Stage *stage, int which, DipPass passes[PASSES]) {
    static const int samples[PASSES] = {1, 2, 4, 6, 8, 4, 8, 1};
    for (int i = 0; i < PASSES; i++) {
        passes[i] = good_pass(stage, i);
        passes[i].sample_count = samples[i];
        passes[i].pattern = (DipPatternKind)(i % DIP_PATTERN_KINDS);
        passes[i].clear_lin[0] = 0.1f * (float)i;
        passes[i].target.rgba8 = pictures[which][i];
    }
}

static void passes_drawn_at_once_equal_passes_drawn_alone(void **state) {
    const Stage *stage = *state;
    DipPass alone[PASSES];
    DipPass together[PASSES];
    DipPipelineCounters expected[PASSES];
    DipStageTimes times[PASSES];
    make_passes(stage, 0, alone);
    make_passes(stage, 1, together);
    memset(expected, 0, sizeof expected);
    for (int i = 0; i < PASSES; i++) {
        assert_true(
            dip_pipeline_draw(stage->pipelines[i], &alone[i], &expected[i], &times[i], NULL));
    }
    for (int count = 1; count <= PASSES; count++) {
        for (int same = 0; same < 2; same++) {
            DipPassWork works[PASSES];
            DipPipelineCounters found[PASSES];
            memset(found, 0, sizeof found);
            memset(pictures[1], 77, sizeof pictures[1]);
            for (int i = 0; i < count; i++) {
                works[i] =
                    (DipPassWork){stage->pipelines[i], &together[i], &found[i], &times[i], NULL};
            }
            assert_true(dip_pipeline_draw_passes(works, count, same, NULL));
            for (int i = 0; i < count; i++) {
                assert_memory_equal(pictures[0][i], pictures[1][i], sizeof pictures[0][i]);
                assert_int_equal(found[i].fragments_shaded, expected[i].fragments_shaded);
                assert_int_equal(found[i].samples_shown, expected[i].samples_shown);
            }
        }
    }
}

static void passes_that_cannot_be_drawn_at_once_are_refused(void **state) {
    const Stage *stage = *state;
    DipPass pass = good_pass(stage, 0);
    DipPipelineCounters counters = {0};
    DipStageTimes times = {0};
    DipError err = {0};
    const DipPassWork works[2] = {{stage->pipelines[0], &pass, &counters, &times, NULL},
                                  {stage->pipelines[0], &pass, &counters, &times, NULL}};
    assert_false(dip_pipeline_draw_passes(works, 2, false, &err));
    assert_int_equal(err.code, DIP_ERROR_CONFLICT);
    assert_string_equal(err.key, "pipeline");
    assert_false(dip_pipeline_draw_passes(works, 0, false, &err));
    assert_false(dip_pipeline_draw_passes(works, PASSES + 1, false, &err));
    assert_string_equal(err.key, "count");
}

// Two passes that are drawn at once have no order, so they may share depths only if both leave them
// as they are.
static void passes_at_once_share_no_depths_that_change(void **state) {
    const Stage *stage = *state;
    static const struct {
        DipStore depth, stencil;
        bool accepted;
    } cases[] = {
        {DIP_STORE_REVERT, DIP_STORE_REVERT, true},   {DIP_STORE_KEEP, DIP_STORE_REVERT, false},
        {DIP_STORE_REVERT, DIP_STORE_KEEP, false},    {DIP_STORE_DISCARD, DIP_STORE_REVERT, false},
        {DIP_STORE_REVERT, DIP_STORE_DISCARD, false},
    };
    DipDepth *depths[2];
    DipPass passes[2];
    DipPassWork works[2];
    for (int i = 0; i < 2; i++) {
        depths[i] = dip_depth_create(WIDTH, HEIGHT, 4, NULL);
        passes[i] = good_pass(stage, i);
        passes[i].attachments.depth = depths[i];
        works[i] = (DipPassWork){.pipeline = stage->pipelines[i], .pass = &passes[i]};
    }
    assert_true(dip_pipeline_draw_passes(works, 2, false, NULL));
    passes[0].attachments.depth = depths[1];
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        for (int changing = 0; changing < 2; changing++) {
            DipError err = {.code = DIP_ERROR_NONE};
            passes[changing].attachments.depth_store = cases[c].depth;
            passes[changing].attachments.stencil_store = cases[c].stencil;
            passes[!changing].attachments.depth_store = DIP_STORE_REVERT;
            passes[!changing].attachments.stencil_store = DIP_STORE_REVERT;
            assert_int_equal(dip_pipeline_draw_passes(works, 2, false, &err), cases[c].accepted);
            assert_int_equal(err.code, cases[c].accepted ? DIP_ERROR_NONE : DIP_ERROR_CONFLICT);
            assert_string_equal(err.key, cases[c].accepted ? "" : "attachments.depth");
        }
    }
    dip_depth_destroy(&depths[0]);
    dip_depth_destroy(&depths[1]);
}

// Draws all passes at once. The even ones copy from the pass `from`, unless it is NONE.
enum { NONE = -1 };
static void draw_copying(const Stage *stage, const DipPass passes[PASSES], int from,
                         DipPipelineCounters counters[PASSES]) {
    DipPassWork works[PASSES];
    memset(counters, 0, PASSES * sizeof *counters);
    for (int i = 0; i < PASSES; i++) {
        const bool copies = from != NONE && i != from && i % 2 == 0;
        works[i] = (DipPassWork){stage->pipelines[i], &passes[i], &counters[i], NULL,
                                 copies ? &works[from] : NULL};
    }
    assert_true(dip_pipeline_draw_passes(works, PASSES, true, NULL));
}

static void passes_that_copy_pixels_equal_passes_that_shade_them(void **state) {
    const Stage *stage = *state;
    DipPass shading[PASSES];
    DipPass copying[PASSES];
    DipPipelineCounters expected[PASSES];
    DipPipelineCounters found[PASSES];
    make_passes(stage, 0, shading);
    make_passes(stage, 1, copying);
    draw_copying(stage, shading, NONE, expected);
    for (int from = 1; from < PASSES; from += 2) {
        memset(pictures[1], 77, sizeof pictures[1]);
        draw_copying(stage, copying, from, found);
        for (int i = 0; i < PASSES; i++) {
            assert_memory_equal(pictures[0][i], pictures[1][i], sizeof pictures[0][i]);
            assert_int_equal(found[i].fragments_copied > 0, i % 2 == 0);
            assert_int_equal(found[i].fragments_shaded + found[i].fragments_copied,
                             expected[i].fragments_shaded);
            assert_int_equal(found[i].shader_counts[1], found[i].fragments_shaded);
        }
    }
}

// The fragment shader of a draw whose colours differ from pass to pass.
static void show_uniform(DipFragmentBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        batch->colour[0][i] = *(const float *)batch->uniforms;
    }
}

static void draws_with_own_shading_are_never_copied(void **state) {
    const Stage *stage = *state;
    static const float light[2] = {0.25f, 0.5f};
    for (int who = 0; who < 2; who++) { // either of the two passes may say it
        DipDraw draws[2] = {stage->draw, stage->draw};
        DipPass passes[2];
        DipPassWork works[2];
        DipPipelineCounters counters[2];
        memset(counters, 0, sizeof counters);
        for (int i = 0; i < 2; i++) {
            draws[i].fragment_shader = show_uniform;
            draws[i].uniforms = &light[i];
            draws[i].own_shading = i == who;
            passes[i] = good_pass(stage, i);
            passes[i].draws = &draws[i];
            works[i] = (DipPassWork){stage->pipelines[i], &passes[i], &counters[i], NULL,
                                     i ? &works[0] : NULL};
        }
        assert_true(dip_pipeline_draw_passes(works, 2, true, NULL));
        assert_int_equal(counters[1].fragments_copied, 0);
        assert_int_equal(counters[1].fragments_shaded, counters[0].fragments_shaded);
        const size_t centre = 4 * (HEIGHT / 2 * WIDTH + WIDTH / 2);
        assert_true(pictures[0][0][centre] < pictures[0][1][centre]);
    }
}

static void works_that_cannot_be_copied_from_are_refused(void **state) {
    const Stage *stage = *state;
    const DipPass passes[2] = {good_pass(stage, 0), good_pass(stage, 1)};
    DipPassWork elsewhere = {.pipeline = stage->pipelines[0], .pass = &passes[0]};
    DipPassWork works[2] = {{.pipeline = stage->pipelines[0], .pass = &passes[0]},
                            {.pipeline = stage->pipelines[1], .pass = &passes[1]}};
    DipError err = {0};
    works[1].copies_from = &elsewhere;
    assert_false(dip_pipeline_draw_passes(works, 2, true, &err));
    assert_int_equal(err.code, DIP_ERROR_CONFLICT);
    assert_string_equal(err.key, "copies_from");
    works[1].copies_from = &works[1];
    assert_false(dip_pipeline_draw_passes(works, 2, true, NULL));
    works[1].copies_from = &works[0];
    assert_false(dip_pipeline_draw_passes(works, 2, false, NULL));
    works[0].copies_from = &works[1];
    assert_false(dip_pipeline_draw_passes(works, 2, true, NULL));
    works[0].copies_from = NULL;
    assert_true(dip_pipeline_draw_passes(works, 2, true, NULL));
}

static void the_fault_of_one_draw_of_many_names_its_index(void **state) {
    enum { MANY = 10000, WRONG = 4711 };
    const Stage *stage = *state;
    DipDraw *draws = malloc(MANY * sizeof *draws);
    for (int d = 0; d < MANY; d++) {
        draws[d] = stage->draw;
    }
    draws[WRONG].mesh = NULL;
    DipPass pass = good_pass(stage, 0);
    pass.draws = draws;
    pass.draw_count = MANY;
    DipError err = {0};
    assert_false(dip_pipeline_draw(stage->pipelines[0], &pass, NULL, NULL, &err));
    assert_string_equal(err.key, "draws[4711].mesh");
    assert_false(dip_pipeline_draw(stage->pipelines[0], &pass, NULL, NULL, NULL));
    free(draws);
}

static void missing_pointers_are_refused_or_have_a_meaning(void **state) {
    const Stage *stage = *state;
    const DipPass pass = good_pass(stage, 0);
    DipError err = {0};
    assert_false(dip_pipeline_draw(NULL, &pass, NULL, NULL, &err));
    assert_string_equal(err.key, "pipeline");
    assert_false(dip_pipeline_draw(stage->pipelines[0], NULL, NULL, NULL, &err));
    assert_string_equal(err.key, "pass");
    assert_false(dip_pipeline_draw_passes(NULL, 1, false, &err));
    assert_string_equal(err.key, "works");
    assert_false(dip_pipeline_reserve(NULL, &pass, &err));
    assert_string_equal(err.key, "pipeline");
    assert_false(dip_pipeline_reserve(stage->pipelines[0], NULL, &err));
    assert_string_equal(err.key, "pass");
    assert_null(dip_mesh_create(NULL, &err));
    assert_string_equal(err.key, "mesh");
    assert_null(dip_texture_create(NULL, &err));
    assert_string_equal(err.key, "texture");
    assert_null(dip_texture_create_from_levels(NULL, 1, &err));
    assert_string_equal(err.key, "texture");
    // Without counters, times or a pool, a pass is drawn all the same.
    assert_true(dip_pipeline_draw(stage->pipelines[0], &pass, NULL, NULL, &err));
    DipPipeline *alone = dip_pipeline_create(NULL, dip_isa_best(), WIDTH, HEIGHT, &err);
    assert_non_null(alone);
    DipPass again = pass;
    again.target.rgba8 = pictures[1][0];
    assert_true(dip_pipeline_draw(alone, &again, NULL, NULL, &err));
    assert_memory_equal(pictures[0][0], pictures[1][0], sizeof pictures[0][0]);
    dip_pipeline_destroy(&alone);
}

// --- what shaders read ---------------------------------------------------------------------------

// What the shader of this test reads.
typedef struct Reading {
    int u_varying;
    const DipTarget *target;    // NULL: it reads a texture
    const DipShadowMap *shadow; // NULL: it reads a texture
} Reading;

static void read_as_told(DipFragmentBatch *batch) {
    const Reading *reading = batch->uniforms;
    if (reading->target) {
        batch->sample_target(batch, reading->target, batch->x, batch->y, batch->colour);
    } else if (reading->shadow) {
        batch->sample_shadow(batch, reading->shadow, batch->x, batch->y, batch->y,
                             batch->colour[0]);
    } else {
        batch->sample_colour(batch, &batch->samplers[1], reading->u_varying, batch->colour);
    }
}

static void three_varyings(const DipVertexBatch *batch) {
    copy_vertices(batch);
    for (int i = 0; i < batch->count; i++) {
        batch->varying[1][i] = batch->in[1][i];
        batch->varying[2][i] = batch->in[2][i];
    }
}

// A reading with one fault, and the error that the pipeline must report.
typedef struct BadReading {
    const char *field;
    DipErrorCode code;
    void (*spoil)(DipPass *pass, DipDraw *draw, DipSampler *sampler, Reading *reading);
} BadReading;

#define MISREAD(name, statement)                                                                   \
    static void name(DipPass *pass, DipDraw *draw, DipSampler *sampler, Reading *reading) {        \
        (void)pass;                                                                                \
        (void)draw;                                                                                \
        (void)sampler;                                                                             \
        (void)reading;                                                                             \
        statement;                                                                                 \
    }
static const DipTarget other_format = {.rgba8 = pictures[1][0],
                                       .stride_bytes = WIDTH * 4,
                                       .width = WIDTH,
                                       .height = HEIGHT,
                                       .format = DIP_FORMAT_LINEAR8};
static const DipTarget no_memory = {.stride_bytes = WIDTH * 4, .width = WIDTH, .height = HEIGHT};
static const DipTarget no_rows = {
    .rgba8 = pictures[1][0], .stride_bytes = WIDTH * 4, .width = WIDTH};
static const DipTarget own_rows = {
    .rgba8 = pictures[0][0] + WIDTH * 8, .stride_bytes = WIDTH * 4, .width = WIDTH, .height = 1};
static const DipShadowMap no_depths;
MISREAD(values_only, draw->value_only_varying_count = 2)
MISREAD(beyond, reading->u_varying = 2)
MISREAD(far_beyond, reading->u_varying = INT32_MAX)
MISREAD(negative, reading->u_varying = -1)
MISREAD(no_samplers, draw->samplers = NULL)
MISREAD(no_texture, sampler->texture = NULL)
MISREAD(much_anisotropy, sampler->max_anisotropy = 17)
MISREAD(negative_anisotropy, sampler->max_anisotropy = -1)
MISREAD(unknown_filter, sampler->filter = DIP_FILTER_COUNT)
MISREAD(negative_level, sampler->min_lod8 = -256)
MISREAD(great_bias, sampler->bias_lod8 = INT32_MIN)
MISREAD(no_such_level, (sampler->shown = sampler->texture, sampler->shown_level[0] = 9))
MISREAD(linear_target, reading->target = &other_format)
MISREAD(target_without_pixels, reading->target = &no_memory)
MISREAD(target_without_rows, reading->target = &no_rows)
MISREAD(own_target, reading->target = &own_rows)
MISREAD(shadow_of_nothing, reading->shadow = &no_depths)

static const BadReading bad_readings[] = {
    {"value_only_varying_count", DIP_ERROR_CONFLICT, values_only},
    {"varying_count", DIP_ERROR_RANGE, beyond},
    {"varying_count", DIP_ERROR_RANGE, far_beyond},
    {"varying_count", DIP_ERROR_RANGE, negative},
    {"samplers", DIP_ERROR_MISSING, no_samplers},
    {"samplers", DIP_ERROR_MISSING, no_texture},
    {"samplers", DIP_ERROR_RANGE, much_anisotropy},
    {"samplers", DIP_ERROR_RANGE, negative_anisotropy},
    {"samplers", DIP_ERROR_RANGE, unknown_filter},
    {"samplers", DIP_ERROR_RANGE, negative_level},
    {"samplers", DIP_ERROR_RANGE, great_bias},
    {"samplers", DIP_ERROR_RANGE, no_such_level},
    {"sample_target", DIP_ERROR_CONFLICT, linear_target},
    {"sample_target", DIP_ERROR_CONFLICT, target_without_pixels},
    {"sample_target", DIP_ERROR_RANGE, target_without_rows},
    {"sample_target", DIP_ERROR_CONFLICT, own_target},
    {"sample_shadow", DIP_ERROR_MISSING, shadow_of_nothing},
};

// Draws with a shader that reads sampler 1 at the varyings 1 and 2, or with a fault. bad: or NULL.
static bool draw_reading(const Stage *stage, const BadReading *bad, int samples, DipError *err) {
    static const uint8_t texel[4] = {255, 255, 255, 255};
    const DipTextureDef def = {.name = "white", .width = 1, .height = 1, .rgba8 = texel};
    DipTexture *texture = dip_texture_create(&def, NULL);
    DipSampler samplers[2] = {{.texture = NULL}, {.texture = texture}};
    Reading reading = {.u_varying = 1};
    DipDraw draw = stage->draw;
    draw.vertex_shader = three_varyings;
    draw.fragment_shader = read_as_told;
    draw.varying_count = 3;
    draw.samplers = samplers;
    draw.uniforms = &reading;
    DipPass pass = good_pass(stage, 0);
    pass.draws = &draw;
    pass.sample_count = samples;
    if (bad) {
        bad->spoil(&pass, &draw, &samplers[1], &reading);
    }
    const bool drawn = dip_pipeline_draw(stage->pipelines[0], &pass, NULL, NULL, err);
    dip_texture_destroy(&texture);
    return drawn;
}

static void read_last_sampler(DipFragmentBatch *batch) {
    batch->sample_colour(batch, &batch->samplers[DIP_MAX_SAMPLERS - 1], 0, batch->colour);
}

static void the_last_sampler_can_be_read(void **state) {
    const Stage *stage = *state;
    static const uint8_t texel[4] = {10, 200, 30, 255};
    const DipTextureDef def = {.name = "green", .width = 1, .height = 1, .rgba8 = texel};
    DipTexture *texture = dip_texture_create(&def, NULL);
    DipSampler samplers[DIP_MAX_SAMPLERS] = {[DIP_MAX_SAMPLERS - 1] = {.texture = texture}};
    DipDraw draw = stage->draw;
    draw.vertex_shader = three_varyings;
    draw.fragment_shader = read_last_sampler;
    draw.varying_count = 2;
    draw.samplers = samplers;
    DipPass pass = good_pass(stage, 0);
    pass.draws = &draw;
    pass.sample_count = 1;
    assert_true(dip_pipeline_draw(stage->pipelines[0], &pass, NULL, NULL, NULL));
    const uint8_t *middle = pictures[0][0] + (HEIGHT / 2 * WIDTH + WIDTH / 2) * 4;
    assert_memory_equal(middle, texel, sizeof texel);
    dip_texture_destroy(&texture);
}

static void readings_that_are_not_allowed_are_refused_by_name(void **state) {
    const Stage *stage = *state;
    assert_true(draw_reading(stage, NULL, 4, NULL)); // max_anisotropy is 0, which means 1
    for (size_t i = 0; i < sizeof bad_readings / sizeof *bad_readings; i++) {
        DipError err = {0};
        char key[64];
        snprintf(key, sizeof key, "draws[0].%s", bad_readings[i].field);
        assert_false(draw_reading(stage, &bad_readings[i], i % 2 ? 4 : 1, &err));
        assert_string_equal(err.key, key);
        assert_int_equal(err.code, bad_readings[i].code);
    }
    assert_true(draw_reading(stage, NULL, 4, NULL)); // the pipeline still works
}

// Draws two passes at once. The shader of the second one reads what `reading` names.
static bool draw_beside(const Stage *stage, const DipPass *drawing, Reading *reading,
                        DipError *err) {
    DipDraw draw = stage->draw;
    draw.fragment_shader = read_as_told;
    draw.uniforms = reading;
    DipPass pass = good_pass(stage, 1);
    pass.draws = &draw;
    const DipPassWork works[2] = {{stage->pipelines[0], drawing, NULL, NULL, NULL},
                                  {stage->pipelines[1], &pass, NULL, NULL, NULL}};
    return dip_pipeline_draw_passes(works, 2, false, err);
}

// Passes that are drawn at once have no order, so none may read what another one draws.
static void a_pass_reads_nothing_that_is_drawn_at_once(void **state) {
    const Stage *stage = *state;
    DipPass drawing = good_pass(stage, 0);
    DipError err = {0};
    assert_false(draw_beside(stage, &drawing, &(Reading){.target = &drawing.target}, &err));
    assert_int_equal(err.code, DIP_ERROR_CONFLICT);
    assert_string_equal(err.key, "draws[0].sample_target");
    assert_non_null(strstr(err.message, "at once"));
    DipDepth *depth = dip_depth_create(WIDTH, HEIGHT, 1, NULL);
    const DipShadowMap map = {.depth = depth};
    drawing.attachments.depth = depth;
    drawing.sample_count = 1;
    assert_false(draw_beside(stage, &drawing, &(Reading){.shadow = &map}, &err));
    assert_string_equal(err.key, "draws[0].sample_shadow");
    drawing.attachments.depth = NULL;
    assert_true(draw_beside(stage, &drawing, &(Reading){.shadow = &map}, &err));
    dip_depth_destroy(&depth);
}

// A target that lies beside the drawn one in a larger picture shares no bytes with it, and may be
// read. One column further to the left, or to the right and so in the next row, it does.
static void a_pass_reads_targets_beside_the_drawn_one(void **state) {
    enum { STRIDE = 3 * WIDTH * 4, COLUMNS = 5, ROWS = 4 };
    static uint8_t picture[(HEIGHT + ROWS) * STRIDE];
    static const struct {
        int column, row;
        bool beside;
    } cases[] = {{WIDTH, 0, true},
                 {WIDTH - 1, 0, false},
                 {WIDTH, ROWS, true},
                 {WIDTH - 1, ROWS, false},
                 {3 * WIDTH - COLUMNS, 0, true},
                 {3 * WIDTH - COLUMNS + 1, 0, false}};
    const Stage *stage = *state;
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        DipPass drawing = good_pass(stage, 0);
        drawing.target.rgba8 = picture;
        drawing.target.stride_bytes = STRIDE;
        const DipTarget read = {.rgba8 = picture + cases[c].row * STRIDE + cases[c].column * 4,
                                .stride_bytes = STRIDE,
                                .width = COLUMNS,
                                .height = ROWS};
        assert_int_equal(draw_beside(stage, &drawing, &(Reading){.target = &read}, NULL),
                         cases[c].beside);
        // The same with the read target before the drawn one.
        const DipTarget first = {
            .rgba8 = picture, .stride_bytes = STRIDE, .width = COLUMNS, .height = ROWS};
        drawing.target.rgba8 = picture + (COLUMNS - !cases[c].beside) * 4;
        assert_int_equal(draw_beside(stage, &drawing, &(Reading){.target = &first}, NULL),
                         cases[c].beside);
    }
}

// --- what shaders leave unset --------------------------------------------------------------------

static void leave_unset(DipFragmentBatch *batch) {
    (void)batch;
}

static void leave_vertices_unset(const DipVertexBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        for (int c = 0; c < 3; c++) {
            batch->clip[c][i] = batch->in[c][i] + batch->in[c + 3][i]; // the mesh has 3 attributes
        }
        batch->clip[3][i] = 1.0f;
    }
}

static void show_last_varying(DipFragmentBatch *batch) {
    const int last = DIP_MAX_VARYINGS - 1;
    for (int i = 0; i < batch->count; i++) {
        batch->colour[0][i] = batch->varying[last][i] + batch->varying_dx[0][i];
        batch->colour[1][i] = batch->varying[0][i];
        batch->colour[2][i] = batch->varying[1][i];
    }
}

static void write_varyings(const DipVertexBatch *batch, int count) {
    copy_vertices(batch);
    for (int s = 0; s < count; s++) {
        for (int i = 0; i < batch->count; i++) {
            batch->varying[s][i] = 0.2f * (float)(s + 1) + batch->in[0][i];
        }
    }
}

static void write_all(const DipVertexBatch *batch) {
    write_varyings(batch, DIP_MAX_VARYINGS);
}

static void write_first(const DipVertexBatch *batch) {
    write_varyings(batch, 1);
}

// Every array of a pipeline holds numbers of another pass before each of these draws.
static void what_shaders_leave_unset_is_zero(void **state) {
    const Stage *stage = *state;
    const DipDraw unset[3] = {
        {.mesh = stage->mesh, .vertex_shader = copy_vertices, .fragment_shader = leave_unset},
        {.mesh = stage->mesh,
         .vertex_shader = leave_vertices_unset,
         .fragment_shader = show_last_varying,
         .varying_count = 2,
         .value_only_varying_count = 2},
        {.mesh = stage->mesh,
         .vertex_shader = copy_vertices,
         .fragment_shader = show_varying,
         .clip_shader = leave_unset,
         .varying_count = 1}};
    DipDraw full = stage->draw;
    full.vertex_shader = write_all;
    full.varying_count = DIP_MAX_VARYINGS;
    for (int d = 0; d < 3; d++) {
        DipPass pass = good_pass(stage, 0);
        pass.draws = &full;
        assert_true(dip_pipeline_draw(stage->pipelines[0], &pass, NULL, NULL, NULL));
        pass.draws = &unset[d];
        assert_true(dip_pipeline_draw(stage->pipelines[0], &pass, NULL, NULL, NULL));
        for (size_t b = 0; b < sizeof pictures[0][0]; b++) {
            assert_int_equal(pictures[0][0][b], b % 4 == 3 ? 255 : 0);
        }
    }
}

// The alpha that a shader leaves unset is 1: a blended draw without colours is black on white.
static void the_alpha_that_shaders_leave_unset_is_one(void **state) {
    const Stage *stage = *state;
    static const DipDrawState blended = {.blend = DIP_BLEND_MODE_ALPHA};
    static const uint8_t black[4] = {0, 0, 0, 255};
    DipDraw draw = stage->draw;
    draw.fragment_shader = leave_unset;
    draw.state = &blended;
    DipPass pass = good_pass(stage, 0);
    pass.draws = &draw;
    pass.clear_lin[0] = pass.clear_lin[1] = pass.clear_lin[2] = 1.0f;
    assert_true(dip_pipeline_draw(stage->pipelines[0], &pass, NULL, NULL, NULL));
    const uint8_t *middle = pictures[0][0] + (HEIGHT / 2 * WIDTH + WIDTH / 2) * 4;
    assert_memory_equal(middle, black, sizeof black);
    assert_int_equal(pictures[0][0][0], 255); // The corner shows no triangle.
}

// A vertex shader may write varyings that a draw does not have: they change nothing.
static void varyings_that_a_draw_lacks_are_dropped(void **state) {
    const Stage *stage = *state;
    DipDraw draw = stage->draw;
    DipPass passes[2] = {good_pass(stage, 0), good_pass(stage, 1)};
    passes[0].draws = passes[1].draws = &draw;
    draw.vertex_shader = write_first;
    assert_true(dip_pipeline_draw(stage->pipelines[0], &passes[0], NULL, NULL, NULL));
    draw.vertex_shader = write_all;
    assert_true(dip_pipeline_draw(stage->pipelines[0], &passes[1], NULL, NULL, NULL));
    assert_memory_equal(pictures[0][0], pictures[0][1], sizeof pictures[0][0]);
}

// A list of draws with a count of 0 is an empty list: the pass clears its target.
static void a_list_of_no_draws_is_legal(void **state) {
    const Stage *stage = *state;
    DipPass pass = good_pass(stage, 0);
    pass.draw_count = 0;
    pass.clear_lin[1] = 1.0f;
    for (int has_list = 0; has_list < 2; has_list++) {
        pass.draws = has_list ? &(DipDraw){0} : NULL; // a draw that would be refused
        DipPipelineCounters counters = {0};
        memset(pictures[0][0], 77, sizeof pictures[0][0]);
        assert_true(dip_pipeline_draw(stage->pipelines[0], &pass, &counters, NULL, NULL));
        assert_int_equal(counters.passes, 1);
        assert_int_equal(counters.fragments_shaded, 0);
        for (size_t b = 0; b < sizeof pictures[0][0]; b++) {
            assert_int_equal(pictures[0][0][b], b % 4 == 1 || b % 4 == 3 ? 255 : 0);
        }
    }
}

// --- threads -------------------------------------------------------------------------------------

typedef struct Artist {
    const Stage *stage;
    int index;
    bool drew;
} Artist;

static void *draw_many(void *context) {
    Artist *artist = context;
    DipPass pass = good_pass(artist->stage, artist->index);
    artist->drew = true;
    for (int n = 0; n < 40; n++) {
        artist->drew =
            dip_pipeline_draw(artist->stage->pipelines[artist->index], &pass, NULL, NULL, NULL) &&
            artist->drew;
    }
    return NULL;
}

static void threads_may_draw_with_pipelines_of_one_pool(void **state) {
    enum { ARTISTS = 4 };
    const Stage *stage = *state;
    Artist artists[ARTISTS];
    pthread_t threads[ARTISTS];
    memset(pictures, 0, sizeof pictures);
    for (int i = 0; i < ARTISTS; i++) {
        artists[i] = (Artist){stage, i, false};
        assert_int_equal(pthread_create(&threads[i], NULL, draw_many, &artists[i]), 0);
    }
    for (int i = 0; i < ARTISTS; i++) {
        pthread_join(threads[i], NULL);
    }
    DipPass pass = good_pass(stage, ARTISTS);
    assert_true(dip_pipeline_draw(stage->pipelines[0], &pass, NULL, NULL, NULL));
    for (int i = 0; i < ARTISTS; i++) {
        assert_true(artists[i].drew);
        assert_memory_equal(pictures[0][i], pictures[0][ARTISTS], sizeof pictures[0][0]);
    }
}

// A store function that draws with the pipeline that calls it, which must be refused.
static void draw_again(void *context, int x, int y, int count, const float *const colour[4]) {
    (void)y;
    (void)colour;
    const Stage *stage = context;
    const DipPass pass = good_pass(stage, 1);
    DipError err = {0};
    assert_true(x >= 0 && count > 0);
    assert_false(dip_pipeline_draw(stage->pipelines[0], &pass, NULL, NULL, &err));
    assert_string_equal(err.key, "pipeline");
    assert_int_equal(err.code, DIP_ERROR_CONFLICT);
}

static void a_pipeline_that_draws_cannot_be_used(void **state) {
    Stage *stage = *state;
    DipPass pass = good_pass(stage, 0);
    pass.draw_count = 0;
    pass.target.format = DIP_FORMAT_CALLER;
    pass.target.store = draw_again;
    pass.target.context = stage;
    DipPipelineCounters counters = {0};
    assert_true(dip_pipeline_draw(stage->pipelines[0], &pass, &counters, NULL, NULL));
    assert_int_equal(counters.passes, 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_fault_of_one_draw_of_many_names_its_index),
        cmocka_unit_test(missing_pointers_are_refused_or_have_a_meaning),
        cmocka_unit_test(the_last_sampler_can_be_read),
        cmocka_unit_test(readings_that_are_not_allowed_are_refused_by_name),
        cmocka_unit_test(a_pass_reads_nothing_that_is_drawn_at_once),
        cmocka_unit_test(a_pass_reads_targets_beside_the_drawn_one),
        cmocka_unit_test(what_shaders_leave_unset_is_zero),
        cmocka_unit_test(the_alpha_that_shaders_leave_unset_is_one),
        cmocka_unit_test(varyings_that_a_draw_lacks_are_dropped),
        cmocka_unit_test(a_list_of_no_draws_is_legal),
        cmocka_unit_test(threads_may_draw_with_pipelines_of_one_pool),
        cmocka_unit_test(a_pipeline_that_draws_cannot_be_used),
        cmocka_unit_test(bad_passes_are_refused_with_the_field_at_fault),
        cmocka_unit_test(a_good_pass_is_drawn),
        cmocka_unit_test(passes_drawn_at_once_equal_passes_drawn_alone),
        cmocka_unit_test(passes_that_copy_pixels_equal_passes_that_shade_them),
        cmocka_unit_test(draws_with_own_shading_are_never_copied),
        cmocka_unit_test(works_that_cannot_be_copied_from_are_refused),
        cmocka_unit_test(passes_that_cannot_be_drawn_at_once_are_refused),
        cmocka_unit_test(passes_at_once_share_no_depths_that_change),
    };
    return cmocka_run_group_tests(tests, open_stage, close_stage);
}
