// Tests the orbit around a model: what it shows, where it begins, and what it refuses.
#include "tests/campaths/paths.h"
#include "renderer/base/hash.h"

#include <math.h>

// Transforms v into camera space with the matrix of the inverse rotation, which is independent of
// the orbit's own formulas.
static void to_camera(const DipPose *pose, const double v_world[3], double v[3]) {
    const double x = pose->orientation[0];
    const double y = pose->orientation[1];
    const double z = pose->orientation[2];
    const double w = pose->orientation[3];
    const double columns[3][3] = {
        {1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
        {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
        {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)},
    };
    for (int i = 0; i < 3; i++) {
        v[i] = 0.0;
        for (int a = 0; a < 3; a++) {
            v[i] += columns[i][a] * (v_world[a] - pose->position_world[a]);
        }
    }
}

// Projects the box's corners and returns the greatest |x| or |y| among them. The edges of the
// picture lie at 1.
static double reach_of_box(const DipCamOrbitDef *def, const DipPose *pose) {
    const double tan_y = tan(def->fov_y_deg * PI / 360.0);
    double reach = 0.0;
    for (int corner = 0; corner < 8; corner++) {
        double p[3];
        double v[3];
        for (int i = 0; i < 3; i++) {
            p[i] = corner >> i & 1 ? def->max_world[i] : def->min_world[i];
        }
        to_camera(pose, p, v);
        assert_true(v[2] < 0.0); // the corner is in front of the camera
        reach = fmax(reach, fabs(v[1]) / (-v[2] * tan_y));
        reach = fmax(reach, fabs(v[0]) / (-v[2] * tan_y * def->aspect));
    }
    return reach;
}

static void the_orbit_shows_the_whole_box(void **context) {
    (void)context;
    static const struct {
        double min[3], max[3], fov_y_deg, aspect;
    } cases[] = {
        {{-1, -1, -1}, {1, 1, 1}, 50, 4.0 / 3.0},    {{0, 0, 0}, {10, 0.1, 3}, 50, 4.0 / 3.0},
        {{5, -3, 2}, {5.1, 40, 2.1}, 30, 0.5},       {{-1e6, 0, 0}, {1e6, 1, 1}, 90, 2.0},
        {{1e-4, 1e-4, 0}, {2e-4, 3e-4, 0}, 50, 1.5}, {{-1, -1, -1}, {1, 1, 1}, 150, 0.2},
    };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        DipCamOrbitDef def = dip_campath_default_orbit();
        memcpy(def.min_world, cases[c].min, sizeof def.min_world);
        memcpy(def.max_world, cases[c].max, sizeof def.max_world);
        def.fov_y_deg = cases[c].fov_y_deg;
        def.aspect = cases[c].aspect;
        DipCamPath *path;
        assert_true(dip_campath_orbit(&def, &path, NULL));
        assert_true(dip_campath_info(path).duration_ns == 20 * SECOND);
        double widest = 0.0;
        double middle[3];
        for (int i = 0; i < 3; i++) {
            middle[i] = 0.5 * (def.min_world[i] + def.max_world[i]);
        }
        for (int t = 0; t < 1000; t++) {
            const DipPose pose = sample(path, t * SECOND / 50);
            widest = fmax(widest, reach_of_box(&def, &pose));
            double v[3];
            to_camera(&pose, middle, v);
            // Between keys, the camera moves on a chord of the circle and is up to 0.05 % nearer.
            assert_true(fabs(v[0]) < 2e-4 * -v[2] && fabs(v[1]) < 2e-4 * -v[2]);
            assert_true(pose.position_world[1] > middle[1]);
        }
        // A long box must fit into the picture even when one of its ends is near the camera. In the
        // rest of the orbit, the border around the box is wider.
        if (!(widest < 1.0 && widest > 0.75)) {
            fail_msg("case %zu: the box reaches to %.3f of the picture", c, widest);
        }
        dip_campath_destroy(&path);
    }
}

// The greatest |x| or |y| of a circle of the silhouette, seen from a pose.
static double reach_of_circle(const DipCamOrbitDef *def, const DipPose *pose, double radius,
                              double y) {
    const double tan_y = tan(def->fov_y_deg * PI / 360.0);
    double reach = 0.0;
    for (int i = 0; i < 360; i++) {
        const double p[3] = {
            0.5 * (def->min_world[0] + def->max_world[0]) + radius * sin(i * PI / 180.0), y,
            0.5 * (def->min_world[2] + def->max_world[2]) + radius * cos(i * PI / 180.0)};
        double v[3];
        to_camera(pose, p, v);
        assert_true(v[2] < 0.0);
        reach = fmax(reach, fabs(v[1]) / (-v[2] * tan_y));
        reach = fmax(reach, fabs(v[0]) / (-v[2] * tan_y * def->aspect));
    }
    return reach;
}

// With a silhouette, the picture is filled by what is there and not by the corners of its box.
static void the_orbit_shows_the_whole_silhouette(void **context) {
    (void)context;
    static const struct {
        double radii[4]; // From below; a negative number is an empty slice.
        double fov_y_deg, aspect;
    } cases[] = {
        {{1, 1, 1, 1}, 50, 4.0 / 3.0}, {{-1, 0.2, 3, 0.1}, 50, 4.0 / 3.0}, {{0, 0, 0, 5}, 30, 0.5},
        {{8, -1, -1, 0}, 90, 2.0},     {{0.1, 0.1, 0.1, 0.1}, 50, 1.5},    {{1, 2, 3, 4}, 150, 0.2},
    };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        DipCamOrbitDef def = dip_campath_default_orbit();
        const double size[3] = {9, 2, 9};
        for (int i = 0; i < 3; i++) {
            def.min_world[i] = 3 - size[i];
            def.max_world[i] = 3 + size[i];
        }
        def.fov_y_deg = cases[c].fov_y_deg;
        def.aspect = cases[c].aspect;
        def.radii = cases[c].radii;
        def.radius_count = 4;
        DipCamPath *path;
        assert_true(dip_campath_orbit(&def, &path, NULL));
        const DipPose pose = sample(path, 7 * SECOND);
        double widest = 0.0;
        for (int slice = 0; slice < 4; slice++) {
            for (int end = 0; end < 2 && def.radii[slice] >= 0; end++) {
                const double y = def.min_world[1] + (slice + end) * 1.0;
                widest = fmax(widest, reach_of_circle(&def, &pose, def.radii[slice], y));
            }
        }
        // The border is 5 % of the distance, so less than that of the picture near the camera.
        if (!(widest < 1.0 && widest > 0.83)) {
            fail_msg("case %zu: the silhouette reaches to %.3f of the picture", c, widest);
        }
        dip_campath_destroy(&path);
    }
}

static void the_orbit_begins_in_front_and_turns_over_plus_x(void **context) {
    (void)context;
    const DipCamOrbitDef def = dip_campath_default_orbit();
    DipCamPath *path;
    assert_true(dip_campath_orbit(&def, &path, NULL));
    const DipPose start = sample(path, 0);
    const DipPose quarter = sample(path, 5 * SECOND);
    assert_true(start.position_world[2] > 1.0 && fabs(start.position_world[0]) < 1e-12);
    assert_true(quarter.position_world[0] > 1.0 && fabs(quarter.position_world[2]) < 1e-12);
    dip_campath_destroy(&path);
}

// A model of a single point is framed as a box of one metre about it, whatever its silhouette.
static void the_orbit_of_a_point_is_that_of_a_box_of_one_metre(void **context) {
    (void)context;
    DipCamOrbitDef point = dip_campath_default_orbit();
    DipCamOrbitDef box = point;
    for (int i = 0; i < 3; i++) {
        point.min_world[i] = point.max_world[i] = 2.0 * i;
        box.min_world[i] = 2.0 * i - 0.5;
        box.max_world[i] = 2.0 * i + 0.5;
    }
    static const double radii[2] = {0.0, 0.0};
    DipCamPath *paths[3];
    assert_true(dip_campath_orbit(&point, &paths[0], NULL));
    assert_true(dip_campath_orbit(&box, &paths[1], NULL));
    point.radii = radii;
    point.radius_count = 2;
    assert_true(dip_campath_orbit(&point, &paths[2], NULL));
    for (int t = 0; t < 20; t++) {
        const DipPose a = sample(paths[0], t * SECOND);
        for (int i = 1; i < 3; i++) {
            const DipPose b = sample(paths[i], t * SECOND);
            assert_memory_equal(&a, &b, sizeof a);
        }
    }
    for (int i = 0; i < 3; i++) {
        dip_campath_destroy(&paths[i]);
    }
}

static void bad_orbits_and_keys_are_refused(void **context) {
    (void)context;
    DipCamPath *path;
    DipError err;
    DipCamOrbitDef def = dip_campath_default_orbit();
    def.max_world[1] = -2.0;
    assert_false(dip_campath_orbit(&def, &path, &err));
    assert_string_equal(err.key, "box");
    def = dip_campath_default_orbit();
    def.min_world[0] = NAN;
    assert_false(dip_campath_orbit(&def, &path, &err));
    assert_string_equal(err.key, "box");
    def = dip_campath_default_orbit();
    def.fov_y_deg = 0.0;
    assert_false(dip_campath_orbit(&def, &path, &err));
    assert_string_equal(err.key, "fov");
    def = dip_campath_default_orbit();
    def.aspect = NAN;
    assert_false(dip_campath_orbit(&def, &path, &err));
    assert_string_equal(err.key, "aspect");
    def = dip_campath_default_orbit();
    def.duration_ns = 0;
    assert_false(dip_campath_orbit(&def, &path, &err));
    assert_string_equal(err.key, "period");
    const DipCamKey key = {{0, 0, 0}, {0, 0, 0, 1}};
    assert_false(dip_campath_create(&key, 0, SECOND, &path, &err));
    assert_string_equal(err.key, "keys");
    assert_int_equal(err.code, DIP_ERROR_RANGE);
    assert_null(path);
    static const char *const names[7] = {"x", "y", "z", "qx", "qy", "qz", "qw"};
    for (int i = 0; i < 7; i++) {
        DipCamKey undefined = key;
        *(i < 3 ? &undefined.position_world[i] : &undefined.orientation[i - 3]) = NAN;
        assert_false(dip_campath_create(&undefined, 1, SECOND, &path, &err));
        assert_string_equal(err.key, names[i]);
        assert_int_equal(err.code, DIP_ERROR_RANGE);
    }
}

// The ends of each range are accepted; the next numbers beyond them are not.
static void orbits_accept_their_ranges_and_no_more(void **context) {
    (void)context;
    const double aspects[2] = {0.01, 100.0};
    const double fovs_deg[2] = {1.0, 170.0};
    for (int end = 0; end < 2; end++) {
        DipCamPath *path;
        DipCamOrbitDef def = dip_campath_default_orbit();
        def.aspect = aspects[end];
        def.fov_y_deg = fovs_deg[end];
        assert_true(dip_campath_orbit(&def, &path, NULL));
        dip_campath_destroy(&path);
        const double beyond = end == 0 ? 0.0 : INFINITY;
        def.aspect = nextafter(aspects[end], beyond);
        assert_false(dip_campath_orbit(&def, &path, NULL));
        def.aspect = aspects[end];
        def.fov_y_deg = nextafter(fovs_deg[end], beyond);
        assert_false(dip_campath_orbit(&def, &path, NULL));
    }
}

// Hashes the bits of 5000 poses. The hash shows that all compilers and processors compute the same
// poses. Other tests show that the poses are right.
static void poses_have_the_same_bits_on_every_machine(void **context) {
    (void)context;
    const DipCamOrbitDef def = dip_campath_default_orbit();
    DipCamPath *path;
    assert_true(dip_campath_orbit(&def, &path, NULL));
    DipHash hash = dip_hash_begin(0);
    for (int t = 0; t < 5000; t++) {
        const DipPose pose = sample(path, t * INT64_C(7654321));
        dip_hash_bytes(&hash, &pose, sizeof pose);
    }
    dip_campath_destroy(&path);
    assert_int_equal(hash.lanes[0], UINT64_C(0x3136025b8ca999f2));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_orbit_shows_the_whole_box),
        cmocka_unit_test(the_orbit_shows_the_whole_silhouette),
        cmocka_unit_test(the_orbit_begins_in_front_and_turns_over_plus_x),
        cmocka_unit_test(the_orbit_of_a_point_is_that_of_a_box_of_one_metre),
        cmocka_unit_test(bad_orbits_and_keys_are_refused),
        cmocka_unit_test(orbits_accept_their_ranges_and_no_more),
        cmocka_unit_test(poses_have_the_same_bits_on_every_machine),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
