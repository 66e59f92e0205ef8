// Writes numbers, time budgets and probabilities for people, in a terminal, in a page or in the
// preview's panel.
#ifndef DIP_APP_REPORT_WORDS_H
#define DIP_APP_REPORT_WORDS_H

#include <stdbool.h>

enum { DIP_NUMBER_BYTES = 24, DIP_BUDGET_BYTES = 64 };

// Writes a value with this number of decimals. If `change` is true, positive values have a sign,
// too. A value that rounds to 0 has no sign, so "-0" never shows. `minus` is the sign of negative
// values: "-", or U+2212 for the panel. Values beyond 9,999,999 are cut to that number.
void dip_number_text(double value, int decimals, bool change, const char *minus,
                     char text[DIP_NUMBER_BYTES]);

// Values that rounding must not cross, such as the time budgets of a report.
typedef struct DipLimits {
    const double *values;
    int count;
    bool doubtful; // The values beside these limits come from a machine that was too busy.
} DipLimits;

// Writes a value as dip_number_text does, but with more decimals, up to three, if rounding would
// carry it over a limit ("16.66" rather than "16.7" beside 16.667). A doubtful value has one
// significant digit and a question mark instead: "8?", "70?". It gets more digits, too, if a limit
// needs them ("15?" rather than "10?" beside a limit of 12).
void dip_limited_number(double value, int decimals, bool change, DipLimits limits,
                        const char *minus, char text[DIP_NUMBER_BYTES]);

// Writes a time with one decimal as dip_limited_number does, beside one limit, such as the budget
// of a frame: "8.4", or "8?" if it is doubtful. If there is no limit, `limit_ms` is INFINITY.
void dip_ms_number(double ms, bool doubtful, double limit_ms, const char *minus,
                   char text[DIP_NUMBER_BYTES]);

// Writes a ratio of two times with two decimals: "1.56", or "2?" if the times are doubtful.
void dip_ratio_number(double ratio, bool doubtful, char text[DIP_NUMBER_BYTES]);

// Writes a FLIP error, or a change of FLIP, with four decimals and without the zero before the
// point: ".0354", "+.0010".
void dip_flip_number(double flip, bool change, const char *minus, char text[DIP_NUMBER_BYTES]);

// Writes a time budget in up to three significant digits: "16.7", "8", "33.3". From 1000 ms on,
// writes it in whole milliseconds.
void dip_budget_ms_text(double budget_ms, char text[DIP_NUMBER_BYTES]);

// Writes a time budget as the start of a sentence: "At 60 frames a second (16.7 ms)" for usual
// frame rates such as 24, 60 and 144 frames a second, otherwise "Within 8 ms a frame".
void dip_budget_text(double budget_ms, char text[DIP_BUDGET_BYTES]);

// Writes the probability that something fits a budget: "99 %", or "unknown" for NAN. Writes 100 %
// only for 99.95 % and more, and 0 % only for 0.05 % and less.
void dip_fits_text(double fits, char text[DIP_NUMBER_BYTES]);

#endif
