// Projection of a batch of clip positions, compiled once per instruction set.
#include "renderer/pipeline/geometry/project.h"
#include "renderer/pipeline/kernels/kernels.h"
#include "renderer/simd/vec.h"

// Adding 1.5 * 2^23 to v and subtracting it again rounds v to the nearest integer, ties to even, if
// |v| <= 2^22.
#define ROUNDER 12582912.0f

// Returns (ndc + 1) * half in 1/256 pixel, clamped to +-2^22 and rounded.
VEC_INLINE Vi to_subpixels(Vf ndc, float half_subpixels) {
    const Vf at = ndc * half_subpixels + half_subpixels;
    const Vf bounded = vf_min(vf_max(at, vf_splat(-4194304.0f)), vf_splat(4194304.0f));
    return vi_from_float((bounded + ROUNDER) - ROUNDER);
}

VEC_INLINE Vi code_if(Mask outside, int32_t code) {
    return vi_select(outside, vi_splat(code), vi_splat(0));
}

VEC_INLINE Vi too_large(Vf v) {
    // The comparison is written so that NaN counts as too large.
    return vi_select(vf_lt(vf_abs(v), vf_splat(DIP_MAX_CLIP_COORDINATE)), vi_splat(0),
                     vi_splat(DIP_CLIP_INVALID));
}

VEC_INLINE Vi clip_code(const DipScreenMapping *map, Vf x, Vf y, Vf z, Vf w) {
    Vi code = too_large(x) | too_large(y) | too_large(z) | too_large(w);
    code |= code_if(vf_lt(w, z), DIP_CLIP_NEAR);
    code |= code_if(vf_lt(z, vf_splat(0.0f)), DIP_CLIP_FAR);
    code |= code_if(vf_lt(w, vf_splat(DIP_MIN_W)), DIP_CLIP_W);
    code |= code_if(vf_lt(x, w * map->left), DIP_CLIP_LEFT);
    code |= code_if(vf_lt(w * map->right, x), DIP_CLIP_RIGHT);
    code |= code_if(vf_lt(w * map->top, y), DIP_CLIP_TOP);
    code |= code_if(vf_lt(y, w * map->bottom), DIP_CLIP_BOTTOM);
    code |= code_if(vf_lt(x, w * -map->guard_left), DIP_CLIP_GUARD_LEFT);
    code |= code_if(vf_lt(w * map->guard_right, x), DIP_CLIP_GUARD_RIGHT);
    code |= code_if(vf_lt(w * map->guard_top, y), DIP_CLIP_GUARD_TOP);
    code |= code_if(vf_lt(y, w * -map->guard_bottom), DIP_CLIP_GUARD_BOTTOM);
    for (int i = 0; i < map->clip_plane_count; i++) {
        const float *p = map->clip_planes[i];
        const Vf side = ((x * p[0] + y * p[1]) + z * p[2]) + w * p[3];
        code |= code_if(vf_lt(side, vf_splat(0.0f)), DIP_CLIP_USER << i);
    }
    return code;
}

void DIP_KERNEL(dip_kernel_project)(const DipScreenMapping *map, int count, float *const *clip,
                                    DipScreenBatch *out) {
    const float half_x = map->half_width * 256.0f;
    const float half_y = map->half_height * 256.0f;
    const Vi first_x = vi_splat(map->first_x * 256);
    const Vi first_y = vi_splat(map->first_y * 256);
    for (int i = 0; i < count; i += DIP_LANES) {
        const Vf x = vf_load(clip[0] + i);
        const Vf y = vf_load(clip[1] + i);
        const Vf z = vf_load(clip[2] + i);
        const Vf w = vf_load(clip[3] + i);
        const Vi code = clip_code(map, x, y, z, w);
        vi_store(out->code + i, code);
        vi_store(out->x + i, to_subpixels(x / w, half_x) + first_x);
        vi_store(out->y + i, to_subpixels(-y / w, half_y) + first_y);
        vf_store(out->z + i, z / w);
        vf_store(out->rw + i, vf_splat(1.0f) / w);
    }
}
