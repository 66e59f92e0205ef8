// Which samples of a tile a triangle hides. Only kernels (*_simd.c) include this header.
#ifndef DIP_RENDERER_PIPELINE_RASTER_HIDING_SIMD_H
#define DIP_RENDERER_PIPELINE_RASTER_HIDING_SIMD_H

#include "renderer/pipeline/raster/tile.h"
#include "renderer/simd/vec.h"

// Returns the lanes among `equal` that show a later draw than `draw`.
static inline unsigned lanes_of_later_draws(const DipTile *tile, const uint32_t *ids,
                                            unsigned equal, uint32_t draw) {
    unsigned later = 0;
    for (; equal; equal &= equal - 1) {
        const int lane = __builtin_ctz(equal);
        if (ids[lane] && tile->near_to_far[ids[lane] - 1].draw > draw) {
            later |= 1u << lane;
        }
    }
    return later;
}

// Returns the lanes in which a triangle of `draw` with these depths hides what the tile holds: it
// is nearer or, near to far, equally near and of an earlier draw. at: index of the vector in the
// tile's arrays. old: the depths there. No depth is negative, so equal depths have equal bits.
VEC_INLINE Mask hiding_lanes(const DipTile *tile, int at, Vf old, Vf depth, uint32_t draw,
                             bool near_to_far) {
    const Mask nearer = vf_lt(old, depth);
    if (near_to_far) {
        const unsigned equal = mask_bits(vi_eq((Vi)old, (Vi)depth));
        if (equal) {
            return nearer | mask_from_bits(lanes_of_later_draws(tile, tile->id + at, equal, draw));
        }
    }
    return nearer;
}

#endif
