// Tests of percentiles and medians of values whose statistics are known, and of intervals.
#include "app/measure/stats/estimate.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>

static double scratch[4096];

static void percentiles_lie_between_neighbours(void **state) {
    (void)state;
    const double odd[] = {9, 1, 5};
    const double even[] = {4, 1, 2, 3};
    double hundred[101];
    for (int i = 0; i <= 100; i++) {
        hundred[i] = 100 - i;
    }
    assert_true(dip_percentile_of(odd, 3, 0.5, scratch) == 5.0);
    assert_true(dip_percentile_of(even, 4, 0.5, scratch) == 2.5);
    assert_true(dip_percentile_of(even, 4, 1.0, scratch) == 4.0);
    assert_true(dip_percentile_of(odd, 1, 0.95, scratch) == 9.0);
    assert_true(fabs(dip_percentile_of(hundred, 101, 0.95, scratch) - 95.0) < 1e-9);
}

static void the_median_needs_no_sorted_values(void **state) {
    (void)state;
    double odd[] = {9, 1, 5};
    double even[] = {4, 1, 2, 3};
    double equal[] = {2, 2, 2, 2};
    double one[] = {7};
    assert_true(dip_median(odd, 3) == 5.0);
    assert_true(dip_median(even, 4) == 2.5);
    assert_true(dip_median(equal, 4) == 2.0);
    assert_true(dip_median(one, 1) == 7.0);
    for (int count = 2; count < 200; count++) {
        double values[200], sorted[200];
        for (int i = 0; i < count; i++) {
            values[i] = i * 7919 % 101;
        }
        const double expected = dip_percentile_of(values, count, 0.5, sorted);
        assert_true(dip_median(values, count) == expected);
    }
}

// The error of the logarithm may be so great that one end of the interval is infinite.
static void an_interval_has_both_ends_or_none(void **state) {
    (void)state;
    const DipEstimate wide = dip_estimate_make(2.0, 100.0, 5.0);
    assert_true(wide.low > 0.0 && wide.low < 2.0 && wide.high > 2.0 && isfinite(wide.high));
    const DipEstimate endless = dip_estimate_make(2.0, 1000.0, 5.0);
    assert_true(endless.value == 2.0 && isnan(endless.low) && isnan(endless.high));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_median_needs_no_sorted_values),
        cmocka_unit_test(percentiles_lie_between_neighbours),
        cmocka_unit_test(an_interval_has_both_ends_or_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
