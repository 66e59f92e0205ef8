// The sub-block (4x4 pixels) whose fragments are being collected. Its 16 pixels are handled as a
// mask of 16 bits. Only kernels (*_simd.c) include this header.
#ifndef DIP_RENDERER_PIPELINE_SHADING_SUB_BLOCK_SIMD_H
#define DIP_RENDERER_PIPELINE_SHADING_SUB_BLOCK_SIMD_H

#include "renderer/pipeline/shading/tile_shading.h"
#include "renderer/simd/vec.h"

#include <stddef.h>

enum { VECTORS = 16 / DIP_LANES, ALL_PIXELS = 0xffff };

// Positions (tile_shading.h) of a sub-block's pixels, relative to the sub-block's first pixel.
static const int32_t pixel_position[16] = {
    0,   1,   2,   3,   64,  65,  66,  67, // one row adds DIP_TILE
    128, 129, 130, 131, 192, 193, 194, 195,
};

// The sub-block whose fragments are being collected.
typedef struct SubBlock {
    DipTileShading *shading;
    // Triangle ids at sample 0. The ids at sample s are DIP_BLOCK_PIXELS * s elements later.
    const uint32_t *ids;
    int sample_count;
    int block;   // the block that it lies in
    int quarter; // its number in the block
    int x0, y0;  // column and row, in the tile, of the sub-block's first pixel
    // The patches that the samples show, [sample][pixel]; 0 for none. This array is filled only if
    // samples of a pixel hold several triangles, or if there may be sample groups.
    uint32_t patches[DIP_MAX_SAMPLES * DIP_SUB_BLOCK_PIXELS];
} SubBlock;

// Returns the pixels, one bit each, for which the entry of `numbers` equals `number`.
VEC_INLINE unsigned pixels_with(const uint32_t *numbers, uint32_t number) {
    unsigned bits = 0;
    for (int v = 0; v < VECTORS; v++) {
        const Vi held = vi_load((const int32_t *)numbers + v * DIP_LANES);
        bits |= mask_bits(vi_eq(held, vi_splat((int32_t)number))) << (v * DIP_LANES);
    }
    return bits;
}

// Gathers one 32-bit field of DipTriangle for each triangle id. The id 0 means that there is no
// triangle; its lane gets the field of triangle 0.
VEC_INLINE Vi gather_words(const SubBlock *sub, Vi ids, size_t offset_bytes) {
    enum { WORDS = sizeof(DipTriangle) / sizeof(int32_t) };
    const char *triangles = (const char *)sub->shading->input.triangles;
    const Vi index = vi_max(ids - 1, vi_splat(0));
    return vi_gather((const int32_t *)(const void *)(triangles + offset_bytes), index * WORDS);
}

static void find_patches(SubBlock *sub) {
    for (int s = 0; s < sub->sample_count; s++) {
        for (int v = 0; v < VECTORS; v++) {
            const Vi ids =
                vi_load((const int32_t *)sub->ids + s * DIP_BLOCK_PIXELS + v * DIP_LANES);
            const Vi patches = gather_words(sub, ids, offsetof(DipTriangle, patch));
            vi_store((int32_t *)sub->patches + s * DIP_SUB_BLOCK_PIXELS + v * DIP_LANES,
                     vi_select(vi_eq(ids, vi_splat(0)), vi_splat(0), patches));
        }
    }
}

// Returns the pixels, one bit each, whose samples have different numbers. numbers: triangle ids or
// patches. stride: distance from the numbers of one sample to the numbers of the next.
VEC_INLINE unsigned multi_fragment_pixels(const uint32_t *numbers, int sample_count, int stride) {
    unsigned same = 0;
    for (int v = 0; v < VECTORS; v++) {
        const int32_t *held = (const int32_t *)numbers + v * DIP_LANES;
        const Vi first = vi_load(held);
        Vi differ = vi_splat(0);
        for (int s = 1; s < sample_count; s++) {
            differ |= first ^ vi_load(held + s * stride);
        }
        same |= mask_bits(vi_eq(differ, vi_splat(0))) << (v * DIP_LANES);
    }
    return ~same & ALL_PIXELS;
}

static inline uint32_t draw_of(const DipTileShading *shading, uint32_t triangle) {
    return shading->input.triangles[triangle].draw;
}

#endif
