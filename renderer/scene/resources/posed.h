// A scene at one time of its motion. A scene never changes, so a renderer that draws a moving scene
// keeps a posed scene of its own: a copy of what moves, and the rest shared.
#ifndef DIP_RENDERER_SCENE_RESOURCES_POSED_H
#define DIP_RENDERER_SCENE_RESOURCES_POSED_H

#include "renderer/base/pool.h"
#include "renderer/scene/scene.h"

struct DipMotionDef;

// Returns the index of the moving mesh that is mesh number `mesh` of the scene, or -1. motion may
// be NULL.
int dip_moving_mesh(const struct DipMotionDef *motion, int mesh);

typedef struct DipPosedScene DipPosedScene;

// Makes a posed scene of a scene that has a motion. The scene is borrowed; it may be destroyed
// before the posed scene is. Fails with MEMORY.
DipPosedScene *dip_posed_scene_create(const DipScene *scene, DipError *err);
// *posed may be NULL and becomes NULL.
void dip_posed_scene_destroy(DipPosedScene **posed);

// Returns the scene at a time. It belongs to the posed scene and changes with the next call. The
// vertices are computed on the pool, even if the scene is at this time already, so that a frame
// costs the same whatever was drawn before it. Allocates nothing.
const DipScene *dip_posed_scene_at(DipPosedScene *posed, int64_t time_ns, DipPool *pool);

#endif
