// Geometry instancing. With gi=on objects share meshes; with gi=off each object has its own copy.
#ifndef DIP_RENDERER_SCENE_RESOURCES_INSTANCING_H
#define DIP_RENDERER_SCENE_RESOURCES_INSTANCING_H

#include "renderer/pipeline/mesh.h"
#include "renderer/scene/frame.h"
#include "renderer/scene/scene.h"

// A mesh for every object of a scene. The first object that uses a mesh keeps the scene's mesh;
// every other object has a copy.
typedef struct DipUnsharedMeshes DipUnsharedMeshes;

// Copies the meshes on the pool, or on the caller's thread if pool is NULL. Fails with
// DIP_ERROR_MEMORY. The copies may be destroyed at any time, even after the scene is destroyed.
DipUnsharedMeshes *dip_unshared_meshes_create(const DipScene *scene, DipPool *pool, DipError *err);
void dip_unshared_meshes_destroy(DipUnsharedMeshes **unshared);

// Returns the mesh that an object draws. The scene must still exist.
const DipMesh *dip_unshared_mesh(const DipUnsharedMeshes *unshared, const DipScene *scene,
                                 int object);

// Fills in the counters `meshes` and `geometry_bytes`. unshared: NULL if objects share the scene's
// meshes.
void dip_count_geometry(const DipScene *scene, const DipUnsharedMeshes *unshared,
                        DipCounters *counters);

#endif
