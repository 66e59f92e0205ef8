// The transfer function of sRGB (IEC 61966-2-1) in double precision, for tests that compare
// pictures with light. It shares nothing with the tables of the code under test.
#ifndef DIP_TESTS_SUPPORT_SRGB_H
#define DIP_TESTS_SUPPORT_SRGB_H

#include <math.h>

// Converts linear light to the encoded value and back. Both are 0..1.
static inline double srgb_encode(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1.0 / 2.4) - 0.055;
}

static inline double srgb_decode(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
}

// Returns the 8-bit code that is nearest to linear light of 0..1.
static inline int srgb_code(double linear) {
    return (int)lround(255.0 * srgb_encode(linear));
}

// Returns the linear light of an 8-bit code.
static inline double srgb_light(int code) {
    return srgb_decode(code / 255.0);
}

#endif
