// Water as a client of the pipeline: the uniforms of its fragment shader. Its vertex shader is the
// surfaces'.
#ifndef DIP_RENDERER_SCENE_MATERIALS_WATER_H
#define DIP_RENDERER_SCENE_MATERIALS_WATER_H

#include "renderer/pipeline/pipeline.h"
#include "renderer/scene/materials/surface.h"

#include <stdbool.h>

// All pools are horizontal, so how much each pixel reflects follows from its view ray.
typedef struct DipWaterUniforms {
    DipSurfaceUniforms surface; // first: the water's own colour is shaded from it
    const DipTarget *mirrored;
    float inverse_size[2]; // 1 / width, 1 / height of the picture that the water is in
    bool schlick;
} DipWaterUniforms;

#endif
