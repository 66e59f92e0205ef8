// Tests of the preview on a fake display: keys and mouse events go in, pixels come out. No SDL is
// linked.
#include "tests/app/display/fake_display.h"
#include "app/files/pictures.h"
#include "app/preview/loop/loop.h"
#include "app/preview/loop/view.h"
#include "config/config.h"
#include "tests/app/preview/png_parts.h"
#include "renderer/catalogue/scenes.h"

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

static DipTestScene scene;
static DipSession session;
static DipCamPath *path;
static DipDisplay display;
static DipFakeDisplay *fake;
static DipPreview *preview;

// --- the fixture -------------------------------------------------------------------------------

static bool scene_is_broken; // The scene's file has become unreadable.

static bool load_scene_def(DipSession *unused, DipError *err) {
    (void)unused;
    if (scene_is_broken) {
        return dip_error_set(err, DIP_ERROR_RUNTIME, "scene.obj", 0, NULL, "the importer crashed");
    }
    session.scene_def = scene.def;
    return true;
}

// Makes a path of ten seconds, past the scene's chequers and back.
static void make_path(void) {
    DipCamKey keys[2];
    for (int i = 0; i < 2; ++i) {
        memcpy(keys[i].position_world, scene.pose.position_world, sizeof keys[i].position_world);
        memcpy(keys[i].orientation, scene.pose.orientation, sizeof keys[i].orientation);
        keys[i].position_world[0] += i;
    }
    assert_true(dip_campath_create(keys, 2, INT64_C(5000000000), &path, NULL));
    session.track = dip_camtrack_make(true);
    dip_camtrack_set(&session.track, DIP_CATEGORY_DEFAULT, path, 60.0);
}

static int set_up(void **state) {
    (void)state;
    dip_test_scene_make(&scene, DIP_TEST_SCENE_grazing_checker);
    session = (DipSession){.pool = dip_pool_create(1, NULL)};
    session.scene = dip_scene_create(&scene.def, NULL, NULL);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        DipRendererDef def = dip_renderer_default_def();
        def.pool = session.pool;
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

// --- driving and looking -----------------------------------------------------------------------

// Asserts that the display shows what the preview drew, so no damage was forgotten.
static void assert_shown(void) {
    const DipPixels shown = dip_fake_display_picture(fake);
    const DipPixels drawn = dip_preview_picture(preview);
    assert_int_equal(shown.width, drawn.width);
    assert_int_equal(shown.height, drawn.height);
    assert_memory_equal(shown.rgba8, drawn.rgba8, 4 * (size_t)shown.width * (size_t)shown.height);
}

static void turn(void) {
    DipError err = {0};
    if (!dip_preview_turn(preview, &err)) {
        fail_msg("%s", err.message);
    }
    if (!dip_preview_has_quit(preview)) {
        assert_shown();
    }
}

static void press(DipKeycode key) {
    dip_fake_display_press(fake, key, 0);
    turn();
}

static void hold(DipKeycode key, bool down) {
    const DipEvent event = {
        .kind = down ? DIP_EVENT_KEY_DOWN : DIP_EVENT_KEY_UP, .key = key, .position = key};
    dip_fake_display_push(fake, &event);
    turn();
}

// A copy of a pane's rows that no label covers.
typedef struct Pane {
    size_t bytes;
    uint8_t *rgba8;
} Pane;

static Pane look(int pane) {
    const DipPixels shown = dip_fake_display_picture(fake);
    const DipLayout layout = dip_preview_layout(preview);
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
    press(DIP_KEYCODE_SPACE);
    for (int i = 0; i < 200; ++i) {
        turn();
    }
}

// --- the tests ---------------------------------------------------------------------------------

static void both_panes_show_the_scene(void **state) {
    (void)state;
    turn();
    assert_int_equal(dip_fake_display_present_count(fake), 1);
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
    turn();
    Pane before = look(DIP_PANE_CURRENT);
    for (int i = 0; i < 10; ++i) {
        turn();
    }
    assert_false(pane_is(DIP_PANE_CURRENT, before));
    rest();
    before = look(DIP_PANE_CURRENT);
    const int presented = dip_fake_display_present_count(fake);
    for (int i = 0; i < 10; ++i) {
        turn();
    }
    assert_true(pane_is(DIP_PANE_CURRENT, before));
    assert_int_equal(dip_fake_display_present_count(fake), presented);
    before = look(DIP_PANE_CURRENT);
    press('.');
    assert_false(pane_is(DIP_PANE_CURRENT, before));
}

static void a_setting_changes_the_requested_pane(void **state) {
    (void)state;
    rest();
    const Pane before = look(DIP_PANE_CURRENT);
    press('x');
    assert_false(panes_are_same());
    assert_true(pane_is(DIP_PANE_CURRENT, before));
    press(DIP_KEYCODE_F2); // The second key of the same setting.
    assert_int_equal(dip_preview_state(preview)->quality[DIP_PANE_REQUESTED].step[DIP_SETTING_AA],
                     2);
}

static void enter_copies_requested_to_current(void **state) {
    (void)state;
    rest();
    press('f');
    assert_false(panes_are_same());
    const Pane requested = look(DIP_PANE_REQUESTED);
    press(DIP_KEYCODE_ENTER);
    assert_true(panes_are_same());
    assert_true(pane_is(DIP_PANE_CURRENT, requested));
}

static void click(int x, int clicks) {
    dip_fake_display_click(fake, DIP_MOUSE_LEFT, x, 150, clicks);
    turn();
}

// A setting's key changes the pane that the key ` or a click has chosen.
static void a_key_and_clicks_choose_the_pane(void **state) {
    (void)state;
    rest();
    press((DipKeycode)'`');
    Pane requested = look(DIP_PANE_REQUESTED);
    press('x');
    assert_true(pane_is(DIP_PANE_REQUESTED, requested));
    assert_false(panes_are_same());
    click(WIDTH - 20, 1);
    press('x');
    assert_true(panes_are_same());
    click(20, 1);
    requested = look(DIP_PANE_REQUESTED);
    press('x');
    assert_true(pane_is(DIP_PANE_REQUESTED, requested));
    dip_fake_display_click(fake, DIP_MOUSE_RIGHT, WIDTH - 20, 150, 1);
    turn();
    assert_true(dip_preview_state(preview)->edited[DIP_PANE_CURRENT]);
    click(20, 2);
    assert_true(dip_fake_display_is_full_screen(fake));
    press(DIP_KEYCODE_F11);
    assert_false(dip_fake_display_is_full_screen(fake));
}

// A press that brings an embedded window the keyboard focus does not choose a pane.
static void a_press_for_the_focus_chooses_no_pane(void **state) {
    (void)state;
    turn();
    DipEvent event = {
        .kind = DIP_EVENT_MOUSE_DOWN, .x = 40, .y = 100, .clicks = 1, .focuses = true};
    for (int i = 0; i < 2; ++i) {
        dip_fake_display_push(fake, &event);
        event.kind = DIP_EVENT_MOUSE_UP;
        dip_fake_display_push(fake, &event);
        turn();
        assert_int_equal(dip_preview_state(preview)->edited[DIP_PANE_CURRENT], i);
        event.kind = DIP_EVENT_MOUSE_DOWN;
        event.focuses = false;
    }
}

// The picture of a camera that stands still, in a scene without motion, is at rest from the start.
static void a_still_camera_rests_from_the_start(void **state) {
    (void)state;
    DipCamPath *still = NULL;
    const DipCamKey key = dip_campath_key(path, 0);
    const DipCamKey keys[2] = {key, key};
    assert_true(dip_campath_create(keys, 2, INT64_C(500000000), &still, NULL));
    dip_camtrack_set(&session.track, DIP_CATEGORY_DEFAULT, still, 60.0);
    for (int i = 0; i < 300; ++i) { // The figures settle.
        turn();
    }
    assert_true(dip_preview_rests(dip_preview_state(preview), false));
    const int presented = dip_fake_display_present_count(fake);
    for (int i = 0; i < 20; ++i) {
        turn();
    }
    assert_int_equal(dip_fake_display_present_count(fake), presented);
    dip_camtrack_set(&session.track, DIP_CATEGORY_DEFAULT, path, 60.0);
    turn();
    assert_false(dip_preview_rests(dip_preview_state(preview), false));
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
        press(ways[i].open);
        const Pane covered = look(DIP_PANE_CURRENT);
        assert_false(is_same(&covered, &before));
        free(covered.rgba8);
        press(ways[i].close);
        assert_true(pane_is(DIP_PANE_CURRENT, before));
        assert_false(dip_preview_has_quit(preview));
    }
}

// The sizes have even, odd and tiny widths. One size is larger than a frame may be.
static void the_panes_follow_the_display(void **state) {
    (void)state;
    static const int sizes[][2] = {{640, 300}, {321, 290}, {402, 480}, {3, 1}, {1, 1}};
    turn();
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; ++i) {
        const int width = sizes[i][0], height = sizes[i][1];
        assert_true(dip_fake_display_resize(fake, width, height));
        turn();
        assert_int_equal(dip_preview_picture(preview).width, width);
        if (height > LAST_ROW) {
            assert_true(panes_are_same());
        }
    }
    assert_true(dip_fake_display_resize(fake, 2 * DIP_MAX_FRAME_SIZE + 100, 40));
    turn();
}

// Text grows with the display's scale: the label strip reaches further down.
static void text_follows_the_scale(void **state) {
    (void)state;
    rest();
    const Pane before = look(DIP_PANE_CURRENT);
    dip_fake_display_rescale(fake, 2.5);
    turn();
    assert_false(pane_is(DIP_PANE_CURRENT, before));
}

static void the_free_camera_follows_held_keys(void **state) {
    (void)state;
    rest();
    press('c');
    Pane before = look(DIP_PANE_CURRENT);
    turn();
    assert_true(pane_is(DIP_PANE_CURRENT, before));
    before = look(DIP_PANE_CURRENT);
    hold('w', true);
    turn();
    assert_false(pane_is(DIP_PANE_CURRENT, before));
    hold('w', false);
    before = look(DIP_PANE_CURRENT);
    for (int i = 0; i < 5; ++i) {
        turn();
    }
    assert_true(pane_is(DIP_PANE_CURRENT, before));
}

static void only_changes_are_presented(void **state) {
    (void)state;
    rest();
    press(DIP_KEYCODE_TAB);
    assert_in_range(dip_fake_display_damaged_pixels(fake), 1, WIDTH * HEIGHT / 4);
    const int presented = dip_fake_display_present_count(fake);
    dip_fake_display_push(fake, &(DipEvent){.kind = DIP_EVENT_EXPOSE});
    turn();
    assert_int_equal(dip_fake_display_present_count(fake), presented + 1);
    assert_int_equal(dip_fake_display_damaged_pixels(fake), WIDTH * HEIGHT);
}

// While the camera rests and the panel shows, errors are measured. The errors show although no
// event arrives.
static void errors_appear_while_the_camera_rests(void **state) {
    (void)state;
    rest();
    press('r');
    turn();
    const int presented = dip_fake_display_present_count(fake);
    for (int i = 0; i < 120000 && dip_fake_display_present_count(fake) == presented; ++i) {
        const struct timespec millisecond = {0, 1000000};
        nanosleep(&millisecond, NULL);
        turn();
    }
    assert_true(dip_fake_display_present_count(fake) > presented);
    assert_in_range(dip_fake_display_damaged_pixels(fake), 1, WIDTH * HEIGHT / 2);
}

// Measuring errors needs the scene's files once more. A file that has become bad in the meantime
// only closes the panel.
static void a_broken_scene_file_leaves_the_running_scene(void **state) {
    (void)state;
    rest();
    const Pane before = look(DIP_PANE_CURRENT);
    scene_is_broken = true;
    press('r');
    scene_is_broken = false;
    assert_false(dip_preview_shows_times(dip_preview_state(preview)));
    assert_non_null(strstr(dip_preview_state(preview)->notice, "the importer crashed"));
    for (int i = 0; i < 200; ++i) {
        turn();
    }
    assert_true(pane_is(DIP_PANE_CURRENT, before));
    press('r');
    assert_true(dip_preview_shows_times(dip_preview_state(preview)));
}

// A window that nobody sees draws nothing, and its time stands still. It goes on where it was.
static void a_hidden_window_draws_nothing(void **state) {
    (void)state;
    turn();
    turn();
    dip_fake_display_hide(fake, true);
    const int presented = dip_fake_display_present_count(fake);
    const int64_t play_ns = dip_preview_state(preview)->play_ns;
    for (int i = 0; i < 20; ++i) {
        turn();
    }
    dip_fake_display_advance(fake, INT64_C(5000000000));
    turn();
    assert_int_equal(dip_fake_display_present_count(fake), presented);
    assert_true(dip_preview_state(preview)->play_ns == play_ns);
    dip_fake_display_hide(fake, false);
    turn();
    turn();
    assert_true(dip_fake_display_present_count(fake) > presented);
    assert_in_range(dip_preview_state(preview)->play_ns - play_ns, 1, 100000000);
}

static void quitting_ends_without_another_frame(void **state) {
    (void)state;
    static const DipEvent ways[] = {
        {.kind = DIP_EVENT_QUIT},
        {.kind = DIP_EVENT_KEY_DOWN, .key = DIP_KEYCODE_ESCAPE},
        {.kind = DIP_EVENT_KEY_DOWN, .key = (DipKeycode)'q', .modifiers = DIP_MODIFIER_CTRL}};
    for (size_t i = 0; i < sizeof ways / sizeof ways[0]; ++i) {
        turn();
        assert_false(dip_preview_has_quit(preview));
        const int presented = dip_fake_display_present_count(fake);
        dip_fake_display_push(fake, &ways[i]);
        turn();
        assert_true(dip_preview_has_quit(preview));
        assert_int_equal(dip_fake_display_present_count(fake), presented);
        tear_down(NULL);
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
    const DipPixels shown = dip_fake_display_picture(fake);
    unsigned char *expected = NULL;
    size_t expected_bytes = 0;
    assert_true(dip_png_encode(shown.rgba8, shown.stride_bytes, shown.width, shown.height,
                               &expected, &expected_bytes));
    press(DIP_KEYCODE_F12);
    char notice[256];
    snprintf(notice, sizeof notice, "Saved diptych-0001.png in %s", folder);
    assert_string_equal(dip_preview_state(preview)->notice, notice);
    unsigned char *found;
    size_t found_bytes;
    png_read("diptych-0001.png", &found, &found_bytes);
    assert_int_equal(png_strip_texts(found, found_bytes), expected_bytes);
    assert_memory_equal(found, expected, expected_bytes);
    free(found);
    free(expected);
    assert_true(remove("diptych-0001.png") == 0 && chdir(before) == 0 && rmdir(folder) == 0);
}

// After any events, the display shows what was drawn (turn() checks this), and nothing fails.
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
        dip_fake_display_push(fake, &event);
        if (value % 50 == 0) {
            assert_true(dip_fake_display_resize(fake, 1 + (int)(value / 50 % 500),
                                                1 + (int)(value / 7 % 300)));
        }
        if (value % 3 == 0) {
            turn();
        }
    }
    turn();
}

int main(void) {
#define PREVIEW_TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
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
