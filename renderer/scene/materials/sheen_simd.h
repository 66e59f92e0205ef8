// The sheen of cloth: light that fibres scatter at grazing angles. docs/picture.md, Metal and
// gloss, defines the formulas. Only *_simd.c files may include this header.
#ifndef DIP_RENDERER_SCENE_MATERIALS_SHEEN_SIMD_H
#define DIP_RENDERER_SCENE_MATERIALS_SHEEN_SIMD_H

#include "renderer/scene/materials/pbr_lobe_simd.h"
#include "renderer/simd/powers.h"

// A surface's sheen at a point.
typedef struct SheenPoint {
    const DipSheen *sheen;
    Vf albedo; // share of uniform light that a white sheen sends to the eye
} SheenPoint;

VEC_INLINE Vf sheen_albedo(const DipSheen *sheen, Vf cosine) {
    const Vf power = cosine * sheen->albedo_slope + sheen->albedo_shift;
    return vf_min(exp2_of(power), vf_splat(1.0f));
}

// Returns what a white sheen gives of a light, as LightShares.highlight. n_l: cosine of the light's
// angle, 0..1.
VEC_INLINE Vf sheen_of_light(const DipSheen *sheen, const Lobe *lobe, Vf3 to_eye, Vf3 to_light,
                             Vf n_l) {
    const Vf sum2 = vf_max(vf3_dot(to_eye, to_light) * 2.0f + 2.0f, vf_splat(1e-6f));
    const Vf along = vf_max(vf3_dot(lobe->normal, to_light) + lobe->facing, vf_splat(0.0f));
    const Vf sine2 =
        vf_min(vf_max(1.0f - along * along / sum2, vf_splat(0.0078125f)), vf_splat(1.0f));
    const Vf distribution = exp2_of(log2_of(sine2) * sheen->exponent) * sheen->scale;
    const Vf open = vf_max((n_l + lobe->n_v - n_l * lobe->n_v) * 4.0f, vf_splat(1.0f));
    return distribution * n_l / open;
}

#endif
