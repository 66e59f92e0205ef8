// A tile of a *merged* pass: a pass that needs the colours of all samples while it draws, because
// it has ordered draws (pipeline/state.h), starts from earlier colours or depths, keeps its depths
// or the colours of its samples, draws without colours, has a viewport or a scissor, or has a
// target of another format than sRGB bytes. Passes that need none of this are drawn without this
// memory. If ordered draws are the only reason, so are the tiles that they do not reach: the
// colours have the same bits either way.
#ifndef DIP_RENDERER_PIPELINE_MERGE_MERGE_TILE_H
#define DIP_RENDERER_PIPELINE_MERGE_MERGE_TILE_H

#include "renderer/base/srgb.h"
#include "renderer/pipeline/kernels/kernels.h"
#include "renderer/pipeline/merge/ordered.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/pipeline/raster/tile.h"

// What all tiles of a merged pass share.
typedef struct DipMergePass {
    const DipKernels *kernels;
    const DipPass *pass;
    const uint8_t *is_ordered; // one per draw
    bool has_colours;          // draws are shaded
    bool resolves;             // the target receives the means of the samples
    bool clamps;               // the target's colours stay within 0..1
    bool uses_stencil;         // a draw tests stencil values, or the pass stores them
    bool starts_from_depth;    // depths are loaded, or cleared to another value than 0
    DipTargetRegion stored;    // pixels of the target that the pass may change
    float clear[4];
    uint32_t clear_rgba8; // in the target's format, if that has 8 bits per channel
    const DipSrgbEncodeTable *srgb;
    const float *srgb_light; // linear light of the 256 8-bit sRGB values
} DipMergePass;

// The memory of one worker for tiles of merged passes.
typedef struct DipMergeTile {
    DipTileColours colours;
    DipOrdered ordered;
    uint8_t *stencil;  // [block][sample][64]
    uint32_t *scratch; // 64x64 pixels, where shading of plain draws puts what is not needed here
    int64_t draw;      // the ordered draw whose fragments are queued, or -1
    bool plain_left;   // plain draws have covered samples that are not shaded yet
} DipMergeTile;

// Whether a pass must be drawn as a merged pass.
bool dip_pass_is_merged(const DipPass *pass);

// Whether a merged pass must merge even the tiles that no ordered draw reaches.
bool dip_pass_merges_all_tiles(const DipPass *pass);

// Whether a pass hands the light of its tiles to DipPass.tile_done.
bool dip_pass_hands_light(const DipPass *pass);

// Whether a pass draws colours, into samples or a target.
bool dip_pass_has_colours(const DipPass *pass);

// Whether a pass writes the means of its samples to its target.
bool dip_pass_stores_target(const DipPass *pass);

// Fills in everything but `is_ordered`, whose entries must have been set.
void dip_merge_pass_begin(DipMergePass *merge, const DipPass *pass);

// Allocates the arrays of a worker. Returns false if memory runs out; the arrays may be freed then.
bool dip_merge_tile_allocate(DipMergeTile *merge);
void dip_merge_tile_free(DipMergeTile *merge);

// Prepares a tile: its depths and stencil values, and no colours yet.
void dip_merge_begin(const DipMergePass *pass, DipMergeTile *merge, DipTile *tile);

// Gives a block its first colours: those that the pass keeps, or the clear colour.
void dip_merge_load_block(const DipMergePass *pass, DipMergeTile *merge, const DipTile *tile,
                          int block);

// Makes sure that a block has colours.
static inline void dip_merge_ready_block(const DipMergePass *pass, DipMergeTile *merge,
                                         const DipTile *tile, int block) {
    if (!(merge->colours.ready >> block & 1)) {
        dip_merge_load_block(pass, merge, tile, block);
    }
}

// Store the colours of shaded fragments of plain draws, from the first entries of a list. In a list
// of whole sub-blocks, 16 entries are one sub-block. Plain draws have the alpha 1.
void dip_merge_store_fragments(const DipMergePass *pass, DipMergeTile *merge, const DipTile *tile,
                               const DipFragmentList *list, int count,
                               const DipFragmentBatch *batch);
void dip_merge_store_whole(const DipMergePass *pass, DipMergeTile *merge, const DipTile *tile,
                           const DipFragmentList *list, const DipFragmentBatch *batch);

// Forgets which triangles the samples show, and keeps their depths.
void dip_merge_clear_ids(DipTile *tile);

// attachments.c: the way between a tile and what outlives a pass.
void dip_load_colours(const DipMergePass *pass, const DipTile *tile, int block,
                      float *const light[4]);
void dip_load_depths(const DipMergePass *pass, DipTile *tile);
void dip_load_stencil(const DipMergePass *pass, const DipTile *tile, uint8_t *stencil);
// light16: where the means of the samples go instead of to the target, laid out for a DipTileDone;
// or NULL.
void dip_store_attachments(const DipMergePass *pass, DipMergeTile *merge, const DipTile *tile,
                           uint16_t *light16);

// Stores the depths of the tile's drawn blocks in DipPass.depths, whether or not the pass is
// merged.
void dip_store_pass_depths(const DipPass *pass, const DipTile *tile);

// Whether a block of a tile is drawn.
static inline bool dip_block_is_drawn(const DipTile *tile, int block) {
    const int x = block % DIP_TILE_BLOCKS * DIP_BLOCK;
    const int y = block / DIP_TILE_BLOCKS * DIP_BLOCK;
    return x >= tile->left && y >= tile->top && x < DIP_TILE - tile->right &&
           y < DIP_TILE - tile->bottom;
}

#endif
