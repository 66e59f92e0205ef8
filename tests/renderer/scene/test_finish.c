// The settings post and sharpen: a frame with them is the frame without them, filtered by the
// library post; their work is counted, their reasons are given, and without them nothing changes.
#include "renderer/catalogue/scenes.h"
#include "renderer/post/post.h"
#include "renderer/scene/finish.h"
#include "renderer/scene/renderer.h"
#include "tests/renderer/scene/image.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 90, HEIGHT = 67 };

static DipTestScene test_scene;
static DipScene *scene;
static DipRenderer *renderer;

static int set_up(void **state) {
    (void)state;
    dip_test_scene_make(&test_scene, DIP_TEST_SCENE_lit_sphere);
    DipRendererDef def = dip_renderer_default_def();
    def.width = WIDTH;
    def.height = HEIGHT;
    scene = dip_scene_create(&test_scene.def, NULL, NULL);
    renderer = dip_renderer_create(&def, NULL);
    return scene && renderer ? 0 : 1;
}

static int tear_down(void **state) {
    (void)state;
    dip_renderer_destroy(&renderer);
    dip_scene_destroy(&scene);
    dip_test_scene_free(&test_scene);
    return 0;
}

// Draws a frame and copies its pixels.
static DipFrame draw(const char *settings, uint8_t pixels[WIDTH * HEIGHT * 4]) {
    DipQuality quality;
    DipFrame frame;
    assert_true(dip_quality_parse(settings, &quality, NULL));
    assert_true(dip_renderer_set_quality(renderer, &quality, NULL));
    assert_true(dip_renderer_draw(renderer, scene, &test_scene.pose, 0, &frame, NULL));
    dip_image_copy(&frame, pixels);
    return frame;
}

static DipPostWork filter(DipPostFilter kind, float sharpness, const uint8_t *from, uint8_t *to) {
    const DipPostDef def = {.filter = kind,
                            .from_width = WIDTH,
                            .from_height = HEIGHT,
                            .to_width = WIDTH,
                            .to_height = HEIGHT,
                            .sharpness = sharpness,
                            .isa = dip_isa_best()};
    DipPost *post = dip_post_create(&def, NULL);
    assert_non_null(post);
    const DipPostWork work = dip_post_run(post, from, (size_t)WIDTH * 4, to, (size_t)WIDTH * 4);
    dip_post_destroy(&post);
    return work;
}

static uint8_t plain[WIDTH * HEIGHT * 4], drawn[WIDTH * HEIGHT * 4];
static uint8_t smoothed[WIDTH * HEIGHT * 4], sharpened[WIDTH * HEIGHT * 4];

static void frames_are_filtered_in_order(void **state) {
    (void)state;
    static const struct {
        const char *settings;
        int post; // DipPostFilter, or -1
        float sharpness;
    } cases[] = {
        {"post=fxaa", DIP_POST_FXAA, 0.0f},
        {"post=smaa", DIP_POST_SMAA, 0.0f},
        {"sharpen=low", -1, 0.25f},
        {"sharpen=medium", -1, 0.5f},
        {"post=smaa,sharpen=high", DIP_POST_SMAA, 1.0f},
        {"post=fxaa,sharpen=low", DIP_POST_FXAA, 0.25f},
    };
    const DipFrame before = draw("aa=none", plain);
    assert_int_equal(before.counters.pixels_filtered, 0);
    assert_false(before.effects.post.run || before.effects.sharpen.run);
    assert_string_equal(before.effects.post.why, "post is off");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        uint64_t edges = 0, filters = 0;
        memcpy(smoothed, plain, sizeof plain);
        if (cases[i].post >= 0) {
            edges = filter((DipPostFilter)cases[i].post, 0.0f, plain, smoothed).edges_found;
            filters++;
        }
        memcpy(sharpened, smoothed, sizeof smoothed);
        if (cases[i].sharpness > 0.0f) {
            filter(DIP_POST_SHARPEN, cases[i].sharpness, smoothed, sharpened);
            filters++;
        }
        const DipFrame frame = draw(cases[i].settings, drawn);
        assert_memory_equal(drawn, sharpened, sizeof drawn);
        assert_memory_not_equal(drawn, plain, sizeof drawn);
        assert_int_equal(frame.counters.pixels_filtered, filters * WIDTH * HEIGHT);
        assert_int_equal(frame.counters.edges_found, edges);
        assert_int_equal(frame.effects.post.run, cases[i].post >= 0);
        assert_int_equal(frame.effects.sharpen.run, cases[i].sharpness > 0.0f);
    }
    draw("aa=none", drawn);
    assert_memory_equal(drawn, plain, sizeof drawn);
}

// A frame is filtered in its new size after a resize.
static void filters_follow_the_size(void **state) {
    (void)state;
    DipQuality quality;
    DipFrame frame;
    assert_true(dip_quality_parse("post=smaa,sharpen=low", &quality, NULL));
    assert_true(dip_renderer_set_quality(renderer, &quality, NULL));
    for (int width = WIDTH; width > WIDTH - 20; width -= 7) {
        assert_true(dip_renderer_resize(renderer, width, HEIGHT, NULL));
        assert_true(dip_renderer_draw(renderer, scene, &test_scene.pose, 0, &frame, NULL));
        assert_int_equal(frame.width, width);
        assert_int_equal(frame.counters.pixels_filtered, 2 * width * HEIGHT);
    }
    assert_true(dip_renderer_resize(renderer, WIDTH, HEIGHT, NULL));
}

// What the library post refuses is refused with its own error, for a history and for filters.
static void what_cannot_be_filtered_is_refused(void **state) {
    (void)state;
    static const char *const settings[] = {"taa=history", "post=fxaa", "sharpen=low"};
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        for (int bad_size = 0; bad_size < 2; bad_size++) {
            DipQuality quality;
            DipError err = {0};
            assert_true(dip_quality_parse(settings[i], &quality, NULL));
            const DipFinishSize size = dip_finish_size(&quality, bad_size ? 0 : WIDTH, HEIGHT);
            DipFinish *finish =
                dip_finish_create(NULL, bad_size ? dip_isa_best() : DIP_ISA_COUNT, NULL);
            assert_non_null(finish);
            assert_false(dip_finish_follow(finish, &quality, &size, &err));
            assert_int_equal(err.code, bad_size ? DIP_ERROR_RANGE : DIP_ERROR_UNSUPPORTED);
            assert_null(dip_finish_depths(finish));
            dip_finish_destroy(&finish);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_are_filtered_in_order),
        cmocka_unit_test(filters_follow_the_size),
        cmocka_unit_test(what_cannot_be_filtered_is_refused),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
