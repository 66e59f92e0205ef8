// Which objects and which of their chunks may be in view.
#ifndef DIP_RENDERER_PIPELINE_CULL_H
#define DIP_RENDERER_PIPELINE_CULL_H

#include "renderer/pipeline/geometry/geometry.h"
#include "renderer/pipeline/geometry/mesh_layout.h"
#include "renderer/scene/draw/view.h"

#include <stdbool.h>

enum { DIP_VIEW_PLANES = 6, DIP_MAX_CULL_PLANES = DIP_VIEW_PLANES + DIP_MAX_CLIP_PLANES };

// Half-spaces: inside where dot(normal, (x, y, z, 1)) >= 0. Those past `count` hold everything.
typedef struct DipCullPlanes {
    int count;
    float normal[4][DIP_MAX_CULL_PLANES]; // by coordinate: vectors take several planes
} DipCullPlanes;

// The bounds in the world of what a pass draws of a view: its region and the user's planes. The
// pass' draws are not read.
DipCullPlanes dip_cull_pass_planes(const DipPass *pass, const DipView *view);

// The bounds in the world of all that a view shows.
DipCullPlanes dip_cull_view_planes(const DipView *view);

// Whether a box lies wholly outside one of the planes.
bool dip_cull_outside(const DipCullPlanes *planes, const DipBox *box);

// A box in the world that holds a placed one, and what rounding adds when a shader places it.
DipBox dip_cull_place_box(const float transform[12], const DipBox *box);

// Fills `visible`, in submission order, with the chunks whose boxes do not lie outside one plane of
// the view volume or of the user's; returns their number. There must be room for all chunks.
uint32_t dip_cull_chunks(const DipPass *pass, DipVisibleChunk *visible);

// The pixels that a pass draws: its region, or all of the target, to whole blocks.
DipRegion dip_drawn_region(const DipPass *pass);

#endif
