// Depth and stencil values that outlive a pass: a pass may start from them, leave its own there,
// and later passes' shaders may read them, for example as a shadow map.
#ifndef DIP_RENDERER_PIPELINE_DEPTH_H
#define DIP_RENDERER_PIPELINE_DEPTH_H

#include "renderer/base/api.h"
#include "renderer/base/error.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// A depth and a stencil value for each sample. Only one pass at a time may draw to it; any number
// of threads may read it while no pass draws to it.
typedef struct DipDepth DipDepth;

// Creates depths that are all 0 (infinitely far) and stencil values that are all 0. width, height:
// 1..DIP_MAX_TARGET_SIZE. sample_count: 1, 2, 4, 6 or 8. It takes 5 bytes per sample. Fails with
// RANGE or MEMORY.
DIP_API DipDepth *dip_depth_create(int width, int height, int sample_count, DipError *err);
// Frees depths that no pass uses any more. *depth may be NULL and becomes NULL.
DIP_API void dip_depth_destroy(DipDepth **depth);

// Makes `copy` hold the depths and stencil values of `depth`. Fails with CONFLICT if the two differ
// in size or number of samples; the copy is then unchanged. No pass may draw to either of them
// during the call.
DIP_API bool dip_depth_copy(DipDepth *copy, const DipDepth *depth, DipError *err);

DIP_API int dip_depth_width(const DipDepth *depth);
DIP_API int dip_depth_height(const DipDepth *depth);
DIP_API int dip_depth_sample_count(const DipDepth *depth);

// Returns `width` depths of one row of pixels, z / w of the nearest surface in each pixel's sample
// `sample`; 0 is infinitely far and 1 is the near plane. The caller may change them between passes.
// Row 0 is the top one.
DIP_API float *dip_depth_row(DipDepth *depth, int sample, int y);
DIP_API uint8_t *dip_stencil_row(DipDepth *depth, int sample, int y);

// How a shader compares with stored depths. A read compares with texels whose middles lie up to 1,
// 1/2 or 3/2 texels away along each axis. So that surfaces do not shade themselves, the map is
// drawn with a depth bias (state.h) that moves them away from the light by their rise over this
// distance along both axes: the slope that stands beside each filter.
typedef enum DipShadowFilter {
    DIP_SHADOW_LINEAR,  // the bilinear mean of four comparisons; slope -2
    DIP_SHADOW_NEAREST, // one comparison; slope -1
    DIP_SHADOW_WIDE,    // the mean of nine comparisons over a square of 2x2 texels; slope -3
} DipShadowFilter;

// Depths that a shader compares with, usually a light's (DipSampleShadow in shader.h). Only sample
// 0 of each pixel is read, so shadow maps are best drawn with one sample per pixel.
typedef struct DipShadowMap {
    const DipDepth *depth;
    DipShadowFilter filter;
} DipShadowMap;

#ifdef __cplusplus
}
#endif

#endif
