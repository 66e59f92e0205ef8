// Private to the reference renderer and its tests: numbers with 106 bits of precision.
//
// A wide number is the unevaluated sum of two doubles ("double-double"). The operations are the
// ones that Joldes, Muller and Popescu analyse in "Tight and rigorous error bounds for basic
// building blocks of double-word arithmetic" (2017). They need rounding to nearest. They do not use
// fused multiply-add, so every machine computes the same bits. Magnitudes must lie between 2^-900
// and 2^900; results are then right to about 2^-102 of the result, except for sums with
// cancellation, which are right to about 2^-104 of the greater term.
#ifndef DIP_RENDERER_REFERENCE_INTERNAL_WIDE_H
#define DIP_RENDERER_REFERENCE_INTERNAL_WIDE_H

typedef struct DipWide {
    double high; // the sum, rounded to double
    double low;  // the rest
} DipWide;

static inline DipWide dip_wide(double value) {
    return (DipWide){value, 0.0};
}

// Returns a + b exactly (Knuth's TwoSum).
static inline DipWide dip_wide_sum(double a, double b) {
    const double sum = a + b;
    const double b_part = sum - a;
    return (DipWide){sum, (a - (sum - b_part)) + (b - b_part)};
}

// Returns a + b exactly, for |a| >= |b| or a = 0 (Dekker's Fast2Sum).
static inline DipWide dip_wide_sum_ordered(double a, double b) {
    const double sum = a + b;
    return (DipWide){sum, b - (sum - a)};
}

// Returns the upper 26 bits of a double (Veltkamp). The rest fits in 26 bits, too.
static inline double dip_wide_upper(double a) {
    const double scaled = a * 134217729.0; // 2^27 + 1
    return scaled - (scaled - a);
}

// Returns a * b exactly (Dekker's product).
static inline DipWide dip_wide_product(double a, double b) {
    const double product = a * b;
    const double a1 = dip_wide_upper(a), a2 = a - a1;
    const double b1 = dip_wide_upper(b), b2 = b - b1;
    return (DipWide){product, ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2};
}

static inline DipWide dip_wide_add(DipWide a, DipWide b) {
    const DipWide upper = dip_wide_sum(a.high, b.high);
    const DipWide lower = dip_wide_sum(a.low, b.low);
    const DipWide sum = dip_wide_sum_ordered(upper.high, upper.low + lower.high);
    return dip_wide_sum_ordered(sum.high, sum.low + lower.low);
}

static inline DipWide dip_wide_add_double(DipWide a, double b) {
    const DipWide sum = dip_wide_sum(a.high, b);
    return dip_wide_sum_ordered(sum.high, sum.low + a.low);
}

static inline DipWide dip_wide_negate(DipWide a) {
    return (DipWide){-a.high, -a.low};
}

static inline DipWide dip_wide_subtract(DipWide a, DipWide b) {
    return dip_wide_add(a, dip_wide_negate(b));
}

static inline DipWide dip_wide_scale(DipWide a, double b) {
    const DipWide upper = dip_wide_product(a.high, b);
    const DipWide sum = dip_wide_sum_ordered(upper.high, a.low * b);
    return dip_wide_sum_ordered(sum.high, sum.low + upper.low);
}

static inline DipWide dip_wide_multiply(DipWide a, DipWide b) {
    const DipWide upper = dip_wide_product(a.high, b.high);
    return dip_wide_sum_ordered(upper.high, upper.low + (a.high * b.low + a.low * b.high));
}

static inline DipWide dip_wide_divide(DipWide a, DipWide b) {
    const double quotient = a.high / b.high;
    const DipWide rest = dip_wide_subtract(a, dip_wide_scale(b, quotient));
    return dip_wide_sum_ordered(quotient, rest.high / b.high);
}

#endif
