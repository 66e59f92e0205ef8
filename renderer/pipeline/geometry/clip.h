// Clipping a triangle in clip space against the near, far, guard-band and user planes.
#ifndef DIP_RENDERER_PIPELINE_GEOMETRY_CLIP_H
#define DIP_RENDERER_PIPELINE_GEOMETRY_CLIP_H

#include "renderer/pipeline/geometry/project.h"

#include <stdbool.h>

// Each plane adds at most one vertex to the triangle's 3. There are seven planes (near, far,
// smallest w, four of the guard band) and the user clip planes.
enum { DIP_MAX_CLIP_VERTICES = 3 + 7 + DIP_MAX_CLIP_PLANES };

// A vertex is far if a clip coordinate has a greater magnitude than DIP_FAR_COORDINATE, or than
// DIP_FAR_RATIO times the distance of the near plane. The edges that end at a far vertex are cut in
// double precision. The ratio keeps cuts exact where the near plane is closer than 0.1 m.
#define DIP_FAR_COORDINATE 512.0f
#define DIP_FAR_RATIO      5120.0f

typedef struct DipClipVertex {
    // The clip position by which the polygon is cut. It has the precision of a double if the vertex
    // is far or lies on an edge that ends at a far vertex, and the precision of a float otherwise.
    double position[4];
    bool far;
    // Whether the edge from this vertex to the next is part of an edge of the triangle.
    bool edge;
    // The position that is projected. For a vertex of the triangle, it is the vertex shader's, so
    // that triangles that are not cut have the same vertex.
    float projected[4];
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
