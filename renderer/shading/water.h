// Water as a client of the pipeline: the uniforms of its fragment shader. Its vertex shader is the
// surfaces'.
#ifndef DIP_RENDERER_SHADING_WATER_H
#define DIP_RENDERER_SHADING_WATER_H

#include "renderer/pipeline.h"
#include "renderer/shading/surface.h"

// All pools are horizontal, so how much each pixel reflects follows from its place on the screen.
typedef struct DipWaterUniforms {
    DipSurfaceUniforms surface; // first: the water's own colour is shaded from it
    const DipTarget *mirrored;
    float inverse_size[2]; // 1 / width, 1 / height of the picture that the water is in
    // The direction from the eye through pixel place (x, y) in camera space, (a, b, -1), and how
    // far it goes down: values at the top left corner, per pixel along x, along y.
    float a[2]; // at 0, per pixel in x
    float b[2]; // at 0, per pixel in y
    float down[3];
    bool schlick;
} DipWaterUniforms;

#endif
