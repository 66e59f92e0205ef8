// Tests what the preview does when memory runs out: after a change of a setting or of the window's
// size, it shows the old picture and says why. Every other failure ends with an error, and the next
// turn shows the right picture.
#include "app/preview/loop/view.h"
#include "tests/app/preview/made_preview.h"
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

static uint8_t old_pane[PANE_BYTES];
static uint8_t new_pane[PANE_BYTES];
static DipKeycode key; // The key under test.

static bool open_preview(void *context, DipError *err) {
    (void)context;
    return dip_made_create_preview(NULL, err);
}

static bool turn(void *context, DipError *err) {
    (void)context;
    return dip_preview_turn(made.preview, err);
}

static void open_session(void *context) {
    (void)context;
    DipRendererDef painter = dip_renderer_default_def();
    painter.width = 200;
    painter.height = HEIGHT;
    dip_made_open_session(1, 1, (const DipRendererDef[]){painter, painter});
    dip_made_open_display(WIDTH, HEIGHT);
}

static void close_all(void *context) {
    (void)context;
    dip_made_tear_down(NULL);
}

static void press(DipKeycode pressed) {
    dip_fake_display_press(made.fake, pressed, 0);
}

// Opens a preview that rests, and lets it load everything that it loads beside the frames.
static void open_resting(void *context) {
    open_session(context);
    assert_true(open_preview(context, NULL));
    press(DIP_KEYCODE_SPACE);
    for (int i = 0; i < 3; ++i) {
        dip_made_turn();
    }
    // Waits for the thread that prepares textures, so that it allocates nothing later.
    assert_true(dip_scene_compress_textures(made.session.scene, NULL, NULL));
}

// Copies the rows of the requested pane that no text covers.
static void look(uint8_t pane[PANE_BYTES]) {
    const DipPixels shown = dip_fake_display_picture(made.fake);
    const DipLayout layout = dip_preview_layout(made.preview);
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
    return dip_preview_state(made.preview);
}

// --- opening -------------------------------------------------------------------------------------

static void check_open(void *context, bool succeeded) {
    assert_int_equal(made.preview != NULL, succeeded);
    assert_true(succeeded || open_preview(context, NULL));
    dip_made_turn();
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
    dip_made_turn();
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
        dip_made_turn();
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
    dip_made_turn();
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
    dip_made_turn();
    assert_int_equal(state_of_preview()->quality[DIP_PANE_REQUESTED].step[DIP_SETTING_GI], 0);
    close_all(NULL);
}

// --- the window's size ---------------------------------------------------------------------------

static void open_and_resize(void *context) {
    open_resting(context);
    assert_true(dip_fake_display_resize(made.fake, 502, 280));
}

static void check_resize(void *context, bool succeeded) {
    (void)context;
    (void)succeeded;
    dip_made_turn();
    assert_int_equal(dip_preview_picture(made.preview).width, 502);
    // The next size finds memory again.
    assert_true(dip_fake_display_resize(made.fake, WIDTH, HEIGHT));
    dip_made_turn();
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
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(preview_opens_whole_or_not_at_all),
        cmocka_unit_test(failed_first_turn_can_be_repeated),
        cmocka_unit_test(failed_key_shows_old_or_new_picture),
        cmocka_unit_test(failed_setting_is_taken_back_and_told),
        cmocka_unit_test(failed_size_keeps_the_old_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
