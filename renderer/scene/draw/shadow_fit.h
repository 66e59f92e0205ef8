// Fits the shadow map to what a frame shows: finds the rectangle across the light that holds all
// shadows in view. Private to the renderer.
#ifndef DIP_RENDERER_SCENE_DRAW_SHADOW_FIT_H
#define DIP_RENDERER_SCENE_DRAW_SHADOW_FIT_H

#include "renderer/pipeline/cull.h"
#include "renderer/scene/scene.h"
#include "renderer/scene/view/view.h"

// Where the shadow map lies. A point p of the world has the coordinates dot(axis[i], p) along the
// axes of the light: 0 to the right and 1 upwards in the map, and 2 towards the light.
typedef struct DipShadowFit {
    double axis[3][3]; // unit vectors
    double low[3];   // left edge, lower edge, and the place of depth 0, the farthest from the light
    double texel[2]; // width and height of a texel, in metres
    double range;    // metres from depth 0 to depth 1
    int size;        // texels along each side of the map
} DipShadowFit;

// A view whose shadows the map must hold.
typedef struct DipShadowView {
    const DipView *view;
    const DipCullPlanes *seen;
} DipShadowView;

// Fits the map of a scene that has a light for it (DipSceneLighting.shadow_light). The fit depends
// on nothing but its arguments. Texels have one of four sizes for each power of two, and the edges
// of the map lie on multiples of them, so while a camera moves, shadows keep their texels: the map
// moves by whole ones. Without receivers in view, the fit holds the whole scene.
DipShadowFit dip_shadow_fit(const DipScene *scene, const DipShadowView *views, int view_count,
                            int size);

#endif
