// Compares dip_sin and the other functions of trig.h with the C library's long double functions.
#include "renderer/base/hash.h"
#include "renderer/base/trig.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

static uint64_t state = 1;

// Returns 0 <= u < 1. The generator is xorshift64* with a fixed state, so every run tests the same
// angles.
static double uniform(void) {
    state ^= state >> 12;
    state ^= state << 25;
    state ^= state >> 27;
    return (double)((state * UINT64_C(2685821657736338717)) >> 11) * 0x1p-53;
}

static void check_near(double found, long double expected, double bound, double argument) {
    const double error = (double)fabsl((long double)found - expected);
    if (!(error <= bound)) {
        fail_msg("at %.17g: found %.17g, expected %.17Lg, error %.3g", argument, found, expected,
                 error);
    }
}

static void check_angle(double angle_rad) {
    const long double t = tanl(angle_rad);
    check_near(dip_sin(angle_rad), sinl(angle_rad), 2.5e-16, angle_rad);
    check_near(dip_cos(angle_rad), cosl(angle_rad), 2.5e-16, angle_rad);
    check_near(dip_tan(angle_rad), t, 1e-15 * (double)fabsl(t) + 1e-300, angle_rad);
    assert_true(dip_sin(-angle_rad) == -dip_sin(angle_rad));
    assert_true(dip_cos(-angle_rad) == dip_cos(angle_rad));
}

static void sin_cos_tan_match_libm(void **context) {
    (void)context;
    static const double reaches[] = {1e-9, 0.8, 7.0, 5e3, 1e6};
    for (size_t r = 0; r < sizeof reaches / sizeof *reaches; r++) {
        for (int i = 0; i < 200000; i++) {
            check_angle((2.0 * uniform() - 1.0) * reaches[r]);
        }
    }
}

// Next to multiples of pi/4, cancellation in the argument reduction can lose most digits. This test
// bounds the relative error, so all digits of the small results must be right.
static void results_near_multiples_of_quarter_pi_keep_their_digits(void **context) {
    (void)context;
    for (int n = 1; n <= 20000; n++) {
        double angle = (double)(n * (3.14159265358979323846264338L / 4.0L));
        for (int step = -2; step <= 2; step++) {
            const double near_by = angle + step * (nextafter(angle, 1e9) - angle);
            check_angle(near_by);
            const long double s = sinl(near_by);
            const long double c = cosl(near_by);
            check_near(dip_sin(near_by), s, 5e-16 * (double)fabsl(s), near_by);
            check_near(dip_cos(near_by), c, 5e-16 * (double)fabsl(c), near_by);
        }
    }
}

static void out_of_range_angles_are_nan(void **context) {
    (void)context;
    static const double bad[] = {1.0000001e6, -1.0000001e6, 1e300, INFINITY, -INFINITY, NAN};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        assert_true(isnan(dip_sin(bad[i])));
        assert_true(isnan(dip_cos(bad[i])));
        assert_true(isnan(dip_tan(bad[i])));
    }
}

static void atan2_matches_libm(void **context) {
    (void)context;
    for (int i = 0; i < 500000; i++) {
        const double y = (2.0 * uniform() - 1.0) * exp2(20.0 * uniform() - 10.0);
        const double x = (2.0 * uniform() - 1.0) * exp2(20.0 * uniform() - 10.0);
        const long double expected = atan2l(y, x);
        check_near(dip_atan2(y, x), expected, 1e-15 * (double)fabsl(expected), y / x);
    }
    static const double axis[][3] = {
        {0.0, 1.0, 0.0},
        {0.0, 0.0, 0.0},
        {1.0, 0.0, DIP_PI / 2},
        {-1.0, 0.0, -DIP_PI / 2},
        {0.0, -1.0, DIP_PI},
        {1.0, 1.0, DIP_PI / 4},
        {-1.0, -1.0, -2.35619449019234492885},
        {1e300, 1e-300, DIP_PI / 2},
        {1e-300, 1e300, 0.0},
        {INFINITY, 1.0, DIP_PI / 2},
        {1.0, -INFINITY, DIP_PI},
    };
    for (size_t i = 0; i < sizeof axis / sizeof *axis; i++) {
        check_near(dip_atan2(axis[i][0], axis[i][1]), axis[i][2], 5e-16, axis[i][0]);
    }
    assert_true(isnan(dip_atan2(NAN, 1.0)) && isnan(dip_atan2(1.0, NAN)));
    assert_true(isnan(dip_atan2(INFINITY, INFINITY)));
}

static void acos_asin_match_libm(void **context) {
    (void)context;
    for (int i = 0; i < 200000; i++) {
        // Half of the values lie close to 1, where acos is small.
        const double u = 2.0 * uniform() - 1.0;
        const double x = i & 1 ? u : 1.0 - fabs(u) * exp2(-40.0 * uniform());
        check_near(dip_acos(x), acosl(x), 1e-15 * (double)acosl(x) + 1e-300, x);
        check_near(dip_asin(x), asinl(x), 1e-15, x);
    }
    assert_true(dip_acos(1.0) == 0.0);
    assert_true(isnan(dip_acos(1.0000001)) && isnan(dip_asin(-1.0000001)) && isnan(dip_acos(NAN)));
}

// Hashes the bits of 60000 values. All compilers and processors must give the same hash.
static void results_have_the_same_bits_everywhere(void **context) {
    (void)context;
    DipHash hash = dip_hash_begin(0);
    for (int i = 0; i < 10000; i++) {
        const double x = (i - 5000) * 0.123456789;
        const double u = (i - 5000) / 5001.0;
        const double values[] = {dip_sin(x),  dip_cos(x),  dip_tan(x),
                                 dip_acos(u), dip_asin(u), dip_atan2(x, u)};
        dip_hash_bytes(&hash, values, sizeof values);
    }
    assert_int_equal(hash.lanes[0], UINT64_C(0x1a6208b1c77439bf));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sin_cos_tan_match_libm),
        cmocka_unit_test(results_near_multiples_of_quarter_pi_keep_their_digits),
        cmocka_unit_test(out_of_range_angles_are_nan),
        cmocka_unit_test(atan2_matches_libm),
        cmocka_unit_test(acos_asin_match_libm),
        cmocka_unit_test(results_have_the_same_bits_everywhere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
