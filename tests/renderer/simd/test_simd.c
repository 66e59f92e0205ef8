// Compares the functions of renderer/simd/ that compute, for every instruction set of this machine,
// with a formula for one lane, bit for bit. test_simd_memory.c tests the functions that move lanes.
#include "renderer/base/assert.h"
#include "tests/renderer/simd/simd_calls.h"
#include "tests/renderer/simd/values.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

// --- functions of lanes ------------------------------------------------------------------------

// A lane of any type.
typedef union Lane {
    int32_t i;
    uint32_t u;
    float f;
    int64_t l;
    double d;
} Lane;

static int32_t signed_low(Lane x) {
    return (int16_t)(x.u & 0xffff);
}

static int32_t signed_high(Lane x) {
    return (int16_t)(x.u >> 16);
}

static uint32_t high_of_product(uint32_t a, uint32_t b) {
    return (uint32_t)((uint64_t)a * b >> 16);
}

// The functions that compute each lane of their result from the same lane of their arguments, as
// X(function, kind of the result, formula, kinds of the arguments ...). The formula sets the lane r
// from the lanes a, b, c and d of the arguments.
#define LANE_LIST(X)                                                                               \
    X(vf_load, FLOAT, r = a, FLOAT)                                                                \
    X(vi_load, INT, r = a, INT)                                                                    \
    X(vu_store, INT, r = a, INT)                                                                   \
    X(vf_splat, ANY_NAN, r = a, FLOAT | SAME)                                                      \
    X(vi_splat, INT, r = a, INT | SAME)                                                            \
    X(vu_splat, INT, r = a, INT | SAME)                                                            \
    X(vf_from_int, FLOAT, r.f = (float)a.i, INT)                                                   \
    X(vi_from_float, INT, r.i = (int32_t)a.f, INT_FLOAT)                                           \
    X(vi_bits, INT, r = a, FLOAT)                                                                  \
    X(vf_bits, FLOAT, r = a, INT)                                                                  \
    X(vf_lt, MASK, r.i = a.f < b.f ? -1 : 0, FLOAT, FLOAT)                                         \
    X(vi_lt, MASK, r.i = a.i < b.i ? -1 : 0, INT, INT)                                             \
    X(vi_eq, MASK, r.i = a.i == b.i ? -1 : 0, INT, INT)                                            \
    X(vi_not_negative, MASK, r.i = a.i >= 0 ? -1 : 0, INT)                                         \
    X(vf_select, FLOAT, r = a.i ? b : c, MASK, FLOAT, FLOAT)                                       \
    X(vi_select, INT, r = a.i ? b : c, MASK, INT, INT)                                             \
    X(vf_min, FLOAT, r = a.f < b.f ? a : b, FLOAT, FLOAT)                                          \
    X(vf_max, FLOAT, r = a.f > b.f ? a : b, FLOAT, FLOAT)                                          \
    X(vi_min, INT, r = a.i < b.i ? a : b, INT, INT)                                                \
    X(vi_max, INT, r = a.i > b.i ? a : b, INT, INT)                                                \
    X(vf_sqrt, ANY_NAN, r.f = (float)sqrt((double)a.f), FLOAT)                                     \
    X(vf_abs, FLOAT, r.f = copysignf(a.f, 1.0f), FLOAT)                                            \
    X(vf_floor, FLOAT, r.f = isnan(a.f) ? a.f : floorf(a.f), FLOAT)                                \
    X(vi_dot16, INT, r.i = signed_low(a) * signed_low(b) + signed_high(a) * signed_high(b), INT,   \
      INT)                                                                                         \
    X(vu_mulhi16, INT,                                                                             \
      r.u = high_of_product(a.u >> 16, b.u >> 16) << 16 |                                          \
            high_of_product(a.u & 0xffff, b.u & 0xffff),                                           \
      INT, INT)                                                                                    \
    X(vu_dot16, INT, r.u = (a.u & 0xffff) * (b.u & 0xffff) + (a.u >> 16) * (b.u >> 16), HALVES_15, \
      HALVES_15 | SAME)                                                                            \
    X(vd_splat, DOUBLE, r = a, WHOLE | SAME)                                                       \
    X(hi_splat, INT, r = a, INT | SAME)                                                            \
    X(vd_from_int, DOUBLE, r.d = (double)a.i, INT)                                                 \
    X(vd_from_float, DOUBLE, r.d = (double)a.f, FLOAT)                                             \
    X(hf_from_double, ANY_NAN, r.f = (float)a.d, DOUBLE)                                           \
    X(vd_abs, DOUBLE, r.d = copysign(a.d, 1.0), DOUBLE)                                            \
    X(vl_from_whole, LONG, r.l = (int64_t)a.d, WHOLE)                                              \
    X(vd_select, DOUBLE, r = a.l ? b : c, LONG_MASK, DOUBLE, DOUBLE)                               \
    X(hi_cross, INT, r.u = a.u * b.u - c.u * d.u, INT, INT, INT, INT)                              \
    X(hi_select, INT, r = a.i ? b : c, MASK, INT, INT)                                             \
    X(hi_min, INT, r = a.i < b.i ? a : b, INT, INT)                                                \
    X(hi_max, INT, r = a.i > b.i ? a : b, INT, INT)                                                \
    X(hf_select, FLOAT, r = a.i ? b : c, MASK, FLOAT, FLOAT)                                       \
    X(hi_condition, MASK, r.i = a.l ? -1 : 0, LONG_MASK)                                           \
    X(vl_condition, LONG_MASK, r.l = a.i ? -1 : 0, MASK)                                           \
    X(vl_pair, LONG, r.l = (int64_t)((uint64_t)b.u << 32 | a.u), INT, INT)

#define LANE_FORMULA(name, result, formula, ...)                                                   \
    static Lane expected_##name(Lane a, Lane b, Lane c, Lane d) {                                  \
        Lane r = {.l = 0};                                                                         \
        (void)a, (void)b, (void)c, (void)d;                                                        \
        formula;                                                                                   \
        return r;                                                                                  \
    }
LANE_LIST(LANE_FORMULA)

typedef struct LaneTest {
    SimdCall function;
    Values result;
    Lane (*expected)(Lane a, Lane b, Lane c, Lane d);
    Values arguments[4];
} LaneTest;

static const LaneTest lane_tests[] = {
#define LANE_TEST(name, result, formula, ...) {SIMD_##name, result, expected_##name, {__VA_ARGS__}},
    LANE_LIST(LANE_TEST)
#undef LANE_TEST
};

static Lane lane_of(const void *values, Values kind, int i) {
    Lane lane = {.l = 0};
    const size_t size = value_bytes(kind);
    memcpy(&lane, (const char *)values + (size_t)i * size, size);
    return lane;
}

// Returns whether a result is right to the bit, or as right as its kind can tell.
static bool is_equal(Lane found, Lane expected, Values kind) {
    if (kind == ANY_NAN && isnan(expected.f)) {
        return isnan(found.f);
    }
    return found.l == expected.l;
}

static void check_lanes(const LaneTest *test, const SimdSet *set, Random *random) {
    const int count = test->function >= SIMD_vd_splat ? set->half_lanes : set->lanes;
    void *in[4] = {NULL};
    for (int k = 0; k < 4 && test->arguments[k] != NOTHING; k++) {
        in[k] = exact_values(random, test->arguments[k], count);
        const size_t size = value_bytes(test->arguments[k]);
        for (int i = 0; i < count && k && test->arguments[k] == test->arguments[0]; i++) {
            if (random_int(random, 0, 7) == 0) { // equal values, also where they are rare
                memcpy((char *)in[k] + (size_t)i * size, (char *)in[0] + (size_t)i * size, size);
            }
        }
    }
    const size_t size = value_bytes(test->result);
    void *out = exact_memory(random, (size_t)count * size, size);
    simd_call_with(set, test->function, (const void *const *)in, out);
    for (int i = 0; i < count; i++) {
        Lane x[4] = {{.l = 0}};
        for (int k = 0; k < 4 && in[k]; k++) {
            x[k] = lane_of(in[k], test->arguments[k], i);
        }
        const Lane found = lane_of(out, test->result, i);
        const Lane expected = test->expected(x[0], x[1], x[2], x[3]);
        if (!is_equal(found, expected, test->result)) {
            fail_msg("%s, %s, lane %d: %llx of %llx, %llx, %llx, %llx; expected %llx",
                     simd_call_name(test->function), dip_isa_name(set->isa), i,
                     (unsigned long long)found.l, (unsigned long long)x[0].l,
                     (unsigned long long)x[1].l, (unsigned long long)x[2].l,
                     (unsigned long long)x[3].l, (unsigned long long)expected.l);
        }
    }
}

static void check_all_lanes(const SimdSet *set, Random *random) {
    for (size_t t = 0; t < DIP_ARRAY_COUNT(lane_tests); t++) {
        check_lanes(&lane_tests[t], set, random);
        free_exact_memory();
    }
}

static void each_lane_is_computed_from_its_arguments(void **state) {
    (void)state;
    simd_for_each_set(check_all_lanes);
}

// --- functions that return a number ------------------------------------------------------------

// As X(function, kind of the argument, formula). For each lane v[i] of n, the formula updates r,
// which begins as 0.
#define NUMBER_LIST(X)                                                                             \
    X(mask_bits, MASK, r |= (v[i] != 0) << i)                                                      \
    X(mask_any, MASK, r |= v[i] != 0)                                                              \
    X(all_lanes, INT, r |= 1 << i)                                                                 \
    X(vi_greatest, INT, r = i == 0 || v[i] > r ? v[i] : r)                                         \
    X(vi_sum, SMALL_INT, r += v[i])                                                                \
    X(hi_mask_bits, MASK, r |= (v[i] != 0) << i)

static void check_numbers(const SimdSet *set, Random *random) {
#define CHECK_NUMBER(name, kind, formula)                                                          \
    {                                                                                              \
        const int n = SIMD_##name == SIMD_hi_mask_bits ? set->half_lanes : set->lanes;             \
        const int32_t *v = exact_values(random, kind, n);                                          \
        int r = 0;                                                                                 \
        for (int i = 0; i < n; i++) {                                                              \
            formula;                                                                               \
        }                                                                                          \
        assert_int_equal(simd_call(set, SIMD_##name, v, NULL, NULL, NULL), r);                     \
    }
    NUMBER_LIST(CHECK_NUMBER)
#undef CHECK_NUMBER
}

static void numbers_are_found_from_all_lanes(void **state) {
    (void)state;
    simd_for_each_set(check_numbers);
}

// --- logarithms and powers ---------------------------------------------------------------------

// Calls a function and checks that it gives the same bits as the scalar one.
static void call_power(const SimdSet *set, SimdCall function, const float *x, float *out) {
    simd_call(set, function, x, NULL, NULL, out);
    for (int i = 0; i < set->lanes; i++) {
        float scalar;
        simd_call(&simd_sets[DIP_ISA_SCALAR], function, &x[i], NULL, NULL, &scalar);
        assert_memory_equal(&out[i], &scalar, sizeof scalar);
    }
}

static void check_log2(const SimdSet *set, Random *random) {
    float out[SIMD_LANES_MAX];
    float *x = exact_values(random, POSITIVE, set->lanes);
    call_power(set, SIMD_log2_of, x, out);
    for (int i = 0; i < set->lanes; i++) {
        assert_true(fabs((double)out[i] - log2((double)x[i])) < 1.4e-5);
    }
    float before[SIMD_LANES_MAX];
    memcpy(before, out, sizeof out);
    for (int i = 0; i < set->lanes; i++) {
        x[i] = x[i] < FLT_MAX ? nextafterf(x[i], FLT_MAX) : x[i];
    }
    call_power(set, SIMD_log2_of, x, out);
    for (int i = 0; i < set->lanes; i++) {
        assert_true(before[i] <= out[i]);
    }
    for (int i = 0; i < set->lanes; i++) {
        before[i] = (float)random_int(random, -126, 127);
        x[i] = ldexpf(1.0f, (int)before[i]);
    }
    call_power(set, SIMD_log2_of, x, out);
    assert_memory_equal(out, before, (size_t)set->lanes * sizeof *out);
}

static void log2_is_exact_at_powers_of_two_and_close_and_monotone_elsewhere(void **state) {
    (void)state;
    simd_for_each_set(check_log2);
}

static void check_exp2(const SimdSet *set, Random *random) {
    float out[SIMD_LANES_MAX];
    float *x = exact_memory(random, (size_t)set->lanes * sizeof *x, sizeof *x);
    for (int i = 0; i < set->lanes; i++) {
        const int whole = random_int(random, -140, 140);
        x[i] = (float)random_real(random, -130.0, 130.0);
        switch (random_int(random, 0, 3)) {
        case 0:
            x[i] = (float)whole;
            break;
        case 1:
            x[i] = nextafterf((float)whole, x[i]);
            break;
        case 2:
            fill_values(random, INT_FLOAT, &x[i], 1);
            break;
        default:
            break;
        }
    }
    x[0] = random_int(random, 0, 9) ? x[0] : copysignf(INFINITY, x[0]);
    call_power(set, SIMD_exp2_of, x, out);
    for (int i = 0; i < set->lanes; i++) {
        const double expected = exp2(fmin(fmax((double)x[i], -126.0), 126.0));
        const bool exact = fabsf(x[i]) >= 126.0f || x[i] == floorf(x[i]);
        const double error = fabs((double)out[i] / expected - 1.0);
        assert_true(exact ? error == 0.0 : error < 6e-7);
    }
}

static void exp2_is_exact_at_whole_numbers_and_limits_and_close_elsewhere(void **state) {
    (void)state;
    simd_for_each_set(check_exp2);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_lane_is_computed_from_its_arguments),
        cmocka_unit_test(numbers_are_found_from_all_lanes),
        cmocka_unit_test(log2_is_exact_at_powers_of_two_and_close_and_monotone_elsewhere),
        cmocka_unit_test(exp2_is_exact_at_whole_numbers_and_limits_and_close_elsewhere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
