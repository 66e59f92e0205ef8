// Triangle set-up: three projected vertices to a DipTriangle with its shading planes.
#ifndef DIP_RENDERER_GEOMETRY_SETUP_H
#define DIP_RENDERER_GEOMETRY_SETUP_H

#include "renderer/geometry/triangle.h"
#include "renderer/pipeline.h"
#include "renderer/raster/pattern.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct DipScreenVertex {
    int32_t x; // 1/256 pixel
    int32_t y;
    float z;
    float rw;
    const float *slot; // slot s is slot[s * slot_stride]
} DipScreenVertex;

typedef struct DipSetupTarget {
    int width; // pixels
    int height;
    int slot_count;
    int slot_stride; // between the slots of a vertex, floats
    DipCull cull;
    uint8_t sample_min[2]; // least and greatest sample position of the pattern, 1/256 pixel
    uint8_t sample_max[2];
} DipSetupTarget;

// Fills *triangle (but for draw and surface) and surface[]; false when the triangle is culled, has
// no area or lies between the samples.
bool dip_setup_triangle(const DipSetupTarget *target, const DipScreenVertex vertex[3],
                        DipTriangle *triangle, float *surface);

#endif
