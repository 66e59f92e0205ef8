// Vectors of quads: each lane has four 32-bit values that are neighbours in memory. A texture keeps
// the texels of a bilinear read in this way, column by column: upper left, lower left, upper right,
// lower right.
//
// Four vectors, numbered k = 0..3, hold the quads of all lanes. With SSE2, AVX2 and AVX-512, which
// load a quad at once, its values stay side by side: the 128-bit part p of vector k holds the quad
// of lane 4 p + k. With other instruction sets, vector k holds the value k of every lane's quad.
// Only the functions of this file depend on this difference.
#ifndef DIP_RENDERER_SIMD_QUADS_H
#define DIP_RENDERER_SIMD_QUADS_H

#include "renderer/simd/vec.h"

#if VEC_AVX512 || VEC_AVX2 || VEC_SSE2
VEC_INLINE __m128i vec_load_quad(const uint32_t *base, size_t stride, int32_t index) {
    return _mm_loadu_si128((const __m128i *)(const void *)(base + stride * (uint32_t)index));
}
#endif

// Returns vector k of the quads that start at base[stride * index[lane]]. Indices are 0 or more.
VEC_INLINE Vu vu_load_quads(const uint32_t *base, size_t stride, const int32_t index[DIP_LANES],
                            int k) {
#if VEC_AVX512
    const __m256i low =
        _mm256_inserti128_si256(_mm256_castsi128_si256(vec_load_quad(base, stride, index[k])),
                                vec_load_quad(base, stride, index[k + 4]), 1);
    const __m256i high =
        _mm256_inserti128_si256(_mm256_castsi128_si256(vec_load_quad(base, stride, index[k + 8])),
                                vec_load_quad(base, stride, index[k + 12]), 1);
    return (Vu)_mm512_inserti64x4(_mm512_castsi256_si512(low), high, 1);
#elif VEC_AVX2
    return (Vu)_mm256_inserti128_si256(
        _mm256_castsi128_si256(vec_load_quad(base, stride, index[k])),
        vec_load_quad(base, stride, index[k + 4]), 1);
#elif VEC_SSE2
    return (Vu)vec_load_quad(base, stride, index[k]);
#else
    Vu v;
    for (int i = 0; i < DIP_LANES; i++) {
        v[i] = base[stride * (uint32_t)index[i] + (size_t)k];
    }
    return v;
#endif
}

// Returns the 16-bit weights for vector k, each of them in both halves of its value. A lane of
// `left` has the weight of the upper left value in its lower half and the weight of the lower left
// value in its upper half; `right` likewise.
VEC_INLINE Vu vu_quad_weights(Vu left, Vu right, int k) {
#if VEC_AVX512
    const __m512i a = (__m512i)left, b = (__m512i)right;
    const __m512i both = k < 2 ? _mm512_unpacklo_epi32(a, b) : _mm512_unpackhi_epi32(a, b);
    return (Vu)(k & 1 ? _mm512_unpackhi_epi16(both, both) : _mm512_unpacklo_epi16(both, both));
#elif VEC_AVX2
    const __m256i a = (__m256i)left, b = (__m256i)right;
    const __m256i both = k < 2 ? _mm256_unpacklo_epi32(a, b) : _mm256_unpackhi_epi32(a, b);
    return (Vu)(k & 1 ? _mm256_unpackhi_epi16(both, both) : _mm256_unpacklo_epi16(both, both));
#elif VEC_SSE2
    const __m128i a = (__m128i)left, b = (__m128i)right;
    const __m128i both = k < 2 ? _mm_unpacklo_epi32(a, b) : _mm_unpackhi_epi32(a, b);
    return (Vu)(k & 1 ? _mm_unpackhi_epi16(both, both) : _mm_unpacklo_epi16(both, both));
#else
    const Vu column = k < 2 ? left : right;
    return k & 1 ? (column >> 16) | (column & 0xffff0000u) : (column & 0xffffu) | column << 16;
#endif
}

#if VEC_AVX512 || VEC_AVX2 || VEC_SSE2
// Returns the values of a and b in turn, from the lower or upper half of each 128-bit part.
VEC_INLINE Vf vf_interleave(Vf a, Vf b, bool upper) {
#if VEC_AVX512
    const __m512 v = (__m512)a, w = (__m512)b;
    return (Vf)(upper ? _mm512_unpackhi_ps(v, w) : _mm512_unpacklo_ps(v, w));
#elif VEC_AVX2
    const __m256 v = (__m256)a, w = (__m256)b;
    return (Vf)(upper ? _mm256_unpackhi_ps(v, w) : _mm256_unpacklo_ps(v, w));
#else
    const __m128 v = (__m128)a, w = (__m128)b;
    return (Vf)(upper ? _mm_unpackhi_ps(v, w) : _mm_unpacklo_ps(v, w));
#endif
}

// Returns the lower or upper half of each 128-bit part of a, followed by that of b.
VEC_INLINE Vf vf_join_halves(Vf a, Vf b, bool upper) {
#if VEC_AVX512
    const __m512 v = (__m512)a, w = (__m512)b;
    return (Vf)(upper ? _mm512_shuffle_ps(v, w, 0xee) : _mm512_shuffle_ps(v, w, 0x44));
#elif VEC_AVX2
    const __m256 v = (__m256)a, w = (__m256)b;
    return (Vf)(upper ? _mm256_shuffle_ps(v, w, 0xee) : _mm256_shuffle_ps(v, w, 0x44));
#else
    const __m128 v = (__m128)a, w = (__m128)b;
    return (Vf)(upper ? _mm_shuffle_ps(v, w, 0xee) : _mm_shuffle_ps(v, w, 0x44));
#endif
}
#endif

// Takes quads of floats apart: values[i] gets the value i of every lane's quad, in the order of
// lanes.
VEC_INLINE void vf_split_quads(const Vu quads[4], Vf values[4]) {
#if VEC_AVX512 || VEC_AVX2 || VEC_SSE2
    for (int half = 0; half < 2; half++) {
        const Vf ab = vf_interleave((Vf)quads[0], (Vf)quads[1], half);
        const Vf cd = vf_interleave((Vf)quads[2], (Vf)quads[3], half);
        values[2 * half] = vf_join_halves(ab, cd, false);
        values[2 * half + 1] = vf_join_halves(ab, cd, true);
    }
#else
    for (int i = 0; i < 4; i++) {
        values[i] = (Vf)quads[i];
    }
#endif
}

// Returns the sum of each lane's four values, in the order of lanes.
VEC_INLINE Vu vu_quad_sum(const Vu quads[4]) {
#if VEC_AVX512
    const __m512i a = (__m512i)quads[0], b = (__m512i)quads[1];
    const __m512i c = (__m512i)quads[2], d = (__m512i)quads[3];
    const Vu ab = (Vu)_mm512_unpacklo_epi64(a, b) + (Vu)_mm512_unpackhi_epi64(a, b);
    const Vu cd = (Vu)_mm512_unpacklo_epi64(c, d) + (Vu)_mm512_unpackhi_epi64(c, d);
    return (Vu)_mm512_shuffle_ps((__m512)ab, (__m512)cd, 0x88) +
           (Vu)_mm512_shuffle_ps((__m512)ab, (__m512)cd, 0xdd);
#elif VEC_AVX2
    const __m256i a = (__m256i)quads[0], b = (__m256i)quads[1];
    const __m256i c = (__m256i)quads[2], d = (__m256i)quads[3];
    const Vu ab = (Vu)_mm256_unpacklo_epi64(a, b) + (Vu)_mm256_unpackhi_epi64(a, b);
    const Vu cd = (Vu)_mm256_unpacklo_epi64(c, d) + (Vu)_mm256_unpackhi_epi64(c, d);
    return (Vu)_mm256_shuffle_ps((__m256)ab, (__m256)cd, 0x88) +
           (Vu)_mm256_shuffle_ps((__m256)ab, (__m256)cd, 0xdd);
#elif VEC_SSE2
    const __m128i a = (__m128i)quads[0], b = (__m128i)quads[1];
    const __m128i c = (__m128i)quads[2], d = (__m128i)quads[3];
    const Vu ab = (Vu)_mm_unpacklo_epi64(a, b) + (Vu)_mm_unpackhi_epi64(a, b);
    const Vu cd = (Vu)_mm_unpacklo_epi64(c, d) + (Vu)_mm_unpackhi_epi64(c, d);
    return (Vu)_mm_shuffle_ps((__m128)ab, (__m128)cd, 0x88) +
           (Vu)_mm_shuffle_ps((__m128)ab, (__m128)cd, 0xdd);
#else
    return (quads[0] + quads[1]) + (quads[2] + quads[3]);
#endif
}

#endif
