// Compares sampled poses of camera paths with closed forms.
#include "tests/campaths/paths.h"

#include <math.h>

// Compares rotations. The quaternions q and -q count as equal because they are the same rotation.
static void check_orientation(const double q[4], double x, double y, double z, double w,
                              double bound) {
    const double sign = q[0] * x + q[1] * y + q[2] * z + q[3] * w < 0.0 ? -1.0 : 1.0;
    const double expected[4] = {x, y, z, w};
    for (int i = 0; i < 4; i++) {
        if (!(fabs(q[i] - sign * expected[i]) <= bound)) {
            fail_msg("component %d: found %.17g, expected %.17g", i, q[i], sign * expected[i]);
        }
    }
}

static void check_turn_about_y(const DipPose *pose, double angle_deg, double bound) {
    const double half = angle_deg * PI / 360.0;
    check_orientation(pose->orientation, 0.0, sin(half), 0.0, cos(half), bound);
}

static void positions_move_linearly_and_the_loop_closes(void **context) {
    (void)context;
    DipCamPath *path = parse("diptych-path 1\nperiod 2\n"
                             "0 0 0 0 0 0 1\n10 4 -2 0 0 0 1\n10 8 0 0 0 0 1\n");
    const struct {
        int64_t time_ns;
        double position[3];
    } cases[] = {
        {0, {0, 0, 0}},
        {SECOND, {5, 2, -1}},
        {2 * SECOND, {10, 4, -2}},
        {3 * SECOND, {10, 6, -1}},
        {4 * SECOND, {10, 8, 0}},
        {5 * SECOND, {5, 4, 0}}, // the closing step leads back to the first key
        {6 * SECOND, {0, 0, 0}},
        {-SECOND, {5, 4, 0}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const DipPose pose = sample(path, cases[i].time_ns);
        for (int a = 0; a < 3; a++) {
            assert_true(pose.position_world[a] == cases[i].position[a]);
        }
        assert_true(pose.fov_y_deg == 33.0); // a path does not change the field of view
    }
    dip_campath_destroy(&path);
    assert_null(path);
    dip_campath_destroy(&path);
    dip_campath_destroy(NULL);
}

// In a step between two keys that turns by `angle` about +Y, the camera has turned by u * angle
// after the fraction u of the step.
static void orientations_turn_at_constant_speed(void **context) {
    (void)context;
    static const double angles_deg[] = {1e-7, 1e-4, 1.1e-4, 1.2e-4, 0.0115, 0.5, 1.62, 30, 90, 179};
    for (size_t a = 0; a < sizeof angles_deg / sizeof *angles_deg; a++) {
        const double half = angles_deg[a] * PI / 360.0;
        const DipCamKey keys[2] = {{{0, 0, 0}, {0, 0, 0, 1}},
                                   {{0, 0, 0}, {0, sin(half), 0, cos(half)}}};
        DipCamPath *path;
        assert_true(dip_campath_create(keys, 2, SECOND, &path, NULL));
        for (int i = 0; i <= 100; i++) {
            const DipPose pose = sample(path, i * SECOND / 100);
            check_turn_about_y(&pose, angles_deg[a] * i / 100.0, 4e-16);
        }
        dip_campath_destroy(&path);
    }
}

static void the_sign_of_a_quaternion_does_not_matter(void **context) {
    (void)context;
    DipCamPath *path = parse("diptych-path 1\nperiod 1\n"
                             "0 0 0 0 0 0 1\n"
                             "0 0 0 0 -0.38268343236508977 0 -0.92387953251128674\n");
    const DipPose pose = sample(path, SECOND / 2);
    check_turn_about_y(&pose, 22.5, 1e-15); // The long way round would give 202.5.
    const DipCamKey key = dip_campath_key(path, 1);
    assert_true(key.orientation[3] > 0.0);
    dip_campath_destroy(&path);
}

// Four quarter turns end at the first orientation with the opposite sign. The closing step must
// still be a quarter turn.
static void the_closing_step_of_a_full_turn_is_short(void **context) {
    (void)context;
    DipCamKey keys[4];
    for (int k = 0; k < 4; k++) {
        const double half = k * PI / 4.0;
        keys[k] = (DipCamKey){{0, 0, 0}, {0, sin(half), 0, cos(half)}};
    }
    DipCamPath *path;
    assert_true(dip_campath_create(keys, 4, SECOND, &path, NULL));
    for (int i = 0; i < 80; i++) {
        const DipPose pose = sample(path, i * SECOND / 20);
        check_turn_about_y(&pose, 360.0 * i / 80.0, 4e-16);
    }
    assert_true(fabs(dip_campath_info(path).max_turn_deg_per_s - 90.0) < 1e-12);
    dip_campath_destroy(&path);
}

static void a_half_turn_is_interpolated(void **context) {
    (void)context;
    DipCamPath *path = parse("diptych-path 1\nperiod 1\n0 0 0 0 0 0 1\n0 0 0 0 1 0 0\n");
    const DipPose there = sample(path, SECOND / 3);
    const DipPose back = sample(path, SECOND + SECOND / 3);
    check_turn_about_y(&there, 60.0, 1e-8);
    check_turn_about_y(&back, 120.0, 1e-8);
    dip_campath_destroy(&path);
}

static void a_path_repeats_exactly_after_its_duration(void **context) {
    (void)context;
    DipCamPath *path = parse("diptych-path 1\nperiod 0.333333333\n"
                             "1 2 3 0.1 0.2 0.3 0.9\n4 -5 6 0.3 -0.2 0.1 0.8\n"
                             "-7 8 9 -0.5 0.5 0.5 -0.5\n0.1 0.2 0.3 0 1 0 0\n"
                             "5 5 5 0 0 1 0.01\n");
    const int64_t duration_ns = dip_campath_info(path).duration_ns;
    assert_true(duration_ns == INT64_C(1666666665));
    for (int64_t t = 0; t < duration_ns; t += 12345677) {
        const DipPose expected = sample(path, t);
        const int64_t loops[] = {1, -1, 600000000, -600000000}; // the last two go beyond 1e9 s
        for (int i = 0; i < 4; i++) {
            const DipPose pose = sample(path, t + loops[i] * duration_ns);
            assert_memory_equal(&pose, &expected, sizeof pose);
        }
        const double *q = expected.orientation;
        const double length = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
        assert_true(fabs(length - 1.0) < 1e-15);
    }
    sample(path, INT64_MIN);
    sample(path, INT64_MAX);
    dip_campath_destroy(&path);
}

static void a_path_of_one_key_is_a_still_camera(void **context) {
    (void)context;
    DipCamPath *path = parse("diptych-path 1\nperiod 1\n1 2 3 0 0 0 2\n");
    static const int64_t times_ns[] = {0, 1, 500000000, -7, INT64_MAX};
    for (int i = 0; i < 5; i++) {
        const DipPose pose = sample(path, times_ns[i]);
        assert_true(pose.position_world[0] == 1.0 && pose.position_world[2] == 3.0);
        check_orientation(pose.orientation, 0, 0, 0, 1, 0.0);
    }
    dip_campath_destroy(&path);
}

static void path_info_has_length_speed_and_bounding_box(void **context) {
    (void)context;
    DipCamPath *path = parse("diptych-path 1\nperiod 0.5\n"
                             "0 0 0 0 0 0 1\n3 4 0 0 0 0 1\n3 4 12 0 0 0 1\n");
    const DipCamPathInfo info = dip_campath_info(path);
    assert_int_equal(info.key_count, 3);
    assert_true(info.period_ns == SECOND / 2 && info.duration_ns == 3 * SECOND / 2);
    assert_true(info.length_m == 5.0 + 12.0 + 13.0);
    assert_true(info.max_speed_m_per_s == 26.0);
    assert_true(info.max_turn_deg_per_s == 0.0);
    assert_true(info.min_world[0] == 0.0 && info.max_world[1] == 4.0 && info.max_world[2] == 12.0);
    dip_campath_destroy(&path);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(positions_move_linearly_and_the_loop_closes),
        cmocka_unit_test(orientations_turn_at_constant_speed),
        cmocka_unit_test(the_sign_of_a_quaternion_does_not_matter),
        cmocka_unit_test(the_closing_step_of_a_full_turn_is_short),
        cmocka_unit_test(a_half_turn_is_interpolated),
        cmocka_unit_test(a_path_repeats_exactly_after_its_duration),
        cmocka_unit_test(a_path_of_one_key_is_a_still_camera),
        cmocka_unit_test(path_info_has_length_speed_and_bounding_box),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
