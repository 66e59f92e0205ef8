// Shading of a tile: the lists and buffers in which a worker turns the visibility buffer
// (raster/tile.h) into pixels.
//
// A patch is a small group of triangles that join smoothly (pipeline/patch.h). Each distinct patch
// that a pixel shows becomes one fragment. Fragments are collected per draw and shaded in
// batches. If a fragment holds all samples of its pixel, its colour becomes the pixel's colour.
// Other fragments are added to the pixel's sum in 16-bit linear light, weighted by their numbers of
// samples. The sums are integers, so the order of fragments does not matter.
#ifndef DIP_RENDERER_PIPELINE_SHADING_TILE_SHADING_H
#define DIP_RENDERER_PIPELINE_SHADING_TILE_SHADING_H

#include "renderer/pipeline/pipeline.h"
#include "renderer/pipeline/raster/fragments.h"
#include "renderer/pipeline/raster/tile.h"
#include "renderer/pipeline/shader.h"

#include <stdbool.h>
#include <stdint.h>

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
    bool single_draw;              // the pass has only one draw
    const DipSampleGroups *groups; // sample groups of alpha-clipped draws; NULL: one group
    bool groups_shade_all;         // all draws have these groups
    DipFlushList *flush;           // called when one of `lists` holds a batch
    DipFlushList *flush_whole;     // called when one of `whole_lists` holds a batch
    void *context;                 // for use by `flush` and `flush_whole`
    void *list_memory;             // of both kinds of lists
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
