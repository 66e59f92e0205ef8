// Geometry instancing: objects that share a mesh, or (gi=off) each with a copy of its own.
#ifndef DIP_RENDERER_SCENE_RESOURCES_INSTANCING_H
#define DIP_RENDERER_SCENE_RESOURCES_INSTANCING_H

#include "renderer/pipeline/mesh.h"
#include "renderer/scene/frame.h"
#include "renderer/scene/scene.h"

// A mesh for every object of a scene. The first object of a mesh keeps the scene's.
typedef struct DipExpanded DipExpanded;

// On the pool (may be NULL). To be destroyed at any time, even after the scene.
DipExpanded *dip_expanded_create(const DipScene *scene, DipPool *pool, DipError *err);
void dip_expanded_destroy(DipExpanded **expanded);

const DipMesh *dip_expanded_mesh(const DipExpanded *expanded, int object);

// Fills in the counters of geometry that the objects draw from: NULL, the scene's own meshes.
void dip_count_geometry(const DipScene *scene, const DipExpanded *expanded, DipCounters *counters);

#endif
