// Projection of vertices from clip space to rounded screen positions: the mapping, the clip codes
// and the batch of results.
#ifndef DIP_RENDERER_PIPELINE_GEOMETRY_PROJECT_H
#define DIP_RENDERER_PIPELINE_GEOMETRY_PROJECT_H

#include "renderer/pipeline/pipeline.h"

#include <stdint.h>

// Clip codes: each bit says that a vertex lies outside one half-space.
enum {
    DIP_CLIP_NEAR = 1 << 0, // z > w
    DIP_CLIP_FAR = 1 << 1,  // z < 0
    DIP_CLIP_W = 1 << 2,    // w below DIP_MIN_W
    // The vertex lies beyond the drawn part of the picture. These four planes only reject
    // triangles.
    DIP_CLIP_LEFT = 1 << 3,
    DIP_CLIP_RIGHT = 1 << 4,
    DIP_CLIP_TOP = 1 << 5,
    DIP_CLIP_BOTTOM = 1 << 6,
    // The vertex lies beyond the guard band. These four planes clip triangles.
    DIP_CLIP_GUARD_LEFT = 1 << 7,
    DIP_CLIP_GUARD_RIGHT = 1 << 8,
    DIP_CLIP_GUARD_TOP = 1 << 9,
    DIP_CLIP_GUARD_BOTTOM = 1 << 10,
    DIP_CLIP_USER = 1 << 11, // user plane 0; the next five bits are planes 1 to 5
    // A coordinate is not finite or too large to compute with. This rejects the triangle.
    DIP_CLIP_INVALID = 1 << 17,

    DIP_CLIP_PICTURE = DIP_CLIP_LEFT | DIP_CLIP_RIGHT | DIP_CLIP_TOP | DIP_CLIP_BOTTOM,
    DIP_CLIP_GUARD =
        DIP_CLIP_GUARD_LEFT | DIP_CLIP_GUARD_RIGHT | DIP_CLIP_GUARD_TOP | DIP_CLIP_GUARD_BOTTOM,
    DIP_CLIP_ALL_USER = ((1 << DIP_MAX_CLIP_PLANES) - 1) * DIP_CLIP_USER,
    // The planes by which triangles are clipped.
    DIP_CLIP_NEEDED =
        DIP_CLIP_NEAR | DIP_CLIP_FAR | DIP_CLIP_W | DIP_CLIP_GUARD | DIP_CLIP_ALL_USER,
};

// The smallest w by which projection divides; a vertex with a smaller w is clipped. It is smaller
// than any near plane of a scene (DIP_MIN_NEAR_M), so that rounding at the near plane never cuts a
// triangle here.
#define DIP_MIN_W 1e-13f
// Greatest magnitude of a clip coordinate. A triangle with a greater coordinate or with a NaN is
// dropped.
#define DIP_MAX_CLIP_COORDINATE 2.1e37f

// How clip space maps to the target.
typedef struct DipScreenMapping {
    float half_width; // half of the viewport's width, in pixels
    float half_height;
    int first_x; // column and row of the viewport's first pixel in the target
    int first_y;
    // Bounds of x / w and y / w. A triangle that lies wholly beyond one of them cannot reach the
    // pass's region.
    float left, right, bottom, top;
    // The guard band in units of w, with y pointing up: -guard_left w <= x <= guard_right w and
    // -guard_bottom w <= y <= guard_top w.
    float guard_left, guard_right, guard_bottom, guard_top;
    float clip_planes[DIP_MAX_CLIP_PLANES][4];
    int clip_plane_count;
} DipScreenMapping;

// Screen positions of a chunk's vertices. x, y, z and rw have no meaning for a vertex whose code
// has a bit of a clipping plane. z and rw may then be infinite or NaN, but x and y always lie
// within +-2^22.
typedef struct DipScreenBatch {
    int32_t x[DIP_VERTEX_BATCH]; // 1/256 pixel from the target's top left corner
    int32_t y[DIP_VERTEX_BATCH];
    float z[DIP_VERTEX_BATCH];  // depth, z / w
    float rw[DIP_VERTEX_BATCH]; // 1 / w
    int32_t code[DIP_VERTEX_BATCH];
} DipScreenBatch;

// Returns the mapping for a pass's target, viewport, region and user clip planes.
DipScreenMapping dip_screen_mapping(const DipPass *pass);

#endif
