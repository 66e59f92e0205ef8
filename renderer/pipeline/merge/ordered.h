// Ordered draws (pipeline/state.h) in one tile: the colours of all samples, and the fragments that
// wait to be shaded and blended.
//
// The pixels of a tile are in the order of raster/tile.h: [block][sample][64]. A sub-block (4x4
// pixels) is *split* if samples of a pixel may hold different colours. In a sub-block that is not
// split, only the colours of sample 0 are kept, and they are the colours of all samples.
#ifndef DIP_RENDERER_PIPELINE_MERGE_ORDERED_H
#define DIP_RENDERER_PIPELINE_MERGE_ORDERED_H

#include "renderer/pipeline/raster/fragments.h"
#include "renderer/pipeline/raster/tile.h"
#include "renderer/pipeline/state.h"

#include <stdbool.h>
#include <stdint.h>

// Flags of an ordered draw's triangle (DipTriangle.patch).
enum {
    DIP_ORDERED_EDGES = 7, // bit i: edge i is an edge of the mesh, not one that clipping made
    DIP_ORDERED_FRONT = 8, // the triangle is a front face, and its edges 0 and 2 are exchanged
};

// The colours of a tile's samples, in linear light.
typedef struct DipTileColours {
    int sample_count;
    bool clamps;       // colours are kept within 0..1
    float *channel[4]; // red, green, blue and alpha: [block][sample][64]
    uint64_t ready;    // bit b: block b has colours
    uint64_t split[4]; // one bit per sub-block, see dip_sub_block_number
} DipTileColours;

// The means of a block's samples in linear light: red, green, blue and alpha, and as 16-bit values
// without alpha.
typedef struct DipBlockLight {
    float channel[4][DIP_BLOCK_PIXELS];
} DipBlockLight;

typedef struct DipBlockLight16 {
    int32_t channel[3][DIP_BLOCK_PIXELS];
} DipBlockLight16;

// Returns the number, 0..255, of the sub-block that holds value `first` of the tile's arrays.
static inline int dip_sub_block_number(int first, int sample_count) {
    const int block = first / (sample_count * DIP_BLOCK_PIXELS);
    return block * 4 + first % (sample_count * DIP_BLOCK_PIXELS) / DIP_SUB_BLOCK_PIXELS;
}

static inline bool dip_is_split(const DipTileColours *colours, int sub_block) {
    return colours->split[sub_block / 64] >> sub_block % 64 & 1;
}

// Gives every sample of a sub-block colours of its own.
void dip_split(DipTileColours *colours, int sub_block);

// A sub-block with fragments that wait to be shaded.
typedef struct DipOrderedSubBlock {
    int first;                         // index of the sub-block's first value in the arrays
    int number;                        // see dip_sub_block_number
    uint16_t pixels;                   // pixels with a fragment in the list, in the list's order
    uint16_t visible[DIP_MAX_SAMPLES]; // pixels in which each sample takes the fragment's colour
} DipOrderedSubBlock;

// A batch of fragments to shade, in submission order, and the sub-blocks that they lie in. One
// pixel may have several fragments of different triangles.
typedef struct DipOrderedBatch {
    DipFragmentList list;
    int count; // number of sub-blocks
    DipOrderedSubBlock waiting[DIP_FRAGMENT_BATCH];
} DipOrderedBatch;

// How many batches wait until they are shaded together. Reading the clock, which tells the time of
// shading from that of coverage, takes as long as blending half a batch.
enum { DIP_ORDERED_BATCHES = 16 };

// One ordered draw in one tile.
typedef struct DipOrdered {
    const DipDrawState *state;
    bool shades;             // the draw writes colours
    const DipClipTest *clip; // NULL: the draw has no clip shader
    uint8_t *stencil;        // [block][sample][64]
    int full;                // batches that are full; the next batch is being filled
    DipOrderedBatch batches[DIP_ORDERED_BATCHES];
    // Shades the waiting fragments and blends them; all batches are empty afterwards.
    void (*flush)(void *context);
    void *context;
} DipOrdered;

// Returns the batch after the current one, which is full. It is empty.
static inline DipOrderedBatch *dip_ordered_next_batch(DipOrdered *ordered) {
    if (++ordered->full == DIP_ORDERED_BATCHES) {
        ordered->flush(ordered->context);
    }
    return &ordered->batches[ordered->full];
}

#endif
