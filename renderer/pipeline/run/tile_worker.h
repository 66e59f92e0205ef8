// The working memory of a worker thread, and the drawing of one tile (64x64 pixels of a pass):
// coverage, shading and resolve.
#ifndef DIP_RENDERER_PIPELINE_RUN_TILE_WORKER_H
#define DIP_RENDERER_PIPELINE_RUN_TILE_WORKER_H

#include "renderer/base/pages.h"
#include "renderer/base/srgb.h"
#include "renderer/pipeline/geometry/geometry.h"
#include "renderer/pipeline/kernels/kernels.h"
#include "renderer/pipeline/merge/merge_tile.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/pipeline/run/shader_guard.h"
#include "renderer/pipeline/shading/tile_shading.h"

// Data that all tiles of a pass share. The data do not change while tiles are drawn.
typedef struct DipTilePass {
    const DipKernels *kernels;
    const DipPass *pass;
    const DipPass *const *at_once; // all passes that are drawn at once, this one among them
    int at_once_count;
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
    const float *srgb_light;    // linear light of the 256 8-bit sRGB values
    bool merged;                // the pass is merged (merge/merge_tile.h)
    bool merges_all;            // it merges even the tiles that no ordered draw reaches
    bool clips;                 // some draw has a clip shader
    DipTileRecording recording; // where the tiles are recorded, or NULL
    DipMergePass merge;
} DipTilePass;

// The memory that one thread writes while it runs geometry jobs and draws tiles.
typedef struct DipTileWorker {
    const DipTilePass *pass;
    _Alignas(DIP_CACHE_LINE) DipGeometryScratch geometry;
    DipTile tile;
    DipTileShading shading;
    _Alignas(DIP_CACHE_LINE) DipFragmentBatch batch;
    _Alignas(DIP_CACHE_LINE) DipFragmentBatch clip_batch;
    bool batch_has_front; // `batch.front` may hold numbers other than 0
    bool clip_batch_has_front;
    DipShaderGuard guard;      // of `batch`
    DipShaderGuard clip_guard; // of `clip_batch`
    DipFragmentList clip_list;
    DipClipQueue clip_queue;
    DipClipTest clip; // of plain draws
    _Alignas(DIP_CACHE_LINE) DipEncodedBatch encoded;
    uint16_t *light16;  // a tile's light for a DipTileDone; exists once a pass has handed light
    DipMergeTile merge; // its arrays exist once a merged pass has been drawn
    bool merging;       // the tile is being merged
    int64_t shading_ns; // merged passes: time of shading in the tile so far
    DipTileRecord tile_record; // of the tile that is being drawn
    DipTileRecord pass_record; // the sum of those that this worker has drawn in the pass
} DipTileWorker;

// Creates the working memory of one thread. Each worker's memory is allocated separately, so that
// threads share no cache line. Returns NULL if memory runs out.
DipTileWorker *dip_tile_worker_create(const DipTilePass *pass);
void dip_tile_worker_destroy(DipTileWorker **worker);

// Replaces the fragment lists by new ones for draw_count draws. The pipeline calls this for all its
// workers when a pass has more draws than any pass before. Returns false if memory runs out.
bool dip_tile_worker_make_lists(DipTileWorker *worker, int draw_count);

// Allocates the memory for merged passes, if it does not exist. Returns false if memory runs out.
bool dip_tile_worker_make_merge(DipTileWorker *worker);

// Allocates the memory for passes that hand over their light, if it does not exist. Returns false
// if memory runs out.
bool dip_tile_worker_make_light(DipTileWorker *worker);

// Interpolates and shades the first fragments of a list, at most one batch, into worker->batch.
// Returns the number of these fragments.
int dip_tile_worker_shade(DipTileWorker *worker, uint32_t draw, DipFragmentList *list);

// Removes the first `count` fragments of a list.
void dip_fragment_list_drop(DipFragmentList *list, int count);

// Covers a triangle of a plain draw. If it is alpha-clipped, its last fragments wait for the clip
// test until dip_tile_worker_end_clip.
void dip_tile_worker_cover(DipTileWorker *worker, uint32_t triangle);

// Runs the clip test on the fragments that wait for it. Until then, the tile lacks them.
void dip_tile_worker_end_clip(DipTileWorker *worker);

// Returns the clip test of the worker's pass, whose context is the worker. groups: see DipClipTest.
DipClipTest dip_tile_worker_clip_test(DipTileWorker *worker, const DipSampleGroups *groups);

// Runs a draw's clip shader on the fragments in worker->clip_list, as DipClipTest describes.
// context: the worker.
const uint8_t *dip_tile_worker_clip(void *context, uint32_t draw);

// Collects the fragments of all covered samples, and shades them.
void dip_tile_worker_shade_tile(DipTileWorker *worker);

// Records which pixels of the tile several fragments share, if tiles are recorded.
void dip_tile_worker_record_mixed(const DipTileWorker *worker);

// Shades and resolves a tile that is not merged and whose triangles have covered it since begin_ns.
void dip_plain_tile_end(DipTileWorker *worker, int64_t begin_ns);

// merged_tile.c: begin merges the tile from now on; draw covers, shades and stores the tile of a
// merged pass, which merges it if an ordered draw reaches it.
void dip_merged_tile_begin(DipTileWorker *worker);
void dip_merged_tile_draw(DipTileWorker *worker, int index);

// Prepares a worker for the tiles of its next pass: it has drawn none, and shares no shading yet.
void dip_tile_worker_begin_pass(DipTileWorker *worker);

// Draws the tile with this index (y * tiles_x + x), adds its counters and times to
// worker->pass_record, and records it if tiles are recorded.
void dip_tile_worker_draw(DipTileWorker *worker, int index);

#endif
