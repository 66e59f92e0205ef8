// The light that arrives from a light of the scene at a point; only *_simd.c files may include it.
// docs/picture.md, Lights, defines the formulas.
#ifndef DIP_RENDERER_SCENE_MATERIALS_ARRIVAL_SIMD_H
#define DIP_RENDERER_SCENE_MATERIALS_ARRIVAL_SIMD_H

#include "renderer/scene/materials/surface_simd.h"

// The light that arrives at a point is at most GREATEST_LIGHT, so that no result is infinite or
// NaN.
#define GREATEST_LIGHT 1e18f

VEC_INLINE Vf3 vf3_splat(const float v[3]) {
    return (Vf3){vf_splat(v[0]), vf_splat(v[1]), vf_splat(v[2])};
}

VEC_INLINE Vf3 vf3_sum(Vf3 a, Vf3 b) {
    return (Vf3){a.x + b.x, a.y + b.y, a.z + b.z};
}

VEC_INLINE Vf3 vf3_unit(Vf3 v) {
    return vf3_scale(v, inverse_length(vf3_dot(v, v)));
}

// The direction to a light, and the part of its light that arrives.
typedef struct Arrival {
    Vf3 to_light; // unit
    Vf share;
} Arrival;

VEC_INLINE Arrival arrive(const DipLightUniforms *light, Vf3 place) {
    if (light->kind == DIP_LIGHT_DIRECTIONAL) {
        return (Arrival){vf3_splat(light->to_light), vf_splat(1.0f)};
    }
    const Vf3 way = {light->from_eye[0] - place.x, light->from_eye[1] - place.y,
                     light->from_eye[2] - place.z};
    const Vf length2 = vf_max(vf3_dot(way, way), vf_splat(LEAST_LENGTH2));
    const Vf length = vf_sqrt(length2);
    const float *a = light->attenuation;
    const Vf loss = (length * a[1] + length2 * a[2]) + a[0];
    const Vf relative2 = length2 * light->inverse_range2;
    const Vf window = clamp01(1.0f - relative2 * relative2);
    Arrival arrival = {.to_light = vf3_scale(way, vf_splat(1.0f) / length),
                       .share = window / vf_max(loss, vf_splat(LEAST_LENGTH2))};
    if (light->kind == DIP_LIGHT_SPOT) {
        const Vf cosine = vf3_dot(arrival.to_light, vf3_splat(light->to_light));
        const Vf cone = clamp01(cosine * light->cone_scale + light->cone_shift);
        arrival.share = arrival.share * (cone * cone);
    }
    return arrival;
}

// Returns the colour of the light that arrives.
VEC_INLINE Vf3 arriving_colour(const DipLightUniforms *light, Vf share) {
    const Vf most = vf_splat(GREATEST_LIGHT);
    return (Vf3){vf_min(share * light->colour_lin[0], most),
                 vf_min(share * light->colour_lin[1], most),
                 vf_min(share * light->colour_lin[2], most)};
}

#endif
