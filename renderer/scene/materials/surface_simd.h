// Code that the shaders of the scene's materials share; only *_simd.c files may include it.
#ifndef DIP_RENDERER_SCENE_MATERIALS_SURFACE_SIMD_H
#define DIP_RENDERER_SCENE_MATERIALS_SURFACE_SIMD_H

#include "renderer/pipeline/shader.h"
#include "renderer/scene/materials/surface.h"
#include "renderer/simd/vec.h"

// The fixed light of surfaces without a light map. It has three parts: ambient light, light of the
// sky from above and light of the sun from the direction SUN.
#define LIGHT_AMBIENT 0.35f
#define LIGHT_SKY     0.15f
#define LIGHT_SUN     0.65f
// The direction to the sun: (-0.42, 0.67, 0.61) normalised.
#define SUN_X -0.42054707f
#define SUN_Y 0.67087270f
#define SUN_Z 0.61079455f

typedef struct Vf3 {
    Vf x, y, z;
} Vf3;

VEC_INLINE Vf3 vf3_load(float (*rows)[DIP_FRAGMENT_BATCH], int i) {
    return (Vf3){vf_load(rows[0] + i), vf_load(rows[1] + i), vf_load(rows[2] + i)};
}

VEC_INLINE Vf vf3_dot(Vf3 a, Vf3 b) {
    return (a.x * b.x + a.y * b.y) + a.z * b.z;
}

VEC_INLINE Vf vf3_dot_sun(Vf3 a) {
    return (a.x * SUN_X + a.y * SUN_Y) + a.z * SUN_Z;
}

VEC_INLINE Vf3 vf3_scale(Vf3 a, Vf s) {
    return (Vf3){a.x * s, a.y * s, a.z * s};
}

// Squared lengths are at least this, so that no vector of length 0 gives a NaN. It is small enough
// to make unit vectors of interpolated normals that nearly cancel out.
#define LEAST_LENGTH2 1e-36f

// Returns 1 / sqrt(length2), or a finite value if length2 is 0.
VEC_INLINE Vf inverse_length(Vf length2) {
    return vf_splat(1.0f) / vf_sqrt(vf_max(length2, vf_splat(LEAST_LENGTH2)));
}

// Returns a power of two s for which 1 <= s * value < 2, for values from 2^-126 to 2^127. Returns
// 2^127 for 0.
VEC_INLINE Vf inverse_exponent(Vf value) {
    return vf_bits(vi_splat(254 << 23) - (vi_bits(value) & vi_splat(0x7f800000)));
}

VEC_INLINE Vf clamp01(Vf v) {
    return vf_min(vf_max(v, vf_splat(0.0f)), vf_splat(1.0f));
}

// Computes clip positions and copies attributes to varyings.
VEC_INLINE void transform_vertices(const DipSurfaceUniforms *uniforms, const DipVertexBatch *batch,
                                   int i) {
    const Vf x = vf_load(batch->in[0] + i) - uniforms->origin[0];
    const Vf y = vf_load(batch->in[1] + i) - uniforms->origin[1];
    const Vf z = vf_load(batch->in[2] + i) - uniforms->origin[2];
    for (int c = 0; c < 4; c++) {
        const float *m = uniforms->to_clip + 4 * c;
        vf_store(batch->clip[c] + i, ((x * m[0] + y * m[1]) + z * m[2]) + m[3]);
    }
    for (int s = 0; s < uniforms->copied_varying_count; s++) {
        vf_store(batch->varying[s] + i, vf_load(batch->in[3 + s] + i));
    }
}

// Returns a vertex's normal in world space, not normalised. It is scaled by a power of two until
// its greatest component is between 1 and 2, so that the squares of its components neither overflow
// nor vanish.
VEC_INLINE Vf3 turn_normal(const DipSurfaceUniforms *uniforms, const DipVertexBatch *batch, int i) {
    const float *const *normal = batch->in + uniforms->normal_attribute;
    const float *m = uniforms->normal_to_world;
    const Vf nx = vf_load(normal[0] + i);
    const Vf ny = vf_load(normal[1] + i);
    const Vf nz = vf_load(normal[2] + i);
    const Vf3 turned = {(nx * m[0] + ny * m[1]) + nz * m[2], (nx * m[3] + ny * m[4]) + nz * m[5],
                        (nx * m[6] + ny * m[7]) + nz * m[8]};
    const Vf greatest = vf_max(vf_max(vf_abs(turned.x), vf_abs(turned.y)), vf_abs(turned.z));
    return vf3_scale(turned, inverse_exponent(greatest));
}

// Returns the view ray of a fragment. It is not normalised; its component along the view axis is 1.
VEC_INLINE Vf3 view_ray(const DipViewRays *rays, const DipFragmentBatch *batch, int i) {
    const Vf x = vf_load(batch->x + i);
    const Vf y = vf_load(batch->y + i);
    return (Vf3){(x * rays->per_x[0] + y * rays->per_y[0]) + rays->origin[0],
                 (x * rays->per_x[1] + y * rays->per_y[1]) + rays->origin[1],
                 (x * rays->per_x[2] + y * rays->per_y[2]) + rays->origin[2]};
}

// Multiplies the batch's colours by factor * scale.
VEC_INLINE void scale_colour(DipFragmentBatch *batch, float (*factor)[DIP_FRAGMENT_BATCH],
                             float scale) {
    for (int c = 0; c < 3; c++) {
        for (int i = 0; i < batch->count; i += DIP_LANES) {
            vf_store(batch->colour[c] + i,
                     vf_load(batch->colour[c] + i) * (vf_load(factor[c] + i) * scale));
        }
    }
}

// Light that multiplies a colour: light times scale.
typedef struct Factor {
    float (*light)[DIP_FRAGMENT_BATCH];
    float scale;
} Factor;

// Sets the batch's colours to the base colour times `count` factors, in their order. Callers pass a
// constant count.
VEC_INLINE void set_colour(DipFragmentBatch *batch, const Factor *factors, int count) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        for (int c = 0; c < 3; c++) {
            Vf colour = vf_splat(uniforms->base_colour_lin[c]);
            for (int f = 0; f < count; f++) {
                colour *= vf_load(factors[f].light[c] + i) * factors[f].scale;
            }
            vf_store(batch->colour[c] + i, colour);
        }
    }
}

// Sets the batch's colours to the base colour.
VEC_INLINE void start_base_colour(DipFragmentBatch *batch) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    for (int c = 0; c < 3; c++) {
        for (int i = 0; i < batch->count; i += DIP_LANES) {
            vf_store(batch->colour[c] + i, vf_splat(uniforms->base_colour_lin[c]));
        }
    }
}

// Sets the batch's colours to base colour times texture. `texture` is scratch space for the
// texture's colours.
VEC_INLINE void start_colour(DipFragmentBatch *batch, float (*texture)[DIP_FRAGMENT_BATCH]) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    start_base_colour(batch);
    if (uniforms->colour_varying != DIP_ABSENT) {
        batch->sample_colour(batch, &batch->samplers[DIP_SURFACE_SAMPLER_COLOUR],
                             uniforms->colour_varying, texture);
        scale_colour(batch, texture, 1.0f);
    }
}

// Returns the alpha of the vertices, which rounding may have carried out of 0..1.
VEC_INLINE Vf vertex_alpha(const DipFragmentBatch *batch, int i) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    return clamp01(vf_load(batch->varying[uniforms->alpha_varying] + i));
}

// Reads the alpha of the texture and the vertices.
VEC_INLINE void read_alpha(DipFragmentBatch *batch, float *alpha) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    if (uniforms->colour_varying != DIP_ABSENT) {
        batch->sample_alpha(batch, &batch->samplers[DIP_SURFACE_SAMPLER_COLOUR],
                            uniforms->colour_varying, alpha);
    }
    if (uniforms->alpha_varying == DIP_ABSENT) {
        return;
    }
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        const Vf of_vertices = vertex_alpha(batch, i);
        vf_store(alpha + i, uniforms->colour_varying == DIP_ABSENT
                                ? of_vertices
                                : vf_load(alpha + i) * of_vertices);
    }
}

// Computes the share of what lies behind that a blended surface covers.
VEC_INLINE void read_opacity(DipFragmentBatch *batch, float *opacity) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    const bool varies =
        uniforms->colour_varying != DIP_ABSENT || uniforms->alpha_varying != DIP_ABSENT;
    if (varies && uniforms->has_alpha) {
        read_alpha(batch, opacity);
        for (int i = 0; i < batch->count; i += DIP_LANES) {
            vf_store(opacity + i, vf_load(opacity + i) * uniforms->opacity);
        }
        return;
    }
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        vf_store(opacity + i, vf_splat(uniforms->opacity));
    }
}

#endif
