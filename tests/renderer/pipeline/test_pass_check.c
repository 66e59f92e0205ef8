// Tests that the pipeline refuses passes that it cannot draw, even in release builds. The error
// must name the field at fault.
#include "pass_stage.h"

#include <limits.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

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
SPOIL(negative_groups, pass->samples_per_group = -2)
SPOIL(very_negative_groups, pass->samples_per_group = INT_MIN)

enum { TILES = 2 * 2 };
static const DipTileRegion uneven_tile[TILES] = {{0, 0, 12, 8}};
static const DipTileRegion large_tile[TILES] = {[TILES - 1] = {0, 0, 72, 64}};
static const DipTileRegion empty_tile[TILES] = {{8, 0, 8, 64}};
SPOIL(uneven_tile_region, pass->tile_regions = uneven_tile)
SPOIL(large_tile_region, pass->tile_regions = large_tile)
SPOIL(empty_tile_region, pass->tile_regions = empty_tile)
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
    {"samples_per_group", DIP_ERROR_CONFLICT, negative_groups},
    {"samples_per_group", DIP_ERROR_CONFLICT, very_negative_groups},
    {"tile_regions", DIP_ERROR_RANGE, uneven_tile_region},
    {"tile_regions", DIP_ERROR_RANGE, large_tile_region},
    {"tile_regions", DIP_ERROR_RANGE, empty_tile_region},
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

static void memory_is_not_reserved_for_bad_draws(void **state) {
    const Stage *stage = *state;
    size_t refused = 0;
    for (size_t i = 0; i < sizeof bad_passes / sizeof *bad_passes; i++) {
        DipDraw draw = stage->draw;
        DipPass pass = good_pass(stage, 0);
        DipError err = {0};
        pass.draws = &draw;
        assert_true(dip_pipeline_reserve(stage->pipelines[0], &pass, &err));
        bad_passes[i].spoil(&pass, &draw);
        if (strncmp(bad_passes[i].field, "draw", 4) == 0) {
            assert_false(dip_pipeline_reserve(stage->pipelines[0], &pass, &err));
            assert_string_equal(err.key, bad_passes[i].field);
            assert_int_equal(err.code, bad_passes[i].code);
            refused++;
        }
    }
    assert_true(refused >= 10);
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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bad_passes_are_refused_with_the_field_at_fault),
        cmocka_unit_test(memory_is_not_reserved_for_bad_draws),
        cmocka_unit_test(a_good_pass_is_drawn),
        cmocka_unit_test(the_fault_of_one_draw_of_many_names_its_index),
        cmocka_unit_test(missing_pointers_are_refused_or_have_a_meaning),
        cmocka_unit_test(a_list_of_no_draws_is_legal),
    };
    return cmocka_run_group_tests(tests, open_stage, close_stage);
}
