// Pictures made by formula, for tests of the metrics.
#ifndef DIP_TESTS_APP_MEASURE_PATTERNS_H
#define DIP_TESTS_APP_MEASURE_PATTERNS_H

#include "app/measure/metrics/picture.h"

enum { DIP_PATTERN_SIZE = 80 }; // greatest width and height

typedef struct DipPattern {
    uint8_t rgba8[DIP_PATTERN_SIZE * DIP_PATTERN_SIZE * 4];
    DipSrgbPicture picture; // the first `width` columns of the first `height` rows
} DipPattern;

// Returns the code (8-bit sRGB value) of channel c at (x, y).
typedef int DipPatternCode(int x, int y, int c);

static inline void dip_pattern_fill(DipPattern *pattern, int width, int height,
                                    DipPatternCode *code) {
    pattern->picture =
        (DipSrgbPicture){pattern->rgba8, (size_t)DIP_PATTERN_SIZE * 4, width, height};
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            for (int c = 0; c < 4; c++) {
                // The fourth byte is noise, which no metric may read.
                pattern->rgba8[4 * (y * DIP_PATTERN_SIZE + x) + c] =
                    (uint8_t)(c < 3 ? code(x, y, c) : x * 7 + y);
            }
        }
    }
}

// Returns codes without any pattern. Channels 3..5 give another picture than channels 0..2.
static inline int dip_pattern_hash(int x, int y, int c) {
    uint32_t h = (uint32_t)x * 374761393u + (uint32_t)y * 668265263u + (uint32_t)c * 2246822519u;
    h = (h ^ h >> 13) * 1274126177u;
    h ^= h >> 16;
    return (int)(h & 255);
}

static inline int dip_pattern_other_hash(int x, int y, int c) {
    return dip_pattern_hash(x, y, c + 3);
}

static inline int dip_pattern_gradient(int x, int y, int c) {
    return (c == 0 ? 4 * x : c == 1 ? 4 * y : 2 * (x + y)) & 255;
}

static inline int dip_pattern_coarse_gradient(int x, int y, int c) {
    return dip_pattern_gradient(x, y, c) & 0xf8;
}

#endif
