// Tests what the preview does when memory runs out: after a change of a setting or of the window's
// size, it shows the old picture and says why. Every other failure ends with an error, and the next
// turn shows the right picture.
#include "tests/app/display/fake_display.h"
#include "app/preview/loop/loop.h"
#include "app/preview/loop/view.h"
#include "config/config.h"
#include "renderer/catalogue/scenes.h"
#include "tests/support/allocation.h"
#include "tests/support/out_of_memory.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// No label and no notice covers the rows FIRST_ROW..LAST_ROW.
enum { WIDTH = 402, HEIGHT = 300, FIRST_ROW = 80, LAST_ROW = 200 };
enum { PANE_BYTES = 4 * 200 * (LAST_ROW - FIRST_ROW) };

static DipTestScene scene;
static DipSession session;
static DipCamPath *path;
static DipDisplay display;
static DipFakeDisplay *fake;
static DipPreview *preview;
static uint8_t old_pane[PANE_BYTES];
static uint8_t new_pane[PANE_BYTES];
static DipKeycode key; // The key under test.

static bool load_scene_def(DipSession *unused, DipError *err) {
    (void)unused;
    (void)err;
    session.scene_def = scene.def;
    return true;
}

static bool open_preview(void *context, DipError *err) {
    (void)context;
    const DipPreviewDef def = {.session = &session,
                               .display = display,
                               .flying_speed_m_per_s = 1.0,
                               .load_scene_def = load_scene_def};
    preview = dip_preview_create(&def, err);
    return preview != NULL;
}

static bool turn(void *context, DipError *err) {
    (void)context;
    return dip_preview_turn(preview, err);
}

static void make_path(void) {
    DipCamKey keys[1];
    memcpy(keys[0].position_world, scene.pose.position_world, sizeof keys[0].position_world);
    memcpy(keys[0].orientation, scene.pose.orientation, sizeof keys[0].orientation);
    assert_true(dip_campath_create(keys, 1, INT64_C(5000000000), &path, NULL));
    session.track = dip_camtrack_make(true);
    dip_camtrack_set(&session.track, DIP_CATEGORY_DEFAULT, path, 60.0);
}

static void open_session(void *context) {
    (void)context;
    session = (DipSession){.pool = dip_pool_create(1, NULL)};
    session.scene = dip_scene_create(&scene.def, NULL, NULL);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        DipRendererDef def = dip_renderer_default_def();
        def.pool = session.pool;
        def.width = 200;
        def.height = HEIGHT;
        session.renderers[p] = dip_painter_create(&def, NULL, NULL);
        assert_non_null(session.renderers[p]);
    }
    make_path();
    fake = dip_fake_display_open(&display, WIDTH, HEIGHT);
    assert_non_null(fake);
}

static void close_all(void *context) {
    (void)context;
    dip_preview_destroy(&preview);
    display.close(display.context);
    dip_campath_destroy(&path);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        dip_painter_destroy(&session.renderers[p]);
    }
    dip_scene_destroy(&session.scene);
    dip_pool_destroy(&session.pool);
}

static void must_turn(void) {
    DipError err;
    if (!turn(NULL, &err)) {
        fail_msg("%s", err.message);
    }
}

static void press(DipKeycode pressed) {
    dip_fake_display_press(fake, pressed, 0);
}

// Opens a preview that rests, and lets it load everything that it loads beside the frames.
static void open_resting(void *context) {
    open_session(context);
    assert_true(open_preview(context, NULL));
    press(DIP_KEYCODE_SPACE);
    for (int i = 0; i < 3; ++i) {
        must_turn();
    }
    // Waits for the thread that prepares textures, so that it allocates nothing later.
    assert_true(dip_scene_compress_textures(session.scene, NULL, NULL));
}

// Copies the rows of the requested pane that no text covers.
static void look(uint8_t pane[PANE_BYTES]) {
    const DipPixels shown = dip_fake_display_picture(fake);
    const DipLayout layout = dip_preview_layout(preview);
    const DipRect *panes = layout.panes;
    const DipRect *rect = &panes[DIP_PANE_REQUESTED];
    const size_t row_bytes = 4 * (size_t)(rect->width < 200 ? rect->width : 200);
    memset(pane, 0, PANE_BYTES);
    for (int y = FIRST_ROW; y < LAST_ROW && y < shown.height; ++y) {
        memcpy(pane + (size_t)(y - FIRST_ROW) * row_bytes,
               shown.rgba8 + (size_t)y * shown.stride_bytes + 4 * (size_t)rect->x, row_bytes);
    }
}

static const DipPreviewState *state_of_preview(void) {
    return dip_preview_state(preview);
}

// --- opening -------------------------------------------------------------------------------------

static void check_open(void *context, bool succeeded) {
    assert_int_equal(preview != NULL, succeeded);
    assert_true(succeeded || open_preview(context, NULL));
    must_turn();
}

static void preview_opens_whole_or_not_at_all(void **state) {
    (void)state;
    dip_out_of_memory_check(&(DipOutOfMemory){.name = "opening a preview",
                                              .prepare = open_session,
                                              .run = open_preview,
                                              .check = check_open,
                                              .finish = close_all,
                                              .needs_every_allocation = true});
}

static void open_session_and_preview(void *context) {
    open_session(context);
    assert_true(open_preview(context, NULL));
}

static void check_first(void *context, bool succeeded) {
    (void)context;
    (void)succeeded;
    must_turn();
    look(new_pane);
    assert_memory_equal(new_pane, old_pane, PANE_BYTES);
}

static void failed_first_turn_can_be_repeated(void **state) {
    (void)state;
    open_resting(NULL);
    look(old_pane);
    close_all(NULL);
    dip_out_of_memory_check(&(DipOutOfMemory){.name = "the first turn of a preview",
                                              .prepare = open_session_and_preview,
                                              .run = turn,
                                              .check = check_first,
                                              .finish = close_all,
                                              .short_count = 24});
}

// --- keys ----------------------------------------------------------------------------------------

static DipQuality new_quality;

static void open_and_press(void *context) {
    open_resting(context);
    press(key);
}

// The preview shows the old settings with the old picture, or the new settings with the new one.
static void check_key(void *context, bool succeeded) {
    static uint8_t shown[PANE_BYTES];
    (void)context;
    (void)succeeded;
    for (int i = 0; i < 2; ++i) { // The second turn shows that the state stays.
        must_turn();
        const DipQuality *quality = &state_of_preview()->quality[DIP_PANE_REQUESTED];
        const bool is_new = memcmp(quality, &new_quality, sizeof new_quality) == 0;
        look(shown);
        assert_memory_equal(shown, is_new ? new_pane : old_pane, PANE_BYTES);
    }
}

static void check_press(const char *name, DipKeycode pressed) {
    key = pressed;
    open_resting(NULL);
    look(old_pane);
    press(key);
    must_turn();
    look(new_pane);
    new_quality = state_of_preview()->quality[DIP_PANE_REQUESTED];
    close_all(NULL);
    dip_out_of_memory_check(&(DipOutOfMemory){.name = name,
                                              .prepare = open_and_press,
                                              .run = turn,
                                              .check = check_key,
                                              .finish = close_all,
                                              .short_count = 8});
}

static void failed_key_shows_old_or_new_picture(void **state) {
    (void)state;
    static const struct {
        const char *name;
        DipKeycode key;
    } keys[] = {
        {"key of aa", (DipKeycode)'x'},       {"key of taa", (DipKeycode)'t'},
        {"key of aaa", (DipKeycode)'v'},      {"key of af", (DipKeycode)'f'},
        {"key of aaf", (DipKeycode)'g'},      {"key of miplod", (DipKeycode)'l'},
        {"key of gi", (DipKeycode)'i'},       {"key of opt", (DipKeycode)'o'},
        {"key of mipdebug", (DipKeycode)'m'},
    };
    for (size_t i = 0; i < sizeof keys / sizeof *keys; ++i) {
        check_press(keys[i].name, keys[i].key);
    }
}

// The frame that needs memory for its settings is drawn with the old ones, and the user is told.
static void failed_setting_is_taken_back_and_told(void **state) {
    (void)state;
    static uint8_t shown[PANE_BYTES];
    open_resting(NULL);
    look(old_pane);
    press((DipKeycode)'i'); // gi=off copies the meshes.
    dip_allocation_arm(DIP_FAIL_ONE, 0);
    const bool turned = turn(NULL, NULL);
    (void)dip_allocation_disarm();
    assert_int_equal(dip_allocation_failed(), 1);
    assert_true(turned);
    assert_int_equal(state_of_preview()->quality[DIP_PANE_REQUESTED].step[DIP_SETTING_GI], 1);
    assert_non_null(strstr(state_of_preview()->notice, "memory"));
    look(shown);
    assert_memory_equal(shown, old_pane, PANE_BYTES);
    press((DipKeycode)'i');
    must_turn();
    assert_int_equal(state_of_preview()->quality[DIP_PANE_REQUESTED].step[DIP_SETTING_GI], 0);
    close_all(NULL);
}

// --- the window's size ---------------------------------------------------------------------------

static void open_and_resize(void *context) {
    open_resting(context);
    assert_true(dip_fake_display_resize(fake, 502, 280));
}

static void check_resize(void *context, bool succeeded) {
    (void)context;
    (void)succeeded;
    must_turn();
    assert_int_equal(dip_preview_picture(preview).width, 502);
    // The next size finds memory again.
    assert_true(dip_fake_display_resize(fake, WIDTH, HEIGHT));
    must_turn();
    look(new_pane);
    assert_memory_equal(new_pane, old_pane, PANE_BYTES);
}

static void failed_size_keeps_the_old_one(void **state) {
    (void)state;
    open_resting(NULL);
    look(old_pane);
    // Every allocation of the second pane's size fails in turn; the panes must stay of one size.
    close_all(NULL);
    dip_out_of_memory_check(&(DipOutOfMemory){.name = "a new size of the window",
                                              .prepare = open_and_resize,
                                              .run = turn,
                                              .check = check_resize,
                                              .finish = close_all,
                                              .short_count = 24});
}

int main(int argc, char **argv) {
    dip_out_of_memory_read_options(argc, argv);
    dip_test_scene_make(&scene, DIP_TEST_SCENE_grazing_checker);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(preview_opens_whole_or_not_at_all),
        cmocka_unit_test(failed_first_turn_can_be_repeated),
        cmocka_unit_test(failed_key_shows_old_or_new_picture),
        cmocka_unit_test(failed_setting_is_taken_back_and_told),
        cmocka_unit_test(failed_size_keeps_the_old_one),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    dip_test_scene_free(&scene);
    return failed;
}
