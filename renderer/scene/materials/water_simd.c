// The fragment shader of water. It blends the water's own colour with the mirrored scene, weighted
// by the Fresnel term. Compiled once per instruction set. docs/picture.md, Water, defines the
// formulas.
#include "renderer/scene/materials/material_kernels.h"
#include "renderer/scene/materials/surface_simd.h"
#include "renderer/scene/materials/water.h"
#include "renderer/scene/reflection.h"

// Returns the fraction of unpolarised light that a dielectric reflects. c is the cosine between the
// view ray and the normal, and n is the refractive index. With g = sqrt(n^2 - 1 + c^2), the result
// is the mean of a = ((c - g) / (c + g))^2 and a * ((c (g + c) - 1) / (c (g - c) + 1))^2.
VEC_INLINE Vf fresnel_exact(Vf c) {
    const float n = (float)DIP_WATER_INDEX;
    const Vf g = vf_sqrt(c * c + (n * n - 1.0f));
    const Vf sum = g + c;
    const Vf difference = g - c;
    const Vf across = difference / sum;
    const Vf ratio = (c * sum - 1.0f) / (c * difference + 1.0f);
    return (across * across * 0.5f) * (ratio * ratio + 1.0f);
}

// Returns Schlick's approximation of fresnel_exact.
VEC_INLINE Vf fresnel_schlick(Vf c) {
    const float n = (float)DIP_WATER_INDEX;
    const float straight = ((n - 1.0f) / (n + 1.0f)) * ((n - 1.0f) / (n + 1.0f));
    const Vf rest = vf_splat(1.0f) - c;
    const Vf square = rest * rest;
    return (square * square) * rest * (1.0f - straight) + straight;
}

// Returns the weight of the mirrored scene along a view ray. It is 0 where the eye looks up at the
// surface.
VEC_INLINE Vf share_of(const DipWaterUniforms *water, Vf3 ray) {
    const Vf down = vf_splat(0.0f) - ray.y;
    const Vf c = down / vf_sqrt(vf3_dot(ray, ray)); // At most 1, up to rounding.
    const Vf share = water->schlick ? fresnel_schlick(c) : fresnel_exact(c);
    return vf_select(vf_lt(vf_splat(0.0f), down), share, vf_splat(0.0f));
}

// Sets the alpha of blended water: it covers what it reflects and, of the rest, its opacity.
// Returns the weight of the mirrored scene in the colour that alpha multiplies.
VEC_INLINE Vf cover(float opacity, Vf share, float *alpha) {
    const Vf covered = share + (vf_splat(1.0f) - share) * opacity;
    vf_store(alpha, covered);
    return share / vf_max(covered, vf_splat(0x1p-20f)); // Without a reflection, share is 0.
}

void DIP_KERNEL(dip_kernel_water_fragment)(DipFragmentBatch *batch) {
    const DipWaterUniforms *water = batch->uniforms;
    float u[DIP_FRAGMENT_BATCH];
    float v[DIP_FRAGMENT_BATCH];
    float mirrored[3][DIP_FRAGMENT_BATCH];
    DIP_KERNEL(dip_kernel_surface_fragment)(batch);
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        vf_store(u + i, vf_load(batch->x + i) * water->inverse_size[0]);
        vf_store(v + i, vf_load(batch->y + i) * water->inverse_size[1]);
    }
    batch->sample_target(batch, water->mirrored, u, v, mirrored);
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        Vf share = share_of(water, view_ray(water->surface.rays, batch, i));
        if (water->surface.opacity < 1.0f) {
            share = cover(water->surface.opacity, share, batch->alpha + i);
        }
        for (int c = 0; c < 3; c++) {
            const Vf own = clamp01(vf_load(batch->colour[c] + i));
            vf_store(batch->colour[c] + i, own + (vf_load(mirrored[c] + i) - own) * share);
        }
    }
    batch->work.counts[DIP_SHADER_COUNT_REFLECTING] += (uint64_t)batch->count;
}
