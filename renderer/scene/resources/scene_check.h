// Checks the description of a scene before a scene is made from it.
#ifndef DIP_RENDERER_SCENE_RESOURCES_SCENE_CHECK_H
#define DIP_RENDERER_SCENE_RESOURCES_SCENE_CHECK_H

#include "renderer/scene/scene.h"

// Returns false and fills in *err if an index is out of range or a number is not acceptable.
// The positions and the indices of vertices are checked when the meshes are made.
bool dip_scene_check(const DipSceneDef *def, DipError *err);

#endif
