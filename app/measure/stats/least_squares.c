// Solves normal equations, finds prices that are not negative, and chooses D-optimal designs.
#include "app/measure/stats/least_squares.h"

#include "renderer/base/assert.h"
#include "renderer/base/fp_mode.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { MAX = DIP_LEAST_SQUARES_MAX_TERMS };

// A term counts as linearly dependent on the terms before it if at most this share of its squared
// length is left after the projection onto them is subtracted.
static const double dependent = 1e-10;

void dip_normal_equations_begin(DipNormalEquations *equations, int terms, const double *scale) {
    DIP_ASSERT(terms > 0 && terms <= MAX);
    memset(equations, 0, sizeof *equations);
    equations->terms = terms;
    memcpy(equations->scale, scale, (size_t)terms * sizeof *scale);
}

static double scaled(double amount, double scale) {
    return scale > 0.0 ? amount / scale : 0.0;
}

void dip_normal_equations_add(DipNormalEquations *equations, const double *amounts, double value,
                              double weight) {
    DIP_FP_MODE_SCOPE();
    DIP_FP_PIN(value);
    DIP_FP_PIN(weight);
    for (int i = 0; i < equations->terms; i++) {
        const double a = weight * scaled(amounts[i], equations->scale[i]);
        for (int k = 0; k < equations->terms; k++) {
            equations->left[i][k] += a * scaled(amounts[k], equations->scale[k]);
        }
        equations->right[i] += a * value;
    }
}

// Solves the equations for the terms that are used, by Cholesky decomposition. All other terms get
// 0, as do terms that depend on terms before them.
static void solve(const DipNormalEquations *equations, const bool *used, double *solution) {
    double lower[MAX][MAX];
    int index[MAX];
    int count = 0;
    for (int term = 0; term < equations->terms; term++) {
        double *row = lower[count];
        const double whole = equations->left[term][term];
        double rest = whole;
        for (int k = 0; used[term] && k < count; k++) {
            double sum = equations->left[term][index[k]];
            for (int j = 0; j < k; j++) {
                sum -= row[j] * lower[k][j];
            }
            row[k] = sum / lower[k][k];
            rest -= row[k] * row[k];
        }
        if (used[term] && rest > dependent * whole && whole > 0.0) {
            row[count] = sqrt(rest);
            index[count++] = term;
        }
    }
    double y[MAX];
    for (int i = 0; i < count; i++) {
        y[i] = equations->right[index[i]];
        for (int k = 0; k < i; k++) {
            y[i] -= lower[i][k] * y[k];
        }
        y[i] /= lower[i][i];
    }
    memset(solution, 0, (size_t)equations->terms * sizeof *solution);
    for (int i = count; i-- > 0;) {
        for (int k = i + 1; k < count; k++) {
            y[i] -= lower[k][i] * y[k];
        }
        y[i] /= lower[i][i];
        solution[index[i]] = y[i];
    }
}

static void unscale(const DipNormalEquations *equations, double *solution) {
    for (int i = 0; i < equations->terms; i++) {
        solution[i] = scaled(solution[i], equations->scale[i]);
    }
}

// Returns the unused term whose price reduces the error most steeply as it rises from 0. Returns -1
// if there is none.
static int steepest_term(const DipNormalEquations *equations, const bool *used, const bool *failed,
                         const double *prices) {
    int best = -1;
    double steepest = 0.0;
    for (int i = 0; i < equations->terms; i++) {
        double slope = equations->right[i];
        double size = fabs(slope);
        for (int k = 0; k < equations->terms; k++) {
            slope -= equations->left[i][k] * prices[k];
            size += fabs(equations->left[i][k] * prices[k]);
        }
        if (!used[i] && !failed[i] && slope > 1e-12 * size && slope > steepest) {
            steepest = slope;
            best = i;
        }
    }
    return best;
}

// Moves the prices towards the solution until the first price reaches 0. Terms whose price reaches
// 0 become unused. Returns true if the prices reached the solution.
static bool move(int terms, bool *used, const double *solution, double *prices) {
    double way = 1.0;
    for (int i = 0; i < terms; i++) {
        if (used[i] && solution[i] <= 0.0) {
            way = fmin(way, prices[i] / (prices[i] - solution[i]));
        }
    }
    bool whole = true;
    for (int i = 0; i < terms; i++) {
        const bool blocks =
            used[i] && solution[i] <= 0.0 && prices[i] / (prices[i] - solution[i]) <= way;
        prices[i] = used[i] && !blocks ? prices[i] + way * (solution[i] - prices[i]) : 0.0;
        used[i] = used[i] && !blocks;
        whole &= !blocks;
    }
    return whole;
}

void dip_least_squares_nonnegative(const DipNormalEquations *equations, double *prices) {
    DIP_FP_MODE_SCOPE();
    const int terms = equations->terms;
    bool used[MAX] = {false};
    bool failed[MAX] = {false}; // Terms whose slope was only rounding error: their price is 0.
    double solution[MAX];
    memset(prices, 0, (size_t)terms * sizeof *prices);
    for (int round = 0; round < 10 * terms; round++) {
        const int next = steepest_term(equations, used, failed, prices);
        if (next < 0) {
            break;
        }
        used[next] = true;
        solve(equations, used, solution);
        if (solution[next] <= 0.0) {
            used[next] = false;
            failed[next] = true;
            continue;
        }
        memset(failed, 0, sizeof failed);
        while (!move(terms, used, solution, prices)) {
            solve(equations, used, solution);
        }
    }
    unscale(equations, prices);
}

// --- designs -----------------------------------------------------------------------------------

typedef struct Design {
    const double *matrix;
    int rows, terms;
    double scale[MAX];
    double inverse[MAX][MAX]; // Inverse of the information matrix of the chosen rows.
} Design;

static void read_row(const Design *design, int row, double amounts[MAX]) {
    for (int i = 0; i < design->terms; i++) {
        amounts[i] = scaled(design->matrix[(size_t)row * (size_t)design->terms + (size_t)i],
                            design->scale[i]);
    }
}

static void multiply(const Design *design, const double *amounts, double product[MAX]) {
    for (int i = 0; i < design->terms; i++) {
        product[i] = 0.0;
        for (int k = 0; k < design->terms; k++) {
            product[i] += design->inverse[i][k] * amounts[k];
        }
    }
}

static double dot(const double *a, const double *b, int count) {
    double sum = 0.0;
    for (int i = 0; i < count; i++) {
        sum += a[i] * b[i];
    }
    return sum;
}

// Adds a row to the inverse, by the formula of Sherman and Morrison.
static void add_information(Design *design, int row) {
    double amounts[MAX], product[MAX];
    read_row(design, row, amounts);
    multiply(design, amounts, product);
    const double divisor = 1.0 + dot(amounts, product, design->terms);
    for (int i = 0; i < design->terms; i++) {
        for (int k = 0; k < design->terms; k++) {
            design->inverse[i][k] -= product[i] * product[k] / divisor;
        }
    }
}

static bool is_chosen(const int *chosen, int count, int row) {
    for (int i = 0; i < count; i++) {
        if (chosen[i] == row) {
            return true;
        }
    }
    return false;
}

static int most_unexplained(const Design *design, const int *chosen, int count) {
    int best = -1;
    double most = -1.0;
    for (int row = 0; row < design->rows; row++) {
        double amounts[MAX], product[MAX];
        if (is_chosen(chosen, count, row)) {
            continue;
        }
        read_row(design, row, amounts);
        multiply(design, amounts, product);
        const double unexplained = dot(amounts, product, design->terms);
        if (unexplained > most) {
            most = unexplained;
            best = row;
        }
    }
    return best;
}

void dip_design_choose(const double *matrix, int rows, int terms, int given, int count,
                       int *chosen) {
    DIP_FP_MODE_SCOPE();
    DIP_ASSERT(terms > 0 && terms <= MAX && 0 <= given && given <= count && count <= rows);
    Design design = {.matrix = matrix, .rows = rows, .terms = terms};
    for (int r = 0; r < rows; r++) {
        for (int i = 0; i < terms; i++) {
            design.scale[i] =
                fmax(design.scale[i], fabs(matrix[(size_t)r * (size_t)terms + (size_t)i]));
        }
    }
    for (int i = 0; i < terms; i++) {
        // Before the first row, the design has almost no information.
        design.inverse[i][i] = 1000.0;
    }
    for (int i = 0; i < count; i++) {
        if (i >= given) {
            chosen[i] = most_unexplained(&design, chosen, i);
        }
        add_information(&design, chosen[i]);
    }
}
