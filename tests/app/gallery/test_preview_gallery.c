// Tests of gallery scenes in the preview, on a fake display: keys change the scene and its look.
// Usage: test_preview_gallery SOURCE_FOLDER
#include "tests/app/display/fake_display.h"
#include "app/preview/loop/loop.h"
#include "app/preview/state/pilot.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 402, HEIGHT = 240, FIRST_ROW = 80, LAST_ROW = 210 };

static char ini[512], model[512];
static DipSessionOptions options;
static DipSession session;
static DipDisplay display;
static DipFakeDisplay *fake;
static DipPreview *preview;

static bool no_scene_def(DipSession *unused, DipError *err) {
    (void)unused;
    return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "scene", "there is none");
}

// Opens a scene of the gallery, or the model if `scene` is NULL.
static void open_scene(const char *scene) {
    DipErrorList faults = {0};
    options = (DipSessionOptions){.config = ini,
                                  .scene = scene,
                                  .models = {model},
                                  .model_count = scene ? 0 : 1,
                                  .has_threads = true,
                                  .threads = 1};
    const DipSessionDef def = {.options = &options, .scene = true, .renderers = true};
    if (!dip_session_open(&session, &def, &faults)) {
        fail_msg("%s", faults.items[0].message);
    }
    dip_error_list_free(&faults);
    fake = dip_fake_display_open(&display, WIDTH, HEIGHT);
    const DipPreviewDef preview_def = {.session = &session,
                                       .display = display,
                                       .hides_panel = true,
                                       .load_scene_def = no_scene_def};
    preview = dip_preview_create(&preview_def, NULL);
    assert_non_null(preview);
}

static int close_scene(void **state) {
    (void)state;
    dip_preview_destroy(&preview);
    display.close(display.context);
    dip_session_close(&session);
    return 0;
}

static void turn(void) {
    DipError err = {0};
    if (!dip_preview_turn(preview, &err)) {
        fail_msg("%s", err.message);
    }
}

static void press(DipKeycode key, unsigned modifiers) {
    dip_fake_display_press(fake, key, modifiers);
    turn();
    turn();
}

// Returns a hash of the rows that no label covers. The panel is hidden, because it shows times.
static uint64_t look_at(void) {
    const DipPixels shown = dip_fake_display_picture(fake);
    uint64_t hash = 14695981039346656037u;
    for (int y = FIRST_ROW; y < LAST_ROW; y++) {
        const uint8_t *row = shown.rgba8 + (size_t)y * shown.stride_bytes;
        for (size_t i = 0; i < 4 * (size_t)shown.width; i++) {
            hash = (hash ^ row[i]) * 1099511628211u;
        }
    }
    return hash;
}

static void keys_change_the_scene(void **state) {
    (void)state;
    open_scene("blend");
    turn();
    const int begin = session.gallery_scene;
    press(DIP_KEYCODE_SPACE, 0);
    press(DIP_KEYCODE_PAGE_DOWN, DIP_MODIFIER_CTRL);
    assert_int_equal(session.gallery_scene, begin + 1);
    assert_string_equal(dip_preview_state(preview)->scene_title,
                        dip_gallery_info(begin + 1)->title);
    press(DIP_KEYCODE_RIGHT, 0);
    assert_int_equal(session.gallery_scene, begin + 2);
    press(DIP_KEYCODE_LEFT, 0);
    press(DIP_KEYCODE_PAGE_UP, DIP_MODIFIER_CTRL);
    assert_int_equal(session.gallery_scene, begin);
}

// A model is orbited, and a scene of the gallery is not. Each begins with the speed that suits it,
// whatever speed the user has chosen in the scene before.
static void each_scene_begins_a_flight_of_its_own(void **state) {
    (void)state;
    open_scene(NULL);
    turn();
    const DipFlight *flight = &dip_preview_state(preview)->flight;
    assert_true(flight->orbits);
    press('\\', 0); // Frees the camera,
    press('\\', 0); // and ends the orbit, so that the wheel changes the speed.
    const DipEvent wheel = {.kind = DIP_EVENT_MOUSE_WHEEL, .x = 50, .y = 100, .wheel_y = 3.0};
    dip_fake_display_push(fake, &wheel);
    turn();
    assert_false(flight->orbits);
    assert_int_equal(flight->speed_steps, 3);
    press(DIP_KEYCODE_PAGE_DOWN, DIP_MODIFIER_CTRL);
    assert_true(dip_preview_state(preview)->shows_gallery);
    assert_false(flight->orbits);
    assert_true(dip_flight_speed(flight) == 3.0);
    press(DIP_KEYCODE_PAGE_UP, DIP_MODIFIER_CTRL);
    assert_false(dip_preview_state(preview)->shows_gallery);
    assert_true(flight->orbits);
    float low[3], high[3];
    double squared = 0.0;
    dip_scene_bounds(session.scene, low, high);
    for (int i = 0; i < 3; i++) {
        squared += ((double)high[i] - low[i]) * ((double)high[i] - low[i]);
    }
    assert_true(fabs(dip_flight_speed(flight) - sqrt(squared) / 4.0) < 1e-9);
}

static void a_key_changes_the_look(void **state) {
    (void)state;
    open_scene("toon");
    turn();
    press(DIP_KEYCODE_SPACE, 0);
    const uint64_t first = look_at();
    press('\'', 0);
    const uint64_t second = look_at();
    assert_true(first != second);
    assert_string_equal(dip_preview_state(preview)->scene_look, "8 bands");
    press('\'', DIP_MODIFIER_SHIFT);
    assert_true(look_at() == first);
}

static void settings_change_the_requested_pane(void **state) {
    (void)state;
    open_scene("dice");
    turn();
    press(DIP_KEYCODE_SPACE, 0);
    const uint64_t before = look_at();
    press('m', 0); // mip colours
    assert_true(look_at() != before);
    press('r', 0); // the panel, which has no errors to show here
    for (int i = 0; i < 20; i++) {
        turn();
    }
    assert_true(dip_preview_shows_times(dip_preview_state(preview)));
}

static void the_tour_goes_from_scene_to_scene(void **state) {
    (void)state;
    open_scene("tour");
    turn();
    const char *first = dip_preview_state(preview)->scene_title;
    assert_string_equal(first, dip_gallery_info(0)->title);
    for (int i = 0; i < 600 && dip_preview_state(preview)->scene_title == first; i++) {
        dip_fake_display_advance(fake, 100000000);
        turn();
    }
    assert_string_equal(dip_preview_state(preview)->scene_title, dip_gallery_info(1)->title);
    press(DIP_KEYCODE_PAGE_DOWN, DIP_MODIFIER_CTRL);
    assert_int_equal(session.gallery_scene, 0);
}

int main(int argc, char **argv) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(keys_change_the_scene, close_scene),
        cmocka_unit_test_teardown(each_scene_begins_a_flight_of_its_own, close_scene),
        cmocka_unit_test_teardown(a_key_changes_the_look, close_scene),
        cmocka_unit_test_teardown(settings_change_the_requested_pane, close_scene),
        cmocka_unit_test_teardown(the_tour_goes_from_scene_to_scene, close_scene),
    };
    snprintf(ini, sizeof ini, "%s/config/courtyard.ini", argc > 1 ? argv[1] : ".");
    snprintf(model, sizeof model, "%s/assets/gallery/pump.glb", argc > 1 ? argv[1] : ".");
    return cmocka_run_group_tests(tests, NULL, NULL);
}
