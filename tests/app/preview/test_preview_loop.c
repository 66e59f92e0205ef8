// Tests of the preview on a fake display: keys and mouse events go in, pixels come out. No SDL is
// linked.
#include "app/files/pictures.h"
#include "app/preview/loop/view.h"
#include "tests/app/preview/made_preview.h"
#include "tests/app/preview/png_parts.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

// The rows FIRST_ROW..LAST_ROW are covered neither by a label nor by the status line, at every size
// used here.
enum { WIDTH = 402, HEIGHT = 300, FIRST_ROW = 100, LAST_ROW = 230 };

static int set_up(void **state) {
    (void)state;
    dip_made_open_session(1, 2, NULL); // The path passes the scene's chequers.
    dip_made_open_display(WIDTH, HEIGHT);
    assert_true(dip_made_create_preview(NULL, NULL));
    return 0;
}

// --- driving and looking -----------------------------------------------------------------------

static void hold(DipKeycode key, bool down) {
    const DipEvent event = {
        .kind = down ? DIP_EVENT_KEY_DOWN : DIP_EVENT_KEY_UP, .key = key, .position = key};
    dip_fake_display_push(made.fake, &event);
    dip_made_turn_shown();
}

// A copy of a pane's rows that no label covers.
typedef struct Pane {
    size_t bytes;
    uint8_t *rgba8;
} Pane;

static Pane look(int pane) {
    const DipPixels shown = dip_fake_display_picture(made.fake);
    const DipLayout layout = dip_preview_layout(made.preview);
    const DipRect *panes = layout.panes;
    const size_t row_bytes = 4 * (size_t)panes[pane].width;
    Pane copy = {row_bytes * (LAST_ROW - FIRST_ROW), malloc(row_bytes * (LAST_ROW - FIRST_ROW))};
    assert_non_null(copy.rgba8);
    for (int y = FIRST_ROW; y < LAST_ROW; ++y) {
        memcpy(copy.rgba8 + (size_t)(y - FIRST_ROW) * row_bytes,
               shown.rgba8 + (size_t)y * shown.stride_bytes + 4 * (size_t)panes[pane].x, row_bytes);
    }
    return copy;
}

static bool is_same(const Pane *a, const Pane *b) {
    return a->bytes == b->bytes && memcmp(a->rgba8, b->rgba8, a->bytes) == 0;
}

// Compares a pane with a copy, which it frees.
static bool pane_is(int pane, Pane before) {
    const Pane now = look(pane);
    const bool same = is_same(&now, &before);
    free(now.rgba8);
    free(before.rgba8);
    return same;
}

static bool panes_are_same(void) {
    return pane_is(DIP_PANE_CURRENT, look(DIP_PANE_REQUESTED));
}

// Pauses, and lets the notice go away and the figures settle.
static void rest(void) {
    dip_made_press(DIP_KEYCODE_SPACE);
    for (int i = 0; i < 200; ++i) {
        dip_made_turn_shown();
    }
}

// --- the tests ---------------------------------------------------------------------------------

static void both_panes_show_the_scene(void **state) {
    (void)state;
    dip_made_turn_shown();
    assert_int_equal(dip_fake_display_present_count(made.fake), 1);
    const Pane current = look(DIP_PANE_CURRENT);
    int different = 0;
    for (size_t i = 4; i < current.bytes; i += 4) {
        different += memcmp(current.rgba8 + i, current.rgba8 + i - 4, 4) != 0;
    }
    free(current.rgba8);
    assert_true(different > 1000);
    assert_true(panes_are_same());
}

static void the_picture_moves_until_it_is_paused(void **state) {
    (void)state;
    dip_made_turn_shown();
    Pane before = look(DIP_PANE_CURRENT);
    for (int i = 0; i < 10; ++i) {
        dip_made_turn_shown();
    }
    assert_false(pane_is(DIP_PANE_CURRENT, before));
    rest();
    before = look(DIP_PANE_CURRENT);
    const int presented = dip_fake_display_present_count(made.fake);
    for (int i = 0; i < 10; ++i) {
        dip_made_turn_shown();
    }
    assert_true(pane_is(DIP_PANE_CURRENT, before));
    assert_int_equal(dip_fake_display_present_count(made.fake), presented);
    before = look(DIP_PANE_CURRENT);
    dip_made_press('.');
    assert_false(pane_is(DIP_PANE_CURRENT, before));
}

static void a_setting_changes_the_requested_pane(void **state) {
    (void)state;
    rest();
    const Pane before = look(DIP_PANE_CURRENT);
    dip_made_press('x');
    assert_false(panes_are_same());
    assert_true(pane_is(DIP_PANE_CURRENT, before));
    dip_made_press(DIP_KEYCODE_F2); // The second key of the same setting.
    assert_int_equal(
        dip_preview_state(made.preview)->quality[DIP_PANE_REQUESTED].step[DIP_SETTING_AA], 2);
}

static void enter_copies_requested_to_current(void **state) {
    (void)state;
    rest();
    dip_made_press('f');
    assert_false(panes_are_same());
    const Pane requested = look(DIP_PANE_REQUESTED);
    dip_made_press(DIP_KEYCODE_ENTER);
    assert_true(panes_are_same());
    assert_true(pane_is(DIP_PANE_CURRENT, requested));
}

static void click(int x, int clicks) {
    dip_fake_display_click(made.fake, DIP_MOUSE_LEFT, x, 150, clicks);
    dip_made_turn_shown();
}

// A setting's key changes the pane that the key ` or a click has chosen.
static void a_key_and_clicks_choose_the_pane(void **state) {
    (void)state;
    rest();
    dip_made_press((DipKeycode)'`');
    Pane requested = look(DIP_PANE_REQUESTED);
    dip_made_press('x');
    assert_true(pane_is(DIP_PANE_REQUESTED, requested));
    assert_false(panes_are_same());
    click(WIDTH - 20, 1);
    dip_made_press('x');
    assert_true(panes_are_same());
    click(20, 1);
    requested = look(DIP_PANE_REQUESTED);
    dip_made_press('x');
    assert_true(pane_is(DIP_PANE_REQUESTED, requested));
    dip_fake_display_click(made.fake, DIP_MOUSE_RIGHT, WIDTH - 20, 150, 1);
    dip_made_turn_shown();
    assert_true(dip_preview_state(made.preview)->edited[DIP_PANE_CURRENT]);
    click(20, 2);
    assert_true(dip_fake_display_is_full_screen(made.fake));
    dip_made_press(DIP_KEYCODE_F11);
    assert_false(dip_fake_display_is_full_screen(made.fake));
}

// A press that brings an embedded window the keyboard focus does not choose a pane.
static void a_press_for_the_focus_chooses_no_pane(void **state) {
    (void)state;
    dip_made_turn_shown();
    DipEvent event = {
        .kind = DIP_EVENT_MOUSE_DOWN, .x = 40, .y = 100, .clicks = 1, .focuses = true};
    for (int i = 0; i < 2; ++i) {
        dip_fake_display_push(made.fake, &event);
        event.kind = DIP_EVENT_MOUSE_UP;
        dip_fake_display_push(made.fake, &event);
        dip_made_turn_shown();
        assert_int_equal(dip_preview_state(made.preview)->edited[DIP_PANE_CURRENT], i);
        event.kind = DIP_EVENT_MOUSE_DOWN;
        event.focuses = false;
    }
}

// The picture of a camera that stands still, in a scene without motion, is at rest from the start.
static void a_still_camera_rests_from_the_start(void **state) {
    (void)state;
    DipCamPath *still = NULL;
    const DipCamKey key = dip_campath_key(made.path, 0);
    const DipCamKey keys[2] = {key, key};
    assert_true(dip_campath_create(keys, 2, INT64_C(500000000), &still, NULL));
    dip_camtrack_set(&made.session.track, DIP_CATEGORY_DEFAULT, still, 60.0);
    for (int i = 0; i < 300; ++i) { // The figures settle.
        dip_made_turn_shown();
    }
    assert_true(dip_preview_rests(dip_preview_state(made.preview), false));
    const int presented = dip_fake_display_present_count(made.fake);
    for (int i = 0; i < 20; ++i) {
        dip_made_turn_shown();
    }
    assert_int_equal(dip_fake_display_present_count(made.fake), presented);
    dip_camtrack_set(&made.session.track, DIP_CATEGORY_DEFAULT, made.path, 60.0);
    dip_made_turn_shown();
    assert_false(dip_preview_rests(dip_preview_state(made.preview), false));
    dip_campath_destroy(&still);
}

static void sheets_cover_the_panes_until_closed(void **state) {
    (void)state;
    static const struct {
        DipKeycode open;
        DipKeycode close;
    } ways[] = {{DIP_KEYCODE_F1, DIP_KEYCODE_F1},
                {(DipKeycode)'h', DIP_KEYCODE_ESCAPE},
                {(DipKeycode)'u', (DipKeycode)'u'},
                {(DipKeycode)'u', DIP_KEYCODE_ESCAPE}};
    rest();
    for (size_t i = 0; i < sizeof ways / sizeof ways[0]; ++i) {
        const Pane before = look(DIP_PANE_CURRENT);
        dip_made_press(ways[i].open);
        const Pane covered = look(DIP_PANE_CURRENT);
        assert_false(is_same(&covered, &before));
        free(covered.rgba8);
        dip_made_press(ways[i].close);
        assert_true(pane_is(DIP_PANE_CURRENT, before));
        assert_false(dip_preview_state(made.preview)->quit);
    }
}

// The sizes have even, odd and tiny widths. One size is larger than a frame may be.
static void the_panes_follow_the_display(void **state) {
    (void)state;
    static const int sizes[][2] = {{640, 300}, {321, 290}, {402, 480}, {3, 1}, {1, 1}};
    dip_made_turn_shown();
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; ++i) {
        const int width = sizes[i][0], height = sizes[i][1];
        assert_true(dip_fake_display_resize(made.fake, width, height));
        dip_made_turn_shown();
        assert_int_equal(dip_preview_picture(made.preview).width, width);
        if (height > LAST_ROW) {
            assert_true(panes_are_same());
        }
    }
    assert_true(dip_fake_display_resize(made.fake, 2 * DIP_MAX_FRAME_SIZE + 100, 40));
    dip_made_turn_shown();
}

// Text grows with the display's scale: the label strip reaches further down.
static void text_follows_the_scale(void **state) {
    (void)state;
    rest();
    const Pane before = look(DIP_PANE_CURRENT);
    dip_fake_display_rescale(made.fake, 2.5);
    dip_made_turn_shown();
    assert_false(pane_is(DIP_PANE_CURRENT, before));
}

static void the_free_camera_follows_held_keys(void **state) {
    (void)state;
    rest();
    dip_made_press('c');
    Pane before = look(DIP_PANE_CURRENT);
    dip_made_turn_shown();
    assert_true(pane_is(DIP_PANE_CURRENT, before));
    before = look(DIP_PANE_CURRENT);
    hold('w', true);
    dip_made_turn_shown();
    assert_false(pane_is(DIP_PANE_CURRENT, before));
    hold('w', false);
    before = look(DIP_PANE_CURRENT);
    for (int i = 0; i < 5; ++i) {
        dip_made_turn_shown();
    }
    assert_true(pane_is(DIP_PANE_CURRENT, before));
}

static void only_changes_are_presented(void **state) {
    (void)state;
    rest();
    dip_made_press(DIP_KEYCODE_TAB);
    assert_in_range(dip_fake_display_damaged_pixels(made.fake), 1, WIDTH * HEIGHT / 4);
    const int presented = dip_fake_display_present_count(made.fake);
    dip_fake_display_push(made.fake, &(DipEvent){.kind = DIP_EVENT_EXPOSE});
    dip_made_turn_shown();
    assert_int_equal(dip_fake_display_present_count(made.fake), presented + 1);
    assert_int_equal(dip_fake_display_damaged_pixels(made.fake), WIDTH * HEIGHT);
}

// While the camera rests and the panel shows, errors are measured. The errors show although no
// event arrives.
static void errors_appear_while_the_camera_rests(void **state) {
    (void)state;
    rest();
    dip_made_press('r');
    dip_made_turn_shown();
    const int presented = dip_fake_display_present_count(made.fake);
    for (int i = 0; i < 120000 && dip_fake_display_present_count(made.fake) == presented; ++i) {
        const struct timespec millisecond = {0, 1000000};
        nanosleep(&millisecond, NULL);
        dip_made_turn_shown();
    }
    assert_true(dip_fake_display_present_count(made.fake) > presented);
    assert_in_range(dip_fake_display_damaged_pixels(made.fake), 1, WIDTH * HEIGHT / 2);
}

// Measuring errors needs the scene's files once more. A file that has become bad in the meantime
// only closes the panel.
static void a_broken_scene_file_leaves_the_running_scene(void **state) {
    (void)state;
    rest();
    const Pane before = look(DIP_PANE_CURRENT);
    made.scene_is_broken = true;
    dip_made_press('r');
    made.scene_is_broken = false;
    assert_false(dip_preview_shows_times(dip_preview_state(made.preview)));
    assert_non_null(strstr(dip_preview_state(made.preview)->notice, "the importer crashed"));
    for (int i = 0; i < 200; ++i) {
        dip_made_turn_shown();
    }
    assert_true(pane_is(DIP_PANE_CURRENT, before));
    dip_made_press('r');
    assert_true(dip_preview_shows_times(dip_preview_state(made.preview)));
}

// A window that nobody sees draws nothing, and its time stands still. It goes on where it was.
static void a_hidden_window_draws_nothing(void **state) {
    (void)state;
    dip_made_turn_shown();
    dip_made_turn_shown();
    dip_fake_display_hide(made.fake, true);
    const int presented = dip_fake_display_present_count(made.fake);
    const int64_t play_ns = dip_preview_state(made.preview)->play_ns;
    for (int i = 0; i < 20; ++i) {
        dip_made_turn_shown();
    }
    dip_fake_display_advance(made.fake, INT64_C(5000000000));
    dip_made_turn_shown();
    assert_int_equal(dip_fake_display_present_count(made.fake), presented);
    assert_true(dip_preview_state(made.preview)->play_ns == play_ns);
    dip_fake_display_hide(made.fake, false);
    dip_made_turn_shown();
    dip_made_turn_shown();
    assert_true(dip_fake_display_present_count(made.fake) > presented);
    assert_in_range(dip_preview_state(made.preview)->play_ns - play_ns, 1, 100000000);
}

static void quitting_ends_without_another_frame(void **state) {
    (void)state;
    static const DipEvent ways[] = {
        {.kind = DIP_EVENT_QUIT},
        {.kind = DIP_EVENT_KEY_DOWN, .key = DIP_KEYCODE_ESCAPE},
        {.kind = DIP_EVENT_KEY_DOWN, .key = (DipKeycode)'q', .modifiers = DIP_MODIFIER_CTRL}};
    for (size_t i = 0; i < sizeof ways / sizeof ways[0]; ++i) {
        dip_made_turn_shown();
        assert_false(dip_preview_state(made.preview)->quit);
        const int presented = dip_fake_display_present_count(made.fake);
        dip_fake_display_push(made.fake, &ways[i]);
        dip_made_turn();
        assert_true(dip_preview_state(made.preview)->quit);
        assert_int_equal(dip_fake_display_present_count(made.fake), presented);
        dip_made_tear_down(NULL);
        set_up(NULL);
    }
}

// The file holds the picture that the display showed before the notice of the file.
static void a_screenshot_equals_the_shown_picture(void **state) {
    (void)state;
    char folder[] = "/tmp/test_preview_loop.XXXXXX";
    char before[1024];
    assert_true(getcwd(before, sizeof before) && mkdtemp(folder) && chdir(folder) == 0);
    rest();
    const DipPixels shown = dip_fake_display_picture(made.fake);
    unsigned char *expected = NULL;
    size_t expected_bytes = 0;
    assert_true(dip_png_encode(shown.rgba8, shown.stride_bytes, shown.width, shown.height,
                               &expected, &expected_bytes));
    dip_made_press(DIP_KEYCODE_F12);
    char notice[256];
    snprintf(notice, sizeof notice, "Saved diptych-0001.png in %s", folder);
    assert_string_equal(dip_preview_state(made.preview)->notice, notice);
    unsigned char *found;
    size_t found_bytes;
    png_read("diptych-0001.png", &found, &found_bytes);
    assert_int_equal(png_strip_texts(found, found_bytes), expected_bytes);
    assert_memory_equal(found, expected, expected_bytes);
    free(found);
    free(expected);
    assert_true(remove("diptych-0001.png") == 0 && chdir(before) == 0 && rmdir(folder) == 0);
}

// After any events, the display shows what was drawn (dip_made_turn_shown checks this), and nothing
// fails.
static void random_events_do_no_harm(void **state) {
    (void)state;
    uint32_t random = 1;
    for (int i = 0; i < 600; ++i) {
        random = random * 1664525u + 1013904223u;
        const unsigned value = random >> 8;
        DipEvent event = {.kind = (DipEventKind)(value % DIP_EVENT_QUIT),
                          .modifiers = value >> 4 & (value >> 12) & 15,
                          .x = (int)(value % WIDTH),
                          .y = (int)(value % HEIGHT),
                          .clicks = (int)(value % 3)};
        event.key = (DipKeycode)(value % 3 ? 'a' + value / 5 % 26 : DIP_KEYCODE_ENTER + value % 29);
        const bool leaves = event.key == DIP_KEYCODE_ESCAPE || event.key == DIP_KEYCODE_F12 ||
                            event.key == (DipKeycode)'q' ||
                            event.key == (DipKeycode)'s'; // Ctrl+S writes a file.
        event.key = leaves ? DIP_KEYCODE_SPACE : event.key;
        event.position = event.key;
        dip_fake_display_push(made.fake, &event);
        if (value % 50 == 0) {
            assert_true(dip_fake_display_resize(made.fake, 1 + (int)(value / 50 % 500),
                                                1 + (int)(value / 7 % 300)));
        }
        if (value % 3 == 0) {
            dip_made_turn_shown();
        }
    }
    dip_made_turn_shown();
}

int main(void) {
#define PREVIEW_TEST(name) cmocka_unit_test_setup_teardown(name, set_up, dip_made_tear_down)
    const struct CMUnitTest tests[] = {
        PREVIEW_TEST(both_panes_show_the_scene),
        PREVIEW_TEST(the_picture_moves_until_it_is_paused),
        PREVIEW_TEST(a_setting_changes_the_requested_pane),
        PREVIEW_TEST(enter_copies_requested_to_current),
        PREVIEW_TEST(a_key_and_clicks_choose_the_pane),
        PREVIEW_TEST(a_press_for_the_focus_chooses_no_pane),
        PREVIEW_TEST(a_still_camera_rests_from_the_start),
        PREVIEW_TEST(sheets_cover_the_panes_until_closed),
        PREVIEW_TEST(the_panes_follow_the_display),
        PREVIEW_TEST(text_follows_the_scale),
        PREVIEW_TEST(the_free_camera_follows_held_keys),
        PREVIEW_TEST(only_changes_are_presented),
        PREVIEW_TEST(errors_appear_while_the_camera_rests),
        PREVIEW_TEST(a_broken_scene_file_leaves_the_running_scene),
        PREVIEW_TEST(a_hidden_window_draws_nothing),
        PREVIEW_TEST(quitting_ends_without_another_frame),
        PREVIEW_TEST(a_screenshot_equals_the_shown_picture),
        PREVIEW_TEST(random_events_do_no_harm),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
