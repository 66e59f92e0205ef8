// The working memory of a worker thread, and what it does with a tile: coverage, shading and
// resolve of 64x64 pixels of a pass.
#ifndef DIP_RENDERER_PIPELINE_RUN_TILE_WORKER_H
#define DIP_RENDERER_PIPELINE_RUN_TILE_WORKER_H

#include "renderer/base/srgb.h"
#include "renderer/pipeline/geometry/geometry.h"
#include "renderer/pipeline/kernels/kernels.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/pipeline/shading/tile_shading.h"

// The timed parts of a tile's work.
typedef enum DipTileStage {
    DIP_TILE_STAGE_RASTER,
    DIP_TILE_STAGE_SHADING,
    DIP_TILE_STAGE_RESOLVE,
    DIP_TILE_STAGE_COUNT
} DipTileStage;

// What one tile did. The pipeline sums these in tile order once all tiles are drawn.
typedef struct DipTileWork {
    DipShaderWork sampling;
    uint64_t sub_blocks_tested;
    uint64_t sub_blocks_accepted;
    uint64_t clip_tested;
    uint64_t clip_sample_groups;
    uint64_t fragments;
    uint64_t samples;
    uint64_t multi_fragment_pixels;
    int64_t stage_ns[DIP_TILE_STAGE_COUNT];
} DipTileWork;

// What all tiles of a pass have in common. It does not change while tiles are drawn.
typedef struct DipTilePass {
    const DipKernels *kernels;
    const DipPass *pass;
    const DipSamplePattern *pattern;
    const DipGeometry *geometry; // this pipeline's, or that of another that draws the same geometry
    DipSampleGroups groups_room;
    const DipSampleGroups *groups; // &groups_room; NULL: alpha-clipped draws have one sample group
    uint32_t clear_rgba8;
    int32_t clear_linear16[3];
    const DipSrgbEncodeTable *srgb;
    const float *srgb_light; // linear light of the 256 sRGB codes
} DipTilePass;

// Everything that one thread writes while it runs geometry jobs and tiles.
typedef struct DipTileWorker {
    const DipTilePass *pass;
    DipGeometryScratch geometry;
    DipTile tile;
    DipTileShading shading;
    DipFragmentBatch batch;
    DipFragmentBatch clip_batch;
    DipFragmentList clip_list;
    DipEncodedBatch encoded;
    DipTileWork *work; // work of the tile that is being drawn
} DipTileWorker;

// Returns NULL if memory runs out. Each worker has memory of its own, so that threads share no
// cache line.
DipTileWorker *dip_tile_worker_create(const DipTilePass *pass);
void dip_tile_worker_destroy(DipTileWorker **worker);

// Makes new fragment lists for draw_count draws. The pipeline calls this for all its workers when a
// pass has more draws than any pass before it. Returns false if memory runs out.
bool dip_tile_worker_make_lists(DipTileWorker *worker, int draw_count);

// Draws the tile with this index (y * tiles_x + x) and fills *work.
void dip_tile_worker_draw(DipTileWorker *worker, int index, DipTileWork *work);

#endif
