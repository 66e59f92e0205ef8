// Geometry instancing: objects that share a mesh, or (gi=off) each with a copy of its own.
#ifndef DIP_RENDERER_SCENE_RESOURCES_INSTANCING_H
#define DIP_RENDERER_SCENE_RESOURCES_INSTANCING_H

#include "renderer/pipeline/mesh.h"
#include "renderer/scene/frame.h"
#include "renderer/scene/scene.h"

// A mesh for every object of a scene. The first object of a mesh keeps the scene's.
typedef struct DipUnsharedMeshes DipUnsharedMeshes;

// On the pool (may be NULL). To be destroyed at any time, even after the scene.
DipUnsharedMeshes *dip_unshared_meshes_create(const DipScene *scene, DipPool *pool, DipError *err);
void dip_unshared_meshes_destroy(DipUnsharedMeshes **unshared);

const DipMesh *dip_unshared_mesh(const DipUnsharedMeshes *unshared, int object);

// Fills in the counters of geometry that the objects draw from: NULL, the scene's own meshes.
void dip_count_geometry(const DipScene *scene, const DipUnsharedMeshes *unshared,
                        DipCounters *counters);

#endif
