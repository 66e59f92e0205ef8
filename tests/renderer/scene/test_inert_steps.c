// Settings beside which a step has no effect, and scenes in which it has none: the plan gives the
// reason, and the step changes neither the picture nor any counter of work or memory.
#include "renderer/catalogue/scenes.h"
#include "renderer/scene/renderer.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 90, HEIGHT = 67 };

typedef struct Row {
    DipTestSceneKind scene;
    const char *settings; // with the step
    const char *without;  // the same without it
    size_t effect;        // what the reason is about: an offset in DipEffects
    const char *why;
    bool turned; // the camera looks the other way
} Row;

#define EFFECT(name) offsetof(DipEffects, name)
#define SCENE(name)  DIP_TEST_SCENE_##name

static const Row inert[] = {
    {SCENE(fence), "", "", EFFECT(adaptive_aa), "aaa is off", false},
    {SCENE(fence), "aa=4,asd=2", "aa=4", EFFECT(adaptive_aa), "aaa is off", false},
    {SCENE(fence), "aaa=coverage", "", EFFECT(adaptive_aa), "one sample group holds all samples",
     false},
    {SCENE(fence), "aaa=on", "", EFFECT(adaptive_aa), "one sample group holds all samples", false},
    {SCENE(fence), "aaa=all", "", EFFECT(adaptive_aa), "one sample group holds all samples", false},
    {SCENE(fence), "aa=2,aaa=on,asd=2", "aa=2", EFFECT(adaptive_aa),
     "one sample group holds all samples", false},
    {SCENE(fence), "aa=2,aaa=all,asd=2", "aa=2", EFFECT(adaptive_aa),
     "one sample group holds all samples", false},
    {SCENE(lit_sphere), "aa=4,aaa=on", "aa=4", EFFECT(adaptive_aa),
     "the scene has no alpha-clipped surface", false},
    {SCENE(lit_sphere), "aa=4,aaa=coverage", "aa=4", EFFECT(adaptive_aa),
     "the scene has no alpha-clipped surface", false},
    {SCENE(fence), "aa=4,aaa=on", "aa=4", EFFECT(adaptive_aa),
     "no alpha-clipped surface is in view", true},
    {SCENE(fence), "aa=4,aaa=coverage", "aa=4", EFFECT(adaptive_aa),
     "no alpha-clipped surface is in view", true},
    {SCENE(fence), "taa=alternate", "", EFFECT(history), "taa is not history", false},
    {SCENE(fence), "", "", EFFECT(post), "post is off", false},
    {SCENE(fence), "", "", EFFECT(sharpen), "sharpen is off", false},
    {SCENE(fence), "upscale=bicubic", "", EFFECT(upscale), "scale is not below 1", false},
    {SCENE(fence), "upscale=easu", "", EFFECT(upscale), "scale is not below 1", false},
    {SCENE(fence), "scale=1.25,upscale=easu", "scale=1.25", EFFECT(upscale), "scale is not below 1",
     false},
    {SCENE(lights), "", "", EFFECT(shadows), "shadows is off", false},
    {SCENE(fence), "shadows=512", "", EFFECT(shadows), "the scene has no directional light", false},
    {SCENE(fence), "shadows=2048", "", EFFECT(shadows), "the scene has no directional light",
     false},
    {SCENE(sky), "mipdebug=on", "mipdebug=on", EFFECT(sky), "mip colours replace the clouds",
     false},
};

static const Row at_work[] = {
    {SCENE(fence), "aa=4,aaa=on", "aa=4", EFFECT(adaptive_aa),
     "alpha-clipped surfaces are drawn per sample group", false},
    {SCENE(fence), "aa=4,aaa=coverage", "aa=4", EFFECT(adaptive_aa),
     "alpha decides how many samples a clipped surface covers", false},
    {SCENE(lit_sphere), "aa=4,aaa=all", "aa=4", EFFECT(adaptive_aa),
     "all surfaces are drawn per sample group", false},
    {SCENE(fence), "taa=history", "", EFFECT(history),
     "each frame is blended with the frames before it", false},
    {SCENE(fence), "post=fxaa", "", EFFECT(post), "the finished picture is searched for edges",
     false},
    {SCENE(fence), "post=smaa", "", EFFECT(post), "the finished picture is searched for edges",
     false},
    {SCENE(fence), "scale=1/2", "", EFFECT(upscale), "a smaller picture is drawn and enlarged",
     false},
    {SCENE(fence), "sharpen=low", "", EFFECT(sharpen), "the finished picture is sharpened", false},
    {SCENE(lights), "shadows=512", "", EFFECT(shadows),
     "surfaces that the directional light lights are in view", false},
};

// Draws two frames, since the sample patterns of taa=alternate take turns. Returns the second one,
// and the hashes of both.
static DipFrame draw(const Row *row, const char *settings, char hashes[2][33]) {
    static DipTestScene test_scene;
    dip_test_scene_make(&test_scene, row->scene);
    if (row->turned) { // by 180 degrees about the vertical axis
        const double turned[4] = {0.0, 1.0, 0.0, 0.0};
        memcpy(test_scene.pose.orientation, turned, sizeof turned);
    }
    DipRendererDef def = dip_renderer_default_def();
    def.width = WIDTH;
    def.height = HEIGHT;
    assert_true(dip_quality_parse(settings, &def.quality, NULL));
    DipScene *scene = dip_scene_create(&test_scene.def, NULL, NULL);
    DipRenderer *renderer = dip_renderer_create(&def, NULL);
    DipFrame frame = {.rgba8 = NULL};
    for (int i = 0; i < 2; i++) {
        dip_renderer_set_frame_index(renderer, (uint64_t)i);
        assert_true(dip_renderer_draw(renderer, scene, &test_scene.pose, 0, &frame, NULL));
        dip_frame_hash(&frame, hashes[i]);
    }
    frame.rgba8 = NULL; // it is freed with the renderer
    dip_renderer_destroy(&renderer);
    dip_scene_destroy(&scene);
    dip_test_scene_free(&test_scene);
    return frame;
}

static const DipEffect *effect_of(const DipFrame *frame, const Row *row) {
    return (const DipEffect *)(const void *)((const char *)&frame->effects + row->effect);
}

static void inert_steps_say_why_and_do_nothing(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof inert / sizeof *inert; i++) {
        const Row *row = &inert[i];
        char hashes[2][33], others[2][33];
        const DipFrame frame = draw(row, row->settings, hashes);
        const DipFrame without = draw(row, row->without, others);
        if (effect_of(&frame, row)->run || strcmp(effect_of(&frame, row)->why, row->why) != 0) {
            fail_msg("%s in %s: \"%s\" instead of \"%s\"", row->settings,
                     dip_test_scene_name(row->scene), effect_of(&frame, row)->why, row->why);
        }
        if (memcmp(hashes, others, sizeof hashes) != 0 ||
            memcmp(&frame.counters, &without.counters, sizeof frame.counters) != 0) {
            fail_msg("%s in %s has an effect", row->settings, dip_test_scene_name(row->scene));
        }
    }
}

static void steps_at_work_say_so_and_change_the_picture(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof at_work / sizeof *at_work; i++) {
        const Row *row = &at_work[i];
        char hashes[2][33], others[2][33];
        const DipFrame frame = draw(row, row->settings, hashes);
        const DipFrame without = draw(row, row->without, others);
        if (!effect_of(&frame, row)->run || strcmp(effect_of(&frame, row)->why, row->why) != 0) {
            fail_msg("%s in %s: \"%s\" instead of \"%s\"", row->settings,
                     dip_test_scene_name(row->scene), effect_of(&frame, row)->why, row->why);
        }
        assert_true(memcmp(hashes, others, sizeof hashes) != 0);
        assert_true(memcmp(&frame.counters, &without.counters, sizeof frame.counters) != 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(inert_steps_say_why_and_do_nothing),
        cmocka_unit_test(steps_at_work_say_so_and_change_the_picture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
