// Tests the Gaussian process against plain elimination, and what the model of FLIP learns.
#include "app/report/flip_model.h"
#include "renderer/catalogue/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// --- the process ---------------------------------------------------------------------------------

enum { KNOWN = 12 };

// Solves a x = b for the first `count` rows and columns, by elimination with pivots.
static void eliminate(double a[KNOWN][KNOWN], const double b[KNOWN], int count, double x[KNOWN]) {
    double left[KNOWN][KNOWN + 1];
    for (int i = 0; i < count; i++) {
        memcpy(left[i], a[i], sizeof a[i]);
        left[i][KNOWN] = b[i];
    }
    for (int c = 0; c < count; c++) {
        int pivot = c;
        for (int i = c; i < count; i++) {
            pivot = fabs(left[i][c]) > fabs(left[pivot][c]) ? i : pivot;
        }
        for (int k = 0; k <= KNOWN; k++) {
            const double swap = left[c][k];
            left[c][k] = left[pivot][k];
            left[pivot][k] = swap;
        }
        for (int i = 0; i < count; i++) {
            const double factor = i == c ? 0.0 : left[i][c] / left[c][c];
            for (int k = c; factor != 0.0 && k <= KNOWN; k++) { // NOLINT: 0 stands for itself.
                left[i][k] -= factor * left[c][k];
            }
        }
    }
    for (int i = 0; i < count; i++) {
        x[i] = left[i][KNOWN] / left[i][i];
    }
}

// log det(K) / 2 follows from the leading minors: each is the one before, divided by the last
// element of the inverse.
static double plain_likelihood(double covariance[KNOWN][KNOWN], const double values[KNOWN]) {
    double solved[KNOWN], squares = 0.0, logs = 0.0;
    eliminate(covariance, values, KNOWN, solved);
    for (int i = 0; i < KNOWN; i++) {
        double unit[KNOWN] = {0.0}, column[KNOWN];
        squares += values[i] * solved[i];
        unit[i] = 1.0;
        eliminate(covariance, unit, i + 1, column);
        logs -= log(column[i]);
    }
    return -0.5 * KNOWN * log(squares / KNOWN) - 0.5 * logs;
}

// Means, variances and what is missed when one value is left out are those of the formulas of
// Rasmussen and Williams 2006 (2.25, 2.26), with the whole matrix of covariances. So is the
// likelihood of a common variance (5.8), but for a constant.
static void the_process_equals_plain_elimination(void **state) {
    (void)state;
    const double common = 1.0, alike = 0.9, own = 0.01;
    DipCostProcess process;
    Random random = {5};
    int distances[KNOWN + 1][KNOWN + 1];
    double covariance[KNOWN][KNOWN], values[KNOWN], to_new[KNOWN], shares[KNOWN], misses[KNOWN];
    double weights[DIP_SETTING_COUNT] = {
        [DIP_SETTING_AA] = 1.0, [DIP_SETTING_AF] = 0.5, [DIP_SETTING_SHARPEN] = 4.0};
    DipQuality list[KNOWN + 1];
    for (int i = 0; i <= KNOWN; i++) {
        list[i] = dip_quality_default();
        list[i].step[DIP_SETTING_AA] = (uint8_t)(i % 5);
        list[i].step[DIP_SETTING_AF] = (uint8_t)(i / 5);
        list[i].step[DIP_SETTING_SHARPEN] = (uint8_t)(i % 3);
        for (int k = 0; k <= i; k++) {
            distances[i][k] = distances[k][i] = dip_cost_distance(&list[i], &list[k], ~0u, weights);
        }
    }
    assert_true(dip_cost_process_begin(&process, common, alike, own, KNOWN));
    for (int i = 0; i < KNOWN; i++) {
        values[i] = random_real(&random, -1.0, 1.0);
        for (int k = 0; k < KNOWN; k++) {
            covariance[i][k] = common + pow(alike, distances[i][k] / 8.0) + (i == k ? own : 0.0);
        }
        to_new[i] = common + pow(alike, distances[i][KNOWN] / 8.0);
        dip_cost_process_add(&process, distances[i]);
    }
    double solved[KNOWN], variance = common + 1.0;
    dip_cost_process_solve(&process, values, shares);
    eliminate(covariance, values, KNOWN, solved);
    for (int i = 0; i < KNOWN; i++) {
        assert_true(fabs(shares[i] - solved[i]) < 1e-7 * (1.0 + fabs(solved[i])));
    }
    eliminate(covariance, to_new, KNOWN, solved);
    for (int i = 0; i < KNOWN; i++) {
        variance -= to_new[i] * solved[i];
    }
    assert_true(fabs(dip_cost_process_variance(&process, distances[KNOWN]) - variance) < 1e-9);
    assert_true(fabs(dip_cost_process_likelihood(&process, values, shares) -
                     plain_likelihood(covariance, values)) < 1e-7);
    dip_cost_process_left_out(&process, shares, misses);
    for (int out = 0; out < KNOWN; out++) {
        double others[KNOWN][KNOWN] = {{0.0}}, their_values[KNOWN], miss = values[out];
        for (int i = 0; i < KNOWN - 1; i++) {
            const int from = i + (i >= out);
            their_values[i] = values[from];
            for (int k = 0; k < KNOWN - 1; k++) {
                others[i][k] = covariance[from][k + (k >= out)];
            }
        }
        eliminate(others, their_values, KNOWN - 1, solved);
        for (int i = 0; i < KNOWN - 1; i++) {
            miss -= covariance[out][i + (i >= out)] * solved[i];
        }
        assert_true(fabs(misses[out] - miss) < 1e-7 * (1.0 + fabs(miss)));
    }
    dip_cost_process_free(&process);
}

// --- the model of FLIP ---------------------------------------------------------------------------

enum { ROWS = 40 };

// FLIP that depends on antialiasing and filtering alone, by factors.
static double made_flip(const DipQuality *quality) {
    return 0.05 / (1.0 + 0.3 * quality->step[DIP_SETTING_AA]) /
           (1.0 + 0.1 * quality->step[DIP_SETTING_AF]);
}

static DipQuality random_settings(Random *random) {
    static const int settings[] = {DIP_SETTING_AA, DIP_SETTING_AF, DIP_SETTING_MIPLOD,
                                   DIP_SETTING_SHARPEN, DIP_SETTING_OPT};
    DipQuality quality = dip_quality_default();
    for (int i = 0; i < 5; i++) {
        const int count = dip_setting_info((DipSetting)settings[i])->step_count;
        quality.step[settings[i]] = (uint8_t)(random_u64(random) % (uint64_t)count);
    }
    return quality;
}

static void make_rows(DipCostReport *report, Random *random, int rows[ROWS]) {
    *report = (DipCostReport){.path_count = 1};
    report->options = (DipCostOptions){.baseline = dip_quality_default(), .places = 1};
    report->rows = calloc(DIP_COST_MAX_ROWS, sizeof *report->rows);
    assert_non_null(report->rows);
    assert_true(dip_cost_report_alloc(report, NULL));
    for (int i = 0; i < ROWS; i++) {
        const DipQuality quality = random_settings(random);
        rows[i] = dip_cost_report_add_row(report, &quality, 0, NULL);
        DipCostRow *row = &report->rows[rows[i]];
        row->judged[0] = true;
        row->viewpoints[0] = (DipMetricSums){.bursts = 1.0};
        row->viewpoints[0].regions[0].pixels = 1.0;
        row->viewpoints[0].regions[0].flip = made_flip(&quality);
    }
}

// Settings that change nothing get small weights, and so unseen combinations are predicted well.
static void the_model_learns_which_settings_matter(void **state) {
    (void)state;
    DipCostReport report;
    DipFlipModel model;
    Random random = {3};
    int rows[ROWS], distances[ROWS], close = 0;
    make_rows(&report, &random, rows);
    assert_true(dip_flip_model_fit(&report, rows, ROWS, 0, &model));
    assert_true(model.weights[DIP_SETTING_MIPLOD] <= 0.25);
    assert_true(model.weights[DIP_SETTING_SHARPEN] <= 0.25);
    assert_true(model.weights[DIP_SETTING_OPT] <= 0.25);
    assert_true(model.weights[DIP_SETTING_AA] >= 1.0);
    for (int i = 0; i < 200; i++) {
        const DipQuality unseen = random_settings(&random);
        dip_flip_model_distances(&model, &unseen, distances);
        const double miss = log(dip_flip_model_value(&model, distances) / made_flip(&unseen));
        assert_true(fabs(miss) < 0.1);
        close += fabs(miss) <= dip_flip_model_error(&model, distances);
        assert_true(dip_flip_model_error(&model, distances) <=
                    dip_flip_model_error_bound(&model, distances) + 1e-12);
    }
    assert_true(close > 150);
    dip_flip_model_free(&model);
    dip_cost_report_free(&report);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_process_equals_plain_elimination),
        cmocka_unit_test(the_model_learns_which_settings_matter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
