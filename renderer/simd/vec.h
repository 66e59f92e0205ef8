// One vector of DIP_LANES 32-bit lanes and its operations, for the kernels (*_simd.c) only.
//
// Built on the compilers' vector extensions, so + - * / & | ^ << >> and comparisons of the element
// types work as written; intrinsics stand where an extension has no operator. Every operation is
// exact IEEE or integer arithmetic, so all widths give the same bits. A condition is a Mask: a
// bit per lane with AVX-512, a vector of 0 / -1 elsewhere.
#ifndef DIP_RENDERER_SIMD_VEC_H
#define DIP_RENDERER_SIMD_VEC_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#if !defined(DIP_LANES) || !defined(DIP_ISA_SUFFIX)
#error "kernels are compiled once per instruction set, with DIP_LANES and DIP_ISA_SUFFIX"
#endif
#if defined(DIP_EXPECT_AVX512) && !defined(__AVX512VL__)
#error "the avx512 kernels need -mavx512f -mavx512vl -mavx512dq -mavx512bw"
#elif defined(DIP_EXPECT_AVX2) && !defined(__AVX2__)
#error "the avx2 kernels need -mavx2"
#endif

#if DIP_LANES == 16 && defined(__AVX512F__)
#define VEC_AVX512 1
#include <immintrin.h>
#elif DIP_LANES == 8 && defined(__AVX2__)
#define VEC_AVX2 1
#include <immintrin.h>
#elif DIP_LANES == 4 && defined(__SSE2__)
#define VEC_SSE2 1
#include <emmintrin.h>
#endif

// dip_kernel_name -> dip_kernel_name_avx2: the exported name of this instruction set's version.
#define VEC_JOIN_(a, b)  a##_##b
#define VEC_JOIN(a, b)   VEC_JOIN_(a, b)
#define DIP_KERNEL(name) VEC_JOIN(name, DIP_ISA_SUFFIX)

typedef float Vf __attribute__((vector_size(4 * DIP_LANES)));
typedef int32_t Vi __attribute__((vector_size(4 * DIP_LANES)));
typedef uint32_t Vu __attribute__((vector_size(4 * DIP_LANES)));

#define VEC_INLINE static inline __attribute__((always_inline))

VEC_INLINE Vf vf_load(const float *p) {
    Vf v;
    memcpy(&v, p, sizeof v);
    return v;
}

VEC_INLINE void vf_store(float *p, Vf v) {
    memcpy(p, &v, sizeof v);
}

VEC_INLINE Vi vi_load(const int32_t *p) {
    Vi v;
    memcpy(&v, p, sizeof v);
    return v;
}

VEC_INLINE void vi_store(int32_t *p, Vi v) {
    memcpy(p, &v, sizeof v);
}

VEC_INLINE void vu_store(uint32_t *p, Vu v) {
    memcpy(p, &v, sizeof v);
}

VEC_INLINE Vf vf_splat(float x) {
    return x - (Vf){0};
}

VEC_INLINE Vi vi_splat(int32_t x) {
    return x - (Vi){0};
}

VEC_INLINE Vu vu_splat(uint32_t x) {
    return x - (Vu){0};
}

VEC_INLINE Vf vf_from_int(Vi v) {
    return __builtin_convertvector(v, Vf);
}

// Towards zero; every lane must be within the range of int32.
VEC_INLINE Vi vi_from_float(Vf v) {
    return __builtin_convertvector(v, Vi);
}

VEC_INLINE Vi vi_bits(Vf v) {
    return (Vi)v;
}

VEC_INLINE Vf vf_bits(Vi v) {
    return (Vf)v;
}

// --- masks -------------------------------------------------------------------------------------

#if VEC_AVX512
typedef __mmask16 Mask;

VEC_INLINE Mask vf_lt(Vf a, Vf b) {
    return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_LT_OQ);
}

VEC_INLINE Mask vi_lt(Vi a, Vi b) {
    return _mm512_cmplt_epi32_mask((__m512i)a, (__m512i)b);
}

VEC_INLINE Mask vi_eq(Vi a, Vi b) {
    return _mm512_cmpeq_epi32_mask((__m512i)a, (__m512i)b);
}

// Lanes whose sign bit is clear.
VEC_INLINE Mask vi_not_negative(Vi a) {
    return (Mask)~_mm512_movepi32_mask((__m512i)a);
}

VEC_INLINE unsigned mask_bits(Mask m) {
    return m;
}

VEC_INLINE Mask mask_from_bits(unsigned bits) {
    return (Mask)bits;
}

VEC_INLINE Vf vf_select(Mask m, Vf a, Vf b) {
    return (Vf)_mm512_mask_blend_ps(m, (__m512)b, (__m512)a);
}

VEC_INLINE Vi vi_select(Mask m, Vi a, Vi b) {
    return (Vi)_mm512_mask_blend_epi32(m, (__m512i)b, (__m512i)a);
}
#else
typedef Vi Mask;

VEC_INLINE Mask vf_lt(Vf a, Vf b) {
    return a < b;
}

VEC_INLINE Mask vi_lt(Vi a, Vi b) {
    return a < b;
}

VEC_INLINE Mask vi_eq(Vi a, Vi b) {
    return a == b;
}

VEC_INLINE Mask vi_not_negative(Vi a) {
    return a >= 0;
}

VEC_INLINE unsigned mask_bits(Mask m) {
#if VEC_AVX2
    return (unsigned)_mm256_movemask_ps((__m256)m);
#elif VEC_SSE2
    return (unsigned)_mm_movemask_ps((__m128)m);
#else
    unsigned bits = 0;
    for (int i = 0; i < DIP_LANES; i++) {
        bits |= (unsigned)(m[i] & 1) << i;
    }
    return bits;
#endif
}

VEC_INLINE Mask mask_from_bits(unsigned bits) {
    Vi lane_bit;
    for (int i = 0; i < DIP_LANES; i++) {
        lane_bit[i] = 1 << i;
    }
    return (vi_splat((int32_t)bits) & lane_bit) != 0;
}

VEC_INLINE Vf vf_select(Mask m, Vf a, Vf b) {
#if VEC_AVX2
    return (Vf)_mm256_blendv_ps((__m256)b, (__m256)a, (__m256)m);
#else
    return (Vf)(((Vi)a & m) | ((Vi)b & ~m));
#endif
}

VEC_INLINE Vi vi_select(Mask m, Vi a, Vi b) {
#if VEC_AVX2
    return (Vi)_mm256_blendv_ps((__m256)b, (__m256)a, (__m256)m);
#else
    return (a & m) | (b & ~m);
#endif
}
#endif

VEC_INLINE bool mask_any(Mask m) {
    return mask_bits(m) != 0;
}

#define VEC_ALL_LANES ((1u << (DIP_LANES - 1) << 1) - 1u)

VEC_INLINE bool mask_all(Mask m) {
    return mask_bits(m) == VEC_ALL_LANES;
}

// --- min, max, sqrt, floor ---------------------------------------------------------------------

// a < b ? a : b, so b where either is NaN.
VEC_INLINE Vf vf_min(Vf a, Vf b) {
#if VEC_AVX512
    return (Vf)_mm512_min_ps((__m512)a, (__m512)b);
#elif VEC_AVX2
    return (Vf)_mm256_min_ps((__m256)a, (__m256)b);
#elif VEC_SSE2
    return (Vf)_mm_min_ps((__m128)a, (__m128)b);
#else
    return vf_select(a < b, a, b);
#endif
}

// a > b ? a : b, so b where either is NaN.
VEC_INLINE Vf vf_max(Vf a, Vf b) {
#if VEC_AVX512
    return (Vf)_mm512_max_ps((__m512)a, (__m512)b);
#elif VEC_AVX2
    return (Vf)_mm256_max_ps((__m256)a, (__m256)b);
#elif VEC_SSE2
    return (Vf)_mm_max_ps((__m128)a, (__m128)b);
#else
    return vf_select(a > b, a, b);
#endif
}

VEC_INLINE Vi vi_min(Vi a, Vi b) {
    return vi_select(vi_lt(a, b), a, b);
}

VEC_INLINE Vi vi_max(Vi a, Vi b) {
    return vi_select(vi_lt(b, a), a, b);
}

VEC_INLINE Vf vf_sqrt(Vf a) {
#if VEC_AVX512
    return (Vf)_mm512_sqrt_ps((__m512)a);
#elif VEC_AVX2
    return (Vf)_mm256_sqrt_ps((__m256)a);
#elif VEC_SSE2
    return (Vf)_mm_sqrt_ps((__m128)a);
#else
    Vf root;
    for (int i = 0; i < DIP_LANES; i++) {
        root[i] = __builtin_sqrtf(a[i]);
    }
    return root;
#endif
}

VEC_INLINE Vf vf_abs(Vf a) {
    return vf_bits(vi_bits(a) & 0x7fffffff);
}

// Values of 2^23 and more, infinities and NaN come back as they are.
VEC_INLINE Vf vf_floor(Vf a) {
#if VEC_AVX512
    return (Vf)_mm512_roundscale_ps((__m512)a, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
#elif VEC_AVX2
    return (Vf)_mm256_floor_ps((__m256)a);
#else
    const Mask small = vf_lt(vf_abs(a), vf_splat(8388608.0f));
    const Vf inside = vf_select(small, a, vf_splat(0.0f));
    const Vf whole = vf_from_int(vi_from_float(inside));
    const Vf lower = vf_select(vf_lt(inside, whole), whole - 1.0f, whole);
    return vf_select(small, lower, a);
#endif
}

// --- memory ------------------------------------------------------------------------------------

// base[index[i]] per lane.
VEC_INLINE Vf vf_gather(const float *base, Vi index) {
#if VEC_AVX512
    return (Vf)_mm512_i32gather_ps((__m512i)index, base, 4);
#elif VEC_AVX2
    return (Vf)_mm256_i32gather_ps(base, (__m256i)index, 4);
#else
    Vf v;
    for (int i = 0; i < DIP_LANES; i++) {
        v[i] = base[index[i]];
    }
    return v;
#endif
}

VEC_INLINE Vi vi_gather(const int32_t *base, Vi index) {
#if VEC_AVX512
    return (Vi)_mm512_i32gather_epi32((__m512i)index, base, 4);
#elif VEC_AVX2
    return (Vi)_mm256_i32gather_epi32(base, (__m256i)index, 4);
#else
    Vi v;
    for (int i = 0; i < DIP_LANES; i++) {
        v[i] = base[index[i]];
    }
    return v;
#endif
}

// base[index[i]] and base[index[i] + 1] per lane: half the loads of two gathers, since both are
// fetched at once.
VEC_INLINE void vu_gather_pairs(const uint32_t *base, Vi index, Vu *first, Vu *second) {
#if VEC_AVX512
    const __m512i i = (__m512i)index;
    const __m512i low = _mm512_i32gather_epi64(_mm512_castsi512_si256(i), base, 4);
    const __m512i high = _mm512_i32gather_epi64(_mm512_extracti64x4_epi64(i, 1), base, 4);
    const __m512i even =
        _mm512_set_epi32(30, 28, 26, 24, 22, 20, 18, 16, 14, 12, 10, 8, 6, 4, 2, 0);
    const __m512i odd = _mm512_set_epi32(31, 29, 27, 25, 23, 21, 19, 17, 15, 13, 11, 9, 7, 5, 3, 1);
    *first = (Vu)_mm512_permutex2var_epi32(low, even, high);
    *second = (Vu)_mm512_permutex2var_epi32(low, odd, high);
#elif VEC_AVX2
    const __m256i i = (__m256i)index;
    const long long *pairs = (const long long *)(const void *)base;
    const __m256 low =
        _mm256_castsi256_ps(_mm256_i32gather_epi64(pairs, _mm256_castsi256_si128(i), 4));
    const __m256 high =
        _mm256_castsi256_ps(_mm256_i32gather_epi64(pairs, _mm256_extracti128_si256(i, 1), 4));
    const __m256 even = _mm256_shuffle_ps(low, high, 0x88); // lanes 0 1 4 5 2 3 6 7
    const __m256 odd = _mm256_shuffle_ps(low, high, 0xdd);
    *first = (Vu)_mm256_permute4x64_epi64(_mm256_castps_si256(even), 0xd8);
    *second = (Vu)_mm256_permute4x64_epi64(_mm256_castps_si256(odd), 0xd8);
#elif VEC_SSE2
    __m128i pair[4];
    for (int i = 0; i < 4; i++) {
        pair[i] = _mm_loadl_epi64((const __m128i *)(const void *)(base + index[i]));
    }
    const __m128i low = _mm_unpacklo_epi32(pair[0], pair[1]);
    const __m128i high = _mm_unpacklo_epi32(pair[2], pair[3]);
    *first = (Vu)_mm_unpacklo_epi64(low, high);
    *second = (Vu)_mm_unpackhi_epi64(low, high);
#else
    for (int i = 0; i < DIP_LANES; i++) {
        (*first)[i] = base[index[i]];
        (*second)[i] = base[index[i] + 1];
    }
#endif
}

// table[index[i]] per lane, 0 <= index < 16: a permutation instead of loads where there is one.
VEC_INLINE Vi vi_lookup16(const int32_t table[16], Vi index) {
#if VEC_AVX512
    return (Vi)_mm512_permutexvar_epi32((__m512i)index, _mm512_loadu_si512(table));
#elif VEC_AVX2
    const __m256i low = _mm256_loadu_si256((const __m256i *)(const void *)table);
    const __m256i high = _mm256_loadu_si256((const __m256i *)(const void *)(table + 8));
    const __m256i in_low = _mm256_permutevar8x32_epi32(low, (__m256i)index);
    const __m256i in_high = _mm256_permutevar8x32_epi32(high, (__m256i)index);
    return vi_select(index > 7, (Vi)in_high, (Vi)in_low);
#else
    return vi_gather(table, index);
#endif
}

// The four bytes from base[index[i]] on, little-endian, at any address.
VEC_INLINE Vu vu_gather_bytes(const uint8_t *base, Vi index) {
#if VEC_AVX512
    return (Vu)_mm512_i32gather_epi32((__m512i)index, base, 1);
#elif VEC_AVX2
    return (Vu)_mm256_i32gather_epi32((const int *)base, (__m256i)index, 1);
#else
    Vu v;
    for (int i = 0; i < DIP_LANES; i++) {
        const uint8_t *p = base + index[i];
        v[i] = (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
    }
    return v;
#endif
}

// The greatest lane.
VEC_INLINE int32_t vi_greatest(Vi v) {
#if VEC_AVX512
    return _mm512_reduce_max_epi32((__m512i)v);
#else
    int32_t lanes[DIP_LANES];
    vi_store(lanes, v);
    int32_t greatest = lanes[0];
    for (int i = 1; i < DIP_LANES; i++) {
        greatest = lanes[i] > greatest ? lanes[i] : greatest;
    }
    return greatest;
#endif
}

// The sum of the lanes, which must fit.
VEC_INLINE int32_t vi_sum(Vi v) {
    int32_t lanes[DIP_LANES];
    vi_store(lanes, v);
    int32_t sum = 0;
    for (int i = 0; i < DIP_LANES; i++) {
        sum += lanes[i];
    }
    return sum;
}

VEC_INLINE Vi vi_iota(void) {
    Vi v;
    for (int i = 0; i < DIP_LANES; i++) {
        v[i] = i;
    }
    return v;
}

// --- half vectors ------------------------------------------------------------------------------

// As many doubles as a vector's bytes hold, and 64-bit and 32-bit numbers of as many lanes; of two
// lanes of 32 bits a vector has two more, which are 0 when loaded and of no use. A condition is a
// vector of 0 / -1, as comparisons give it.
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

VEC_INLINE Hi hi_iota(void) {
    Hi v;
    for (int i = 0; i < (int)(sizeof v / sizeof v[0]); i++) {
        v[i] = i;
    }
    return v;
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

// Whole numbers below 2^51 in magnitude: adding 1.5 * 2^52 leaves them in the low bits.
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

// a * b - c * d modulo 2^32.
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

// A condition on doubles as one on their lanes' 32-bit numbers.
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

// The other way round.
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

// base[index[i]] per lane.
VEC_INLINE Hi hi_gather(const int32_t *base, Hi index) {
#if VEC_AVX512
    return (Hi)_mm256_i32gather_epi32(base, (__m256i)index, 4);
#elif VEC_AVX2
    return (Hi)_mm_i32gather_epi32(base, (__m128i)index, 4);
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

// Stores the lanes whose bits are set one after another; may write a whole vector.
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

// Lane by lane, low in the lower half of 64 bits.
VEC_INLINE Vl vl_pair(Hi low, Hi high) {
#if VEC_AVX512
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

// Four words of every lane to memory: those of lane i at out + i * stride_bytes.
VEC_INLINE void vl_store_rows(void *out, size_t stride_bytes, const Vl row[4]) {
    char *at = out;
#if VEC_AVX512
    const __m512i first = _mm512_set_epi64(13, 12, 5, 4, 9, 8, 1, 0);
    const __m512i second = _mm512_set_epi64(15, 14, 7, 6, 11, 10, 3, 2);
    const __m512i even[2] = {_mm512_unpacklo_epi64((__m512i)row[0], (__m512i)row[1]),
                             _mm512_unpacklo_epi64((__m512i)row[2], (__m512i)row[3])};
    const __m512i odd[2] = {_mm512_unpackhi_epi64((__m512i)row[0], (__m512i)row[1]),
                            _mm512_unpackhi_epi64((__m512i)row[2], (__m512i)row[3])};
    // Lanes 0 and 4, 1 and 5, 2 and 6, 3 and 7.
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
