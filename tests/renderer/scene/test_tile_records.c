// Tests the records of tiles. In every scene, with every instruction set and several numbers of
// threads, the records add up to the counters of the frame, and recording changes no pixel.
#include "tests/renderer/scene/stage.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const char *const settings[] = {"aa=none", "aa=8,af=16,aaf=on", "aa=4,taa=on,mipdebug=on",
                                       "aa=8,aaa=on,asd=2", "gi=off,aa=2"};

// The size is not a multiple of the size of tiles.
enum { SETTINGS = 5, WIDTH = 200, HEIGHT = 150, ACROSS = 4, DOWN = 3, TILES = ACROSS * DOWN };

static DipRenderer *make_renderer(DipPool *pool, DipIsa isa, const DipTestScene *scene,
                                  const char *text) {
    DipRendererDef def = stage_def(WIDTH, HEIGHT, text);
    def.pool = pool;
    def.isa = isa;
    def.reflection = scene->reflection;
    return stage_make_renderer(&def);
}

// Sums the counters and the time of all tiles.
static DipPipelineCounters sum_records(const DipFrameTiles *tiles, int64_t *ns) {
    DipPipelineCounters sum = {0};
    *ns = 0;
    for (int t = 0; t < tiles->across * tiles->down; t++) {
        const DipTileRecord *record = &tiles->records[t];
#define ADD(name, text) sum.name += record->counters.name;
        DIP_PIPELINE_COUNTER_LIST(ADD)
#undef ADD
        for (int i = 0; i < DIP_SHADER_COUNT_MAX; i++) {
            sum.shader_counts[i] += record->counters.shader_counts[i];
        }
        assert_true(record->raster_ns >= 0 && record->shading_ns >= 0 && record->resolve_ns >= 0);
        *ns += record->raster_ns + record->shading_ns + record->resolve_ns;
    }
    return sum;
}

// In each tile, as many pixels are marked as mixed as the tile resolved.
static void check_mixed(const DipFrame *frame) {
    for (int t = 0; t < frame->tiles.across * frame->tiles.down; t++) {
        const int x0 = t % frame->tiles.across * DIP_TARGET_TILE;
        const int y0 = t / frame->tiles.across * DIP_TARGET_TILE;
        uint64_t marked = 0;
        for (int y = y0; y < y0 + DIP_TARGET_TILE && y < frame->height; y++) {
            for (int x = x0; x < x0 + DIP_TARGET_TILE && x < frame->width; x++) {
                const uint8_t mixed = frame->tiles.mixed[y * frame->width + x];
                assert_true(mixed <= 1);
                marked += mixed;
            }
        }
        assert_int_equal(marked, frame->tiles.records[t].counters.pixels_resolved);
    }
}

static void check_sums(const DipFrame *frame, int threads) {
    const DipFrameTiles *tiles = &frame->tiles;
    const DipPipelineCounters *mirrored = &tiles->mirrored;
    const DipCounters *counters = &frame->counters;
    int64_t ns;
    assert_non_null(tiles->records);
    assert_int_equal(tiles->across, (frame->width + 63) / 64);
    assert_int_equal(tiles->down, (frame->height + 63) / 64);
    const DipPipelineCounters sum = sum_records(tiles, &ns);
#define CHECK(name) assert_int_equal(sum.name + mirrored->name, counters->name)
    CHECK(tiles_drawn);
    CHECK(sub_blocks_tested);
    CHECK(sub_blocks_accepted);
    CHECK(fragments_clip_tested);
    CHECK(clip_sample_groups);
    CHECK(fragments_shaded);
    CHECK(fragments_of_blocks);
    CHECK(shader_batches);
    CHECK(fragments_ordered);
    CHECK(samples_shown);
    CHECK(pixels_resolved);
    CHECK(texture_probes);
    CHECK(clip_probes);
    CHECK(texels_fetched);
#undef CHECK
    // The work before the tiles is in no record.
    assert_int_equal(sum.passes + sum.draws_in_view + sum.draws_culled + sum.triangles_in +
                         sum.triangles_drawn + sum.tile_triangles + sum.target_bytes +
                         sum.tiles_spared,
                     0);
    assert_int_equal(mirrored->passes + 1, counters->passes);
    assert_int_equal(mirrored->fragments_shaded, counters->fragments_mirrored);
    // Each thread draws one tile at a time, within the time of the frame.
    assert_true(ns > 0 && (double)ns <= 1e6 * threads * frame->stages.total_ms);
    assert_true(tiles->mirrored_times.total_ms < frame->stages.total_ms);
}

static void draw(DipRenderer *renderer, const DipTestScene *scene, const DipScene *fast,
                 DipFrame *frame, char hash[33]) {
    assert_true(dip_renderer_draw(renderer, fast, &scene->pose, 0, frame, NULL));
    dip_frame_hash(frame, hash);
}

// Draws a frame without and with recording. Copies the counters of the tiles.
static void check_frame(DipPool *pool, DipIsa isa, const DipTestScene *scene, const DipScene *fast,
                        const char *text, DipPipelineCounters counters[TILES]) {
    DipRenderer *renderer = make_renderer(pool, isa, scene, text);
    DipFrame frame;
    char off[33], on[33];
    draw(renderer, scene, fast, &frame, off);
    assert_null(frame.tiles.records);
    assert_null(frame.tiles.mixed);
    const DipCounters expected = frame.counters;
    assert_true(dip_renderer_record_tiles(renderer, true, NULL));
    draw(renderer, scene, fast, &frame, on);
    assert_string_equal(on, off);
    assert_memory_equal(&frame.counters, &expected, sizeof expected);
    check_sums(&frame, dip_pool_thread_count(pool));
    check_mixed(&frame);
    for (int t = 0; t < TILES; t++) {
        counters[t] = frame.tiles.records[t].counters;
    }
    assert_true(dip_renderer_record_tiles(renderer, false, NULL));
    draw(renderer, scene, fast, &frame, on);
    assert_string_equal(on, off);
    assert_null(frame.tiles.records);
    dip_renderer_destroy(&renderer);
}

static void records_add_up_to_the_frames_counters(void **state) {
    (void)state;
    for (int kind = 0; kind < DIP_TEST_SCENE_COUNT; kind++) {
        static DipTestScene scene;
        dip_test_scene_make(&scene, (DipTestSceneKind)kind);
        DipScene *fast = dip_scene_create(&scene.def, NULL, NULL);
        for (int s = 0; s < SETTINGS; s++) {
            DipPipelineCounters first[TILES], counters[TILES];
            bool known = false;
            for (int isa = 0; isa < DIP_ISA_COUNT; isa++) {
                // Each instruction set draws with one thread, and the best one with more.
                const int most = isa == (int)dip_isa_best() ? 3 : 1;
                for (int threads = 1; threads <= most && dip_isa_available((DipIsa)isa);
                     threads++) {
                    DipPool *pool = dip_pool_create(threads, NULL);
                    check_frame(pool, (DipIsa)isa, &scene, fast, settings[s],
                                known ? counters : first);
                    assert_true(!known || memcmp(first, counters, sizeof first) == 0);
                    known = true;
                    dip_pool_destroy(&pool);
                }
            }
        }
        dip_scene_destroy(&fast);
        dip_test_scene_free(&scene);
    }
}

// Frames that are drawn at once and share their geometry have records of their own.
static void frames_drawn_at_once_have_their_own_records(void **state) {
    (void)state;
    static DipTestScene scene;
    dip_test_scene_make(&scene, DIP_TEST_SCENE_water_effects);
    DipScene *fast = dip_scene_create(&scene.def, NULL, NULL);
    DipPool *pool = dip_pool_create(2, NULL);
    DipRenderer *renderers[2];
    DipFrame alone[2], frames[2];
    DipFrame *const panes[2] = {&frames[0], &frames[1]};
    DipPipelineCounters counters[2][TILES];
    for (int p = 0; p < 2; p++) {
        char hash[33];
        renderers[p] = make_renderer(pool, dip_isa_best(), &scene, settings[p]);
        assert_true(dip_renderer_record_tiles(renderers[p], true, NULL));
        draw(renderers[p], &scene, fast, &alone[p], hash);
        for (int t = 0; t < TILES; t++) {
            counters[p][t] = alone[p].tiles.records[t].counters;
        }
    }
    assert_true(dip_renderer_draw_frames(renderers, 2, fast, &scene.pose, 0, panes, NULL));
    for (int p = 0; p < 2; p++) {
        check_sums(&frames[p], 2);
        check_mixed(&frames[p]);
        for (int t = 0; t < TILES; t++) {
            DipPipelineCounters together = frames[p].tiles.records[t].counters;
            // Shared geometry keeps triangles that only the other frame's samples meet.
            together.sub_blocks_tested = counters[p][t].sub_blocks_tested;
            together.sub_blocks_accepted = counters[p][t].sub_blocks_accepted;
            assert_memory_equal(&together, &counters[p][t], sizeof together);
        }
        dip_renderer_destroy(&renderers[p]);
    }
    dip_pool_destroy(&pool);
    dip_scene_destroy(&fast);
    dip_test_scene_free(&scene);
}

static void a_new_size_has_new_records(void **state) {
    (void)state;
    static DipTestScene scene;
    static const int sizes[][2] = {{1, 1}, {65, 3}, {300, 260}, {64, 64}};
    dip_test_scene_make(&scene, DIP_TEST_SCENE_fence);
    DipScene *fast = dip_scene_create(&scene.def, NULL, NULL);
    DipPool *pool = dip_pool_create(2, NULL);
    DipRenderer *renderer = make_renderer(pool, dip_isa_best(), &scene, settings[1]);
    assert_true(dip_renderer_record_tiles(renderer, true, NULL));
    for (int i = 0; i < 4; i++) {
        DipFrame frame;
        char hash[33];
        assert_true(dip_renderer_resize(renderer, sizes[i][0], sizes[i][1], NULL));
        draw(renderer, &scene, fast, &frame, hash);
        check_sums(&frame, 2);
        check_mixed(&frame);
    }
    dip_renderer_destroy(&renderer);
    dip_pool_destroy(&pool);
    dip_scene_destroy(&fast);
    dip_test_scene_free(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(records_add_up_to_the_frames_counters),
        cmocka_unit_test(frames_drawn_at_once_have_their_own_records),
        cmocka_unit_test(a_new_size_has_new_records),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
