// The memory of a DipDepth (pipeline/depth.h).
#ifndef DIP_RENDERER_PIPELINE_MERGE_DEPTH_PLANES_H
#define DIP_RENDERER_PIPELINE_MERGE_DEPTH_PLANES_H

#include "renderer/pipeline/depth.h"

#include <stddef.h>

struct DipDepth {
    int width;
    int height;
    int sample_count;
    float *depth; // [sample][row][column]
    uint8_t *stencil;
};

// Returns the index of the first value of one row of a sample.
static inline size_t dip_depth_row_index(const DipDepth *depth, int sample, int y) {
    return ((size_t)sample * (size_t)depth->height + (size_t)y) * (size_t)depth->width;
}

#endif
