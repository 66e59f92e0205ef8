// A name for a scene's content, under which its truths are kept.
#ifndef DIP_APP_COST_SCENE_HASH_H
#define DIP_APP_COST_SCENE_HASH_H

#include "renderer/scene/reflection.h"
#include "renderer/scene/scene.h"

void dip_cost_scene_hash(const DipSceneDef *def, const DipReflectionDef *reflection, char hex[33]);

#endif
