// The shaders of normal-mapped surfaces, which compute light and highlight per fragment. Compiled
// once per instruction set. docs/picture.md, Normal maps, defines the formulas.
#include "renderer/scene/materials/facing_simd.h"
#include "renderer/scene/materials/material_kernels.h"

// A surface is in the sun's shadow where its light map's luminance is at most SHADE_LIGHT. It is
// fully in the sun where the luminance is at least SHADE_LIGHT + SUNLIT_LIGHT.
#define SHADE_LIGHT  0.4f
#define SUNLIT_LIGHT 0.5f
// Bounds of the factor by which a mapped normal changes the light map.
#define LEAST_RATIO    0.25f
#define GREATEST_RATIO 2.5f
// Reflectance of a dielectric seen along its normal, and the least width (GGX alpha) of its
// highlight.
#define REFLECTANCE 0.04f
#define LEAST_ALPHA 0.1f

// Copies what the light of fragments needs to varyings: normal, depth and vertex colour.
void DIP_KERNEL(dip_kernel_fragment_lit_vertex)(const DipVertexBatch *batch) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        transform_vertices(uniforms, batch, i);
        const Vf3 turned = turn_normal(uniforms, batch, i);
        const Vf3 normal = vf3_scale(turned, inverse_length(vf3_dot(turned, turned)));
        vf_store(batch->varying[uniforms->normal_varying] + i, normal.x);
        vf_store(batch->varying[uniforms->normal_varying + 1] + i, normal.y);
        vf_store(batch->varying[uniforms->normal_varying + 2] + i, normal.z);
        vf_store(batch->varying[uniforms->depth_varying] + i, vf_load(batch->clip[3] + i));
        for (int c = 0; c < 3 && uniforms->light_varying != DIP_ABSENT; c++) {
            vf_store(batch->varying[uniforms->light_varying + c] + i,
                     vf_load(batch->in[uniforms->colour_attribute + c] + i));
        }
    }
}

// Computes the fixed light of sky and sun on a surface with this normal. `sun` is max(0,
// dot(normal, direction to the sun)) times the visible fraction of the sun.
VEC_INLINE Vf fixed_light(Vf3 normal, Vf sun) {
    return (LIGHT_AMBIENT + normal.y * LIGHT_SKY) + sun * LIGHT_SUN;
}

// The fraction above / below. The caller divides, so that one division can serve several fractions.
typedef struct Fraction {
    Vf above, below;
} Fraction;

// Computes the sun's highlight, a GGX lobe that widens where the map's normals spread (Toksvig).
// Let c be the cosine of the angle between the directions to the eye and to the sun. The sum of
// these directions has the squared length 2 (1 + c). The squared cosine between the sum and the
// direction to the sun is (1 + c) / 2. `sun` is dot(mapped normal, direction to the sun). `met` is
// max(0, sun) times the visible fraction of the sun.
VEC_INLINE Fraction highlight(const Facing *facing, Vf3 ray, Vf sun, Vf met, float roughness) {
    const float alpha = roughness * roughness > LEAST_ALPHA ? roughness * roughness : LEAST_ALPHA;
    const Vf bounded = vf_min(facing->inverse_length, vf_splat(10.0f));
    const Vf spread = vf_max(bounded - 1.0f, vf_splat(0.0f)) * 2.0f;
    const Vf alpha2 = vf_min(spread + alpha * alpha, vf_splat(1.0f));
    const Vf to_eye = vf_splat(0.0f) - inverse_length(vf3_dot(ray, ray));
    const Vf c1 = vf_max(vf3_dot_sun(ray) * to_eye + 1.0f, vf_splat(1e-6f));
    const Vf n_h = vf_max(sun + vf3_dot(facing->mapped, ray) * to_eye, vf_splat(0.0f));
    // The value that is squared in GGX's denominator, times 2 (1 + c).
    const Vf d = n_h * n_h * (alpha2 - 1.0f) + c1 * 2.0f;
    const Vf above = (alpha2 * met) * ((c1 * c1) * (4.0f * REFLECTANCE * LIGHT_SUN));
    const Vf width = vf_sqrt(alpha2) * 4.0f + 2.0f;
    return (Fraction){above, (d * d) * (vf_max(c1 * 0.5f, vf_splat(0.1f)) * width)};
}

// Lights the batch's colours by a light map. The map's luminance tells what fraction of the sun is
// visible.
VEC_INLINE void light_by_map(DipFragmentBatch *batch, float (*map)[DIP_FRAGMENT_BATCH],
                             float (*light)[DIP_FRAGMENT_BATCH]) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        const Vf3 ray = view_ray(uniforms->rays, batch, i);
        const Facing facing = find_facing(batch, i, ray, map);
        const Vf3 baked = vf3_scale(vf3_load(light, i), vf_splat(uniforms->light_map_scale));
        const Vf luminance = (baked.x * 0.2126f + baked.y * 0.7152f) + baked.z * 0.0722f;
        const Vf sunlit = clamp01((luminance - SHADE_LIGHT) * (1.0f / SUNLIT_LIGHT));
        const Vf sun = vf3_dot_sun(facing.mapped);
        const Vf met = vf_max(sun, vf_splat(0.0f)) * sunlit;
        const Vf met_flat = vf_max(vf3_dot_sun(facing.mesh), vf_splat(0.0f)) * sunlit;
        const Fraction shine = highlight(&facing, ray, sun, met, uniforms->roughness);
        const Vf flat = fixed_light(facing.mesh, met_flat);
        const Vf inverse = vf_splat(1.0f) / (flat * shine.below);
        const Vf ratio = (fixed_light(facing.mapped, met) * shine.below) * inverse;
        const Vf bounded = vf_min(vf_max(ratio, vf_splat(LEAST_RATIO)), vf_splat(GREATEST_RATIO));
        const Vf added = (shine.above * flat) * inverse;
        for (int c = 0; c < 3; c++) {
            const Vf base = vf_load(batch->colour[c] + i);
            const Vf lit = c == 0 ? baked.x : c == 1 ? baked.y : baked.z;
            vf_store(batch->colour[c] + i, base * (lit * bounded) + added);
        }
    }
}

// Lights the batch's colours by the fixed light.
VEC_INLINE void light_by_sun(DipFragmentBatch *batch, float (*map)[DIP_FRAGMENT_BATCH]) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        const Vf3 ray = view_ray(uniforms->rays, batch, i);
        const Facing facing = find_facing(batch, i, ray, map);
        const Vf sun = vf3_dot_sun(facing.mapped);
        const Vf met = vf_max(sun, vf_splat(0.0f));
        const Vf light = fixed_light(facing.mapped, met);
        const Fraction shine = highlight(&facing, ray, sun, met, uniforms->roughness);
        const Vf added = shine.above / shine.below;
        for (int c = 0; c < 3; c++) {
            vf_store(batch->colour[c] + i, vf_load(batch->colour[c] + i) * light + added);
        }
    }
}

void DIP_KERNEL(dip_kernel_normal_map_fragment)(DipFragmentBatch *batch) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    float texture[3][DIP_FRAGMENT_BATCH];
    float map[3][DIP_FRAGMENT_BATCH];
    start_mapped_colour(batch, texture, map);
    if (uniforms->light_varying != DIP_ABSENT) {
        scale_colour(batch, batch->varying + uniforms->light_varying, 1.0f);
    }
    if (uniforms->light_map_varying != DIP_ABSENT) {
        batch->sample_colour(batch, &batch->samplers[DIP_SURFACE_SAMPLER_LIGHT_MAP],
                             uniforms->light_map_varying, texture);
        light_by_map(batch, map, texture);
    } else {
        light_by_sun(batch, map);
    }
    batch->work.counts[DIP_SHADER_COUNT_NORMAL_MAPPED] += (uint64_t)batch->count;
}
