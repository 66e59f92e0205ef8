// Tests that any number of threads draws the same picture and counts the same work. Also tests that
// drawing a scene again, or at another size, does not change later pictures.
#include "tests/renderer/scene/stage.h"

#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const char *const settings[] = {"aa=none", "aa=8,af=16,aaf=on", "aa=6,mipdebug=on",
                                       "aa=8,aaa=on,asd=2"};
static const int sizes[][2] = {{130, 70}, {1, 1}, {65, 3}}; // The first has six tiles.

enum { MAX_THREADS = 4, SETTINGS = 4, SIZES = 3, DRAWN_TWICE = 2 };
static int size_count = SIZES; // Sizes that are drawn. --sizes gives fewer.

typedef struct Result {
    char hash[33];
    DipCounters counters;
} Result;

static DipRenderer *pane_of(DipPool *pool, const DipTestScene *scene, const char *text,
                            const int size[2]) {
    DipRendererDef def = stage_def(size[0], size[1], text);
    def.pool = pool;
    def.reflection = scene->reflection;
    return stage_make_renderer(&def);
}

// Draws a scene twice, with a pool that serves only this function.
static Result draw(const DipTestScene *scene, const DipScene *fast, int threads, const int size[2],
                   const char *text) {
    Result result[DRAWN_TWICE];
    DipPool *pool = dip_pool_create(threads, NULL);
    DipRenderer *renderer = pane_of(pool, scene, text, size);
    for (int i = 0; i < DRAWN_TWICE; i++) {
        DipFrame frame;
        assert_true(dip_renderer_draw(renderer, fast, &scene->pose, 0, &frame, NULL));
        dip_frame_hash(&frame, result[i].hash);
        result[i].counters = frame.counters;
    }
    assert_string_equal(result[0].hash, result[1].hash);
    assert_memory_equal(&result[0].counters, &result[1].counters, sizeof(DipCounters));
    dip_renderer_destroy(&renderer);
    dip_pool_destroy(&pool);
    return result[0];
}

static void any_number_of_threads_draws_the_same_picture(void **state) {
    (void)state;
    for (int kind = 0; kind < DIP_TEST_SCENE_COUNT; kind++) {
        static DipTestScene scene;
        dip_test_scene_make(&scene, (DipTestSceneKind)kind);
        DipScene *fast = dip_scene_create(&scene.def, NULL, NULL);
        assert_non_null(fast);
        for (int i = 0; i < SETTINGS * size_count; i++) {
            const char *text = settings[i % SETTINGS];
            const int *size = sizes[i / SETTINGS];
            const Result one = draw(&scene, fast, 1, size, text);
            for (int threads = 2; threads <= MAX_THREADS; threads++) {
                const Result many = draw(&scene, fast, threads, size, text);
                assert_string_equal(many.hash, one.hash);
                assert_memory_equal(&many.counters, &one.counters, sizeof one.counters);
            }
        }
        dip_scene_destroy(&fast);
        dip_test_scene_free(&scene);
    }
}

// Two panes with different settings and sizes share one scene and one pool, and do not disturb each
// other.
static void panes_that_share_a_scene_do_not_disturb_each_other(void **state) {
    (void)state;
    static DipTestScene scene;
    dip_test_scene_make(&scene, DIP_TEST_SCENE_fence);
    DipScene *fast = dip_scene_create(&scene.def, NULL, NULL);
    DipPool *pool = dip_pool_create(2, NULL);
    DipRenderer *renderers[2];
    char expected[2][33];
    for (int p = 0; p < 2; p++) {
        DipRendererDef def = stage_def(120 + 30 * p, 90, settings[p]);
        def.pool = pool;
        renderers[p] = stage_make_renderer(&def);
    }
    for (int round = 0; round < 3; round++) {
        for (int p = 0; p < 2; p++) {
            DipFrame frame;
            char hash[33];
            assert_true(dip_renderer_draw(renderers[p], fast, &scene.pose, 0, &frame, NULL));
            dip_frame_hash(&frame, hash);
            if (round) {
                assert_string_equal(hash, expected[p]);
            }
            memcpy(expected[p], hash, sizeof hash);
        }
    }
    assert_string_not_equal(expected[0], expected[1]);
    dip_renderer_destroy(&renderers[0]);
    dip_renderer_destroy(&renderers[1]);
    dip_pool_destroy(&pool);
    dip_scene_destroy(&fast);
    dip_test_scene_free(&scene);
}

// Pairs of settings. The first pair differs only in samples. The other pairs also differ in
// filtering, temporal patterns, sample groups, textures or copies of meshes.
static const char *const pairs[][2] = {{"aa=8,af=16", "aa=4,af=16"},
                                       {"aa=none", "aa=2,af=4,aaf=on"},
                                       {"aa=6,taa=on", "aa=8,aaa=on,asd=2"},
                                       {"opt=standard,miplod=performance", "aa=4,mipdebug=on"},
                                       {"aa=4,gi=off", "aa=8"}};

// With and without the other pane, shading must take the same work. The geometry stage may take
// more work for a pair, because it keeps every triangle that one of the panes may show.
static void compare_work(const DipFrame *alone, const DipFrame *paired) {
    assert_int_equal(paired->counters.fragments_shaded, alone->counters.fragments_shaded);
    assert_int_equal(paired->counters.samples_shown, alone->counters.samples_shown);
    assert_int_equal(paired->counters.pixels_resolved, alone->counters.pixels_resolved);
    assert_int_equal(paired->counters.texels_fetched, alone->counters.texels_fetched);
    assert_int_equal(paired->counters.fragments_mirrored, alone->counters.fragments_mirrored);
    assert_true(paired->counters.triangles_drawn >= alone->counters.triangles_drawn);
}

static void draw_both_ways(DipRenderer *const panes[2], const DipTestScene *scene,
                           const DipScene *fast, uint64_t frame_index) {
    DipFrame alone[2], paired[2];
    char expected[2][33];
    for (int p = 0; p < 2; p++) {
        dip_renderer_set_frame_index(panes[p], frame_index);
        assert_true(dip_renderer_draw(panes[p], fast, &scene->pose, 5, &alone[p], NULL));
        dip_frame_hash(&alone[p], expected[p]);
    }
    DipFrame *const frames[2] = {&paired[0], &paired[1]};
    assert_true(dip_renderer_draw_frames(panes, 2, fast, &scene->pose, 5, frames, NULL));
    for (int p = 0; p < 2; p++) {
        char hash[33];
        dip_frame_hash(&paired[p], hash);
        assert_string_equal(hash, expected[p]);
        compare_work(&alone[p], &paired[p]);
    }
}

// Two frames drawn at once have the same bits as the two frames drawn one by one, even if their
// sizes differ.
static void frames_drawn_as_a_pair_equal_frames_drawn_alone(void **state) {
    (void)state;
    static const int other_size[2] = {90, 130};
    for (int kind = 0; kind < DIP_TEST_SCENE_COUNT; kind++) {
        static DipTestScene scene;
        dip_test_scene_make(&scene, (DipTestSceneKind)kind);
        DipScene *fast = dip_scene_create(&scene.def, NULL, NULL);
        DipPool *pool = dip_pool_create(3, NULL);
        for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
            DipRenderer *panes[2] = {
                pane_of(pool, &scene, pairs[i][0], sizes[0]),
                pane_of(pool, &scene, pairs[i][1], i == 1 ? other_size : sizes[0])};
            for (uint64_t frame = 0; frame < 2; frame++) {
                draw_both_ways(panes, &scene, fast, frame);
            }
            dip_renderer_destroy(&panes[0]);
            dip_renderer_destroy(&panes[1]);
        }
        dip_pool_destroy(&pool);
        dip_scene_destroy(&fast);
        dip_test_scene_free(&scene);
    }
}

// A change of settings or size shows in the next frame, and changing it back gives the earlier
// picture.
static void changes_show_in_the_next_frame(void **state) {
    (void)state;
    static DipTestScene scene;
    dip_test_scene_make(&scene, DIP_TEST_SCENE_grazing_noise);
    DipScene *fast = dip_scene_create(&scene.def, NULL, NULL);
    DipPool *pool = dip_pool_create(2, NULL);
    DipRendererDef def = stage_def(96, 64, "");
    def.pool = pool;
    DipRenderer *renderer = stage_make_renderer(&def);
    static const char *const changes[] = {"",
                                          "aa=2",
                                          "aa=4",
                                          "aa=6",
                                          "aa=8",
                                          "af=2",
                                          "af=4",
                                          "af=16",
                                          "af=16,aaf=on",
                                          "mipdebug=on",
                                          "opt=standard",
                                          "opt=advanced",
                                          "miplod=quality",
                                          "miplod=performance",
                                          "miplod=high-performance"};
    enum { COUNT = sizeof changes / sizeof *changes };
    char hashes[COUNT][33];
    for (int round = 0; round < 2; round++) {
        for (int i = 0; i < COUNT; i++) {
            DipQuality quality;
            DipFrame frame;
            char hash[33];
            assert_true(dip_quality_parse(changes[i], &quality, NULL));
            assert_true(dip_renderer_set_quality(renderer, &quality, NULL));
            assert_true(dip_renderer_draw(renderer, fast, &scene.pose, 0, &frame, NULL));
            dip_frame_hash(&frame, hash);
            for (int other = 0; round == 0 && other < i; other++) {
                assert_string_not_equal(hash, hashes[other]);
            }
            if (round) {
                assert_string_equal(hash, hashes[i]);
            }
            memcpy(hashes[i], hash, sizeof hash);
        }
    }
    DipFrame frame;
    assert_true(dip_renderer_resize(renderer, 33, 70, NULL));
    assert_true(dip_renderer_draw(renderer, fast, &scene.pose, 0, &frame, NULL));
    assert_int_equal(frame.width, 33);
    assert_int_equal(frame.height, 70);
    DipError err;
    assert_false(dip_renderer_resize(renderer, 0, 70, &err));
    assert_int_equal(err.code, DIP_ERROR_RANGE);
    assert_true(dip_renderer_draw(renderer, fast, &scene.pose, 0, &frame, NULL));
    assert_int_equal(frame.width, 33);
    dip_renderer_destroy(&renderer);
    dip_pool_destroy(&pool);
    dip_scene_destroy(&fast);
    dip_test_scene_free(&scene);
}

static void *compress(void *scene) {
    return dip_scene_compress_textures(scene, NULL, NULL) ? scene : NULL;
}

// One thread compresses the textures while this thread draws frames. The first frames do not use
// compressed textures; the next ones do and may have to wait for them.
static void textures_can_be_compressed_while_frames_are_drawn(void **state) {
    (void)state;
    static DipTestScene scene;
    static const int size[2] = {64, 48};
    dip_test_scene_make(&scene, DIP_TEST_SCENE_grazing_noise);
    for (int round = 0; round < 3; round++) {
        DipScene *fast = dip_scene_create(&scene.def, NULL, NULL);
        pthread_t thread;
        void *made = NULL;
        assert_int_equal(pthread_create(&thread, NULL, compress, fast), 0);
        const Result plain = draw(&scene, fast, 2, size, "aa=none");
        const Result meanwhile = draw(&scene, fast, 2, size, "opt=standard");
        assert_int_equal(pthread_join(thread, &made), 0);
        assert_ptr_equal(made, fast);
        const Result after = draw(&scene, fast, 1, size, "opt=standard");
        assert_string_equal(meanwhile.hash, after.hash);
        assert_string_not_equal(plain.hash, after.hash);
        dip_scene_destroy(&fast);
    }
    dip_test_scene_free(&scene);
}

int main(int argc, char **argv) {
    if (argc == 3 && strcmp(argv[1], "--sizes") == 0) {
        size_count = atoi(argv[2]);
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_number_of_threads_draws_the_same_picture),
        cmocka_unit_test(panes_that_share_a_scene_do_not_disturb_each_other),
        cmocka_unit_test(frames_drawn_as_a_pair_equal_frames_drawn_alone),
        cmocka_unit_test(changes_show_in_the_next_frame),
        cmocka_unit_test(textures_can_be_compressed_while_frames_are_drawn),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
