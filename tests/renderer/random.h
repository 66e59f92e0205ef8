// Seeded random numbers for tests: the same on every machine.
#ifndef DIP_TESTS_RENDERER_RANDOM_H
#define DIP_TESTS_RENDERER_RANDOM_H

#include <stdint.h>

typedef struct DipTestRandom {
    uint64_t state;
} DipTestRandom;

// A Weyl sequence through a 64-bit mixer (splitmix64).
static inline uint64_t dip_test_random_bits(DipTestRandom *random) {
    uint64_t z = random->state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

// low..high, both included.
static inline int64_t dip_test_random_int(DipTestRandom *random, int64_t low, int64_t high) {
    return low + (int64_t)(dip_test_random_bits(random) % (uint64_t)(high - low + 1));
}

// [low, high)
static inline double dip_test_random_real(DipTestRandom *random, double low, double high) {
    return low + (high - low) * ((double)(dip_test_random_bits(random) >> 11) * 0x1p-53);
}

#endif
