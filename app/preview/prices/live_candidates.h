// What can be chosen from prices that are measured live: combinations of settings whose whole time
// and error are known as sums of prices (dip_prices_sum).
//
// Times and errors of several settings are not exactly the sums of their prices: adaptive
// antialiasing, for example, gains most where antialiasing has gained already. So what is chosen is
// a first guess for the view that was measured. A cost report measures combinations along whole
// paths.
#ifndef DIP_APP_PREVIEW_PRICES_LIVE_CANDIDATES_H
#define DIP_APP_PREVIEW_PRICES_LIVE_CANDIDATES_H

#include "app/preview/prices/prices.h"
#include "app/report/choice.h"

typedef enum DipLiveKnown {
    DIP_LIVE_NO_TIMES,  // Times of some steps are not known yet.
    DIP_LIVE_NO_ERRORS, // The times are known, but not all errors.
    DIP_LIVE_KNOWN
} DipLiveKnown;

// Lists the combinations of aa, aaa, af, aaf, opt and miplod whose prices are known; the other
// settings are those of the base. Waits until all steps are known that the combination `like` could
// take, since settings that need others, such as adaptive AA, are priced beside them. The caller
// frees candidates->list, which is NULL unless the result is DIP_LIVE_KNOWN. Takes some
// milliseconds. Running out of memory leaves the times unknown.
DipLiveKnown dip_live_candidates(const DipPrices *prices, const DipQuality *like,
                                 DipCandidates *candidates);

#endif
