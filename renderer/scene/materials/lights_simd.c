// The shaders of surfaces that the scene's lights light, at the vertices (Gouraud) or at the
// fragments (Phong). Compiled once per instruction set. docs/picture.md, Lights, defines the
// formulas.
#include "renderer/scene/materials/arrival_simd.h"
#include "renderer/scene/materials/facing_simd.h"
#include "renderer/scene/materials/material_kernels.h"
#include "renderer/scene/materials/shadow_simd.h"

// A point of a surface, relative to the eye.
typedef struct LitPoint {
    Vf3 place;
    Vf3 normal; // unit
    Vf3 to_eye; // unit
    Vf lit;     // share of the light with shadows that arrives
} LitPoint;

// The light of a point: what its surface reflects in all directions, and towards the eye.
typedef struct PointLight {
    Vf3 diffuse;
    Vf3 highlight;
    Vf3 direct; // from the light with shadows, if `diffuse` shall lack it
} PointLight;

// Raises x to a whole power.
VEC_INLINE Vf power(Vf x, unsigned exponent) {
    Vf product = vf_splat(1.0f);
    for (; exponent; exponent >>= 1) {
        product = exponent & 1 ? product * x : product;
        x = x * x;
    }
    return product;
}

// diffuse: where the light that is reflected in all directions is added.
VEC_INLINE void add_light(const DipLightUniforms *light, const LitPoint *point, Vf lit, bool shines,
                          unsigned shininess, Vf3 *diffuse, PointLight *sum) {
    const Vf none = vf_splat(0.0f);
    const Arrival arrival = arrive(light, point->place);
    const Vf3 colour = arriving_colour(light, arrival.share * lit);
    const Vf facing = vf3_dot(point->normal, arrival.to_light);
    *diffuse = vf3_sum(*diffuse, vf3_scale(colour, vf_max(facing, none)));
    if (shines) {
        const Vf3 half = vf3_unit(vf3_sum(arrival.to_light, point->to_eye));
        const Vf cosine = clamp01(vf3_dot(point->normal, half));
        const Vf peak = vf_select(vf_lt(none, facing), power(cosine, shininess), none);
        sum->highlight = vf3_sum(sum->highlight, vf3_scale(colour, peak));
    }
}

VEC_INLINE PointLight light_of(const DipSurfaceUniforms *uniforms, const LitPoint *point) {
    const DipLightingUniforms *lighting = uniforms->lighting;
    const float *specular = uniforms->specular_lin;
    const bool shines = specular[0] > 0.0f || specular[1] > 0.0f || specular[2] > 0.0f;
    const float zero[3] = {0.0f, 0.0f, 0.0f};
    const Vf up = point->normal.y;
    PointLight sum = {.diffuse = {up * lighting->sky_lin[0] + lighting->ambient_lin[0],
                                  up * lighting->sky_lin[1] + lighting->ambient_lin[1],
                                  up * lighting->sky_lin[2] + lighting->ambient_lin[2]},
                      .highlight = vf3_splat(zero),
                      .direct = vf3_splat(zero)};
    for (int l = 0; l < lighting->count; l++) {
        if (uniforms->lights >> l & 1) {
            const bool apart = uniforms->direct_varying != DIP_ABSENT && has_shadow(uniforms, l);
            add_light(&lighting->lights[l], point, lit_by(uniforms, l, point->lit), shines,
                      uniforms->shininess, apart ? &sum.direct : &sum.diffuse, &sum);
        }
    }
    sum.highlight = (Vf3){sum.highlight.x * specular[0], sum.highlight.y * specular[1],
                          sum.highlight.z * specular[2]};
    return sum;
}

// --- Gouraud -----------------------------------------------------------------------------------

VEC_INLINE Vf3 vertex_place(const DipViewRays *rays, const DipVertexBatch *batch, int i) {
    const Vf x = vf_load(batch->clip[0] + i);
    const Vf y = vf_load(batch->clip[1] + i);
    const Vf w = vf_load(batch->clip[3] + i);
    return (Vf3){(x * rays->right[0] + y * rays->up[0]) + w * rays->ahead[0],
                 (x * rays->right[1] + y * rays->up[1]) + w * rays->ahead[1],
                 (x * rays->right[2] + y * rays->up[2]) + w * rays->ahead[2]};
}

void DIP_KERNEL(dip_kernel_gouraud_vertex)(const DipVertexBatch *batch) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        transform_vertices(uniforms, batch, i);
        LitPoint point = {.place = vertex_place(uniforms->rays, batch, i), .lit = vf_splat(1.0f)};
        point.normal = vf3_unit(turn_normal(uniforms, batch, i));
        point.to_eye = vf3_unit(vf3_scale(point.place, vf_splat(-1.0f)));
        const PointLight light = light_of(uniforms, &point);
        const Vf diffuse[3] = {light.diffuse.x, light.diffuse.y, light.diffuse.z};
        const Vf highlight[3] = {light.highlight.x, light.highlight.y, light.highlight.z};
        const Vf direct[3] = {light.direct.x, light.direct.y, light.direct.z};
        const bool apart = uniforms->direct_varying != DIP_ABSENT;
        if (apart) {
            vf_store(batch->varying[uniforms->depth_varying] + i, vf_load(batch->clip[3] + i));
        }
        for (int c = 0; c < 3; c++) {
            const Vf colour = uniforms->colour_attribute == DIP_ABSENT
                                  ? vf_splat(1.0f)
                                  : vf_load(batch->in[uniforms->colour_attribute + c] + i);
            vf_store(batch->varying[uniforms->light_varying + c] + i, diffuse[c] * colour);
            vf_store(batch->varying[uniforms->highlight_varying + c] + i, highlight[c]);
            if (apart) {
                vf_store(batch->varying[uniforms->direct_varying + c] + i, direct[c] * colour);
            }
        }
    }
}

// Adds the light that comes from the light with shadows, and takes the highlights away where none
// of it arrives.
VEC_INLINE void shadow_vertex_light(DipFragmentBatch *batch) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    float lit[DIP_FRAGMENT_BATCH];
    read_shadow(batch, DIP_ABSENT, lit);
    for (int c = 0; c < 3; c++) {
        float *light = batch->varying[uniforms->light_varying + c];
        float *highlight = batch->varying[uniforms->highlight_varying + c];
        const float *direct = batch->varying[uniforms->direct_varying + c];
        for (int i = 0; i < batch->count; i += DIP_LANES) {
            const Vf share = vf_load(lit + i);
            vf_store(light + i, vf_load(light + i) + vf_load(direct + i) * share);
            vf_store(highlight + i, vf_load(highlight + i) * share);
        }
    }
}

void DIP_KERNEL(dip_kernel_gouraud_fragment)(DipFragmentBatch *batch) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    float texture[3][DIP_FRAGMENT_BATCH];
    start_colour(batch, texture);
    if (uniforms->direct_varying != DIP_ABSENT) {
        shadow_vertex_light(batch);
    }
    for (int c = 0; c < 3; c++) {
        for (int i = 0; i < batch->count; i += DIP_LANES) {
            const Vf light = vf_load(batch->varying[uniforms->light_varying + c] + i);
            const Vf highlight = vf_load(batch->varying[uniforms->highlight_varying + c] + i);
            vf_store(batch->colour[c] + i, vf_load(batch->colour[c] + i) * light + highlight);
        }
    }
    batch->work.counts[DIP_SHADER_COUNT_LIT] += (uint64_t)batch->count;
}

// --- Phong -------------------------------------------------------------------------------------

VEC_INLINE void light_fragments(DipFragmentBatch *batch, int i, Vf3 ray, Vf3 normal, Vf lit) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    const Vf depth = vf_load(batch->varying[uniforms->depth_varying] + i);
    const LitPoint point = {.place = vf3_scale(ray, depth),
                            .normal = normal,
                            .to_eye = vf3_unit(vf3_scale(ray, vf_splat(-1.0f))),
                            .lit = lit};
    const PointLight light = light_of(uniforms, &point);
    const Vf diffuse[3] = {light.diffuse.x, light.diffuse.y, light.diffuse.z};
    const Vf highlight[3] = {light.highlight.x, light.highlight.y, light.highlight.z};
    for (int c = 0; c < 3; c++) {
        vf_store(batch->colour[c] + i, vf_load(batch->colour[c] + i) * diffuse[c] + highlight[c]);
    }
}

void DIP_KERNEL(dip_kernel_phong_fragment)(DipFragmentBatch *batch) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    const bool mapped = uniforms->normal_map_varying != DIP_ABSENT;
    float texture[3][DIP_FRAGMENT_BATCH];
    float map[3][DIP_FRAGMENT_BATCH];
    if (mapped) {
        start_mapped_colour(batch, texture, map);
        batch->work.counts[DIP_SHADER_COUNT_NORMAL_MAPPED] += (uint64_t)batch->count;
    } else {
        start_colour(batch, texture);
    }
    if (uniforms->light_varying != DIP_ABSENT) {
        scale_colour(batch, batch->varying + uniforms->light_varying, 1.0f);
    }
    float lit[DIP_FRAGMENT_BATCH];
    if (uniforms->shadow) {
        read_shadow(batch, uniforms->normal_varying, lit);
    }
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        const Vf3 ray = view_ray(uniforms->rays, batch, i);
        light_fragments(batch, i, ray,
                        mapped ? find_facing(batch, i, ray, map).mapped : mesh_normal(batch, i),
                        uniforms->shadow ? vf_load(lit + i) : vf_splat(1.0f));
    }
    batch->work.counts[DIP_SHADER_COUNT_LIT] += (uint64_t)batch->count;
}
