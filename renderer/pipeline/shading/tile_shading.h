// From a tile's visibility buffer to shaded pixels: the lists and buffers a worker keeps.
//
// Every pixel's distinct patches become fragments, gathered per draw and shaded 64 at a time. A
// fragment that holds all samples of its pixel is the pixel; the others add to a sum in 16-bit
// linear light, weighted by their samples, in integers, so the order does not matter.
#ifndef DIP_RENDERER_PIPELINE_SHADING_TILE_SHADING_H
#define DIP_RENDERER_PIPELINE_SHADING_TILE_SHADING_H

#include "renderer/pipeline/pipeline.h"
#include "renderer/pipeline/raster/tile.h"
#include "renderer/pipeline/shader.h"

#include <stdbool.h>
#include <stdint.h>

enum { DIP_TILE_PIXELS = DIP_TILE * DIP_TILE };

// Where a fragment is shaded, in bits: its pixel in the tile, y * DIP_TILE + x, and the position in
// the pixel, 1/256 pixel from its top left corner.
enum {
    DIP_POSITION_Y = 6,      // first of 6 bits, after the 6 of x
    DIP_POSITION_SUB_X = 12, // first of 8
    DIP_POSITION_SUB_Y = 20,
    DIP_POSITION_PIXEL = DIP_TILE_PIXELS - 1, // mask of x and y
};

// A sub-block's fragments are pushed at once, past a batch's count.
enum { DIP_LIST_ROOM = DIP_FRAGMENT_BATCH + 16 };

// Fragments of one draw that wait to be shaded. Arrays may be read to their end.
typedef struct DipFragmentList {
    int count;
    uint32_t triangle[DIP_LIST_ROOM]; // index into the geometry's triangles
    uint32_t position[DIP_LIST_ROOM];
    uint32_t samples[DIP_LIST_ROOM]; // bit s: holds sample s; whole lists: not set, all of them
} DipFragmentList;

// How coverage asks which fragments of an alpha-clipped triangle are there: it fills the list's
// count, x, y and triangle (one for all; these three up to a multiple of DIP_BATCH_ALIGN) and calls
// test, which returns a byte per fragment, 0 where the surface is not. `samples` and `pixel` are
// not used. With groups, a pixel is asked about once in each that it has samples of.
typedef struct DipClipTest {
    DipFragmentList *list;
    const uint8_t *(*test)(void *context, const DipTriangle *triangle);
    void *context;
    const DipSampleGroups *groups; // NULL: one group of all samples
} DipClipTest;

// A batch after shading.
typedef struct DipEncodedBatch {
    int32_t linear16[3][DIP_FRAGMENT_BATCH];
    uint32_t rgba8[DIP_FRAGMENT_BATCH]; // bytes R, G, B, 255 in memory order (little-endian)
} DipEncodedBatch;

// The geometry's arrays, as kernels read them.
typedef struct DipShadingInput {
    const DipTriangle *triangles;
    const float *planes; // of triangle i from i * plane_stride on
    int plane_stride;
    int x0; // of the tile's first pixel in the target
    int y0;
} DipShadingInput;

typedef struct DipTileShading DipTileShading;

// Shades a draw's list, at most a batch of it, and moves what is left to its start.
typedef void DipFlushList(DipTileShading *shading, uint32_t draw);

struct DipTileShading {
    DipTile *tile;
    DipShadingInput input;
    const DipDraw *draws;
    const DipSampleGroups *groups; // of alpha-clipped draws; NULL: one group of all samples
    DipFlushList *flush;
    DipFlushList *flush_whole;
    void *context;                // of both
    DipFragmentList *lists;       // per draw
    DipFragmentList *whole_lists; // per draw: of whole sub-blocks, 16 fragments each
    uint32_t *active;             // draws whose list was used in this tile, in order of first use
    int active_count;
    uint8_t *is_active; // per draw
    int width;          // of the tile that lies in the target
    int height;
    uint32_t *pixels; // of the tile's first pixel in the target
    size_t stride;    // pixels per row of the target
    uint32_t clear_rgba8;
    int32_t clear_linear16[3];
    int32_t (*sum)[4];        // per tile pixel: linear16 sums of a pixel with several fragments
    uint16_t *multi_fragment; // such pixels
    int multi_fragment_count;
    uint64_t fragments;
    uint64_t samples; // that show a surface
};

#endif
