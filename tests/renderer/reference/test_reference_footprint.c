// Tests the level of detail and the anisotropy that the reference computes from a Jacobian (the
// derivatives of texture coordinates). The axes of the tests' Jacobians are known.
#include "renderer/reference/internal/footprint.h"
#include "renderer/catalogue/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "tests/renderer/pipeline/near.h"

static const double pi = 3.14159265358979323846;

// Makes the Jacobian of an ellipse with semi-axes of the given lengths. The major axis points to
// `direction` in the texture, and the screen is rotated by `roll` relative to the axes.
static void make_jacobian(double major, double minor, double direction, double roll, double dx[2],
                          double dy[2]) {
    const double along[2] = {major * cos(direction), major * sin(direction)};
    const double across[2] = {-minor * sin(direction), minor * cos(direction)};
    for (int i = 0; i < 2; i++) {
        dx[i] = along[i] * cos(roll) - across[i] * sin(roll);
        dy[i] = along[i] * sin(roll) + across[i] * cos(roll);
    }
}

static void trilinear_takes_the_longer_derivative(void **state) {
    (void)state;
    const double dx[2] = {3.0, 4.0};
    const double dy[2] = {0.0, 8.0};
    const DipFootprint f = dip_reference_footprint(dx, dy, 1, true, 0);
    assert_near(f.lambda, 3.0, 1e-12);
    assert_int_equal(f.probe_count, 1);
    assert_near(dip_reference_footprint(dy, dx, 1, false, 0).lambda, 3.0, 1e-12);
}

static void advanced_af_finds_the_axes_at_any_roll(void **state) {
    (void)state;
    Random random = {1};
    for (int i = 0; i < 20000; i++) {
        const double minor = exp2(random_real(&random, -6.0, 6.0));
        const double ratio = exp2(random_real(&random, 0.0, 8.0));
        const double direction = random_real(&random, 0.0, pi);
        const int max = 1 << random_int(&random, 1, 4);
        const double eta = fmin(ratio, max);
        double dx[2], dy[2];
        make_jacobian(minor * ratio, minor, direction, random_real(&random, 0.0, 2.0 * pi), dx, dy);
        const DipFootprint f = dip_reference_footprint(dx, dy, max, true, 0);
        assert_near(f.eta, eta, 1e-9 * eta);
        assert_near(f.lambda, log2(minor * ratio / eta), 1e-9);
        const double probes = fmin(eta, fmax(1.0, minor * ratio)) - 1e-4;
        if (fabs(probes - rint(probes)) > 1e-8) {
            assert_int_equal(f.probe_count, (int)ceil(probes));
        }
        if (ratio > 1.01) { // both directions along the axis are right
            const double cross =
                f.major_texels[0] * sin(direction) - f.major_texels[1] * cos(direction);
            assert_near(cross / (minor * ratio), 0.0, 1e-9 / (ratio - 1.0));
            assert_near(hypot(f.major_texels[0], f.major_texels[1]), minor * ratio,
                        1e-9 * minor * ratio);
        }
    }
}

static double plain_eta(double ratio, double roll_deg, int max) {
    double dx[2], dy[2];
    make_jacobian(ratio, 1.0, 0.3, roll_deg * pi / 180.0, dx, dy);
    return dip_reference_footprint(dx, dy, max, false, 0).eta;
}

// Returns the ratio, at least 1, of the lengths of dX and dY. The ellipse has the axes m and 1 and
// is rotated by `roll` relative to the frame of dX and dY.
static double frame_ratio(double m, double roll) {
    const double c = cos(roll) * cos(roll);
    const double s = sin(roll) * sin(roll);
    const double ratio = sqrt((m * m * c + s) / (m * m * s + c));
    return fmax(ratio, 1.0 / ratio);
}

static void plain_af_loses_anisotropy_with_roll_as_the_cotangent_predicts(void **state) {
    (void)state;
    assert_near(plain_eta(16.0, 0.0, 16), 16.0, 1e-9);
    assert_near(plain_eta(16.0, 45.0, 16), 8.0, 1e-9);
    assert_near(plain_eta(16.0, 22.5, 16), 2.39, 0.005);
    assert_near(plain_eta(1e6, 22.5, 16), 1.0 + sqrt(2.0), 1e-6); // the cotangent of 22.5 degrees
    assert_near(plain_eta(16.0, 45.0, 2), 1.0,
                1e-12); // in the turned frame, the limit is half of 2
    for (double roll_deg = -180.0; roll_deg <= 180.0; roll_deg += 1.0) {
        const double roll = roll_deg * pi / 180.0;
        const double expected = fmax(fmin(frame_ratio(16.0, roll), 16.0),
                                     fmin(frame_ratio(16.0, roll - pi / 4.0), 8.0));
        assert_near(plain_eta(16.0, roll_deg, 16), expected, 1e-9);
    }
}

static void plain_af_takes_its_level_from_the_frame_with_the_greater_ratio(void **state) {
    (void)state;
    double dx[2], dy[2];
    make_jacobian(16.0, 1.0, 0.3, 45.0 * pi / 180.0, dx, dy);
    const DipFootprint turned = dip_reference_footprint(dx, dy, 16, false, 0);
    assert_near(turned.lambda, 1.0, 1e-9); // 16 texels divided by 8 probes
    assert_int_equal(turned.probe_count, 8);
    // The result must be the major axis of the ellipse.
    assert_near(fabs(turned.major_texels[0]), 16.0 * cos(0.3), 1e-9);
    assert_near(fabs(turned.major_texels[1]), 16.0 * sin(0.3), 1e-9);
}

// Returns any finite number of any magnitude, sometimes a special value.
static double awkward(Random *random) {
    static const double specials[] = {0.0, -0.0, 1.0, -1.0, 1e308, -1e308, 5e-324, 1e-300};
    if (random_int(random, 0, 2) == 0) {
        return specials[random_int(random, 0, 7)];
    }
    return exp2(random_real(random, -300.0, 300.0)) * (random_int(random, 0, 1) ? 1.0 : -1.0);
}

static void the_level_is_finite_for_any_jacobian(void **state) {
    (void)state;
    Random random = {2};
    for (int i = 0; i < 100000; i++) {
        double dx[2] = {awkward(&random), awkward(&random)};
        double dy[2] = {awkward(&random), awkward(&random)};
        if (i % 4 == 0) { // collinear derivatives
            dy[0] = dx[0] * 3.0;
            dy[1] = dx[1] * 3.0;
        }
        const int max = 1 << random_int(&random, 0, 4);
        const DipFootprint f = dip_reference_footprint(dx, dy, max, i % 2 == 0, 0);
        assert_true(f.eta >= 1.0 && f.eta <= max);
        assert_true(f.probe_count >= 1 && f.probe_count <= max);
        const double level = dip_reference_level(f.lambda, 0.5, 0, 10);
        assert_true(level >= 0.0 && level <= 10.0);
    }
}

static void degenerate_jacobians_have_defined_footprints(void **state) {
    (void)state;
    const double zero[2] = {0.0, 0.0};
    const double line[2] = {8.0, 0.0};
    const double broken[2] = {NAN, INFINITY};
    for (int advanced = 0; advanced < 2; advanced++) {
        const DipFootprint point = dip_reference_footprint(zero, zero, 16, advanced, 0);
        assert_near(point.eta, 1.0, 0.0);
        assert_near(dip_reference_level(point.lambda, 1.5, 0, 9), 0.0, 0.0);
        const DipFootprint thin = dip_reference_footprint(line, zero, 16, advanced, 0);
        assert_near(thin.eta, 16.0, 0.0);
        assert_near(thin.lambda, -1.0, 1e-12);
        const DipFootprint none = dip_reference_footprint(broken, line, 16, advanced, 0);
        assert_int_equal(none.probe_count, 1);
        assert_near(dip_reference_level(none.lambda, 0.0, 0, 9), 9.0, 0.0);
    }
}

// A footprint of 6 x 0.1 texels has the capped axis ratio (eta) 16, but the read takes only six
// probes, because these are already only one texel apart. If the two largest levels are dropped, a
// texel is as wide as 4 texels of level 0.
static void probes_are_no_closer_than_texels(void **state) {
    (void)state;
    const double along[2] = {6.0, 0.0};
    const double across[2] = {0.0, 0.1};
    for (int advanced = 0; advanced < 2; advanced++) {
        const DipFootprint f = dip_reference_footprint(along, across, 16, advanced, 0);
        assert_near(f.eta, 16.0, 0.0);
        assert_int_equal(f.probe_count, 6);
        assert_int_equal(dip_reference_footprint(along, across, 16, advanced, 2).probe_count, 2);
        const double small[2] = {0.5, 0.0};
        assert_int_equal(dip_reference_footprint(small, across, 16, advanced, 0).probe_count, 1);
    }
}

static void the_level_is_biased_clamped_and_rounded(void **state) {
    (void)state;
    assert_near(dip_reference_level(2.0, 0.5, 0, 9), 2.5, 0.0);
    assert_near(dip_reference_level(1.0, 1.5, 0, 2), 2.0, 0.0);
    assert_near(dip_reference_level(-3.0, 1.5, 2, 9), 2.0, 0.0);
    assert_near(dip_reference_level(0.0, 0.0, 2, 1), 1.0, 0.0); // the chain ends before min_level
    assert_near(dip_reference_level(1.0 + 0.4 / 256.0, 0.0, 0, 9), 1.0, 0.0);
    assert_near(dip_reference_level(1.0 + 0.6 / 256.0, 0.0, 0, 9), 1.0 + 1.0 / 256.0, 0.0);
    assert_near(dip_reference_level(INFINITY, 0.0, 0, 9), 9.0, 0.0);
    assert_near(dip_reference_level(-INFINITY, 0.0, 0, 9), 0.0, 0.0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(trilinear_takes_the_longer_derivative),
        cmocka_unit_test(advanced_af_finds_the_axes_at_any_roll),
        cmocka_unit_test(plain_af_loses_anisotropy_with_roll_as_the_cotangent_predicts),
        cmocka_unit_test(plain_af_takes_its_level_from_the_frame_with_the_greater_ratio),
        cmocka_unit_test(the_level_is_finite_for_any_jacobian),
        cmocka_unit_test(degenerate_jacobians_have_defined_footprints),
        cmocka_unit_test(probes_are_no_closer_than_texels),
        cmocka_unit_test(the_level_is_biased_clamped_and_rounded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
