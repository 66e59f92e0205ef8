// The shader of metallic-roughness surfaces. Compiled once per instruction set. docs/picture.md,
// Metal and gloss, defines the formulas.
#include "renderer/scene/materials/arrival_simd.h"
#include "renderer/scene/materials/backdrop_simd.h"
#include "renderer/scene/materials/environment_simd.h"
#include "renderer/scene/materials/facing_simd.h"
#include "renderer/scene/materials/material_kernels.h"
#include "renderer/scene/materials/pbr_lobe_simd.h"
#include "renderer/scene/materials/sheen_simd.h"
#include "renderer/scene/materials/shadow_simd.h"

// Reflected share of a clear coat at normal incidence.
#define COAT_F0 0.04f

// The maps of a batch. A pointer is NULL if the surface lacks the map.
typedef struct Maps {
    float (*normal)[DIP_FRAGMENT_BATCH];
    float (*metal_rough)[DIP_FRAGMENT_BATCH];
    const float *occlusion;
    float (*emission)[DIP_FRAGMENT_BATCH];
    const float *lit; // share of the light with shadows that arrives; NULL: there is none
} Maps;

// The textures that the shader reads for a batch.
typedef struct Memory {
    float texture[3][DIP_FRAGMENT_BATCH];
    float normals[3][DIP_FRAGMENT_BATCH];
    float maps[3][3][DIP_FRAGMENT_BATCH];
} Memory;

// A point that is shaded, relative to the eye.
typedef struct PbrPoint {
    Vf3 place;
    Vf3 to_eye; // unit
    Vf3 base;   // own colour
    Vf metallic;
    Vf occlusion; // share of the ambient light that arrives
    Vf lit;       // share of the light with shadows that arrives
} PbrPoint;

// From where the fragments of a batch are seen. A loop of its own finds it for all of them: its
// long chains of roots and divisions then overlap, which they do not in one loop with all that
// follows.
typedef struct Sights {
    float to_eye[3][DIP_FRAGMENT_BATCH]; // unit
    float mesh[3][DIP_FRAGMENT_BATCH];   // unit normal of the mesh
    // With a normal map, the normal from the map, and 1 / its length before it was made unit.
    float mapped[3][DIP_FRAGMENT_BATCH];
    float inverse_length[DIP_FRAGMENT_BATCH];
} Sights;

// The widths of the lobes of a surface that has the same roughness everywhere, which are computed
// once for a batch.
typedef struct Widths {
    const Width *surface; // NULL: the roughness is not the same everywhere
    const Width *coat;    // NULL: the surface has no coat
} Widths;

// --- the surface ---------------------------------------------------------------------------------

// Returns a normal of the triangle at a fragment, of any length, that points away from the eye.
// With the steps x and y of the view ray along x and y, the depth w, and det = x * cross(y, ray),
// which is the same for all rays, this normal is
//     (w cross(x, y) + dw/dy cross(x, ray) + dw/dx cross(ray, y)) / (det w^2).
// No sum in it cancels where the eye is close to the triangle's plane. It is also right where a
// triangle is shaded outside of it, at a ray that its plane meets behind the eye: w < 0 there.
VEC_INLINE Vf3 normal_from_eye(const DipFragmentBatch *batch, int i, Vf3 ray) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    const DipViewRays *rays = uniforms->rays;
    const int w = uniforms->depth_varying;
    const Vf depth = vf_load(batch->varying[w] + i);
    const Vf dx = vf_load(batch->varying_dx[w] + i);
    const Vf dy = vf_load(batch->varying_dy[w] + i);
    const Vf3 x = {vf_splat(rays->per_x[0]), vf_splat(rays->per_x[1]), vf_splat(rays->per_x[2])};
    const Vf3 y = {vf_splat(rays->per_y[0]), vf_splat(rays->per_y[1]), vf_splat(rays->per_y[2])};
    const Vf3 ahead = cross(x, y);
    const Vf3 sum = vf3_sum(vf3_scale(ahead, depth),
                            vf3_sum(vf3_scale(cross(x, ray), dy), vf3_scale(cross(ray, y), dx)));
    const Mask turned = vf_lt(vf3_dot(ahead, ray), vf_splat(0.0f));
    return vf3_scale(sum, vf_select(turned, vf_splat(-1.0f), vf_splat(1.0f)));
}

// Returns the lanes whose surface is seen from the side away from its normal.
VEC_INLINE Mask seen_from_behind(const DipFragmentBatch *batch, int i, Vf3 ray, Vf3 normal) {
    return vf_lt(vf_splat(0.0f), vf3_dot(normal_from_eye(batch, i, ray), normal));
}

// Finds the normals of a surface, turned to the side from which it is seen.
VEC_INLINE Facing face_eye(DipFragmentBatch *batch, int i, Vf3 ray, const Maps *maps) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    Facing facing;
    if (maps->normal) {
        facing = find_scaled_facing(batch, i, ray, maps->normal, uniforms->pbr->normal_scale);
    } else {
        facing.mesh = facing.mapped = mesh_normal(batch, i);
        facing.inverse_length = vf_splat(1.0f);
    }
    if (uniforms->pbr->two_sided) {
        const Mask behind = seen_from_behind(batch, i, ray, facing.mesh);
        const Vf sign = vf_select(behind, vf_splat(-1.0f), vf_splat(1.0f));
        facing.mesh = vf3_scale(facing.mesh, sign);
        facing.mapped = vf3_scale(facing.mapped, sign);
    }
    return facing;
}

VEC_INLINE void vf3_store(float (*rows)[DIP_FRAGMENT_BATCH], int i, Vf3 v) {
    vf_store(rows[0] + i, v.x);
    vf_store(rows[1] + i, v.y);
    vf_store(rows[2] + i, v.z);
}

VEC_INLINE void find_sights(DipFragmentBatch *batch, const Maps *maps, Sights *sights) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        const Vf3 ray = view_ray(uniforms->rays, batch, i);
        const Facing facing = face_eye(batch, i, ray, maps);
        vf3_store(sights->to_eye, i, vf3_unit(vf3_scale(ray, vf_splat(-1.0f))));
        vf3_store(sights->mesh, i, facing.mesh);
        if (maps->normal) {
            vf3_store(sights->mapped, i, facing.mapped);
            vf_store(sights->inverse_length + i, facing.inverse_length);
        }
    }
}

// Makes the lobe of the surface itself. It widens where the normals of the map spread (Toksvig).
// known: the lobe's width, or NULL if it follows from the maps.
VEC_INLINE Lobe surface_lobe(const DipPbrUniforms *pbr, int i, Sights *sights, Vf3 to_eye,
                             const Maps *maps, const Width *known) {
    const Vf3 normal = vf3_load(maps->normal ? sights->mapped : sights->mesh, i);
    if (known) {
        return make_lobe(pbr->tables, normal, to_eye, known);
    }
    Vf roughness = vf_splat(pbr->roughness);
    if (maps->metal_rough) {
        // A filtered texel can be an ulp above 1, and the lean of a lobe has the root of 1 - alpha.
        roughness = vf_min(roughness * vf_load(maps->metal_rough[1] + i), vf_splat(1.0f));
    }
    Width width = width_of(roughness);
    if (maps->normal) {
        const Vf bounded = vf_min(vf_load(sights->inverse_length + i), vf_splat(10.0f));
        const Vf spread = vf_max(bounded - 1.0f, vf_splat(0.0f)) * 2.0f;
        const Vf alpha = roughness * roughness;
        const Vf wide = vf_sqrt(vf_min(alpha * alpha + spread, vf_splat(1.0f)));
        const Vf alpha2 = vf_min(width.alpha2 + spread, vf_splat(1.0f));
        width = width_of(vf_sqrt(wide));
        width.alpha2 = alpha2;
    }
    return make_lobe(pbr->tables, normal, to_eye, &width);
}

// The colours of a channel that no light changes.
typedef struct Channel {
    Vf f0;
    Vf gain;    // of the lobe, for light that bounces several times between facets
    Vf diffuse; // own colour of what is not metal
} Channel;

VEC_INLINE Channel channel_of(const DipPbrUniforms *pbr, const PbrPoint *point, int c, Vf base,
                              Vf lost) {
    const Vf rest = 1.0f - point->metallic;
    Channel channel = {.f0 = rest * pbr->f0_lin[c] + base * point->metallic,
                       .diffuse = base * rest};
    channel.gain = channel.f0 * lost + 1.0f;
    return channel;
}

VEC_INLINE Vf surroundings(const DipLightingUniforms *lighting, int c, Vf height) {
    return vf_max(height * (1.5f * lighting->sky_lin[c]) + lighting->ambient_lin[c],
                  vf_splat(0.0f));
}

// Computes the light that a lobe sees. environment: NULL for the surroundings of the lighting.
VEC_INLINE void see_surroundings(const DipLightingUniforms *lighting,
                                 const DipEnvironmentMap *environment, const Lobe *lobe, Vf3 to_eye,
                                 Vf seen[3]) {
    if (environment) {
        const Vf s = lobe->width.lean;
        const Vf of_normal = (1.0f - s) + lobe->n_v * s * 2.0f;
        const Vf3 towards = {lobe->normal.x * of_normal - to_eye.x * s,
                             lobe->normal.y * of_normal - to_eye.y * s,
                             lobe->normal.z * of_normal - to_eye.z * s};
        read_environment(environment, towards, lobe->width.roughness, seen);
        return;
    }
    const Vf height = reflected_height(lobe, to_eye);
    for (int c = 0; c < 3; c++) {
        seen[c] = surroundings(lighting, c, height);
    }
}

// Computes the light that falls on a matt surface from its surroundings.
VEC_INLINE void gather_soft_light(const DipLightingUniforms *lighting,
                                  const DipEnvironmentMap *environment, Vf3 normal, Vf soft[3]) {
    if (environment) {
        soft_light_of(environment, normal.x, normal.y, normal.z, soft);
        return;
    }
    for (int c = 0; c < 3; c++) {
        soft[c] = normal.y * lighting->sky_lin[c] + lighting->ambient_lin[c];
    }
}

// Adds what a light gives to the surface. sheen: NULL if the surface has none.
VEC_INLINE void add_light(const DipPbrUniforms *pbr, const Lobe *lobe, const PbrPoint *point,
                          const DipLightUniforms *light, Vf lit, const Channel channels[3], Vf f90,
                          const SheenPoint *sheen, Vf sum[3]) {
    const Arrival arrival = arrive(light, point->place);
    const Vf3 colour = arriving_colour(light, arrival.share * lit);
    const LightShares shares = meet_light(lobe, point->to_eye, arrival.to_light);
    const Vf kept = (1.0f - pbr->f0_greatest) - shares.fresnel * (pbr->f90 - pbr->f0_greatest);
    const Vf diffuse = kept * shares.facing;
    const Vf arriving[3] = {colour.x, colour.y, colour.z};
    Vf below = vf_splat(1.0f);
    Vf scattered = vf_splat(0.0f);
    if (sheen) {
        const Vf met = vf_min(shares.facing, vf_splat(1.0f));
        const Vf albedo = vf_max(sheen->albedo, sheen_albedo(sheen->sheen, met));
        below = 1.0f - albedo * sheen->sheen->greatest;
        scattered = sheen_of_light(sheen->sheen, lobe, point->to_eye, arrival.to_light, met);
    }
    for (int c = 0; c < 3; c++) {
        const Vf f0 = channels[c].f0;
        const Vf highlight = (f0 + (f90 - f0) * shares.fresnel) * channels[c].gain;
        const Vf base = highlight * shares.highlight + channels[c].diffuse * diffuse;
        const Vf share = sheen ? base * below + scattered * sheen->sheen->lin[c] : base;
        sum[c] = sum[c] + arriving[c] * share;
    }
}

VEC_INLINE void light_surface(const DipSurfaceUniforms *uniforms,
                              const DipEnvironmentMap *environment, const Lobe *lobe,
                              const PbrPoint *point, bool layered, const SheenPoint *sheen,
                              Vf sum[3]) {
    const DipPbrUniforms *pbr = uniforms->pbr;
    const DipLightingUniforms *lighting = uniforms->lighting;
    const Vf base[3] = {point->base.x, point->base.y, point->base.z};
    Vf seen[3];
    Vf soft[3];
    see_surroundings(lighting, environment, lobe, point->to_eye, seen);
    gather_soft_light(lighting, environment, lobe->normal, soft);
    const Vf lost = lost_light(lobe);
    const Vf f90 = (1.0f - point->metallic) * pbr->f90 + point->metallic;
    const Vf kept = (1.0f - pbr->f0_greatest) - lobe->grazing * (pbr->f90 - pbr->f0_greatest);
    Channel channels[3];
    for (int c = 0; c < 3; c++) {
        channels[c] = channel_of(pbr, point, c, base[c], lost);
        if (layered) { // What is let through does not become diffuse light.
            channels[c].diffuse = channels[c].diffuse * (1.0f - pbr->transmission);
        }
        const Vf mirrored = (channels[c].f0 * lobe->a + f90 * lobe->b) * channels[c].gain;
        sum[c] = (mirrored * seen[c] + (kept * channels[c].diffuse) * soft[c]) * point->occlusion;
        if (sheen) {
            const Vf below = 1.0f - sheen->albedo * sheen->sheen->greatest;
            const Vf scattered = sheen->albedo * sheen->sheen->lin[c];
            sum[c] = sum[c] * below + scattered * soft[c] * point->occlusion;
        }
    }
    for (int l = 0; l < lighting->count; l++) {
        if (uniforms->lights >> l & 1) {
            add_light(pbr, lobe, point, &lighting->lights[l], lit_by(uniforms, l, point->lit),
                      channels, f90, sheen, sum);
        }
    }
}

// Covers a colour with the clear coat, which takes a share of what is below and adds its own lobe.
VEC_INLINE void add_coat(const DipSurfaceUniforms *uniforms, const DipEnvironmentMap *environment,
                         const Width *width, Vf3 normal, const PbrPoint *point, Vf sum[3]) {
    const DipPbrUniforms *pbr = uniforms->pbr;
    const DipLightingUniforms *lighting = uniforms->lighting;
    const Lobe lobe = make_lobe(pbr->tables, normal, point->to_eye, width);
    const Vf rest = 1.0f - lobe.n_v;
    const Vf fresnel = (rest * rest) * (rest * rest) * rest * (1.0f - COAT_F0) + COAT_F0;
    const Vf left = 1.0f - fresnel * pbr->coat;
    Vf seen[3];
    see_surroundings(lighting, environment, &lobe, point->to_eye, seen);
    const Vf gain = (lost_light(&lobe) * COAT_F0 + 1.0f) * pbr->coat;
    const Vf mirrored = (lobe.a * COAT_F0 + lobe.b) * gain * point->occlusion;
    for (int c = 0; c < 3; c++) {
        sum[c] = sum[c] * left + mirrored * seen[c];
    }
    for (int l = 0; l < lighting->count; l++) {
        if (uniforms->lights >> l & 1) {
            const DipLightUniforms *light = &lighting->lights[l];
            const Arrival arrival = arrive(light, point->place);
            const Vf lit = lit_by(uniforms, l, point->lit);
            const Vf3 colour = arriving_colour(light, arrival.share * lit);
            const LightShares shares = meet_light(&lobe, point->to_eye, arrival.to_light);
            const Vf highlight =
                (shares.fresnel * (1.0f - COAT_F0) + COAT_F0) * gain * shares.highlight;
            sum[0] = sum[0] + colour.x * highlight;
            sum[1] = sum[1] + colour.y * highlight;
            sum[2] = sum[2] + colour.z * highlight;
        }
    }
}

VEC_INLINE PbrPoint find_point(const DipFragmentBatch *batch, int i, Sights *sights,
                               const Maps *maps) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    const DipPbrUniforms *pbr = uniforms->pbr;
    const Vf3 ray = view_ray(uniforms->rays, batch, i);
    PbrPoint point = {
        .place = vf3_scale(ray, vf_load(batch->varying[uniforms->depth_varying] + i)),
        .to_eye = vf3_load(sights->to_eye, i),
        .base = {vf_load(batch->colour[0] + i), vf_load(batch->colour[1] + i),
                 vf_load(batch->colour[2] + i)},
        .metallic = vf_splat(pbr->metallic),
        .occlusion = vf_splat(1.0f),
        .lit = maps->lit ? vf_load(maps->lit + i) : vf_splat(1.0f),
    };
    if (maps->metal_rough) {
        point.metallic = point.metallic * vf_load(maps->metal_rough[2] + i);
    }
    if (maps->occlusion) {
        point.occlusion = (vf_load(maps->occlusion + i) - 1.0f) * pbr->occlusion_strength + 1.0f;
    }
    return point;
}

VEC_INLINE void shade_fragments(DipFragmentBatch *batch, const DipEnvironmentMap *environment,
                                bool layered, int i, Sights *sights, const Maps *maps,
                                const Widths *widths) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    const DipPbrUniforms *pbr = uniforms->pbr;
    const PbrPoint point = find_point(batch, i, sights, maps);
    const Lobe lobe = surface_lobe(pbr, i, sights, point.to_eye, maps, widths->surface);
    Vf sum[3];
    SheenPoint sheen;
    const bool has_sheen = layered && pbr->sheen;
    if (has_sheen) {
        sheen = (SheenPoint){pbr->sheen, sheen_albedo(pbr->sheen, lobe.n_v)};
    }
    light_surface(uniforms, environment, &lobe, &point, layered, has_sheen ? &sheen : NULL, sum);
    for (int c = 0; c < 3 && pbr->emits; c++) {
        const Vf share = maps->emission ? vf_load(maps->emission[c] + i) : vf_splat(1.0f);
        sum[c] = sum[c] + share * pbr->emission_lin[c];
    }
    if (widths->coat) {
        add_coat(uniforms, environment, widths->coat, vf3_load(sights->mesh, i), &point, sum);
    }
    for (int c = 0; c < 3; c++) {
        vf_store(batch->colour[c] + i, sum[c]);
    }
}

// --- the shader ----------------------------------------------------------------------------------

// Reads the maps that the surface has. Three textures' memory is the caller's.
VEC_INLINE void read_maps(DipFragmentBatch *batch, float (*memory)[3][DIP_FRAGMENT_BATCH],
                          Maps *maps) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    const DipPbrUniforms *pbr = uniforms->pbr;
    if (pbr->metal_rough_varying != DIP_ABSENT) {
        maps->metal_rough = memory[0];
        batch->sample_colour(batch, &batch->samplers[DIP_SURFACE_SAMPLER_METAL_ROUGH],
                             pbr->metal_rough_varying, memory[0]);
    }
    if (pbr->occlusion_in_metal_rough) {
        maps->occlusion = memory[0][0];
    } else if (pbr->occlusion_varying != DIP_ABSENT) {
        maps->occlusion = memory[1][0];
        batch->sample_colour(batch, &batch->samplers[DIP_SURFACE_SAMPLER_OCCLUSION],
                             pbr->occlusion_varying, memory[1]);
    }
    if (pbr->emission_varying != DIP_ABSENT) {
        maps->emission = memory[2];
        batch->sample_colour(batch, &batch->samplers[DIP_SURFACE_SAMPLER_EMISSION],
                             pbr->emission_varying, memory[2]);
    }
}

VEC_INLINE void count_parts(DipFragmentBatch *batch, const Maps *maps) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    const DipPbrUniforms *pbr = uniforms->pbr;
    const uint64_t count = (uint64_t)batch->count;
    batch->work.counts[DIP_SHADER_COUNT_PBR] += count;
    batch->work.counts[DIP_SHADER_COUNT_NORMAL_MAPPED] += maps->normal ? count : 0;
    batch->work.counts[DIP_SHADER_COUNT_LIT] += pbr->own_lights ? count : 0;
    batch->work.counts[DIP_SHADER_COUNT_OCCLUDED] += maps->occlusion ? count : 0;
    batch->work.counts[DIP_SHADER_COUNT_EMITTING] += pbr->emits ? count : 0;
    batch->work.counts[DIP_SHADER_COUNT_COATED] += pbr->coat > 0.0f ? count : 0;
}

static bool has_maps(const Maps *maps) {
    return maps->normal || maps->metal_rough || maps->occlusion || maps->emission || maps->lit;
}

// Shades all fragments of a batch, whose own colours and maps have been read. Surfaces without maps
// and coat have a loop of their own, in which the compiler leaves out what the others need.
VEC_INLINE void shade_lobes(DipFragmentBatch *batch, const DipEnvironmentMap *environment,
                            bool layered, const Maps *maps) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    const DipPbrUniforms *pbr = uniforms->pbr;
    const Width surface = width_of_all(pbr->roughness);
    Sights sights;
    find_sights(batch, maps, &sights);
    if (!has_maps(maps) && !(pbr->coat > 0.0f)) {
        const Maps none = {.normal = NULL};
        const Widths alone = {.surface = &surface};
        for (int i = 0; i < batch->count; i += DIP_LANES) {
            shade_fragments(batch, environment, layered, i, &sights, &none, &alone);
        }
        return;
    }
    const Width coat = width_of_all(pbr->coat_roughness);
    const Widths widths = {.surface = maps->metal_rough || maps->normal ? NULL : &surface,
                           .coat = pbr->coat > 0.0f ? &coat : NULL};
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        shade_fragments(batch, environment, layered, i, &sights, maps, &widths);
    }
}

// Reads the own colours and the maps of a batch.
VEC_INLINE void begin_batch(DipFragmentBatch *batch, Memory *memory, Maps *maps) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    *maps = (Maps){.normal = NULL};
    if (uniforms->normal_map_varying != DIP_ABSENT) {
        maps->normal = memory->normals;
        start_mapped_colour(batch, memory->texture, memory->normals);
    } else {
        start_colour(batch, memory->texture);
    }
    if (uniforms->light_varying != DIP_ABSENT) {
        scale_colour(batch, batch->varying + uniforms->light_varying, 1.0f);
    }
    read_maps(batch, memory->maps, maps);
}

// environment: NULL for the surroundings of the lighting. layered: the surface may have a sheen or
// transmit light.
VEC_INLINE void shade_batch(DipFragmentBatch *batch, const DipEnvironmentMap *environment,
                            bool layered) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    Memory memory;
    Maps maps;
    begin_batch(batch, &memory, &maps);
    float lit[DIP_FRAGMENT_BATCH];
    if (uniforms->shadow) {
        read_shadow(batch, uniforms->normal_varying, lit);
        maps.lit = lit;
    }
    shade_lobes(batch, environment, layered, &maps);
    count_parts(batch, &maps);
}

void DIP_KERNEL(dip_kernel_pbr_fragment)(DipFragmentBatch *batch) {
    shade_batch(batch, NULL, false);
}

void DIP_KERNEL(dip_kernel_pbr_environment_fragment)(DipFragmentBatch *batch) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    shade_batch(batch, uniforms->pbr->environment, false);
    batch->work.counts[DIP_SHADER_COUNT_SURROUNDED] += (uint64_t)batch->count;
}

void DIP_KERNEL(dip_kernel_pbr_layered_fragment)(DipFragmentBatch *batch) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    const DipPbrUniforms *pbr = uniforms->pbr;
    const uint64_t count = (uint64_t)batch->count;
    shade_batch(batch, pbr->environment, true);
    batch->work.counts[DIP_SHADER_COUNT_SURROUNDED] += pbr->environment ? count : 0;
    batch->work.counts[DIP_SHADER_COUNT_SHEEN] += pbr->sheen ? count : 0;
}

// --- transmission --------------------------------------------------------------------------------

// Computes the share of what lies behind that a surface and its coat let through.
VEC_INLINE void find_transmittance(const DipFragmentBatch *batch, int i, Sights *sights,
                                   const Maps *maps, const Width *known, Vf through[3]) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    const DipPbrUniforms *pbr = uniforms->pbr;
    const PbrPoint point = find_point(batch, i, sights, maps);
    const Lobe lobe = surface_lobe(pbr, i, sights, point.to_eye, maps, known);
    const Vf base[3] = {point.base.x, point.base.y, point.base.z};
    const Vf f90 = (1.0f - point.metallic) * pbr->f90 + point.metallic;
    const Vf rest = 1.0f - clamp01(vf3_dot(vf3_load(sights->mesh, i), point.to_eye));
    const Vf fresnel = (rest * rest) * (rest * rest) * rest * (1.0f - COAT_F0) + COAT_F0;
    const Vf clear = (1.0f - point.metallic) * pbr->transmission * (1.0f - fresnel * pbr->coat);
    for (int c = 0; c < 3; c++) {
        const Channel channel = channel_of(pbr, &point, c, base[c], vf_splat(0.0f));
        const Vf kept = clamp01(1.0f - (channel.f0 * lobe.a + f90 * lobe.b));
        through[c] = clear * base[c] * kept;
    }
}

void DIP_KERNEL(dip_kernel_transmittance_fragment)(DipFragmentBatch *batch) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    float opacity[DIP_FRAGMENT_BATCH];
    Memory memory;
    Maps maps;
    begin_batch(batch, &memory, &maps);
    read_opacity(batch, opacity);
    Sights sights;
    find_sights(batch, &maps, &sights);
    const Width surface = width_of_all(uniforms->pbr->roughness);
    const Width *known = maps.metal_rough || maps.normal ? NULL : &surface;
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        Vf through[3];
        find_transmittance(batch, i, &sights, &maps, known, through);
        const Vf covered = vf_load(opacity + i);
        for (int c = 0; c < 3; c++) {
            vf_store(batch->colour[c] + i, (1.0f - covered) + covered * through[c]);
        }
    }
    batch->work.counts[DIP_SHADER_COUNT_TRANSMITTING] += (uint64_t)batch->count;
}

// Computes what a surface lets through of its backdrop, which its roughness blurs.
VEC_INLINE void see_backdrop(DipFragmentBatch *batch, float (*seen)[DIP_FRAGMENT_BATCH]) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    const DipPbrUniforms *pbr = uniforms->pbr;
    Memory memory;
    Maps maps;
    begin_batch(batch, &memory, &maps);
    Sights sights;
    find_sights(batch, &maps, &sights);
    const Width surface = width_of_all(pbr->roughness);
    const Width *known = maps.metal_rough || maps.normal ? NULL : &surface;
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        Vf through[3];
        Vf behind[3];
        Vf roughness = vf_splat(pbr->roughness);
        if (maps.metal_rough) {
            roughness = roughness * vf_load(maps.metal_rough[1] + i);
        }
        find_transmittance(batch, i, &sights, &maps, known, through);
        read_backdrop(uniforms->backdrop, vf_load(batch->x + i), vf_load(batch->y + i),
                      roughness * pbr->scattering, behind);
        for (int c = 0; c < 3; c++) {
            vf_store(seen[c] + i, through[c] * behind[c]);
        }
    }
}

void DIP_KERNEL(dip_kernel_pbr_scattering_fragment)(DipFragmentBatch *batch) {
    float seen[3][DIP_FRAGMENT_BATCH];
    see_backdrop(batch, seen);
    DIP_KERNEL(dip_kernel_pbr_layered_fragment)(batch);
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        for (int c = 0; c < 3; c++) {
            vf_store(batch->colour[c] + i,
                     clamp01(vf_load(batch->colour[c] + i)) + vf_load(seen[c] + i));
        }
    }
    batch->work.counts[DIP_SHADER_COUNT_TRANSMITTING] += (uint64_t)batch->count;
    batch->work.counts[DIP_SHADER_COUNT_SCATTERING] += (uint64_t)batch->count;
}
