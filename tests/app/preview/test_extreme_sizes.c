// Runs the preview on a fake display of the smallest and the largest sizes. Usage:
// test_extreme_sizes [--big]. With --big, the panes have 8192x8192 pixels and more; this takes 3 GB
// of memory.
#include "tests/app/display/fake_display.h"
#include "app/preview/loop/loop.h"
#include "app/preview/loop/view.h"
#include "config/config.h"
#include "renderer/catalogue/scenes.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 402, HEIGHT = 300 };

static DipTestScene scene;
static DipSession session;
static DipCamPath *path;
static DipDisplay display;
static DipFakeDisplay *fake;
static DipPreview *preview;

static bool load_scene_def(DipSession *unused, DipError *err) {
    (void)unused;
    (void)err;
    session.scene_def = scene.def;
    return true;
}

// Makes a path with a single key.
static void make_path(void) {
    DipCamKey key;
    memcpy(key.position_world, scene.pose.position_world, sizeof key.position_world);
    memcpy(key.orientation, scene.pose.orientation, sizeof key.orientation);
    assert_true(dip_campath_create(&key, 1, INT64_C(5000000000), &path, NULL));
    session.track = dip_camtrack_make(true);
    dip_camtrack_set(&session.track, DIP_CATEGORY_DEFAULT, path, 60.0);
}

static int set_up(void **state) {
    (void)state;
    dip_test_scene_make(&scene, DIP_TEST_SCENE_grazing_checker);
    session = (DipSession){.pool = dip_pool_create(2, NULL)};
    session.scene = dip_scene_create(&scene.def, NULL, NULL);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        DipRendererDef def = dip_renderer_default_def();
        def.pool = session.pool;
        assert_true(dip_quality_parse(p ? "aa=8,af=16" : "aa=none", &def.quality, NULL));
        session.renderers[p] = dip_painter_create(&def, NULL, NULL);
        assert_non_null(session.renderers[p]);
    }
    make_path();
    fake = dip_fake_display_open(&display, WIDTH, HEIGHT);
    const DipPreviewDef def = {.session = &session,
                               .display = display,
                               .flying_speed_m_per_s = 1.0,
                               .load_scene_def = load_scene_def};
    preview = dip_preview_create(&def, NULL);
    assert_true(session.scene && fake && preview);
    return 0;
}

static int tear_down(void **state) {
    (void)state;
    dip_preview_destroy(&preview);
    display.close(display.context);
    dip_campath_destroy(&path);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        dip_painter_destroy(&session.renderers[p]);
    }
    dip_scene_destroy(&session.scene);
    dip_pool_destroy(&session.pool);
    dip_test_scene_free(&scene);
    return 0;
}

// Runs a turn. The display must show the whole picture that the preview drew.
static void turn(void) {
    DipError err = {0};
    if (!dip_preview_turn(preview, &err)) {
        fail_msg("%s", err.message);
    }
    const DipPixels shown = dip_fake_display_picture(fake);
    const DipPixels drawn = dip_preview_picture(preview);
    assert_int_equal(shown.width, drawn.width);
    assert_int_equal(shown.height, drawn.height);
    assert_memory_equal(shown.rgba8, drawn.rgba8, 4 * (size_t)shown.width * (size_t)shown.height);
}

static void press(DipKeycode key) {
    dip_fake_display_press(fake, key, 0);
    turn();
}

// Shows a size, and every sheet over it.
static void show(int width, int height) {
    static const DipKeycode keys[] = {DIP_KEYCODE_F1, DIP_KEYCODE_F1, 'r', 'r', 'u', 'u',
                                      DIP_KEYCODE_TAB};
    assert_true(dip_fake_display_resize(fake, width, height));
    turn();
    assert_int_equal(dip_preview_picture(preview).width, width);
    assert_int_equal(dip_preview_picture(preview).height, height);
    for (size_t i = 0; i < sizeof keys / sizeof *keys; ++i) {
        press(keys[i]);
        dip_fake_display_click(fake, DIP_MOUSE_LEFT, width - 1, height - 1, 1);
        turn();
    }
}

// Pauses, and lets notices go away and the figures settle.
static void rest(void) {
    for (int i = 0; i < 400; ++i) {
        turn();
    }
}

// Returns a copy of the shown picture.
static uint8_t *copy_shown(void) {
    const DipPixels shown = dip_fake_display_picture(fake);
    const size_t bytes = 4 * (size_t)shown.width * (size_t)shown.height;
    uint8_t *copy = malloc(bytes);
    assert_non_null(copy);
    memcpy(copy, shown.rgba8, bytes);
    return copy;
}

// The rows that neither a label nor the status line covers, of the display of WIDTH x HEIGHT.
enum { FIRST_ROW = 80, LAST_ROW = 270 };

static void small_displays_show_and_leave_nothing_behind(void **state) {
    (void)state;
    static const int sizes[][2] = {{1, 1}, {2, 1},   {3, 1},   {4, 2},     {5, 1},   {1, 300},
                                   {6, 6}, {7, 333}, {402, 1}, {16386, 1}, {1, 8192}};
    press(DIP_KEYCODE_SPACE);
    rest();
    uint8_t *before = copy_shown();
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; ++i) {
        show(sizes[i][0], sizes[i][1]);
    }
    assert_true(dip_fake_display_resize(fake, WIDTH, HEIGHT));
    rest();
    uint8_t *after = copy_shown();
    const size_t row_bytes = 4 * (size_t)WIDTH;
    assert_memory_equal(before + FIRST_ROW * row_bytes, after + FIRST_ROW * row_bytes,
                        (LAST_ROW - FIRST_ROW) * row_bytes);
    free(before);
    free(after);
}

// Returns the pixel of a pane that shows the pixel (x, y) of the pane's frame.
static const uint8_t *pane_pixel(int pane, int frame_width, int frame_height, int x, int y) {
    const DipPixels shown = dip_fake_display_picture(fake);
    const DipLayout layout = dip_preview_layout(preview);
    const DipRect *panes = layout.panes;
    const int64_t to_x =
        panes[pane].x + (2 * (int64_t)x + 1) * panes[pane].width / (2 * frame_width);
    const int64_t to_y = (2 * (int64_t)y + 1) * panes[pane].height / (2 * frame_height);
    return shown.rgba8 + (size_t)to_y * shown.stride_bytes + 4 * (size_t)to_x;
}

// Draws the current pane's frame again, and compares a sample of its pixels with the display.
static void compare_pane(void) {
    DipFrame frame;
    DipPose pose = scene.pose;
    pose.fov_y_deg = 60.0;
    assert_true(dip_painter_draw(session.renderers[DIP_PANE_CURRENT], session.scene, &pose,
                                 dip_preview_state(preview)->play_ns, &frame, NULL));
    assert_int_equal(frame.width, DIP_MAX_FRAME_SIZE);
    assert_int_equal(frame.height, DIP_MAX_FRAME_SIZE);
    for (int y = 2000; y < 8000; y += 61) {
        for (int x = 13; x < frame.width; x += 67) {
            assert_memory_equal(pane_pixel(DIP_PANE_CURRENT, frame.width, frame.height, x, y),
                                frame.rgba8 + (size_t)y * frame.stride_bytes + 4 * (size_t)x, 4);
        }
    }
}

// A pane has at most 8192x8192 pixels. On a larger display, it is scaled up.
static void large_displays_show_large_panes(void **state) {
    (void)state;
    static const int sizes[][2] = {{16386, 8192}, {16800, 8300}};
    press(DIP_KEYCODE_SPACE);
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; ++i) {
        assert_true(dip_fake_display_resize(fake, sizes[i][0], sizes[i][1]));
        turn();
        turn();
        compare_pane();
    }
}

int main(int argc, char **argv) {
    const struct CMUnitTest small[] = {cmocka_unit_test_setup_teardown(
        small_displays_show_and_leave_nothing_behind, set_up, tear_down)};
    const struct CMUnitTest big[] = {
        cmocka_unit_test_setup_teardown(large_displays_show_large_panes, set_up, tear_down)};
    return argc > 1 && strcmp(argv[1], "--big") == 0 ? cmocka_run_group_tests(big, NULL, NULL)
                                                     : cmocka_run_group_tests(small, NULL, NULL);
}
