// What the clip test keeps of the fragments of alpha-clipped triangles. Only kernels (*_simd.c)
// include this header.
#ifndef DIP_RENDERER_PIPELINE_RASTER_KEPT_SIMD_H
#define DIP_RENDERER_PIPELINE_RASTER_KEPT_SIMD_H

#include "renderer/pipeline/raster/in_tile_simd.h"

// Which fragments of a batch the clip test keeps, in the list's order. They are taken sub-block by
// sub-block.
typedef struct Kept {
    uint16_t bits[DIP_FRAGMENT_BATCH / 16 + 1]; // one bit per fragment
    unsigned next;                              // the first fragment that has not been taken
} Kept;

// bytes: a byte per fragment; 0 means that the surface is cut away.
VEC_INLINE void find_kept(const uint8_t *bytes, int count, Kept *kept) {
    kept->next = 0;
    for (int i = 0; i < count; i += 16) {
        unsigned bits = 0;
        for (int v = 0; v < VECTORS; v++) {
            const Vi lanes = vi_load_bytes(bytes + i + v * DIP_LANES);
            bits |= mask_bits(vi_lt(vi_splat(0), lanes)) << (v * DIP_LANES);
        }
        kept->bits[i / 16] = (uint16_t)bits;
        kept->bits[i / 16 + 1] = 0;
    }
}

// Takes the fragments of a sub-block, which lie in these pixels. Returns the pixels that are kept.
VEC_INLINE unsigned take_kept(Kept *kept, unsigned pixels) {
    const unsigned word = kept->next / 16;
    const unsigned bits = kept->bits[word] | (unsigned)kept->bits[word + 1] << 16;
    const unsigned at = kept->next % 16;
    kept->next += (unsigned)__builtin_popcount(pixels);
    return bits_at(bits >> at, pixels);
}

// Alpha to coverage: takes from the samples of each pixel those that come after the first bytes[i]
// in `order`. samples: the pixels in which each sample is visible. bytes: one per pixel.
static inline void drop_samples(uint16_t *samples, unsigned pixels, const uint8_t *bytes,
                                const uint8_t *order, int sample_count) {
    for (; pixels; pixels &= pixels - 1) {
        for (int i = *bytes++; i < sample_count; i++) {
            samples[order[i]] &= (uint16_t) ~(pixels & -pixels);
        }
    }
}

#endif
