// The reflection in a scene's water: one plane, one picture of the mirrored scene.
#ifndef DIP_RENDERER_SCENE_REFLECTION_H
#define DIP_RENDERER_SCENE_REFLECTION_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

// All of a scene's water (DIP_SURFACE_WATER) counts as horizontal and shows the same picture: the
// scene mirrored at one height, whatever the height of each pool.
typedef struct DipReflectionDef {
    int width; // of the mirrored picture, pixels, 1..DIP_MAX_FRAME_SIZE; 0: water does not reflect
    int height;
    double level_m; // world y at which the scene is mirrored
    bool schlick;   // Fresnel by Schlick's approximation rather than exactly
    bool show;      // the mirrored picture in the frame's top left corner
} DipReflectionDef;

// Refractive index of water.
#define DIP_WATER_INDEX 1.333

#ifdef __cplusplus
}
#endif

#endif
