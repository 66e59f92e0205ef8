// Tests of game controllers without any device: events go in; actions, keys and poses come out.
#include "app/preview/state/controller.h"

#include "app/preview/state/camera.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static DipControllers controllers;
static DipPreviewState state;
static DipCamTrack track;

static int set_up(void **unused) {
    (void)unused;
    const DipQuality quality[DIP_PANE_COUNT] = {dip_quality_default(), dip_quality_default()};
    memset(&controllers, 0, sizeof controllers);
    track = dip_camtrack_make(true);
    state = dip_preview_state_make(quality, &track);
    return 0;
}

static bool send(DipEvent event, DipEvent *key) {
    DipEvent ignored;
    assert_true(dip_controllers_concern(&event));
    return dip_controllers_handle(&controllers, &state, &event, 0, key ? key : &ignored);
}

static void add(int controller) {
    DipEvent event = {.kind = DIP_EVENT_CONTROLLER_ADDED, .controller = controller};
    strcpy(event.text, "Pad");
    assert_false(send(event, NULL));
}

static void tilt(int controller, DipControllerAxis axis, double value) {
    assert_false(send((DipEvent){.kind = DIP_EVENT_CONTROLLER_AXIS,
                                 .controller = controller,
                                 .axis = axis,
                                 .axis_value = value},
                      NULL));
}

static DipPose origin(void) {
    return (DipPose){.orientation = {0.0, 0.0, 0.0, 1.0}};
}

// Flies for a second at 1 m/s from the origin.
static DipPose fly(void) {
    DipPose pose = origin();
    dip_controllers_fly(&controllers, &pose, 1.0, 1.0);
    return pose;
}

static void assert_position(double x, double y, double z) {
    const DipPose pose = fly();
    const double expected[3] = {x, y, z};
    for (int i = 0; i < 3; ++i) {
        if (fabs(pose.position_world[i] - expected[i]) > 1e-12) {
            fail_msg("axis %d: %.15g instead of %.15g", i, pose.position_world[i], expected[i]);
        }
    }
}

static void sticks_at_rest_do_not_move_the_camera(void **unused) {
    (void)unused;
    const DipPose at_rest = origin();
    DipPose pose = at_rest;
    add(7);
    for (int a = 0; a < DIP_CONTROLLER_AXIS_COUNT; ++a) {
        tilt(7, (DipControllerAxis)a, 0.11); // A stick's noise in x and y together is .156.
    }
    assert_false(dip_controllers_fly(&controllers, &pose, 1.0, 1.0));
    assert_memory_equal(&pose, &at_rest, sizeof pose);
    tilt(7, DIP_CONTROLLER_LEFT_TRIGGER, 0.0); // The right trigger alone.
    assert_false(dip_controllers_fly(&controllers, &pose, 1.0, 1.0));
}

// The camera looks along -z, with y up.
static void a_full_tilt_is_as_fast_as_a_key(void **unused) {
    (void)unused;
    add(7);
    tilt(7, DIP_CONTROLLER_LEFT_Y, -1.0);
    assert_position(0.0, 0.0, -1.0);
    tilt(7, DIP_CONTROLLER_LEFT_Y, 1.0);
    assert_position(0.0, 0.0, 1.0);
    tilt(7, DIP_CONTROLLER_LEFT_Y, 0.0);
    tilt(7, DIP_CONTROLLER_LEFT_X, 1.0);
    assert_position(1.0, 0.0, 0.0);
    tilt(7, DIP_CONTROLLER_RIGHT_TRIGGER, 1.0);
    assert_position(1.0, 1.0, 0.0);
    tilt(7, DIP_CONTROLLER_LEFT_TRIGGER, 1.0);
    assert_position(1.0, 0.0, 0.0);
}

// The speed begins with 0 at the edge of the dead zone, and grows in proportion to the tilt.
static void speed_begins_at_the_dead_zone(void **unused) {
    (void)unused;
    const double edge = 7849.0 / 32767.0;
    add(7);
    tilt(7, DIP_CONTROLLER_LEFT_X, edge);
    assert_position(0.0, 0.0, 0.0);
    tilt(7, DIP_CONTROLLER_LEFT_X, 0.5 * (1.0 + edge));
    assert_position(0.5, 0.0, 0.0);
    // Tilts of .3 and .4 make .5 together; each axis keeps its share of three and four fifths.
    tilt(7, DIP_CONTROLLER_LEFT_X, 0.3);
    tilt(7, DIP_CONTROLLER_LEFT_Y, 0.4);
    const double speed = (0.5 - edge) / (1.0 - edge);
    assert_position(0.6 * speed, 0.0, 0.8 * speed);
    // Corners of a square stick are no faster than the rim.
    tilt(7, DIP_CONTROLLER_LEFT_X, 1.0);
    tilt(7, DIP_CONTROLLER_LEFT_Y, 1.0);
    assert_position(sqrt(0.5), 0.0, sqrt(0.5));
}

static void the_right_stick_turns_as_the_keys_do(void **unused) {
    (void)unused;
    DipPose by_key = origin();
    const DipCameraKeys keys = {.right = 1.0, .turn = true};
    dip_camera_move(&by_key, &keys, 1.0, 1.0);
    add(7);
    tilt(7, DIP_CONTROLLER_RIGHT_X, 1.0);
    const DipPose by_stick = fly();
    assert_memory_equal(&by_stick, &by_key, sizeof by_key);
}

static void an_unplugged_controller_stops_the_camera(void **unused) {
    (void)unused;
    add(7);
    assert_non_null(strstr(state.notice, "Controller connected: Pad"));
    tilt(7, DIP_CONTROLLER_LEFT_X, 1.0);
    assert_position(1.0, 0.0, 0.0);
    send((DipEvent){.kind = DIP_EVENT_CONTROLLER_REMOVED, .controller = 7}, NULL);
    assert_non_null(strstr(state.notice, "disconnected"));
    assert_position(0.0, 0.0, 0.0);
    tilt(7, DIP_CONTROLLER_LEFT_X, 1.0); // Unknown by now.
    add(8);
    assert_position(0.0, 0.0, 0.0);
}

static void several_controllers_steer_together(void **unused) {
    (void)unused;
    for (int i = 0; i < 2 * DIP_MAX_CONTROLLERS; ++i) { // Half of them find no slot.
        add(i);
        tilt(i, DIP_CONTROLLER_LEFT_X, 1.0);
    }
    assert_position(1.0, 0.0, 0.0);
    tilt(0, DIP_CONTROLLER_LEFT_Y, -1.0);
    for (int i = 1; i < DIP_MAX_CONTROLLERS; ++i) {
        tilt(i, DIP_CONTROLLER_LEFT_X, 0.0);
    }
    assert_position(sqrt(0.5), 0.0, -sqrt(0.5));
}

static bool press(DipControllerButton button, DipEvent *key) {
    const bool is_key = send(
        (DipEvent){.kind = DIP_EVENT_CONTROLLER_DOWN, .controller = 7, .controller_button = button},
        key);
    DipEvent up;
    assert_int_equal(send((DipEvent){.kind = DIP_EVENT_CONTROLLER_UP,
                                     .controller = 7,
                                     .controller_button = button},
                          &up),
                     is_key);
    return is_key;
}

// The report's table of controls: Y, Start, the directional pad and Back.
static void buttons_do_what_the_table_of_controls_says(void **unused) {
    (void)unused;
    DipEvent key = {0};
    assert_false(press(DIP_CONTROLLER_START, &key));
    assert_true(state.paused);
    assert_false(press(DIP_CONTROLLER_START, &key));
    assert_false(state.paused);
    assert_false(press(DIP_CONTROLLER_Y, &key));
    assert_true(state.manual);
    assert_true(press(DIP_CONTROLLER_RIGHT, &key));
    assert_int_equal(key.key, DIP_KEYCODE_RIGHT);
    assert_true(press(DIP_CONTROLLER_LEFT, &key));
    assert_int_equal(key.key, DIP_KEYCODE_LEFT);
    assert_true(press(DIP_CONTROLLER_BACK, &key));
    assert_int_equal(key.key, DIP_KEYCODE_ESCAPE);
    assert_true(press(DIP_CONTROLLER_LEFT_SHOULDER, &key));
    assert_int_equal(key.key, DIP_KEYCODE_TAB);
    assert_int_equal(key.modifiers, DIP_MODIFIER_SHIFT);
}

int main(void) {
#define CONTROLLER_TEST(name) cmocka_unit_test_setup(name, set_up)
    const struct CMUnitTest tests[] = {
        CONTROLLER_TEST(sticks_at_rest_do_not_move_the_camera),
        CONTROLLER_TEST(a_full_tilt_is_as_fast_as_a_key),
        CONTROLLER_TEST(speed_begins_at_the_dead_zone),
        CONTROLLER_TEST(the_right_stick_turns_as_the_keys_do),
        CONTROLLER_TEST(an_unplugged_controller_stops_the_camera),
        CONTROLLER_TEST(several_controllers_steer_together),
        CONTROLLER_TEST(buttons_do_what_the_table_of_controls_says),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
