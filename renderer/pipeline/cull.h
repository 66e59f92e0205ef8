// Culling by bounding boxes: finds the objects that a pass may show.
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
// planes. The other planes of the array are padding; every point is inside them.
typedef struct DipCullPlanes {
    int count;
    // The index is [coordinate][plane], so that a vector can hold one coordinate of several planes.
    float normal[4][DIP_MAX_CULL_PLANES];
} DipCullPlanes;

// Returns the planes, in world space, that bound what a pass draws: the planes of its view volume,
// narrowed to the pass's region, and its user clip planes. world_to_clip: 4x4, row-major. The
// function does not read the pass's draws.
DIP_API DipCullPlanes dip_cull_pass_planes(const DipPass *pass, const double world_to_clip[16]);

// Returns the six planes, in world space, of the whole view volume.
DIP_API DipCullPlanes dip_cull_view_planes(const double world_to_clip[16]);

// Returns whether a box lies wholly outside one of the planes.
DIP_API bool dip_cull_outside(const DipCullPlanes *planes, const DipBox *box);

// Returns a box in world space that contains the transformed box. A margin covers the rounding of
// the shader that transforms the vertices. transform: rows of a 3x4 matrix.
DIP_API DipBox dip_cull_transform_box(const float transform[12], const DipBox *box);

#ifdef __cplusplus
}
#endif

#endif
