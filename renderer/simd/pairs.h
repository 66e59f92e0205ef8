// Vectors of pairs: each lane has two values that are neighbours in memory, for example two numbers
// of a triangle's planes.
#ifndef DIP_RENDERER_SIMD_PAIRS_H
#define DIP_RENDERER_SIMD_PAIRS_H

#include "renderer/simd/vec.h"

// A left and a right value for each lane of a vector, in pair order. With SSE2, AVX2 and AVX-512,
// which load both values at once, the two values stay side by side. `a` then holds the pairs of the
// lanes in the first half of each 128-bit part, and `b` holds the pairs of the lanes in the second
// half. With other instruction sets, `a` holds the left values and `b` the right values. Only the
// functions of this file depend on this difference.
typedef struct VuPair {
    Vu a;
    Vu b;
} VuPair;

// Brings lanes into pair order. vu_gather_pairs expects its indices in this order.
VEC_INLINE Vi vi_pair_order(Vi v) {
#if VEC_AVX512
    const __m512i order = _mm512_set_epi32(15, 14, 11, 10, 7, 6, 3, 2, 13, 12, 9, 8, 5, 4, 1, 0);
    return (Vi)_mm512_permutexvar_epi32(order, (__m512i)v);
#elif VEC_AVX2
    return (Vi)_mm256_permute4x64_epi64((__m256i)v, 0xd8);
#else
    return v;
#endif
}

// Returns base[index] and base[index + 1] for each lane, fetched at once. `index` is in pair order.
VEC_INLINE VuPair vu_gather_pairs(const uint32_t *base, Vi index) {
#if VEC_AVX512
    const __m512i i = (__m512i)index;
    return (VuPair){(Vu)_mm512_i32gather_epi64(_mm512_castsi512_si256(i), base, 4),
                    (Vu)_mm512_i32gather_epi64(_mm512_extracti64x4_epi64(i, 1), base, 4)};
#elif VEC_AVX2
    const __m256i i = (__m256i)index;
    const long long *pairs = (const long long *)(const void *)base;
    return (VuPair){(Vu)_mm256_i32gather_epi64(pairs, _mm256_castsi256_si128(i), 4),
                    (Vu)_mm256_i32gather_epi64(pairs, _mm256_extracti128_si256(i, 1), 4)};
#elif VEC_SSE2
    __m128i pair[4];
    for (int i = 0; i < 4; i++) {
        pair[i] = _mm_loadl_epi64((const __m128i *)(const void *)(base + index[i]));
    }
    return (VuPair){(Vu)_mm_unpacklo_epi64(pair[0], pair[1]),
                    (Vu)_mm_unpacklo_epi64(pair[2], pair[3])};
#else
    VuPair pair;
    for (int i = 0; i < DIP_LANES; i++) {
        pair.a[i] = base[index[i]];
        pair.b[i] = base[index[i] + 1];
    }
    return pair;
#endif
}

// Returns the left values, in the order of lanes.
VEC_INLINE Vu vu_pair_left(VuPair pair) {
#if VEC_AVX512
    return (Vu)_mm512_shuffle_ps((__m512)pair.a, (__m512)pair.b, 0x88);
#elif VEC_AVX2
    return (Vu)_mm256_shuffle_ps((__m256)pair.a, (__m256)pair.b, 0x88);
#elif VEC_SSE2
    return (Vu)_mm_shuffle_ps((__m128)pair.a, (__m128)pair.b, 0x88);
#else
    return pair.a;
#endif
}

// Returns the right values, in the order of lanes.
VEC_INLINE Vu vu_pair_right(VuPair pair) {
#if VEC_AVX512
    return (Vu)_mm512_shuffle_ps((__m512)pair.a, (__m512)pair.b, 0xdd);
#elif VEC_AVX2
    return (Vu)_mm256_shuffle_ps((__m256)pair.a, (__m256)pair.b, 0xdd);
#elif VEC_SSE2
    return (Vu)_mm_shuffle_ps((__m128)pair.a, (__m128)pair.b, 0xdd);
#else
    return pair.b;
#endif
}

#endif
