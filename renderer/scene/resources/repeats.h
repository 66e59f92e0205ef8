// Finds the texture coordinates of a mesh that the pipeline may reduce by whole numbers.
#ifndef DIP_RENDERER_SCENE_RESOURCES_REPEATS_H
#define DIP_RENDERER_SCENE_RESOURCES_REPEATS_H

#include "renderer/scene/resources/scene_layout.h"

// Returns the mesh's DipDraw.repeating_varyings. Only coordinates that are large enough to lose
// precision are declared, so that other meshes cost nothing more. The mesh must have been laid out.
uint32_t dip_scene_repeating_varyings(const DipSceneDef *def, const DipMeshDef *mesh,
                                      const DipSceneMesh *laid_out);

// Sets full_layout.coordinate_bounds of a normal-mapped mesh that has been laid out.
void dip_scene_bound_coordinates(const DipSceneDef *def, const DipMeshDef *mesh,
                                 DipSceneMesh *laid_out);

#endif
