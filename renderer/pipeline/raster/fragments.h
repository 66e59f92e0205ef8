// Lists of fragments: the pixels of a tile in which triangles are visible, on their way from
// coverage to the shaders.
#ifndef DIP_RENDERER_PIPELINE_RASTER_FRAGMENTS_H
#define DIP_RENDERER_PIPELINE_RASTER_FRAGMENTS_H

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
    int count;
    uint32_t triangle[DIP_LIST_ROOM]; // index into the geometry's triangles
    uint32_t position[DIP_LIST_ROOM]; // the fragment's position, in the bits described above
    // Bit s: the fragment holds sample s. The array is unused in lists of whole sub-blocks, whose
    // fragments hold all samples.
    uint32_t samples[DIP_LIST_ROOM];
} DipFragmentList;

// The clip test: coverage uses it to find out which fragments of an alpha-clipped triangle exist.
// Coverage fills in the list's count, positions and triangles, but not its samples. All entries
// have the same triangle. Both arrays are padded for vector reads: `position` to a multiple of
// DIP_BATCH_ALIGN, `triangle` to whole vectors. Then coverage calls test, which returns a byte per
// fragment; 0 means that the surface is cut away. With sample groups, a pixel has one fragment for
// each group in which it has visible samples.
typedef struct DipClipTest {
    DipFragmentList *list;
    const uint8_t *(*test)(void *context, const DipTriangle *triangle);
    void *context;
    const DipSampleGroups *groups; // NULL: one group of all samples
    // Not NULL: each byte is the number of samples of its pixel that the surface may have
    // (DipPass.alpha_to_coverage). It may have the first of these samples.
    const uint8_t *order;
} DipClipTest;

#endif
