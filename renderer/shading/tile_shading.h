// From a tile's visibility buffer to shaded pixels: the lists and buffers a worker keeps.
//
// Every pixel's distinct surfaces become fragments, gathered per draw and shaded 64 at a time. A
// fragment that holds all samples of its pixel is the pixel; the others add to a sum in 16-bit
// linear light, weighted by their samples, in integers, so the order does not matter.
#ifndef DIP_RENDERER_SHADING_TILE_SHADING_H
#define DIP_RENDERER_SHADING_TILE_SHADING_H

#include "renderer/frame.h"
#include "renderer/pipeline.h"
#include "renderer/raster/tile.h"
#include "renderer/shader.h"

#include <stdbool.h>
#include <stdint.h>

enum { DIP_TILE_PIXELS = DIP_TILE * DIP_TILE };

// Fragments of one draw that wait to be shaded. Arrays may be read to their end.
typedef struct DipFragmentList {
    int count;
    uint32_t triangle[DIP_FRAGMENT_BATCH]; // index into the geometry's triangles
    uint16_t pixel[DIP_FRAGMENT_BATCH];    // of the tile: y * DIP_TILE + x
    uint8_t samples[DIP_FRAGMENT_BATCH];   // bit s: holds sample s
    float x[DIP_FRAGMENT_BATCH];           // where it is shaded, pixels in the target
    float y[DIP_FRAGMENT_BATCH];
} DipFragmentList;

// How coverage asks which fragments of an alpha-clipped triangle are there: it fills the list's
// count, x, y and triangle (one for all; these three up to a multiple of DIP_BATCH_ALIGN) and calls
// test, which returns a byte per fragment, 0 where the surface is not. `samples` and `pixel` are
// not used.
typedef struct DipClipTest {
    DipFragmentList *list;
    const uint8_t *(*test)(void *context, const DipTriangle *triangle);
    void *context;
} DipClipTest;

// A batch after shading.
typedef struct DipEncodedBatch {
    int32_t linear16[3][DIP_FRAGMENT_BATCH];
    uint32_t rgba8[DIP_FRAGMENT_BATCH]; // bytes R, G, B, 255 in memory order (little-endian)
} DipEncodedBatch;

// The geometry's arrays, as kernels read them.
typedef struct DipShadingInput {
    const DipTriangle *triangles;
    const float *surfaces;
} DipShadingInput;

typedef struct DipTileShading DipTileShading;

// Shades a draw's list and empties it.
typedef void DipFlushList(DipTileShading *shading, uint32_t draw);

struct DipTileShading {
    DipTile *tile;
    DipShadingInput input;
    DipFlushList *flush;
    DipFlushList *flush_whole;
    void *context;                // of both
    DipFragmentList *lists;       // per draw
    DipFragmentList *whole_lists; // per draw: of whole sub-blocks, 16 fragments of a triangle each
    uint32_t *active;             // draws whose list was used in this tile, in order of first use
    int active_count;
    uint8_t *is_active; // per draw
    int width;          // of the tile that lies in the target
    int height;
    uint32_t *pixels; // of the tile's first pixel in the target
    size_t stride;    // pixels per row of the target
    uint32_t clear_rgba8;
    int32_t clear_linear16[3];
    int32_t (*sum)[4]; // per tile pixel: linear16 sums of a pixel with several surfaces
    uint16_t *mixed;   // such pixels
    int mixed_count;
    uint64_t fragments;
};

#endif
