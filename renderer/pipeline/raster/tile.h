// The visibility buffer of a tile: for each sample, the nearest depth and the triangle with this
// depth.
//
// A tile has 64x64 pixels. It consists of 64 blocks of 8x8 pixels. A block consists of four
// sub-blocks of 4x4 pixels. Blocks, sub-blocks and pixels are in row order. The values of sample s
// in a block are a run of 64, one per pixel. A vector of 1, 4, 8 or 16 lanes therefore always lies
// within a sub-block, and no result depends on the vector's width.
#ifndef DIP_RENDERER_PIPELINE_RASTER_TILE_H
#define DIP_RENDERER_PIPELINE_RASTER_TILE_H

#include "renderer/pipeline/raster/triangle.h"
#include "renderer/pipeline/pattern.h"
#include "renderer/pipeline/target.h"

#include <stdint.h>

enum {
    DIP_TILE = DIP_TARGET_TILE,
    DIP_TILE_PIXELS = DIP_TILE * DIP_TILE,
    DIP_BLOCK = 8,
    DIP_TILE_BLOCKS = DIP_TILE / DIP_BLOCK, // number of blocks in a row of a tile
    DIP_BLOCKS = DIP_TILE_BLOCKS * DIP_TILE_BLOCKS,
    DIP_BLOCK_PIXELS = DIP_BLOCK * DIP_BLOCK,
    DIP_SUB_BLOCK = 4,
    DIP_SUB_BLOCK_PIXELS = DIP_SUB_BLOCK * DIP_SUB_BLOCK,
    DIP_TILE_SUB_BLOCKS = DIP_TILE / DIP_SUB_BLOCK, // number of sub-blocks in a row of a tile
};

// Returns the column of pixel i (0..63) of a block.
static inline int dip_block_x(int i) {
    return (i >> 4 & 1) * 4 + (i & 3);
}

// Returns the row of pixel i (0..63) of a block.
static inline int dip_block_y(int i) {
    return (i >> 5) * 4 + (i >> 2 & 3);
}

// Returns the pixel i (0..63) in column x and row y of a block.
static inline int dip_block_pixel(int x, int y) {
    return y / DIP_SUB_BLOCK * 32 + x / DIP_SUB_BLOCK * 16 + y % DIP_SUB_BLOCK * 4 +
           x % DIP_SUB_BLOCK;
}

typedef struct DipTile {
    int x0; // column and row of the first pixel in the target
    int y0;
    // Number of pixels at each side of the tile that are not drawn: multiples of DIP_BLOCK.
    int left;
    int top;
    int right;
    int bottom;
    const DipSamplePattern *pattern;
    uint64_t touched; // bit b: block b has been cleared and may hold samples
    // Bit b: an alpha-clipped triangle has drawn samples of block b in sample groups (pattern.h).
    uint64_t grouped;
    float *depth; // [block][sample][64]; 0 is infinitely far
    uint32_t *id; // [block][sample][64]; triangle index + 1, or 0 for none
    uint64_t sub_blocks_tested;
    uint64_t sub_blocks_accepted;
    // The pass's triangles if its draws come near to far (geometry/order.h), otherwise NULL. Of
    // triangles that are equally near, the one of the earlier draw is shown in either order.
    const DipTriangle *near_to_far;
    // Only near to far: no sample of the block is farther than its bound, which is 0 at first.
    float bound[DIP_BLOCKS];
    uint8_t drawn[DIP_BLOCKS]; // number of triangles drawn in the block since its bound was found
} DipTile;

// Returns the index in `depth` and `id` of the first value of a block's sample.
static inline int dip_tile_index(const DipTile *tile, int block, int sample) {
    return (block * tile->pattern->count + sample) * DIP_BLOCK_PIXELS;
}

#endif
