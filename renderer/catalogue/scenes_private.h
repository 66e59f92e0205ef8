// Declares the function that scenes.c and scene_kinds.c share.
#ifndef DIP_RENDERER_CATALOGUE_SCENES_PRIVATE_H
#define DIP_RENDERER_CATALOGUE_SCENES_PRIVATE_H

#include "renderer/catalogue/scenes.h"

// Adds a plane 1 m below the origin that reaches 195 m ahead. The texture repeats every metre.
void dip_test_scene_add_ground(DipTestScene *scene, int material);

#endif
