// Tests the odds of a choice against closed forms of the normal distribution.
#include "app/measure/stats/choice.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

// The probability that a normal variable is at most x standard errors above its mean.
static double normal(double x) {
    return 0.5 * erfc(-x / sqrt(2.0));
}

static void assert_near(double a, double b, double tolerance) {
    assert_true(fabs(a - b) <= tolerance);
}

static DipChoiceOdds odds_of(const DipChoice *choices, int count, int chosen, double budget,
                             double common_error, double tolerance) {
    DipChoiceOdds odds;
    assert_true(
        dip_choice_odds(choices, count, chosen, budget, common_error, tolerance, &odds, NULL));
    return odds;
}

// 2000 draws have a standard error of at most .011.
static const double drawn = 0.035;

static void a_choice_alone_is_best_if_it_is_within_the_budget(void **state) {
    (void)state;
    const DipChoice one[] = {{.time = 10.0, .error = 0.02, .loss = 1.0}};
    assert_near(odds_of(one, 1, 0, 10.0, 0.0, 0.01).best, 0.5, drawn);
    assert_near(odds_of(one, 1, 0, 10.0 * exp(0.02), 0.0, 0.01).best, normal(1.0), drawn);
    // Two independent errors add in quadrature.
    assert_near(odds_of(one, 1, 0, 10.0 * exp(0.02), 0.02, 0.01).best, normal(1.0 / sqrt(2.0)),
                drawn);
    assert_int_equal(odds_of(one, 1, 0, 10.0, 0.0, 0.01).runner_up, -1);
}

static void a_better_candidate_near_the_budget_is_the_runner_up(void **state) {
    (void)state;
    const DipChoice two[] = {{5.0, 0.02, 1.0}, {10.0, 0.02, 0.8}, {10.5, 0.02, 0.7}};
    const DipChoiceOdds odds = odds_of(two, 3, 0, 10.0 * exp(-0.02), 0.0, 0.01);
    const double second = normal(-1.0);
    const double third = normal(log(10.0 / 10.5) / 0.02 - 1.0);
    assert_near(odds.best, (1.0 - second) * (1.0 - third), drawn);
    assert_int_equal(odds.runner_up, 1);
    assert_near(odds.runner_up_best, second * (1.0 - third), drawn);
}

static void losses_within_the_tolerance_do_not_count(void **state) {
    (void)state;
    const DipChoice two[] = {{5.0, 0.01, 1.0}, {5.0, 0.01, 0.991}};
    assert_near(odds_of(two, 2, 0, 10.0, 0.0, 0.01).best, 1.0, 0.0);
    assert_near(odds_of(two, 2, 0, 10.0, 0.0, 0.005).best, 0.0, 0.0);
}

// If all times move together, the slower candidate never fits without the faster one.
static void a_common_error_moves_all_times_together(void **state) {
    (void)state;
    const DipChoice two[] = {{10.0, 0.0, 1.0}, {10.0, 0.0, 1.0}};
    assert_near(odds_of(two, 2, 0, 10.0, 0.05, 0.01).best, 0.5, drawn);
    const DipChoice apart[] = {{10.0, 0.05, 1.0}, {10.0, 0.05, 1.0}};
    const DipChoiceOdds odds = odds_of(apart, 2, 0, 10.0, 0.0, 0.01);
    assert_near(odds.best, 0.5, drawn);
    assert_near(odds.runner_up_best, 0.25, drawn); // The chosen one does not fit; the other does.
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_choice_alone_is_best_if_it_is_within_the_budget),
        cmocka_unit_test(a_better_candidate_near_the_budget_is_the_runner_up),
        cmocka_unit_test(losses_within_the_tolerance_do_not_count),
        cmocka_unit_test(a_common_error_moves_all_times_together),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
