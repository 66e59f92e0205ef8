// A virtual game controller drives a tour of the preview through SDL: it is plugged in, chooses a
// setting, changes it, applies it, goes to the next path, pauses, flies, and is unplugged. SDL's
// dummy driver stands for the screen.
#include "app/display/sdl/sdl_display.h"
#include "app/preview/loop/loop.h"
#include "renderer/catalogue/scenes.h"

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

static DipTestScene scene;
static DipSession session;
static DipCamPath *paths[2];
static DipDisplay display;
static DipPreview *preview;
static int device = -1; // SDL's index of the virtual controller.
static SDL_Joystick *joystick;

// --- the fixture -------------------------------------------------------------------------------

static bool load_scene_def(DipSession *unused, DipError *err) {
    (void)unused;
    (void)err;
    session.scene_def = scene.def;
    return true;
}

// Makes a path of ten seconds, past the scene's chequers and back.
static DipCamPath *make_path(double length_m) {
    DipCamPath *path = NULL;
    DipCamKey keys[2];
    for (int i = 0; i < 2; ++i) {
        memcpy(keys[i].position_world, scene.pose.position_world, sizeof keys[i].position_world);
        memcpy(keys[i].orientation, scene.pose.orientation, sizeof keys[i].orientation);
        keys[i].position_world[0] += i * length_m;
    }
    assert_true(dip_campath_create(keys, 2, INT64_C(5000000000), &path, NULL));
    return path;
}

static int set_up(void **state) {
    (void)state;
    DipError err = {0};
    // No window has the focus on the dummy driver.
    SDL_SetHint(SDL_HINT_JOYSTICK_ALLOW_BACKGROUND_EVENTS, "1");
    setenv("SDL_VIDEODRIVER", "dummy", 1);
    dip_test_scene_make(&scene, DIP_TEST_SCENE_grazing_checker);
    session = (DipSession){.pool = dip_pool_create(1, NULL)};
    session.scene = dip_scene_create(&scene.def, NULL, NULL);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        DipRendererDef def = dip_renderer_default_def();
        def.pool = session.pool;
        session.renderers[p] = dip_painter_create(&def, NULL, NULL);
        assert_non_null(session.renderers[p]);
    }
    session.track = dip_camtrack_make(true);
    for (int i = 0; i < 2; ++i) {
        paths[i] = make_path(1.0 + i);
        dip_camtrack_set(&session.track, i, paths[i], 60.0);
    }
    if (!dip_sdl_display_open(&display, 0, WIDTH, HEIGHT, &err)) {
        fail_msg("%s", err.message);
    }
    const DipPreviewDef def = {.session = &session,
                               .display = display,
                               .flying_speed_m_per_s = 1.0,
                               .load_scene_def = load_scene_def};
    preview = dip_preview_create(&def, NULL);
    assert_true(session.scene && preview);
    return 0;
}

static int tear_down(void **state) {
    (void)state;
    dip_preview_destroy(&preview);
    display.close(display.context);
    for (int i = 0; i < 2; ++i) {
        dip_campath_destroy(&paths[i]);
    }
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        dip_painter_destroy(&session.renderers[p]);
    }
    dip_scene_destroy(&session.scene);
    dip_pool_destroy(&session.pool);
    dip_test_scene_free(&scene);
    return 0;
}

// --- driving and looking -----------------------------------------------------------------------

static void turn(void) {
    DipError err = {0};
    if (!dip_preview_turn(preview, &err)) {
        fail_msg("%s", err.message);
    }
}

static const DipPreviewState *now(void) {
    return dip_preview_state(preview);
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
    turn();
}

static void unplug(void) {
    SDL_JoystickClose(joystick);
    assert_int_equal(SDL_JoystickDetachVirtual(device), 0);
    turn();
}

static void press(SDL_GameControllerButton button) {
    SDL_JoystickSetVirtualButton(joystick, button, 1);
    turn();
    SDL_JoystickSetVirtualButton(joystick, button, 0);
    turn();
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
    const DipPixels picture = dip_preview_picture(preview);
    const DipRect rect = dip_preview_layout(preview).panes[pane];
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
    const DipRect rect = dip_preview_layout(preview).panes[pane];
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
        turn();
    }
    tilt(axis, rest);
    turn();
    return changed(DIP_PANE_REQUESTED, before);
}

// --- tests -------------------------------------------------------------------------------------

static void a_virtual_controller_drives_the_tour(void **state) {
    (void)state;
    turn();
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
    assert_false(dip_preview_has_quit(preview));
    const int path = session.track.active;
    press(SDL_CONTROLLER_BUTTON_DPAD_RIGHT);
    assert_int_not_equal(session.track.active, path);
    press(SDL_CONTROLLER_BUTTON_DPAD_LEFT);
    assert_int_equal(session.track.active, path);

    press(SDL_CONTROLLER_BUTTON_START);
    assert_true(now()->paused);
    uint8_t *still = look(DIP_PANE_REQUESTED);
    turn();
    assert_false(changed(DIP_PANE_REQUESTED, still));

    press(SDL_CONTROLLER_BUTTON_Y);
    assert_true(now()->manual);
    assert_true(flies(SDL_CONTROLLER_AXIS_LEFTX, 32767, 0));
    assert_true(flies(SDL_CONTROLLER_AXIS_LEFTY, -32768, 0));
    assert_true(flies(SDL_CONTROLLER_AXIS_RIGHTX, -32768, 0));
    assert_true(flies(SDL_CONTROLLER_AXIS_TRIGGERRIGHT, 32767, -32768));
    assert_false(flies(SDL_CONTROLLER_AXIS_LEFTX, 4000, 0)); // Inside the dead zone.

    tilt(SDL_CONTROLLER_AXIS_LEFTX, 32767);
    turn();
    unplug();
    assert_non_null(strstr(now()->notice, "Controller disconnected"));
    still = look(DIP_PANE_REQUESTED);
    for (int i = 0; i < 3; ++i) {
        SDL_Delay(20);
        turn();
    }
    // The label of the pane may change, but a camera that still flies would change much more.
    assert_false(changed(DIP_PANE_REQUESTED, still));

    plug_in(); // The same device again, with another number.
    assert_non_null(strstr(now()->notice, "Controller connected: "));
    press(SDL_CONTROLLER_BUTTON_Y);
    assert_false(now()->manual);
    press(SDL_CONTROLLER_BUTTON_BACK);
    assert_true(dip_preview_has_quit(preview));
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
