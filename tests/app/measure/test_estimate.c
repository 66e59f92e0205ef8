// Estimates with their intervals and chances, the quantiles behind them, and percentiles.
#include "app/measure/stats/estimate.h"
#include "renderer/base/assert.h"
#include "renderer/base/trig.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>

// Published tables of the distribution (for example NIST's handbook, section 1.3.6.7.2).
static void student_has_the_published_quantiles(void **state) {
    (void)state;
    static const struct {
        double probability, degrees, value;
    } table[] = {{0.975, 1, 12.706}, {0.975, 2, 4.303},  {0.975, 3, 3.182},  {0.975, 6, 2.447},
                 {0.975, 13, 2.160}, {0.975, 15, 2.131}, {0.975, 30, 2.042}, {0.975, 100, 1.984},
                 {0.95, 5, 2.015},   {0.995, 10, 3.169}, {0.9, 7, 1.415},    {0.975, 1e9, 1.960},
                 {0.975, 3.5, 2.939}};
    for (size_t i = 0; i < DIP_ARRAY_COUNT(table); i++) {
        const double got = dip_student_quantile(table[i].probability, table[i].degrees);
        assert_true(fabs(got - table[i].value) < (table[i].degrees == 3.5 ? 0.05 : 6e-4));
    }
    assert_true(fabs(dip_student_quantile(0.5, 4)) < 1e-9);
    // Closed forms for 1 and 2 degrees of freedom, and the normal distribution, at the bounds of
    // the most rows that a report has.
    for (double beyond = 1e-6; beyond < 0.5; beyond *= 3.0) {
        const double p = 1.0 - beyond;
        const double cauchy = 1.0 / tan(DIP_PI * beyond);
        const double two = (2.0 * p - 1.0) / sqrt(2.0 * p * beyond);
        assert_true(fabs(dip_student_quantile(p, 1.0) / cauchy - 1.0) < 1e-8);
        assert_true(fabs(dip_student_quantile(p, 2.0) / two - 1.0) < 1e-8);
    }
    assert_true(fabs(dip_student_quantile(0.999999, INFINITY) - 4.753424) < 1e-6);
}

static void an_estimate_needs_a_finite_error_and_a_degree_of_freedom(void **state) {
    (void)state;
    static const double unknown[][2] = {{0.0, 5.0},      {-0.1, 5.0}, {NAN, 5.0}, {INFINITY, 5.0},
                                        {INFINITY, 0.0}, {0.1, 0.99}, {0.1, NAN}};
    for (size_t i = 0; i < sizeof unknown / sizeof *unknown; i++) {
        const DipEstimate e = dip_estimate_make(2.0, unknown[i][0], unknown[i][1]);
        assert_true(e.value == 2.0 && isnan(e.low) && isnan(e.high));
        assert_true(isnan(e.log_error) && isnan(e.degrees));
    }
    const DipEstimate known = dip_estimate_make(2.0, 0.1, 1.0);
    assert_true(known.low < 2.0 && known.high > 2.0);
}

static void an_estimate_says_how_likely_a_limit_holds(void **state) {
    (void)state;
    const DipEstimate known = dip_estimate_make(10.0, 0.05, INFINITY);
    assert_true(fabs(log(known.high / 10.0) - 1.95996 * 0.05) < 1e-4);
    assert_true(fabs(dip_estimate_chance_below(&known, known.high, 0.0) - 0.975) < 1e-4);
    assert_true(fabs(dip_estimate_chance_below(&known, 10.0, 0.0) - 0.5) < 1e-9);
    assert_true(dip_estimate_chance_below(&known, known.high, 0.05) < 0.93);
    const DipEstimate wider = dip_estimate_widen(&known, 0.05);
    assert_true(wider.low < known.low && wider.high > known.high);
    const DipEstimate unknown = dip_estimate_make(10.0, 0.0, 5.0);
    assert_true(unknown.value == 10.0 && isnan(unknown.low) && isnan(unknown.high));
    assert_true(isnan(dip_estimate_chance_below(&unknown, 12.0, 0.0)));
}

// With one degree of freedom, Student's t is the distribution of Cauchy. The two errors 0.3 and 0.4
// add up to 0.5.
static void chances_follow_students_t(void **state) {
    (void)state;
    const DipEstimate one = dip_estimate_make(10.0, 0.3, 1.0);
    for (int i = -8; i <= 8; i++) {
        const double t = 0.5 * i;
        const double chance = dip_estimate_chance_below(&one, 10.0 * exp(0.5 * t), 0.4);
        assert_true(fabs(chance - (0.5 + atan(t) / DIP_PI)) < 1e-12);
    }
    const DipEstimate two = dip_estimate_make(10.0, 0.5, 2.0);
    const double chance = dip_estimate_chance_below(&two, 10.0 * exp(0.5 * 1.5), 0.0);
    assert_true(fabs(chance - (0.5 + 1.5 / (2.0 * sqrt(2.0 + 1.5 * 1.5)))) < 1e-12);
    const DipEstimate wider = dip_estimate_widen(&one, 0.4);
    assert_true(fabs(wider.log_error - 0.5) < 1e-15 && wider.degrees == 1.0 && wider.value == 10.0);
    // No time is 0 or less; what is known of an impossible value is nothing.
    assert_true(dip_estimate_chance_below(&one, 0.0, 0.4) == 0.0);
    assert_true(dip_estimate_chance_below(&one, -1.0, 0.4) == 0.0);
    const DipEstimate impossible = {0.0, NAN, NAN, 0.3, 1.0};
    assert_true(isnan(dip_estimate_chance_below(&impossible, 1.0, 0.4)));
    assert_true(isnan(dip_estimate_chance_below(&one, 1.0, NAN)));
}

static void a_percentile_is_linear_between_neighbours(void **state) {
    (void)state;
    double values[20];
    for (int i = 0; i < 20; i++) {
        values[i] = 20.0 - i;
    }
    assert_true(fabs(dip_percentile(values, 20, 0.95) - 19.05) < 1e-12);
    assert_true(dip_percentile(values, 1, 0.95) == 1.0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(student_has_the_published_quantiles),
        cmocka_unit_test(an_estimate_needs_a_finite_error_and_a_degree_of_freedom),
        cmocka_unit_test(an_estimate_says_how_likely_a_limit_holds),
        cmocka_unit_test(chances_follow_students_t),
        cmocka_unit_test(a_percentile_is_linear_between_neighbours),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
