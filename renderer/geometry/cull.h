// Which chunks of a pass may be in view.
#ifndef DIP_RENDERER_GEOMETRY_CULL_H
#define DIP_RENDERER_GEOMETRY_CULL_H

#include "renderer/geometry/geometry.h"
#include "renderer/geometry/mesh.h"

// Fills `visible`, in submission order, with the chunks whose boxes do not lie outside one plane of
// the view volume or of the user's; returns their number. There must be room for all chunks.
uint32_t dip_cull_chunks(const DipPass *pass, DipVisibleChunk *visible);

// Whether a box may be in view: false only where it lies outside one plane of the view volume.
bool dip_cull_in_view(const float to_clip[16], const DipBox *box);

// The pixels that a pass draws: its region, or all of the target, to whole blocks.
DipRegion dip_drawn_region(const DipPass *pass);

#endif
