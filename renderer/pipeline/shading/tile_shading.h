// Shading of a tile: the lists and buffers in which a worker turns the visibility buffer into
// pixels.
//
// Each distinct patch in a pixel becomes one fragment. Fragments are collected per draw and shaded
// 64 at a time. A fragment that holds all samples of its pixel gives the pixel its colour. Other
// fragments are added to a sum in 16-bit linear light, weighted by their number of samples. The
// sums are integers, so the order of fragments does not matter.
#ifndef DIP_RENDERER_PIPELINE_SHADING_TILE_SHADING_H
#define DIP_RENDERER_PIPELINE_SHADING_TILE_SHADING_H

#include "renderer/pipeline/pipeline.h"
#include "renderer/pipeline/raster/tile.h"
#include "renderer/pipeline/shader.h"

#include <stdbool.h>
#include <stdint.h>

enum { DIP_TILE_PIXELS = DIP_TILE * DIP_TILE };

// A fragment's position, in bits: its pixel in the tile, y * DIP_TILE + x, and the point that is
// shaded within the pixel, in 1/256 pixel from the pixel's top left corner.
enum {
    DIP_POSITION_Y = 6,                       // first of y's 6 bits, after the 6 of x
    DIP_POSITION_SUB_X = 12,                  // first of 8 bits
    DIP_POSITION_SUB_Y = 20,                  // first of 8 bits
    DIP_POSITION_PIXEL = DIP_TILE_PIXELS - 1, // mask of the pixel's x and y
};

// The length of a list. The 16 fragments of a sub-block are added at once, so a list may become
// longer than a batch.
enum { DIP_LIST_ROOM = DIP_FRAGMENT_BATCH + 16 };

// Fragments of one draw that wait to be shaded. Kernels may read the arrays to their end.
typedef struct DipFragmentList {
    int count;
    uint32_t triangle[DIP_LIST_ROOM]; // index into the geometry's triangles
    uint32_t position[DIP_LIST_ROOM]; // its position, in the bits described above
    // Bit s: the fragment holds sample s. Not set in lists of whole sub-blocks, whose fragments
    // hold all samples.
    uint32_t samples[DIP_LIST_ROOM];
} DipFragmentList;

// How coverage finds out which fragments of an alpha-clipped triangle exist. It fills in the list's
// count, position and triangle (the same for all; both arrays up to a multiple of DIP_BATCH_ALIGN),
// but not its samples. Then it calls test, which returns a byte per fragment: 0 where the surface
// is cut away. With sample groups, a pixel is tested once for each group in which it has visible
// samples.
typedef struct DipClipTest {
    DipFragmentList *list;
    const uint8_t *(*test)(void *context, const DipTriangle *triangle);
    void *context;
    const DipSampleGroups *groups; // NULL: one group of all samples
} DipClipTest;

// The colours of a batch after shading, in 16-bit linear light and as sRGB pixels.
typedef struct DipEncodedBatch {
    int32_t linear16[3][DIP_FRAGMENT_BATCH];
    uint32_t rgba8[DIP_FRAGMENT_BATCH]; // bytes R, G, B, 255 in memory order (little-endian)
} DipEncodedBatch;

// The geometry's arrays, as kernels read them.
typedef struct DipShadingInput {
    const DipTriangle *triangles;
    const float *planes; // those of triangle i start at i * plane_stride
    int plane_stride;
    int x0; // column and row of the tile's first pixel in the target
    int y0;
} DipShadingInput;

typedef struct DipTileShading DipTileShading;

// Shades at most a batch of a draw's list, and moves the rest to its start.
typedef void DipFlushList(DipTileShading *shading, uint32_t draw);

struct DipTileShading {
    DipTile *tile;
    DipShadingInput input;
    const DipDraw *draws;
    const DipSampleGroups *groups; // groups of alpha-clipped draws; NULL: one group
    DipFlushList *flush;           // for `lists`, called when a list holds a batch
    DipFlushList *flush_whole;     // for `whole_lists`, called when a list holds a batch
    void *context;                 // context of these two functions
    DipFragmentList *lists;        // one per draw
    DipFragmentList *whole_lists;  // one per draw, for whole sub-blocks of 16 fragments
    uint32_t *active;              // draws whose lists this tile has used, in order of first use
    int active_count;
    uint8_t *is_active; // one per draw: whether it is in `active`
    int width;          // width of the part of the tile that lies in the target
    int height;
    uint32_t *pixels; // the tile's first pixel in the target
    size_t stride;    // pixels from one row of the target to the next
    uint32_t clear_rgba8;
    int32_t clear_linear16[3];
    int32_t (*sum)[4];        // each pixel's sums of 16-bit linear light
    uint16_t *multi_fragment; // pixels that several fragments share
    int multi_fragment_count;
    uint64_t fragments;
    uint64_t samples; // number of samples that show a surface
};

#endif
