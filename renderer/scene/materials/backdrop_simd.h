// Reads the backdrop of rough glass; only *_simd.c files may include this header.
#ifndef DIP_RENDERER_SCENE_MATERIALS_BACKDROP_SIMD_H
#define DIP_RENDERER_SCENE_MATERIALS_BACKDROP_SIMD_H

#include "renderer/scene/materials/backdrop.h"
#include "renderer/scene/materials/surface_simd.h"

// The four texels along an axis that a read uses, and their weights.
typedef struct Taps {
    Vi at[4];
    Vf weight[4];
} Taps;

// Finds the texels around a position and the weights of the uniform cubic B-spline. Beyond the
// border, the last texel is repeated. Lanes without a fragment may have any position, even NaN.
VEC_INLINE Taps find_taps(Vf position, Vi size) {
    const Vf centred = position - 0.5f;
    const Vf bounded = vf_min(vf_max(centred, vf_splat(-1.0f)), vf_from_int(size));
    const Vf floor = vf_floor(bounded);
    const Vf t = bounded - floor;
    const Vf rest = 1.0f - t;
    const Vi first = vi_from_float(floor);
    Taps taps;
    for (int k = 0; k < 4; k++) {
        taps.at[k] = vi_min(vi_max(first + (k - 1), vi_splat(0)), size - 1);
    }
    const float sixth = 1.0f / 6.0f;
    taps.weight[0] = (rest * rest) * rest * sixth;
    taps.weight[1] = ((t * t) * (t * 3.0f - 6.0f) + 4.0f) * sixth;
    taps.weight[2] = ((rest * rest) * (rest * 3.0f - 6.0f) + 4.0f) * sixth;
    taps.weight[3] = (t * t) * t * sixth;
    return taps;
}

// Adds a share of what a level has at a position (x, y) of the picture.
VEC_INLINE void add_backdrop_level(const DipBackdrop *backdrop, Vi level, Vf x, Vf y, Vf share,
                                   Vf sum[3]) {
    const Vi width = vi_gather(backdrop->width, level);
    const Taps across = find_taps(x * vf_gather(backdrop->across, level), width);
    const Vi height = vi_gather(backdrop->height, level);
    const Taps down = find_taps(y * vf_gather(backdrop->down, level), height);
    const Vi first = vi_gather(backdrop->first, level);
    for (int j = 0; j < 4; j++) {
        const Vi row = first + down.at[j] * width;
        const Vf of_row = down.weight[j] * share;
        for (int i = 0; i < 4; i++) {
            const Vi at = (row + across.at[i]) * 2;
            const Vi words[2] = {vi_gather(backdrop->texels, at),
                                 vi_gather(backdrop->texels, at + 1)};
            const Vf weight = across.weight[i] * of_row;
            sum[0] = sum[0] + vf_from_int(words[0] & 65535) * weight;
            sum[1] = sum[1] + vf_from_int(words[0] >> 16 & 65535) * weight;
            sum[2] = sum[2] + vf_from_int(words[1]) * weight;
        }
    }
}

// Reads the backdrop at a position (x, y) of the picture, blurred for a roughness.
VEC_INLINE void read_backdrop(const DipBackdrop *backdrop, Vf x, Vf y, Vf roughness, Vf light[3]) {
    const Vf wanted = roughness * backdrop->level_range + backdrop->least_level;
    const Vf top = vf_splat((float)(backdrop->count - 1));
    const Vf level = vf_min(vf_max(wanted, vf_splat(0.0f)), top);
    const Vf floor = vf_floor(level);
    const Vf share = (level - floor) * (1.0f / 65535.0f);
    const Vi finer = vi_from_float(floor);
    const Vi coarser = vi_min(finer + 1, vi_splat(backdrop->count - 1));
    light[0] = light[1] = light[2] = vf_splat(0.0f);
    add_backdrop_level(backdrop, finer, x, y, (1.0f / 65535.0f) - share, light);
    add_backdrop_level(backdrop, coarser, x, y, share, light);
}

#endif
