// The lights of a scene. A scene without lights of its own has one fixed light of sky and sun.
//
// The lights shine on `lit` opaque, clipped and blended surfaces with normals and without a light
// map. With the setting `shadows`, the strongest directional light casts shadows, and no other
// light does. docs/picture.md, Lights and Shadows, defines the formulas.
#ifndef DIP_RENDERER_SCENE_LIGHTS_H
#define DIP_RENDERER_SCENE_LIGHTS_H

#include "renderer/base/api.h"

#ifdef __cplusplus
extern "C" {
#endif

// Greatest colour of a light or highlight, and greatest range and attenuation.
#define DIP_MAX_LIGHT_LIN 1e9f

enum {
    DIP_MAX_LIGHTS = 64,      // of a scene
    DIP_MAX_SHININESS = 1024, // greatest exponent of a highlight
};

typedef enum DipLightKind {
    DIP_LIGHT_DIRECTIONAL, // from far away: the same direction and strength everywhere
    DIP_LIGHT_POINT,       // from a point in all directions
    DIP_LIGHT_SPOT,        // from a point within a cone
} DipLightKind;

// All numbers must be finite.
typedef struct DipLightDef {
    const char *name; // may be NULL
    DipLightKind kind;
    float colour_lin[3]; // 0..DIP_MAX_LIGHT_LIN; light on a surface that faces the light
    // Of a point or spot light. A light more than 1e18 m from the eye shines everywhere as it does
    // at the eye.
    float position_world[3];
    float direction_world[3]; // the way the light travels; any length but 0; not of a point light
    // At distance d, the light of a point or spot light is divided by
    // attenuation[0] + attenuation[1] * d + attenuation[2] * d * d. Each is 0 or more, and at least
    // one is greater than 0. {0, 0, 1} is the inverse-square law.
    float attenuation[3];
    // The light of a point or spot light fades to nothing at this distance. 0: it has no end.
    float range_m;
    // Half of a spot light's cones: full light inside the inner cone, none outside the outer one.
    // 0 <= inner <= outer <= 90 degrees, and outer > 0.
    float inner_deg, outer_deg;
} DipLightDef;

// Where the light of a lit surface is computed.
typedef enum DipShading {
    DIP_SHADING_PHONG,   // at each fragment, with the interpolated normal
    DIP_SHADING_GOURAUD, // at the vertices; surfaces with a normal map have DIP_SHADING_PHONG
} DipShading;

// The light that no direction can be named for is ambient + n.y * sky, where n is the unit normal:
// it is brightest on surfaces that face the sky. 0 <= sky_lin <= ambient_lin.
typedef struct DipLightingDef {
    float ambient_lin[3];
    float sky_lin[3];
    const DipLightDef *lights; // light_count of them
    int light_count;           // 0..DIP_MAX_LIGHTS
    DipShading shading;
} DipLightingDef;

enum { DIP_MAX_ENVIRONMENT_WIDTH = 4096 }; // greatest width of an environment, texels

// Greatest light of an environment. Brighter texels must be cut off.
#define DIP_MAX_ENVIRONMENT_LIN 65000.0f

// The surroundings of a scene: an equirectangular picture of the light that comes from all
// directions. Surfaces with `pbr` (scene.h) reflect it and are lit by it, in place of the ambient
// light and the sky of DipLightingDef. The top row is up (+y). The middle of the picture lies
// towards +x, and what is right of it towards +z.
typedef struct DipEnvironmentDef {
    const float *rgb_lin; // 0..DIP_MAX_ENVIRONMENT_LIN, row by row from the top, 3 for each texel
    int width;            // even, 2..DIP_MAX_ENVIRONMENT_WIDTH
    int height;           // width / 2
} DipEnvironmentDef;

// Returns the fixed light of sky and sun as lights of a scene, with Gouraud shading. Static
// storage.
DIP_API const DipLightingDef *dip_lighting_fixed(void);

#ifdef __cplusplus
}
#endif

#endif
