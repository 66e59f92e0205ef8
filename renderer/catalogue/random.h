// A small random generator for tests. Tests seed it, so that a failure can be repeated.
#ifndef DIP_RENDERER_CATALOGUE_RANDOM_H
#define DIP_RENDERER_CATALOGUE_RANDOM_H

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

#endif
