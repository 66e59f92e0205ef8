// Formats numbers, budgets and probabilities.
#include "app/report/words.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void dip_number_text(double value, int decimals, bool change, const char *minus,
                     char text[DIP_NUMBER_BYTES]) {
    char digits[DIP_NUMBER_BYTES];
    const double most = 9999999.0;
    snprintf(digits, sizeof digits, "%.*f", decimals < 9 ? decimals : 9, fmin(fabs(value), most));
    const bool is_zero = strspn(digits, "0.") == strlen(digits);
    const char *sign = is_zero ? "" : value < 0.0 ? minus : change ? "+" : "";
    snprintf(text, DIP_NUMBER_BYTES, "%.4s%.19s", sign, digits);
}

// Returns whether a rounded value lies on the same side of a limit as the value itself.
static bool keeps_side(double rounded, double value, double limit) {
    return (rounded > limit) == (value > limit);
}

// Returns the value rounded to this number of decimals. The result is the double that one gets by
// writing the rounded value and reading it again. If `decimals` is negative, that many digits
// before the point become 0.
static double round_to(double value, int decimals) {
    const double power = pow(10.0, abs(decimals));
    return decimals < 0 ? power * round(value / power) : round(value * power) / power;
}

void dip_limited_number(double value, int decimals, bool change, DipLimits limits,
                        const char *minus, char text[DIP_NUMBER_BYTES]) {
    enum { MOST_DECIMALS = 3 };
    const double size = fabs(value);
    if (limits.doubtful) {
        decimals = size < 0.05 ? 0 : -(int)floor(log10(fmin(fmax(size, 0.1), 1e9)));
    }
    for (int i = 0; i < limits.count; i++) {
        while (decimals < MOST_DECIMALS &&
               !keeps_side(round_to(value, decimals), value, limits.values[i])) {
            decimals++;
        }
    }
    dip_number_text(round_to(value, decimals), decimals > 0 ? decimals : 0, change, minus, text);
    if (limits.doubtful) {
        strcat(text, "?");
    }
}

void dip_ms_number(double ms, bool doubtful, double limit_ms, const char *minus,
                   char text[DIP_NUMBER_BYTES]) {
    dip_limited_number(ms, 1, false, (DipLimits){&limit_ms, 1, doubtful}, minus, text);
}

void dip_ratio_number(double ratio, bool doubtful, char text[DIP_NUMBER_BYTES]) {
    dip_limited_number(ratio, 2, false, (DipLimits){.doubtful = doubtful}, "-", text);
}

void dip_flip_number(double flip, bool change, const char *minus, char text[DIP_NUMBER_BYTES]) {
    dip_number_text(flip, 4, change, minus, text);
    char *zero = strstr(text, "0.");
    if (zero && (zero == text || !strchr("0123456789", zero[-1]))) {
        memmove(zero, zero + 1, strlen(zero));
    }
}

void dip_budget_ms_text(double budget_ms, char text[DIP_NUMBER_BYTES]) {
    if (budget_ms < 999.5) { // From there on, three digits would be written with an exponent.
        snprintf(text, DIP_NUMBER_BYTES, "%.3g", budget_ms);
    } else {
        snprintf(text, DIP_NUMBER_BYTES, "%.0f", budget_ms);
    }
}

void dip_budget_text(double budget_ms, char text[DIP_BUDGET_BYTES]) {
    static const int rates_hz[] = {24, 25, 30, 48, 50, 60, 72, 75, 90, 100, 120, 144, 165, 240};
    char ms[DIP_NUMBER_BYTES];
    dip_budget_ms_text(budget_ms, ms);
    for (size_t i = 0; i < sizeof rates_hz / sizeof *rates_hz; i++) {
        if (fabs(1000.0 / budget_ms / rates_hz[i] - 1.0) < 0.003) { // 16.7 ms (59.9 Hz) means 60.
            snprintf(text, DIP_BUDGET_BYTES, "At %d frames a second (%s ms)", rates_hz[i], ms);
            return;
        }
    }
    snprintf(text, DIP_BUDGET_BYTES, "Within %s ms a frame", ms);
}

void dip_fits_text(double fits, char text[DIP_NUMBER_BYTES]) {
    if (isnan(fits)) {
        snprintf(text, DIP_NUMBER_BYTES, "unknown");
    } else if (fits >= 0.995 && fits < 0.9995) {
        snprintf(text, DIP_NUMBER_BYTES, "99 %%");
    } else if (fits <= 0.005 && fits > 0.0005) {
        snprintf(text, DIP_NUMBER_BYTES, "1 %%");
    } else {
        snprintf(text, DIP_NUMBER_BYTES, "%.0f %%", 100.0 * fits);
    }
}
