// The lights of a scene, kept in a form that draws can use. Private to the renderer.
#ifndef DIP_RENDERER_SCENE_RESOURCES_LIGHTING_H
#define DIP_RENDERER_SCENE_RESOURCES_LIGHTING_H

#include "renderer/pipeline/mesh.h"
#include "renderer/scene/lights.h"
#include "renderer/scene/materials/surface.h"

#include <stdbool.h>

// A copy of a DipLightingDef.
typedef struct DipSceneLighting {
    float ambient_lin[3];
    float sky_lin[3];
    DipShading shading;
    int shadow_light; // index of the light that can cast shadows, or -1
    int count;
    DipLightDef lights[DIP_MAX_LIGHTS]; // without their names
} DipSceneLighting;

// Copies a description that dip_scene_check has accepted. Returns NULL when memory runs out. The
// caller frees the copy with free().
DipSceneLighting *dip_scene_lighting_create(const DipLightingDef *def);

// Writes the unit vector against a light's direction. The direction is scaled first, so that no
// square overflows or vanishes.
void dip_lighting_reverse(const float direction[3], double reversed[3]);

// Computes the lights as an eye in world space sees them.
void dip_lighting_at(const DipSceneLighting *lighting, const double eye[3],
                     DipLightingUniforms *uniforms);

// Returns the lights that may reach a box in world space; bit i stands for light i. The others are
// so far away that their light is exactly 0 everywhere in the box.
uint64_t dip_lights_reaching(const DipSceneLighting *lighting, const DipBox *box);

#endif
