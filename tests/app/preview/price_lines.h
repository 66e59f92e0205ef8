// Questions about prices, and the answers, as lines of text for scripts.
#ifndef DIP_TESTS_APP_PREVIEW_PRICE_LINES_H
#define DIP_TESTS_APP_PREVIEW_PRICE_LINES_H

#include "app/preview/prices/prices.h"

// Answers a line that asks for one price with a line of JSON on standard output: "step KEY INDEX
// SETTINGS" for a step of a setting in a pane with these settings, or "sum SETTINGS". Returns false
// if the line asks for nothing.
bool dip_print_price(const DipPrices *prices, const char *line);

#endif
