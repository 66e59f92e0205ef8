// A tile's visibility buffer: per sample the nearest depth and the triangle it belongs to.
//
// Tiles are 64x64 pixels, of 8x8 blocks in row order, of four 4x4 sub-blocks in row order, of 16
// pixels in row order. Sample s of a block is a run of 64 values, so that a vector of 1, 4, 8 or
// 16 lanes always lies within a sub-block and no result depends on the vector's width.
#ifndef DIP_RENDERER_PIPELINE_RASTER_TILE_H
#define DIP_RENDERER_PIPELINE_RASTER_TILE_H

#include "renderer/pipeline/geometry/triangle.h"
#include "renderer/pipeline/pattern.h"
#include "renderer/pipeline/target.h"

#include <stdint.h>

enum {
    DIP_TILE = DIP_TARGET_TILE,
    DIP_BLOCK = 8,
    DIP_TILE_BLOCKS = DIP_TILE / DIP_BLOCK, // per row
    DIP_BLOCKS = DIP_TILE_BLOCKS * DIP_TILE_BLOCKS,
    DIP_BLOCK_PIXELS = DIP_BLOCK * DIP_BLOCK,
    DIP_SUB_BLOCK = 4,
    DIP_SUB_BLOCK_PIXELS = DIP_SUB_BLOCK * DIP_SUB_BLOCK,
    DIP_TILE_SUB_BLOCKS = DIP_TILE / DIP_SUB_BLOCK, // per row
};

// Pixel i (0..63) of a block: its position within the block.
static inline int dip_block_x(int i) {
    return (i >> 4 & 1) * 4 + (i & 3);
}

static inline int dip_block_y(int i) {
    return (i >> 5) * 4 + (i >> 2 & 3);
}

typedef struct DipTile {
    int x0; // of the first pixel, in the target
    int y0;
    int left; // pixels at each side that are not drawn: multiples of DIP_BLOCK, 0: all are
    int top;
    int right;
    int bottom;
    const DipSamplePattern *pattern;
    uint64_t touched; // bit b: block b has been cleared and holds something since
    uint64_t
        grouped;  // bit b: block b has held samples of an alpha-clipped triangle's sample groups
    float *depth; // [block][sample][64]; 0 is infinitely far
    uint32_t *id; // likewise; triangle index + 1, or 0 for none
    uint64_t sub_blocks_tested;
    uint64_t sub_blocks_accepted;
} DipTile;

static inline int dip_tile_index(const DipTile *tile, int block, int sample) {
    return (block * tile->pattern->count + sample) * DIP_BLOCK_PIXELS;
}

#endif
