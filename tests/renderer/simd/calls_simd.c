// Calls each function of renderer/simd/ on arrays. This file is compiled once per instruction set.
#include "tests/renderer/simd/simd_calls.h"

#include "renderer/simd/half.h"
#include "renderer/simd/pairs.h"
#include "renderer/simd/powers.h"
#include "renderer/simd/quads.h"
#include "renderer/simd/srgb.h"
#include "renderer/simd/vec.h"

static Mask load_mask(const int32_t *lanes) {
    unsigned bits = 0;
    for (int i = 0; i < DIP_LANES; i++) {
        bits |= (unsigned)(lanes[i] & 1) << i;
    }
    return mask_from_bits(bits);
}

static void store_mask(int32_t *lanes, Mask m) {
    const unsigned bits = mask_bits(m);
    for (int i = 0; i < DIP_LANES; i++) {
        lanes[i] = -(int32_t)(bits >> i & 1u);
    }
}

// Loads a half vector of 32-bit lanes. The further lanes of SSE2 become -1 or NaN, since functions
// must not use them.
static Hi load_half(const void *lanes) {
    Hi v;
    memset(&v, 0xff, sizeof v);
    memcpy(&v, lanes, DIP_HALF_LANES * sizeof(int32_t));
    return v;
}

// Stores the lanes that a half vector of 32-bit lanes has with every instruction set.
static void store_half(void *out, Hi v) {
    memcpy(out, &v, DIP_HALF_LANES * sizeof(int32_t));
}

// Also stores the further lanes of SSE2, which load functions set to 0.
static void store_whole_half(void *out, Hi v) {
    memcpy(out, &v, sizeof v);
}

static Vl load_long(const void *lanes) {
    Vl v;
    memcpy(&v, lanes, sizeof v);
    return v;
}

static void store_long(void *out, Vl v) {
    memcpy(out, &v, sizeof v);
}

static void load_quads(const void *const in[4], Vu quads[4]) {
    for (int k = 0; k < 4; k++) {
        quads[k] = vu_load_quads(in[0], *(const size_t *)in[2], in[1], k);
    }
}

static void split_quads(const Vu quads[4], float *out) {
    Vf values[4];
    vf_split_quads(quads, values);
    for (int i = 0; i < 4; i++) {
        vf_store(out + (size_t)i * DIP_LANES, values[i]);
    }
}

// Argument i of a call, as a vector, a half vector or a number.
#define VF(i)           vf_load(in[i])
#define VI(i)           vi_load(in[i])
#define VU(i)           ((Vu)vi_load(in[i]))
#define MASK(i)         load_mask(in[i])
#define HI(i)           load_half(in[i])
#define HF(i)           ((Hf)load_half(in[i]))
#define VL(i)           load_long(in[i])
#define VD(i)           ((Vd)load_long(in[i]))
#define NUMBER(type, i) (*(const type *)in[i])

#define CALL(name, ...)                                                                            \
    case SIMD_##name:                                                                              \
        __VA_ARGS__;                                                                               \
        break

static void call_on_lanes(SimdCall call, const void *const in[4], void *out) {
    switch (call) {
        CALL(vf_load, vf_store(out, VF(0)));
        CALL(vi_load, vi_store(out, VI(0)));
        CALL(vu_store, vu_store(out, VU(0)));
        CALL(vf_splat, vf_store(out, vf_splat(NUMBER(float, 0))));
        CALL(vi_splat, vi_store(out, vi_splat(NUMBER(int32_t, 0))));
        CALL(vu_splat, vu_store(out, vu_splat(NUMBER(uint32_t, 0))));
        CALL(vf_from_int, vf_store(out, vf_from_int(VI(0))));
        CALL(vi_from_float, vi_store(out, vi_from_float(VF(0))));
        CALL(vi_bits, vi_store(out, vi_bits(VF(0))));
        CALL(vf_bits, vf_store(out, vf_bits(VI(0))));
        CALL(vf_lt, store_mask(out, vf_lt(VF(0), VF(1))));
        CALL(vi_lt, store_mask(out, vi_lt(VI(0), VI(1))));
        CALL(vi_eq, store_mask(out, vi_eq(VI(0), VI(1))));
        CALL(vi_not_negative, store_mask(out, vi_not_negative(VI(0))));
        CALL(vf_select, vf_store(out, vf_select(MASK(0), VF(1), VF(2))));
        CALL(vi_select, vi_store(out, vi_select(MASK(0), VI(1), VI(2))));
        CALL(vf_min, vf_store(out, vf_min(VF(0), VF(1))));
        CALL(vf_max, vf_store(out, vf_max(VF(0), VF(1))));
        CALL(vi_min, vi_store(out, vi_min(VI(0), VI(1))));
        CALL(vi_max, vi_store(out, vi_max(VI(0), VI(1))));
        CALL(vf_sqrt, vf_store(out, vf_sqrt(VF(0))));
        CALL(vf_abs, vf_store(out, vf_abs(VF(0))));
        CALL(vf_floor, vf_store(out, vf_floor(VF(0))));
        CALL(vi_dot16, vi_store(out, vi_dot16(VI(0), VI(1))));
        CALL(vu_mulhi16, vu_store(out, vu_mulhi16(VU(0), VU(1))));
        CALL(vu_dot16, vu_store(out, vu_dot16(VU(0), NUMBER(uint32_t, 1))));
        CALL(vi_iota, vi_store(out, vi_iota()));
        CALL(log2_of, vf_store(out, log2_of(VF(0))));
        CALL(exp2_of, vf_store(out, exp2_of(VF(0))));
    default:
        break;
    }
}

static int call_for_number(SimdCall call, const void *const in[4]) {
    switch (call) {
    case SIMD_mask_bits:
        return (int)mask_bits(MASK(0));
    case SIMD_mask_any:
        return mask_any(MASK(0));
    case SIMD_all_lanes:
        return (int)VEC_ALL_LANES;
    case SIMD_vi_greatest:
        return vi_greatest(VI(0));
    case SIMD_vi_sum:
        return vi_sum(VI(0));
    case SIMD_hi_mask_bits:
        return (int)hi_mask_bits(HI(0));
    case SIMD_bits_at:
        return (int)bits_at(NUMBER(unsigned, 0), NUMBER(unsigned, 1));
    default:
        return 0;
    }
}

static void call_on_memory(SimdCall call, const void *const in[4], void *out) {
    switch (call) {
        CALL(vf_gather, vf_store(out, vf_gather(in[0], VI(1))));
        CALL(vi_gather, vi_store(out, vi_gather(in[0], VI(1))));
        CALL(vi_load_bytes, vi_store(out, vi_load_bytes(in[0])));
        CALL(vf_store_lanes, vf_store_lanes(out, MASK(0), VF(1), VF(2)));
        CALL(vi_store_lanes, vi_store_lanes(out, MASK(0), VI(1)));
        CALL(vi_lookup16, vi_store(out, vi_lookup16(in[0], VI(1))));
        CALL(vi_lookup32, vi_store(out, vi_lookup32(in[0], VI(1))));
        CALL(vf_lookup16, vf_store(out, vf_lookup16(in[0], VI(1))));
        CALL(vu_gather_bytes, vu_store(out, vu_gather_bytes(in[0], VI(1))));
        CALL(vu_srgb_codes, vu_store(out, vu_srgb_codes(in[0], VI(1))));
        CALL(vf_expand, vf_store(out, vf_expand(in[0], NUMBER(unsigned, 1))));
        CALL(hi_gather, store_half(out, hi_gather(in[0], HI(1))));
        CALL(hf_gather, store_half(out, (Hi)hf_gather(in[0], HI(1))));
        CALL(hi_store_packed, hi_store_packed(out, HI(0), NUMBER(unsigned, 1)));
        CALL(hi_load, store_whole_half(out, hi_load(in[0])));
        CALL(hi_load_bytes, store_whole_half(out, hi_load_bytes(in[0])));
    default:
        break;
    }
}

static void call_on_rows(SimdCall call, const void *const in[4], void *out) {
    Vl rows[4];
    Vu quads[4];
    switch (call) {
    case SIMD_vl_store_rows:
        memcpy(rows, in[0], sizeof rows);
        vl_store_rows(out, NUMBER(size_t, 1), rows);
        break;
    case SIMD_vu_gather_pairs: {
        const VuPair pair = vu_gather_pairs(in[0], vi_pair_order(VI(1)));
        vu_store(out, vu_pair_left(pair));
        vu_store((uint32_t *)out + DIP_LANES, vu_pair_right(pair));
        break;
    }
    case SIMD_vf_split_quads:
        load_quads(in, quads);
        split_quads(quads, out);
        break;
    case SIMD_vu_quad_sum:
        load_quads(in, quads);
        vu_store(out, vu_quad_sum(quads));
        break;
    case SIMD_vu_quad_weights:
        for (int k = 0; k < 4; k++) {
            quads[k] = vu_quad_weights(VU(0), VU(1), k);
        }
        split_quads(quads, out);
        break;
    default:
        break;
    }
}

static void call_on_halves(SimdCall call, const void *const in[4], void *out) {
    switch (call) {
        CALL(vd_splat, store_long(out, (Vl)vd_splat(NUMBER(double, 0))));
        CALL(hi_splat, store_half(out, hi_splat(NUMBER(int32_t, 0))));
        CALL(vd_from_int, store_long(out, (Vl)vd_from_int(HI(0))));
        CALL(vd_from_float, store_long(out, (Vl)vd_from_float(HF(0))));
        CALL(hf_from_double, store_half(out, (Hi)hf_from_double(VD(0))));
        CALL(vd_abs, store_long(out, (Vl)vd_abs(VD(0))));
        CALL(vl_from_whole, store_long(out, vl_from_whole(VD(0))));
        CALL(vd_select, store_long(out, (Vl)vd_select(VL(0), VD(1), VD(2))));
        CALL(hi_cross, store_half(out, hi_cross(HI(0), HI(1), HI(2), HI(3))));
        CALL(hi_select, store_half(out, hi_select(HI(0), HI(1), HI(2))));
        CALL(hi_min, store_half(out, hi_min(HI(0), HI(1))));
        CALL(hi_max, store_half(out, hi_max(HI(0), HI(1))));
        CALL(hf_select, store_half(out, (Hi)hf_select(HI(0), HF(1), HF(2))));
        CALL(hi_condition, store_half(out, hi_condition(VL(0))));
        CALL(vl_condition, store_long(out, vl_condition(HI(0))));
        CALL(vl_pair, store_long(out, vl_pair(HI(0), HI(1))));
    default:
        break;
    }
}

int DIP_KERNEL(dip_kernel_simd_call)(SimdCall call, const void *const in[4], void *out) {
    if (call == SIMD_vu_compress) {
        return vu_compress(out, NUMBER(unsigned, 0), VU(1));
    }
    call_on_lanes(call, in, out);
    call_on_memory(call, in, out);
    call_on_rows(call, in, out);
    call_on_halves(call, in, out);
    return call_for_number(call, in);
}
