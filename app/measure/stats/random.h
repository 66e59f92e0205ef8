// Generates repeatable random numbers for shuffling. They are not safe for cryptography.
#ifndef DIP_APP_MEASURE_STATS_RANDOM_H
#define DIP_APP_MEASURE_STATS_RANDOM_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Returns the upper 31 bits of the new state of Knuth's 64-bit linear congruential generator
// (MMIX).
static inline uint32_t dip_random_next(uint64_t *state) {
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (uint32_t)(*state >> 33);
}

// Returns a number in 0..count - 1. All are equally likely, to within a relative error of
// count / 2^31.
static inline int dip_random_below(uint64_t *state, int count) {
    return (int)(dip_random_next(state) % (uint32_t)count);
}

// Shuffles the values in place (Fisher and Yates).
static inline void dip_random_shuffle(uint64_t *state, int *values, int count) {
    for (int i = count - 1; i > 0; i--) {
        const int other = dip_random_below(state, i + 1);
        const int swap = values[i];
        values[i] = values[other];
        values[other] = swap;
    }
}

#ifdef __cplusplus
}
#endif

#endif
