// Tests that drawing a frame allocates no memory. After the first frame of a scene, drawing the
// scene with any settings and any camera must not call an allocator. tests/support/allocation.h
// counts the calls.
#include "tests/renderer/scene/stage.h"
#include "tests/support/allocation.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

// Draws from several positions with the steps of every setting. Draws each frame twice: with the
// first pane alone, and with both panes together. Returns the number of allocations.
static int64_t draw_everything(DipRenderer *const panes[2], const DipScene *scene, DipPose pose,
                               bool instancing) {
    const int64_t before = dip_allocation_count();
    for (int i = 0; i < 60; i++) {
        DipQuality quality = dip_quality_default();
        quality.step[DIP_SETTING_AA] = (uint8_t)(i % 5);
        quality.step[DIP_SETTING_TAA] = (uint8_t)(i / 2 % 2);
        quality.step[DIP_SETTING_AAA] = (uint8_t)(i / 3 % 2);
        quality.step[DIP_SETTING_AF] = (uint8_t)(i / 5 % 5);
        quality.step[DIP_SETTING_AAF] = (uint8_t)(i % 2);
        quality.step[DIP_SETTING_OPT] = (uint8_t)(i / 2 % 3);
        quality.step[DIP_SETTING_GI] = instancing;
        quality.step[DIP_SETTING_MIPLOD] = (uint8_t)(i % 4);
        quality.step[DIP_SETTING_MIPDEBUG] = (uint8_t)(i / 30);
        quality.step[DIP_SETTING_SHADOWS] = 1; // a map of another size is another allocation
        pose.position_world[0] += 0.05;
        dip_renderer_set_frame_index(panes[0], (uint64_t)i);
        dip_renderer_copy_shading(panes[0], i % 3 == 1);
        dip_renderer_copy_shading(panes[1], i % 3 == 2);
        DipFrame frames[2];
        assert_true(dip_renderer_set_quality(panes[0], &quality, NULL));
        assert_true(dip_renderer_draw(panes[0], scene, &pose, i, &frames[0], NULL));
        assert_true(dip_renderer_draw_frames(panes, 2, scene, &pose, i,
                                             (DipFrame *const[2]){&frames[0], &frames[1]}, NULL));
    }
    return dip_allocation_count() - before;
}

static void frames_of_a_history_allocate_nothing(void **state) {
    (void)state;
    static DipTestScene scene;
    dip_test_scene_make(&scene, DIP_TEST_SCENE_fence);
    const int64_t at_first = dip_allocation_count();
    Stage stage = stage_open(&scene.def, stage_def(160, 120, "taa=history"), 2);
    stage_draw(&stage, &scene.pose, 0);
    const int64_t before = dip_allocation_count();
    assert_true(before > at_first);
    for (int i = 1; i < 40; i++) {
        scene.pose.position_world[0] += i < 20 ? 0.05 : 0.0;
        dip_renderer_set_frame_index(stage.renderer, (uint64_t)i);
        const DipFrame frame = stage_draw(&stage, &scene.pose, 0);
        assert_true(i > 19 || frame.counters.pixels_reprojected > 0);
    }
    assert_int_equal(before, dip_allocation_count());
    stage_close(&stage);
    dip_test_scene_free(&scene);
}

// Returns the bytes that are held after a frame of a renderer with these settings.
static int64_t bytes_after(DipRenderer *renderer, const DipScene *scene, const DipPose *pose,
                           const DipQuality *quality) {
    DipFrame frame;
    assert_true(dip_renderer_set_quality(renderer, quality, NULL));
    assert_true(dip_renderer_draw(renderer, scene, pose, 0, &frame, NULL));
    return dip_allocation_holdings().bytes;
}

// A renderer that is drawn with a step and then without it holds what it held before. The settings
// below need memory of their own while they are on: pictures, filters, a history and a shadow map.
// The others draw with the memory that every frame has.
static void settings_that_are_off_hold_no_byte(void **state) {
    (void)state;
    static const DipSetting settings[] = {DIP_SETTING_TAA, DIP_SETTING_SCALE, DIP_SETTING_POST,
                                          DIP_SETTING_SHARPEN, DIP_SETTING_SHADOWS};
    static DipTestScene scene;
    dip_test_scene_make(&scene, DIP_TEST_SCENE_lights);
    DipScene *fast = dip_scene_create(&scene.def, NULL, NULL);
    DipRendererDef def = dip_renderer_default_def();
    def.width = 160;
    def.height = 120;
    DipRenderer *renderer = dip_renderer_create(&def, NULL);
    const DipQuality off = dip_quality_default();
    const int64_t before = bytes_after(renderer, fast, &scene.pose, &off);
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        const DipSettingInfo *info = dip_setting_info(settings[i]);
        for (int step = 0; step < info->step_count; step++) {
            DipQuality on = off;
            on.step[settings[i]] = (uint8_t)step;
            const bool takes = step != info->default_step &&
                               (settings[i] != DIP_SETTING_TAA || step == DIP_TAA_HISTORY);
            const int64_t with = bytes_after(renderer, fast, &scene.pose, &on);
            const int64_t after = bytes_after(renderer, fast, &scene.pose, &off);
            if (after != before || (with > before) != takes) {
                fail_msg("%s=%s: %lld bytes before, %lld with it, %lld after", info->key,
                         info->steps[step], (long long)before, (long long)with, (long long)after);
            }
        }
    }
    dip_renderer_destroy(&renderer);
    dip_scene_destroy(&fast);
    dip_test_scene_free(&scene);
}

// Makes a scene of the catalogue, or of DIP_TEST_SCENE_COUNT one with rough glass.
static void make_scene(int kind, DipTestScene *scene) {
    const bool glass = kind == DIP_TEST_SCENE_COUNT;
    dip_test_scene_make(scene, glass ? DIP_TEST_SCENE_metal_gloss : (DipTestSceneKind)kind);
    for (int i = 1; glass && i < scene->def.material_count; i++) {
        scene->materials[i].surface = DIP_SURFACE_BLENDED;
        scene->pbrs[i].roughness = 0.5f;
        scene->pbrs[i].transmission = scene->pbrs[i].scattering = 1.0f;
    }
}

static void frames_after_the_first_allocate_nothing(void **state) {
    (void)state;
    for (int kind = 0; kind <= DIP_TEST_SCENE_COUNT; kind++) {
        static DipTestScene scene;
        make_scene(kind, &scene);
        const int64_t before = dip_allocation_count();
        DipRendererDef def = stage_def(160, 120, "");
        def.reflection = scene.reflection;
        def.quality.step[DIP_SETTING_SHADOWS] = 1;
        Stage stage = stage_open(&scene.def, def, 2);
        DipRenderer *panes[2] = {stage.renderer, stage_make_renderer(&stage.def)};
        const DipScene *fast = stage.scene;
        DipFrame frame;
        assert_true(dip_allocation_count() > before); // proves that calls are counted
        // In the first frame, nothing is in view: the memory that it allocates does not depend on
        // the view.
        DipPose away = scene.pose;
        away.position_world[1] += 1000.0;
        away.orientation[0] = away.orientation[3] = 0.7071067811865476;
        for (int p = 0; p < 2; p++) {
            assert_true(dip_renderer_draw(panes[p], fast, &away, 0, &frame, NULL));
        }
        // The textures are compressed in advance, so that no frame has to make compressed textures.
        assert_true(dip_scene_compress_textures(stage.scene, stage.pool, NULL));
        assert_int_equal(draw_everything(panes, fast, scene.pose, true), 0);
        assert_true(dip_renderer_draw(panes[0], fast, &scene.pose, 0, &frame, NULL));
        assert_true(frame.effects.scattering.run == (kind == DIP_TEST_SCENE_COUNT));
        // The first frame without instancing creates a mesh for each object.
        (void)draw_everything(panes, fast, scene.pose, false);
        assert_int_equal(draw_everything(panes, fast, scene.pose, false), 0);
        dip_renderer_destroy(&panes[1]);
        stage_close(&stage);
        dip_test_scene_free(&scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_after_the_first_allocate_nothing),
        cmocka_unit_test(frames_of_a_history_allocate_nothing),
        cmocka_unit_test(settings_that_are_off_hold_no_byte),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
