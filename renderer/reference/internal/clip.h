// Private to the reference renderer: vertices before the division by w, and how triangles are cut
// at the planes that docs/picture.md, "Camera", lists.
#ifndef DIP_RENDERER_REFERENCE_INTERNAL_CLIP_H
#define DIP_RENDERER_REFERENCE_INTERNAL_CLIP_H

#include "renderer/reference/internal/internal.h"
#include "renderer/reference/internal/wide.h"

// A vertex before the division by w. Its numbers are wide because the visible part of a triangle
// may be 2^-50 times as large as the triangle.
typedef struct DipRefClipVertex {
    DipWide x; // in clip space
    DipWide y;
    DipWide w;     // distance along the view axis, in metres
    DipWide above; // signed height above the plane that cuts a mirrored scene; 0 in other scenes
    DipWide varyings[DIP_REF_VARYINGS];
} DipRefClipVertex;

// The planes that cut triangles: near, four of the guard band, and the level of a mirrored scene.
// In clip space, the guard band is -left w <= x <= right w and -bottom w <= y <= top w.
typedef struct DipRefClipPlanes {
    double near_m;
    double left, right, top, bottom;
    bool mirrored;
} DipRefClipPlanes;

enum { DIP_REF_MAX_CORNERS = 3 + 6 }; // each plane adds at most one corner

// Returns the planes of a shot.
DipRefClipPlanes dip_reference_clip_planes(const DipReference *reference, const DipRefShot *shot);

// Returns false if a triangle clearly lies inside all planes. dip_reference_clip would then change
// nothing.
bool dip_reference_needs_clip(const DipRefClipPlanes *planes,
                              const DipRefClipVertex *const corners[3]);

// Cuts a triangle at the planes. Returns the number of corners that are left: 0, or 3 to
// DIP_REF_MAX_CORNERS.
int dip_reference_clip(const DipRefClipPlanes *planes, const DipRefClipVertex *const corners[3],
                       DipRefClipVertex polygon[DIP_REF_MAX_CORNERS]);

#endif
