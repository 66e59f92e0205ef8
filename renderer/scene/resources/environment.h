// Blurs an environment for the shader of metallic-roughness surfaces. Private to the renderer.
#ifndef DIP_RENDERER_SCENE_RESOURCES_ENVIRONMENT_H
#define DIP_RENDERER_SCENE_RESOURCES_ENVIRONMENT_H

#include "renderer/base/pool.h"
#include "renderer/scene/lights.h"
#include "renderer/scene/materials/environment.h"

// Makes the map of an environment, which must be valid, on the pool. It is the same on every
// machine and for every number of threads. Returns NULL if memory runs out. The caller frees it
// with free().
DipEnvironmentMap *dip_environment_map_create(const DipEnvironmentDef *def, DipPool *pool);

#endif
