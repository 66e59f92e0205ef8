// The sky's fragment shader: two layers of clouds that scroll and are displaced, both read from one
// texture. Compiled once per instruction set. docs/picture.md, Sky, defines the formulas.
#include "renderer/scene/materials/material_kernels.h"
#include "renderer/scene/materials/surface_simd.h"

// The last two varyings, which no sky mesh uses, hold the texture coordinates of a layer.
enum { LAYER_VARYING = DIP_MAX_VARYINGS - 2 };

// The shader assumes that a displacement of up to one texture width changes by at most this much
// per unit of texture coordinates. It enlarges a layer's derivatives accordingly, so that displaced
// clouds are read from coarse enough levels.
#define DISPLACEMENT_SLOPE 8.0f

// The densest clouds are darker than thin clouds by this fraction.
#define CLOUD_SHADE 0.2f

// Writes coordinates * scale to the layer's varyings. Their derivatives are multiplied by
// scale * steeper.
VEC_INLINE void scale_coordinates(DipFragmentBatch *batch, int varying, float scale,
                                  float steeper) {
    const float slope = scale * steeper;
    for (int k = 0; k < 2; k++) {
        for (int i = 0; i < batch->count; i += DIP_LANES) {
            vf_store(batch->varying[LAYER_VARYING + k] + i,
                     vf_load(batch->varying[varying + k] + i) * scale);
            vf_store(batch->varying_dx[LAYER_VARYING + k] + i,
                     vf_load(batch->varying_dx[varying + k] + i) * slope);
            vf_store(batch->varying_dy[LAYER_VARYING + k] + i,
                     vf_load(batch->varying_dy[varying + k] + i) * slope);
        }
    }
}

// Reads a layer's clouds into texels[2]: 0 is clear, 1 is dense.
VEC_INLINE void read_layer(DipFragmentBatch *batch, int layer,
                           float (*displacement)[DIP_FRAGMENT_BATCH],
                           float (*texels)[DIP_FRAGMENT_BATCH]) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    const DipSkyUniforms *sky = uniforms->sky;
    const float far = sky->layers[layer].perturbation_widths;
    scale_coordinates(batch, uniforms->colour_varying, sky->layers[layer].scale,
                      1.0f + DISPLACEMENT_SLOPE * (far < 0.0f ? -far : far));
    for (int k = 0; k < 2; k++) {
        const float phase = k == 0 ? sky->layers[layer].phase : 0.0f;
        for (int i = 0; i < batch->count; i += DIP_LANES) {
            const Vf push = (vf_load(displacement[k] + i) * 2.0f - 1.0f) * far + phase;
            float *coordinate = batch->varying[LAYER_VARYING + k] + i;
            vf_store(coordinate, vf_load(coordinate) + push);
        }
    }
    batch->sample_colour(batch, &batch->samplers[DIP_SURFACE_SAMPLER_COLOUR], LAYER_VARYING,
                         texels);
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        vf_store(texels[2] + i,
                 clamp01((vf_load(texels[2] + i) - sky->clear) * sky->inverse_range));
    }
}

// Weights of the colours in one direction of the sky.
typedef struct Weather {
    Vf cover; // how far clouds cover the clear sky
    Vf shade; // brightness of the clouds
    Vf haze;  // how far the horizon's colour covers the sky and the clouds
    Vf glare; // factor of the sun's glare, which is added
} Weather;

VEC_INLINE Weather find_weather(const DipSkyUniforms *sky, Vf3 ray, Vf density) {
    const Vf inverse = inverse_length(vf3_dot(ray, ray));
    const Vf edge = clamp01(density + (2.0f * sky->overcast - 1.0f));
    const Vf down = clamp01(1.0f - vf_max(ray.y * inverse, vf_splat(0.0f)));
    const Vf down2 = down * down;
    const Vf down4 = down2 * down2;
    const Vf sun = clamp01(vf3_dot_sun(ray) * inverse);
    const Vf sun2 = sun * sun;
    const Vf sun4 = sun2 * sun2;
    const Vf sun8 = sun4 * sun4;
    const Vf sun16 = sun8 * sun8;
    const Vf sun32 = sun16 * sun16;
    Weather weather;
    weather.cover = (edge * edge) * (3.0f - edge * 2.0f);
    weather.shade = 1.0f - (density * density) * CLOUD_SHADE;
    weather.haze = down4 * down4;
    weather.glare =
        (sun8 * 0.25f + (sun32 * sun32) * (sun32 * sun32)) * (1.0f - weather.cover * 0.6f);
    return weather;
}

void DIP_KERNEL(dip_kernel_sky_fragment)(DipFragmentBatch *batch) {
    const DipSurfaceUniforms *uniforms = batch->uniforms;
    const DipSkyUniforms *sky = uniforms->sky;
    float displacement[3][DIP_FRAGMENT_BATCH];
    float layers[2][3][DIP_FRAGMENT_BATCH];
    scale_coordinates(batch, uniforms->colour_varying, sky->perturbation_scale, 1.0f);
    batch->sample_colour(batch, &batch->samplers[DIP_SURFACE_SAMPLER_COLOUR], LAYER_VARYING,
                         displacement);
    read_layer(batch, 0, displacement, layers[0]);
    read_layer(batch, 1, displacement, layers[1]);
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        const Vf first = vf_load(layers[0][2] + i);
        const Vf density = first + (vf_load(layers[1][2] + i) - first) * sky->blend;
        const Weather weather = find_weather(sky, view_ray(uniforms->rays, batch, i), density);
        for (int c = 0; c < 3; c++) {
            const Vf clear = vf_splat(sky->zenith_lin[c]);
            const Vf cloud = weather.shade * sky->cloud_lin[c];
            const Vf near = clear + (cloud - clear) * weather.cover;
            const Vf hazy = near + (sky->horizon_lin[c] - near) * weather.haze;
            vf_store(batch->colour[c] + i,
                     (hazy + weather.glare * sky->glare_lin[c]) * sky->tint_lin[c]);
        }
    }
    batch->work.counts[DIP_SHADER_COUNT_SKY] += (uint64_t)batch->count;
}
