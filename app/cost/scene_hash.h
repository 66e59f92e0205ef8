// A hash of a scene's content. The cache of truths (converged pictures) finds a scene's truths by
// it.
#ifndef DIP_APP_COST_SCENE_HASH_H
#define DIP_APP_COST_SCENE_HASH_H

#include "renderer/scene/reflection.h"
#include "renderer/scene/scene.h"

// Writes 32 hexadecimal digits that depend on everything that decides how the scene looks.
void dip_cost_scene_hash(const DipSceneDef *def, const DipReflectionDef *reflection, char hex[33]);

#endif
