// Shaders of normal-mapped surfaces: light and highlight per fragment, compiled once per
// instruction set. docs/picture.md, Normal maps, defines them.
#include "renderer/raster/kernels.h"
#include "renderer/shading/surface_simd.h"

// Light maps show the sun from SHADE on, in full from SHADE + SUNLIT.
#define SHADE_LIGHT  0.4f
#define SUNLIT_LIGHT 0.5f
// Bounds of what a mapped normal may change the light map by.
#define LEAST_RATIO    0.25f
#define GREATEST_RATIO 2.5f
// Reflection of a dielectric seen along its normal, and the least width of its highlight.
#define REFLECTANCE 0.04f
#define LEAST_ALPHA 0.1f

void DIP_KERNEL(dip_kernel_normal_map_vertex)(const DipVertexBatch *batch) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        place_vertices(uniforms, batch, i);
        const Vf3 turned = turn_normal(uniforms, batch, i);
        const Vf3 normal = vf3_scale(turned, inverse_length(vf3_dot(turned, turned)));
        vf_store(batch->slot[uniforms->normal_slot] + i, normal.x);
        vf_store(batch->slot[uniforms->normal_slot + 1] + i, normal.y);
        vf_store(batch->slot[uniforms->normal_slot + 2] + i, normal.z);
        vf_store(batch->slot[uniforms->depth_slot] + i, vf_load(batch->clip[3] + i));
        for (int c = 0; c < 3 && uniforms->light_slot != DIP_NO_SLOT; c++) {
            vf_store(batch->slot[uniforms->light_slot + c] + i,
                     vf_load(batch->in[uniforms->colour_attribute + c] + i));
        }
    }
}

// How a surface is turned where it is shaded.
typedef struct Facing {
    Vf3 mesh;   // unit normal of the mesh
    Vf3 mapped; // unit normal of the map
    Vf length2; // squared length of the map's filtered normal
} Facing;

// d * depth + ray * d(depth): how the place on the surface moves per pixel.
VEC_INLINE Vf3 place_step(const float per[3], Vf depth, Vf3 ray, Vf depth_step) {
    return (Vf3){depth * per[0] + ray.x * depth_step, depth * per[1] + ray.y * depth_step,
                 depth * per[2] + ray.z * depth_step};
}

// The part of a * s - b * t that is at right angles to the unit normal, at length 1 (or 0).
VEC_INLINE Vf3 tangent(Vf3 a, Vf s, Vf3 b, Vf t, Vf3 normal) {
    const Vf3 raw = {a.x * s - b.x * t, a.y * s - b.y * t, a.z * s - b.z * t};
    const Vf along = vf3_dot(raw, normal);
    const Vf3 flat = {raw.x - normal.x * along, raw.y - normal.y * along, raw.z - normal.z * along};
    const Vf length2 = vf3_dot(flat, flat);
    return vf3_scale(flat, vf_splat(1.0f) / vf_sqrt(vf_max(length2, vf_splat(1e-36f))));
}

// The tangents are the directions in which u grows and v shrinks on the triangle: from the
// derivatives of place and coordinates, so that mirrored coordinates turn them round. Where the
// coordinates have no area the map says nothing.
VEC_INLINE Facing find_facing(DipFragmentBatch *batch, int i, Vf3 ray,
                              float (*map)[DIP_FRAGMENT_BATCH]) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    const int u = uniforms->normal_map_slot;
    const int w = uniforms->depth_slot;
    Facing facing = {.mesh = vf3_load(batch->slot + uniforms->normal_slot, i)};
    facing.mesh = vf3_scale(facing.mesh, inverse_length(vf3_dot(facing.mesh, facing.mesh)));
    const Vf depth = vf_load(batch->slot[w] + i);
    const Vf3 dx = place_step(uniforms->rays->per_x, depth, ray, vf_load(batch->slot_dx[w] + i));
    const Vf3 dy = place_step(uniforms->rays->per_y, depth, ray, vf_load(batch->slot_dy[w] + i));
    const Vf u_dx = vf_load(batch->slot_dx[u] + i), v_dx = vf_load(batch->slot_dx[u + 1] + i);
    const Vf u_dy = vf_load(batch->slot_dy[u] + i), v_dy = vf_load(batch->slot_dy[u + 1] + i);
    const Vf area = u_dx * v_dy - u_dy * v_dx;
    const Vf3 to_u = tangent(dx, v_dy, dy, v_dx, facing.mesh);
    const Vf3 to_v = tangent(dx, u_dy, dy, u_dx, facing.mesh); // against v, times the area's sign
    const Vf sign = vf_select(vf_lt(area, vf_splat(0.0f)), vf_splat(-1.0f), vf_splat(1.0f));
    const Vf shown = vf_select(vf_lt(vf_splat(0.0f), vf_abs(area)), sign, vf_splat(0.0f));
    const Vf mx = vf_load(map[0] + i) * (255.0f / 127.0f) - (128.0f / 127.0f);
    const Vf my = vf_load(map[1] + i) * (255.0f / 127.0f) - (128.0f / 127.0f);
    const Vf mz = vf_load(map[2] + i) * (255.0f / 127.0f) - (128.0f / 127.0f);
    facing.length2 = (mx * mx + my * my) + mz * mz;
    const Vf x = mx * shown;
    const Vf y = my * shown;
    const Vf3 n = {(to_u.x * x + to_v.x * y) + facing.mesh.x * mz,
                   (to_u.y * x + to_v.y * y) + facing.mesh.y * mz,
                   (to_u.z * x + to_v.z * y) + facing.mesh.z * mz};
    facing.mapped = vf3_scale(n, inverse_length(vf3_dot(n, n)));
    return facing;
}

// The fixed light on a normal, with a part of the sun; *sun: how steeply the sun meets it.
VEC_INLINE Vf fixed_light(Vf3 normal, Vf sunlit, Vf *sun) {
    *sun = vf_max(vf3_dot_sun(normal), vf_splat(0.0f));
    return (LIGHT_AMBIENT + normal.y * LIGHT_SKY) + (*sun * sunlit) * LIGHT_SUN;
}

// The sun's highlight, a GGX lobe that widens as the map's normals spread (Toksvig).
VEC_INLINE Vf highlight(const Facing *facing, Vf3 ray, Vf sun, Vf sunlit, float roughness) {
    const float alpha = roughness * roughness > LEAST_ALPHA ? roughness * roughness : LEAST_ALPHA;
    const Vf length = vf_max(vf_sqrt(facing->length2), vf_splat(0.1f));
    const Vf spread = vf_max(vf_splat(1.0f) / length - 1.0f, vf_splat(0.0f)) * 2.0f;
    const Vf alpha2 = vf_min(spread + alpha * alpha, vf_splat(1.0f));
    const Vf to_eye = vf_splat(0.0f) - inverse_length(vf3_dot(ray, ray));
    const Vf3 half = {ray.x * to_eye + SUN_X, ray.y * to_eye + SUN_Y, ray.z * to_eye + SUN_Z};
    const Vf inverse = inverse_length(vf3_dot(half, half));
    const Vf n_h = vf_max(vf3_dot(facing->mapped, half) * inverse, vf_splat(0.0f));
    const Vf l_h = vf3_dot_sun(half) * inverse;
    const Vf d = n_h * n_h * (alpha2 - 1.0f) + 1.0f;
    const Vf below =
        (d * d) * (vf_max(l_h * l_h, vf_splat(0.1f)) * (vf_sqrt(alpha2) * 4.0f + 2.0f));
    return (alpha2 / below) * ((sun * sunlit) * (REFLECTANCE * LIGHT_SUN));
}

// Lights the batch's colours by a light map, whose brightness says whether the sun is there.
VEC_INLINE void light_by_map(DipFragmentBatch *batch, float (*map)[DIP_FRAGMENT_BATCH],
                             float (*light)[DIP_FRAGMENT_BATCH]) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        const Vf3 ray = view_ray(uniforms->rays, batch, i);
        const Facing facing = find_facing(batch, i, ray, map);
        const Vf3 baked = vf3_scale(vf3_load(light, i), vf_splat(uniforms->light_map_scale));
        const Vf luminance = (baked.x * 0.2126f + baked.y * 0.7152f) + baked.z * 0.0722f;
        const Vf sunlit = clamp01((luminance - SHADE_LIGHT) * (1.0f / SUNLIT_LIGHT));
        Vf sun;
        const Vf flat = fixed_light(facing.mesh, sunlit, &sun);
        const Vf mapped = fixed_light(facing.mapped, sunlit, &sun);
        const Vf ratio =
            vf_min(vf_max(mapped / flat, vf_splat(LEAST_RATIO)), vf_splat(GREATEST_RATIO));
        const Vf shine = highlight(&facing, ray, sun, sunlit, uniforms->roughness);
        vf_store(batch->colour[0] + i, vf_load(batch->colour[0] + i) * (baked.x * ratio) + shine);
        vf_store(batch->colour[1] + i, vf_load(batch->colour[1] + i) * (baked.y * ratio) + shine);
        vf_store(batch->colour[2] + i, vf_load(batch->colour[2] + i) * (baked.z * ratio) + shine);
    }
}

VEC_INLINE void light_by_sun(DipFragmentBatch *batch, float (*map)[DIP_FRAGMENT_BATCH]) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        const Vf3 ray = view_ray(uniforms->rays, batch, i);
        const Facing facing = find_facing(batch, i, ray, map);
        Vf sun;
        const Vf light = fixed_light(facing.mapped, vf_splat(1.0f), &sun);
        const Vf shine = highlight(&facing, ray, sun, vf_splat(1.0f), uniforms->roughness);
        for (int c = 0; c < 3; c++) {
            vf_store(batch->colour[c] + i, vf_load(batch->colour[c] + i) * light + shine);
        }
    }
}

void DIP_KERNEL(dip_kernel_normal_map_fragment)(DipFragmentBatch *batch) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    float texture[3][DIP_FRAGMENT_BATCH];
    float map[3][DIP_FRAGMENT_BATCH];
    start_colour(batch, texture);
    if (uniforms->light_slot != DIP_NO_SLOT) {
        scale_colour(batch, batch->slot + uniforms->light_slot, 1.0f);
    }
    batch->sample_colour(batch, &batch->samplers[DIP_SURFACE_SAMPLER_NORMAL_MAP],
                         uniforms->normal_map_slot, map);
    if (uniforms->light_map_slot != DIP_NO_SLOT) {
        batch->sample_colour(batch, &batch->samplers[DIP_SURFACE_SAMPLER_LIGHT_MAP],
                             uniforms->light_map_slot, texture);
        light_by_map(batch, map, texture);
    } else {
        light_by_sun(batch, map);
    }
    batch->work.normal_mapped += (uint64_t)batch->count;
}
