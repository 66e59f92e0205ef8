// Half vectors: vectors of doubles and 64-bit integers for triangle set-up, in addition to the
// vectors of vec.h.
#ifndef DIP_RENDERER_SIMD_HALF_H
#define DIP_RENDERER_SIMD_HALF_H

#include "renderer/simd/vec.h"

// clang's memory sanitizer takes a lane of _mm512_permutex2var_* as unwritten if any operand has an
// unwritten lane at the same place, wherever the lane's value comes from. With the sanitizer, plain
// code does the same.
#if defined(__has_feature)
#if __has_feature(memory_sanitizer)
#define VEC_NO_PERMUTE2 1
#endif
#endif

// --- half vectors ------------------------------------------------------------------------------

// The number of lanes of a half vector is the number of doubles that fit into a vector of vec.h. Vd
// and Vl have lanes of 64 bits; Hf, Hi and Hu have the same number of lanes of 32 bits. If a half
// vector has two lanes, the 32-bit types have two further lanes; the load functions set them to 0,
// and no code uses them. A condition is a vector with 0 (false) or -1 (true) per lane; comparisons
// return it.
enum { DIP_HALF_LANES = DIP_LANES > 1 ? DIP_LANES / 2 : 1 };

#define VEC_HALF_BYTES (DIP_LANES == 4 ? 16 : 4 * (DIP_LANES > 1 ? DIP_LANES / 2 : 1))

typedef double Vd __attribute__((vector_size(8 * DIP_HALF_LANES)));
typedef int64_t Vl __attribute__((vector_size(8 * DIP_HALF_LANES)));
typedef float Hf __attribute__((vector_size(VEC_HALF_BYTES)));
typedef int32_t Hi __attribute__((vector_size(VEC_HALF_BYTES)));
typedef uint32_t Hu __attribute__((vector_size(VEC_HALF_BYTES)));

VEC_INLINE Vd vd_splat(double x) {
    return x - (Vd){0};
}

VEC_INLINE Hi hi_splat(int32_t x) {
    return x - (Hi){0};
}

VEC_INLINE Hi hi_load(const int32_t *p) {
    Hi v = {0};
    memcpy(&v, p, DIP_HALF_LANES * sizeof *p);
    return v;
}

VEC_INLINE Hi hi_load_bytes(const uint8_t *p) {
#if VEC_AVX512
    return (Hi)_mm256_cvtepu8_epi32(_mm_loadl_epi64((const __m128i *)(const void *)p));
#elif VEC_AVX2
    return (Hi)_mm_cvtepu8_epi32(_mm_loadu_si32(p));
#else
    Hi v = {0};
    for (int i = 0; i < DIP_HALF_LANES; i++) {
        v[i] = p[i];
    }
    return v;
#endif
}

VEC_INLINE Vd vd_from_int(Hi v) {
#if VEC_AVX512
    return (Vd)_mm512_cvtepi32_pd((__m256i)v);
#elif VEC_AVX2
    return (Vd)_mm256_cvtepi32_pd((__m128i)v);
#elif VEC_SSE2
    return (Vd)_mm_cvtepi32_pd((__m128i)v);
#else
    Vd wide = {0};
    for (int i = 0; i < DIP_HALF_LANES; i++) {
        wide[i] = v[i];
    }
    return wide;
#endif
}

VEC_INLINE Vd vd_from_float(Hf v) {
#if VEC_AVX512
    return (Vd)_mm512_cvtps_pd((__m256)v);
#elif VEC_AVX2
    return (Vd)_mm256_cvtps_pd((__m128)v);
#elif VEC_SSE2
    return (Vd)_mm_cvtps_pd((__m128)v);
#else
    Vd wide = {0};
    for (int i = 0; i < DIP_HALF_LANES; i++) {
        wide[i] = (double)v[i];
    }
    return wide;
#endif
}

VEC_INLINE Hf hf_from_double(Vd v) {
#if VEC_AVX512
    return (Hf)_mm512_cvtpd_ps((__m512d)v);
#elif VEC_AVX2
    return (Hf)_mm256_cvtpd_ps((__m256d)v);
#elif VEC_SSE2
    return (Hf)_mm_cvtpd_ps((__m128d)v);
#else
    Hf narrow = {0};
    for (int i = 0; i < DIP_HALF_LANES; i++) {
        narrow[i] = (float)v[i];
    }
    return narrow;
#endif
}

VEC_INLINE Vd vd_abs(Vd v) {
    return (Vd)((Vl)v & INT64_MAX);
}

// Converts whole numbers v, |v| < 2^51, to integers. Adding 1.5 * 2^52 moves a whole number into
// the low bits of the double.
VEC_INLINE Vl vl_from_whole(Vd v) {
    const Vd shift = vd_splat(6755399441055744.0);
    return (Vl)(v + shift) - (Vl)shift;
}

VEC_INLINE Vd vd_select(Vl m, Vd a, Vd b) {
#if VEC_AVX2
    return (Vd)_mm256_blendv_pd((__m256d)b, (__m256d)a, (__m256d)m);
#else
    return (Vd)(((Vl)a & m) | ((Vl)b & ~m));
#endif
}

// Returns a * b - c * d modulo 2^32.
VEC_INLINE Hi hi_cross(Hi a, Hi b, Hi c, Hi d) {
    return (Hi)((Hu)a * (Hu)b - (Hu)c * (Hu)d);
}

VEC_INLINE Hi hi_select(Hi m, Hi a, Hi b) {
    return (a & m) | (b & ~m);
}

VEC_INLINE Hi hi_min(Hi a, Hi b) {
    return hi_select(a < b, a, b);
}

VEC_INLINE Hi hi_max(Hi a, Hi b) {
    return hi_select(a > b, a, b);
}

VEC_INLINE Hf hf_select(Hi m, Hf a, Hf b) {
    return (Hf)hi_select(m, (Hi)a, (Hi)b);
}

// Narrows a condition from 64-bit to 32-bit lanes.
VEC_INLINE Hi hi_condition(Vl m) {
#if VEC_AVX512
    return (Hi)_mm512_cvtepi64_epi32((__m512i)m);
#elif VEC_AVX2
    return __builtin_convertvector(m, Hi);
#else
    Hi narrow = {0};
    for (int i = 0; i < DIP_HALF_LANES; i++) {
        narrow[i] = (int32_t)m[i];
    }
    return narrow;
#endif
}

// Widens a condition from 32-bit to 64-bit lanes.
VEC_INLINE Vl vl_condition(Hi m) {
#if VEC_AVX512
    return (Vl)_mm512_cvtepi32_epi64((__m256i)m);
#elif VEC_AVX2
    return (Vl)_mm256_cvtepi32_epi64((__m128i)m);
#elif VEC_SSE2
    return (Vl)_mm_unpacklo_epi32((__m128i)m, (__m128i)m);
#else
    Vl wide = {0};
    for (int i = 0; i < DIP_HALF_LANES; i++) {
        wide[i] = m[i];
    }
    return wide;
#endif
}

// Returns a condition as bits: bit i is set if the condition is true in lane i.
VEC_INLINE unsigned hi_mask_bits(Hi m) {
#if VEC_AVX512
    return (unsigned)_mm256_movemask_ps((__m256)m);
#elif VEC_AVX2
    return (unsigned)_mm_movemask_ps((__m128)m);
#elif VEC_SSE2
    return (unsigned)_mm_movemask_ps((__m128)m) & 3u;
#else
    unsigned bits = 0;
    for (int i = 0; i < DIP_HALF_LANES; i++) {
        bits |= (unsigned)(m[i] & 1) << i;
    }
    return bits;
#endif
}

#if VEC_AVX512 || VEC_AVX2
VEC_INLINE __m128i vec_load_four(const int32_t *base, const int32_t index[4]) {
    const __m128i one = _mm_cvtsi32_si128(base[index[0]]);
    const __m128i two = _mm_insert_epi32(one, base[index[1]], 1);
    return _mm_insert_epi32(_mm_insert_epi32(two, base[index[2]], 2), base[index[3]], 3);
}
#endif

// Returns base[index[i]] in lane i. With AMD's Zen 4, single loads of so few lanes take less time
// than the instruction that gathers them.
VEC_INLINE Hi hi_gather(const int32_t *base, Hi index) {
#if VEC_AVX512 || VEC_AVX2
    _Alignas(VEC_HALF_BYTES) int32_t at[DIP_HALF_LANES];
    memcpy(at, &index, sizeof at);
#endif
#if VEC_AVX512
    return (Hi)_mm256_set_m128i(vec_load_four(base, at + 4), vec_load_four(base, at));
#elif VEC_AVX2
    return (Hi)vec_load_four(base, at);
#else
    Hi v = {0};
    for (int i = 0; i < DIP_HALF_LANES; i++) {
        v[i] = base[index[i]];
    }
    return v;
#endif
}

VEC_INLINE Hf hf_gather(const float *base, Hi index) {
    return (Hf)hi_gather((const int32_t *)(const void *)base, index);
}

// Stores the lanes whose bits are set in `bits` to `out`, without gaps. The function may overwrite
// a whole vector's length from `out` on.
VEC_INLINE void hi_store_packed(int32_t *out, Hi v, unsigned bits) {
#if VEC_AVX512
    v = (Hi)_mm256_maskz_compress_epi32((__mmask8)bits, (__m256i)v);
    memcpy(out, &v, sizeof v);
#else
    if (bits == (1u << DIP_HALF_LANES) - 1) {
        memcpy(out, &v, sizeof v);
        return;
    }
    for (; bits; bits &= bits - 1) {
        *out++ = v[__builtin_ctz(bits)];
    }
#endif
}

// Joins each pair of 32-bit lanes into one 64-bit lane, with `low` in the lower half.
VEC_INLINE Vl vl_pair(Hi low, Hi high) {
#if VEC_AVX512 && !VEC_NO_PERMUTE2
    const __m512i order = _mm512_set_epi32(23, 7, 22, 6, 21, 5, 20, 4, 19, 3, 18, 2, 17, 1, 16, 0);
    return (Vl)_mm512_permutex2var_epi32(_mm512_castsi256_si512((__m256i)low), order,
                                         _mm512_castsi256_si512((__m256i)high));
#elif VEC_AVX2
    return (Vl)_mm256_set_m128i(_mm_unpackhi_epi32((__m128i)low, (__m128i)high),
                                _mm_unpacklo_epi32((__m128i)low, (__m128i)high));
#elif VEC_SSE2
    return (Vl)_mm_unpacklo_epi32((__m128i)low, (__m128i)high);
#else
    Vl v = {0};
    for (int i = 0; i < DIP_HALF_LANES; i++) {
        v[i] = (int64_t)((uint64_t)(uint32_t)high[i] << 32 | (uint32_t)low[i]);
    }
    return v;
#endif
}

// Stores four 64-bit words per lane: lane i of row[0..3] goes to out + i * stride_bytes.
VEC_INLINE void vl_store_rows(void *out, size_t stride_bytes, const Vl row[4]) {
    char *at = out;
#if VEC_AVX512 && !VEC_NO_PERMUTE2
    const __m512i first = _mm512_set_epi64(13, 12, 5, 4, 9, 8, 1, 0);
    const __m512i second = _mm512_set_epi64(15, 14, 7, 6, 11, 10, 3, 2);
    const __m512i even[2] = {_mm512_unpacklo_epi64((__m512i)row[0], (__m512i)row[1]),
                             _mm512_unpacklo_epi64((__m512i)row[2], (__m512i)row[3])};
    const __m512i odd[2] = {_mm512_unpackhi_epi64((__m512i)row[0], (__m512i)row[1]),
                            _mm512_unpackhi_epi64((__m512i)row[2], (__m512i)row[3])};
    // The lower half of lanes[i] holds the four words of lane i. The upper half holds the four
    // words of lane i + 4.
    const __m512i lanes[4] = {_mm512_permutex2var_epi64(even[0], first, even[1]),
                              _mm512_permutex2var_epi64(odd[0], first, odd[1]),
                              _mm512_permutex2var_epi64(even[0], second, even[1]),
                              _mm512_permutex2var_epi64(odd[0], second, odd[1])};
    for (size_t i = 0; i < 4; i++) {
        _mm256_storeu_si256((__m256i *)(void *)(at + i * stride_bytes),
                            _mm512_castsi512_si256(lanes[i]));
        _mm256_storeu_si256((__m256i *)(void *)(at + (i + 4) * stride_bytes),
                            _mm512_extracti64x4_epi64(lanes[i], 1));
    }
#elif VEC_AVX2
    const __m256i even[2] = {_mm256_unpacklo_epi64((__m256i)row[0], (__m256i)row[1]),
                             _mm256_unpacklo_epi64((__m256i)row[2], (__m256i)row[3])};
    const __m256i odd[2] = {_mm256_unpackhi_epi64((__m256i)row[0], (__m256i)row[1]),
                            _mm256_unpackhi_epi64((__m256i)row[2], (__m256i)row[3])};
    const __m256i lanes[4] = {_mm256_permute2x128_si256(even[0], even[1], 0x20),
                              _mm256_permute2x128_si256(odd[0], odd[1], 0x20),
                              _mm256_permute2x128_si256(even[0], even[1], 0x31),
                              _mm256_permute2x128_si256(odd[0], odd[1], 0x31)};
    for (size_t i = 0; i < 4; i++) {
        _mm256_storeu_si256((__m256i *)(void *)(at + i * stride_bytes), lanes[i]);
    }
#elif VEC_SSE2
    for (size_t i = 0; i < 2; i++) {
        const __m128i a = (__m128i)row[2 * i];
        const __m128i b = (__m128i)row[2 * i + 1];
        _mm_storeu_si128((__m128i *)(void *)(at + 16 * i), _mm_unpacklo_epi64(a, b));
        _mm_storeu_si128((__m128i *)(void *)(at + 16 * i + stride_bytes), _mm_unpackhi_epi64(a, b));
    }
#else
    for (size_t i = 0; i < DIP_HALF_LANES; i++) {
        const int64_t words[4] = {row[0][i], row[1][i], row[2][i], row[3][i]};
        memcpy(at + i * stride_bytes, words, sizeof words);
    }
#endif
}

#endif
