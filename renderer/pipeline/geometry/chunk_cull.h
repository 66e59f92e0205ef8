// Which chunks of a pass's draws may be in view, and which pixels the pass draws.
#ifndef DIP_RENDERER_PIPELINE_GEOMETRY_CHUNK_CULL_H
#define DIP_RENDERER_PIPELINE_GEOMETRY_CHUNK_CULL_H

#include "renderer/pipeline/geometry/geometry.h"

// Fills `visible`, in submission order, with the chunks whose boxes do not lie wholly outside one
// plane of the view volume or of the user's clip planes, and returns their number. There must be
// room for all chunks of the pass.
uint32_t dip_cull_chunks(const DipPass *pass, DipVisibleChunk *visible);

// The pixels that a pass draws: its region, or all of the target, extended to whole 8x8 blocks.
DipTargetRegion dip_drawn_region(const DipPass *pass);

#endif
