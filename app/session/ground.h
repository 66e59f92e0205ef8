// Adds a ground to models that stand in empty space. It is a plain square below the model, in the
// colour of the background, with the soft shade that the model would leave where it touches the
// ground.
#ifndef DIP_APP_SESSION_GROUND_H
#define DIP_APP_SESSION_GROUND_H

#include "renderer/base/error.h"
#include "renderer/scene/scene.h"

#include <stdbool.h>

// The extent of a scene's objects that are not sky, over all moments of the clips (animations) that
// play.
typedef struct DipExtent {
    double low[3]; // All 0 if the scene has no such object with a triangle.
    double high[3];
} DipExtent;

DipExtent dip_extent_of(const DipSceneDef *def);

// The silhouette of a scene as an orbit about the middle of its extent sees it: the height is
// divided into slices, and each slice has the greatest distance of its vertices from the vertical
// axis through the middle, or -1 if it has no vertex. If clips play, it is the greatest distance at
// any moment.
enum { DIP_SILHOUETTE_SLICES = 64 };
typedef struct DipSilhouette {
    double radius[DIP_SILHOUETTE_SLICES]; // From the lowest slice to the highest.
} DipSilhouette;

DipSilhouette dip_silhouette_of(const DipSceneDef *def, const DipExtent *extent);

// Returns whether a ground would help: the scene has a size, but neither sky nor water, is not flat
// itself, and has no surface of its own that faces up and covers most of what lies below it.
bool dip_ground_is_missing(const DipSceneDef *def, const DipExtent *extent);

// A scene with a ground. Owns the ground and the arrays of the def; everything else in them belongs
// to the scene without the ground.
typedef struct DipGround {
    DipSceneDef def;
    uint8_t *shade_rgba8;
    float positions[4][3];
    float uv[4][2];
} DipGround;

// Adds a ground to a scene. The shade is that of the scene at the start of its clips. Returns NULL
// and fills *err with DIP_ERROR_MEMORY when memory runs out. The scene must outlive the ground.
DipGround *dip_ground_create(const DipSceneDef *def, const DipExtent *extent, DipError *err);
// *ground may be NULL and becomes NULL.
void dip_ground_destroy(DipGround **ground);

#endif
