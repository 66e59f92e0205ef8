// A hash of a scene's content. The cache of truths (converged pictures) uses this hash to find the
// truths of a scene.
#ifndef DIP_APP_COST_SCENE_HASH_H
#define DIP_APP_COST_SCENE_HASH_H

#include "renderer/scene/reflection.h"
#include "renderer/scene/scene.h"

// Writes the hash as 32 hexadecimal digits. It depends on everything that affects how the scene
// looks.
void dip_cost_scene_hash(const DipSceneDef *def, const DipReflectionDef *reflection, char hex[33]);

#endif
