// Triangle set-up: turns projected vertices into DipTriangles with their shading planes.
#ifndef DIP_RENDERER_PIPELINE_GEOMETRY_SETUP_H
#define DIP_RENDERER_PIPELINE_GEOMETRY_SETUP_H

#include "renderer/pipeline/geometry/project.h"
#include "renderer/pipeline/raster/triangle.h"
#include "renderer/pipeline/pattern.h"
#include "renderer/pipeline/pipeline.h"

#include <stdint.h>

enum {
    DIP_SETUP_BATCH = 128, // most triangles of a batch
    // Set-up may overwrite the space of this many triangles after the triangles that it keeps.
    DIP_SETUP_EXCESS = 8,
};

// The sample positions of one or several passes, in 1/256 pixel from the pixel's top left corner.
typedef struct DipSamplePositions {
    int count;
    uint8_t x[DIP_MAX_PASSES_AT_ONCE * DIP_MAX_SAMPLES];
    uint8_t y[DIP_MAX_PASSES_AT_ONCE * DIP_MAX_SAMPLES];
} DipSamplePositions;

// Adds the positions of a pattern. There is space for DIP_MAX_PASSES_AT_ONCE patterns.
static inline void dip_sample_positions_add(DipSamplePositions *positions,
                                            const DipSamplePattern *pattern) {
    for (int s = 0; s < pattern->count; s++) {
        positions->x[positions->count] = pattern->x[s];
        positions->y[positions->count++] = pattern->y[s];
    }
}

// The target of set-up, and the draw that the triangles belong to.
typedef struct DipSetupTarget {
    int width; // size of the target in pixels
    int height;
    int region_first[2]; // x and y of the region's first pixel; triangles outside the region are
                         // dropped
    int region_last[2];  // x and y of the region's last pixel
    int varying_count;
    uint32_t repeating_varyings; // see DipDraw
    int plane_stride;            // floats per triangle, see dip_plane_stride
    uint32_t draw;
    uint32_t first_patch; // number of patch 0 of the draw's mesh
    uint32_t front_flag;  // added to the patch of front faces; 0 unless the draw is ordered
    DipCull cull;
    const DipSamplePositions *samples;
    uint8_t sample_min[2]; // smallest x and y of the sample positions, 1/256 pixel
    uint8_t sample_max[2]; // greatest x and y of the sample positions, 1/256 pixel
} DipSetupTarget;

// Triangles of one draw. The arrays of corners and patches can be read up to the next multiple of
// DIP_BATCH_ALIGN. The padding of the corners consists of valid vertices.
typedef struct DipSetupBatch {
    int count;                // 1..DIP_SETUP_BATCH
    const uint8_t *corner[3]; // triangle t has the vertices corner[0..2][t] of `screen`
    const uint32_t *patch;    // patch[t]: patch of triangle t in the numbering of the draw's mesh
    const DipScreenBatch *screen;
    const float *varyings; // varying s of vertex v is varyings[s * varying_stride + v]
    int varying_stride;
} DipSetupBatch;

// dip_kernel_setup (kernels.h) sets up the triangles of a batch. It drops triangles that are
// culled, have no area, or lie outside the region. It also drops triangles that cover no sample, if
// a quick test can tell. It keeps the other triangles in order and returns their number. The i-th
// kept triangle goes to triangles[i], and its planes go to planes + i * plane_stride.

#endif
