// Sharing with passes that are drawn at once: offers the pixels of a sub-block, or copies those
// that another pass offers. Only kernels (*_simd.c) include this header.
#ifndef DIP_RENDERER_PIPELINE_SHADING_SHARE_SIMD_H
#define DIP_RENDERER_PIPELINE_SHADING_SHARE_SIMD_H

#include "renderer/pipeline/shading/push_simd.h"

#include <string.h>

// Returns the pixels among `left`, which show one draw each, whose draw has own_shading.
static unsigned pixels_of_own_shading(const SubBlock *sub, unsigned left) {
    unsigned found = 0;
    for (; left; left &= left - 1) {
        const int pixel = __builtin_ctz(left);
        const uint32_t draw = draw_of(sub->shading, sub->ids[pixel] - 1);
        found |= (unsigned)sub->shading->draws[draw].own_shading << pixel;
    }
    return found;
}

// Returns the pixels that the other pass offers and whose first samples show the same triangles in
// both passes.
VEC_INLINE unsigned pixels_to_copy(const SubBlock *sub) {
    const DipTileShading *from = sub->shading->share.from;
    const unsigned offered = from->share.offered[sub->block][sub->quarter];
    if (!offered) {
        return 0; // the other pass may not have touched the block
    }
    const uint32_t *ids = from->tile->id + dip_tile_index(from->tile, sub->block, 0) +
                          sub->quarter * DIP_SUB_BLOCK_PIXELS;
    unsigned same = 0;
    for (int v = 0; v < VECTORS; v++) {
        same |= mask_bits(vi_eq(vi_load((const int32_t *)ids + v * DIP_LANES),
                                vi_load((const int32_t *)sub->ids + v * DIP_LANES)))
                << (v * DIP_LANES);
    }
    return same & offered;
}

// Pixels that are not copied are not written, not even with what they hold: a sub-block at the
// target's edge reaches past the target's memory, or into a row that another thread draws.
static void copy_pixels(const SubBlock *sub, unsigned pixels) {
    DipTileShading *shading = sub->shading;
    const DipTileShading *other = shading->share.from;
    const uint32_t *from = other->pixels + (size_t)sub->y0 * other->stride + (size_t)sub->x0;
    uint32_t *to = shading->pixels + (size_t)sub->y0 * shading->stride + (size_t)sub->x0;
    for (int y = 0; y < DIP_SUB_BLOCK; y++, from += other->stride, to += shading->stride) {
        const unsigned row = pixels >> (y * DIP_SUB_BLOCK) & ((1u << DIP_SUB_BLOCK) - 1);
        if (row == (1u << DIP_SUB_BLOCK) - 1) {
            memcpy(to, from, DIP_SUB_BLOCK * sizeof *to);
            continue;
        }
        for (unsigned left = row; left; left &= left - 1) {
            const int x = __builtin_ctz(left);
            to[x] = from[x];
        }
    }
    shading->copied += (unsigned)__builtin_popcount(pixels);
}

// Whether the pass offers pixels to other passes or copies theirs.
static inline bool shares(const DipTileShading *shading) {
    return (shading->share.offers || shading->share.from) && !shading->share.paused;
}

// Offers pixels to other passes, or copies those that another pass offers. uniform: pixels that
// show one patch alone, of a draw without sample groups. Returns the pixels that are left to shade.
static unsigned share_pixels(const SubBlock *sub, unsigned uniform) {
    DipShadingShare *share = &sub->shading->share;
    unsigned pixels = share->offers ? uniform : pixels_to_copy(sub) & uniform;
    if (share->some_own) {
        pixels &= ~pixels_of_own_shading(sub, pixels);
    }
    if (share->offers) {
        share->offered[sub->block][sub->quarter] = (uint16_t)pixels;
        return uniform;
    }
    if (pixels) {
        copy_pixels(sub, pixels);
    }
    return uniform & ~pixels;
}

#endif
