// Clipping a triangle in clip space against the near, far, guard-band and user planes.
#ifndef DIP_RENDERER_PIPELINE_GEOMETRY_CLIP_H
#define DIP_RENDERER_PIPELINE_GEOMETRY_CLIP_H

#include "renderer/pipeline/geometry/project.h"

// Each plane adds at most one vertex: near, far, smallest w, four of the guard band, the user's.
enum { DIP_MAX_CLIP_VERTICES = 3 + 7 + DIP_MAX_CLIP_PLANES };

typedef struct DipClipVertex {
    float position[4];
    float varying[DIP_MAX_VARYINGS];
} DipClipVertex;

typedef struct DipClipPolygon {
    int count; // 0, or 3..DIP_MAX_CLIP_VERTICES
    DipClipVertex vertex[DIP_MAX_CLIP_VERTICES];
} DipClipPolygon;

// Clips a convex polygon in place by the planes whose codes are set. Every new vertex is
// interpolated from the inside vertex towards the outside one, so that two triangles that share an
// edge get the same vertex.
void dip_clip_polygon(DipClipPolygon *polygon, int32_t codes, const DipScreenMapping *map,
                      int varying_count);

#endif
