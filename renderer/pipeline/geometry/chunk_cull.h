// Finds the chunks of a pass's draws that may be in view, and the pixels that the pass draws.
#ifndef DIP_RENDERER_PIPELINE_GEOMETRY_CHUNK_CULL_H
#define DIP_RENDERER_PIPELINE_GEOMETRY_CHUNK_CULL_H

#include "renderer/base/pool.h"
#include "renderer/pipeline/geometry/geometry.h"

// Fills `visible` with the chunks that may be in view, draw by draw in the order of `order`, which
// has the numbers of all draws, or in submission order if it is NULL. Returns the number of chunks.
// A chunk is left out if its box lies wholly outside one plane of the view volume, or outside one
// user clip plane. `visible` must have room for all chunks of the pass. Adds the draws of which
// some chunk is in view, and those of which none is, to *in_view and *culled; a draw whose mesh is
// empty is neither.
// pool: culls the draws; NULL: the caller's thread culls them.
uint32_t dip_cull_chunks(const DipPass *pass, const uint32_t *order, DipPool *pool,
                         DipVisibleChunk *visible, uint64_t *in_view, uint64_t *culled);

// Returns the rectangle of pixels that clip space maps to: the pass's viewport, or the whole
// target.
DipTargetRegion dip_viewport(const DipPass *pass);

// Returns the pixels that a pass draws: what its region, viewport and scissor have in common (the
// whole target if there are none), extended to whole 8x8 blocks.
DipTargetRegion dip_drawn_region(const DipPass *pass);

#endif
