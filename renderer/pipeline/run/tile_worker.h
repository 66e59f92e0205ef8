// The working memory of a worker thread, and the drawing of one tile (64x64 pixels of a pass):
// coverage, shading and resolve.
#ifndef DIP_RENDERER_PIPELINE_RUN_TILE_WORKER_H
#define DIP_RENDERER_PIPELINE_RUN_TILE_WORKER_H

#include "renderer/base/srgb.h"
#include "renderer/pipeline/geometry/geometry.h"
#include "renderer/pipeline/kernels/kernels.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/pipeline/shading/tile_shading.h"

// The parts of a tile's work whose times are measured.
typedef enum DipTileStage {
    DIP_TILE_STAGE_RASTER,
    DIP_TILE_STAGE_SHADING,
    DIP_TILE_STAGE_RESOLVE,
    DIP_TILE_STAGE_COUNT
} DipTileStage;

// The counters and times of drawing one tile. The pipeline sums them in tile order after all tiles
// are drawn.
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

// Data that all tiles of a pass share. The data do not change while tiles are drawn.
typedef struct DipTilePass {
    const DipKernels *kernels;
    const DipPass *pass;
    const DipSamplePattern *pattern;
    // This pipeline's own geometry, or the geometry of another pipeline if both are drawn together
    // and share it.
    const DipGeometry *geometry;
    DipSampleGroups groups_room;
    // &groups_room, or NULL if alpha-clipped draws have one sample group.
    const DipSampleGroups *groups;
    uint32_t clear_rgba8;
    int32_t clear_linear16[3];
    const DipSrgbEncodeTable *srgb;
    const float *srgb_light; // linear light of the 256 8-bit sRGB values
} DipTilePass;

// The memory that one thread writes while it runs geometry jobs and draws tiles.
typedef struct DipTileWorker {
    const DipTilePass *pass;
    DipGeometryScratch geometry;
    DipTile tile;
    DipTileShading shading;
    DipFragmentBatch batch;
    DipFragmentBatch clip_batch;
    DipFragmentList clip_list;
    DipEncodedBatch encoded;
    DipTileWork *work; // counters and times of the tile that is being drawn
} DipTileWorker;

// Creates the working memory of one thread. Each worker's memory is allocated separately, so that
// threads share no cache line. Returns NULL if memory runs out.
DipTileWorker *dip_tile_worker_create(const DipTilePass *pass);
void dip_tile_worker_destroy(DipTileWorker **worker);

// Replaces the fragment lists by new ones for draw_count draws. The pipeline calls this for all its
// workers when a pass has more draws than any pass before. Returns false if memory runs out.
bool dip_tile_worker_make_lists(DipTileWorker *worker, int draw_count);

// Draws the tile with this index (y * tiles_x + x) and fills in *work.
void dip_tile_worker_draw(DipTileWorker *worker, int index, DipTileWork *work);

#endif
