// A triangle after set-up: the data that coverage reads, and the layout of the triangle's shading
// planes.
#ifndef DIP_RENDERER_PIPELINE_RASTER_TRIANGLE_H
#define DIP_RENDERER_PIPELINE_RASTER_TRIANGLE_H

#include <stdint.h>

enum {
    DIP_SUBPIXELS = 256,      // screen positions are in 1/256 pixel
    DIP_GUARD_BAND_PX = 16000 // |x|, |y| of every set-up vertex are below this
};

// Edge i is E(x, y) = a x + b y + c, with x and y in 1/256 pixel from the target's top left corner.
// A sample is inside the triangle if all three edge values are >= 0 there. c includes the top-left
// rule. |a| and |b| are below 2^23.
typedef struct DipTriangle {
    int64_t c[3];
    int32_t a[3];
    int32_t b[3];
    int16_t x0, y0, x1, y1; // box of target pixels that may hold covered samples, inclusive
    uint32_t draw;          // index into the pass's draws
    // Number of the triangle's patch among the patches of all draws, from 1. Triangles of ordered
    // draws have flags instead (merge/ordered.h).
    uint32_t patch;
    double z_origin; // depth at the target's top left corner
    double z_dx;     // change of depth per pixel
    double z_dy;
    float z_min; // smallest depth of the vertices; depth is clamped to z_min..z_max
    float z_max;
} DipTriangle;

// The shading planes of triangles have an array of their own. Each triangle has the x and y of its
// anchor in pixels, a plane for 1/w, and a plane for each varying/w. A plane consists of the value
// at the anchor and the derivatives per pixel along x and y. The anchor is a corner of the box of
// pixels that the triangle touches: the corner where 1/w is smallest in magnitude. Float planes are
// most exact near their anchor, and the far end of a receding triangle needs exactness most.
enum {
    DIP_PLANES_ANCHOR = 0,
    DIP_PLANES_RW = 2,
    DIP_PLANES_VARYINGS = 5,
};

// Returns the number of floats that a triangle's planes take.
static inline int dip_plane_floats(int varying_count) {
    return DIP_PLANES_VARYINGS + 3 * varying_count;
}

enum { DIP_PLANES_ALIGN = 8 }; // number of floats that set-up writes at once

// Returns the distance from one triangle's planes to the next triangle's planes, in floats.
static inline int dip_plane_stride(int varying_count) {
    return (dip_plane_floats(varying_count) + DIP_PLANES_ALIGN - 1) / DIP_PLANES_ALIGN *
           DIP_PLANES_ALIGN;
}

#endif
