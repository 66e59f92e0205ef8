// Tests shading that frames drawn at once share (dip_renderer_copy_shading). A frame that copies
// pixels from another frame has the same bits as the frame drawn alone, in every scene, from
// several viewpoints, with every instruction set and several numbers of threads; and what it copied
// and what it shaded add up to what it shades alone.
#include "tests/renderer/scene/stage.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// The last sub-blocks of rows and columns reach past the picture's edges.
enum { WIDTH = 201, HEIGHT = 150, VIEWS = 3 };
static int views = VIEWS; // Viewpoints from which each pair is drawn. --views gives fewer.

// Two panes' settings, and whether they shade alike.
typedef struct Pair {
    const char *settings[2];
    bool alike;
} Pair;

static const Pair pairs[] = {
    {{"aa=8,af=16", "aa=4,af=16"}, true},
    {{"aa=none", "aa=6"}, true},
    {{"aa=2,taa=on,af=4,aaf=on", "aa=8,taa=on,af=4,aaf=on"}, true},
    {{"aa=8,aaa=on,asd=2", "aa=4"}, true},
    {{"aa=8,aaa=on,asd=2,opt=advanced", "aa=4,aaa=on,asd=1,opt=advanced"}, true},
    {{"aa=4,gi=off,miplod=performance", "aa=none,gi=off,miplod=performance"}, true},
    {{"aa=4,af=16", "aa=4,af=8"}, false},
    {{"aa=4,af=2", "aa=4,af=2,aaf=on"}, false},
    {{"aa=4", "aa=4,opt=standard"}, false},
    {{"aa=4,miplod=quality", "aa=2,miplod=performance"}, false},
    {{"aa=4,mipdebug=on", "aa=2,mipdebug=on"}, false},
    {{"aa=4", "aa=2,gi=off"}, false},
    {{"aa=4,aaa=coverage", "aa=8,aaa=coverage"}, false},
    {{"aa=4,aaa=all", "aa=8,aaa=all"}, false},
    {{"aa=4,scale=1.5", "aa=8,scale=1.5"}, false},
    {{"aa=4,scale=1/1.5,upscale=easu", "aa=8,scale=1/1.5,upscale=easu"}, true},
    {{"aa=4,scale=1/1.5", "aa=8,scale=1/1.3"}, false},
    {{"aa=4,post=smaa,sharpen=low", "aa=8,post=smaa,sharpen=low"}, true},
    {{"aa=4,post=smaa", "aa=8,post=fxaa"}, false},
    {{"aa=4,shadows=512", "aa=8,shadows=512"}, true},
    {{"aa=4,shadows=512", "aa=8,shadows=1024"}, false},
};
enum { PAIRS = sizeof pairs / sizeof *pairs };

// A scene, and two renderers that share a pool.
typedef struct Panes {
    const DipScene *scene;
    DipPose pose;
    DipRenderer *renderers[2];
} Panes;

static DipRendererDef pane_def(DipPool *pool, DipIsa isa, const DipTestScene *scene) {
    DipRendererDef def = stage_def(WIDTH, HEIGHT, "");
    def.pool = pool;
    def.isa = isa;
    def.reflection = scene->reflection;
    return def;
}

// The viewpoints are near the scene's own, so that they show what the scene tests.
static DipPose view_of(const DipTestScene *scene, int view) {
    DipPose pose = scene->pose;
    pose.position_world[0] += 0.3 * view;
    pose.position_world[1] += 0.1 * view;
    pose.fov_y_deg -= 5.0 * view;
    return pose;
}

static void set_pair(const Panes *panes, const Pair *pair) {
    for (int p = 0; p < 2; p++) {
        DipQuality quality;
        assert_true(dip_quality_parse(pair->settings[p], &quality, NULL));
        assert_true(dip_renderer_set_quality(panes->renderers[p], &quality, NULL));
    }
}

static void compare_effects(const DipEffects *alone, const DipEffects *shared) {
#define COMPARE(name, text)                                                                        \
    assert_int_equal(shared->name.run, alone->name.run);                                           \
    assert_string_equal(shared->name.why, alone->name.why);
    DIP_EFFECT_LIST(COMPARE)
#undef COMPARE
}

// Compares a frame that may have copied pixels with the frame drawn alone.
static void compare(const DipFrame *alone, const DipFrame *shared, const char shared_hash[33]) {
    const DipCounters *a = &alone->counters;
    const DipCounters *b = &shared->counters;
    char hash[33];
    dip_frame_hash(alone, hash);
    assert_string_equal(shared_hash, hash);
    assert_int_equal(a->fragments_copied, 0);
    assert_int_equal(b->fragments_shaded + b->fragments_copied, a->fragments_shaded);
    assert_int_equal(b->samples_shown, a->samples_shown);
    assert_int_equal(b->pixels_resolved, a->pixels_resolved);
    assert_int_equal(b->fragments_clip_tested, a->fragments_clip_tested);
    assert_int_equal(b->fragments_reflecting, a->fragments_reflecting);
    assert_true(b->fragments_mirrored <= a->fragments_mirrored);
    assert_true(b->texels_fetched <= a->texels_fetched);
    compare_effects(&alone->effects, &shared->effects);
}

// Draws a pair from one viewpoint, with one of the panes copying and then each pane alone. The
// shared frames come first, so that a pixel that they leave out still has the colour of the
// viewpoint before. Returns the number of fragments that the pane has copied.
static uint64_t draw_pair(const Panes *panes, uint64_t frame_index, int copying) {
    DipFrame alone;
    DipFrame shared[2];
    char hashes[2][33];
    for (int p = 0; p < 2; p++) {
        dip_renderer_set_frame_index(panes->renderers[p], frame_index);
        dip_renderer_copy_shading(panes->renderers[p], p == copying);
    }
    assert_true(dip_renderer_draw_frames(panes->renderers, 2, panes->scene, &panes->pose, 5,
                                         (DipFrame *const[2]){&shared[0], &shared[1]}, NULL));
    for (int p = 0; p < 2; p++) {
        dip_frame_hash(&shared[p], hashes[p]);
    }
    for (int p = 0; p < 2; p++) {
        assert_true(
            dip_renderer_draw(panes->renderers[p], panes->scene, &panes->pose, 5, &alone, NULL));
        compare(&alone, &shared[p], hashes[p]);
    }
    assert_int_equal(shared[!copying].counters.fragments_copied, 0);
    return shared[copying].counters.fragments_copied;
}

// Calls draw_all with the panes of every scene, for one instruction set and number of threads.
static void for_all_scenes(DipIsa isa, int threads,
                           void (*draw_all)(Panes *, const DipTestScene *)) {
    for (int kind = 0; kind < DIP_TEST_SCENE_COUNT; kind++) {
        static DipTestScene scene;
        dip_test_scene_make(&scene, (DipTestSceneKind)kind);
        DipScene *fast = dip_scene_create(&scene.def, NULL, NULL);
        DipPool *pool = dip_pool_create(threads, NULL);
        const DipRendererDef def = pane_def(pool, isa, &scene);
        Panes panes = {.scene = fast};
        for (int p = 0; p < 2; p++) {
            panes.renderers[p] = stage_make_renderer(&def);
        }
        draw_all(&panes, &scene);
        dip_renderer_destroy(&panes.renderers[0]);
        dip_renderer_destroy(&panes.renderers[1]);
        dip_pool_destroy(&pool);
        dip_scene_destroy(&fast);
        dip_test_scene_free(&scene);
    }
}

static bool blends(const DipTestScene *scene) {
    for (int i = 0; i < scene->def.material_count; i++) {
        if (scene->def.materials[i].surface == DIP_SURFACE_BLENDED ||
            scene->def.materials[i].transmission > 0.0f) {
            return true;
        }
    }
    return false;
}

static void draw_all_pairs(Panes *panes, const DipTestScene *scene) {
    for (int i = 0; i < PAIRS; i++) {
        uint64_t copied = 0;
        set_pair(panes, &pairs[i]);
        for (int view = 0; view < views; view++) {
            panes->pose = view_of(scene, view);
            copied += draw_pair(panes, (uint64_t)view, view % 2);
        }
        // Tiles that blended surfaces reach are merged, and merged tiles share no shading.
        assert_true(pairs[i].alike ? copied > 0 || blends(scene) : copied == 0);
    }
}

static void frames_that_copy_pixels_equal_frames_drawn_alone(void **state) {
    (void)state;
    for_all_scenes(dip_isa_best(), 3, draw_all_pairs);
}

// The counters and hashes of one pair, drawn with the first instruction set.
static uint64_t copied_first[DIP_TEST_SCENE_COUNT * 2];
static int copied_count;

static void draw_one_pair(Panes *panes, const DipTestScene *scene) {
    panes->pose = view_of(scene, 0);
    set_pair(panes, &pairs[0]);
    for (int copying = 0; copying < 2; copying++) {
        const uint64_t copied = draw_pair(panes, 0, copying);
        const int at = copied_count++ % (DIP_TEST_SCENE_COUNT * 2);
        if (copied_count > DIP_TEST_SCENE_COUNT * 2) {
            assert_int_equal(copied, copied_first[at]);
        }
        copied_first[at] = copied;
    }
}

static void any_threads_and_instruction_set_copy_the_same_pixels(void **state) {
    (void)state;
    copied_count = 0;
    for (int isa = 0; isa < DIP_ISA_COUNT; isa++) {
        if (dip_isa_available((DipIsa)isa)) {
            for_all_scenes((DipIsa)isa, 1 + isa % 3, draw_one_pair);
        }
    }
    for_all_scenes(dip_isa_best(), 4, draw_one_pair);
}

// Draws both panes with every effect forced, or with one pane that records its tiles. Neither
// copies.
static void nothing_is_copied_where_the_work_of_a_pane_is_wanted(void **state) {
    (void)state;
    static DipTestScene scene;
    dip_test_scene_make(&scene, DIP_TEST_SCENE_water_effects);
    DipScene *fast = dip_scene_create(&scene.def, NULL, NULL);
    DipPool *pool = dip_pool_create(2, NULL);
    for (int recording = 0; recording < 2; recording++) {
        DipRendererDef def = pane_def(pool, dip_isa_best(), &scene);
        def.force_all_effects = !recording;
        Panes panes = {.scene = fast, .pose = scene.pose};
        for (int p = 0; p < 2; p++) {
            panes.renderers[p] = stage_make_renderer(&def);
        }
        set_pair(&panes, &pairs[0]);
        for (int pane = 0; pane < 2; pane++) {
            DipFrame frames[2];
            assert_true(dip_renderer_record_tiles(panes.renderers[pane], recording, NULL));
            dip_renderer_copy_shading(panes.renderers[1], true);
            assert_true(dip_renderer_draw_frames(panes.renderers, 2, fast, &scene.pose, 0,
                                                 (DipFrame *const[2]){&frames[0], &frames[1]},
                                                 NULL));
            assert_int_equal(frames[1].counters.fragments_copied, 0);
            assert_true(dip_renderer_record_tiles(panes.renderers[pane], false, NULL));
        }
        dip_renderer_destroy(&panes.renderers[0]);
        dip_renderer_destroy(&panes.renderers[1]);
    }
    dip_pool_destroy(&pool);
    dip_scene_destroy(&fast);
    dip_test_scene_free(&scene);
}

int main(int argc, char **argv) {
    if (argc == 3 && strcmp(argv[1], "--views") == 0) {
        views = atoi(argv[2]);
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_that_copy_pixels_equal_frames_drawn_alone),
        cmocka_unit_test(any_threads_and_instruction_set_copy_the_same_pixels),
        cmocka_unit_test(nothing_is_copied_where_the_work_of_a_pane_is_wanted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
