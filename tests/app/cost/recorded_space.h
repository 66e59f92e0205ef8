// The combinations whose pictures record_flip.c judges, and on which test_best.c lets the search
// run: every combination of one option of each factor. Their FLIP is written as text.
#ifndef DIP_TESTS_APP_COST_RECORDED_SPACE_H
#define DIP_TESTS_APP_COST_RECORDED_SPACE_H

#include "renderer/scene/quality.h"

#include <math.h>
#include <string.h>

enum { RECORDED_FACTORS = 7, RECORDED_MOST_OPTIONS = 10 };

// Settings as text. A factor ends at the first NULL. Option 0 of each is the default.
static const char *const recorded_factors[RECORDED_FACTORS][RECORDED_MOST_OPTIONS + 1] = {
    {"", "aa=2", "aa=4", "aa=8", "taa=history", "aa=4,taa=history", "aa=4,aaa=coverage",
     "aa=4,aaa=on", "aa=8,aaa=on", "aa=8,aaa=all"},
    {"", "af=4", "af=16", "af=16,aaf=on"},
    {"", "opt=advanced"},
    {"", "miplod=quality", "miplod=sharp"},
    {"", "scale=1/1.5", "scale=1/1.5,upscale=easu", "scale=1.25", "scale=1.5", "scale=2"},
    {"", "post=smaa"},
    {"", "sharpen=low"},
};

static inline int recorded_options(int factor) {
    int count = 0;
    while (recorded_factors[factor][count]) {
        count++;
    }
    return count;
}

static inline int recorded_count(void) {
    int count = 1;
    for (int f = 0; f < RECORDED_FACTORS; f++) {
        count *= recorded_options(f);
    }
    return count;
}

// Returns a combination, 0 to recorded_count() - 1. The last factor changes fastest.
static inline DipQuality recorded_settings(int index) {
    DipQuality quality = dip_quality_default();
    char text[256] = "";
    int divisor = recorded_count();
    for (int f = 0; f < RECORDED_FACTORS; f++) {
        divisor /= recorded_options(f);
        const char *option = recorded_factors[f][index / divisor % recorded_options(f)];
        strcat(strcat(text, *text && *option ? "," : ""), option);
    }
    if (*text) {
        dip_quality_parse(text, &quality, NULL);
    }
    return quality;
}

// Each value is two digits to the base 64. They are the logarithm of FLIP above that of 2e-4, in
// units of .0019, so FLIP is known within .1 %, from 2e-4 to .48.
#define RECORDED_DIGITS "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz+-"
static const double recorded_least = 2e-4, recorded_unit = 0.0019;

// The values stand in lines.
enum { RECORDED_PER_LINE = 45, RECORDED_LINES = 5760 / RECORDED_PER_LINE };

static inline double recorded_value(const char (*lines)[2 * RECORDED_PER_LINE + 1], int index) {
    const char *digits = RECORDED_DIGITS;
    const char *text = &lines[index / RECORDED_PER_LINE][2 * (index % RECORDED_PER_LINE)];
    const long high = strchr(digits, text[0]) - digits;
    const long low = strchr(digits, text[1]) - digits;
    return recorded_least * exp(recorded_unit * (double)(64 * high + low));
}

static inline void recorded_write(double flip, char text[3]) {
    const double code = log(fmax(flip, recorded_least) / recorded_least) / recorded_unit;
    const long rounded = lround(fmin(code, 4095.0));
    text[0] = RECORDED_DIGITS[rounded / 64];
    text[1] = RECORDED_DIGITS[rounded % 64];
    text[2] = '\0';
}

#endif
