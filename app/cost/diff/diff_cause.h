// Finds the likely cause of a slowdown: the kind of work with which the additional time grows.
#ifndef DIP_APP_COST_DIFF_DIFF_CAUSE_H
#define DIP_APP_COST_DIFF_DIFF_CAUSE_H

#include "renderer/base/error.h"

#include <stdbool.h>

// Additional times of some rows, and the work that may explain them. Arrays are borrowed.
typedef struct DipCauseData {
    int rows;
    int starts;
    int kinds;               // Kinds of work.
    const double *per_start; // [row * starts + start]: additional time; NAN: not known.
    const double *work;      // [kind * rows + row], at least 0.
} DipCauseData;

typedef struct DipCause {
    int kind;     // The kind of work that explains the additional times best; -1 if none is sure.
    double price; // Additional time per unit of this work.
    double share; // Share of the sum of squares of the additional times that it explains.
} DipCause;

// Fits the additional times y of the rows by y = price * work, for each kind of work by itself,
// with least squares, and takes the kind that leaves the least error. It is sure if it wins in 90 %
// of 200 bootstrap draws of the starts and explains 90 % of the sum of squares. Kinds of work that
// are proportional over the rows to within a few per cent (the cosine of their angle is above .999)
// cannot be told apart and count as the first of them. Fails with DIP_ERROR_MEMORY.
bool dip_cause_find(const DipCauseData *data, DipCause *cause, DipError *err);

// True if two kinds of work are proportional over the rows, so that they cannot be told apart.
bool dip_cause_is_same_work(const DipCauseData *data, int a, int b);

#endif
