// Reads the shadow map for the surfaces that receive shadows; only *_simd.c files may include it.
// docs/picture.md, Shadows, defines what is read.
#ifndef DIP_RENDERER_SCENE_MATERIALS_SHADOW_SIMD_H
#define DIP_RENDERER_SCENE_MATERIALS_SHADOW_SIMD_H

#include "renderer/scene/materials/facing_simd.h"

// Least cosine between normal and light that the bias of a receiver follows.
#define LEAST_COSINE 0.125f

VEC_INLINE bool has_shadow(const DipSurfaceUniforms *uniforms, int light) {
    return uniforms->shadow && uniforms->shadow->light == light;
}

// Returns the share of a light that arrives: `lit` if it is the light with shadows, otherwise 1.
VEC_INLINE Vf lit_by(const DipSurfaceUniforms *uniforms, int light, Vf lit) {
    return has_shadow(uniforms, light) ? lit : vf_splat(1.0f);
}

VEC_INLINE Vf dot_row(const float row[3], Vf3 v) {
    return (v.x * row[0] + v.y * row[1]) + v.z * row[2];
}

// Returns how much the depth of a surface changes over a texel and a half in the map's directions.
VEC_INLINE Vf rise_of(const DipShadowUniforms *shadow, Vf3 normal) {
    const Vf across = vf_abs(dot_row(shadow->rise[0], normal));
    const Vf along = vf_abs(dot_row(shadow->rise[1], normal));
    const Vf cosine = vf_abs(dot_row(shadow->rise[2], normal));
    return (across + along) * 1.5f / vf_max(cosine, vf_splat(LEAST_COSINE));
}

// Writes the share of the light with shadows that arrives at each fragment. A surface is moved
// towards the light by as much as it rises around a point, so that it does not shade itself.
// normal_varying: index of the first of three. If it is DIP_ABSENT, the normal is the triangle's.
VEC_INLINE void read_shadow(DipFragmentBatch *batch, int normal_varying, float *lit) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    const DipShadowUniforms *shadow = uniforms->shadow;
    float at[3][DIP_FRAGMENT_BATCH];
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        const Vf depth = vf_load(batch->varying[uniforms->depth_varying] + i);
        const Vf3 ray = view_ray(uniforms->rays, batch, i);
        const Vf3 place = vf3_scale(ray, depth);
        const Vf3 normal = normal_varying == DIP_ABSENT
                               ? triangle_normal(batch, i, ray, depth)
                               : vf3_load(batch->varying + normal_varying, i);
        const Vf rise = rise_of(shadow, vf3_scale(normal, inverse_length(vf3_dot(normal, normal))));
        for (int axis = 0; axis < 3; axis++) {
            vf_store(at[axis] + i, dot_row(shadow->to_map[axis], place) + shadow->to_map[axis][3]);
        }
        vf_store(at[2] + i, vf_load(at[2] + i) + rise);
    }
    batch->sample_shadow(batch, &shadow->map, at[0], at[1], at[2], lit);
    batch->work.counts[DIP_SHADER_COUNT_SHADOWED] += (uint64_t)batch->count;
}

#endif
