// Tests of quantiles, estimates and intervals with values whose statistics are known.
#include "app/measure/stats/statistics.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>

static double scratch[4096];

static void quantiles_lie_between_neighbours(void **state) {
    (void)state;
    const double odd[] = {9, 1, 5};
    const double even[] = {4, 1, 2, 3};
    double hundred[101];
    for (int i = 0; i <= 100; i++) {
        hundred[i] = 100 - i;
    }
    assert_true(dip_stats_quantile(odd, 3, 0.5, scratch) == 5.0);
    assert_true(dip_stats_quantile(even, 4, 0.5, scratch) == 2.5);
    assert_true(dip_stats_quantile(even, 4, 1.0, scratch) == 4.0);
    assert_true(dip_stats_quantile(odd, 1, 0.95, scratch) == 9.0);
    assert_true(fabs(dip_stats_quantile(hundred, 101, 0.95, scratch) - 95.0) < 1e-9);
}

// Frames differ a hundredfold, but all rounds are equal. So the ratio of the medians, 300 to 100,
// is certain, and the interval's ends are equal.
static void different_frames_do_not_widen_the_interval(void **state) {
    (void)state;
    static const double by_frame[2][5] = {{600, 300, 200, 900, 30}, {1, 50, 100, 150, 200}};
    double a[15];
    double b[15];
    for (int i = 0; i < 15; i++) {
        a[i] = by_frame[0][i % 5];
        b[i] = by_frame[1][i % 5];
    }
    const DipStatsInterval interval = dip_stats_ratio_interval(a, b, 5, 3, scratch);
    assert_true(interval.low == 3.0 && interval.high == 3.0);
}

// There is one frame, in 20 rounds. The ratio of the medians is 2, and b has noise of +-10 %.
static void different_rounds_widen_the_interval(void **state) {
    (void)state;
    double a[20];
    double b[20];
    for (int i = 0; i < 20; i++) {
        a[i] = 2.0;
        b[i] = i % 2 ? 0.9 : 1.1;
    }
    const DipStatsInterval interval = dip_stats_ratio_interval(a, b, 1, 20, scratch);
    assert_true(interval.low < 1.9 && interval.low >= 2.0 / 1.1);
    assert_true(interval.high > 2.1 && interval.high <= 2.0 / 0.9);
}

static void the_median_needs_no_sorted_values(void **state) {
    (void)state;
    double odd[] = {9, 1, 5};
    double even[] = {4, 1, 2, 3};
    double equal[] = {2, 2, 2, 2};
    double one[] = {7};
    assert_true(dip_stats_median(odd, 3) == 5.0);
    assert_true(dip_stats_median(even, 4) == 2.5);
    assert_true(dip_stats_median(equal, 4) == 2.0);
    assert_true(dip_stats_median(one, 1) == 7.0);
    for (int count = 2; count < 200; count++) {
        double values[200], sorted[200];
        for (int i = 0; i < count; i++) {
            values[i] = i * 7919 % 101;
        }
        const double expected = dip_stats_quantile(values, count, 0.5, sorted);
        assert_true(dip_stats_median(values, count) == expected);
    }
}

// Frames take 10 and 20 ms, but in one of five rounds they take 100 ms more. The medians ignore
// this round.
static void a_time_is_the_mean_of_medians(void **state) {
    (void)state;
    double ms[10];
    for (int i = 0; i < 10; i++) {
        ms[i] = 10.0 * (i % 2 + 1) + (i / 2 == 3 ? 100.0 : 0.0);
    }
    assert_true(dip_stats_time(ms, 2, 5, scratch) == 15.0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_median_needs_no_sorted_values),
        cmocka_unit_test(a_time_is_the_mean_of_medians),
        cmocka_unit_test(quantiles_lie_between_neighbours),
        cmocka_unit_test(different_frames_do_not_widen_the_interval),
        cmocka_unit_test(different_rounds_widen_the_interval),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
