// The reflection in a scene's water: one mirror plane and one picture of the mirrored scene.
#ifndef DIP_RENDERER_SCENE_REFLECTION_H
#define DIP_RENDERER_SCENE_REFLECTION_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

// All of a scene's water (DIP_SURFACE_WATER) is treated as horizontal and shows the same picture:
// the scene mirrored at one height, even if a pool lies at another height.
typedef struct DipReflectionDef {
    int width;      // width of the mirrored picture, in pixels; 0: water does not reflect
    int height;     // height of the mirrored picture, in pixels; both are 1..DIP_MAX_FRAME_SIZE
    double level_m; // world y at which the scene is mirrored
    bool schlick;   // true: Fresnel term by Schlick's approximation; false: exact
    bool show;      // true: the frame's top left corner shows the mirrored picture
} DipReflectionDef;

// Refractive index of water, for the Fresnel term.
#define DIP_WATER_INDEX 1.333

#ifdef __cplusplus
}
#endif

#endif
