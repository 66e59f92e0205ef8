// Lists of fragments: the pixels of a tile in which triangles are visible, on their way from
// coverage to the shaders.
#ifndef DIP_RENDERER_PIPELINE_RASTER_FRAGMENTS_H
#define DIP_RENDERER_PIPELINE_RASTER_FRAGMENTS_H

#include "renderer/base/pages.h"
#include "renderer/pipeline/pattern.h"
#include "renderer/pipeline/raster/tile.h"
#include "renderer/pipeline/raster/triangle.h"
#include "renderer/pipeline/shader.h"

#include <stdint.h>

// The bits of a fragment's position. The lowest bits are its pixel in the tile, y * DIP_TILE + x.
// The bits above them are the shaded point within the pixel, in 1/256 pixel from the pixel's top
// left corner.
enum {
    DIP_POSITION_Y = 6,                       // first of 6 bits, the pixel's row y
    DIP_POSITION_SUB_X = 12,                  // first of 8 bits, the shaded point's x
    DIP_POSITION_SUB_Y = 20,                  // first of 8 bits, the shaded point's y
    DIP_POSITION_PIXEL = DIP_TILE_PIXELS - 1, // mask of the pixel in the tile
};

// The length of a list. The 16 fragments of a sub-block are added at once, so a list may become
// longer than a batch.
enum { DIP_LIST_ROOM = DIP_FRAGMENT_BATCH + 16 };

// Fragments of one draw that wait to be shaded. Kernels may read the arrays to their end.
typedef struct DipFragmentList {
    // Index into the geometry's triangles.
    _Alignas(DIP_CACHE_LINE) uint32_t triangle[DIP_LIST_ROOM];
    uint32_t position[DIP_LIST_ROOM]; // the fragment's position, in the bits described above
    // Bit s: the fragment holds sample s. The array is unused in lists of whole sub-blocks, whose
    // fragments hold all samples.
    uint32_t samples[DIP_LIST_ROOM];
    int count;
} DipFragmentList;

// A sub-block in which a triangle's fragments wait for the clip test.
typedef struct DipWaitingSubBlock {
    uint32_t triangle; // index into the geometry's triangles
    int first;         // index of the sub-block's first value in the tile's arrays
    float depth;       // the triangle's depth at the sub-block's corner
    uint16_t pixels;   // pixels that have a fragment in the list, in the list's order
    uint16_t samples;  // samples that the fragments may hold, one bit each
    uint16_t visible[DIP_MAX_SAMPLES]; // the pixels in which each sample is visible
} DipWaitingSubBlock;

// The sub-blocks that wait for the clip test, of triangles of one draw that follow one another. The
// fragments of several small triangles are tested at once, which takes less time than testing those
// of each. No two of the triangles wait in the same pixel. Which fragments of one are visible
// therefore does not depend on which the test keeps of another, so the fragments that are tested
// and shown are the same as if each triangle were tested at once.
typedef struct DipClipQueue {
    int count; // number of sub-blocks
    uint32_t draw;
    uint64_t blocks;                                         // bit b: fragments of block b wait
    uint16_t pixels[DIP_TILE_PIXELS / DIP_SUB_BLOCK_PIXELS]; // by sub-block: the pixels that wait
    DipWaitingSubBlock waiting[DIP_FRAGMENT_BATCH];
} DipClipQueue;

// The clip test: coverage uses it to find out which fragments of alpha-clipped triangles exist.
// Coverage fills in the list's count, positions and triangles, but not its samples. All entries are
// of one draw. Both arrays are padded for vector reads to a multiple of DIP_BATCH_ALIGN. Then
// coverage calls test, which returns a byte per fragment; 0 means that the surface is cut away.
// With sample groups, a pixel has one fragment for each group in which it has visible samples.
typedef struct DipClipTest {
    DipFragmentList *list;
    const uint8_t *(*test)(void *context, uint32_t draw);
    void *context;
    const DipSampleGroups *groups; // NULL: one group of all samples
    // Not NULL: each byte is the number of samples of its pixel that the surface may have
    // (DipPass.alpha_to_coverage). It may have the first of these samples.
    const uint8_t *order;
    // Only plain draws use the next two; ordered draws test the fragments of each triangle at
    // once.
    DipClipQueue *queue;
    const DipTriangle *triangles; // those of the geometry
} DipClipTest;

#endif
