// Random and special values, and memory without room around it.
#include "tests/renderer/simd/values.h"

#include "renderer/base/assert.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

static char *blocks[16];
static size_t block_count;

size_t value_bytes(Values kind) {
    kind &= KINDS;
    return kind == BYTE ? 1 : kind < LONG_MASK ? 4 : 8;
}

static float float_of(uint32_t bits) {
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

static double double_of(uint64_t bits) {
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

static int32_t any_int(Random *random) {
    static const int32_t specials[] = {
        0,      1,      -1,      INT32_MIN,   INT32_MAX,  INT32_MIN + 1, INT32_MAX - 1, 0x7fff,
        0x8000, 0xffff, 0x10000, 0x7fff0000,  0x7fff7fff, 0x00018000,    0xff,          0x1000001,
        -32768, -32769, -65536,  -0x7fff0001, 1 << 24,    1 << 30,       0x7fffffc0,    0x7fffff40};
    switch (random_int(random, 0, 2)) {
    case 0:
        return specials[random_int(random, 0, (int)DIP_ARRAY_COUNT(specials) - 1)];
    case 1:
        return random_int(random, -3, 3);
    default:
        return (int32_t)(uint32_t)random_u64(random);
    }
}

static float any_float(Random *random) {
    static const float specials[] = {
        0.0f,     -0.0f,        1.0f,           -1.0f,         0.5f,         -0.5f,
        INFINITY, -INFINITY,    FLT_MAX,        -FLT_MAX,      FLT_MIN,      -FLT_MIN,
        1e-45f,   -1e-45f,      1e-40f,         0x1.fffffep-1, 8388607.0f,   8388607.5f - 0.5f,
        8388608,  -8388608.0f,  8388609.0f,     -8388609.0f,   4194303.5f,   -4194303.5f,
        16777216, 0x1p31f,      0x1.fffffep30f, -0x1p31f,      -0x1.8p31f,   0x1p32f,
        -8388607, -4194304.25f, 0x1.000002p0f,  -0x1p-24f,     -0x1.fp-126f, 126.0f};
    uint32_t bits;
    float half;
    switch (random_int(random, 0, 4)) {
    case 0:
        return specials[random_int(random, 0, (int)DIP_ARRAY_COUNT(specials) - 1)];
    case 1: // any bits
        bits = (uint32_t)random_u64(random);
        return float_of((bits & 0x7f800000) == 0x7f800000 ? bits | 0x00400000 : bits);
    case 2: // quiet NaNs of both signs, with any payload, but fewer of them
        bits = (uint32_t)random_u64(random);
        return float_of(bits & 1 ? bits | 0x7fc00000 : 0x3f800000 + bits % 4);
    case 3: // whole numbers, halves, and their neighbours
        half = 0.5f * (float)random_int(random, -9, 9);
        return nextafterf(half, 0.5f * (float)random_int(random, -9, 9));
    default:
        return (float)random_real(random, -1000.0, 1000.0);
    }
}

static double any_double(Random *random) {
    static const uint64_t low_bits[] = {0, 1, 0x0fffffff, 0x10000000, 0x10000001, 0x1fffffff};
    uint64_t bits;
    switch (random_int(random, 0, 2)) {
    case 0: // any bits
        bits = random_u64(random);
        return double_of((bits & 0x7ff0000000000000u) == 0x7ff0000000000000u
                             ? bits | 0x0008000000000000u
                             : bits);
    case 1: // floats
        return (double)any_float(random);
    default: // numbers at and beside the middle of two floats, from too small to too large for one
        bits = (uint64_t)random_int(random, 1023 - 152, 1023 + 128) << 52;
        bits |= random_u64(random) & 0x800fffffe0000000u;
        return double_of(bits | low_bits[random_int(random, 0, 5)]);
    }
}

static double any_whole(Random *random) {
    const double limit = 0x1p51 - 1.0;
    switch (random_int(random, 0, 2)) {
    case 0:
        return random_int(random, 0, 1) ? limit : -limit;
    case 1:
        return (double)any_int(random);
    default:
        return trunc(random_real(random, -limit, limit));
    }
}

static void fill_floats(Random *random, Values kind, float *values, int count) {
    for (int i = 0; i < count; i++) {
        do {
            values[i] = any_float(random);
        } while ((kind == INT_FLOAT && !(values[i] >= -0x1p31f && values[i] < 0x1p31f)) ||
                 (kind == POSITIVE && !(values[i] >= FLT_MIN && values[i] <= FLT_MAX)));
    }
}

// Returns the bits of up to 64 lanes: all, none, a single one, or any of them.
static uint64_t any_lanes(Random *random, int count) {
    switch (random_int(random, 0, 5)) {
    case 0:
        return UINT64_MAX;
    case 1:
        return 0;
    case 2:
        return UINT64_C(1) << random_int(random, 0, (count < 64 ? count : 64) - 1);
    default:
        return random_u64(random);
    }
}

static void fill_ints(Random *random, Values kind, int32_t *values, int count) {
    const uint64_t lanes = any_lanes(random, count);
    for (int i = 0; i < count; i++) {
        const int32_t any = any_int(random);
        values[i] = kind == MASK        ? -(int32_t)(lanes >> (i & 63) & 1)
                    : kind == SMALL_INT ? any >> 4
                    : kind == HALVES_15 ? any & 0x7fff7fff
                                        : any;
    }
}

static void fill_wide(Random *random, Values kind, char *values, int count) {
    const uint64_t lanes = any_lanes(random, count);
    for (int i = 0; i < count; i++) {
        const double x = kind == WHOLE ? any_whole(random) : any_double(random);
        int64_t bits =
            kind == LONG_MASK ? -(int64_t)(lanes >> (i & 63) & 1) : (int64_t)random_u64(random);
        if (kind == DOUBLE || kind == WHOLE) {
            memcpy(&bits, &x, sizeof bits);
        }
        memcpy(values + 8 * i, &bits, sizeof bits);
    }
}

void fill_values(Random *random, Values kind, void *values, int count) {
    const size_t size = value_bytes(kind);
    const Values each = kind & KINDS;
    if (each == BYTE) {
        for (int i = 0; i < count; i++) {
            ((uint8_t *)values)[i] = (uint8_t)random_u64(random);
        }
    } else if (each < FLOAT) {
        fill_ints(random, each, values, count);
    } else if (each < LONG_MASK) {
        fill_floats(random, each, values, count);
    } else {
        fill_wide(random, each, values, count);
    }
    for (int i = 1; kind & SAME && i < count; i++) {
        memcpy((char *)values + (size_t)i * size, values, size);
    }
}

void *exact_memory(Random *random, size_t bytes, size_t align_bytes) {
    // malloc aligns to 16 bytes. Half of the arrays have the asked alignment only.
    const size_t before = random_int(random, 0, 1) ? align_bytes : 0;
    char *block = malloc(before + bytes);
    DIP_ASSERT(block_count < DIP_ARRAY_COUNT(blocks));
    blocks[block_count++] = block;
    return block + before;
}

void *exact_values(Random *random, Values kind, int count) {
    void *values = exact_memory(random, (size_t)count * value_bytes(kind), value_bytes(kind));
    fill_values(random, kind, values, count);
    return values;
}

void free_exact_memory(void) {
    while (block_count) {
        free(blocks[--block_count]);
    }
}
