// sRGB codes of 16-bit linear light.
#ifndef DIP_RENDERER_SIMD_SRGB_H
#define DIP_RENDERER_SIMD_SRGB_H

#include "renderer/base/srgb.h"
#include "renderer/simd/vec.h"

#if VEC_AVX512

// Returns the codes that sRGB's curve above its straight part gives, 269.025 * (light /
// 65535)^(5/12) - 13.525: the code of the formula, with 1/2 added. A table has the power of the
// exponent. The power of the mantissa is a square polynomial for each sixteenth of its range. It
// takes the place within the sixteenth, from 1 to 17/16. The numbers were searched until the codes
// of all 65536 lights were exact; no result is closer than 7e-5 to another code.
VEC_INLINE Vf srgb_curve(Vf light) {
    // 269.025 * (2^e / 65535)^(5/12) for e = 1 to 16
    static const float powers_of_exponent[16] = {
        0x1.c4727cp+1f, 0x1.2df8e6p+2f, 0x1.9315aap+2f, 0x1.0d06d6p+3f,
        0x1.671b8ap+3f, 0x1.df59e2p+3f, 0x1.3fedbp+4f,  0x1.ab0da4p+4f,
        0x1.1d061cp+5f, 0x1.7c7612p+5f, 0x1.fbdad4p+5f, 0x1.52f3d2p+6f,
        0x1.c4727cp+6f, 0x1.2df8e6p+7f, 0x1.9315aap+7f, 0x1.0d06d6p+8f};
    static const float constant[16] = {
        0x1.da7edep-2f, 0x1.06cf58p-1f, 0x1.24270ep-1f, 0x1.37f96p-1f,
        0x1.50a592p-1f, 0x1.62272cp-1f, 0x1.75c86cp-1f, 0x1.872d3cp-1f,
        0x1.96c866p-1f, 0x1.a73796p-1f, 0x1.b65fa2p-1f, 0x1.c52738p-1f,
        0x1.d572ep-1f,  0x1.dd172cp-1f, 0x1.f3ee6p-1f,  0x1.f9036ap-1f};
    static const float linear[16] = {
        0x1.5024e6p-1f, 0x1.3e8e16p-1f, 0x1.244558p-1f, 0x1.1b33fp-1f,
        0x1.076b9cp-1f, 0x1.00947p-1f,  0x1.e9796p-2f,  0x1.d8c236p-2f,
        0x1.cd2562p-2f, 0x1.bcc89p-2f,  0x1.b059b8p-2f, 0x1.a3cab2p-2f,
        0x1.9056f2p-2f, 0x1.9d6244p-2f, 0x1.6e5ff6p-2f, 0x1.834f66p-2f};
    static const float square[16] = {
        -0x1.eb23aep-4f, -0x1.c2284ep-4f, -0x1.75562ap-4f, -0x1.695938p-4f,
        -0x1.316e4ep-4f, -0x1.2a7496p-4f, -0x1.0ef3e6p-4f, -0x1.ff8fd6p-5f,
        -0x1.f1e9bep-5f, -0x1.cfa1e8p-5f, -0x1.bc0b12p-5f, -0x1.a5257ap-5f,
        -0x1.72ace8p-5f, -0x1.bd0374p-5f, -0x1.1cfbbp-5f,  -0x1.836de4p-5f};
    const Vi bits = vi_bits(light);
    const Vi part = bits >> 19; // its lowest four bits, which lookups use, are the sixteenth
    const Vf t = vf_bits((bits & 0x7ffff) | 0x3f800000);
    const Vf power = (t * vf_lookup16(square, part) + vf_lookup16(linear, part)) * t +
                     vf_lookup16(constant, part);
    return power * vf_lookup16(powers_of_exponent, bits >> 23) - 0x1.b0ccccp+3f;
}

#endif

// Returns what dip_srgb_code returns in each lane. With 16 lanes, computing a code takes less time
// than gathering it.
VEC_INLINE Vu vu_srgb_codes(const DipSrgbEncodeTable *table, Vi linear16) {
#if VEC_AVX512
    (void)table;
    const Vf light = vf_from_int(linear16);
    const Vf line = light * 0x1.9bd4dp-5f + 0.5f; // 12.92 * 255 / 65535
    return (Vu)vi_from_float(vf_select(vf_lt(light, vf_splat(206.0f)), line, srgb_curve(light)));
#else
    const Vu light = (Vu)linear16;
    const uint8_t *runs = (const uint8_t *)table->runs;
    const Vi run_bytes = (Vi)(light / DIP_SRGB_RUN * sizeof *table->runs);
    const Vu run = vu_gather_bytes(runs, run_bytes) & 0xffffu;
    return (run + light % DIP_SRGB_RUN) / DIP_SRGB_RUN;
#endif
}

#endif
