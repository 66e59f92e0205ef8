// Tests of the loupe: which pixels it shows, what the crops look like, how it follows the pointer,
// and the samples that it reads.
#include "app/preview/tools/compare.h"
#include "app/preview/tools/loupe.h"
#include "tests/app/preview/tool_window.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static DipToolWindow tw;

// --- arithmetic --------------------------------------------------------------------------------

// The pixel of the picture that a crop shows at a position of its frame, by division alone: the
// looked-at pixel covers the middle square, and every square is zoom pixels wide.
static int column_at(int looked_at, int columns, int zoom, int position) {
    return looked_at - (columns - 1) / 2 + (int)floor((double)position / zoom);
}

static void check_crop(int width, int height, int x, int y, int zoom, DipRect area) {
    const DipLoupeCrop crop = dip_loupe_crop(width, height, x, y, zoom, area);
    const int columns = crop.frame.width / zoom;
    const int rows = crop.frame.height / zoom;
    assert_int_equal(columns % 2, 1);
    assert_int_equal(rows % 2, 1);
    assert_true(crop.frame.width <= area.width && crop.frame.width > area.width - 2 * zoom);
    assert_true(crop.frame.height <= area.height && crop.frame.height > area.height - 2 * zoom);
    for (int i = 0; i < crop.frame.width; i++) {
        for (int j = 0; j < crop.frame.height; j += 5) {
            const int px = column_at(x, columns, zoom, i);
            const int py = column_at(y, rows, zoom, j);
            const bool inside = px >= 0 && py >= 0 && px < width && py < height;
            int found_x, found_y;
            assert_int_equal(dip_rect_holds(crop.shown, area.x + i, area.y + j), inside);
            if (dip_loupe_pixel_at(crop.shown, crop.source.width, crop.source.height, area.x + i,
                                   area.y + j, &found_x, &found_y)) {
                assert_int_equal(crop.source.x + found_x, px);
                assert_int_equal(crop.source.y + found_y, py);
            }
            assert_int_equal(dip_rect_holds(crop.pixel, area.x + i, area.y + j),
                             px == x && py == y);
        }
    }
}

static void test_crops_are_centred_and_end_with_the_picture(void **state) {
    (void)state;
    static const int zooms[] = {2, 4, 8, 16, 32};
    static const int pixels[][2] = {{0, 0},  {39, 0},  {0, 29}, {39, 29}, {20, 15},
                                    {1, 28}, {38, 14}, {5, 0},  {0, 14}};
    for (size_t z = 0; z < sizeof zooms / sizeof *zooms; z++) {
        for (size_t i = 0; i < sizeof pixels / sizeof *pixels; i++) {
            check_crop(40, 30, pixels[i][0], pixels[i][1], zooms[z], (DipRect){7, 100, 131, 77});
        }
    }
    assert_true(
        dip_rect_is_empty(dip_loupe_crop(40, 30, 5, 5, 16, (DipRect){0, 0, 15, 100}).frame));
}

// The pixel that shows at a position, by the rule that each position shows the picture at its own
// middle: floor((i + 1/2) * from / to), in exact fractions.
static int shown_pixel(int i, int from, int to) {
    return (int)floorl(((long double)i + 0.5L) * from / to + 1e-12L);
}

static void test_positions_and_marks_agree_with_scaled_panes(void **state) {
    (void)state;
    static const int sizes[][2] = {{200, 200}, {200, 100}, {100, 200}, {67, 200}, {200, 67},
                                   {201, 200}, {3, 5},     {1, 7},     {7, 1}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        const int from = sizes[i][0];
        const DipRect shown = {11, 5, sizes[i][1], 4};
        int x, y;
        for (int k = 0; k < shown.width; k++) {
            assert_true(dip_loupe_pixel_at(shown, from, 4, shown.x + k, 6, &x, &y));
            assert_int_equal(x, shown_pixel(k, from, shown.width));
        }
        assert_false(dip_loupe_pixel_at(shown, from, 4, shown.x - 1, 6, &x, &y));
        assert_false(dip_loupe_pixel_at(shown, from, 4, shown.x + shown.width, 6, &x, &y));
        for (int first = 0; first < from; first++) {
            const DipRect source = {first, 1, from - first < 3 ? from - first : 3, 2};
            const DipRect mark = dip_loupe_mark(shown, from, 4, source);
            for (int k = 0; k < shown.width; k++) {
                const int pixel = shown_pixel(k, from, shown.width);
                assert_int_equal(
                    dip_rect_holds((DipRect){mark.x, 0, mark.width, 1}, shown.x + k, 0),
                    pixel >= source.x && pixel < source.x + source.width);
            }
        }
    }
}

static void test_zoom_and_moves_stay_in_range(void **state) {
    (void)state;
    DipToolState tools = {.zoom = 8, .x = 3, .y = 3};
    dip_tool_state_zoom(&tools, 9);
    assert_int_equal(tools.zoom, DIP_LOUPE_MAX_ZOOM);
    dip_tool_state_zoom(&tools, -2);
    assert_int_equal(tools.zoom, 8);
    dip_tool_state_zoom(&tools, -9);
    assert_int_equal(tools.zoom, DIP_LOUPE_MIN_ZOOM);
    dip_loupe_move(&tools, -5, 1, 10, 8);
    assert_true(tools.pinned && tools.x == 0 && tools.y == 4);
    dip_loupe_move(&tools, 100, 100, 10, 8);
    assert_true(tools.x == 9 && tools.y == 7);
    dip_loupe_keep_inside(&tools, 6, 20);
    assert_true(tools.x == 5 && tools.y == 7);
    tools.y = -1;
    dip_loupe_keep_inside(&tools, 6, 20);
    assert_true(tools.x == 3 && tools.y == 10);
}

static void test_front_surface_is_the_nearest(void **state) {
    (void)state;
    const DipSampleValue samples[4] = {{.patch = 0, .depth = 0.0f},
                                       {.patch = 9, .depth = 0.25f},
                                       {.patch = 5, .depth = 0.125f},
                                       {.patch = 9, .depth = 0.24f}};
    const DipSampleCount count = dip_loupe_count(samples, 4);
    assert_int_equal(count.front, 2);
    assert_int_equal(count.patches, 3);
    assert_true(dip_loupe_is_front(samples, 4, 3) && !dip_loupe_is_front(samples, 4, 2));
}

// --- the window --------------------------------------------------------------------------------

enum { PANE_WIDTH = 420, PANE_HEIGHT = 300, DOCK = 208 };

static int open_window(void **state) {
    (void)state;
    dip_tool_window_open(&tw, DIP_TEST_SCENE_fence, PANE_WIDTH, PANE_HEIGHT, DOCK);
    return 0;
}

static int close_window(void **state) {
    (void)state;
    dip_tool_window_close(&tw);
    return 0;
}

// Where a crop begins in the window: beneath its pane and the row of buttons.
static DipRect crop_area(int pane) {
    const DipRect *under = &tw.layout.panes[pane];
    return (DipRect){under->x, PANE_HEIGHT + 32, PANE_WIDTH - 264, DOCK - 32};
}

// Compares the middle of each square of a crop with the frame. Marks of samples and of the pixel
// cover parts of squares; zooms below 16 have no marks of samples.
static void check_crop_on_screen(int pane) {
    const DipToolState *tools = &tw.state.tools;
    const DipLoupeCrop crop =
        dip_loupe_crop(tw.window.frames[pane].width, tw.window.frames[pane].height, tools->x,
                       tools->y, tools->zoom, crop_area(pane));
    int compared = 0;
    for (int y = crop.source.y; y < crop.source.y + crop.source.height; y++) {
        for (int x = crop.source.x; x < crop.source.x + crop.source.width; x++) {
            if (abs(x - tools->x) <= 3 && abs(y - tools->y) <= 3) {
                continue; // the outline of the pixel
            }
            const int left = crop.shown.x + (x - crop.source.x) * crop.zoom;
            const int top = crop.shown.y + (y - crop.source.y) * crop.zoom;
            const uint8_t *expected = dip_tool_window_frame_pixel(&tw, pane, x, y);
            assert_memory_equal(dip_tool_window_pixel(&tw, left, top), expected, 3);
            assert_memory_equal(
                dip_tool_window_pixel(&tw, left + crop.zoom - 1, top + crop.zoom - 1), expected, 3);
            ++compared;
        }
    }
    assert_true(compared > 20);
}

static void test_crops_show_the_frames_pixels(void **state) {
    (void)state;
    static const int pixels[][2] = {
        {210, 150}, {0, 0}, {PANE_WIDTH - 1, PANE_HEIGHT - 1}, {3, 290}};
    for (int zoom = 2; zoom <= 8; zoom *= 2) {
        for (size_t i = 0; i < sizeof pixels / sizeof *pixels; i++) {
            tw.state.tools.zoom = zoom;
            tw.state.tools.x = pixels[i][0];
            tw.state.tools.y = pixels[i][1];
            dip_tool_window_draw(&tw);
            check_crop_on_screen(DIP_PANE_CURRENT);
            check_crop_on_screen(DIP_PANE_REQUESTED);
        }
    }
}

static void test_loupe_follows_the_pointer_in_scaled_panes(void **state) {
    (void)state;
    dip_tool_window_draw_frames(&tw, "aa=none", "aa=4", 2);
    dip_tool_window_draw(&tw);
    dip_tool_window_mouse(&tw, DIP_EVENT_MOUSE_MOVE, DIP_MOUSE_LEFT, 101, 57);
    assert_int_equal(tw.state.tools.x, 50);
    assert_int_equal(tw.state.tools.y, 28);
    const int right = tw.layout.panes[DIP_PANE_REQUESTED].x;
    dip_tool_window_mouse(&tw, DIP_EVENT_MOUSE_MOVE, DIP_MOUSE_LEFT, right + 419, 299);
    assert_int_equal(tw.state.tools.x, PANE_WIDTH / 2 - 1);
    assert_int_equal(tw.state.tools.y, PANE_HEIGHT / 2 - 1);
}

static void test_right_click_pins_and_arrows_move(void **state) {
    (void)state;
    tw.state.tools.open = false;
    dip_tool_window_draw(&tw); // The controls take events at the positions where they showed last.
    dip_tool_window_mouse(&tw, DIP_EVENT_MOUSE_DOWN, DIP_MOUSE_RIGHT, 33, 44);
    dip_tool_window_mouse(&tw, DIP_EVENT_MOUSE_UP, DIP_MOUSE_RIGHT, 33, 44);
    assert_true(tw.state.tools.pinned && tw.state.tools.open);
    assert_int_equal(tw.state.tools.tab, DIP_TAB_LOUPE);
    dip_tool_window_mouse(&tw, DIP_EVENT_MOUSE_MOVE, DIP_MOUSE_LEFT, 200, 100);
    assert_true(tw.state.tools.x == 33 && tw.state.tools.y == 44);
    const DipEvent up = {.kind = DIP_EVENT_KEY_DOWN, .key = DIP_KEYCODE_UP};
    const DipEvent right = {.kind = DIP_EVENT_KEY_DOWN, .key = DIP_KEYCODE_RIGHT};
    assert_true(dip_loupe_press(&tw.state, PANE_WIDTH, PANE_HEIGHT, &up));
    assert_true(dip_loupe_press(&tw.state, PANE_WIDTH, PANE_HEIGHT, &right));
    assert_true(tw.state.tools.x == 34 && tw.state.tools.y == 43);
    dip_tool_window_mouse(&tw, DIP_EVENT_MOUSE_DOWN, DIP_MOUSE_RIGHT, 34, 43);
    assert_false(tw.state.tools.pinned);
    const DipEvent letter = {.kind = DIP_EVENT_KEY_DOWN, .key = (DipKeycode)'x'};
    assert_false(dip_loupe_press(&tw.state, PANE_WIDTH, PANE_HEIGHT, &letter));
}

// The pointer lies over a crop. Wherever Tab has moved the focus, an arrow key only moves the
// focus; without a focus, it moves the loupe by one pixel in its direction.
static void test_arrows_move_the_loupe_and_never_zoom(void **state) {
    (void)state;
    static const struct {
        DipKeycode key;
        int dx, dy;
    } arrows[] = {{DIP_KEYCODE_LEFT, -1, 0},
                  {DIP_KEYCODE_RIGHT, 1, 0},
                  {DIP_KEYCODE_UP, 0, -1},
                  {DIP_KEYCODE_DOWN, 0, 1}};
    const DipRect crop = crop_area(DIP_PANE_REQUESTED);
    const DipEvent tab = {.kind = DIP_EVENT_KEY_DOWN, .key = DIP_KEYCODE_TAB};
    dip_tool_window_draw(&tw);
    dip_tool_window_mouse(&tw, DIP_EVENT_MOUSE_DOWN, DIP_MOUSE_LEFT, crop.x + 100, crop.y + 120);
    dip_tool_window_mouse(&tw, DIP_EVENT_MOUSE_UP, DIP_MOUSE_LEFT, crop.x + 100, crop.y + 120);
    assert_true(tw.state.tools.pinned);
    for (int i = 0; i < 4 * 12; ++i) {
        const DipEvent event = {.kind = DIP_EVENT_KEY_DOWN, .key = arrows[i % 4].key};
        const DipToolState before = tw.state.tools;
        for (int tabs = 0; tabs < i / 4; ++tabs) {
            assert_true(dip_tool_window_event(&tw, &tab));
        }
        const bool taken = dip_tool_window_event(&tw, &event);
        assert_memory_equal(&tw.state.tools, &before, sizeof before);
        assert_int_equal(taken, i / 4 > 0); // The click has hidden the focus.
        if (!taken) {
            assert_true(dip_loupe_press(&tw.state, PANE_WIDTH, PANE_HEIGHT, &event));
            assert_int_equal(tw.state.tools.x, before.x + arrows[i % 4].dx);
            assert_int_equal(tw.state.tools.y, before.y + arrows[i % 4].dy);
        }
        dip_ui_blur(tw.ui);
    }
}

// --- samples -----------------------------------------------------------------------------------

static int code_of(double linear) {
    const double encoded =
        linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1.0 / 2.4) - 0.055;
    return (int)floor(255.0 * encoded + 0.5);
}

static void check_samples(int pane, int x, int y, int count) {
    const DipSamplePattern *pattern;
    const DipSampleValue *samples =
        dip_loupe_samples(&tw.tools->loupe, pane, tw.window.versions[pane], x, y, &pattern);
    assert_non_null(samples);
    assert_int_equal(pattern->count, count);
    for (int c = 0; c < 3; c++) {
        double sum = 0.0;
        for (int s = 0; s < count; s++) {
            sum += samples[s].linear16[c];
        }
        assert_int_equal(code_of(floor(sum / count + 0.5) / 65535.0),
                         dip_tool_window_frame_pixel(&tw, pane, x, y)[c]);
    }
}

// A new picture is read again while the loupe shows, and not after it is closed.
static void test_a_closed_loupe_reads_no_samples(void **state) {
    (void)state;
    for (int open = 1; open >= 0; open--) {
        tw.state.tools.x = 200;
        tw.state.tools.y = 150;
        dip_tool_window_draw(&tw);
        dip_tool_window_update(&tw);
        tw.state.tools.open = open;
        tw.window.versions[0] += 2;
        assert_int_equal(dip_tool_window_update(&tw), open);
    }
}

static void test_samples_of_all_pixels_of_the_crops_resolve_to_the_panes(void **state) {
    (void)state;
    tw.state.tools.x = 200;
    tw.state.tools.y = 150;
    dip_tool_window_draw(&tw);
    assert_true(dip_tool_window_update(&tw));
    dip_tool_window_draw(&tw);
    assert_false(dip_tool_window_update(&tw)); // they are known now
    const DipLoupeCrop crop =
        dip_loupe_crop(PANE_WIDTH, PANE_HEIGHT, 200, 150, 16, crop_area(DIP_PANE_CURRENT));
    for (int y = crop.source.y; y < crop.source.y + crop.source.height; y++) {
        for (int x = crop.source.x; x < crop.source.x + crop.source.width; x++) {
            check_samples(DIP_PANE_CURRENT, x, y, 1);
            check_samples(DIP_PANE_REQUESTED, x, y, 4);
        }
    }
}

static void test_copied_panes_share_their_samples(void **state) {
    (void)state;
    tw.frame_index = 3;
    dip_tool_window_draw_frames(&tw, "aa=8,taa=on", "aa=8,taa=on", 1);
    assert_true(tw.frame.copied);
    dip_tool_window_draw(&tw);
    assert_true(dip_tool_window_update(&tw));
    check_samples(DIP_PANE_CURRENT, tw.state.tools.x, tw.state.tools.y, 8);
    check_samples(DIP_PANE_REQUESTED, tw.state.tools.x, tw.state.tools.y, 8);
    const DipSamplePattern *pattern;
    dip_loupe_samples(&tw.tools->loupe, 1, tw.window.versions[1], tw.state.tools.x,
                      tw.state.tools.y, &pattern);
    assert_ptr_equal(pattern, dip_sample_pattern_of(8, DIP_PATTERN_ODD));
}

static void test_moving_pictures_have_no_samples(void **state) {
    (void)state;
    const DipSamplePattern *pattern;
    tw.window.still = false;
    dip_tool_window_draw(&tw);
    assert_false(dip_tool_window_update(&tw));
    tw.window.still = true;
    assert_true(dip_tool_window_update(&tw));
    const uint64_t before = tw.window.versions[1];
    dip_tool_window_draw_frames(&tw, "aa=none", "aa=8", 1);
    assert_null(dip_loupe_samples(&tw.tools->loupe, 1, tw.window.versions[1], tw.state.tools.x,
                                  tw.state.tools.y, &pattern));
    assert_non_null(dip_loupe_samples(&tw.tools->loupe, 1, before, tw.state.tools.x,
                                      tw.state.tools.y, &pattern));
}

static void test_box_shows_samples_at_their_positions(void **state) {
    (void)state;
    DipLoupe *loupe = &tw.tools->loupe;
    static const int places[4][2] = {{96, 32}, {224, 96}, {32, 160}, {160, 224}}; // 1/256 pixel
    DipSampleValue samples[4];
    for (int s = 0; s < 4; s++) {
        samples[s] = (DipSampleValue){.patch = 1u + (unsigned)s % 2, .depth = s % 2 ? 0.5f : 0.1f};
        samples[s].linear16[s % 3] = 65535;
    }
    const DipBoxContent content = {{90, 90, 90, 255}, dip_sample_pattern(4), samples, 128};
    DipPixels picture;
    uint64_t version, again;
    assert_true(dip_loupe_box_picture(loupe, 0, &content, &picture, &version));
    for (int s = 0; s < 4; s++) {
        // The pixel's square is 108 wide and lies 10 from the picture's edges.
        const int x = 10 + (int)lround(places[s][0] * 108 / 256.0);
        const int y = 10 + (int)lround(places[s][1] * 108 / 256.0);
        const uint8_t *pixel = picture.rgba8 + (size_t)y * picture.stride_bytes + 4 * (size_t)x;
        for (int c = 0; c < 3; c++) {
            assert_int_equal(pixel[c], c == s % 3 ? 255 : 0);
        }
    }
    assert_true(dip_loupe_box_picture(loupe, 0, &content, &picture, &again));
    assert_true(version == again);
    samples[2].linear16[0] = 5;
    assert_true(dip_loupe_box_picture(loupe, 0, &content, &picture, &again));
    assert_true(version != again);
}

int main(void) {
#define IN_WINDOW(test) cmocka_unit_test_setup_teardown(test, open_window, close_window)
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_crops_are_centred_and_end_with_the_picture),
        cmocka_unit_test(test_positions_and_marks_agree_with_scaled_panes),
        cmocka_unit_test(test_zoom_and_moves_stay_in_range),
        cmocka_unit_test(test_front_surface_is_the_nearest),
        IN_WINDOW(test_crops_show_the_frames_pixels),
        IN_WINDOW(test_loupe_follows_the_pointer_in_scaled_panes),
        IN_WINDOW(test_right_click_pins_and_arrows_move),
        IN_WINDOW(test_arrows_move_the_loupe_and_never_zoom),
        IN_WINDOW(test_a_closed_loupe_reads_no_samples),
        IN_WINDOW(test_samples_of_all_pixels_of_the_crops_resolve_to_the_panes),
        IN_WINDOW(test_copied_panes_share_their_samples),
        IN_WINDOW(test_moving_pictures_have_no_samples),
        IN_WINDOW(test_box_shows_samples_at_their_positions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
