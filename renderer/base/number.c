// Conversion of numbers from and to text.
#include "renderer/base/number.h"

#include "renderer/base/fp_mode.h"

#include <limits.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// strtod and printf take the decimal point from the thread's locale, and the last digit from the
// rounding mode.
#ifdef _WIN32
// Windows has no locale that a thread can save and restore. Programs for Windows start in the "C"
// locale, and Diptych does not change it.
typedef int CallerLocale;

static CallerLocale enter_c_locale(void) {
    return 0;
}

static void return_to_locale(CallerLocale caller) {
    (void)caller;
}
#else
typedef struct CallerLocale {
    locale_t locale;
    locale_t made;
} CallerLocale;

// glibc's "C" locale object is static, so newlocale allocates no memory there.
static CallerLocale enter_c_locale(void) {
    CallerLocale caller = {.made = newlocale(LC_ALL_MASK, "C", (locale_t)0)};
    caller.locale = uselocale(caller.made); // uselocale((locale_t)0) changes nothing
    return caller;
}

static void return_to_locale(CallerLocale caller) {
    uselocale(caller.locale);
    if (caller.made) {
        freelocale(caller.made);
    }
}
#endif

static size_t count_digits(const char *text, const char *end) {
    const char *at = text;
    while (at < end && *at >= '0' && *at <= '9') {
        at++;
    }
    return (size_t)(at - text);
}

static const char *skip_sign(const char *text, const char *end) {
    return text < end && (*text == '+' || *text == '-') ? text + 1 : text;
}

static bool is_decimal(const char *text, size_t length) {
    const char *end = text + length;
    const char *at = skip_sign(text, end);
    size_t digits = count_digits(at, end);
    at += digits;
    if (at < end && *at == '.') {
        at++;
        const size_t fraction = count_digits(at, end);
        at += fraction;
        digits += fraction;
    }
    if (digits == 0) {
        return false;
    }
    if (at < end && (*at == 'e' || *at == 'E')) {
        at = skip_sign(at + 1, end);
        const size_t exponent = count_digits(at, end);
        at += exponent;
        if (exponent == 0) {
            return false;
        }
    }
    return at == end;
}

bool dip_number_parse(const char *text, size_t length, double *value) {
    DIP_FP_MODE_SCOPE();
    char copy[DIP_MAX_NUMBER_LENGTH + 1];
    if (length > DIP_MAX_NUMBER_LENGTH || !is_decimal(text, length)) {
        return false;
    }
    memcpy(copy, text, length);
    copy[length] = '\0';
    const CallerLocale caller = enter_c_locale();
    char *end;
    const double number = strtod(copy, &end);
    return_to_locale(caller);
    if (*end != '\0' || !isfinite(number)) {
        return false;
    }
    *value = number;
    return true;
}

bool dip_integer_parse(const char *text, size_t length, int *value) {
    const char *end = text + length;
    const char *digits = skip_sign(text, end);
    if (digits == end || digits + count_digits(digits, end) != end) {
        return false;
    }
    long long number = 0;
    for (const char *at = digits; at < end; at++) {
        number = number * 10 + (*at - '0');
        if (number > INT_MAX) {
            return false;
        }
    }
    *value = (int)(*text == '-' ? -number : number);
    return true;
}

size_t dip_number_format(double value, char buffer[DIP_NUMBER_TEXT_SIZE]) {
    DIP_FP_MODE_SCOPE();
    const CallerLocale caller = enter_c_locale();
    int length = 0;
    for (int digits = 15; digits <= 17; digits++) {
        length = snprintf(buffer, DIP_NUMBER_TEXT_SIZE, "%.*g", digits, value);
        if (strtod(buffer, NULL) == value) {
            break;
        }
    }
    return_to_locale(caller);
    return (size_t)length;
}
