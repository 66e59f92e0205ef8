// The shaders of normal-mapped surfaces, which compute light and highlight per fragment. Compiled
// once per instruction set. docs/picture.md, Normal maps, defines the formulas.
#include "renderer/scene/materials/material_kernels.h"
#include "renderer/scene/materials/surface_simd.h"

// A surface is in the sun's shadow where its light map's luminance is at most SHADE_LIGHT. It is
// fully in the sun where the luminance is at least SHADE_LIGHT + SUNLIT_LIGHT.
#define SHADE_LIGHT  0.4f
#define SUNLIT_LIGHT 0.5f
// Bounds of the factor by which a mapped normal changes the light map.
#define LEAST_RATIO    0.25f
#define GREATEST_RATIO 2.5f
// Least component of a mapped normal along the mesh's normal. A footprint is the area of the map
// that a pixel covers. If the map's normals in this area cancel out, their mean has an accidental
// direction; this bound then keeps the mapped normal close to the mesh's normal.
#define LEAST_RISE 0.125f
// Reflectance of a dielectric seen along its normal, and the least width (GGX alpha) of its
// highlight.
#define REFLECTANCE 0.04f
#define LEAST_ALPHA 0.1f

void DIP_KERNEL(dip_kernel_normal_map_vertex)(const DipVertexBatch *batch) {
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

// The normals of a surface at the position that is shaded, in world space.
typedef struct Facing {
    Vf3 mesh;          // unit normal of the mesh
    Vf3 mapped;        // unit normal from the normal map
    Vf inverse_length; // 1 / length of the filtered normal in the map
} Facing;

// The derivative of depth * ray along x or y: how far the position on the surface moves per pixel.
VEC_INLINE Vf3 position_step(const float ray_step[3], Vf depth, Vf3 ray, Vf depth_step) {
    return (Vf3){depth * ray_step[0] + ray.x * depth_step, depth * ray_step[1] + ray.y * depth_step,
                 depth * ray_step[2] + ray.z * depth_step};
}

// a * s - b * t
VEC_INLINE Vf3 combine(Vf3 a, Vf s, Vf3 b, Vf t) {
    return (Vf3){a.x * s - b.x * t, a.y * s - b.y * t, a.z * s - b.z * t};
}

VEC_INLINE Vf3 cross(Vf3 a, Vf3 b) {
    return (Vf3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// Where the texture coordinates have (nearly) no area, only rounding decides the direction of their
// derivatives. AREA_LIMIT bounds the area relative to the derivatives' sizes (Coordinate). Rounding
// stays below 2^-22 of a size for coordinates within +-1, and below 2^-17 for coordinates within
// +-32. The mapped surfaces of the courtyard have at least 2^-5.
#define AREA_LIMIT 0x1p-14f
// Least squared tangent of the angle between the normal and the direction of growing u.
#define LEAST_TANGENT2 0x1p-20f

// Unit tangents that point along growing u and falling v. They are perpendicular to each other and
// to the normal. `there` is set where the tangents are valid. They are invalid, and may be NaN,
// where the texture coordinates have no area or u grows along the normal.
typedef struct Tangents {
    Vf3 u, v;
    Mask there;
} Tangents;

// The derivatives of a texture coordinate, and their size, which is relative to the depth.
typedef struct Coordinate {
    Vf dx, dy, size;
} Coordinate;

// Loads the derivatives of varying s. A derivative is the difference of two terms, of which one is
// proportional to the coordinate and to the derivative of the depth. The size includes that term,
// so that the derivative's rounding is small relative to the size. A large coordinate counts as 1
// there, because whole numbers may be added to coordinates without changing the picture.
VEC_INLINE Coordinate load_coordinate(const DipFragmentBatch *batch, int s, int i, Vf depth,
                                      Vf depth_change) {
    Coordinate c = {.dx = vf_load(batch->varying_dx[s] + i),
                    .dy = vf_load(batch->varying_dy[s] + i)};
    const Vf bounded = vf_min(vf_abs(vf_load(batch->varying[s] + i)), vf_splat(1.0f));
    c.size = (vf_abs(c.dx) + vf_abs(c.dy)) * depth + bounded * depth_change;
    return c;
}

// Finds the tangents from the derivatives of the position and of the texture coordinates. If the
// coordinates are mirrored, the tangents are mirrored too. Multiplying coordinates or positions by
// a power of two changes no bit of the result.
VEC_INLINE Tangents find_tangents(DipFragmentBatch *batch, int i, Vf3 ray, Vf3 normal) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    const int w = uniforms->depth_varying;
    const Vf depth = vf_load(batch->varying[w] + i);
    const Vf depth_dx = vf_load(batch->varying_dx[w] + i);
    const Vf depth_dy = vf_load(batch->varying_dy[w] + i);
    const Vf depth_change = vf_abs(depth_dx) + vf_abs(depth_dy);
    const Vf3 dx = position_step(uniforms->rays->per_x, depth, ray, depth_dx);
    const Vf3 dy = position_step(uniforms->rays->per_y, depth, ray, depth_dy);
    const int s = uniforms->normal_map_varying;
    const Coordinate u = load_coordinate(batch, s, i, depth, depth_change);
    Coordinate v = load_coordinate(batch, s + 1, i, depth, depth_change);
    const Vf scale = inverse_exponent(v.size);
    v = (Coordinate){v.dx * scale, v.dy * scale, v.size * scale};
    const Vf area = u.dx * v.dy - u.dy * v.dx;
    // The direction of growing u, multiplied by the area.
    const Vf3 along = combine(dx, v.dy, dy, v.dx);
    const Vf rise = vf3_dot(along, normal);
    const Vf3 flat = {along.x - normal.x * rise, along.y - normal.y * rise,
                      along.z - normal.z * rise};
    const Vf length2 = vf3_dot(flat, flat);
    const Mask has_area = vf_lt(u.size * v.size * AREA_LIMIT, vf_abs(area) * depth * depth);
    const Mask is_flat = vf_lt(rise * rise * LEAST_TANGENT2, length2);
    const Vf inverse = vf_splat(1.0f) / vf_sqrt(length2);
    const Vf sign = vf_select(vf_lt(area, vf_splat(0.0f)), vf_splat(0.0f) - inverse, inverse);
    Tangents tangents = {.u = vf3_scale(flat, sign), .there = has_area & is_flat};
    tangents.v = cross(normal, tangents.u);
    // The directions of growing u and growing v are in the same order as the derivatives of the
    // position along x and y if the area is positive, and in the other order if it is negative.
    const Vf hand = vf3_dot(cross(dx, dy), normal) * area;
    const Mask left = vf_lt(vf_splat(0.0f), hand);
    tangents.v = vf3_scale(tangents.v, vf_select(left, vf_splat(-1.0f), vf_splat(1.0f)));
    return tangents;
}

VEC_INLINE Facing find_facing(DipFragmentBatch *batch, int i, Vf3 ray,
                              float (*map)[DIP_FRAGMENT_BATCH]) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    const Vf3 vertex = vf3_load(batch->varying + uniforms->normal_varying, i);
    Facing facing = {.mesh = vf3_scale(vertex, inverse_length(vf3_dot(vertex, vertex)))};
    const Tangents tangents = find_tangents(batch, i, ray, facing.mesh);
    Vf3 m = vf3_load(map, i);
    m.x = m.x * (255.0f / 127.0f) - (128.0f / 127.0f);
    m.y = m.y * (255.0f / 127.0f) - (128.0f / 127.0f);
    m.z = vf_max(m.z * (255.0f / 127.0f) - (128.0f / 127.0f), vf_splat(LEAST_RISE));
    facing.inverse_length = inverse_length(vf3_dot(m, m));
    m = vf3_scale(m, facing.inverse_length);
    const Vf3 n = facing.mesh;
    const Vf3 mapped = {(tangents.u.x * m.x + tangents.v.x * m.y) + n.x * m.z,
                        (tangents.u.y * m.x + tangents.v.y * m.y) + n.y * m.z,
                        (tangents.u.z * m.x + tangents.v.z * m.y) + n.z * m.z};
    facing.mapped =
        (Vf3){vf_select(tangents.there, mapped.x, n.x), vf_select(tangents.there, mapped.y, n.y),
              vf_select(tangents.there, mapped.z, n.z)};
    return facing;
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

// Sets the batch's colours to base colour times texture, and reads the normal map. If both textures
// have the same coordinates, one call samples both.
VEC_INLINE void start_mapped_colour(DipFragmentBatch *batch, float (*texture)[DIP_FRAGMENT_BATCH],
                                    float (*map)[DIP_FRAGMENT_BATCH]) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    const DipSampler *const samplers[2] = {&batch->samplers[DIP_SURFACE_SAMPLER_COLOUR],
                                           &batch->samplers[DIP_SURFACE_SAMPLER_NORMAL_MAP]};
    if (uniforms->colour_varying == uniforms->normal_map_varying) {
        float(*const out[2])[DIP_FRAGMENT_BATCH] = {texture, map};
        start_base_colour(batch);
        batch->sample_colours(batch, samplers, uniforms->colour_varying, out);
        scale_colour(batch, texture, 1.0f);
    } else {
        start_colour(batch, texture);
        batch->sample_colour(batch, samplers[1], uniforms->normal_map_varying, map);
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
