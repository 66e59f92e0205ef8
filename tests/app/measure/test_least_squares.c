// Tests least squares against known prices and against the conditions that every least sum of
// squares meets (Karush, Kuhn and Tucker), computed in a wider type; tests designs against the
// determinant of the information that they give.
#include "app/measure/stats/least_squares.h"
#include "renderer/catalogue/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { ROWS = 40, TERMS = 12 };

typedef struct Problem {
    double amounts[ROWS][TERMS];
    double values[ROWS];
    double scale[TERMS];
    int rows;
} Problem;

// Amounts of very different size, as counters have: ten triangles and ten million texels.
static void make_problem(Problem *problem, Random *random, int rows) {
    memset(problem, 0, sizeof *problem);
    problem->rows = rows;
    for (int r = 0; r < rows; r++) {
        for (int t = 0; t < TERMS; t++) {
            problem->amounts[r][t] = pow(10.0, t % 6) * random_real(random, 0.0, 1.0);
            problem->scale[t] = fmax(problem->scale[t], problem->amounts[r][t]);
        }
        problem->values[r] = random_real(random, 1.0, 2.0);
    }
}

static void add_all(const Problem *problem, DipNormalEquations *equations) {
    dip_normal_equations_begin(equations, TERMS, problem->scale);
    for (int r = 0; r < problem->rows; r++) {
        dip_normal_equations_add(equations, problem->amounts[r], problem->values[r], 1.0);
    }
}

static void known_prices_are_found(void **state) {
    (void)state;
    Random random = {1};
    for (int round = 0; round < 200; round++) {
        Problem problem;
        DipNormalEquations equations;
        double known[TERMS], prices[TERMS];
        make_problem(&problem, &random, ROWS);
        for (int t = 0; t < TERMS; t++) {
            known[t] = t % 3 ? random_real(&random, 0.5, 2.0) / pow(10.0, t % 6) : 0.0;
        }
        for (int r = 0; r < ROWS; r++) {
            problem.values[r] = 0.0;
            for (int t = 0; t < TERMS; t++) {
                problem.values[r] += known[t] * problem.amounts[r][t];
            }
        }
        add_all(&problem, &equations);
        dip_least_squares_nonnegative(&equations, prices);
        for (int t = 0; t < TERMS; t++) {
            assert_true(fabs(prices[t] - known[t]) * problem.scale[t] < 1e-9);
        }
    }
}

// At the least sum of squares no price is negative, no price above 0 has a slope, and no price at 0
// has a slope that would lessen the sum. Only the least sum meets all three.
static void random_problems_end_at_the_least_sum(void **state) {
    (void)state;
    Random random = {2};
    int at_zero = 0;
    for (int round = 0; round < 500; round++) {
        Problem problem;
        DipNormalEquations equations;
        double prices[TERMS];
        make_problem(&problem, &random, round % 2 ? ROWS : TERMS / 2);
        add_all(&problem, &equations);
        dip_least_squares_nonnegative(&equations, prices);
        for (int t = 0; t < TERMS; t++) {
            long double slope = 0.0L;
            for (int r = 0; r < problem.rows; r++) {
                long double left = problem.values[r];
                for (int k = 0; k < TERMS; k++) {
                    left -= (long double)prices[k] * problem.amounts[r][k];
                }
                slope += left * problem.amounts[r][t] / problem.scale[t];
            }
            assert_true(prices[t] >= 0.0);
            assert_true(slope < 1e-7L);
            assert_true(prices[t] == 0.0 || slope > -1e-7L);
            at_zero += prices[t] == 0.0;
        }
    }
    assert_true(at_zero > 500); // The bound on the sign was needed.
}

static void a_row_taken_away_leaves_the_equations_of_the_others(void **state) {
    (void)state;
    Random random = {3};
    Problem problem;
    DipNormalEquations all, others;
    double a[TERMS], b[TERMS];
    make_problem(&problem, &random, ROWS);
    add_all(&problem, &all);
    dip_normal_equations_add(&all, problem.amounts[7], problem.values[7], -1.0);
    dip_normal_equations_begin(&others, TERMS, problem.scale);
    for (int r = 0; r < ROWS; r++) {
        dip_normal_equations_add(&others, problem.amounts[r], problem.values[r], r != 7);
    }
    dip_least_squares_nonnegative(&all, a);
    dip_least_squares_nonnegative(&others, b);
    for (int t = 0; t < TERMS; t++) {
        assert_true(fabs(a[t] - b[t]) * problem.scale[t] < 1e-9);
    }
}

// Equal amounts in two terms, and a term that no row has.
static void terms_that_cannot_be_told_apart_share_a_price(void **state) {
    (void)state;
    const double amounts[4][3] = {{1, 1, 0}, {2, 2, 0}, {3, 3, 0}, {5, 5, 0}};
    const double scale[3] = {5, 5, 0};
    DipNormalEquations equations;
    double prices[3];
    dip_normal_equations_begin(&equations, 3, scale);
    for (int r = 0; r < 4; r++) {
        dip_normal_equations_add(&equations, amounts[r], 2.5 * amounts[r][0], 1.0);
    }
    dip_least_squares_nonnegative(&equations, prices);
    assert_true(fabs(prices[0] + prices[1] - 2.5) < 1e-12);
    assert_true(prices[2] == 0.0);
}

// The third term is a quarter of the first two but for a millionth, which counts as the same: its
// price stays 0, although a little of the error is left for it. The fourth term, whose slope is
// flatter, still gets its price.
static void a_term_that_nearly_depends_on_others_costs_nothing(void **state) {
    (void)state;
    const double amounts[4][4] = {
        {1, 0, 0.25, 0}, {0, 1, 0.25, 0}, {0, 0, 1e-6, 0}, {0, 0, 0, 1e-7}};
    const double scale[4] = {1, 1, 1, 1};
    const double expected[4] = {1, 1, 0, 1e7};
    DipNormalEquations equations;
    double prices[4];
    dip_normal_equations_begin(&equations, 4, scale);
    for (int r = 0; r < 4; r++) {
        dip_normal_equations_add(&equations, amounts[r], 1.0, 1.0);
    }
    dip_least_squares_nonnegative(&equations, prices);
    for (int t = 0; t < 4; t++) {
        assert_true(fabs(prices[t] - expected[t]) <= 1e-9 * expected[t]);
    }
}

// Determinant of the information matrix of some rows, by elimination in a wider type.
static long double information(const Problem *problem, const int *chosen, int count, int terms) {
    long double m[TERMS][TERMS] = {{0}};
    for (int i = 0; i < count; i++) {
        for (int a = 0; a < terms; a++) {
            for (int b = 0; b < terms; b++) {
                m[a][b] += (long double)problem->amounts[chosen[i]][a] / problem->scale[a] *
                           problem->amounts[chosen[i]][b] / problem->scale[b];
            }
        }
    }
    long double determinant = 1.0L;
    for (int c = 0; c < terms; c++) {
        determinant *= m[c][c];
        for (int r = c + 1; r < terms; r++) {
            const long double factor = m[r][c] / m[c][c];
            for (int k = c; k < terms; k++) {
                m[r][k] -= factor * m[c][k];
            }
        }
    }
    return determinant;
}

static void a_design_tells_more_than_random_rows(void **state) {
    (void)state;
    enum { CHOSEN = 16 };
    Random random = {4};
    int better = 0;
    for (int round = 0; round < 100; round++) {
        Problem problem;
        int chosen[CHOSEN] = {5, 6};
        int other[CHOSEN];
        make_problem(&problem, &random, ROWS);
        dip_design_choose(&problem.amounts[0][0], ROWS, TERMS, 2, CHOSEN, chosen);
        assert_int_equal(chosen[0], 5);
        assert_int_equal(chosen[1], 6);
        // What lies behind the given rows says nothing.
        int again[CHOSEN];
        memcpy(again, chosen, sizeof again);
        dip_design_choose(&problem.amounts[0][0], ROWS, TERMS, 2, CHOSEN, again);
        assert_memory_equal(again, chosen, sizeof again);
        bool seen[ROWS] = {false};
        for (int i = 0; i < CHOSEN; i++) {
            assert_true(chosen[i] >= 0 && chosen[i] < ROWS && !seen[chosen[i]]);
            seen[chosen[i]] = true;
            other[i] = (i * 7 + round) % ROWS;
        }
        better += information(&problem, chosen, CHOSEN, TERMS) >
                  4.0L * information(&problem, other, CHOSEN, TERMS);
    }
    assert_true(better >= 98);
}

// Copies values to memory of exactly their size, so that the address sanitizer sees each read
// beyond them.
static double *exact_copy(const double *values, int count) {
    double *copy = malloc((size_t)count * sizeof *copy);
    assert_non_null(copy);
    memcpy(copy, values, (size_t)count * sizeof *copy);
    return copy;
}

// Each row of a diagonal problem has one term, whose price is the row's value / its amount, or 0 if
// the value is negative. The element behind the prices and the one behind the chosen rows keep
// their values. The greatest number of terms fills all arrays of the functions.
static void nothing_beyond_the_terms_is_touched(void **state) {
    (void)state;
    enum { MOST = DIP_LEAST_SQUARES_MAX_TERMS };
    static const int sizes[] = {1, 2, 7, MOST};
    static DipNormalEquations equations;
    static double matrix[MOST * MOST];
    for (size_t size = 0; size < sizeof sizes / sizeof *sizes; size++) {
        const int terms = sizes[size];
        double scale[MOST], prices[MOST + 1];
        int chosen[MOST + 1];
        memset(matrix, 0, sizeof matrix);
        for (int t = 0; t < terms; t++) {
            scale[t] = matrix[t * terms + t] = 1.0 + t;
        }
        double *exact_scale = exact_copy(scale, terms);
        dip_normal_equations_begin(&equations, terms, exact_scale);
        free(exact_scale);
        for (int t = 0; t < terms; t++) {
            double *row = exact_copy(matrix + t * terms, terms);
            dip_normal_equations_add(&equations, row, t % 3 == 2 ? -5.0 : 4.0 * (1.0 + t), 1.0);
            free(row);
        }
        prices[terms] = 77.0;
        dip_least_squares_nonnegative(&equations, prices);
        for (int t = 0; t < terms; t++) {
            assert_true(fabs(prices[t] - (t % 3 == 2 ? 0.0 : 4.0)) < 1e-12);
        }
        assert_true(prices[terms] == 77.0);
        for (int count = 0; count <= terms; count += count < 2 || terms < 4 ? 1 : terms - 2) {
            double *rows = exact_copy(matrix, terms * terms);
            chosen[count] = 77;
            dip_design_choose(rows, terms, terms, 0, count, chosen);
            free(rows);
            // All rows tell equally much, so the first ones are chosen.
            for (int i = 0; i < count; i++) {
                assert_int_equal(chosen[i], i);
            }
            assert_int_equal(chosen[count], 77);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(known_prices_are_found),
        cmocka_unit_test(random_problems_end_at_the_least_sum),
        cmocka_unit_test(a_row_taken_away_leaves_the_equations_of_the_others),
        cmocka_unit_test(terms_that_cannot_be_told_apart_share_a_price),
        cmocka_unit_test(a_term_that_nearly_depends_on_others_costs_nothing),
        cmocka_unit_test(a_design_tells_more_than_random_rows),
        cmocka_unit_test(nothing_beyond_the_terms_is_touched),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
