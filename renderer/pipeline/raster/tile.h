// The visibility buffer of a tile: for each sample the nearest depth and the triangle that has it.
//
// A tile has 64x64 pixels. It consists of 8x8 blocks, a block of four sub-blocks, and a sub-block
// of 4x4 pixels, each in row order. Sample s of a block is a run of 64 values, so that a vector of
// 1, 4, 8 or 16 lanes always lies within a sub-block and no result depends on the vector's width.
#ifndef DIP_RENDERER_PIPELINE_RASTER_TILE_H
#define DIP_RENDERER_PIPELINE_RASTER_TILE_H

#include "renderer/pipeline/geometry/triangle.h"
#include "renderer/pipeline/pattern.h"
#include "renderer/pipeline/target.h"

#include <stdint.h>

enum {
    DIP_TILE = DIP_TARGET_TILE,
    DIP_BLOCK = 8,
    DIP_TILE_BLOCKS = DIP_TILE / DIP_BLOCK, // blocks per row of a tile
    DIP_BLOCKS = DIP_TILE_BLOCKS * DIP_TILE_BLOCKS,
    DIP_BLOCK_PIXELS = DIP_BLOCK * DIP_BLOCK,
    DIP_SUB_BLOCK = 4,
    DIP_SUB_BLOCK_PIXELS = DIP_SUB_BLOCK * DIP_SUB_BLOCK,
    DIP_TILE_SUB_BLOCKS = DIP_TILE / DIP_SUB_BLOCK, // sub-blocks per row of a tile
};

// Column of pixel i (0..63) of a block.
static inline int dip_block_x(int i) {
    return (i >> 4 & 1) * 4 + (i & 3);
}

// Row of pixel i (0..63) of a block.
static inline int dip_block_y(int i) {
    return (i >> 5) * 4 + (i >> 2 & 3);
}

typedef struct DipTile {
    int x0; // column and row of the first pixel in the target
    int y0;
    // Pixels at each side that are not drawn, in multiples of DIP_BLOCK. 0: all are drawn.
    int left;
    int top;
    int right;
    int bottom;
    const DipSamplePattern *pattern;
    uint64_t touched; // bit b: block b has been cleared and may hold something since
    // Bit b: block b has held samples that an alpha-clipped triangle drew in sample groups.
    uint64_t grouped;
    float *depth; // [block][sample][64]; 0 is infinitely far
    uint32_t *id; // [block][sample][64]; triangle index + 1, or 0 for none
    uint64_t sub_blocks_tested;
    uint64_t sub_blocks_accepted;
} DipTile;

// Returns the index of a block's first value of a sample in depth and id.
static inline int dip_tile_index(const DipTile *tile, int block, int sample) {
    return (block * tile->pattern->count + sample) * DIP_BLOCK_PIXELS;
}

#endif
