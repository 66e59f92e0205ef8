// Advice for a time budget from rough prices: the prices of single steps, added up.
//
// Times and errors of several settings are not exactly the sums of their prices: adaptive
// antialiasing, for example, gains most where antialiasing has gained already. So the advice is a
// first guess for the view that was measured. A cost report measures combinations along whole
// paths.
#ifndef DIP_APP_PREVIEW_PRICES_ROUGH_ADVICE_H
#define DIP_APP_PREVIEW_PRICES_ROUGH_ADVICE_H

#include "app/preview/prices/prices.h"

typedef enum DipRoughAdviceState {
    DIP_ROUGH_ADVICE_NO_TIMES,  // Times of some steps are not known yet.
    DIP_ROUGH_ADVICE_NO_ERRORS, // The times are known, but not all errors.
    DIP_ROUGH_ADVICE_TOO_SLOW,  // Even the fastest combination takes longer than the budget.
    DIP_ROUGH_ADVICE_FOUND
} DipRoughAdviceState;

typedef struct DipRoughAdvice {
    DipRoughAdviceState state;
    DipQuality quality; // If found; if too slow, the fastest combination.
    double ms;          // Its sum of times.
    double flip;        // Its sum of errors, at least 0.
    double base_flip;   // The error of the base.
} DipRoughAdvice;

// Finds the combination of aa, aaa, af, aaf, opt and miplod with the least error whose time is
// within the budget; of combinations whose errors differ by less than 1 %, the fastest. The other
// settings are those of the base. Settings that need others, such as adaptive AA, are considered
// only if the combination `like` has what they need, because they are priced beside it. Takes
// about a tenth of a millisecond.
DipRoughAdvice dip_rough_advice(const DipPrices *prices, const DipQuality *like, double budget_ms);

#endif
