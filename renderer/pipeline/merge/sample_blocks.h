// The memory of a DipSamples (pipeline/samples.h): blocks of 8x8 pixels as in raster/tile.h, so
// that a sub-block of a tile moves as whole cache lines.
#ifndef DIP_RENDERER_PIPELINE_MERGE_SAMPLE_BLOCKS_H
#define DIP_RENDERER_PIPELINE_MERGE_SAMPLE_BLOCKS_H

#include "renderer/pipeline/merge/ordered.h"
#include "renderer/pipeline/samples.h"

#include <stddef.h>
#include <stdint.h>

enum { DIP_SAMPLE_CHANNELS = 4 };

struct DipSamples {
    int width;
    int height;
    int sample_count;
    DipFormat format;
    int blocks_x; // blocks in a row of blocks
    float *light; // [block][channel][sample][64]
    // One byte per block; bit q: sub-block q is split, as in merge/ordered.h. If it is not, only
    // the values of sample 0 count.
    uint8_t *split;
};

// Returns the number of the block that holds a pixel.
static inline size_t dip_samples_block(const DipSamples *samples, int x, int y) {
    return (size_t)(y / DIP_BLOCK) * (size_t)samples->blocks_x + (size_t)(x / DIP_BLOCK);
}

// Returns the index in `light` of a block's first value of one channel and sample.
static inline size_t dip_samples_index(const DipSamples *samples, size_t block, int channel,
                                       int sample) {
    const size_t run =
        (block * DIP_SAMPLE_CHANNELS + (size_t)channel) * (size_t)samples->sample_count +
        (size_t)sample;
    return run * DIP_BLOCK_PIXELS;
}

// Gives a block of a tile the colours of the samples. The block must not be split yet.
void dip_samples_load_block(const DipSamples *samples, const DipTile *tile, int block,
                            DipTileColours *colours);

// Gives the samples the colours of a block of a tile, in the pixels within `stored` alone.
void dip_samples_store_block(DipSamples *samples, const DipTargetRegion *stored,
                             const DipTile *tile, int block, const DipTileColours *colours);

#endif
