// sRGB codes of 16-bit linear light.
#ifndef DIP_RENDERER_SIMD_SRGB_H
#define DIP_RENDERER_SIMD_SRGB_H

#include "renderer/base/srgb.h"
#include "renderer/simd/vec.h"

#if VEC_AVX512

// Returns the codes that sRGB's curve above its straight part gives, 269.025 * (light /
// 65535)^(5/12) - 13.525: the code of the formula, with 1/2 added. The power of the mantissa is a
// polynomial around 3/2 (degree 6, minimax), and that of the exponent comes from a table. The last
// digits of all numbers were searched until the codes of all 65536 lights were exact.
VEC_INLINE Vf srgb_curve(Vf light) {
    // 269.025 * (2^e / 65535)^(5/12) for e = 1 to 16
    static const float powers_of_exponent[16] = {
        0x1.c4727ep+1f, 0x1.2df8e4p+2f, 0x1.9315aap+2f, 0x1.0d06d6p+3f,
        0x1.671b8ap+3f, 0x1.df59ep+3f,  0x1.3fedb2p+4f, 0x1.ab0da2p+4f,
        0x1.1d061ap+5f, 0x1.7c7614p+5f, 0x1.fbdad2p+5f, 0x1.52f3dp+6f,
        0x1.c4727cp+6f, 0x1.2df8e6p+7f, 0x1.9315acp+7f, 0x1.52f3d2p+1f};
    const Vi bits = vi_bits(light);
    const Vf t = vf_bits((bits & 0x7fffff) | 0x3f800000) - 1.5f;
    Vf power = t * -0x1.6edb38p-9f + 0x1.573f04p-8f;
    power = power * t - 0x1.3abcacp-7f;
    power = power * t + 0x1.6f62d4p-6f;
    power = power * t - 0x1.05f9dap-4f;
    power = power * t + 0x1.50cccep-2f;
    power = power * t + 0x1.2f1e24p+0f;
    return power * vf_lookup16(powers_of_exponent, (bits >> 23) & 15) - 0x1.b0ccdcp+3f;
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
