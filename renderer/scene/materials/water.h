// The uniforms of the water's fragment shader. Water has the vertex shader of plain surfaces.
#ifndef DIP_RENDERER_SCENE_MATERIALS_WATER_H
#define DIP_RENDERER_SCENE_MATERIALS_WATER_H

#include "renderer/pipeline/pipeline.h"
#include "renderer/scene/materials/surface.h"

#include <stdbool.h>

// All water is treated as horizontal, so a fragment's view ray alone determines how much the water
// reflects.
typedef struct DipWaterUniforms {
    // Must be first: the surface shader reads it to compute the water's own colour.
    DipSurfaceUniforms surface;
    const DipTarget *mirrored; // the picture of the mirrored scene
    float inverse_size[2];     // 1 / width and 1 / height of the target that the water is drawn to
    bool schlick;              // see DipReflectionDef
} DipWaterUniforms;

#endif
