// Adds a ground to models that stand in empty space. The ground is a plain square below the model,
// in the colour of the background. A soft shade on the ground shows where the model touches the
// ground or comes near it.
#ifndef DIP_APP_SESSION_GROUND_H
#define DIP_APP_SESSION_GROUND_H

#include "app/session/added_surface.h"
#include "renderer/base/error.h"
#include "renderer/scene/scene.h"

#include <stdbool.h>

// The extent of a scene's objects that are not sky, over DIP_MOTION_MOMENTS moments of the clips
// (animations) that play. If the boxes of all moving meshes are known, each moving mesh counts as
// its box, which holds the mesh at all moments, so the extent may be larger than needed.
typedef struct DipExtent {
    double low[3]; // All 0 if the scene has no such object with a triangle.
    double high[3];
} DipExtent;

DipExtent dip_extent_of(const DipSceneDef *def);

// The silhouette that a camera sees on an orbit about the middle of a scene's extent. The scene's
// height is divided into slices. A slice holds the greatest distance of its vertices from the
// vertical axis through that middle, over the same moments as the extent, or -1 if the slice has no
// vertex.
enum { DIP_SILHOUETTE_SLICES = 64 };
typedef struct DipSilhouette {
    double radius[DIP_SILHOUETTE_SLICES]; // From the lowest slice to the highest.
} DipSilhouette;

DipSilhouette dip_silhouette_of(const DipSceneDef *def, const DipExtent *extent);

// Returns whether the scene needs a ground. It needs none if it has no width, if it has a sky or
// water, or if it is flat itself. Nor does it need one if, seen from above, surfaces that face up
// near its lowest point cover most of its extent. It also gets none if it lies very far above or
// below the origin, or if memory runs out.
bool dip_ground_is_missing(const DipSceneDef *def, const DipExtent *extent);

// Adds a ground to a scene. The shade, which is the ground's texture, is that of the scene at the
// start of its clips. Returns NULL and fills *err with DIP_ERROR_MEMORY when memory runs out. The
// scene must outlive the ground.
DipAddedSurface *dip_ground_create(const DipSceneDef *def, const DipExtent *extent, DipError *err);

#endif
