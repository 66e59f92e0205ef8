// Tests how paths end, and the track, which switches between the paths of the categories.
#include "tests/campaths/paths.h"
#include "campaths/camtrack.h"

// Steps through time one nanosecond after the other, turning around as the path says. The path's
// times are small, so that the model can be this simple.
static void paths_end_as_they_are_told(void **context) {
    (void)context;
    DipCamPath *path = parse("diptych-path 1\nperiod 0.000001\n"
                             "0 0 0 0 0 0 1\n1 0 0 0 0 0 1\n5 0 0 0 0 0 1\n");
    const int64_t last_ns = 2000;
    int64_t back_ns = 0;
    int step = 1;
    for (int64_t t = 0; t < 20000; t++) {
        assert_int_equal(dip_campath_time_at_end(path, DIP_CAMPATH_END_loop, t), t % 3000);
        assert_int_equal(dip_campath_time_at_end(path, DIP_CAMPATH_END_once, t),
                         t < last_ns ? t : last_ns);
        assert_int_equal(dip_campath_time_at_end(path, DIP_CAMPATH_END_back, t), back_ns);
        assert_int_equal(dip_campath_time_at_end(path, DIP_CAMPATH_END_back, -t), back_ns);
        assert_int_equal(dip_campath_time_at_end(path, DIP_CAMPATH_END_once, -t), 0);
        back_ns += step;
        step = back_ns == last_ns ? -1 : back_ns == 0 ? 1 : step;
    }
    assert_int_equal(dip_campath_span_ns(path, DIP_CAMPATH_END_loop), 3000);
    assert_int_equal(dip_campath_span_ns(path, DIP_CAMPATH_END_once), 2000);
    assert_int_equal(dip_campath_span_ns(path, DIP_CAMPATH_END_back), 4000);
    for (int end = 0; end < DIP_CAMPATH_END_COUNT; end++) {
        for (int i = 0; i < 2; i++) {
            const int64_t t =
                dip_campath_time_at_end(path, (DipCamPathEnd)end, i ? INT64_MAX : INT64_MIN);
            assert_in_range(t, 0, 3000);
        }
    }
    dip_campath_destroy(&path);
}

static void a_single_key_ends_where_it_begins(void **context) {
    (void)context;
    DipCamPath *path = parse("diptych-path 1\nperiod 3600\n1 2 3 0 0 0 1\n");
    for (int end = 0; end < DIP_CAMPATH_END_COUNT; end++) {
        DipCamTrack track = dip_camtrack_make(true);
        DipPose pose = {.fov_y_deg = 0.0};
        dip_camtrack_set(&track, 0, path, 55.0);
        dip_camtrack_set_end(&track, (DipCamPathEnd)end);
        assert_true(dip_camtrack_pose(&track, 7 * SECOND, &pose));
        assert_true(pose.position_world[0] == 1.0 && pose.position_world[2] == 3.0);
    }
    dip_campath_destroy(&path);
}

// The track applies the end to the time since the path began.
static void a_track_stops_or_turns_at_the_end(void **context) {
    (void)context;
    DipCamPath *path = parse("diptych-path 1\nperiod 1\n0 0 0 0 0 0 1\n8 0 0 0 0 0 1\n");
    DipCamTrack track = dip_camtrack_make(true);
    DipPose pose;
    assert_int_equal(dip_camtrack_path_time(&track, SECOND), 0);
    dip_camtrack_set(&track, 0, path, 55.0);
    dip_camtrack_restart(&track, 100 * SECOND);
    static const struct {
        DipCamPathEnd end;
        double at_one_half, at_one_and_a_half, at_seven;
    } expected[] = {{DIP_CAMPATH_END_loop, 4.0, 4.0, 8.0},
                    {DIP_CAMPATH_END_once, 4.0, 8.0, 8.0},
                    {DIP_CAMPATH_END_back, 4.0, 4.0, 8.0}};
    for (int i = 0; i < 3; i++) {
        dip_camtrack_set_end(&track, expected[i].end);
        assert_true(dip_camtrack_pose(&track, 100 * SECOND + SECOND / 2, &pose));
        assert_true(pose.position_world[0] == expected[i].at_one_half);
        assert_true(dip_camtrack_pose(&track, 101 * SECOND + SECOND / 2, &pose));
        assert_true(pose.position_world[0] == expected[i].at_one_and_a_half);
        assert_true(dip_camtrack_pose(&track, 107 * SECOND, &pose));
        assert_true(pose.position_world[0] == expected[i].at_seven);
    }
    assert_int_equal(dip_camtrack_path_time(&track, 107 * SECOND), SECOND);
    dip_campath_destroy(&path);
}

static void switching_paths_restarts_or_keeps_the_time(void **context) {
    (void)context;
    DipCamPath *a = parse("diptych-path 1\nperiod 1\n0 0 0 0 0 0 1\n10 0 0 0 0 0 1\n");
    DipCamPath *b = parse("diptych-path 1\nperiod 4\n0 5 0 0 0 0 1\n40 5 0 0 0 0 1\n");
    for (int reset = 0; reset < 2; reset++) {
        DipCamTrack track = dip_camtrack_make(reset);
        DipPose pose = {.fov_y_deg = 1.0};
        assert_false(dip_camtrack_pose(&track, 0, &pose));
        assert_null(dip_camtrack_playing(&track)->path);
        assert_true(pose.fov_y_deg == 1.0);
        dip_camtrack_set(&track, 0, a, 55.0);
        dip_camtrack_set(&track, 2, a, 50.0); // The same path in another category.
        dip_camtrack_set(&track, 3, b, 45.0);
        assert_true(dip_camtrack_pose(&track, SECOND / 2, &pose));
        assert_true(pose.position_world[0] == 5.0 && pose.fov_y_deg == 55.0);
        dip_camtrack_switch(&track, 2, SECOND / 2); // The path is the same, so it continues.
        assert_true(dip_camtrack_pose(&track, SECOND / 2, &pose));
        assert_true(pose.position_world[0] == 5.0 && pose.fov_y_deg == 50.0);
        dip_camtrack_switch(&track, 3, SECOND);
        assert_true(dip_camtrack_pose(&track, SECOND, &pose));
        assert_true(pose.position_world[0] == (reset ? 0.0 : 10.0));
        assert_true(pose.position_world[1] == 5.0 && pose.fov_y_deg == 45.0);
        // Category 7 has no path, so the path of category 0 plays.
        dip_camtrack_switch(&track, 7, 5 * SECOND / 2);
        assert_ptr_equal(dip_camtrack_playing(&track), &track.categories[0]);
        assert_true(dip_camtrack_pose(&track, 5 * SECOND / 2, &pose));
        assert_true(pose.position_world[0] == (reset ? 0.0 : 5.0) && pose.fov_y_deg == 55.0);
        dip_camtrack_restart(&track, 3 * SECOND);
        assert_true(dip_camtrack_time(&track, 4 * SECOND) == SECOND);
    }
    dip_campath_destroy(&a);
    dip_campath_destroy(&b);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(paths_end_as_they_are_told),
        cmocka_unit_test(a_single_key_ends_where_it_begins),
        cmocka_unit_test(a_track_stops_or_turns_at_the_end),
        cmocka_unit_test(switching_paths_restarts_or_keeps_the_time),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
