// Logarithms and powers to the base of 2, with the same bits on every machine.
#ifndef DIP_RENDERER_SIMD_POWERS_H
#define DIP_RENDERER_SIMD_POWERS_H

#include "renderer/simd/vec.h"

// Returns log2 of positive normal numbers. The result is exact at powers of two, and the function
// is monotone; its error is below 1.4e-5. On [1, 2), the function computes log2(1 + t) = t (1 + (1
// - t) r(t)), where the polynomial r interpolates at Chebyshev points.
VEC_INLINE Vf log2_of(Vf x) {
    const Vi bits = vi_bits(x);
    const Vf exponent = vf_from_int((bits >> 23) - 127);
    const Vf t = vf_bits((bits & 0x7fffff) | 0x3f800000) - 1.0f;
    const Vf t2 = t * t; // for Estrin's scheme, which has a short dependency chain
    const Vf r = (0.442654073f - 0.276569515f * t) +
                 t2 * ((0.184100822f - 0.0972018316f * t) + 0.0256912634f * t2);
    return exponent + t * (1.0f + (1.0f - t) * r);
}

// Returns 2^x with a relative error below 6e-7, and exactly where x is a whole number. x is limited
// to -126..126. On [0, 1), the function computes 1 + t (1 + (1 - t) r(t)).
VEC_INLINE Vf exp2_of(Vf x) {
    const Vf within = vf_max(vf_min(x, vf_splat(126.0f)), vf_splat(-126.0f));
    const Vf whole = vf_floor(within);
    const Vf t = within - whole;
    const Vf r = ((-0.00189781538f * t - 0.0108646285f) * t - 0.0666790158f) * t - 0.306851149f;
    const Vf mantissa = 1.0f + t * (1.0f + (1.0f - t) * r);
    return mantissa * vf_bits((vi_from_float(whole) + 127) << 23);
}

#endif
