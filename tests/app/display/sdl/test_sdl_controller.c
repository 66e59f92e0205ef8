// A virtual game controller drives a tour of the preview through SDL: it is plugged in, chooses a
// setting, changes it, applies it, goes to the next path, pauses, flies, and is unplugged. SDL's
// dummy driver stands for the screen.
#include "app/display/sdl/sdl_display.h"
#include "tests/app/preview/made_preview.h"

#include <SDL2/SDL.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 800, HEIGHT = 600, MAX_CONTROLS = 60 };

static DipCamPath *second_path;
static int device = -1; // SDL's index of the virtual controller.
static SDL_Joystick *joystick;

// --- the fixture -------------------------------------------------------------------------------

static int set_up(void **state) {
    (void)state;
    DipError err = {0};
    // No window has the focus on the dummy driver.
    SDL_SetHint(SDL_HINT_JOYSTICK_ALLOW_BACKGROUND_EVENTS, "1");
    setenv("SDL_VIDEODRIVER", "dummy", 1);
    dip_made_open_session(1, 2, NULL);
    second_path = dip_made_path(2, 2.0);
    dip_camtrack_set(&made.session.track, DIP_CATEGORY_AA, second_path, 60.0);
    if (!dip_sdl_display_open(&made.display, 0, WIDTH, HEIGHT, &err)) {
        fail_msg("%s", err.message);
    }
    assert_true(dip_made_create_preview(NULL, NULL));
    return 0;
}

static int tear_down(void **state) {
    dip_made_tear_down(state);
    dip_campath_destroy(&second_path);
    return 0;
}

// --- driving and looking -----------------------------------------------------------------------

static const DipPreviewState *now(void) {
    return dip_preview_state(made.preview);
}

static void plug_in(void) {
    device = SDL_JoystickAttachVirtual(SDL_JOYSTICK_TYPE_GAMECONTROLLER, SDL_CONTROLLER_AXIS_MAX,
                                       SDL_CONTROLLER_BUTTON_MAX, 0);
    assert_true(device >= 0 && SDL_IsGameController(device));
    joystick = SDL_JoystickOpen(device);
    assert_non_null(joystick);
    // A trigger at rest is at the lowest value of the device's axis.
    SDL_JoystickSetVirtualAxis(joystick, SDL_CONTROLLER_AXIS_TRIGGERLEFT, -32768);
    SDL_JoystickSetVirtualAxis(joystick, SDL_CONTROLLER_AXIS_TRIGGERRIGHT, -32768);
    dip_made_turn();
}

static void unplug(void) {
    SDL_JoystickClose(joystick);
    assert_int_equal(SDL_JoystickDetachVirtual(device), 0);
    dip_made_turn();
}

static void press(SDL_GameControllerButton button) {
    SDL_JoystickSetVirtualButton(joystick, button, 1);
    dip_made_turn();
    SDL_JoystickSetVirtualButton(joystick, button, 0);
    dip_made_turn();
}

static void tilt(SDL_GameControllerAxis axis, Sint16 value) {
    SDL_JoystickSetVirtualAxis(joystick, axis, value);
}

// Whether the two panes' settings differ.
static bool differ(void) {
    return memcmp(&now()->quality[DIP_PANE_CURRENT], &now()->quality[DIP_PANE_REQUESTED],
                  sizeof(DipQuality)) != 0;
}

// Copies the pixels of a pane.
static uint8_t *look(int pane) {
    const DipPixels picture = dip_preview_picture(made.preview);
    const DipRect rect = dip_preview_layout(made.preview).panes[pane];
    const size_t row_bytes = 4 * (size_t)rect.width;
    uint8_t *copy = malloc(row_bytes * (size_t)rect.height);
    assert_non_null(copy);
    for (int y = 0; y < rect.height; ++y) {
        memcpy(copy + (size_t)y * row_bytes,
               picture.rgba8 + (size_t)(rect.y + y) * picture.stride_bytes + 4 * (size_t)rect.x,
               row_bytes);
    }
    return copy;
}

// Returns whether a pane shows other pixels than the copy, which is freed.
static bool changed(int pane, uint8_t *before) {
    const DipRect rect = dip_preview_layout(made.preview).panes[pane];
    uint8_t *after = look(pane);
    const bool other = memcmp(before, after, 4 * (size_t)rect.width * (size_t)rect.height) != 0;
    free(before);
    free(after);
    return other;
}

// Moves the focus from control to control, and steps each, until a setting has changed.
static void choose_and_change_a_setting(void) {
    for (int i = 0; i < MAX_CONTROLS && !differ(); ++i) {
        press(SDL_CONTROLLER_BUTTON_RIGHTSHOULDER);
        press(SDL_CONTROLLER_BUTTON_DPAD_RIGHT);
    }
    assert_true(differ());
}

// Flies with one axis tilted, and returns whether the requested pane shows another picture.
static bool flies(SDL_GameControllerAxis axis, Sint16 value, Sint16 rest) {
    uint8_t *before = look(DIP_PANE_REQUESTED);
    tilt(axis, value);
    for (int i = 0; i < 5; ++i) {
        SDL_Delay(20);
        dip_made_turn();
    }
    tilt(axis, rest);
    dip_made_turn();
    return changed(DIP_PANE_REQUESTED, before);
}

// --- tests -------------------------------------------------------------------------------------

static void a_virtual_controller_drives_the_tour(void **state) {
    (void)state;
    dip_made_turn();
    assert_int_equal(now()->notice[0], '\0');
    plug_in();
    assert_non_null(strstr(now()->notice, "Controller connected: "));
    assert_true(now()->tools.open);

    const DipQuality before = now()->quality[DIP_PANE_CURRENT];
    choose_and_change_a_setting();
    assert_memory_equal(&before, &now()->quality[DIP_PANE_CURRENT], sizeof before);
    press(SDL_CONTROLLER_BUTTON_X);
    assert_false(differ());
    assert_memory_not_equal(&before, &now()->quality[DIP_PANE_CURRENT], sizeof before);
    press(SDL_CONTROLLER_BUTTON_B);
    assert_true(differ());

    press(SDL_CONTROLLER_BUTTON_BACK); // Takes the focus away.
    assert_false(dip_preview_state(made.preview)->quit);
    const int path = made.session.track.active;
    press(SDL_CONTROLLER_BUTTON_DPAD_RIGHT);
    assert_int_not_equal(made.session.track.active, path);
    press(SDL_CONTROLLER_BUTTON_DPAD_LEFT);
    assert_int_equal(made.session.track.active, path);

    press(SDL_CONTROLLER_BUTTON_START);
    assert_true(now()->paused);
    uint8_t *still = look(DIP_PANE_REQUESTED);
    dip_made_turn();
    assert_false(changed(DIP_PANE_REQUESTED, still));

    press(SDL_CONTROLLER_BUTTON_Y);
    assert_true(now()->manual);
    assert_true(flies(SDL_CONTROLLER_AXIS_LEFTX, 32767, 0));
    assert_true(flies(SDL_CONTROLLER_AXIS_LEFTY, -32768, 0));
    assert_true(flies(SDL_CONTROLLER_AXIS_RIGHTX, -32768, 0));
    assert_true(flies(SDL_CONTROLLER_AXIS_TRIGGERRIGHT, 32767, -32768));
    assert_false(flies(SDL_CONTROLLER_AXIS_LEFTX, 4000, 0)); // Inside the dead zone.

    tilt(SDL_CONTROLLER_AXIS_LEFTX, 32767);
    dip_made_turn();
    unplug();
    assert_non_null(strstr(now()->notice, "Controller disconnected"));
    still = look(DIP_PANE_REQUESTED);
    for (int i = 0; i < 3; ++i) {
        SDL_Delay(20);
        dip_made_turn();
    }
    // The label of the pane may change, but a camera that still flies would change much more.
    assert_false(changed(DIP_PANE_REQUESTED, still));

    plug_in(); // The same device again, with another number.
    assert_non_null(strstr(now()->notice, "Controller connected: "));
    press(SDL_CONTROLLER_BUTTON_Y);
    assert_false(now()->manual);
    press(SDL_CONTROLLER_BUTTON_BACK);
    assert_true(dip_preview_state(made.preview)->quit);
    SDL_JoystickClose(joystick);
}

static void plugging_in_and_out_leaves_nothing_behind(void **state) {
    (void)state;
    for (int i = 0; i < 20; ++i) {
        plug_in();
        tilt(SDL_CONTROLLER_AXIS_LEFTX, 32767);
        press(SDL_CONTROLLER_BUTTON_START);
        assert_int_equal(now()->paused, i % 2 == 0);
        unplug();
    }
    assert_int_equal(SDL_NumJoysticks(), 0);
}

int main(void) {
#define TOUR_TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
    const struct CMUnitTest tests[] = {
        TOUR_TEST(a_virtual_controller_drives_the_tour),
        TOUR_TEST(plugging_in_and_out_leaves_nothing_behind),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
