// Finds by linear least squares how long each kind of work takes, and chooses which measurements
// tell most about this.
//
// A row is one measurement: the amounts of several kinds of work, which are called terms, and the
// time that they took together. A price is the time for one unit of a kind of work. Amounts and
// times may have any unit. All functions are thread-safe. They allocate no memory and use less than
// 128 KiB of stack. Equal input gives equal output to the bit.
#ifndef DIP_APP_MEASURE_STATS_LEAST_SQUARES_H
#define DIP_APP_MEASURE_STATS_LEAST_SQUARES_H

#include "renderer/base/api.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { DIP_LEAST_SQUARES_MAX_TERMS = 120 };

// The normal equations of a set of rows. Rows can be added and removed. A caller can thus predict
// each row from all others without adding up those others each time.
typedef struct DipNormalEquations {
    int terms;                                 // 1 to DIP_LEAST_SQUARES_MAX_TERMS.
    double scale[DIP_LEAST_SQUARES_MAX_TERMS]; // [term]: amounts are divided by this.
    double left[DIP_LEAST_SQUARES_MAX_TERMS][DIP_LEAST_SQUARES_MAX_TERMS];
    double right[DIP_LEAST_SQUARES_MAX_TERMS];
} DipNormalEquations;

// Starts equations without rows. `scale` holds the greatest amount of each term, so that the units
// of the terms do not matter. `scale` is 0 for a term that no row has.
DIP_API void dip_normal_equations_begin(DipNormalEquations *equations, int terms,
                                        const double *scale);

// Adds a row: `terms` amounts and the measured value. The row's squared error is multiplied by
// `weight`. A negative weight removes a row that was added with the same amounts and value and the
// opposite weight.
DIP_API void dip_normal_equations_add(DipNormalEquations *equations, const double *amounts,
                                      double value, double weight);

// Finds the prices >= 0 with the least sum of squared errors, sum_r weight (amounts . price -
// value)^2. Terms that no row has get the price 0. Of terms that depend linearly on each other, at
// least one gets the price 0. Method: active set on the normal equations (Lawson and Hanson 1974,
// Bro and de Jong 1997).
DIP_API void dip_least_squares_nonnegative(const DipNormalEquations *equations, double *prices);

// Chooses `count` of `rows` rows so that measuring them tells most about all prices. Adds one row
// after another, each time the row whose amounts the rows chosen so far explain least (a greedy
// D-optimal design, Fedorov 1972). The matrix has rows x terms amounts. On entry, `chosen` holds
// the indices of `given` rows, which stay chosen; on return, it holds all `count` indices. No row
// is chosen twice. 0 <= given <= count <= rows.
DIP_API void dip_design_choose(const double *matrix, int rows, int terms, int given, int count,
                               int *chosen);

#ifdef __cplusplus
}
#endif

#endif
