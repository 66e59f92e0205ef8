// Tests advice from live prices against a search over nested loops of known sums.
#include "tests/app/preview/made_live.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define BASE_MS   5.0
#define BASE_FLIP 0.08

// What the steps add, in the order of the steps' indices.
static const double aa_ms[] = {0.0, 1.0, 1.9, 2.7, 3.4};
static const double aa_flip[] = {0.0, -0.02, -0.03, -0.034, -0.036};
static const double af_ms[] = {0.0, 0.4, 0.9, 1.6, 2.6};
static const double af_flip[] = {0.0, -0.008, -0.012, -0.015, -0.016};
static const double opt_ms[] = {0.0, -0.3, -0.9};
static const double opt_flip[] = {0.0, 0.004, 0.02};
static const double mip_ms[] = {-0.8, -0.5, -0.2, 0.0, 0.1, 0.3};
static const double mip_flip[] = {0.05, 0.03, 0.01, 0.0, -0.004, -0.006};

static DipPrices *prices;

static DipQuality quality_of(const char *text) {
    DipQuality quality;
    assert_true(dip_quality_parse(text, &quality, NULL));
    return quality;
}

static void add_steps(DipSetting setting, const double *ms, const double *flip, int base,
                      bool errors) {
    for (int i = 0; i < dip_setting_info(setting)->step_count; i++) {
        DipQuality quality = quality_of("aa=none");
        quality.step[setting] = (uint8_t)i;
        if (i != base) {
            char text[200];
            dip_quality_format(&quality, text, sizeof text);
            dip_made_live(prices, text, BASE_MS + ms[i], 0.001,
                          errors ? BASE_FLIP + flip[i] : -1.0);
        }
    }
}

static void add_all(bool errors) {
    dip_made_live(prices, "aa=none", BASE_MS, 0.001, errors ? BASE_FLIP : -1.0);
    add_steps(DIP_SETTING_AA, aa_ms, aa_flip, 0, errors);
    add_steps(DIP_SETTING_AF, af_ms, af_flip, 0, errors);
    add_steps(DIP_SETTING_OPT, opt_ms, opt_flip, 0, errors);
    add_steps(DIP_SETTING_MIPLOD, mip_ms, mip_flip, 3, errors);
}

// The least error of the combinations whose time is within the budget, or INFINITY.
static double least_flip(double budget_ms) {
    double least = INFINITY;
    for (int aa = 0; aa < 5; aa++) {
        for (int af = 0; af < 5; af++) {
            for (int opt = 0; opt < 3; opt++) {
                for (int mip = 0; mip < 6; mip++) {
                    const double ms = BASE_MS + aa_ms[aa] + af_ms[af] + opt_ms[opt] + mip_ms[mip];
                    const double flip =
                        BASE_FLIP + aa_flip[aa] + af_flip[af] + opt_flip[opt] + mip_flip[mip];
                    least = ms <= budget_ms && flip < least ? flip : least;
                }
            }
        }
    }
    return least;
}

static DipAdvice advise(const DipQuality *like, double budget_ms, DipCandidates *candidates) {
    assert_int_equal(dip_price_candidates(dip_prices_view(prices), like, candidates),
                     DIP_PRICES_KNOWN);
    return dip_advise(candidates, budget_ms);
}

// Intervals of about 0.5 % move the budget by less than 1.5 %.
static void the_advice_is_within_one_percent_of_the_best(void **state) {
    (void)state;
    const DipQuality like = quality_of("aa=none");
    prices = dip_prices_create(NULL);
    add_all(true);
    int found = 0;
    for (double budget_ms = 2.5; budget_ms < 13.0; budget_ms += 0.05) {
        DipCandidates candidates;
        const DipAdvice advice = advise(&like, budget_ms, &candidates);
        if (advice.chosen < 0) {
            assert_true(isinf(least_flip(0.985 * budget_ms)));
            const DipCandidate *fastest = &candidates.list[advice.next];
            assert_true(fabs(fastest->time.value - (BASE_MS - 0.9 - 0.8)) < 1e-9);
            free(candidates.list);
            continue;
        }
        const DipCandidate *advised = &candidates.list[advice.chosen];
        assert_true(advised->time.value <= budget_ms && advice.fits >= DIP_SURELY_FITS);
        assert_true(advised->flip >= least_flip(budget_ms) - 1e-9);
        assert_true(advised->flip <= 1.01 * least_flip(0.985 * budget_ms) + 1e-9);
        assert_int_equal(advised->quality.step[DIP_SETTING_AAA], 0); // It has no price here.
        const uint8_t *step = advised->quality.step;
        const double ms = BASE_MS + aa_ms[step[DIP_SETTING_AA]] + af_ms[step[DIP_SETTING_AF]] +
                          opt_ms[step[DIP_SETTING_OPT]] + mip_ms[step[DIP_SETTING_MIPLOD]];
        assert_true(fabs(ms - advised->time.value) < 1e-9);
        free(candidates.list);
        found++;
    }
    assert_true(found > 100);
    dip_prices_destroy(&prices);
}

static void steps_that_need_company_are_considered_beside_it(void **state) {
    (void)state;
    const DipQuality like = quality_of("aa=4,af=8");
    prices = dip_prices_create(NULL);
    add_all(true);
    DipCandidates candidates;
    assert_int_equal(dip_price_candidates(dip_prices_view(prices), &like, &candidates),
                     DIP_PRICES_NO_TIMES);
    dip_made_live(prices, "aa=4,aaa=on", 8.0, 0.001, 0.04);
    dip_made_live(prices, "af=8,aaf=on", 7.0, 0.001, 0.06);
    const DipAdvice advice = advise(&like, 33.0, &candidates);
    assert_true(advice.chosen >= 0);
    const DipQuality *quality = &candidates.list[advice.chosen].quality;
    assert_int_equal(quality->step[DIP_SETTING_AAA], DIP_AAA_ON);
    assert_int_equal(quality->step[DIP_SETTING_AAF], 1);
    free(candidates.list);
    dip_prices_destroy(&prices);
}

static void without_errors_there_is_no_advice(void **state) {
    (void)state;
    const DipQuality like = quality_of("aa=none");
    DipCandidates candidates;
    prices = dip_prices_create(NULL);
    assert_int_equal(dip_price_candidates(dip_prices_view(prices), &like, &candidates),
                     DIP_PRICES_NO_TIMES);
    assert_null(candidates.list);
    add_all(false);
    assert_int_equal(dip_price_candidates(dip_prices_view(prices), &like, &candidates),
                     DIP_PRICES_NO_ERRORS);
    assert_null(candidates.list);
    dip_prices_destroy(&prices);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_advice_is_within_one_percent_of_the_best),
        cmocka_unit_test(steps_that_need_company_are_considered_beside_it),
        cmocka_unit_test(without_errors_there_is_no_advice),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
