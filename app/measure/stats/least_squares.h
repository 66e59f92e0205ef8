// Fits prices that are not negative by linear least squares, and chooses the rows to measure.
//
// A row is one measurement: the amounts of `terms` kinds of work (a row of the matrix) and the time
// that they took together. A price is the time for one unit of a kind of work. Amounts and times
// may have any unit. All functions are thread-safe and need no memory of their own beyond a few
// kilobytes of stack; equal input gives equal output to the bit.
#ifndef DIP_APP_MEASURE_STATS_LEAST_SQUARES_H
#define DIP_APP_MEASURE_STATS_LEAST_SQUARES_H

#include "renderer/base/api.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { DIP_LEAST_SQUARES_MAX_TERMS = 64 };

// The normal equations of a set of rows. Rows can be added and taken away again, so that every row
// can be predicted from all others without adding them up anew.
typedef struct DipNormalEquations {
    int terms;                                 // 1 to DIP_LEAST_SQUARES_MAX_TERMS.
    double scale[DIP_LEAST_SQUARES_MAX_TERMS]; // Amounts are divided by these; see _begin.
    double left[DIP_LEAST_SQUARES_MAX_TERMS][DIP_LEAST_SQUARES_MAX_TERMS];
    double right[DIP_LEAST_SQUARES_MAX_TERMS];
} DipNormalEquations;

// Starts equations without rows. `scale` has the greatest amount of each term, so that terms of any
// unit are treated alike; a scale of 0 stands for a term that no row has.
DIP_API void dip_normal_equations_begin(DipNormalEquations *equations, int terms,
                                        const double *scale);

// Adds a row, `weight` times: its squared error counts that often. A negative weight takes a row
// away that was added with the same amounts and value.
DIP_API void dip_normal_equations_add(DipNormalEquations *equations, const double *amounts,
                                      double value, double weight);

// Finds the prices >= 0 with the least sum of squared errors, sum_r weight (amounts . price -
// value)^2. Terms that no row has, and terms that depend linearly on others, get the price 0.
// Method: active set on the normal equations (Lawson and Hanson 1974, Bro and de Jong 1997).
DIP_API void dip_least_squares_nonnegative(const DipNormalEquations *equations, double *prices);

// The same without the bound on the sign, with `ridge` added to the diagonal of the scaled
// equations (ridge regression, Hoerl and Kennard 1970). The ridge must be positive if there are
// fewer rows than terms.
DIP_API void dip_least_squares_ridge(const DipNormalEquations *equations, double ridge,
                                     double *solution);

// Chooses `count` of `rows` rows so that measuring them tells most about all prices: greedily, each
// time the row whose amounts the rows chosen so far explain least (a D-optimal design, Fedorov
// 1972). The matrix has rows x terms amounts. `chosen` holds the indices of the first `given` rows
// on entry, which are kept, and all `count` on return; no row is chosen twice.
// 0 <= given <= count <= rows.
DIP_API void dip_design_choose(const double *matrix, int rows, int terms, int given, int count,
                               int *chosen);

#ifdef __cplusplus
}
#endif

#endif
