// Tests that the pipeline refuses passes that it cannot draw, even in release builds. The error
// must name the field at fault. Also tests that passes drawn in one call have the same results as
// passes drawn one by one.
#include "renderer/pipeline/pipeline.h"
#include "renderer/catalogue/random.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
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
    {"draws.mesh", DIP_ERROR_MISSING, no_mesh},
    {"draws.vertex_shader", DIP_ERROR_MISSING, no_vertex_shader},
    {"draws.fragment_shader", DIP_ERROR_MISSING, no_fragment_shader},
    {"draws.varying_count", DIP_ERROR_RANGE, too_many_varyings},
    {"draws.clip_varying_count", DIP_ERROR_RANGE, too_many_clip_varyings},
    {"draws.value_only_varying_count", DIP_ERROR_RANGE, too_many_value_only_varyings},
    {"draws.cull", DIP_ERROR_RANGE, unknown_cull},
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
                works[i] = (DipPassWork){stage->pipelines[i], &together[i], &found[i], &times[i]};
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
    const DipPassWork works[2] = {{stage->pipelines[0], &pass, &counters, &times},
                                  {stage->pipelines[0], &pass, &counters, &times}};
    assert_false(dip_pipeline_draw_passes(works, 2, false, &err));
    assert_int_equal(err.code, DIP_ERROR_CONFLICT);
    assert_string_equal(err.key, "pipeline");
    assert_false(dip_pipeline_draw_passes(works, 0, false, &err));
    assert_false(dip_pipeline_draw_passes(works, PASSES + 1, false, &err));
    assert_string_equal(err.key, "count");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bad_passes_are_refused_with_the_field_at_fault),
        cmocka_unit_test(a_good_pass_is_drawn),
        cmocka_unit_test(passes_drawn_at_once_equal_passes_drawn_alone),
        cmocka_unit_test(passes_that_cannot_be_drawn_at_once_are_refused),
    };
    return cmocka_run_group_tests(tests, open_stage, close_stage);
}
