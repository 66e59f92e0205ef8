// Culling by bounding boxes: which objects may be in view of a pass.
#ifndef DIP_RENDERER_PIPELINE_CULL_H
#define DIP_RENDERER_PIPELINE_CULL_H

#include "renderer/base/api.h"
#include "renderer/pipeline/mesh.h"
#include "renderer/pipeline/pipeline.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { DIP_VIEW_PLANES = 6, DIP_MAX_CULL_PLANES = DIP_VIEW_PLANES + DIP_MAX_CLIP_PLANES };

// Half-spaces: a point is inside where dot(normal, (x, y, z, 1)) >= 0 for each of the first `count`
// planes. The planes after them hold everything.
typedef struct DipCullPlanes {
    int count;
    float normal[4][DIP_MAX_CULL_PLANES]; // [coordinate][plane]: a vector holds several planes
} DipCullPlanes;

// The planes, in the world, of what a pass draws: the view volume, narrowed to the pass's region,
// and the user's clip planes. world_to_clip: 4x4, row-major. The pass's draws are not read.
DIP_API DipCullPlanes dip_cull_pass_planes(const DipPass *pass, const double world_to_clip[16]);

// The planes, in the world, of the whole view volume.
DIP_API DipCullPlanes dip_cull_view_planes(const double world_to_clip[16]);

// Returns whether a box lies wholly outside one of the planes.
DIP_API bool dip_cull_outside(const DipCullPlanes *planes, const DipBox *box);

// Returns a box in the world that holds a transformed one, with a margin for the rounding of the
// shader that transforms the vertices. transform: rows of a 3x4 matrix.
DIP_API DipBox dip_cull_transform_box(const float transform[12], const DipBox *box);

#ifdef __cplusplus
}
#endif

#endif
