// Clipping a triangle in clip space against the near, far, guard-band and user planes.
#ifndef DIP_RENDERER_PIPELINE_GEOMETRY_CLIP_H
#define DIP_RENDERER_PIPELINE_GEOMETRY_CLIP_H

#include "renderer/pipeline/geometry/project.h"

// Each plane adds at most one vertex to the triangle's 3. There are seven planes (near, far,
// smallest w, four of the guard band) and the user clip planes.
enum { DIP_MAX_CLIP_VERTICES = 3 + 7 + DIP_MAX_CLIP_PLANES };

typedef struct DipClipVertex {
    float position[4];
    // Rounded to floats, except large repeating varyings, which are reduced before they are
    // rounded.
    double varying[DIP_MAX_VARYINGS];
} DipClipVertex;

typedef struct DipClipPolygon {
    int count; // 0, or 3..DIP_MAX_CLIP_VERTICES
    DipClipVertex vertex[DIP_MAX_CLIP_VERTICES];
} DipClipPolygon;

typedef struct DipClipVaryings {
    int count;
    uint32_t repeating; // DipDraw.repeating_varyings
} DipClipVaryings;

// Clips a convex polygon in place by the planes whose bits are set in `codes`. Every new vertex is
// interpolated from the edge's inside vertex towards its outside vertex. Two triangles that share
// the edge therefore get the same new vertex.
void dip_clip_polygon(DipClipPolygon *polygon, int32_t codes, const DipScreenMapping *map,
                      const DipClipVaryings *varyings);

#endif
