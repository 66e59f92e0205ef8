// Adds surfaces of the program to scenes of models, such as the ground below a model. Each addition
// makes a scene of its own, which borrows everything else from the scene that it adds to.
#ifndef DIP_APP_SESSION_ADDED_SURFACE_H
#define DIP_APP_SESSION_ADDED_SURFACE_H

#include "renderer/scene/scene.h"

#include <stdbool.h>

// Copies a description. The copy owns its arrays of textures, materials, meshes and objects, which
// have room for one more item. Returns false when memory runs out. The caller must free the copy in
// either case.
bool dip_scene_def_begin_surface(const DipSceneDef *def, DipSceneDef *copy);

// Appends a texture, an opaque material of a colour that no light falls on and that shows the
// texture, and a mesh of this material, as one object that stands where the mesh says. The mesh has
// the name of all. Everything is borrowed.
void dip_scene_def_add_surface(DipSceneDef *copy, const DipTextureDef *texture,
                               const float colour_lin[3], const DipMeshDef *mesh);

// Frees the arrays of a copy.
void dip_scene_def_free_surface(DipSceneDef *copy);

#endif
