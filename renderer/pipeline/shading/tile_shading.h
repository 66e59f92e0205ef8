// Shading of a tile: the lists and buffers in which a worker turns the visibility buffer
// (raster/tile.h) into pixels.
//
// A patch is a small group of triangles that join smoothly (pipeline/patch.h). Each distinct patch
// that a pixel shows becomes one fragment. Fragments are collected per draw and shaded 64 at a
// time. If a fragment holds all samples of its pixel, its colour becomes the pixel's colour. Other
// fragments are added to the pixel's sum in 16-bit linear light, weighted by their numbers of
// samples. The sums are integers, so the order of fragments does not matter.
#ifndef DIP_RENDERER_PIPELINE_SHADING_TILE_SHADING_H
#define DIP_RENDERER_PIPELINE_SHADING_TILE_SHADING_H

#include "renderer/pipeline/pipeline.h"
#include "renderer/pipeline/raster/tile.h"
#include "renderer/pipeline/shader.h"

#include <stdbool.h>
#include <stdint.h>

enum { DIP_TILE_PIXELS = DIP_TILE * DIP_TILE };

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

// The colours of a batch after shading, in 16-bit linear light and as sRGB pixels.
typedef struct DipEncodedBatch {
    int32_t linear16[3][DIP_FRAGMENT_BATCH];
    uint32_t rgba8[DIP_FRAGMENT_BATCH]; // bytes R, G, B, 255 in memory order (little-endian)
} DipEncodedBatch;

// The geometry's arrays, as kernels read them.
typedef struct DipShadingInput {
    const DipTriangle *triangles;
    const float *planes; // the planes of triangle i start at i * plane_stride
    int plane_stride;
    int x0; // column and row of the tile's first pixel in the target
    int y0;
} DipShadingInput;

typedef struct DipTileShading DipTileShading;

// How passes that are drawn at once share their shading (DipPassWork.copies_from). A worker draws
// the same tile of the passes one after the other, so it finds the tile of the pass that it copies
// from as that pass left it: its visibility buffer and its pixels.
typedef struct DipShadingShare {
    bool offers; // other passes copy pixels of this pass
    bool paused; // this tile neither offers nor copies pixels, because it is merged
    // The draws of this pass may have own_shading. If false, own_shading need not be looked up.
    bool some_own;
    const DipTileShading *from; // the pass to copy pixels from; NULL if this pass shades them all
    // If this pass offers pixels: those of the tile's sub-blocks that others may copy, one bit
    // each, [block][sub-block]. They show one patch alone, and their draw has no own_shading.
    uint16_t offered[DIP_BLOCKS][DIP_BLOCK_PIXELS / DIP_SUB_BLOCK_PIXELS];
} DipShadingShare;

// Shades the first fragments of a draw's list, at most one batch, and moves the remaining fragments
// to the start of the list.
typedef void DipFlushList(DipTileShading *shading, uint32_t draw);

struct DipTileShading {
    DipTile *tile;
    DipShadingInput input;
    const DipDraw *draws;
    const DipSampleGroups *groups; // sample groups of alpha-clipped draws; NULL: one group
    bool groups_shade_all;         // all draws have these groups
    DipFlushList *flush;           // called when one of `lists` holds a batch
    DipFlushList *flush_whole;     // called when one of `whole_lists` holds a batch
    void *context;                 // for use by `flush` and `flush_whole`
    DipFragmentList *lists;        // one per draw
    DipFragmentList *whole_lists;  // one per draw, for whole sub-blocks of 16 fragments
    uint32_t *active;              // draws whose lists this tile has used, in order of first use
    int active_count;
    uint8_t *is_active; // one per draw: whether it is in `active`
    int width;          // width of the part of the tile that lies in the target
    int height;
    uint32_t *pixels; // points to the tile's first pixel in the target
    size_t stride;    // distance from one row of the target to the next, in pixels
    // Where the tile's colours go instead of to `pixels`, laid out for a DipTileDone; or NULL.
    uint16_t *light16;
    uint32_t clear_rgba8;
    int32_t clear_linear16[3];
    int32_t (*sum)[4];        // each pixel's sums of 16-bit linear light
    uint16_t *multi_fragment; // pixels that several fragments share
    int multi_fragment_count;
    DipShadingShare share;
    uint64_t fragments; // number of fragments that were shaded
    uint64_t copied;    // number of fragments that were copied from another pass
    uint64_t samples;   // number of samples that show a surface
};

// Stores the colour of a pixel, y * DIP_TILE + x, in shading->light16.
static inline void dip_store_light16(const DipTileShading *shading, uint32_t pixel, int32_t red,
                                     int32_t green, int32_t blue) {
    uint16_t *light = shading->light16 + pixel;
    light[0] = (uint16_t)red;
    light[DIP_TILE_PIXELS] = (uint16_t)green;
    light[2 * DIP_TILE_PIXELS] = (uint16_t)blue;
}

#endif
