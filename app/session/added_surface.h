// Adds surfaces that the program makes itself, such as the ground below a model, to scenes of
// models. Each addition makes a description of a scene (DipSceneDef) of its own, which borrows all
// other data from the description without the surface.
#ifndef DIP_APP_SESSION_ADDED_SURFACE_H
#define DIP_APP_SESSION_ADDED_SURFACE_H

#include "renderer/scene/scene.h"

#include <stdbool.h>

// Copies a description. The copy owns its arrays of textures, materials, meshes and objects, each
// of which has room for one more item. Returns false when memory runs out. The caller must free the
// copy in either case.
bool dip_scene_def_begin_surface(const DipSceneDef *def, DipSceneDef *copy);

// Appends a texture, an opaque material, a mesh of this material, and an object that shows the mesh
// without moving it. The surface has the texture's colour times `colour_lin`; no light falls on it.
// The material and the object get the name of the mesh. The arguments are copied, and what they
// point to is borrowed.
void dip_scene_def_add_surface(DipSceneDef *copy, const DipTextureDef *texture,
                               const float colour_lin[3], const DipMeshDef *mesh);

// Frees the arrays of a copy.
void dip_scene_def_free_surface(DipSceneDef *copy);

#endif
