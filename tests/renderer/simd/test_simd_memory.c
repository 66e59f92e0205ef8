// Compares the functions of renderer/simd/ that read, write and reorder memory, for every
// instruction set of this machine, with plain code. Arrays are only as large as the functions may
// use.
#include "renderer/base/assert.h"
#include "tests/renderer/simd/simd_calls.h"
#include "tests/renderer/simd/values.h"

#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

// A function that reads, for each lane, one or more 32-bit values from base[index * step]. An index
// is from `low` to `high`, both included. The function returns a vector of the first values, then
// one of the second values, and so on.
typedef struct ReadTest {
    SimdCall function;
    int step_bytes;
    int low;
    int high;
    int values;
} ReadTest;

enum { QUAD_STRIDE = 5 }; // 32-bit values between the quads of two neighbouring indices

static const ReadTest read_tests[] = {
    {SIMD_vf_gather, 4, -9, 40, 1},       {SIMD_vi_gather, 4, -9, 40, 1},
    {SIMD_hi_gather, 4, -9, 40, 1},       {SIMD_hf_gather, 4, -9, 40, 1},
    {SIMD_vi_lookup16, 4, 0, 15, 1},      {SIMD_vi_lookup32, 4, 0, 31, 1},
    {SIMD_vf_lookup16, 4, 0, 15, 1},      {SIMD_vu_gather_bytes, 1, -9, 40, 1},
    {SIMD_vu_gather_pairs, 4, -9, 40, 2}, {SIMD_vf_split_quads, 4 * QUAD_STRIDE, 0, 20, 4},
};

static void check_reads(const SimdSet *set, Random *random) {
    const size_t stride = QUAD_STRIDE;
    for (size_t t = 0; t < DIP_ARRAY_COUNT(read_tests); t++) {
        const ReadTest *test = &read_tests[t];
        const bool half = test->function == SIMD_hi_gather || test->function == SIMD_hf_gather;
        const int count = half ? set->half_lanes : set->lanes;
        const int bytes = (test->high - test->low) * test->step_bytes + 4 * test->values;
        const char *memory = test->step_bytes == 1 ? exact_values(random, BYTE, bytes)
                                                   : exact_values(random, FLOAT, bytes / 4);
        const char *base = memory - test->low * test->step_bytes;
        int32_t *index = exact_memory(random, (size_t)count * 4, 4);
        for (int i = 0; i < count; i++) {
            const int at = random_int(random, test->low - 1, test->high + 1);
            index[i] = at < test->low ? test->low : at > test->high ? test->high : at;
        }
        uint32_t *out = exact_memory(random, (size_t)(count * test->values) * 4, 4);
        simd_call(set, test->function, base, index, &stride, out);
        for (int i = 0; i < count; i++) {
            for (int v = 0; v < test->values; v++) {
                const uint8_t *p = (const uint8_t *)base + index[i] * test->step_bytes + 4 * v;
                const uint32_t little_endian = (uint32_t)p[0] | (uint32_t)p[1] << 8 |
                                               (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
                if (out[v * count + i] != little_endian) {
                    fail_msg("%s, %s: value %d of lane %d, index %d",
                             simd_call_name(test->function), dip_isa_name(set->isa), v, i,
                             index[i]);
                }
            }
        }
        free_exact_memory();
    }
}

static void each_lane_reads_from_its_own_index(void **state) {
    (void)state;
    simd_for_each_set(check_reads);
}

static void check_loads(const SimdSet *set, Random *random) {
    int32_t found[SIMD_LANES_MAX] = {0};
    const uint8_t *bytes = exact_values(random, BYTE, set->lanes);
    simd_call(set, SIMD_vi_load_bytes, bytes, NULL, NULL, found);
    for (int i = 0; i < set->lanes; i++) {
        assert_int_equal(found[i], bytes[i]);
    }
    simd_call(set, SIMD_vi_iota, NULL, NULL, NULL, found);
    for (int i = 0; i < set->lanes; i++) {
        assert_int_equal(found[i], i);
    }
    // Lanes that a half vector has in addition become 0.
    const int whole = set->lanes == 4 ? 4 : set->half_lanes;
    const uint8_t *half_bytes = exact_values(random, BYTE, set->half_lanes);
    const int32_t *half = exact_values(random, INT, set->half_lanes);
    simd_call(set, SIMD_hi_load_bytes, half_bytes, NULL, NULL, found);
    for (int i = 0; i < whole; i++) {
        assert_int_equal(found[i], i < set->half_lanes ? half_bytes[i] : 0);
    }
    simd_call(set, SIMD_hi_load, half, NULL, NULL, found);
    for (int i = 0; i < whole; i++) {
        assert_int_equal(found[i], i < set->half_lanes ? half[i] : 0);
    }
}

static void loads_fill_every_lane(void **state) {
    (void)state;
    simd_for_each_set(check_loads);
}

static void check_stores_of_lanes(const SimdSet *set, Random *random) {
    const size_t bytes = (size_t)set->lanes * 4;
    for (int floats = 0; floats < 2; floats++) {
        const int32_t *mask = exact_values(random, MASK, set->lanes);
        const uint32_t *v = exact_values(random, FLOAT, set->lanes);
        const uint32_t *old = exact_values(random, FLOAT, set->lanes);
        uint32_t *out = memcpy(exact_memory(random, bytes, 4), old, bytes);
        simd_call(set, floats ? SIMD_vf_store_lanes : SIMD_vi_store_lanes, mask, v, old, out);
        for (int i = 0; i < set->lanes; i++) {
            assert_int_equal(out[i], mask[i] ? v[i] : old[i]);
        }
    }
}

static void only_lanes_of_the_mask_are_stored(void **state) {
    (void)state;
    simd_for_each_set(check_stores_of_lanes);
}

// Returns a mask as bits.
static unsigned random_bits(Random *random, int lanes) {
    const int32_t *mask = exact_values(random, MASK, lanes);
    unsigned bits = 0;
    for (int i = 0; i < lanes; i++) {
        bits |= (unsigned)(mask[i] & 1) << i;
    }
    return bits;
}

static void check_packing(const SimdSet *set, Random *random) {
    const unsigned bits = random_bits(random, set->lanes);
    const uint32_t *v = exact_values(random, FLOAT, set->lanes);
    uint32_t *packed = exact_values(random, FLOAT, set->lanes);
    uint32_t *expanded = exact_memory(random, (size_t)set->lanes * 4, 4);
    const int count = simd_call(set, SIMD_vu_compress, &bits, v, NULL, packed);
    simd_call(set, SIMD_vf_expand, packed, &bits, NULL, expanded);
    int expected = 0;
    for (int i = 0; i < set->lanes; i++) {
        assert_int_equal(expanded[i], bits >> i & 1 ? packed[expected] : 0);
        if (bits >> i & 1) {
            assert_int_equal(packed[expected++], v[i]);
        }
    }
    assert_int_equal(count, expected);

    const unsigned half_bits = random_bits(random, set->half_lanes);
    const int whole = set->lanes == 4 ? 4 : set->half_lanes; // lanes of a half vector in memory
    const int32_t *half = exact_values(random, INT, set->half_lanes);
    int32_t *half_packed = exact_memory(random, (size_t)whole * 4, 4);
    simd_call(set, SIMD_hi_store_packed, half, &half_bits, NULL, half_packed);
    for (int i = 0; i < set->half_lanes; i++) {
        if (half_bits >> i & 1) {
            assert_int_equal(*half_packed++, half[i]);
        }
    }
}

static void check_bits(const SimdSet *set, Random *random) {
    const unsigned bits = random_bits(random, SIMD_LANES_MAX);
    const unsigned places = random_bits(random, SIMD_LANES_MAX);
    unsigned expected = 0;
    for (int i = 0, next = 0; i < SIMD_LANES_MAX; i++) {
        if (places >> i & 1) {
            expected |= (bits >> next++ & 1) << i;
        }
    }
    assert_int_equal(simd_call(set, SIMD_bits_at, &bits, &places, NULL, NULL), expected);
}

static void bits_go_to_their_places(void **state) {
    (void)state;
    simd_for_each_set(check_bits);
}

static void lanes_are_packed_without_gaps_and_expanded_again(void **state) {
    (void)state;
    simd_for_each_set(check_packing);
}

static void check_rows(const SimdSet *set, Random *random) {
    const int count = set->half_lanes;
    const size_t stride = random_int(random, 0, 1) ? 40 : 32; // with or without a gap
    const size_t bytes = stride * (size_t)(count - 1) + 32;
    const int64_t *rows = exact_values(random, LONG, 4 * count);
    char *out = exact_memory(random, bytes, 8);
    char *expected = exact_memory(random, bytes, 8);
    memset(out, 0x5a, bytes);
    memset(expected, 0x5a, bytes);
    for (int i = 0; i < 4 * count; i++) { // word i / count of lane i % count
        memcpy(expected + stride * (size_t)(i % count) + 8 * (size_t)(i / count), &rows[i], 8);
    }
    simd_call(set, SIMD_vl_store_rows, rows, &stride, NULL, out);
    assert_memory_equal(out, expected, bytes);
}

static void rows_of_words_are_stored_at_a_stride(void **state) {
    (void)state;
    simd_for_each_set(check_rows);
}

static void check_quads(const SimdSet *set, Random *random) {
    const size_t stride = QUAD_STRIDE;
    const size_t lanes = (size_t)set->lanes;
    const uint32_t *base = exact_values(random, INT, 20 * QUAD_STRIDE + 4);
    int32_t *index = exact_memory(random, lanes * 4, 4);
    for (size_t i = 0; i < lanes; i++) {
        index[i] = random_int(random, 0, 20);
    }
    uint32_t *sum = exact_memory(random, lanes * 4, 4);
    simd_call(set, SIMD_vu_quad_sum, base, index, &stride, sum);
    const uint32_t *left = exact_values(random, INT, set->lanes);
    const uint32_t *right = exact_values(random, INT, set->lanes);
    uint32_t *weights = exact_memory(random, 4 * lanes * 4, 4);
    simd_call(set, SIMD_vu_quad_weights, left, right, NULL, weights);
    for (size_t i = 0; i < lanes; i++) {
        const uint32_t *quad = base + stride * (size_t)index[i];
        assert_int_equal(sum[i], (uint32_t)(quad[0] + quad[1] + quad[2] + quad[3]));
        // From the upper left to the lower right weight, each in both halves.
        assert_int_equal(weights[i], (left[i] & 0xffff) * 0x10001);
        assert_int_equal(weights[lanes + i], (left[i] >> 16) * 0x10001);
        assert_int_equal(weights[2 * lanes + i], (right[i] & 0xffff) * 0x10001);
        assert_int_equal(weights[3 * lanes + i], (right[i] >> 16) * 0x10001);
    }
}

static void quads_are_summed_and_weights_put_in_their_order(void **state) {
    (void)state;
    simd_for_each_set(check_quads);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_lane_reads_from_its_own_index),
        cmocka_unit_test(loads_fill_every_lane),
        cmocka_unit_test(only_lanes_of_the_mask_are_stored),
        cmocka_unit_test(lanes_are_packed_without_gaps_and_expanded_again),
        cmocka_unit_test(bits_go_to_their_places),
        cmocka_unit_test(rows_of_words_are_stored_at_a_stride),
        cmocka_unit_test(quads_are_summed_and_weights_put_in_their_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
