// Adds surfaces that the program makes itself, such as the ground below a model, to scenes of
// models.
#ifndef DIP_APP_SESSION_ADDED_SURFACE_H
#define DIP_APP_SESSION_ADDED_SURFACE_H

#include "renderer/base/error.h"
#include "renderer/scene/scene.h"

#include <stdint.h>

// A scene with an added surface. Owns the surface and the arrays of `def`. Everything else that
// these arrays point to belongs to the scene without the surface.
typedef struct DipAddedSurface {
    DipSceneDef def;
    uint8_t *rgba8;    // The texture of the surface.
    float *positions;  // Three coordinates for each vertex.
    float *uv;         // Two texture coordinates for each vertex.
    uint32_t *indices; // Three for each triangle.
} DipAddedSurface;

// Copies the description of a scene, and appends a texture, an opaque material, a mesh of this
// material, and an object that shows the mesh without moving it. The surface has the texture's
// colour times `colour_lin`; no light falls on it. The material and the object get the name of the
// mesh. `texture` and `mesh` give names, sizes and numbers; the arrays that they point to are made
// here, and the caller fills them in. Returns NULL and fills *err with DIP_ERROR_MEMORY and the
// mesh's name when memory runs out. The scene must outlive the result.
DipAddedSurface *dip_added_surface_create(const DipSceneDef *def, const DipTextureDef *texture,
                                          const float colour_lin[3], const DipMeshDef *mesh,
                                          DipError *err);

// *surface may be NULL and becomes NULL.
void dip_added_surface_destroy(DipAddedSurface **surface);

#endif
