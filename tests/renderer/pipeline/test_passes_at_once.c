// Tests that passes drawn in one call have the same results as passes drawn one by one, that those
// which cannot be drawn at once are refused, and that threads may share a pool.
#include "pass_stage.h"

#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

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
        cmocka_unit_test(passes_drawn_at_once_equal_passes_drawn_alone),
        cmocka_unit_test(passes_that_cannot_be_drawn_at_once_are_refused),
        cmocka_unit_test(passes_at_once_share_no_depths_that_change),
        cmocka_unit_test(passes_that_copy_pixels_equal_passes_that_shade_them),
        cmocka_unit_test(draws_with_own_shading_are_never_copied),
        cmocka_unit_test(works_that_cannot_be_copied_from_are_refused),
        cmocka_unit_test(threads_may_draw_with_pipelines_of_one_pool),
        cmocka_unit_test(a_pipeline_that_draws_cannot_be_used),
    };
    return cmocka_run_group_tests(tests, open_stage, close_stage);
}
