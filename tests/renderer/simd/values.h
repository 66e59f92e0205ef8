// Arguments for the functions of renderer/simd/: arrays of random and of special values.
#ifndef DIP_TESTS_RENDERER_SIMD_VALUES_H
#define DIP_TESTS_RENDERER_SIMD_VALUES_H

#include "renderer/catalogue/random.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// The kinds of an array's values. NaNs are quiet, because instructions make signalling ones quiet.
typedef enum Values {
    NOTHING,
    BYTE,
    INT,
    SMALL_INT, // below 2^27 in magnitude
    HALVES_15, // both 16-bit halves are below 2^15
    MASK,      // 0 or -1
    FLOAT,
    INT_FLOAT, // within the range of int32
    POSITIVE,  // positive normal numbers
    ANY_NAN,   // as FLOAT; as the kind of a result, every NaN equals every other
    LONG_MASK, // 0 or -1, in 64 bits, as all kinds that follow
    DOUBLE,
    WHOLE, // whole numbers below 2^51 in magnitude
    LONG,
    KINDS = 31,
    SAME = 32, // This bit gives all values of the array the value of the first.
} Values;

// Bytes of a value.
size_t value_bytes(Values kind);

// Fills an array with random and special values.
void fill_values(Random *random, Values kind, void *values, int count);

// Returns uninitialised memory, after whose last byte nothing is allocated, so that the address
// sanitizer sees a step beyond the end. The address is often aligned to align_bytes and no more.
void *exact_memory(Random *random, size_t bytes, size_t align_bytes);

// Returns an array in exact_memory that fill_values has filled.
void *exact_values(Random *random, Values kind, int count);

// Frees all that exact_memory has returned.
void free_exact_memory(void);

#endif
