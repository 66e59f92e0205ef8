// Tests the parts of the fit of levels (app/measure/stats) against their definitions.
#include "app/measure/stats/rounds_fit_private.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { FRAMES = 7, UNITS = 3 };

// The variance of how far the known levels move when a unit is left out, in the definition's words:
// the mean square minus the square of the mean.
static long double variance_without(const double *levels, int unit) {
    const double *without = levels + (unit + 1) * FRAMES;
    long double sum = 0.0L, squares = 0.0L;
    int known = 0;
    for (int f = 0; f < FRAMES; f++) {
        if (!isnan(levels[f]) && !isnan(without[f])) {
            const long double moved = (long double)without[f] - levels[f];
            known++;
            sum += moved;
            squares += moved * moved;
        }
    }
    return known ? squares / known - sum * sum / known / known : 0.0L;
}

// The second unit knows few frames, and the third one knows none.
static void the_noise_of_levels_is_half_the_jackknifes_variance(void **state) {
    (void)state;
    double levels[(1 + UNITS) * FRAMES];
    uint32_t random = 5;
    for (int i = 0; i < (1 + UNITS) * FRAMES; i++) {
        random = random * 1664525u + 1013904223u;
        levels[i] = 1.0 + (random >> 8) * 0x1p-24;
    }
    levels[3] = NAN;
    for (int f = 0; f < FRAMES; f++) {
        levels[2 * FRAMES + f] = f == 1 || f == 4 ? levels[2 * FRAMES + f] : NAN;
        levels[3 * FRAMES + f] = NAN;
    }
    long double expected = 0.0L;
    for (int unit = 0; unit < UNITS; unit++) {
        expected += variance_without(levels, unit);
    }
    expected *= 0.5L * (UNITS - 1) / UNITS;
    const double found = dip_times_noise_of_levels(levels, FRAMES, UNITS);
    assert_true(expected > 0.01L);
    assert_true(fabsl(found - expected) < 1e-14L);
}

// Gaps lie on the straight line between the values around them, and repeat the values at the ends.
static void gaps_lie_on_straight_lines(void **state) {
    (void)state;
    double values[] = {NAN, NAN, 3.0, NAN, NAN, NAN, 7.0, 5.0, NAN, 6.0, NAN};
    static const double expected[] = {3.0, 3.0, 3.0, 4.0, 5.0, 6.0, 7.0, 5.0, 5.5, 6.0, 6.0};
    double none[] = {NAN, NAN};
    dip_times_fill_gaps(values, 11);
    for (int i = 0; i < 11; i++) {
        assert_true(fabs(values[i] - expected[i]) < 1e-15);
    }
    dip_times_fill_gaps(none, 2);
    assert_true(isnan(none[0]) && isnan(none[1]));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_noise_of_levels_is_half_the_jackknifes_variance),
        cmocka_unit_test(gaps_lie_on_straight_lines),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
