// A triangle after set-up: what coverage reads, and where its shading planes are.
#ifndef DIP_RENDERER_PIPELINE_GEOMETRY_TRIANGLE_H
#define DIP_RENDERER_PIPELINE_GEOMETRY_TRIANGLE_H

#include <stdint.h>

enum {
    DIP_SUBPIXELS = 256,      // screen positions are in 1/256 pixel
    DIP_GUARD_BAND_PX = 16000 // |x|, |y| of every set-up vertex are below this
};

// Edge i: E(x, y) = a x + b y + c with x, y in 1/256 pixel from the target's corner; a sample is
// inside where all three are >= 0 (the top-left rule is folded into c). |a|, |b| < 2^23.
typedef struct DipTriangle {
    int64_t c[3];
    int32_t a[3];
    int32_t b[3];
    int16_t x0, y0, x1, y1; // pixels that may hold covered samples, inclusive, within the target
    uint32_t draw;          // index into the pass' draws
    uint32_t patch;         // of all draws' patches, from 1
    double z_origin;        // depth at the target's corner
    double z_dx;            // per pixel
    double z_dy;
    float z_min; // of the vertices; depth is clamped to these
    float z_max;
} DipTriangle;

// Shading planes, in an array of their own, triangle by triangle: anchor x, y (pixels); then 1/w
// and each varying/w as value at the anchor, d/dx, d/dy per pixel. The anchor is the corner of the
// box of pixels that the triangle touches where 1/w is smallest, because float planes are most
// exact near their anchor and the far end of a receding surface needs that most.
enum {
    DIP_PLANES_ANCHOR = 0,
    DIP_PLANES_RW = 2,
    DIP_PLANES_VARYINGS = 5,
};

static inline int dip_plane_floats(int varying_count) {
    return DIP_PLANES_VARYINGS + 3 * varying_count;
}

enum { DIP_PLANES_ALIGN = 8 }; // floats; set-up writes so many at once

// From one triangle's planes to the next.
static inline int dip_plane_stride(int varying_count) {
    return (dip_plane_floats(varying_count) + DIP_PLANES_ALIGN - 1) / DIP_PLANES_ALIGN *
           DIP_PLANES_ALIGN;
}

#endif
