// The linear fit of time to work, by the normal equations of least squares. A term is a kind of
// work; its price is the time for one unit. While a price is negative, the term with the most
// negative price is dropped, and the equations are solved again for the other terms.
#include "app/cost/fit.h"

#include <math.h>
#include <string.h>

enum { TERMS = 8 };

static const char *const names[TERMS] = {
    "frame",           "triangle in", "sub-block test per sample",
    "fragment shaded", "normal map",  "sky fragment",
    "texel fetched",   "clip test",
};

// The amounts of work in one frame of a row, in the order of `names`.
static void terms_of(const DipCostRow *row, double terms[TERMS]) {
    const double *c = row->counters;
    const double samples = dip_quality_sample_count(&row->quality);
    terms[0] = 1.0;
    terms[1] = c[DIP_COST_COUNTER_triangles_in];
    terms[2] = c[DIP_COST_COUNTER_sub_blocks_tested] * samples;
    terms[3] = c[DIP_COST_COUNTER_fragments_shaded];
    terms[4] = c[DIP_COST_COUNTER_fragments_normal_mapped];
    terms[5] = c[DIP_COST_COUNTER_fragments_sky];
    terms[6] = c[DIP_COST_COUNTER_texels_fetched];
    terms[7] = c[DIP_COST_COUNTER_fragments_clip_tested];
}

typedef struct Equations {
    double left[TERMS][TERMS];
    double right[TERMS];
} Equations;

// Solves for the used terms by Gaussian elimination with pivots. The other terms get the price 0. A
// term whose column depends linearly on other columns gets the price 0, too.
static void solve(const Equations *equations, const bool used[TERMS], double solution[TERMS]) {
    Equations e = *equations;
    int pivot_of[TERMS];
    bool taken[TERMS] = {false};
    for (int c = 0; c < TERMS; c++) {
        int pivot = -1;
        for (int r = 0; used[c] && r < TERMS; r++) {
            if (used[r] && !taken[r] &&
                (pivot < 0 || fabs(e.left[r][c]) > fabs(e.left[pivot][c]))) {
                pivot = r;
            }
        }
        pivot_of[c] = pivot >= 0 && fabs(e.left[pivot][c]) > 1e-9 ? pivot : -1;
        if (pivot_of[c] < 0) {
            continue;
        }
        taken[pivot] = true;
        for (int r = 0; r < TERMS; r++) {
            const double factor = r == pivot ? 0.0 : e.left[r][c] / e.left[pivot][c];
            for (int k = 0; k < TERMS; k++) {
                e.left[r][k] -= factor * e.left[pivot][k];
            }
            e.right[r] -= factor * e.right[pivot];
        }
    }
    for (int c = 0; c < TERMS; c++) {
        solution[c] = pivot_of[c] < 0 ? 0.0 : e.right[pivot_of[c]] / e.left[pivot_of[c]][c];
    }
}

static double fitted(const double terms[TERMS], const double solution[TERMS]) {
    double sum = 0.0;
    for (int i = 0; i < TERMS; i++) {
        sum += terms[i] * solution[i];
    }
    return sum;
}

// Adds a row to the normal equations. Terms are divided by their greatest values, which keeps the
// equations well conditioned. The fit minimises relative errors, so that slow rows have no
// more weight than fast rows.
static void add_row(Equations *equations, const double terms[TERMS], const double scale[TERMS],
                    double ms) {
    for (int i = 0; i < TERMS; i++) {
        for (int k = 0; k < TERMS; k++) {
            equations->left[i][k] += terms[i] / scale[i] * terms[k] / scale[k] / (ms * ms);
        }
        equations->right[i] += terms[i] / scale[i] / ms;
    }
}

static void judge_fit(const DipCostReport *report, const double *ms, const double solution[TERMS],
                      DipCostFit *fit) {
    // R2 compares the fit with a constant: the one time that fits all rows best. The errors of
    // both are relative errors.
    double sum = 0.0, weight = 0.0, all = 0.0, left = 0.0;
    double misses[DIP_COST_MAX_ROWS];
    for (int r = 0; r < report->row_count; r++) {
        sum += 1.0 / ms[r];
        weight += 1.0 / (ms[r] * ms[r]);
    }
    for (int r = 0; r < report->row_count; r++) {
        double terms[TERMS];
        terms_of(&report->rows[r], terms);
        const double miss = fitted(terms, solution) / ms[r] - 1.0;
        const double off = sum / weight / ms[r] - 1.0;
        all += off * off;
        left += miss * miss;
        misses[r] = fabs(miss);
    }
    fit->median_miss = dip_stats_median(misses, report->row_count);
    fit->r2 = all > 0.0 ? 1.0 - left / all : 0.0;
}

static void solve_without_negatives(const Equations *equations, double solution[TERMS]) {
    bool used[TERMS];
    memset(used, true, sizeof used);
    for (int tries = 0; tries < TERMS; tries++) {
        int worst = 0;
        solve(equations, used, solution);
        for (int i = 1; i < TERMS; i++) {
            worst = solution[i] < solution[worst] ? i : worst;
        }
        if (solution[worst] >= 0.0) {
            return;
        }
        used[worst] = false;
    }
}

DipCostFit dip_cost_fit(const DipCostReport *report) {
    DipCostFit fit = {.count = TERMS};
    Equations equations = {0};
    double scale[TERMS] = {0};
    double solution[TERMS] = {0};
    double ms[DIP_COST_MAX_ROWS];
    if (report->rounds == 0 || report->row_count < 2 * TERMS) {
        return (DipCostFit){0};
    }
    for (int r = 0; r < report->row_count; r++) {
        double terms[TERMS];
        terms_of(&report->rows[r], terms);
        ms[r] = dip_cost_ms(report, r);
        for (int i = 0; i < TERMS; i++) {
            scale[i] = fmax(scale[i], fmax(terms[i], 1e-30));
        }
    }
    for (int r = 0; r < report->row_count; r++) {
        double terms[TERMS];
        terms_of(&report->rows[r], terms);
        add_row(&equations, terms, scale, ms[r]);
    }
    solve_without_negatives(&equations, solution);
    for (int i = 0; i < TERMS; i++) {
        solution[i] /= scale[i];
        fit.names[i] = names[i];
        fit.ns[i] = 1e6 * solution[i];
    }
    fit.rows = report->row_count;
    judge_fit(report, ms, solution, &fit);
    return fit;
}
