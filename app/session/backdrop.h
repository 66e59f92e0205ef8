// Shows an environment behind a scene, on a sphere around the scene. The sphere is so large that
// its points look infinitely far away.
#ifndef DIP_APP_SESSION_BACKDROP_H
#define DIP_APP_SESSION_BACKDROP_H

#include "app/session/ground.h"
// Adds a sphere that shows the scene's environment; the scene must have one. `extent` is the extent
// of the scene's objects. The sphere's middle is the middle of the extent, and the sphere's radius
// is proportional to the size of the extent. The sphere's texture is the environment, cut off at 1
// and encoded as sRGB, and its triangles face the sphere's middle. Returns NULL and fills *err with
// DIP_ERROR_MEMORY when memory runs out. The scene must outlive the backdrop.
DipAddedSurface *dip_backdrop_create(const DipSceneDef *def, const DipExtent *extent,
                                     DipError *err);

#endif
