// The shaders of plain and alpha-clipped surfaces. Compiled once per instruction set.
#include "renderer/scene/materials/surface_simd.h"

#include "renderer/scene/materials/material_kernels.h"

// Computes the fixed light of sky and sun on a vertex.
VEC_INLINE Vf light_of(const DipSurfaceUniforms *uniforms, const DipVertexBatch *batch, int i) {
    const Vf3 n = turn_normal(uniforms, batch, i);
    const Vf inverse = inverse_length(vf3_dot(n, n));
    const Vf sun = vf3_dot_sun(n) * inverse;
    return (LIGHT_AMBIENT + n.y * inverse * LIGHT_SKY) + vf_max(sun, vf_splat(0.0f)) * LIGHT_SUN;
}

void DIP_KERNEL(dip_kernel_surface_vertex)(const DipVertexBatch *batch) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        transform_vertices(uniforms, batch, i);
        if (uniforms->light_varying == DIP_ABSENT) {
            continue;
        }
        const Vf light = uniforms->normal_attribute == DIP_ABSENT ? vf_splat(1.0f)
                                                                  : light_of(uniforms, batch, i);
        for (int c = 0; c < 3; c++) {
            const Vf colour = uniforms->colour_attribute == DIP_ABSENT
                                  ? vf_splat(1.0f)
                                  : vf_load(batch->in[uniforms->colour_attribute + c] + i);
            vf_store(batch->varying[uniforms->light_varying + c] + i, light * colour);
        }
    }
}

void DIP_KERNEL(dip_kernel_surface_fragment)(DipFragmentBatch *batch) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    float texture[3][DIP_FRAGMENT_BATCH];
    float light_map[3][DIP_FRAGMENT_BATCH];
    Factor factors[3];
    int count = 0;
    if (uniforms->colour_varying != DIP_ABSENT) {
        batch->sample_colour(batch, &batch->samplers[DIP_SURFACE_SAMPLER_COLOUR],
                             uniforms->colour_varying, texture);
        factors[count++] = (Factor){texture, 1.0f};
    }
    if (uniforms->light_map_varying != DIP_ABSENT) {
        batch->sample_colour(batch, &batch->samplers[DIP_SURFACE_SAMPLER_LIGHT_MAP],
                             uniforms->light_map_varying, light_map);
        factors[count++] = (Factor){light_map, uniforms->light_map_scale};
    }
    if (uniforms->light_varying != DIP_ABSENT) {
        factors[count++] = (Factor){batch->varying + uniforms->light_varying, 1.0f};
    }
    switch (count) {
    case 0:
        set_colour(batch, factors, 0);
        break;
    case 1:
        set_colour(batch, factors, 1);
        break;
    case 2:
        set_colour(batch, factors, 2);
        break;
    default:
        set_colour(batch, factors, 3);
        break;
    }
}

void DIP_KERNEL(dip_kernel_surface_clip)(DipFragmentBatch *batch) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    float alpha[DIP_FRAGMENT_BATCH];
    read_alpha(batch, alpha);
    for (int i = 0; i < batch->count; i++) {
        batch->keep[i] = alpha[i] >= uniforms->alpha_cutoff;
    }
}

// Does what dip_alpha_to_coverage does, for a vector of fragments.
VEC_INLINE Vi alpha_to_coverage(Vf alpha, Vf slope, float cutoff, int sample_count) {
    const Vf over = vf_min(vf_max(alpha - cutoff, vf_splat(-512.0f)), vf_splat(512.0f));
    const Vf least = vf_max(vf_min(slope, vf_splat(1024.0f)), vf_splat(DIP_LEAST_ALPHA_SLOPE));
    const Vi width = vi_from_float(least * 65536.0f);
    const Vi below = vi_select(vf_lt(over, vf_splat(0.0f)), vi_splat(1), vi_splat(0));
    const Vi distance = vi_from_float(over * 65536.0f) - below;
    const Vi share = (distance + distance + width) * sample_count + width;
    Vi covered = vi_splat(0);
    Vi needed = width + width;
    for (int n = 1; n <= sample_count; n++) {
        covered += vi_select(vi_lt(share, needed), vi_splat(0), vi_splat(1));
        needed += width + width;
    }
    return covered;
}

// Reads the alpha of the texture and the vertices, and bounds how fast it changes: the changes of
// both factors are added.
VEC_INLINE void read_alpha_slope(DipFragmentBatch *batch, float *alpha, float *slope) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    const int varying = uniforms->alpha_varying;
    if (uniforms->colour_varying != DIP_ABSENT) {
        batch->sample_alpha_slope(batch, &batch->samplers[DIP_SURFACE_SAMPLER_COLOUR],
                                  uniforms->colour_varying, alpha, slope);
    }
    if (varying == DIP_ABSENT) {
        return;
    }
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        const Vf own = vertex_alpha(batch, i);
        const Vf change = vf_abs(vf_load(batch->varying_dx[varying] + i)) +
                          vf_abs(vf_load(batch->varying_dy[varying] + i));
        if (uniforms->colour_varying == DIP_ABSENT) {
            vf_store(alpha + i, own);
            vf_store(slope + i, change);
        } else {
            const Vf texture = vf_load(alpha + i);
            vf_store(alpha + i, texture * own);
            vf_store(slope + i, vf_load(slope + i) * own + texture * change);
        }
    }
}

void DIP_KERNEL(dip_kernel_surface_cover)(DipFragmentBatch *batch) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    float alpha[DIP_FRAGMENT_BATCH];
    float slope[DIP_FRAGMENT_BATCH];
    int32_t covered[DIP_FRAGMENT_BATCH];
    read_alpha_slope(batch, alpha, slope);
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        vi_store(covered + i, alpha_to_coverage(vf_load(alpha + i), vf_load(slope + i),
                                                uniforms->alpha_cutoff, uniforms->sample_count));
    }
    for (int i = 0; i < batch->count; i++) {
        batch->keep[i] = (uint8_t)covered[i];
    }
}

// Computes the colour of a blended surface by the shader that an opaque one would have, and its
// alpha.
void DIP_KERNEL(dip_kernel_blended_fragment)(DipFragmentBatch *batch) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    uniforms->colour_shader(batch);
    read_opacity(batch, batch->alpha);
}
