// Vectors of pairs: each lane has two values that are neighbours in memory, for example two texels.
// Also operations on the 16-bit halves of lanes.
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

// Multiplies the unsigned 16-bit halves of a and b and returns the upper 16 bits of each product.
VEC_INLINE Vu vu_mulhi16(Vu a, Vu b) {
#if VEC_AVX512
    return (Vu)_mm512_mulhi_epu16((__m512i)a, (__m512i)b);
#elif VEC_AVX2
    return (Vu)_mm256_mulhi_epu16((__m256i)a, (__m256i)b);
#elif VEC_SSE2
    return (Vu)_mm_mulhi_epu16((__m128i)a, (__m128i)b);
#else
    return ((a & 0xffffu) * (b & 0xffffu)) >> 16 | (((a >> 16) * (b >> 16)) & 0xffff0000u);
#endif
}

// Multiplies the lower 16-bit half of each lane of a by the lower half of b, and the upper half by
// the upper half. Returns the sum of both products. All halves must be below 2^15.
VEC_INLINE Vu vu_dot16(Vu a, uint32_t b) {
#if VEC_AVX512
    return (Vu)_mm512_madd_epi16((__m512i)a, (__m512i)vu_splat(b));
#elif VEC_AVX2
    return (Vu)_mm256_madd_epi16((__m256i)a, (__m256i)vu_splat(b));
#elif VEC_SSE2
    return (Vu)_mm_madd_epi16((__m128i)a, (__m128i)vu_splat(b));
#else
    return (a & 0xffffu) * (b & 0xffffu) + (a >> 16) * (b >> 16);
#endif
}

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

// Returns pairs in which the left and the right value are both the lane's value.
VEC_INLINE VuPair vu_pair_same(Vu v) {
#if VEC_AVX512
    return (VuPair){(Vu)_mm512_unpacklo_epi32((__m512i)v, (__m512i)v),
                    (Vu)_mm512_unpackhi_epi32((__m512i)v, (__m512i)v)};
#elif VEC_AVX2
    return (VuPair){(Vu)_mm256_unpacklo_epi32((__m256i)v, (__m256i)v),
                    (Vu)_mm256_unpackhi_epi32((__m256i)v, (__m256i)v)};
#elif VEC_SSE2
    return (VuPair){(Vu)_mm_unpacklo_epi32((__m128i)v, (__m128i)v),
                    (Vu)_mm_unpackhi_epi32((__m128i)v, (__m128i)v)};
#else
    return (VuPair){v, v};
#endif
}

// Returns pairs in which the left and the right value are equal. Each 16-bit half of these values
// is 256 times the lane's lowest byte.
VEC_INLINE VuPair vu_pair_both(Vi v) {
#if VEC_AVX512 || VEC_AVX2
    const __m128i spread_a = _mm_set_epi8(4, -1, 4, -1, 4, -1, 4, -1, 0, -1, 0, -1, 0, -1, 0, -1);
    const __m128i spread_b =
        _mm_set_epi8(12, -1, 12, -1, 12, -1, 12, -1, 8, -1, 8, -1, 8, -1, 8, -1);
#endif
#if VEC_AVX512
    return (VuPair){(Vu)_mm512_shuffle_epi8((__m512i)v, _mm512_broadcast_i32x4(spread_a)),
                    (Vu)_mm512_shuffle_epi8((__m512i)v, _mm512_broadcast_i32x4(spread_b))};
#elif VEC_AVX2
    return (VuPair){(Vu)_mm256_shuffle_epi8((__m256i)v, _mm256_broadcastsi128_si256(spread_a)),
                    (Vu)_mm256_shuffle_epi8((__m256i)v, _mm256_broadcastsi128_si256(spread_b))};
#else
    const Vu byte = ((Vu)v & 0xffu) << 8;
    return vu_pair_same(byte | byte << 16);
#endif
}

// Returns the 16-bit weights of a blend from left to right. The right weights are the values of
// vu_pair_both; the left weights are their bitwise complement. A left and a right weight sum to
// 65535.
VEC_INLINE VuPair vu_pair_ramp(Vi v) {
    const VuPair both = vu_pair_both(v);
#if VEC_AVX512
    const Vu left = (Vu)_mm512_set1_epi64(0xffffffff);
#elif VEC_AVX2
    const Vu left = (Vu)_mm256_set1_epi64x(0xffffffff);
#elif VEC_SSE2
    const Vu left = (Vu)_mm_set1_epi64x(0xffffffff);
#else
    return (VuPair){~both.a, both.b};
#endif
#if VEC_AVX512 || VEC_AVX2 || VEC_SSE2
    return (VuPair){both.a ^ left, both.b ^ left};
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

// Returns the sum of each lane's left and right value, in the order of lanes.
VEC_INLINE Vu vu_pair_sum(VuPair pair) {
    return vu_pair_left(pair) + vu_pair_right(pair);
}

#endif
