// A small random generator for tests. Tests seed it, so that a failure can be repeated. Do not draw
// two numbers in one expression, call or list of initial values: C leaves open which of them comes
// first, and the cases would depend on the compiler.
#ifndef DIP_RENDERER_CATALOGUE_RANDOM_H
#define DIP_RENDERER_CATALOGUE_RANDOM_H

#include <math.h>
#include <stdint.h>

typedef struct Random {
    uint64_t state;
} Random;

// The SplitMix64 generator.
static inline uint64_t random_u64(Random *random) {
    uint64_t z = random->state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

// Returns a number from low to high, both included.
static inline int random_int(Random *random, int low, int high) {
    return low + (int)(random_u64(random) % (uint64_t)((int64_t)high - low + 1));
}

static inline double random_real(Random *random, double low, double high) {
    return low + (high - low) * (double)(random_u64(random) >> 11) * 0x1p-53;
}

// Returns a positive number whose binary exponent is a number from low to high, both included, with
// the same chance: the number is at least 2^low and less than 2^(high + 1).
static inline double random_magnitude(Random *random, int low, int high) {
    const double significand = random_real(random, 1.0, 2.0);
    return ldexp(significand, random_int(random, low, high));
}

#endif
