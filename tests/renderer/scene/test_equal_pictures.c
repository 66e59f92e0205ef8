// Tests the rule that says which settings have no effect (dip_quality_effective) against pictures:
// for every valid combination, the rule must say that two draw the same pictures exactly where
// they do, in a scene with clipped bars before a plane that reaches to the horizon.
#include "renderer/scene/renderer.h"

#include "renderer/catalogue/scenes.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { SIZE = 48 };

static DipTestScene scene;

typedef struct Stage {
    DipPool *pool;
    DipScene *scene;
    DipRenderer *renderer;
    int drawn;
} Stage;

// Draws two successive frames, since temporal AA alternates, and returns their hash.
static uint64_t draw(Stage *stage, const DipQuality *quality) {
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    assert_true(dip_renderer_set_quality(stage->renderer, quality, NULL));
    for (uint64_t i = 0; i < 2; i++) {
        DipFrame frame;
        dip_renderer_set_frame_index(stage->renderer, i);
        assert_true(dip_renderer_draw(stage->renderer, stage->scene, &scene.pose, 0, &frame, NULL));
        for (int y = 0; y < frame.height; y++) {
            const uint8_t *row = frame.rgba8 + (size_t)y * frame.stride_bytes;
            for (int x = 0; x < 4 * frame.width; x++) {
                hash = (hash ^ row[x]) * UINT64_C(0x100000001b3);
            }
        }
    }
    stage->drawn++;
    return hash;
}

static void compare(Stage *stage, const DipQuality *quality) {
    static const DipSetting switched[] = {DIP_SETTING_TAA, DIP_SETTING_AAA, DIP_SETTING_ASD,
                                          DIP_SETTING_AAF};
    char text[128];
    const DipQuality effective = dip_quality_effective(quality);
    const uint64_t hash = draw(stage, quality);
    dip_quality_format_changes(quality, text, sizeof text);
    if (!dip_quality_equal(&effective, quality) && draw(stage, &effective) != hash) {
        fail_msg("%s: a setting that is said to have no effect changes the picture", text);
    }
    for (size_t i = 0; i < sizeof switched / sizeof *switched; i++) {
        DipQuality off = effective;
        off.step[switched[i]] = 0;
        if (!dip_quality_equal(&off, &effective) && draw(stage, &off) == hash) {
            fail_msg("%s: %s is said to have an effect, but the picture stays the same", text,
                     dip_setting_info(switched[i])->key);
        }
    }
}

// Calls compare for every valid combination of the settings from `setting` on that can lose their
// effect.
static void compare_from(Stage *stage, DipQuality quality, int setting) {
    if (setting > DIP_SETTING_AAF) {
        if (dip_quality_check(&quality, NULL)) {
            compare(stage, &quality);
        }
        return;
    }
    for (int step = 0; step < dip_setting_info((DipSetting)setting)->step_count; step++) {
        quality.step[setting] = (uint8_t)step;
        compare_from(stage, quality, setting + 1);
    }
}

static void equal_pictures_are_one_rule(void **state) {
    (void)state;
    dip_test_scene_make(&scene, DIP_TEST_SCENE_fence);
    Stage stage = {.pool = dip_pool_create(1, NULL),
                   .scene = dip_scene_create(&scene.def, NULL, NULL)};
    DipRendererDef def = dip_renderer_default_def();
    def.pool = stage.pool;
    def.width = def.height = SIZE;
    stage.renderer = dip_renderer_create(&def, NULL);
    assert_non_null(stage.renderer);
    compare_from(&stage, dip_quality_default(), 0);
    print_message("%d combinations drawn\n", stage.drawn);
    assert_true(stage.drawn > 400);
    dip_renderer_destroy(&stage.renderer);
    dip_scene_destroy(&stage.scene);
    dip_pool_destroy(&stage.pool);
    dip_test_scene_free(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(equal_pictures_are_one_rule)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
