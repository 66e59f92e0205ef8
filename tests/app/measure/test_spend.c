// Tests of spending a budget on several parts: against trying all choices, and against a closed
// form.
#include "app/measure/stats/spend.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include <math.h>

enum { PARTS = 4, OPTIONS = 7 };

static uint32_t random_state = 1;

static double random_share(void) {
    random_state = random_state * 1664525u + 1013904223u;
    return (random_state >> 8) * 0x1p-24;
}

static void expect_near(double found, double expected, double tolerance) {
    if (!(fabs(found - expected) <= tolerance)) {
        fail_msg("%.9g, expected %.9g", found, expected);
    }
}

static void make_random(DipSpendOption options[PARTS * OPTIONS]) {
    for (int i = 0; i < PARTS * OPTIONS; i++) {
        const double cost = 1.0 + 9.0 * random_share();
        options[i] = (DipSpendOption){cost, (1.0 + random_share()) * (1.0 + i / OPTIONS) / cost};
    }
}

// --- hulls ---------------------------------------------------------------------------------------

// A point is on the hull if it wins for some price of cost: if no price separates it from winning,
// it is not. Winning for a price means that loss + price * cost is least.
static bool wins_somewhere(const DipSpendOption *options, int index) {
    double least_price = 0.0, most_price = INFINITY;
    for (int i = 0; i < OPTIONS; i++) {
        const double cost = options[i].cost - options[index].cost;
        const double loss = options[i].loss - options[index].loss;
        // loss + price * cost >= 0 must hold.
        if (cost > 0.0) {
            least_price = fmax(least_price, -loss / cost);
        } else if (cost < 0.0) {
            most_price = fmin(most_price, loss / -cost);
        }
    }
    return least_price < most_price;
}

static void the_hull_has_what_wins_for_some_price(void **state) {
    (void)state;
    for (int trial = 0; trial < 500; trial++) {
        DipSpendOption options[PARTS * OPTIONS];
        int hull[OPTIONS];
        int expected = 0;
        make_random(options);
        const int count = dip_spend_hull(options, OPTIONS, hull);
        for (int i = 0; i < OPTIONS; i++) {
            bool is_on_hull = false;
            for (int k = 0; k < count; k++) {
                is_on_hull = is_on_hull || hull[k] == i;
            }
            assert_int_equal(is_on_hull, wins_somewhere(options, i));
            expected += is_on_hull;
        }
        assert_int_equal(count, expected);
        for (int k = 1; k < count; k++) {
            assert_true(options[hull[k]].cost > options[hull[k - 1]].cost);
            assert_true(options[hull[k]].loss < options[hull[k - 1]].loss);
        }
    }
}

static void the_hull_leaves_out_ties_and_lines(void **state) {
    (void)state;
    // Options 1 and 2 cost the same; option 3 lies on the line from 2 to 4; option 5 is no better.
    static const DipSpendOption options[] = {{5.0, 9.0}, {1.0, 8.0}, {1.0, 6.0},
                                             {2.0, 4.0}, {3.0, 2.0}, {4.0, 2.0}};
    int hull[6];
    assert_int_equal(dip_spend_hull(options, 6, hull), 2);
    assert_true(hull[0] == 2 && hull[1] == 4);
    assert_int_equal(dip_spend_hull(options, 1, hull), 1);
}

// --- spending ------------------------------------------------------------------------------------

// The least loss of all OPTIONS^PARTS choices within the budget; INFINITY if none is.
static double try_all(const DipSpendOption *options, double budget) {
    double least = INFINITY;
    for (int code = 0; code < OPTIONS * OPTIONS * OPTIONS * OPTIONS; code++) {
        double cost = 0.0, loss = 0.0;
        for (int p = 0, rest = code; p < PARTS; p++, rest /= OPTIONS) {
            cost += options[p * OPTIONS + rest % OPTIONS].cost;
            loss += options[p * OPTIONS + rest % OPTIONS].loss;
        }
        least = cost <= budget && loss < least ? loss : least;
    }
    return least;
}

static void check_sums(const DipSpendOption *options, const int *chosen, double budget,
                       const DipSpendResult *result) {
    double cost = 0.0, loss = 0.0;
    for (int p = 0; p < PARTS; p++) {
        cost += options[p * OPTIONS + chosen[p]].cost;
        loss += options[p * OPTIONS + chosen[p]].loss;
    }
    expect_near(result->cost, cost, 1e-12);
    expect_near(result->loss, loss, 1e-12);
    assert_int_equal(result->fits, cost <= budget);
}

// The greatest fall of an edge of a hull.
static double greatest_fall(const DipSpendOption *options) {
    double most = 0.0;
    for (int p = 0; p < PARTS; p++) {
        int hull[OPTIONS];
        const DipSpendOption *part = options + p * OPTIONS;
        const int count = dip_spend_hull(part, OPTIONS, hull);
        for (int k = 1; k < count; k++) {
            most = fmax(most, part[hull[k - 1]].loss - part[hull[k]].loss);
        }
    }
    return most;
}

static void choices_are_near_the_best_of_all(void **state) {
    (void)state;
    int best = 0, tried = 0;
    for (int trial = 0; trial < 40; trial++) {
        DipSpendOption options[PARTS * OPTIONS];
        int chosen[PARTS];
        make_random(options);
        const double fall = greatest_fall(options);
        for (double budget = 5.0; budget < 40.0; budget += 2.5) {
            const double least = try_all(options, budget);
            const DipSpendResult result = dip_spend(options, PARTS, OPTIONS, budget, chosen);
            check_sums(options, chosen, budget, &result);
            assert_int_equal(result.fits, isfinite(least));
            if (result.fits) {
                assert_true(result.loss >= least - 1e-12 && result.loss < least + fall);
                best += result.loss <= least + 1e-12;
                tried++;
            }
        }
    }
    assert_true(tried > 300 && best > tried / 2);
}

// With a budget of just what points of equal slope cost, no choice is better (Everett's theorem).
static void a_choice_of_equal_slope_is_the_best_of_its_cost(void **state) {
    (void)state;
    for (int trial = 0; trial < 40; trial++) {
        DipSpendOption options[PARTS * OPTIONS];
        int chosen[PARTS];
        make_random(options);
        for (double price = 0.02; price < 3.0; price *= 2.0) {
            double budget = 0.0;
            for (int p = 0; p < PARTS; p++) {
                int best = 0;
                for (int i = 1; i < OPTIONS; i++) {
                    const DipSpendOption *a = &options[p * OPTIONS + i];
                    const DipSpendOption *b = &options[p * OPTIONS + best];
                    best = a->loss + price * a->cost < b->loss + price * b->cost ? i : best;
                }
                budget += options[p * OPTIONS + best].cost;
            }
            const DipSpendResult result =
                dip_spend(options, PARTS, OPTIONS, budget * (1.0 + 1e-12), chosen);
            expect_near(result.loss, try_all(options, budget * (1.0 + 1e-12)), 1e-12);
            assert_true(result.slope <= price + 1e-12);
        }
    }
}

// Losses of a_p / cost: the best costs are proportional to the roots of a_p (Lagrange), and the
// loss falls by (sum of roots)^2 / budget^2 per unit of the budget.
static void costs_follow_the_closed_form(void **state) {
    (void)state;
    enum { FINE = 2000 };
    static const double a[3] = {1.0, 4.0, 9.0};
    static DipSpendOption options[3 * FINE];
    int chosen[3];
    const double budget = 12.0 + 1e-9;
    for (int p = 0; p < 3; p++) {
        for (int i = 0; i < FINE; i++) {
            const double cost = 0.005 * (i + 1);
            options[p * FINE + i] = (DipSpendOption){cost, a[p] / cost};
        }
    }
    const DipSpendResult result = dip_spend(options, 3, FINE, budget, chosen);
    for (int p = 0; p < 3; p++) {
        expect_near(options[p * FINE + chosen[p]].cost, budget * sqrt(a[p]) / 6.0, 0.03);
    }
    expect_near(result.loss, 36.0 / budget, 1e-4);
    expect_near(result.slope, 36.0 / (budget * budget), 2e-3);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_hull_has_what_wins_for_some_price),
        cmocka_unit_test(the_hull_leaves_out_ties_and_lines),
        cmocka_unit_test(choices_are_near_the_best_of_all),
        cmocka_unit_test(a_choice_of_equal_slope_is_the_best_of_its_cost),
        cmocka_unit_test(costs_follow_the_closed_form),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
