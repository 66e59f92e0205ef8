// Reads environments; only *_simd.c files may include this header.
#ifndef DIP_RENDERER_SCENE_MATERIALS_ENVIRONMENT_SIMD_H
#define DIP_RENDERER_SCENE_MATERIALS_ENVIRONMENT_SIMD_H

#include "renderer/scene/materials/environment.h"
#include "renderer/scene/materials/surface_simd.h"

VEC_INLINE void add_texel(Vi texel, Vf share, Vf sum[3]) {
    const Vi exponent = (Vi)((Vu)texel >> 27) + (127 - 24);
    const Vf scale = share * vf_bits(exponent << 23);
    sum[0] = sum[0] + vf_from_int(texel & 511) * scale;
    sum[1] = sum[1] + vf_from_int(texel >> 9 & 511) * scale;
    sum[2] = sum[2] + vf_from_int(texel >> 18 & 511) * scale;
}

// Adds a share of what a level has at u, v, which are 0..1.
VEC_INLINE void add_level(const DipEnvironmentMap *map, Vi level, Vf u, Vf v, Vf share, Vf sum[3]) {
    const Vi cells = vi_gather(map->cells, level);
    const Vf size = vf_from_int(cells);
    const Vi column = vi_min(vi_from_float(u * size), cells - 1);
    const Vi row = vi_min(vi_from_float(v * size), cells - 1);
    const Vf right = u * size - vf_from_int(column);
    const Vf below = (v * size - vf_from_int(row)) * share;
    const Vf above = share - below;
    const Vi at = vi_gather(map->first, level) + row * (cells + 1) + column;
    add_texel(vi_gather(map->texels, at), above - above * right, sum);
    add_texel(vi_gather(map->texels, at + 1), above * right, sum);
    add_texel(vi_gather(map->texels, at + cells + 1), below - below * right, sum);
    add_texel(vi_gather(map->texels, at + cells + 2), below * right, sum);
}

// Computes the light that a lobe of some roughness, 0..1, sees around a direction of any length.
VEC_INLINE void read_environment(const DipEnvironmentMap *map, Vf3 towards, Vf roughness,
                                 Vf sum[3]) {
    const Vf zero = vf_splat(0.0f);
    const Vf length = (vf_abs(towards.x) + vf_abs(towards.y)) + vf_abs(towards.z);
    const Vf inverse = 1.0f / vf_max(length, vf_splat(1e-12f));
    const Vf x = towards.x * inverse;
    const Vf z = towards.z * inverse;
    const Mask below = vf_lt(towards.y, zero);
    const Vf far_x = 1.0f - vf_abs(z);
    const Vf far_z = 1.0f - vf_abs(x);
    const Vf folded_x = vf_select(vf_lt(x, zero), zero - far_x, far_x);
    const Vf folded_z = vf_select(vf_lt(z, zero), zero - far_z, far_z);
    const Vf u = clamp01(vf_select(below, folded_x, x) * 0.5f + 0.5f);
    const Vf v = clamp01(vf_select(below, folded_z, z) * 0.5f + 0.5f);
    const int last = DIP_ENVIRONMENT_LEVELS - 1;
    const Vf height = clamp01(roughness) * (float)last;
    const Vi level = vi_min(vi_from_float(height), vi_splat(last - 1));
    const Vf share = height - vf_from_int(level);
    sum[0] = sum[1] = sum[2] = zero;
    add_level(map, level, u, v, 1.0f - share, sum);
    add_level(map, level + 1, u, v, share, sum);
}

// Computes the light that falls on a white matt surface with the unit normal (x, y, z).
VEC_INLINE void soft_light_of(const DipEnvironmentMap *map, Vf x, Vf y, Vf z, Vf soft[3]) {
    const Vf terms[8] = {x, y, z, x * y, y * z, x * z, x * x - y * y, z * z * 3.0f - 1.0f};
    for (int c = 0; c < 3; c++) {
        Vf sum = vf_splat(map->soft_lin[0][c]);
        for (int t = 0; t < 8; t++) {
            sum = sum + terms[t] * map->soft_lin[t + 1][c];
        }
        soft[c] = vf_max(sum, vf_splat(0.0f));
    }
}

#endif
