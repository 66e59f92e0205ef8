// From clip space to the rounded screen: the mapping, clip codes and their batch form.
#ifndef DIP_RENDERER_PIPELINE_GEOMETRY_PROJECT_H
#define DIP_RENDERER_PIPELINE_GEOMETRY_PROJECT_H

#include "renderer/pipeline/pipeline.h"

#include <stdint.h>

// Clip codes: which half-spaces a vertex is outside of.
enum {
    DIP_CLIP_NEAR = 1 << 0, // z > w
    DIP_CLIP_FAR = 1 << 1,  // z < 0
    DIP_CLIP_W = 1 << 2,    // w below DIP_MIN_W
    DIP_CLIP_LEFT = 1 << 3, // of what is drawn of the picture: to reject, not to clip
    DIP_CLIP_RIGHT = 1 << 4,
    DIP_CLIP_TOP = 1 << 5,
    DIP_CLIP_BOTTOM = 1 << 6,
    DIP_CLIP_GUARD_LEFT = 1 << 7, // of the guard band: to clip
    DIP_CLIP_GUARD_RIGHT = 1 << 8,
    DIP_CLIP_GUARD_TOP = 1 << 9,
    DIP_CLIP_GUARD_BOTTOM = 1 << 10,
    DIP_CLIP_USER = 1 << 11,    // and the next five bits
    DIP_CLIP_INVALID = 1 << 17, // not finite, or too large to compute with: rejects the triangle

    DIP_CLIP_PICTURE = DIP_CLIP_LEFT | DIP_CLIP_RIGHT | DIP_CLIP_TOP | DIP_CLIP_BOTTOM,
    DIP_CLIP_GUARD =
        DIP_CLIP_GUARD_LEFT | DIP_CLIP_GUARD_RIGHT | DIP_CLIP_GUARD_TOP | DIP_CLIP_GUARD_BOTTOM,
    DIP_CLIP_ALL_USER = ((1 << DIP_MAX_CLIP_PLANES) - 1) * DIP_CLIP_USER,
    DIP_CLIP_NEEDED =
        DIP_CLIP_NEAR | DIP_CLIP_FAR | DIP_CLIP_W | DIP_CLIP_GUARD | DIP_CLIP_ALL_USER,
};

// Smallest w that is divided by.
#define DIP_MIN_W 1e-6f
// Largest clip coordinate that is computed with; beyond it (or NaN) a triangle is dropped.
#define DIP_MAX_CLIP_COORDINATE 2.1e37f

typedef struct DipScreenMapping {
    float half_width; // pixels
    float half_height;
    // Where drawing ends, in units of w: beyond it nothing can reach the pass' region.
    float left, right, bottom, top;
    // The guard band in units of w: -guard_left w <= x <= guard_right w; likewise y, up positive.
    float guard_left, guard_right, guard_bottom, guard_top;
    float clip_planes[DIP_MAX_CLIP_PLANES][4];
    int clip_plane_count;
} DipScreenMapping;

// Screen positions of a chunk's vertices. Where a code asks for clipping, x, y, z, rw hold nothing
// of use.
typedef struct DipScreenBatch {
    int32_t x[DIP_VERTEX_BATCH]; // 1/256 pixel from the target's top left corner
    int32_t y[DIP_VERTEX_BATCH];
    float z[DIP_VERTEX_BATCH];  // depth, z / w
    float rw[DIP_VERTEX_BATCH]; // 1 / w
    int32_t code[DIP_VERTEX_BATCH];
} DipScreenBatch;

DipScreenMapping dip_screen_mapping(const DipPass *pass);

#endif
