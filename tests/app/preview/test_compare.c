// Tests of the comparisons: where pictures show, what the difference is, and what a wipe shows on
// both sides of its divider.
#include "app/preview/tools/compare.h"
#include "app/preview/tools/strip.h"
#include "tests/app/preview/tool_window.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { PANE_WIDTH = 300, PANE_HEIGHT = 200, DOCK = 180 };

static DipToolWindow tw;

static int open_window(void **state) {
    (void)state;
    dip_tool_window_open(&tw, DIP_TEST_SCENE_cube_on_plane, PANE_WIDTH, PANE_HEIGHT, DOCK);
    tw.state.tools.tab = DIP_TAB_COMPARE;
    return 0;
}

static int close_window(void **state) {
    (void)state;
    dip_tool_window_close(&tw);
    return 0;
}

// --- where pictures show -------------------------------------------------------------------------

static void test_one_picture_fits_by_whole_factors(void **state) {
    (void)state;
    static const struct {
        DipRect area;
        int width, height;
        DipRect shown;
    } cases[] = {
        {{0, 0, 1282, 480}, 640, 480, {321, 0, 640, 480}},
        {{0, 0, 1282, 480}, 1282, 480, {0, 0, 1282, 480}},
        {{10, 20, 400, 300}, 100, 100, {60, 20, 300, 300}},
        {{0, 0, 100, 100}, 400, 200, {0, 25, 100, 50}},
        {{0, 0, 100, 100}, 200, 400, {25, 0, 50, 100}},
        {{0, 0, 100, 1}, 8000, 1, {0, 0, 100, 1}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const DipRect shown = dip_compare_fit(cases[i].area, cases[i].width, cases[i].height);
        assert_true(dip_rect_equals(shown, cases[i].shown));
    }
}

static void test_frame_size_is_the_room_of_the_picture(void **state) {
    (void)state;
    int width, height;
    dip_compare_frame_size(&tw.layout, DIP_COMPARE_SIDE_BY_SIDE, &width, &height);
    assert_true(width == PANE_WIDTH && height == PANE_HEIGHT);
    static const DipComparison of_one_picture[] = {DIP_COMPARE_WIPE, DIP_COMPARE_BLINK,
                                                   DIP_COMPARE_DIFFERENCE, DIP_COMPARE_ALONE};
    for (int i = 0; i < 4; i++) {
        dip_compare_frame_size(&tw.layout, of_one_picture[i], &width, &height);
        assert_true(width == 2 * PANE_WIDTH + DIP_PANE_GAP_PX && height == PANE_HEIGHT);
    }
}

// --- the difference ------------------------------------------------------------------------------

// The converged picture takes the current pane's place in a wipe, a blink and a difference.
static void test_truth_is_compared_with_the_requested_pane(void **state) {
    (void)state;
    static uint8_t grey[4 * PANE_WIDTH * PANE_HEIGHT];
    static const DipPixels truth = {grey, 4 * PANE_WIDTH, PANE_WIDTH, PANE_HEIGHT};
    static const DipComparison comparisons[] = {DIP_COMPARE_WIPE, DIP_COMPARE_BLINK,
                                                DIP_COMPARE_DIFFERENCE, DIP_COMPARE_TRUTH};
    memset(grey, 77, sizeof grey);
    tw.state.tools.against_truth = true;
    for (int i = 0; i < 4; i++) {
        uint64_t version;
        tw.state.tools.comparison = comparisons[i];
        assert_true(dip_compare_wants_truth(&tw.state.tools));
        tw.window.truth = NULL; // It is not known yet.
        assert_ptr_equal(dip_compare_picture(&tw.window, DIP_PANE_CURRENT, &version),
                         &tw.window.frames[DIP_PANE_CURRENT]);
        tw.window.truth = &truth;
        tw.window.truth_version = 999;
        assert_ptr_equal(dip_compare_picture(&tw.window, DIP_PANE_CURRENT, &version), &truth);
        assert_true(version == 999);
        assert_ptr_equal(dip_compare_picture(&tw.window, DIP_PANE_REQUESTED, &version),
                         &tw.window.frames[DIP_PANE_REQUESTED]);
    }
    tw.state.tools.comparison = DIP_COMPARE_WIPE;
    tw.state.tools.bare = true;
    dip_tool_window_draw(&tw);
    const DipRect left = dip_compare_visible(&tw.window, DIP_PANE_CURRENT);
    const uint8_t *pixel = dip_tool_window_pixel(&tw, left.x + 2, left.y + 2);
    assert_true(pixel[0] == 77 && pixel[1] == 77 && pixel[2] == 77);
    tw.state.tools.against_truth = false;
    assert_false(dip_compare_wants_truth(&tw.state.tools));
}

static void test_difference_equals_a_plain_loop(void **state) {
    (void)state;
    enum { W = 37, H = 11, STRIDE = 4 * (W + 3) };
    static uint8_t a[H * STRIDE], b[H * STRIDE], out[4 * W * H];
    uint32_t random = 7;
    for (size_t i = 0; i < sizeof a; i++) {
        random = random * 1664525u + 1013904223u;
        a[i] = (uint8_t)(random >> 24);
        b[i] = random >> 20 & 3 ? a[i] : (uint8_t)(random >> 8);
    }
    const DipPixels left = {a, STRIDE, W, H};
    const DipPixels right = {b, STRIDE, W, H};
    for (int gain = 1; gain <= DIP_COMPARE_MAX_GAIN; gain *= 2) {
        const DipDifference found = dip_compare_difference(&left, &right, gain, out);
        int differing = 0, greatest = 0;
        for (int y = 0; y < H; y++) {
            for (int x = 0; x < W; x++) {
                bool differs = false;
                for (int c = 0; c < 3; c++) {
                    const size_t at = (size_t)(y * STRIDE + 4 * x + c);
                    const int d = (int)fabs((double)a[at] - (double)b[at]);
                    assert_int_equal(out[4 * (y * W + x) + c], d * gain < 255 ? d * gain : 255);
                    differs = differs || d;
                    greatest = d > greatest ? d : greatest;
                }
                assert_int_equal(out[4 * (y * W + x) + 3], 255);
                differing += differs;
            }
        }
        assert_int_equal(found.pixels, W * H);
        assert_int_equal(found.differing, differing);
        assert_int_equal(found.greatest, greatest);
        const size_t at = (size_t)(found.y * STRIDE + 4 * found.x);
        int there = 0;
        for (int c = 0; c < 3; c++) {
            there = abs(a[at + (size_t)c] - b[at + (size_t)c]) > there
                        ? abs(a[at + (size_t)c] - b[at + (size_t)c])
                        : there;
        }
        assert_int_equal(there, greatest);
    }
    assert_int_equal(dip_compare_difference(&left, &left, 64, out).differing, 0);
}

static void test_difference_is_computed_only_when_pictures_change(void **state) {
    (void)state;
    DipPixels picture;
    uint64_t first, again;
    DipComparer *compare = &tw.tools->compare;
    assert_non_null(dip_compare_make_difference(compare, &tw.window, &picture, &first));
    assert_non_null(dip_compare_make_difference(compare, &tw.window, &picture, &again));
    assert_true(first == again);
    tw.state.tools.gain = 8;
    assert_non_null(dip_compare_make_difference(compare, &tw.window, &picture, &again));
    assert_true(first != again);
    dip_tool_window_draw_frames(&tw, "aa=4", "aa=4", 1);
    const DipDifference *same = dip_compare_make_difference(compare, &tw.window, &picture, &first);
    assert_true(first != again && same->differing == 0);
}

// --- pictures ------------------------------------------------------------------------------------

static void show(DipComparison comparison, double divider) {
    tw.state.tools.comparison = comparison;
    tw.state.tools.divider = divider;
    tw.state.tools.bare = true; // no line over the pictures
    dip_tool_window_draw(&tw);
}

// Asserts that columns first..last-1 of the one picture show a pane's columns.
static void assert_columns(int pane, int first, int last) {
    const DipRect shown = dip_compare_shown(&tw.window, pane);
    const int factor = shown.width / tw.window.frames[pane].width;
    for (int y = 0; y < tw.window.frames[pane].height; y++) {
        for (int x = first; x < last; x++) {
            assert_memory_equal(
                dip_tool_window_pixel(&tw, shown.x + factor * x, shown.y + factor * y),
                dip_tool_window_frame_pixel(&tw, pane, x, y), 3);
        }
    }
}

static void test_wipe_shows_each_pane_on_its_side(void **state) {
    (void)state;
    static const double dividers[] = {0.0, 0.001, 0.25, 0.5, 0.77, 0.999, 1.0, 0.5};
    for (size_t i = 0; i < sizeof dividers / sizeof *dividers; i++) {
        show(DIP_COMPARE_WIPE, dividers[i]);
        const int column = (int)floor(dividers[i] * PANE_WIDTH + 0.5);
        assert_int_equal(dip_compare_divider_column(dividers[i], PANE_WIDTH), column);
        assert_columns(DIP_PANE_CURRENT, 0, column);
        assert_columns(DIP_PANE_REQUESTED, column, PANE_WIDTH);
    }
}

static void test_wipe_of_small_frames_is_enlarged_by_whole_factors(void **state) {
    (void)state;
    dip_tool_window_draw_frames(&tw, "aa=none", "aa=8", 2);
    show(DIP_COMPARE_WIPE, 0.3);
    const int column = (int)floor(0.3 * PANE_WIDTH / 2 + 0.5);
    assert_columns(DIP_PANE_CURRENT, 0, column);
    assert_columns(DIP_PANE_REQUESTED, column, PANE_WIDTH / 2);
}

static void test_every_comparison_leaves_no_trace_of_the_one_before(void **state) {
    (void)state;
    const size_t bytes = 4 * (size_t)tw.layout.width * PANE_HEIGHT;
    uint8_t *drawn = malloc(bytes);
    assert_non_null(drawn);
    for (int from = 0; from < DIP_COMPARISON_COUNT; from++) {
        for (int to = 0; to < DIP_COMPARISON_COUNT; to++) {
            show((DipComparison)from, 0.5);
            show((DipComparison)to, 0.5);
            memcpy(drawn, tw.canvas.rgba8, bytes);
            dip_draw_list_destroy(&tw.list); // a new list draws the whole window
            tw.list = dip_draw_list_create(tw.font, NULL);
            show((DipComparison)to, 0.5);
            assert_memory_equal(drawn, tw.canvas.rgba8, bytes);
        }
    }
    free(drawn);
}

static void test_blink_and_alone_show_one_pane(void **state) {
    (void)state;
    show(DIP_COMPARE_BLINK, 0.5);
    assert_columns(DIP_PANE_CURRENT, 0, PANE_WIDTH);
    tw.state.tools.blinked = true;
    show(DIP_COMPARE_BLINK, 0.5);
    assert_columns(DIP_PANE_REQUESTED, 0, PANE_WIDTH);
    tw.state.tools.blinked = false;
    tw.state.tools.blinks = true;
    assert_true(dip_compare_wakes_ns(&tw.state.tools, 1) == 500000000);
    tw.now_ns = 700000000;
    show(DIP_COMPARE_BLINK, 0.5);
    assert_columns(DIP_PANE_REQUESTED, 0, PANE_WIDTH);
    tw.now_ns = 1200000000;
    show(DIP_COMPARE_BLINK, 0.5);
    assert_columns(DIP_PANE_CURRENT, 0, PANE_WIDTH);
    show(DIP_COMPARE_ALONE, 0.5);
    assert_columns(DIP_PANE_REQUESTED, 0, PANE_WIDTH);
    tw.state.edited[DIP_PANE_REQUESTED] = false;
    show(DIP_COMPARE_ALONE, 0.5);
    assert_columns(DIP_PANE_CURRENT, 0, PANE_WIDTH);
}

static void test_truth_takes_the_current_panes_room(void **state) {
    (void)state;
    show(DIP_COMPARE_TRUTH, 0.5);
    assert_columns(DIP_PANE_CURRENT, 0, PANE_WIDTH); // not known yet
    uint8_t *grey = malloc(4 * PANE_WIDTH * PANE_HEIGHT);
    assert_non_null(grey);
    memset(grey, 77, 4 * PANE_WIDTH * PANE_HEIGHT);
    const DipPixels truth = {grey, 4 * PANE_WIDTH, PANE_WIDTH, PANE_HEIGHT};
    tw.window.truth = &truth;
    tw.window.truth_version = UINT64_C(7) << 60;
    show(DIP_COMPARE_TRUTH, 0.5);
    assert_int_equal(dip_tool_window_pixel(&tw, 0, 0)[0], 77);
    assert_int_equal(dip_tool_window_pixel(&tw, PANE_WIDTH - 1, PANE_HEIGHT - 1)[2], 77);
    assert_columns(DIP_PANE_REQUESTED, 0, PANE_WIDTH);
    free(grey);
}

// --- the mouse -----------------------------------------------------------------------------------

static void test_divider_is_dragged_and_stays_in_the_picture(void **state) {
    (void)state;
    show(DIP_COMPARE_WIPE, 0.5);
    const DipRect shown = dip_compare_shown(&tw.window, 0);
    dip_tool_window_mouse(&tw, DIP_EVENT_MOUSE_DOWN, DIP_MOUSE_LEFT, shown.x + 140, 50);
    dip_tool_window_mouse(&tw, DIP_EVENT_MOUSE_MOVE, DIP_MOUSE_LEFT, shown.x + 74, 60);
    assert_true(fabs(tw.state.tools.divider - 74.5 / PANE_WIDTH) < 1e-12);
    dip_tool_window_mouse(&tw, DIP_EVENT_MOUSE_MOVE, DIP_MOUSE_LEFT, tw.layout.width + 400, 60);
    assert_true(tw.state.tools.divider >= 1.0 && tw.state.tools.divider <= 1.0);
    dip_tool_window_mouse(&tw, DIP_EVENT_MOUSE_UP, DIP_MOUSE_LEFT, 0, 60);
    dip_tool_window_mouse(&tw, DIP_EVENT_MOUSE_MOVE, DIP_MOUSE_LEFT, shown.x + 10, 60);
    assert_true(tw.state.tools.divider >= 1.0);
    // The right button flies the camera, from the first pixel on.
    dip_tool_window_mouse(&tw, DIP_EVENT_MOUSE_DOWN, DIP_MOUSE_RIGHT, shown.x + 140, 50);
    dip_tool_window_mouse(&tw, DIP_EVENT_MOUSE_MOVE, DIP_MOUSE_RIGHT, shown.x + 138, 50);
    dip_tool_window_mouse(&tw, DIP_EVENT_MOUSE_UP, DIP_MOUSE_RIGHT, shown.x + 138, 50);
    assert_true(tw.state.tools.divider >= 1.0);
}

static void test_position_tells_the_pane_and_the_pixel(void **state) {
    (void)state;
    int pane, x, y;
    show(DIP_COMPARE_WIPE, 0.5);
    const DipRect shown = dip_compare_shown(&tw.window, 0);
    assert_true(dip_compare_pixel_at(&tw.window, shown.x + 149, 9, &pane, &x, &y));
    assert_true(pane == DIP_PANE_CURRENT && x == 149 && y == 9);
    assert_true(dip_compare_pixel_at(&tw.window, shown.x + 150, 9, &pane, &x, &y));
    assert_true(pane == DIP_PANE_REQUESTED && x == 150 && y == 9);
    assert_false(dip_compare_pixel_at(&tw.window, shown.x - 1, 9, &pane, &x, &y));
    show(DIP_COMPARE_SIDE_BY_SIDE, 0.5);
    assert_true(dip_compare_pixel_at(&tw.window, PANE_WIDTH + DIP_PANE_GAP_PX, 0, &pane, &x, &y));
    assert_true(pane == DIP_PANE_REQUESTED && x == 0 && y == 0);
    assert_false(dip_compare_pixel_at(&tw.window, PANE_WIDTH, 0, &pane, &x, &y)); // the gap
}

static void test_brackets_act_on_what_shows(void **state) {
    (void)state;
    DipToolState tools = {.comparison = DIP_COMPARE_WIPE, .divider = 0.5};
    assert_true(dip_tool_state_adjust(&tools, -8));
    assert_true(fabs(tools.divider - 0.375) < 1e-12);
    dip_tool_state_adjust(&tools, -1000);
    assert_true(tools.divider <= 0.0);
    tools.comparison = DIP_COMPARE_DIFFERENCE;
    dip_tool_state_adjust(&tools, 3);
    assert_int_equal(tools.gain, 8);
    dip_tool_state_adjust(&tools, 30);
    assert_int_equal(tools.gain, DIP_COMPARE_MAX_GAIN);
    dip_tool_state_adjust(&tools, -30);
    assert_int_equal(tools.gain, 1);
    tools.comparison = DIP_COMPARE_SIDE_BY_SIDE;
    assert_false(dip_tool_state_adjust(&tools, 1));
    tools.map = DIP_MAP_TIME;
    assert_true(dip_tool_state_adjust(&tools, 2));
    assert_int_equal(tools.brightness, 4);
    tools.comparison = DIP_COMPARE_DIFFERENCE; // The difference hides the map.
    dip_tool_state_adjust(&tools, 1);
    assert_int_equal(tools.gain, 2);
    assert_int_equal(tools.brightness, 4);
}

// The keys [ and ] and the slider of the tab move the divider by the same step, and change the gain
// alike. Side by side, they change nothing.
static void test_keys_step_as_the_slider_does(void **state) {
    (void)state;
    for (int comparison = 0; comparison < DIP_COMPARISON_COUNT; ++comparison) {
        for (int back = 0; back < 2; ++back) {
            DipToolState expected = {
                .comparison = (DipComparison)comparison, .divider = 0.5, .gain = 8};
            tw.state.tools = expected;
            dip_tool_state_adjust(&expected, back ? -1 : 1);
            dip_preview_act(&tw.state, DIP_ACTION_ADJUST, 0, back, 0);
            assert_memory_equal(&tw.state.tools, &expected, sizeof expected);
        }
    }
}

// --- the strip -----------------------------------------------------------------------------------

static void test_strip_is_drawn_one_thumbnail_at_a_time(void **state) {
    (void)state;
    DipStrip *strip = &tw.tools->strip;
    for (int i = 0; i < DIP_STRIP_COUNT; i++) {
        dip_tool_window_draw(&tw);
        assert_true(dip_tool_window_update(&tw));
        assert_int_equal(dip_strip_thumbnail(strip, i).time_ns, i * INT64_C(1000000000));
        assert_true(dip_strip_thumbnail(strip, i).picture.width > 0);
        for (int later = i + 1; later < DIP_STRIP_COUNT; later++) {
            assert_int_equal(dip_strip_thumbnail(strip, later).picture.width, 0);
        }
        assert_true((strip->painter != NULL) == (i + 1 < DIP_STRIP_COUNT));
    }
    dip_tool_window_draw(&tw);
    assert_false(dip_tool_window_update(&tw));
    // A thumbnail is the frame of that time, drawn at the thumbnail's size.
    const DipThumbnail third = dip_strip_thumbnail(strip, 3);
    assert_true(dip_camtrack_pose(&tw.session.track, third.time_ns, &tw.pose));
    DipFrame frame;
    DipPainter *painter = tw.session.renderers[0];
    assert_true(dip_painter_resize(painter, third.picture.width, third.picture.height, NULL));
    assert_true(dip_painter_draw(painter, tw.session.scene, &tw.pose, third.time_ns, &frame, NULL));
    for (int y = 0; y < frame.height; y++) {
        assert_memory_equal(third.picture.rgba8 + (size_t)y * third.picture.stride_bytes,
                            frame.rgba8 + (size_t)y * frame.stride_bytes, 4 * (size_t)frame.width);
    }
}

// While nobody looks at an incomplete strip, it keeps its thumbnails but no painter.
static void test_a_hidden_strip_keeps_no_painter(void **state) {
    (void)state;
    DipStrip *strip = &tw.tools->strip;
    for (int i = 0; i < 3; i++) {
        dip_tool_window_draw(&tw);
        assert_true(dip_tool_window_update(&tw));
    }
    assert_non_null(strip->painter);
    tw.state.tools.tab = DIP_TAB_LOUPE;
    dip_tool_window_draw(&tw);
    dip_tool_window_update(&tw);
    assert_null(strip->painter);
    tw.state.tools.tab = DIP_TAB_COMPARE;
    dip_tool_window_draw(&tw);
    assert_true(dip_tool_window_update(&tw));
    assert_int_equal(strip->drawn, 4);
}

int main(void) {
#define IN_WINDOW(test) cmocka_unit_test_setup_teardown(test, open_window, close_window)
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_one_picture_fits_by_whole_factors),
        IN_WINDOW(test_frame_size_is_the_room_of_the_picture),
        IN_WINDOW(test_truth_is_compared_with_the_requested_pane),
        cmocka_unit_test(test_difference_equals_a_plain_loop),
        IN_WINDOW(test_difference_is_computed_only_when_pictures_change),
        IN_WINDOW(test_wipe_shows_each_pane_on_its_side),
        IN_WINDOW(test_wipe_of_small_frames_is_enlarged_by_whole_factors),
        IN_WINDOW(test_every_comparison_leaves_no_trace_of_the_one_before),
        IN_WINDOW(test_blink_and_alone_show_one_pane),
        IN_WINDOW(test_truth_takes_the_current_panes_room),
        IN_WINDOW(test_divider_is_dragged_and_stays_in_the_picture),
        IN_WINDOW(test_position_tells_the_pane_and_the_pixel),
        cmocka_unit_test(test_brackets_act_on_what_shows),
        IN_WINDOW(test_keys_step_as_the_slider_does),
        IN_WINDOW(test_strip_is_drawn_one_thumbnail_at_a_time),
        IN_WINDOW(test_a_hidden_strip_keeps_no_painter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
