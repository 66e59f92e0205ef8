// What follows from an object's transform alone. It is computed once, when the scene is made.
#ifndef DIP_RENDERER_SCENE_RESOURCES_PLACEMENT_H
#define DIP_RENDERER_SCENE_RESOURCES_PLACEMENT_H

#include "renderer/scene/resources/scene_layout.h"

// Sets the object's transform and the members that follow from it: normal_to_world, mirrors and
// world_to_object.
void dip_scene_object_place(DipSceneObject *object, const float transform[12]);

#endif
