// Tests of the front, its knee and the advice on candidates with known times and errors, and of the
// words that tell them.
#include "app/report/choice.h"
#include "app/report/words.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 200 };

static DipCandidate made[MOST];
static DipCandidates candidates = {.list = made};

static uint32_t random_state = 1;

static double random_share(void) {
    random_state = random_state * 1664525u + 1013904223u;
    return (random_state >> 8) * 0x1p-24;
}

static double random_normal(void) {
    return sqrt(-2.0 * log(random_share() + 1e-9)) * cos(6.283185307179586 * random_share());
}

static DipCandidate *add(double ms, double log_error, double flip) {
    DipCandidate *candidate = &made[candidates.count];
    *candidate = (DipCandidate){.quality = dip_quality_default(),
                                .time = dip_estimate_make(ms, log_error, INFINITY),
                                .loss = flip,
                                .flip = flip,
                                .row = candidates.count++};
    return candidate;
}

static int clear(void **state) {
    (void)state;
    candidates = (DipCandidates){.list = made};
    return 0;
}

// --- the front -----------------------------------------------------------------------------------

static void no_candidate_is_better_than_the_front(void **state) {
    (void)state;
    int front[MOST];
    add(4.0, 0.01, 0.1);
    add(2.0, 0.01, 0.3);
    add(3.0, 0.01, 0.3); // Slower and no better than the one before.
    add(1.0, 0.01, 0.5);
    assert_int_equal(dip_front(&candidates, 0.0, front), 3);
    assert_true(front[0] == 3 && front[1] == 1 && front[2] == 0);
    made[1].loss = 0.101; // Candidate 0 is then less than 1 % better.
    assert_int_equal(dip_front(&candidates, 0.0, front), 3);
    assert_int_equal(dip_front(&candidates, DIP_CLEARLY_BETTER, front), 2);
    assert_int_equal(front[1], 1);
}

// A thinned front leaves out members of the whole one, and every member is the next better of the
// member before.
static void a_thinned_front_belongs_to_the_whole_one(void **state) {
    (void)state;
    for (int trial = 0; trial < 50; trial++) {
        int whole[MOST], thin[MOST], at = 0;
        candidates.count = 0;
        for (int i = 0; i < MOST; i++) {
            add(1.0 + random_share(), 0.01, 0.1 * (1.0 + 0.2 * random_share()));
        }
        const int count = dip_front(&candidates, 0.0, whole);
        const int kept = dip_front(&candidates, DIP_CLEARLY_BETTER, thin);
        for (int i = 0; i < count; i++) {
            for (int c = 0; c < MOST; c++) {
                assert_false(made[c].time.value < made[whole[i]].time.value &&
                             made[c].loss <= made[whole[i]].loss);
            }
        }
        for (int i = 0; i < kept; i++) {
            while (at < count && whole[at] != thin[i]) {
                at++;
            }
            assert_true(at < count);
            const int next = i + 1 < kept ? thin[i + 1] : -1;
            assert_int_equal(dip_next_better(&candidates, made[thin[i]].loss, DIP_CLEARLY_BETTER),
                             next);
        }
    }
}

// Below the line from (log 1, log .16) to (log 16, log .01), whose slope is -1: at 2 ms the line is
// at .08, at 4 ms at .04.
static void the_knee_is_farthest_below_the_line(void **state) {
    (void)state;
    const int front[4] = {0, 1, 2, 3};
    add(1.0, 0.01, 0.16);
    add(2.0, 0.01, 0.03);
    add(4.0, 0.01, 0.02);
    add(16.0, 0.01, 0.01);
    assert_int_equal(dip_front_knee(&candidates, front, 4), 1);
    assert_int_equal(dip_front_knee(&candidates, front, 2), -1);
}

// --- advice --------------------------------------------------------------------------------------

static void the_least_error_that_surely_fits_is_advised(void **state) {
    (void)state;
    add(4.0, 0.01, 0.100);
    add(3.0, 0.01, 0.1005); // Hardly worse than candidate 0, but faster.
    add(2.0, 0.01, 0.3);
    add(1.0, 0.01, 0.5);
    DipAdvice advice = dip_advise(&candidates, 5.0);
    assert_true(advice.chosen == 1 && advice.tie_count == 1 && advice.ties[0] == 0);
    assert_int_equal(advice.next, -1); // Candidate 0 is less than 1 % better.
    advice = dip_advise(&candidates, 2.5);
    assert_true(advice.chosen == 2 && advice.next == 1 && advice.tie_count == 0);
    assert_true(fabs(advice.next_ms - 1.0) < 1e-12 && advice.next_fits < 1e-6);
    // 2 ms with an error of 20 % are within 2.5 ms with less than 95 %.
    made[2].time = dip_estimate_make(2.0, 0.2, INFINITY);
    advice = dip_advise(&candidates, 2.5);
    assert_true(advice.chosen == 3 && advice.next == 2);
    assert_true(fabs(advice.next_fits - 0.8677) < 1e-3); // Phi(log(1.25) / .2)
    // Nothing fits: the fastest is next, and takes longer than the budget.
    advice = dip_advise(&candidates, 0.5);
    assert_true(advice.chosen == -1 && advice.next == 3 && isnan(advice.fits));
    assert_true(fabs(advice.next_ms - 0.5) < 1e-12);
}

// Of candidates that differ neither in time nor in error, the one with fewer settings is taken,
// wherever it stands in the list.
static void fewer_settings_are_preferred(void **state) {
    (void)state;
    for (int first = 0; first < 2; first++) {
        candidates.count = 0;
        add(3.0, 0.01, 0.1);
        add(3.01, 0.01, 0.1);
        made[first].quality.step[DIP_SETTING_AF] = 2;
        assert_int_equal(dip_advise(&candidates, 5.0).chosen, 1 - first);
    }
    // They are apart: the faster one is taken.
    made[0].time = dip_estimate_make(2.0, 0.01, INFINITY);
    made[0].quality.step[DIP_SETTING_AF] = 2;
    assert_int_equal(dip_advise(&candidates, 5.0).chosen, 0);
}

static void all_ties_are_counted_and_the_fastest_listed(void **state) {
    (void)state;
    for (int i = 0; i < 20; i++) {
        add(1.0 + 0.1 * ((7 * i) % 20), 1e-4, 0.1);
    }
    const DipAdvice advice = dip_advise(&candidates, 10.0);
    assert_int_equal(advice.chosen, 0);
    assert_int_equal(advice.tie_count, 19);
    for (int i = 0; i < DIP_ADVICE_TIES; i++) {
        assert_true(fabs(made[advice.ties[i]].time.value - (1.1 + 0.1 * i)) < 1e-9);
    }
}

static void unknown_errors_fit_nothing(void **state) {
    (void)state;
    add(1.0, NAN, 0.1);
    add(2.0, 0.01, 0.2);
    const DipAdvice advice = dip_advise(&candidates, 5.0);
    assert_true(advice.chosen == 1 && advice.next == 0 && isnan(advice.next_fits));
}

static void disturbed_times_advise_nothing(void **state) {
    (void)state;
    add(1.0, 0.01, 0.1);
    candidates.disturbed = true;
    const DipAdvice advice = dip_advise(&candidates, 5.0);
    assert_true(advice.chosen == -1 && advice.next == -1 && advice.tie_count == 0);
}

// True times are drawn around the measured ones: budgets are kept as often as the advice says.
static void advice_fits_with_its_probability(void **state) {
    (void)state;
    double said = 0.0;
    int kept = 0;
    enum { TRIALS = 4000 };
    for (int trial = 0; trial < TRIALS; trial++) {
        candidates.count = 0;
        const double common = 0.03 * random_normal();
        for (int i = 0; i < 12; i++) {
            const double true_ms = 1.0 + 0.5 * i;
            const double measured = true_ms * exp(0.04 * random_normal() + common);
            add(measured, 0.04, 0.2 / (i + 1))->common_error = 0.03;
        }
        // A budget at a fixed distance from one measured time: chosen with a known probability.
        const int i = trial % 12;
        const double budget_ms = made[i].time.value * 1.05;
        said += dip_candidate_fits(&made[i], budget_ms);
        kept += 1.0 + 0.5 * i <= budget_ms;
    }
    assert_true(fabs(said - kept) < 3.0 * sqrt(0.1 * TRIALS));
}

// --- words ---------------------------------------------------------------------------------------

static void no_change_has_no_sign(void **state) {
    (void)state;
    static const struct {
        double value;
        int decimals;
        bool change;
        const char *text;
    } rows[] = {
        {0.0, 4, true, "0.0000"},      {-0.00004, 4, true, "0.0000"}, {0.00004, 4, true, "0.0000"},
        {-0.0001, 4, true, "-0.0001"}, {0.25, 1, true, "+0.2"},       {-0.04, 1, false, "0.0"},
        {12.0, 0, false, "12"},        {-3.4, 0, true, "-3"},         {-0.4, 0, true, "0"},
    };
    char text[DIP_NUMBER_BYTES];
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        dip_number_text(rows[i].value, rows[i].decimals, rows[i].change, "-", text);
        assert_string_equal(text, rows[i].text);
    }
    dip_number_text(-1.5, 1, true, "\u2212", text);
    assert_string_equal(text, "\u22121.5");
}

static void budgets_and_probabilities_are_named(void **state) {
    (void)state;
    char text[DIP_BUDGET_BYTES];
    dip_budget_text(1000.0 / 60.0, text);
    assert_string_equal(text, "At 60 frames a second (16.7 ms)");
    dip_budget_text(16.7, text);
    assert_string_equal(text, "At 60 frames a second (16.7 ms)");
    dip_budget_text(16.6, text);
    assert_string_equal(text, "Within 16.6 ms a frame");
    dip_budget_text(1000.0 / 120.0, text);
    assert_string_equal(text, "At 120 frames a second (8.33 ms)");
    dip_budget_text(999.7, text);
    assert_string_equal(text, "Within 1000 ms a frame");
    dip_budget_text(100000.0, text);
    assert_string_equal(text, "Within 100000 ms a frame");
    dip_fits_text(0.9969, text);
    assert_string_equal(text, "99 %");
    dip_fits_text(1.0, text);
    assert_string_equal(text, "100 %");
    dip_fits_text(0.002, text);
    assert_string_equal(text, "1 %");
    dip_fits_text(NAN, text);
    assert_string_equal(text, "unknown");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(no_candidate_is_better_than_the_front, clear),
        cmocka_unit_test_setup(a_thinned_front_belongs_to_the_whole_one, clear),
        cmocka_unit_test_setup(the_knee_is_farthest_below_the_line, clear),
        cmocka_unit_test_setup(the_least_error_that_surely_fits_is_advised, clear),
        cmocka_unit_test_setup(fewer_settings_are_preferred, clear),
        cmocka_unit_test_setup(all_ties_are_counted_and_the_fastest_listed, clear),
        cmocka_unit_test_setup(unknown_errors_fit_nothing, clear),
        cmocka_unit_test_setup(disturbed_times_advise_nothing, clear),
        cmocka_unit_test_setup(advice_fits_with_its_probability, clear),
        cmocka_unit_test(no_change_has_no_sign),
        cmocka_unit_test(budgets_and_probabilities_are_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
