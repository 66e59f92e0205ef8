// Lets a test call the functions of renderer/simd/, compiled for any instruction set, on arrays.
#ifndef DIP_TESTS_RENDERER_SIMD_SIMD_CALLS_H
#define DIP_TESTS_RENDERER_SIMD_SIMD_CALLS_H

#include "renderer/catalogue/random.h"
#include "renderer/simd/kernel_table.h"

// The calls, as X(name). A call has the name of the function that it calls. Functions whose vectors
// have an order that only their header knows are called together, under the name of the last one.
#define SIMD_CALL_LIST(X)                                                                          \
    X(vf_load)                                                                                     \
    X(vi_load)                                                                                     \
    X(vu_store)                                                                                    \
    X(vf_splat)                                                                                    \
    X(vi_splat)                                                                                    \
    X(vu_splat)                                                                                    \
    X(vf_from_int)                                                                                 \
    X(vi_from_float)                                                                               \
    X(vi_bits)                                                                                     \
    X(vf_bits)                                                                                     \
    X(vf_lt)                                                                                       \
    X(vi_lt)                                                                                       \
    X(vi_eq)                                                                                       \
    X(vi_not_negative)                                                                             \
    X(vf_select)                                                                                   \
    X(vi_select)                                                                                   \
    X(vf_min)                                                                                      \
    X(vf_max)                                                                                      \
    X(vi_min)                                                                                      \
    X(vi_max)                                                                                      \
    X(vf_sqrt)                                                                                     \
    X(vf_abs)                                                                                      \
    X(vf_floor)                                                                                    \
    X(vi_dot16)                                                                                    \
    X(vu_mulhi16)                                                                                  \
    X(vu_dot16)                                                                                    \
    X(vi_iota)                                                                                     \
    X(log2_of)                                                                                     \
    X(exp2_of)                                                                                     \
    /* Functions that return a number. */                                                          \
    X(mask_bits)                                                                                   \
    X(mask_any)                                                                                    \
    X(all_lanes) /* VEC_ALL_LANES */                                                               \
    X(vi_greatest)                                                                                 \
    X(vi_sum)                                                                                      \
    X(hi_mask_bits)                                                                                \
    X(bits_at)                                                                                     \
    /* Functions that read and write memory. */                                                    \
    X(vf_gather)                                                                                   \
    X(vi_gather)                                                                                   \
    X(vi_load_bytes)                                                                               \
    X(vf_store_lanes)                                                                              \
    X(vi_store_lanes)                                                                              \
    X(vi_lookup16)                                                                                 \
    X(vi_lookup32)                                                                                 \
    X(vf_lookup16)                                                                                 \
    X(vu_gather_bytes)                                                                             \
    X(vu_srgb_codes)                                                                               \
    X(vu_compress)                                                                                 \
    X(vf_expand)                                                                                   \
    X(hi_load)                                                                                     \
    X(hi_load_bytes)                                                                               \
    X(hi_gather)                                                                                   \
    X(hf_gather)                                                                                   \
    X(hi_store_packed)                                                                             \
    X(vl_store_rows)                                                                               \
    X(vu_gather_pairs) /* left values, then right values */                                        \
    X(vf_split_quads)  /* four vectors of values */                                                \
    X(vu_quad_sum)                                                                                 \
    X(vu_quad_weights) /* four vectors of values */                                                \
    /* Functions that compute with half vectors, from vd_splat on. */                              \
    X(vd_splat)                                                                                    \
    X(hi_splat)                                                                                    \
    X(vd_from_int)                                                                                 \
    X(vd_from_float)                                                                               \
    X(hf_from_double)                                                                              \
    X(vd_abs)                                                                                      \
    X(vl_from_whole)                                                                               \
    X(vd_select)                                                                                   \
    X(hi_cross)                                                                                    \
    X(hi_select)                                                                                   \
    X(hi_min)                                                                                      \
    X(hi_max)                                                                                      \
    X(hf_select)                                                                                   \
    X(hi_condition)                                                                                \
    X(vl_condition)                                                                                \
    X(vl_pair)

typedef enum SimdCall {
#define SIMD_CALL_ENUM(name) SIMD_##name,
    SIMD_CALL_LIST(SIMD_CALL_ENUM)
#undef SIMD_CALL_ENUM
        SIMD_CALL_COUNT
} SimdCall;

// dip_kernel_simd_call calls a function. in[i] is the function's argument i if that is a pointer
// to read from; otherwise it points to the argument's lanes or to its value. Lanes of masks are 0
// or -1. The function's vector goes to `out`, lane by lane, unless the function itself writes to
// `out`. Returns the function's result if it is a number, otherwise 0.
#define SIMD_KERNEL_LIST(X)                                                                        \
    X(int, dip_kernel_simd_call, (SimdCall call, const void *const in[4], void *out))

typedef struct SimdKernels {
    SIMD_KERNEL_LIST(DIP_KERNEL_FIELD)
} SimdKernels;

DIP_KERNELS_DECLARE(SIMD_KERNEL_LIST)

// An instruction set and the numbers of its lanes.
typedef struct SimdSet {
    DipIsa isa;
    int lanes;
    int half_lanes; // of a half vector (half.h)
} SimdSet;

enum { SIMD_LANES_MAX = 16 };

// All instruction sets. The index is a DipIsa.
extern const SimdSet simd_sets[DIP_ISA_COUNT];

// Calls a function with up to three arguments, as dip_kernel_simd_call does. This machine must have
// the instruction set.
int simd_call(const SimdSet *set, SimdCall function, const void *in0, const void *in1,
              const void *in2, void *out);

// As simd_call, with four arguments.
int simd_call_with(const SimdSet *set, SimdCall function, const void *const in[4], void *out);

// Calls a check for each instruction set that this machine has, again and again, so that it sees
// thousands of lanes. Frees all exact_memory (values.h) after each call.
void simd_for_each_set(void (*check)(const SimdSet *set, Random *random));

// Returns the name that SIMD_CALL_LIST gives a call. Static storage.
const char *simd_call_name(SimdCall call);

#endif
