// Shaders of the scene's surfaces, compiled once per instruction set.
#include "renderer/raster/kernels.h"
#include "renderer/shading/surface.h"
#include "renderer/simd/vec.h"

// The fixed light of surfaces without a light map: sky from above, sun from SUN.
#define LIGHT_AMBIENT 0.35f
#define LIGHT_SKY     0.15f
#define LIGHT_SUN     0.65f
// (-0.42, 0.67, 0.61) normalised.
#define SUN_X -0.42046720f
#define SUN_Y 0.67074529f
#define SUN_Z 0.61067856f

VEC_INLINE Vf row(const float *m, Vf x, Vf y, Vf z) {
    return ((x * m[0] + y * m[1]) + z * m[2]) + m[3];
}

VEC_INLINE Vf light_of(const DipSurfaceUniforms *uniforms, const DipVertexBatch *batch, int i) {
    const float *const *normal = batch->in + uniforms->normal_attribute;
    const float *m = uniforms->normal_to_world;
    const Vf nx = vf_load(normal[0] + i);
    const Vf ny = vf_load(normal[1] + i);
    const Vf nz = vf_load(normal[2] + i);
    const Vf x = (nx * m[0] + ny * m[1]) + nz * m[2];
    const Vf y = (nx * m[3] + ny * m[4]) + nz * m[5];
    const Vf z = (nx * m[6] + ny * m[7]) + nz * m[8];
    const Vf length2 = (x * x + y * y) + z * z;
    const Vf inverse = vf_splat(1.0f) / vf_sqrt(vf_max(length2, vf_splat(1e-12f)));
    const Vf sun = ((x * SUN_X + y * SUN_Y) + z * SUN_Z) * inverse;
    return (LIGHT_AMBIENT + y * inverse * LIGHT_SKY) + vf_max(sun, vf_splat(0.0f)) * LIGHT_SUN;
}

void DIP_KERNEL(dip_kernel_surface_vertex)(const DipVertexBatch *batch) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        const Vf x = vf_load(batch->in[0] + i);
        const Vf y = vf_load(batch->in[1] + i);
        const Vf z = vf_load(batch->in[2] + i);
        for (int c = 0; c < 4; c++) {
            vf_store(batch->clip[c] + i, row(uniforms->to_clip + 4 * c, x, y, z));
        }
        for (int s = 0; s < uniforms->pass_count; s++) {
            vf_store(batch->slot[s] + i, vf_load(batch->in[3 + s] + i));
        }
        if (uniforms->light_slot == DIP_NO_SLOT) {
            continue;
        }
        const Vf light = uniforms->normal_attribute == DIP_NO_SLOT ? vf_splat(1.0f)
                                                                   : light_of(uniforms, batch, i);
        for (int c = 0; c < 3; c++) {
            const Vf colour = uniforms->colour_attribute == DIP_NO_SLOT
                                  ? vf_splat(1.0f)
                                  : vf_load(batch->in[uniforms->colour_attribute + c] + i);
            vf_store(batch->slot[uniforms->light_slot + c] + i, light * colour);
        }
    }
}

static void scale_colour(DipFragmentBatch *batch, float (*factor)[DIP_FRAGMENT_BATCH],
                         float scale) {
    for (int c = 0; c < 3; c++) {
        for (int i = 0; i < batch->count; i += DIP_LANES) {
            vf_store(batch->colour[c] + i,
                     vf_load(batch->colour[c] + i) * (vf_load(factor[c] + i) * scale));
        }
    }
}

void DIP_KERNEL(dip_kernel_surface_fragment)(DipFragmentBatch *batch) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    float texture[3][DIP_FRAGMENT_BATCH];
    for (int c = 0; c < 3; c++) {
        for (int i = 0; i < batch->count; i += DIP_LANES) {
            vf_store(batch->colour[c] + i, vf_splat(uniforms->base_colour_lin[c]));
        }
    }
    if (uniforms->colour_slot != DIP_NO_SLOT) {
        batch->sample_colour(batch, &batch->samplers[DIP_SURFACE_SAMPLER_COLOUR],
                             uniforms->colour_slot, texture);
        scale_colour(batch, texture, 1.0f);
    }
    if (uniforms->light_map_slot != DIP_NO_SLOT) {
        batch->sample_colour(batch, &batch->samplers[DIP_SURFACE_SAMPLER_LIGHT_MAP],
                             uniforms->light_map_slot, texture);
        scale_colour(batch, texture, uniforms->light_map_scale);
    }
    if (uniforms->light_slot != DIP_NO_SLOT) {
        scale_colour(batch, batch->slot + uniforms->light_slot, 1.0f);
    }
}

void DIP_KERNEL(dip_kernel_surface_clip)(DipFragmentBatch *batch) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    float alpha[DIP_FRAGMENT_BATCH];
    batch->sample_alpha(batch, &batch->samplers[DIP_SURFACE_SAMPLER_COLOUR], uniforms->colour_slot,
                        alpha);
    for (int i = 0; i < batch->count; i++) {
        batch->keep[i] = alpha[i] >= uniforms->alpha_cutoff;
    }
}
