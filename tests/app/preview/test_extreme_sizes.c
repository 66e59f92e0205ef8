// Runs the preview on a fake display of the smallest and the largest sizes. Usage:
// test_extreme_sizes [--big]. With --big, the panes have 8192x8192 pixels and more; this takes 3 GB
// of memory.
#include "app/preview/loop/view.h"
#include "tests/app/preview/made_preview.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 402, HEIGHT = 300 };

static void open_preview(bool hides_panel) {
    static const char *const settings[DIP_PANE_COUNT] = {"aa=none", "aa=8,af=16"};
    DipRendererDef painters[DIP_PANE_COUNT];
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        painters[p] = dip_renderer_default_def();
        assert_true(dip_quality_parse(settings[p], &painters[p].quality, NULL));
    }
    dip_made_open_session(2, 1, painters);
    dip_made_open_display(WIDTH, HEIGHT);
    assert_true(dip_made_create_preview(&(DipPreviewDef){.hides_panel = hides_panel}, NULL));
}

static int set_up(void **state) {
    (void)state;
    open_preview(false);
    return 0;
}

// The panes are as high as the display.
static int set_up_without_dock(void **state) {
    (void)state;
    open_preview(true);
    return 0;
}

// Shows a size, and every sheet over it.
static void show(int width, int height) {
    static const DipKeycode keys[] = {DIP_KEYCODE_F1, DIP_KEYCODE_F1, 'r', 'r', 'u', 'u',
                                      DIP_KEYCODE_TAB};
    assert_true(dip_fake_display_resize(made.fake, width, height));
    dip_made_turn_shown();
    assert_int_equal(dip_preview_picture(made.preview).width, width);
    assert_int_equal(dip_preview_picture(made.preview).height, height);
    for (size_t i = 0; i < sizeof keys / sizeof *keys; ++i) {
        dip_made_press(keys[i]);
        dip_fake_display_click(made.fake, DIP_MOUSE_LEFT, width - 1, height - 1, 1);
        dip_made_turn_shown();
    }
}

// Pauses, and lets notices go away and the figures settle.
static void rest(void) {
    for (int i = 0; i < 400; ++i) {
        dip_made_turn_shown();
    }
}

// Returns a copy of the shown picture.
static uint8_t *copy_shown(void) {
    const DipPixels shown = dip_fake_display_picture(made.fake);
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
    dip_made_press(DIP_KEYCODE_SPACE);
    rest();
    uint8_t *before = copy_shown();
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; ++i) {
        show(sizes[i][0], sizes[i][1]);
    }
    assert_true(dip_fake_display_resize(made.fake, WIDTH, HEIGHT));
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
    const DipPixels shown = dip_fake_display_picture(made.fake);
    const DipLayout layout = dip_preview_layout(made.preview);
    const DipRect *panes = layout.panes;
    const int64_t to_x =
        panes[pane].x + (2 * (int64_t)x + 1) * panes[pane].width / (2 * frame_width);
    const int64_t to_y = (2 * (int64_t)y + 1) * panes[pane].height / (2 * frame_height);
    return shown.rgba8 + (size_t)to_y * shown.stride_bytes + 4 * (size_t)to_x;
}

// Draws the current pane's frame again, and compares a sample of its pixels with the display.
static void compare_pane(void) {
    DipFrame frame;
    DipPose pose = made.scene.pose;
    pose.fov_y_deg = 60.0;
    assert_true(dip_painter_draw(made.session.renderers[DIP_PANE_CURRENT], made.session.scene,
                                 &pose, dip_preview_state(made.preview)->play_ns, &frame, NULL));
    assert_int_equal(frame.width, DIP_MAX_FRAME_SIZE);
    assert_int_equal(frame.height, DIP_MAX_FRAME_SIZE);
    for (int y = 2000; y < 7900; y += 61) { // The button that shows the panel is further down.
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
    dip_made_press(DIP_KEYCODE_SPACE);
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; ++i) {
        assert_true(dip_fake_display_resize(made.fake, sizes[i][0], sizes[i][1]));
        dip_made_turn_shown();
        dip_made_turn_shown();
        compare_pane();
    }
}

int main(int argc, char **argv) {
    const struct CMUnitTest small[] = {cmocka_unit_test_setup_teardown(
        small_displays_show_and_leave_nothing_behind, set_up, dip_made_tear_down)};
    const struct CMUnitTest big[] = {cmocka_unit_test_setup_teardown(
        large_displays_show_large_panes, set_up_without_dock, dip_made_tear_down)};
    return argc > 1 && strcmp(argv[1], "--big") == 0 ? cmocka_run_group_tests(big, NULL, NULL)
                                                     : cmocka_run_group_tests(small, NULL, NULL);
}
