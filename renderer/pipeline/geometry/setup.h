// Triangle set-up: projected vertices to DipTriangles with their shading planes.
#ifndef DIP_RENDERER_PIPELINE_GEOMETRY_SETUP_H
#define DIP_RENDERER_PIPELINE_GEOMETRY_SETUP_H

#include "renderer/pipeline/geometry/project.h"
#include "renderer/pipeline/geometry/triangle.h"
#include "renderer/pipeline/pattern.h"
#include "renderer/pipeline/pipeline.h"

#include <stdint.h>

enum {
    DIP_SETUP_BATCH = 128, // triangles
    // Beyond the triangles that stay, up to this many may be overwritten with nothing of use.
    DIP_SETUP_EXCESS = 8,
};

// The sample positions of one or several passes, in 1/256 pixel from the pixel's top left corner.
typedef struct DipSamplePositions {
    int count;
    uint8_t x[DIP_MAX_PASSES_AT_ONCE * DIP_MAX_SAMPLES];
    uint8_t y[DIP_MAX_PASSES_AT_ONCE * DIP_MAX_SAMPLES];
} DipSamplePositions;

// Adds the positions of a pattern; there is room for those of DIP_MAX_PASSES_AT_ONCE patterns.
static inline void dip_sample_positions_add(DipSamplePositions *positions,
                                            const DipSamplePattern *pattern) {
    for (int s = 0; s < pattern->count; s++) {
        positions->x[positions->count] = pattern->x[s];
        positions->y[positions->count++] = pattern->y[s];
    }
}

typedef struct DipSetupTarget {
    int width; // pixels
    int height;
    int region_first[2]; // pixels x, y: triangles without a pixel in this part of the target go
    int region_last[2];  // inclusive
    int varying_count;
    int plane_stride; // floats per triangle, see dip_plane_stride
    uint32_t draw;
    uint32_t first_patch; // the number of the draw's patch 0
    DipCull cull;
    const DipSamplePositions *samples;
    uint8_t sample_min[2]; // least and greatest of their positions, 1/256 pixel
    uint8_t sample_max[2];
} DipSetupTarget;

// Triangles of one draw. Arrays of corners and patches may be read to the next multiple of
// DIP_BATCH_ALIGN and hold valid vertices there.
typedef struct DipSetupBatch {
    int count;                // 1..DIP_SETUP_BATCH
    const uint8_t *corner[3]; // of triangle t: vertices corner[0..2][t] of `screen`
    const uint32_t *patch;    // of triangle t, of the draw's
    const DipScreenBatch *screen;
    const float *varyings; // varying s of vertex v: varyings[s * varying_stride + v]
    int varying_stride;
} DipSetupBatch;

// dip_kernel_setup (see kernels.h) keeps, in order, the triangles that are not culled, have an area
// and, as far as that is quickly seen, do not lie between the samples; it returns their number.
// Triangle i of these goes to triangles[i], its planes to planes + i * plane_stride.

#endif
