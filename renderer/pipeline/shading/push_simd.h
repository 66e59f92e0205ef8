// Adds the fragments of a sub-block to the lists of their draws. Pixels whose samples all show one
// patch are added draw by draw. Pixels that show several patches are added patch by patch. Only
// kernels (*_simd.c) include this header.
#ifndef DIP_RENDERER_PIPELINE_SHADING_PUSH_SIMD_H
#define DIP_RENDERER_PIPELINE_SHADING_PUSH_SIMD_H

#include "renderer/pipeline/shading/sub_block_simd.h"

#include <string.h>

// Adds a draw to the active draws: the draws whose lists this tile uses.
static inline void activate(DipTileShading *shading, uint32_t draw) {
    if (!shading->is_active[draw]) {
        shading->is_active[draw] = 1;
        shading->active[shading->active_count++] = draw;
    }
}

// Returns a fragment's position (raster/fragments.h). x, y: the pixel in the tile; sub_x, sub_y:
// the shaded point in the pixel, in 1/256 pixel.
VEC_INLINE int32_t position_at(int x, int y, int sub_x, int sub_y) {
    return (y * DIP_TILE + x) | sub_x << DIP_POSITION_SUB_X | sub_y << DIP_POSITION_SUB_Y;
}

// Does so for the first pixel of a sub-block.
VEC_INLINE int32_t position_of(const SubBlock *sub, int sub_x, int sub_y) {
    return position_at(sub->x0, sub->y0, sub_x, sub_y);
}

// Adds a sub-block in which all 16 pixels show the same draw, and each pixel shows one patch. Its
// 16 fragments stay together in the draw's list of whole sub-blocks. ids: those of the first
// samples of the sub-block's pixels; centre: position of the centre of its first pixel.
VEC_INLINE void push_whole(DipTileShading *shading, const uint32_t *ids, int32_t centre,
                           uint32_t draw) {
    activate(shading, draw);
    DipFragmentList *list = &shading->whole_lists[draw];
    for (int v = 0; v < VECTORS; v++) {
        vi_store((int32_t *)list->triangle + list->count + v * DIP_LANES,
                 vi_load((const int32_t *)ids + v * DIP_LANES) - 1);
        vi_store((int32_t *)list->position + list->count + v * DIP_LANES,
                 vi_load(pixel_position + v * DIP_LANES) + centre);
    }
    list->count += DIP_SUB_BLOCK_PIXELS;
    if (list->count == DIP_FRAGMENT_BATCH) {
        shading->flush_whole(shading, draw);
    }
}

// Adds pixels as fragments of a draw. Triangle ids, samples and positions are given as vectors.
// uniform: whether all fragments hold the same samples.
VEC_INLINE void push(const SubBlock *sub, uint32_t draw, unsigned pixels, const Vu *ids,
                     const Vu *samples, const Vu *positions, bool uniform) {
    DipTileShading *shading = sub->shading;
    activate(shading, draw);
    DipFragmentList *list = &shading->lists[draw];
    for (int v = 0; v < VECTORS; v++) {
        const unsigned bits = pixels >> (v * DIP_LANES) & VEC_ALL_LANES;
        if (uniform) {
            vu_store(list->samples + list->count, samples[v]);
        } else {
            vu_compress(list->samples + list->count, bits, samples[v]);
        }
        vu_compress(list->triangle + list->count, bits, ids[v] - 1u);
        list->count += vu_compress(list->position + list->count, bits, positions[v]);
    }
    if (list->count >= DIP_FRAGMENT_BATCH) {
        shading->flush(shading, draw);
    }
}

// Adds pixels whose samples all show one patch. Such a pixel is shaded at its centre, on the
// triangle of its first sample. draws: the draw of each pixel. left: the pixels to add, one bit
// each.
VEC_INLINE void push_uniform(const SubBlock *sub, const uint32_t *draws, unsigned left) {
    Vu ids[VECTORS];
    Vu samples[VECTORS];
    Vu positions[VECTORS];
    for (int v = 0; v < VECTORS; v++) {
        ids[v] = (Vu)vi_load((const int32_t *)sub->ids + v * DIP_LANES);
        samples[v] = vu_splat((1u << sub->sample_count) - 1);
        positions[v] = (Vu)(vi_load(pixel_position + v * DIP_LANES) + position_of(sub, 128, 128));
    }
    while (left) {
        const uint32_t draw = draws[__builtin_ctz(left)];
        const unsigned pixels = pixels_with(draws, draw) & left;
        left &= ~pixels;
        push(sub, draw, pixels, ids, samples, positions, true);
    }
}

// Returns the sample groups of a draw, or NULL if all its samples form one group.
static inline const DipSampleGroups *groups_of(const DipTileShading *shading, uint32_t draw) {
    const bool has_groups = shading->groups_shade_all || shading->draws[draw].clip_shader;
    return shading->groups && has_groups ? shading->groups : NULL;
}

// Adds the fragments of one patch: the patch that sample `first` shows in the first pixel of
// left[first]. left[s] holds the pixels whose sample s has not been added yet; the function removes
// the samples that it adds. A fragment is shaded at its first sample that shows the patch. If the
// draw has sample groups, the function adds only samples in the same group as `first`. The fragment
// is then shaded at the centroid of the samples that it holds.
VEC_INLINE void push_multi_fragment_patch(const SubBlock *sub, unsigned *left, int first) {
    const DipSamplePattern *pattern = sub->shading->tile->pattern;
    const int pixel = __builtin_ctz(left[first]);
    const uint32_t patch = sub->patches[first * DIP_SUB_BLOCK_PIXELS + pixel];
    const uint32_t draw = draw_of(sub->shading, sub->ids[first * DIP_BLOCK_PIXELS + pixel] - 1);
    const DipSampleGroups *groups = groups_of(sub->shading, draw);
    const unsigned shared = groups ? groups->sharing[first] : ~0u;
    Vu ids[VECTORS];
    Vu samples[VECTORS];
    Vu positions[VECTORS];
    unsigned pixels = 0;
    for (int v = 0; v < VECTORS; v++) {
        ids[v] = samples[v] = positions[v] = vu_splat(0);
    }
    for (int s = sub->sample_count - 1; s >= first; s--) {
        const unsigned held =
            shared >> s & 1 ? pixels_with(sub->patches + s * DIP_SUB_BLOCK_PIXELS, patch) & left[s]
                            : 0;
        left[s] &= ~held;
        pixels |= held;
        const Vi position = vi_splat(position_of(sub, pattern->x[s], pattern->y[s]));
        for (int v = 0; v < VECTORS; v++) {
            const Mask mask = mask_from_bits(held >> (v * DIP_LANES) & VEC_ALL_LANES);
            samples[v] |= (Vu)vi_select(mask, vi_splat(1 << s), vi_splat(0));
            positions[v] = (Vu)vi_select(mask, position, (Vi)positions[v]);
            const Vi sample_ids =
                vi_load((const int32_t *)sub->ids + s * DIP_BLOCK_PIXELS + v * DIP_LANES);
            ids[v] = (Vu)vi_select(mask, sample_ids, (Vi)ids[v]);
        }
    }
    for (int v = 0; v < VECTORS; v++) {
        if (groups) {
            const Vi centroid = vi_gather(groups->centroid, (Vi)samples[v]);
            positions[v] = (Vu)((centroid << DIP_POSITION_SUB_X) + position_of(sub, 0, 0));
        }
        positions[v] += (Vu)vi_load(pixel_position + v * DIP_LANES);
    }
    push(sub, draw, pixels, ids, samples, positions, false);
}

// Starts the sums of multi-fragment pixels (pixels with several fragments). Uncovered samples add
// the background; most pixels have no uncovered sample. empty[s]: the pixels whose sample s is
// uncovered. any_empty: the pixels that have an uncovered sample.
VEC_INLINE void begin_sums(const SubBlock *sub, unsigned multi_fragment,
                           const unsigned empty[DIP_MAX_SAMPLES], unsigned any_empty) {
    DipTileShading *shading = sub->shading;
    const int corner = sub->y0 * DIP_TILE + sub->x0;
    for (unsigned left = multi_fragment; left; left &= left - 1) {
        const int pixel = __builtin_ctz(left);
        const int at = corner + pixel_position[pixel];
        shading->multi_fragment[shading->multi_fragment_count++] = (uint16_t)at;
        memset(shading->sum[at], 0, sizeof shading->sum[at]);
    }
    for (unsigned left = any_empty; left; left &= left - 1) {
        const int pixel = __builtin_ctz(left);
        for (int s = 0; s < sub->sample_count; s++) {
            const int32_t uncovered = (int32_t)(empty[s] >> pixel & 1);
            for (int c = 0; c < 3; c++) {
                shading->sum[corner + pixel_position[pixel]][c] +=
                    shading->clear_linear16[c] * uncovered;
            }
        }
    }
}

VEC_INLINE void push_multi_fragment(const SubBlock *sub, unsigned multi_fragment) {
    unsigned left[DIP_MAX_SAMPLES];
    unsigned empty[DIP_MAX_SAMPLES];
    unsigned any_empty = 0;
    for (int s = 0; s < sub->sample_count; s++) {
        empty[s] = pixels_with(sub->patches + s * DIP_SUB_BLOCK_PIXELS, 0) & multi_fragment;
        left[s] = multi_fragment & ~empty[s];
        sub->shading->samples += (unsigned)__builtin_popcount(left[s]);
        any_empty |= empty[s];
    }
    begin_sums(sub, multi_fragment, empty, any_empty);
    for (int s = 0; s < sub->sample_count; s++) {
        while (left[s]) {
            push_multi_fragment_patch(sub, left, s);
        }
    }
}

#endif
