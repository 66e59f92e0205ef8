// Tests of common advice (cost advise): one choice of settings for several reports.
#include "app/cost/advise/common_advice.h"
#include "app/report/format/formats.h"
#include "tests/app/cost/made_report.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include <math.h>

enum { REPORTS = 3, COMBINATIONS = 25, ROUNDS = 16 };

// A time of this error surely fits a budget that is longer by this factor: the 95 % quantile of
// Student's t with 15 degrees of freedom is 1.7531 (published tables).
static const double sure = 1.003513; // exp(1.7531 * .002)

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

// Combination c has step c / 5 of AA and step c % 5 of AF.
static DipQuality quality_of(int c) {
    DipQuality quality = dip_quality_default();
    quality.step[DIP_SETTING_AA] = (uint8_t)(c / 5);
    quality.step[DIP_SETTING_AF] = (uint8_t)(c % 5);
    return quality;
}

// Sets the time that budgets are meant for, and the standard error of its logarithm.
static void set_time(DipCostReport *report, int row, double ms, double error) {
    report->rows[row].time.p95_ms.value = ms;
    report->rows[row].time.p95_error = error;
    report->rows[row].time.level_error = 0.0;
}

// Adds a combination with a time that is known as well as any: to 2 per mille.
static int add(DipCostReport *report, int c, double ms, double flip) {
    const DipQuality quality = quality_of(c);
    const int row = dip_made_combination(report, &quality, ms, flip);
    set_time(report, row, ms, 0.0);
    return row;
}

static void begin(DipCostCommon *common, int reports) {
    static const char *const names[REPORTS] = {"a.json", "b.json", "c.json"};
    *common = (DipCostCommon){.reports = calloc((size_t)reports, sizeof(DipCostReport))};
    assert_non_null(common->reports);
    for (int i = 0; i < reports; i++) {
        dip_made_report(&common->reports[i], ROUNDS);
        common->names[i] = names[i];
    }
    common->report_count = reports;
}

// --- choosing ------------------------------------------------------------------------------------

// Times and errors of random combinations; 0 ms: the report has not measured the combination.
typedef struct Truth {
    double ms[REPORTS][COMBINATIONS];
    double flip[REPORTS][COMBINATIONS];
} Truth;

// Every report lists its combinations in another order, and misses some.
static void make_random(DipCostCommon *common, Truth *truth) {
    begin(common, REPORTS);
    for (int i = 0; i < REPORTS; i++) {
        for (int k = 0; k < COMBINATIONS; k++) {
            const int c = (7 * k + 3 * i) % COMBINATIONS;
            const bool has = random_share() < 0.9;
            truth->ms[i][c] = has ? 1.0 + 9.0 * random_share() : 0.0;
            // Errors in steps of 0.4 %, so that several combinations are alike.
            truth->flip[i][c] = 0.05 * (1.0 + 0.004 * floor(20.0 * random_share()));
            if (has) {
                add(&common->reports[i], c, truth->ms[i][c], truth->flip[i][c]);
            }
        }
    }
}

// Tries all combinations: the least mean FLIP within the budget, and then the fastest, in the
// report in which each takes longest, of those with at most 1.01 times this FLIP. Of those whose
// intervals overlap with the fastest one's, the one with the fewest changes. Returns -1 if nothing
// is within the budget.
static int try_all(const Truth *truth, double budget_ms) {
    const double wide = 1.0042718; // Half of an interval: exp(2.1314 * .002).
    double mean[COMBINATIONS], longest[COMBINATIONS];
    double least = INFINITY, fastest = INFINITY;
    for (int c = 0; c < COMBINATIONS; c++) {
        bool fits = true;
        mean[c] = 0.0;
        longest[c] = 0.0;
        for (int i = 0; i < REPORTS; i++) {
            fits = fits && truth->ms[i][c] > 0.0 && sure * truth->ms[i][c] <= budget_ms;
            mean[c] += truth->flip[i][c] / REPORTS;
            longest[c] = fmax(longest[c], truth->ms[i][c]);
        }
        mean[c] = fits ? mean[c] : INFINITY;
        least = fmin(least, mean[c]);
    }
    for (int c = 0; c < COMBINATIONS; c++) {
        fastest =
            isfinite(mean[c]) && mean[c] <= 1.01 * least ? fmin(fastest, longest[c]) : fastest;
    }
    int best = -1;
    for (int c = 0; c < COMBINATIONS; c++) {
        const int changes = (c / 5 > 0) + (c % 5 > 0), other = (best / 5 > 0) + (best % 5 > 0);
        if (isfinite(mean[c]) && mean[c] <= 1.01 * least && longest[c] / wide <= wide * fastest &&
            (best < 0 || changes < other || (changes == other && longest[c] < longest[best]))) {
            best = c;
        }
    }
    return best;
}

static void the_common_choice_is_that_of_trying_all(void **state) {
    (void)state;
    int chosen = 0, none = 0;
    for (int trial = 0; trial < 60; trial++) {
        DipCostCommon common;
        DipCostCommonAdvice advice;
        Truth truth;
        make_random(&common, &truth);
        assert_true(dip_cost_common_match(&common, NULL));
        for (double budget_ms = 1.5; budget_ms < 12.0; budget_ms += 1.7) {
            const int expected = try_all(&truth, budget_ms);
            dip_cost_common_advise(&common, budget_ms, &advice);
            assert_int_equal(advice.all.chosen >= 0, expected >= 0);
            if (expected >= 0) {
                const DipQuality quality = quality_of(expected);
                assert_memory_equal(&common.candidates.list[advice.all.chosen].quality, &quality,
                                    sizeof quality);
                chosen++;
            }
            none += expected < 0;
        }
        dip_cost_common_free(&common);
    }
    assert_true(chosen > 100 && none > 20);
}

// With one report, the choice is the one that the report itself prints, also if intervals overlap.
static void advise_of_one_report_is_its_advice(void **state) {
    (void)state;
    for (int trial = 0; trial < 60; trial++) {
        DipCostCommon common;
        begin(&common, 1);
        DipCostReport *report = &common.reports[0];
        for (int c = 0; c < COMBINATIONS; c++) {
            const double ms = 1.0 + 9.0 * random_share();
            const int row = add(report, c, ms, 0.05 * (1.0 + 0.1 * random_share()));
            set_time(report, row, ms, 0.1 * random_share());
        }
        assert_true(dip_cost_common_match(&common, NULL));
        assert_int_equal(common.candidates.count, COMBINATIONS);
        for (double budget_ms = 1.5; budget_ms < 12.0; budget_ms += 0.7) {
            DipCostCommonAdvice advice;
            report->options.budgets_ms[0] = budget_ms;
            assert_true(dip_cost_choose(report, NULL));
            const DipCandidate *own = dip_cost_chosen(report, 0);
            const DipAdvice *of_report = &report->choice.advice[0];
            dip_cost_common_advise(&common, budget_ms, &advice);
            const int chosen = advice.all.chosen, next = advice.all.next;
            assert_int_equal(chosen >= 0 ? dip_cost_common_row(&common, chosen, 0) : -1,
                             own ? own->row : -1);
            assert_int_equal(advice.alone[0], own ? own->row : -1);
            assert_int_equal(
                next >= 0 ? dip_cost_common_row(&common, next, 0) : -1,
                of_report->next >= 0 ? report->choice.candidates.list[of_report->next].row : -1);
            assert_true(advice.all.next_ms == of_report->next_ms);
        }
        dip_cost_common_free(&common);
    }
}

// Combination 1 would be better than 0, but is too slow in the second report; 2 is the best in the
// first one alone.
static void make_three(DipCostCommon *common) {
    begin(common, 2);
    add(&common->reports[0], 0, 2.0, 0.08);
    add(&common->reports[0], 1, 3.0, 0.06);
    add(&common->reports[0], 2, 4.5, 0.04);
    add(&common->reports[1], 2, 9.0, 0.02);
    add(&common->reports[1], 1, 6.0, 0.04);
    add(&common->reports[1], 0, 4.0, 0.06);
    assert_true(dip_cost_common_match(common, NULL));
}

static void the_report_that_limits_is_named(void **state) {
    (void)state;
    DipCostCommon common;
    DipCostCommonAdvice advice;
    make_three(&common);
    dip_cost_common_advise(&common, 5.0, &advice);
    assert_int_equal(advice.all.chosen, 0);
    expect_near(common.candidates.list[0].flip, 0.07, 1e-12);
    expect_near(dip_cost_common_candidate(&common, 0, 1).time.value, 4.0, 1e-12);
    assert_int_equal(advice.all.next, 1);
    assert_int_equal(common.candidates.list[1].report, 1);
    expect_near(advice.all.next_ms, 2.0, 1e-12); // 6 ms and 4 ms, both in the second report.
    assert_true(advice.all.next_fits < 0.001);
    assert_int_equal(advice.alone[0], dip_cost_common_row(&common, 2, 0));
    expect_near(dip_cost_common_share_lost(&common, &advice, 0), 0.08 / 0.04 - 1.0, 1e-12);
    expect_near(dip_cost_common_share_lost(&common, &advice, 1), 0.0, 1e-12);
    // Nothing is within 3 ms in both reports, but combination 0 is nearest to it.
    dip_cost_common_advise(&common, 3.0, &advice);
    assert_true(advice.all.chosen == -1 && advice.all.next == 0);
    assert_true(isnan(dip_cost_common_share_lost(&common, &advice, 0)));
    dip_cost_common_advise(&common, 10.0, &advice);
    assert_true(advice.all.chosen == 2 && advice.all.next == -1);
    // What may be within the budget in the second report fits with a probability between.
    set_time(&common.reports[1], dip_cost_common_row(&common, 1, 1), 5.1, 0.02);
    assert_true(dip_cost_common_match(&common, NULL));
    dip_cost_common_advise(&common, 5.0, &advice);
    assert_true(advice.all.chosen == 0 && advice.all.next == 1);
    assert_true(advice.all.next_fits > 0.1 && advice.all.next_fits < 0.4);
    dip_cost_common_free(&common);
}

// In the second report, combination 1 draws the same pictures as combination 0, whose row stands
// for both.
static void a_combination_may_be_the_row_of_another(void **state) {
    (void)state;
    DipCostCommon common;
    begin(&common, 2);
    add(&common.reports[0], 0, 2.0, 0.08);
    add(&common.reports[0], 1, 3.0, 0.06);
    const int row = add(&common.reports[1], 0, 4.0, 0.06);
    DipCostReport *second = &common.reports[1];
    free(second->same);
    second->same = calloc(1, sizeof *second->same);
    assert_non_null(second->same);
    second->same[0] = (DipCostSame){quality_of(1), row};
    second->same_count = 1;
    assert_true(dip_cost_common_match(&common, NULL));
    assert_int_equal(common.candidates.count, 2);
    DipCostCommonAdvice advice;
    dip_cost_common_advise(&common, 5.0, &advice);
    assert_int_equal(advice.all.chosen, 1);
    assert_int_equal(dip_cost_common_row(&common, 1, 1), row);
    expect_near(common.candidates.list[1].flip, 0.06, 1e-12);
    dip_cost_common_free(&common);
}

// --- refusing ------------------------------------------------------------------------------------

static void expect_refusal(DipCostCommon *common, DipErrorCode code, const char *name) {
    DipError err = {0};
    assert_false(dip_cost_common_match(common, &err));
    assert_int_equal(err.code, code);
    assert_string_equal(err.file, name);
    assert_int_equal(err.origin, code == DIP_ERROR_BUSY ? DIP_ORIGIN_RUNTIME : DIP_ORIGIN_INPUT);
    assert_null(strchr(err.message, '\n'));
    dip_cost_common_free(common);
}

static void make_pair(DipCostCommon *common) {
    begin(common, 2);
    add(&common->reports[0], 0, 2.0, 0.08);
    add(&common->reports[1], 0, 4.0, 0.06);
}

static void reports_that_cannot_be_used_are_named(void **state) {
    (void)state;
    DipCostCommon common;
    make_pair(&common);
    common.reports[1].verdict = DIP_COST_RED;
    expect_refusal(&common, DIP_ERROR_BUSY, "b.json");
    make_pair(&common);
    common.reports[1].rounds = 0;
    expect_refusal(&common, DIP_ERROR_MISSING, "b.json");
    make_pair(&common);
    common.reports[0].combined_first++;
    expect_refusal(&common, DIP_ERROR_MISSING, "a.json");
    make_pair(&common);
    strcpy(common.reports[1].build, "c");
    expect_refusal(&common, DIP_ERROR_CONFLICT, "b.json");
    make_pair(&common);
    common.reports[1].rows[common.reports[1].combined_first].quality = quality_of(7);
    expect_refusal(&common, DIP_ERROR_CONFLICT, "b.json");
}

// --- files and output ----------------------------------------------------------------------------

static char *print(const DipCostCommon *common, const DipCostCommonAdvice *advice, int count) {
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    dip_cost_common_print(common, advice, count, out);
    fclose(out);
    return text;
}

static void expect_text(const char *text, const char *part) {
    if (!strstr(text, part)) {
        fputs(text, stderr);
        fail_msg("\"%s\" is not in the text", part);
    }
}

static void the_table_names_everything(void **state) {
    (void)state;
    static const double budgets[4] = {10.0, 3.0, 5.0, 7.0};
    DipCostCommon common;
    DipCostCommonAdvice advice[4];
    make_three(&common);
    for (int i = 0; i < 4; i++) {
        dip_cost_common_advise(&common, budgets[i], &advice[i]);
    }
    char *text = print(&common, advice, 4);
    expect_text(text, "3 combinations of settings are in every report. Times are p95 times");
    expect_text(text,
                "\n\nWithin 5 ms a frame in every report:\ndefaults\n  Fits           with 100 "
                "%\n  Error          mean FLIP 0.0700\n");
    expect_text(text, "\n       1  2.00   1.99 to 2.01  0.0800  100.0  af=4\n");
    expect_text(text, "\n       2  4.00   3.98 to 4.02  0.0600    0.0  the same\n");
    expect_text(text, "Next better    af=2 (mean FLIP -28.6 %), for +2.00 ms in report 2, where it "
                      "takes longest; fits\n                 with 0 %");
    expect_text(text,
                "Within 3 ms a frame in every report:\nNo common combination surely fits. The "
                "fastest, defaults, takes 4.00 ms in report 2 and fits with\n0 %.");
    expect_text(text,
                "\n  low          3  nothing surely fits\n  medium       5  REQUESTED: aa=none,");
    expect_text(text, "\n  ultra       10  REQUESTED: aa=none,taa=off,aaa=off,asd=1,af=4,");
    free(text);
    dip_cost_common_free(&common);
}

// Reports that were written to files are read, matched and advised for, and the advice is written.
static void files_become_advice(void **state) {
    (void)state;
    static const char *const files[2] = {"common_a.json", "common_b.json"};
    DipCostCommon common;
    begin(&common, 2);
    for (int i = 0; i < 2; i++) {
        DipCostReport *report = &common.reports[i];
        add(report, 0, 2.0 + i, 0.08);
        add(report, 1, 3.0 + i, 0.06);
        assert_true(dip_cost_estimate_times(report, NULL));
        assert_true(dip_cost_write_json(report, files[i], NULL));
    }
    dip_cost_common_free(&common);
    DipError err = {0};
    DipCostCommonAdvice advice;
    assert_true(dip_cost_common_read(&common, files, 2, DIP_TIME_MEAN, &err));
    dip_cost_common_advise(&common, 5.0, &advice);
    assert_int_equal(advice.all.chosen, 1);
    expect_near(dip_cost_common_candidate(&common, 1, 1).time.value, 4.0, 1e-9);
    assert_true(dip_cost_common_write_json(&common, &advice, 1, "common.json", &err));
    char text[16384] = "";
    FILE *in = fopen("common.json", "rb");
    assert_non_null(in);
    assert_true(fread(text, 1, sizeof text - 1, in) > 0);
    fclose(in);
    expect_text(text, "\"budget_of\":\"mean\"");
    expect_text(text, "\"mean_flip\":0.0");
    expect_text(text, "\"name\":\"common_b.json\"");
    expect_text(text, "\"next_better\":null,\"next_ms\":null,");
    dip_cost_common_free(&common);
    remove(files[0]);
    assert_false(dip_cost_common_read(&common, files, 2, DIP_TIME_MEAN, &err));
    assert_string_equal(err.file, files[0]);
    dip_cost_common_free(&common);
    remove(files[1]);
    remove("common.json");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_common_choice_is_that_of_trying_all),
        cmocka_unit_test(advise_of_one_report_is_its_advice),
        cmocka_unit_test(the_report_that_limits_is_named),
        cmocka_unit_test(a_combination_may_be_the_row_of_another),
        cmocka_unit_test(reports_that_cannot_be_used_are_named),
        cmocka_unit_test(the_table_names_everything),
        cmocka_unit_test(files_become_advice),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
