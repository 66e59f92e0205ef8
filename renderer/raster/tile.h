// A tile's visibility buffer: per sample the nearest depth and the triangle it belongs to.
//
// Tiles are 64x64 pixels, of 8x8 blocks in row order, of four 4x4 sub-blocks in row order, of 16
// pixels in row order. Sample s of a block is a run of 64 values, so that a vector of 1, 4, 8 or
// 16 lanes always lies within a sub-block and no result depends on the vector's width.
#ifndef DIP_RENDERER_RASTER_TILE_H
#define DIP_RENDERER_RASTER_TILE_H

#include "renderer/geometry/triangle.h"
#include "renderer/raster/pattern.h"

#include <stdint.h>

enum {
    DIP_TILE = 64,
    DIP_BLOCK = 8,
    DIP_TILE_BLOCKS = DIP_TILE / DIP_BLOCK, // per row
    DIP_BLOCKS = DIP_TILE_BLOCKS * DIP_TILE_BLOCKS,
    DIP_BLOCK_PIXELS = DIP_BLOCK * DIP_BLOCK,
};

// Pixel i (0..63) of a block: its place within the block.
static inline int dip_block_x(int i) {
    return (i >> 4 & 1) * 4 + (i & 3);
}

static inline int dip_block_y(int i) {
    return (i >> 5) * 4 + (i >> 2 & 3);
}

typedef struct DipBlockCoverage {
    uint64_t covered[DIP_MAX_SAMPLES]; // by the edges; bit i: pixel i of the block
    uint64_t visible[DIP_MAX_SAMPLES]; // covered and nearer than what is there
} DipBlockCoverage;

typedef struct DipTile DipTile;

// Decides an alpha-clipped triangle's pixels in a block: bit i of the result is set where the
// surface is there. Called only when some sample is visible.
typedef uint64_t DipClipTest(void *context, const DipTile *tile, const DipTriangle *triangle,
                             int block, const DipBlockCoverage *coverage);

struct DipTile {
    int x0; // of the first pixel, in the target
    int y0;
    const DipSamplePattern *pattern;
    uint64_t touched; // bit b: block b has been cleared and holds something since
    float *depth;     // [block][sample][64]; 0 is infinitely far
    uint32_t *id;     // likewise; triangle index + 1, or 0 for none
    uint64_t blocks_tested;
    uint64_t blocks_accepted;
};

static inline int dip_tile_index(const DipTile *tile, int block, int sample) {
    return (block * tile->pattern->count + sample) * DIP_BLOCK_PIXELS;
}

#endif
