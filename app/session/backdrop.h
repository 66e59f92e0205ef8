// Shows an environment behind a scene, on a sphere around the scene. The sphere is so large that
// its points look infinitely far away.
#ifndef DIP_APP_SESSION_BACKDROP_H
#define DIP_APP_SESSION_BACKDROP_H

#include "app/session/ground.h"
#include "renderer/base/error.h"
#include "renderer/scene/scene.h"

#include <stdint.h>

// A scene with a backdrop. Owns the sphere and the arrays of `def`. Everything else that these
// arrays point to belongs to the scene without the backdrop.
typedef struct DipBackdrop {
    DipSceneDef def;
    uint8_t *rgba8;    // The environment, cut off at 1 and encoded as sRGB.
    float *positions;  // 3 coordinates for each vertex, then 2 texture coordinates for each vertex.
    uint32_t *indices; // Three for each triangle. The triangles face the sphere's middle.
} DipBackdrop;

// Adds a sphere that shows the scene's environment; the scene must have one. `extent` is the extent
// of the scene's objects. The sphere's middle is the middle of the extent, and the sphere's radius
// is proportional to the size of the extent. Returns NULL and fills *err with DIP_ERROR_MEMORY when
// memory runs out. The scene must outlive the backdrop.
DipBackdrop *dip_backdrop_create(const DipSceneDef *def, const DipExtent *extent, DipError *err);
// *backdrop may be NULL and becomes NULL.
void dip_backdrop_destroy(DipBackdrop **backdrop);

#endif
