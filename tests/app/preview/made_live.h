// A live report with made-up times, for tests.
#ifndef DIP_TESTS_APP_PREVIEW_MADE_LIVE_H
#define DIP_TESTS_APP_PREVIEW_MADE_LIVE_H

#include "app/preview/prices/prices.h"

// Gives a combination a time and an error in the live report, in place of those that it has. Its
// times in four rounds deviate from ms by up to `noise`, as a logarithm. flip below 0: unknown. The
// base comes first, since the others are timed beside it.
void dip_made_live(DipPrices *prices, const char *settings, double ms, double noise, double flip);

#endif
