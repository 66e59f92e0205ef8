// Vectors of DIP_LANES 32-bit lanes and their operations. Only kernels (*_simd.c) include this
// header.
//
// The types are compiler vector extensions, so + - * / & | ^ << >> and comparisons apply to them
// directly. Intrinsics serve where the extensions have no operator. Every operation is exact
// integer arithmetic or correctly rounded IEEE arithmetic, so all widths give the same bits.
// Comparison functions return a Mask: one bit per lane with AVX-512, otherwise a vector with 0
// (false) or -1 (true) per lane.
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

// DIP_KERNEL(dip_kernel_name) is the exported name of this instruction set's version, for example
// dip_kernel_name_avx2.
#define VEC_JOIN_(a, b)  a##_##b
#define VEC_JOIN(a, b)   VEC_JOIN_(a, b)
#define DIP_KERNEL(name) VEC_JOIN(name, DIP_ISA_SUFFIX)

typedef float Vf __attribute__((vector_size(4 * DIP_LANES)));
typedef int32_t Vi __attribute__((vector_size(4 * DIP_LANES)));
typedef uint32_t Vu __attribute__((vector_size(4 * DIP_LANES)));

#if DIP_SANITIZED
// With the checks of a sanitizer, inlined copies grow so large that a file takes half a minute to
// compile.
#define VEC_INLINE static inline
#else
#define VEC_INLINE static inline __attribute__((always_inline))
#endif

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

// Converts to integers, rounding towards zero. Every lane must be within the range of int32.
VEC_INLINE Vi vi_from_float(Vf v) {
    return __builtin_convertvector(v, Vi);
}

// The next two functions reinterpret the bits of the lanes.
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

// Returns the lanes whose sign bit is clear.
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
    return ~(a >> 31);
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

// --- min, max, sqrt, floor ---------------------------------------------------------------------

// Returns a < b ? a : b. The result is b if a or b is NaN.
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

// Returns a > b ? a : b. The result is b if a or b is NaN.
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
#if VEC_AVX512
    return (Vi)_mm512_min_epi32((__m512i)a, (__m512i)b);
#elif VEC_AVX2
    return (Vi)_mm256_min_epi32((__m256i)a, (__m256i)b);
#else
    return vi_select(vi_lt(a, b), a, b);
#endif
}

VEC_INLINE Vi vi_max(Vi a, Vi b) {
#if VEC_AVX512
    return (Vi)_mm512_max_epi32((__m512i)a, (__m512i)b);
#elif VEC_AVX2
    return (Vi)_mm256_max_epi32((__m256i)a, (__m256i)b);
#else
    return vi_select(vi_lt(b, a), a, b);
#endif
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

// Rounds down. The result has the sign of a, also where it is 0. Returns lanes unchanged if they
// are NaN, infinite, or at least 2^23 in magnitude.
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
    const Vf with_sign = vf_bits(vi_bits(lower) | (vi_bits(a) & INT32_MIN));
    return vf_select(small, with_sign, a);
#endif
}

// Multiplies the signed 16-bit halves of each lane of a by the same halves of b. Returns the sum of
// both products.
VEC_INLINE Vi vi_dot16(Vi a, Vi b) {
#if VEC_AVX512
    return (Vi)_mm512_madd_epi16((__m512i)a, (__m512i)b);
#elif VEC_AVX2
    return (Vi)_mm256_madd_epi16((__m256i)a, (__m256i)b);
#elif VEC_SSE2
    return (Vi)_mm_madd_epi16((__m128i)a, (__m128i)b);
#else
    const Vi low_a = (Vi)((Vu)a << 16) >> 16;
    const Vi low_b = (Vi)((Vu)b << 16) >> 16;
    return low_a * low_b + (a >> 16) * (b >> 16);
#endif
}

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

// --- memory ------------------------------------------------------------------------------------

// Returns base[index[i]] in lane i.
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

// Loads DIP_LANES bytes, one into each lane.
VEC_INLINE Vi vi_load_bytes(const uint8_t *p) {
#if VEC_AVX512
    return (Vi)_mm512_cvtepu8_epi32(_mm_loadu_si128((const __m128i *)(const void *)p));
#elif VEC_AVX2
    return (Vi)_mm256_cvtepu8_epi32(_mm_loadl_epi64((const __m128i *)(const void *)p));
#else
    Vi v;
    for (int i = 0; i < DIP_LANES; i++) {
        v[i] = p[i];
    }
    return v;
#endif
}

// Stores to p the lanes of v that are set in m. `old` must be the vector that is in memory at p,
// because the other lanes may be overwritten with the lanes of `old`.
VEC_INLINE void vf_store_lanes(float *p, Mask m, Vf v, Vf old) {
#if VEC_AVX512
    (void)old;
    _mm512_mask_storeu_ps(p, m, (__m512)v);
#else
    vf_store(p, vf_select(m, v, old));
#endif
}

// Stores to p the lanes of v that are set in m.
VEC_INLINE void vi_store_lanes(int32_t *p, Mask m, Vi v) {
#if VEC_AVX512
    _mm512_mask_storeu_epi32(p, m, (__m512i)v);
#else
    vi_store(p, vi_select(m, v, vi_load(p)));
#endif
}

// Returns table[index[i]] in lane i, for 0 <= index[i] < 16. With AVX2 and AVX-512, this permutes
// vectors instead of loading lane by lane.
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

// Returns table[index[i]] in lane i, for 0 <= index[i] < 32, as vi_lookup16 does.
VEC_INLINE Vi vi_lookup32(const int32_t table[32], Vi index) {
#if VEC_AVX512
    return (Vi)_mm512_permutex2var_epi32(_mm512_loadu_si512(table), (__m512i)index,
                                         _mm512_loadu_si512(table + 16));
#elif VEC_AVX2
    const Vi in_low = vi_lookup16(table, index & 15);
    const Vi in_high = vi_lookup16(table + 16, index & 15);
    return vi_select(index > 15, in_high, in_low);
#else
    return vi_gather(table, index);
#endif
}

VEC_INLINE Vf vf_lookup16(const float table[16], Vi index) {
#if VEC_AVX512
    return (Vf)_mm512_permutexvar_ps((__m512i)index, _mm512_loadu_ps(table));
#elif VEC_AVX2
    const __m256 in_low = _mm256_permutevar8x32_ps(_mm256_loadu_ps(table), (__m256i)index);
    const __m256 in_high = _mm256_permutevar8x32_ps(_mm256_loadu_ps(table + 8), (__m256i)index);
    return vf_select(index > 7, (Vf)in_high, (Vf)in_low);
#else
    return vf_gather(table, index);
#endif
}

// Returns in lane i the four bytes that start at base[index[i]], read as a little-endian number.
// The bytes need no alignment.
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

// Stores the lanes whose bits are set in `bits` to `out`, without gaps, and returns their number.
// The function may overwrite a whole vector's length from `out` on.
VEC_INLINE int vu_compress(uint32_t *out, unsigned bits, Vu v) {
#if VEC_AVX512
    const __m512i packed = _mm512_maskz_compress_epi32((__mmask16)bits, (__m512i)v);
    _mm512_storeu_si512(out, packed);
    return __builtin_popcount(bits);
#elif VEC_AVX2
    // Each of these words has one byte per lane. In `stay`, the bytes of the lanes to store are
    // 255. `order` gets the numbers of these lanes, without gaps.
    const uint64_t stay = _pdep_u64(bits, 0x0101010101010101u) * 255;
    const uint64_t order = _pext_u64(0x0706050403020100u, stay);
    const __m256i lane = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128((long long)order));
    _mm256_storeu_si256((__m256i *)(void *)out, _mm256_permutevar8x32_epi32((__m256i)v, lane));
    return __builtin_popcount(bits);
#else
    uint32_t lanes[DIP_LANES];
    vu_store(lanes, v);
    int count = 0;
    for (; bits; bits &= bits - 1) {
        out[count++] = lanes[__builtin_ctz(bits)];
    }
    return count;
#endif
}

// Returns the lowest bits of `bits`, one after the other, at the places of the bits that are set in
// `places`, and 0 elsewhere.
VEC_INLINE unsigned bits_at(unsigned bits, unsigned places) {
#if VEC_AVX2 || VEC_AVX512
    return _pdep_u32(bits, places);
#else
    unsigned spread = 0;
    for (; places; places &= places - 1, bits >>= 1) {
        spread |= places & -places & (0u - (bits & 1));
    }
    return spread;
#endif
}

// The reverse of vu_compress: returns the values at p, one after the other, in the lanes whose bits
// are set in `bits`, and 0 in the other lanes. The function may read a whole vector's length from p
// on.
VEC_INLINE Vf vf_expand(const float *p, unsigned bits) {
#if VEC_AVX512
    return (Vf)_mm512_maskz_expand_ps((__mmask16)bits, _mm512_loadu_ps(p));
#elif VEC_AVX2
    // `order` has one byte per lane: the number of the value that the lane gets.
    const uint64_t stay = _pdep_u64(bits, 0x0101010101010101u) * 255;
    const uint64_t order = _pdep_u64(0x0706050403020100u, stay);
    const __m256i from = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128((long long)order));
    const __m256 spread = _mm256_permutevar8x32_ps(_mm256_loadu_ps(p), from);
    return vf_select(mask_from_bits(bits), (Vf)spread, vf_splat(0.0f));
#else
    float lanes[DIP_LANES] = {0};
    for (; bits; bits &= bits - 1) {
        lanes[__builtin_ctz(bits)] = *p++;
    }
    return vf_load(lanes);
#endif
}

// Returns the value of the greatest lane.
VEC_INLINE int32_t vi_greatest(Vi v) {
#if VEC_AVX512
    return _mm512_reduce_max_epi32((__m512i)v);
#elif VEC_AVX2
    __m128i m =
        _mm_max_epi32(_mm256_castsi256_si128((__m256i)v), _mm256_extracti128_si256((__m256i)v, 1));
    m = _mm_max_epi32(m, _mm_shuffle_epi32(m, 0x4e));
    m = _mm_max_epi32(m, _mm_shuffle_epi32(m, 0xb1));
    return _mm_cvtsi128_si32(m);
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

// Returns the sum of the lanes, which must fit into 32 bits.
VEC_INLINE int32_t vi_sum(Vi v) {
    int32_t lanes[DIP_LANES];
    vi_store(lanes, v);
    int32_t sum = 0;
    for (int i = 0; i < DIP_LANES; i++) {
        sum += lanes[i];
    }
    return sum;
}

// Returns 0, 1, 2, ... in the lanes.
VEC_INLINE Vi vi_iota(void) {
    Vi v;
    for (int i = 0; i < DIP_LANES; i++) {
        v[i] = i;
    }
    return v;
}

#endif
