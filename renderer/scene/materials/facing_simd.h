// Finds the normal of a fragment, with or without a normal map; only *_simd.c files may include it.
// docs/picture.md, Normal maps, defines the formulas.
#ifndef DIP_RENDERER_SCENE_MATERIALS_FACING_SIMD_H
#define DIP_RENDERER_SCENE_MATERIALS_FACING_SIMD_H

#include "renderer/scene/materials/surface_simd.h"

// Least component of a mapped normal along the mesh's normal. A footprint is the area of the map
// that a pixel covers. If the map's normals in this area cancel out, their mean has an accidental
// direction; this bound then keeps the mapped normal close to the mesh's normal.
#define LEAST_RISE 0.125f

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

// Returns a normal of the triangle itself at a fragment, of any length and to either side.
VEC_INLINE Vf3 triangle_normal(const DipFragmentBatch *batch, int i, Vf3 ray, Vf depth) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    const int w = uniforms->depth_varying;
    return cross(
        position_step(uniforms->rays->per_x, depth, ray, vf_load(batch->varying_dx[w] + i)),
        position_step(uniforms->rays->per_y, depth, ray, vf_load(batch->varying_dy[w] + i)));
}

// Where the texture coordinates have (nearly) no area, only rounding decides the direction of their
// derivatives. AREA_LIMIT bounds the area relative to the derivatives' sizes (Coordinate). Rounding
// stays below 2^-22 of a size for coordinates within +-1 and for those of axes along which a
// texture is clamped, and below 2^-17 for repeating coordinates within +-32. The mapped surfaces of
// the courtyard have at least 2^-5.
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

// Loads the derivatives of one of the normal map's two coordinates. A derivative is the difference
// of two terms, of which one is proportional to the coordinate and to the derivative of the depth.
// The size includes that term, so that the derivative's rounding is small relative to the size. A
// large coordinate of a repeating axis counts as 1 there, because whole numbers may be added to it
// without changing the picture. Set-up has reduced it, so its rounding is small, too.
VEC_INLINE Coordinate load_coordinate(const DipFragmentBatch *batch, int axis, int i, Vf depth,
                                      Vf depth_change) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    const int s = uniforms->normal_map_varying + axis;
    Coordinate c = {.dx = vf_load(batch->varying_dx[s] + i),
                    .dy = vf_load(batch->varying_dy[s] + i)};
    const Vf bounded =
        vf_min(vf_abs(vf_load(batch->varying[s] + i)), vf_splat(uniforms->coordinate_bounds[axis]));
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
    const Coordinate u = load_coordinate(batch, 0, i, depth, depth_change);
    Coordinate v = load_coordinate(batch, 1, i, depth, depth_change);
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

// Returns the unit normal of the mesh at a fragment.
VEC_INLINE Vf3 mesh_normal(DipFragmentBatch *batch, int i) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    const Vf3 vertex = vf3_load(batch->varying + uniforms->normal_varying, i);
    return vf3_scale(vertex, inverse_length(vf3_dot(vertex, vertex)));
}

// scale multiplies x and y of the map's normals. The length of the filtered normal is that before.
VEC_INLINE Facing find_scaled_facing(DipFragmentBatch *batch, int i, Vf3 ray,
                                     float (*map)[DIP_FRAGMENT_BATCH], float scale) {
    Facing facing = {.mesh = mesh_normal(batch, i)};
    const Tangents tangents = find_tangents(batch, i, ray, facing.mesh);
    Vf3 m = vf3_load(map, i);
    m.x = m.x * (255.0f / 127.0f) - (128.0f / 127.0f);
    m.y = m.y * (255.0f / 127.0f) - (128.0f / 127.0f);
    m.z = vf_max(m.z * (255.0f / 127.0f) - (128.0f / 127.0f), vf_splat(LEAST_RISE));
    facing.inverse_length = inverse_length(vf3_dot(m, m));
    if (scale == 1.0f) {
        m = vf3_scale(m, facing.inverse_length);
    } else {
        m = (Vf3){m.x * scale, m.y * scale, m.z};
        m = vf3_scale(m, inverse_length(vf3_dot(m, m)));
    }
    const Vf3 n = facing.mesh;
    const Vf3 mapped = {(tangents.u.x * m.x + tangents.v.x * m.y) + n.x * m.z,
                        (tangents.u.y * m.x + tangents.v.y * m.y) + n.y * m.z,
                        (tangents.u.z * m.x + tangents.v.z * m.y) + n.z * m.z};
    facing.mapped =
        (Vf3){vf_select(tangents.there, mapped.x, n.x), vf_select(tangents.there, mapped.y, n.y),
              vf_select(tangents.there, mapped.z, n.z)};
    return facing;
}

VEC_INLINE Facing find_facing(DipFragmentBatch *batch, int i, Vf3 ray,
                              float (*map)[DIP_FRAGMENT_BATCH]) {
    return find_scaled_facing(batch, i, ray, map, 1.0f);
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

#endif
