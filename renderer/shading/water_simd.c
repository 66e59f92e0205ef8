// The fragment shader of water: its own colour, and the mirrored scene by Fresnel's share; compiled
// once per instruction set.
#include "renderer/raster/kernels.h"
#include "renderer/reflection.h"
#include "renderer/shading/water.h"
#include "renderer/simd/vec.h"

// Unpolarised light on a dielectric: with g = sqrt(n^2 - 1 + c^2), the mean of
// ((c - g) / (c + g))^2 and that times ((c (g + c) - 1) / (c (g - c) + 1))^2.
VEC_INLINE Vf fresnel_exact(Vf c) {
    const float n = (float)DIP_WATER_INDEX;
    const Vf g = vf_sqrt(c * c + (n * n - 1.0f));
    const Vf sum = g + c;
    const Vf difference = g - c;
    const Vf across = difference / sum;
    const Vf ratio = (c * sum - 1.0f) / (c * difference + 1.0f);
    return (across * across * 0.5f) * (ratio * ratio + 1.0f);
}

VEC_INLINE Vf fresnel_schlick(Vf c) {
    const float n = (float)DIP_WATER_INDEX;
    const float straight = ((n - 1.0f) / (n + 1.0f)) * ((n - 1.0f) / (n + 1.0f));
    const Vf rest = vf_splat(1.0f) - c;
    const Vf square = rest * rest;
    return (square * square) * rest * (1.0f - straight) + straight;
}

// The mirrored scene's share at pixel places; none where the eye looks up at the surface.
VEC_INLINE Vf share_at(const DipWaterUniforms *water, Vf x, Vf y) {
    const Vf a = x * water->a[1] + water->a[0];
    const Vf b = y * water->b[1] + water->b[0];
    const Vf down = (x * water->down[1] + y * water->down[2]) + water->down[0];
    const Vf length = vf_sqrt((a * a + b * b) + 1.0f);
    const Vf c = vf_min(vf_max(down / length, vf_splat(0.0f)), vf_splat(1.0f));
    const Vf share = water->schlick ? fresnel_schlick(c) : fresnel_exact(c);
    return vf_select(vf_lt(vf_splat(0.0f), down), share, vf_splat(0.0f));
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
        const Vf share = share_at(water, vf_load(batch->x + i), vf_load(batch->y + i));
        for (int c = 0; c < 3; c++) {
            const Vf colour = vf_max(vf_load(batch->colour[c] + i), vf_splat(0.0f));
            const Vf own = vf_min(colour, vf_splat(1.0f));
            vf_store(batch->colour[c] + i, own + (vf_load(mirrored[c] + i) - own) * share);
        }
    }
}
