// Tests of the free camera: drags and the wheel over the panes turn, orbit and speed up the camera,
// and leave clicks and the loupe's wheel alone. Poses are checked with rotation matrices.
#include "tests/app/preview/lone_window.h"
#include "app/preview/state/pilot.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { X = 300, Y = 200 }; // A point of the current pane.

static const double rad = 3.14159265358979323846 / 180.0;
static DipSession session;
static DipPose pose;
static double pane_height;

static int set_up(void **unused) {
    dip_lone_set_up(unused);
    pane_height = dip_view_layout(&lone.input).panes[0].height;
    session = (DipSession){.track = lone.track};
    dip_pilot_enter(&lone.state.flight, &session);
    pose = (DipPose){.position_world = {1, 2, 3}, .orientation = {0, 0, 0, 1}, .fov_y_deg = 60};
    return 0;
}

// --- driving -------------------------------------------------------------------------------------

static bool turn(void) {
    const DipPilotTurn pilot = {.session = &session};
    return dip_pilot_turn(&lone.state, &pilot, &pose);
}

static void drag(DipMouseButton button, int dx, int dy) {
    dip_lone_mouse(DIP_EVENT_MOUSE_DOWN, button, X, Y);
    dip_lone_mouse(DIP_EVENT_MOUSE_MOVE, button, X + dx / 2, Y + dy / 2);
    dip_lone_mouse(DIP_EVENT_MOUSE_MOVE, button, X + dx, Y + dy);
    dip_lone_mouse(DIP_EVENT_MOUSE_UP, button, X + dx, Y + dy);
    turn();
}

// --- looking -------------------------------------------------------------------------------------

// Writes the rotation matrix of the pose by the textbook formula. Its columns are the camera's
// axes in world space.
static void matrix_of(const DipPose *of, double m[3][3]) {
    const double *q = of->orientation;
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    const double rows[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
                               {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
                               {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}};
    memcpy(m, rows, sizeof rows);
}

// Asserts that the camera looks `right` degrees to the right of -Z and `up` degrees above the
// horizon, without roll.
static void assert_looks(double right, double up) {
    double m[3][3];
    matrix_of(&pose, m);
    assert_true(fabs(-m[0][2] - sin(right * rad) * cos(up * rad)) < 1e-12);
    assert_true(fabs(-m[1][2] - sin(up * rad)) < 1e-12);
    assert_true(fabs(-m[2][2] + cos(right * rad) * cos(up * rad)) < 1e-12);
    assert_true(fabs(m[1][0]) < 1e-12); // The right axis is level.
    assert_true(m[1][1] > 0.0);
}

static void camera_coordinates(const double world[3], double seen[3]) {
    double m[3][3];
    matrix_of(&pose, m);
    for (int c = 0; c < 3; ++c) {
        seen[c] = 0.0;
        for (int i = 0; i < 3; ++i) {
            seen[c] += m[i][c] * (world[i] - pose.position_world[i]);
        }
    }
}

// --- the tests -----------------------------------------------------------------------------------

static void dragging_turns_the_free_camera(void **unused) {
    (void)unused;
    lone.state.manual = true;
    for (int i = 0; i < 2; ++i) {
        const DipMouseButton button = i ? DIP_MOUSE_RIGHT : DIP_MOUSE_LEFT;
        pose.orientation[0] = pose.orientation[1] = pose.orientation[2] = 0.0;
        pose.orientation[3] = 1.0;
        drag(button, 100, 0);
        assert_looks(90.0 * 100 / pane_height, 0.0);
        drag(button, 0, -60);
        assert_looks(90.0 * 100 / pane_height, 90.0 * 60 / pane_height);
    }
    assert_true(pose.position_world[0] == 1.0 && pose.position_world[1] == 2.0 &&
                pose.position_world[2] == 3.0);
    assert_false(turn()); // Nothing is left of the drags.
}

static void the_camera_does_not_tip_over(void **unused) {
    (void)unused;
    for (int sign = -1; sign <= 1; sign += 2) {
        pose.orientation[0] = 0.0;
        pose.orientation[3] = 1.0;
        for (int i = 0; i < 40; ++i) {
            dip_camera_look(&pose, 0.0, sign * 7.0);
        }
        assert_looks(0.0, sign * 89.0);
        dip_camera_look(&pose, 0.0, -sign * 30.0);
        assert_looks(0.0, sign * 59.0);
    }
    // A camera upside down can turn back, but not further.
    pose = (DipPose){.orientation = {sin(60 * rad), 0, 0, cos(60 * rad)}}; // 120 degrees upwards.
    const DipPose before = pose;
    dip_camera_look(&pose, 0.0, 5.0);
    assert_true(fabs(pose.orientation[0] - before.orientation[0]) < 1e-12);
    dip_camera_look(&pose, 0.0, -50.0);
    assert_looks(0.0, 70.0);
}

// A camera on its side sees the horizon upright, so turning it upwards turns it about the world's
// vertical axis, all the way round.
static void a_camera_on_its_side_turns_all_the_way_round(void **unused) {
    (void)unused;
    for (int roll = -1; roll <= 1; roll += 2) {
        for (int sign = -1; sign <= 1; sign += 2) {
            pose.orientation[0] = pose.orientation[1] = 0.0;
            pose.orientation[2] = sin(45 * roll * rad);
            pose.orientation[3] = cos(45 * roll * rad);
            for (int i = 1; i <= 36; ++i) {
                double m[3][3];
                dip_camera_look(&pose, 0.0, sign * 10.0);
                matrix_of(&pose, m);
                assert_true(fabs(m[1][2]) < 1e-9); // The line of sight stays level
                assert_true(fabs(-m[2][2] + cos(10 * i * rad)) < 1e-9); // and turns.
                assert_true(fabs(-m[0][2] + roll * sign * sin(10 * i * rad)) < 1e-9);
            }
        }
    }
}

// A camera that is a little rolled stops where its up vector is nearly level, and turns back.
static void a_rolled_camera_does_not_tip_over(void **unused) {
    (void)unused;
    for (int sign = -1; sign <= 1; sign += 2) {
        double m[3][3];
        pose.orientation[0] = pose.orientation[1] = 0.0;
        pose.orientation[2] = sin(15 * rad);
        pose.orientation[3] = cos(15 * rad);
        for (int i = 0; i < 40; ++i) {
            dip_camera_look(&pose, 0.0, sign * 7.0);
        }
        matrix_of(&pose, m);
        assert_true(fabs(m[1][1] - cos(30 * rad) * cos(89 * rad)) < 1e-9);
        assert_true(fabs(-m[1][2] - sign * cos(30 * rad) * sin(89 * rad)) < 1e-9);
        dip_camera_look(&pose, 0.0, -sign * 89.0);
        matrix_of(&pose, m);
        assert_true(fabs(m[1][2]) < 1e-9);
    }
}

static void the_right_button_frees_the_camera_and_a_click_pins_the_loupe(void **unused) {
    (void)unused;
    drag(DIP_MOUSE_LEFT, 100, 0); // The left button only chooses the pane.
    assert_false(lone.state.manual);
    drag(DIP_MOUSE_RIGHT, 2, 1); // This is a click.
    assert_false(lone.state.manual);
    assert_true(lone.state.tools.pinned);
    lone.state.tools.pinned = false;
    drag(DIP_MOUSE_RIGHT, 100, 0);
    assert_true(lone.state.manual);
    assert_false(lone.state.tools.pinned);
    assert_looks(90.0 * 100 / pane_height, 0.0);
}

static void the_wipe_keeps_the_left_button(void **unused) {
    (void)unused;
    lone.state.manual = true;
    lone.state.tools.comparison = DIP_COMPARE_WIPE;
    drag(DIP_MOUSE_LEFT, 100, 0);
    assert_looks(0.0, 0.0);
    drag(DIP_MOUSE_RIGHT, 100, 0);
    assert_looks(90.0 * 100 / pane_height, 0.0);
}

// The centre stays where it is in camera space, so it keeps its place and size in the picture.
static void orbiting_keeps_the_centre_in_the_picture(void **unused) {
    (void)unused;
    lone.state.manual = true;
    lone.state.flight.orbits = true;
    double centre[3], before[3], after[3];
    dip_camera_look(&pose, 20.0, 10.0);
    dip_orbit_centre(&session, &pose, centre);
    camera_coordinates(centre, before);
    assert_true(fabs(before[0]) < 1e-12 && fabs(before[1]) < 1e-12 && before[2] <= -1.0 + 1e-12);
    drag(DIP_MOUSE_LEFT, 50, 30);
    camera_coordinates(centre, after);
    for (int i = 0; i < 3; ++i) {
        assert_true(fabs(after[i] - before[i]) < 1e-12);
    }
    assert_looks(20.0 + 180.0 * 50 / pane_height, 10.0 - 180.0 * 30 / pane_height);
    // A centre beside the line of sight stays, too.
    const double beside[3] = {-4.0, 1.0, -7.0};
    camera_coordinates(beside, before);
    dip_camera_orbit(&pose, beside, 33.0, -21.0);
    camera_coordinates(beside, after);
    for (int i = 0; i < 3; ++i) {
        assert_true(fabs(after[i] - before[i]) < 1e-12);
    }
}

// What lies between the camera and the centre moves with the pointer: to the right and down.
static void an_orbited_scene_follows_the_pointer(void **unused) {
    (void)unused;
    lone.state.manual = true;
    lone.state.flight.orbits = true;
    double centre[3], seen[3], before[3];
    dip_orbit_centre(&session, &pose, centre);
    for (int i = 0; i < 3; ++i) {
        before[i] = 0.5 * (centre[i] + pose.position_world[i]);
    }
    camera_coordinates(before, seen);
    assert_true(fabs(seen[0]) < 1e-12 && fabs(seen[1]) < 1e-12 && seen[2] < 0.0);
    drag(DIP_MOUSE_RIGHT, 20, 10);
    camera_coordinates(before, seen);
    assert_true(seen[0] > 0.01 && seen[1] < -0.01);
}

static void the_wheel_zooms_an_orbit(void **unused) {
    (void)unused;
    lone.state.manual = true;
    lone.state.flight.orbits = true;
    double centre[3], before[3], after[3];
    dip_orbit_centre(&session, &pose, centre);
    camera_coordinates(centre, before);
    dip_lone_wheel(2.0, 0, X, Y);
    assert_true(turn());
    camera_coordinates(centre, after);
    assert_true(fabs(after[2] - 0.81 * before[2]) < 1e-12);
    for (int i = 0; i < 500; ++i) { // The camera never passes through the centre.
        dip_camera_zoom(&pose, centre, 0.5);
    }
    camera_coordinates(centre, after);
    assert_true(after[2] < 0.0);
}

static void the_wheel_changes_the_speed(void **unused) {
    (void)unused;
    turn();
    dip_lone_wheel(4.0, 0, X, Y);
    assert_true(dip_flight_speed(&lone.state.flight) == 3.0); // The camera follows its path.
    lone.state.manual = true;
    dip_lone_wheel(4.0, 0, X, Y);
    assert_true(dip_flight_speed(&lone.state.flight) == 6.0);
    assert_non_null(strstr(lone.state.notice, "6 m/s"));
    dip_lone_wheel(-8.0, 0, X, Y);
    assert_true(dip_flight_speed(&lone.state.flight) == 1.5);
    for (int i = 0; i < 100; ++i) {
        dip_lone_wheel(-8.0, 0, X, Y);
    }
    assert_true(dip_flight_speed(&lone.state.flight) == 3.0 / 1024);
}

static void the_loupe_keeps_its_wheel(void **unused) {
    (void)unused;
    turn();
    lone.state.manual = true;
    lone.state.tools.loupe = true;
    const int zoom = lone.state.tools.zoom;
    dip_lone_wheel(1.0, DIP_MODIFIER_CTRL, X, Y);
    assert_int_equal(lone.state.tools.zoom, 2 * zoom);
    assert_int_equal(lone.state.flight.speed_steps, 0);
    dip_lone_wheel(1.0, 0, X, Y);
    assert_int_equal(lone.state.tools.zoom, 2 * zoom);
    assert_int_equal(lone.state.flight.speed_steps, 1);
}

static void home_takes_the_camera_back(void **unused) {
    (void)unused;
    lone.state.play_ns = INT64_C(2500000000);
    lone.state.manual = true;
    dip_preview_act(&lone.state, DIP_ACTION_CAMERA_BACK, 0, false, 0);
    assert_true(turn());
    assert_true(pose.position_world[0] == 0.5 && pose.position_world[1] == 0.5);
    assert_true(lone.state.manual);
    assert_false(turn());
    pose = (DipPose){.fov_y_deg = 60}; // A camera that is free before the first frame has no pose.
    assert_true(turn());
    assert_true(pose.position_world[0] == 0.5);
}

static void only_given_models_are_orbited_at_first(void **unused) {
    (void)unused;
    const DipSessionOptions none = {.model_count = 0};
    const DipSessionOptions one = {.model_count = 1};
    session.options = &none;
    dip_pilot_enter(&lone.state.flight, &session);
    assert_false(lone.state.flight.orbits);
    session.options = &one;
    dip_pilot_enter(&lone.state.flight, &session);
    assert_true(lone.state.flight.orbits);
    dip_preview_act(&lone.state, DIP_ACTION_ORBIT, 0, false, 0); // Frees the camera.
    assert_true(lone.state.manual && lone.state.flight.orbits);
    dip_preview_act(&lone.state, DIP_ACTION_ORBIT, 0, false, 0);
    assert_false(lone.state.flight.orbits);
}

// --- the end of paths ----------------------------------------------------------------------------

// Position on the path that the track shows at a play time.
static double shown_x(int64_t play_ns) {
    DipPose shown;
    assert_true(dip_camtrack_pose(&lone.track, play_ns, &shown));
    return shown.position_world[0];
}

// The path's x is 0, 1 and 3 at 0, 5 and 10 s, and as a loop 0 again at 15 s.
static void the_end_of_paths_changes_without_a_jump(void **unused) {
    (void)unused;
    lone.state.play_ns = INT64_C(37500000000); // 7.5 s in the third loop.
    assert_true(fabs(shown_x(lone.state.play_ns) - 2.0) < 1e-12);
    for (int i = 0; i < DIP_CAMPATH_END_COUNT; ++i) {
        dip_preview_act(&lone.state, DIP_ACTION_PATH_END, 1, false, 0);
        assert_int_equal(lone.track.end, (i + 1) % DIP_CAMPATH_END_COUNT);
        assert_true(fabs(shown_x(lone.state.play_ns) - 2.0) < 1e-12);
        const bool loops = lone.track.end == DIP_CAMPATH_END_loop;
        assert_int_equal(dip_preview_path_length_ns(&lone.state),
                         INT64_C(1000000000) * (loops ? 15 : 10));
        assert_int_equal(dip_preview_path_ns(&lone.state), INT64_C(7500000000));
    }
}

// A jump to a time shows the pose of that time whatever the path does at its end, also from its way
// back and from beyond its end.
static void jumps_reach_the_time_on_the_path(void **unused) {
    (void)unused;
    static const int64_t second_ns = 1000000000;
    for (int end = 0; end < DIP_CAMPATH_END_COUNT; ++end) {
        dip_camtrack_set_end(&lone.track, (DipCamPathEnd)end);
        for (int start = -40; start <= 40; start += 20) {
            for (int play = 0; play < 90; play += 7) {
                for (int to = 0; to < 10; to += 2) {
                    dip_camtrack_restart(&lone.track, start * second_ns);
                    lone.state.play_ns = play * second_ns;
                    dip_preview_seek_path(&lone.state, to * second_ns);
                    assert_true(lone.state.play_ns >= 0);
                    if (end == DIP_CAMPATH_END_once && start + to < 0) {
                        continue; // This time lies before play time 0.
                    }
                    assert_int_equal(dip_preview_path_ns(&lone.state), to * second_ns);
                    assert_true(fabs(shown_x(lone.state.play_ns) -
                                     (to <= 5 ? to / 5.0 : 1.0 + 2.0 * (to - 5) / 5.0)) < 1e-12);
                }
            }
        }
    }
}

static void buttons_move_the_camera_by_a_quarter_of_a_second(void **unused) {
    (void)unused;
    pose.orientation[1] = sin(-45 * rad); // Looks along +X.
    pose.orientation[3] = cos(-45 * rad);
    dip_pilot_step(&lone.state, 0, 3, 0);
    dip_pilot_step(&lone.state, -1, 0, 0);
    assert_true(lone.state.manual);
    assert_true(turn());
    assert_true(fabs(pose.position_world[0] - (1.0 + 3 * 0.25 * 3.0)) < 1e-12);
    assert_true(fabs(pose.position_world[1] - 2.0) < 1e-12);
    assert_true(fabs(pose.position_world[2] - (3.0 - 0.25 * 3.0)) < 1e-12); // -Z is to the left.
    assert_false(turn());
}

int main(void) {
#define FLIGHT_TEST(name) cmocka_unit_test_setup_teardown(name, set_up, dip_lone_tear_down)
    const struct CMUnitTest tests[] = {
        FLIGHT_TEST(dragging_turns_the_free_camera),
        FLIGHT_TEST(the_camera_does_not_tip_over),
        FLIGHT_TEST(a_camera_on_its_side_turns_all_the_way_round),
        FLIGHT_TEST(a_rolled_camera_does_not_tip_over),
        FLIGHT_TEST(the_right_button_frees_the_camera_and_a_click_pins_the_loupe),
        FLIGHT_TEST(the_wipe_keeps_the_left_button),
        FLIGHT_TEST(orbiting_keeps_the_centre_in_the_picture),
        FLIGHT_TEST(an_orbited_scene_follows_the_pointer),
        FLIGHT_TEST(the_wheel_zooms_an_orbit),
        FLIGHT_TEST(the_wheel_changes_the_speed),
        FLIGHT_TEST(the_loupe_keeps_its_wheel),
        FLIGHT_TEST(home_takes_the_camera_back),
        FLIGHT_TEST(only_given_models_are_orbited_at_first),
        FLIGHT_TEST(buttons_move_the_camera_by_a_quarter_of_a_second),
        FLIGHT_TEST(the_end_of_paths_changes_without_a_jump),
        FLIGHT_TEST(jumps_reach_the_time_on_the_path),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
