// Lights and materials. Shades points with the model of Phong and Blinn, in fragment or vertex
// shaders.
#ifndef DIP_APP_GALLERY_KIT_LIGHT_H
#define DIP_APP_GALLERY_KIT_LIGHT_H

#include "renderer/pipeline/shader.h"

typedef enum DipKitLightKind {
    DIP_KIT_DIRECTIONAL, // The light comes from one direction everywhere, as the sun's does.
    DIP_KIT_POINT,       // The light comes from a point and weakens with distance.
    DIP_KIT_SPOT,        // The same as POINT, but the light fills a cone only.
} DipKitLightKind;

typedef struct DipKitLight {
    DipKitLightKind kind;
    float position[3];  // point and spot lights, in world space
    float direction[3]; // unit vector along which directional and spot lights shine
    float colour[3];    // linear light; may exceed 1
    float reach;        // point and spot lights: distance at which the light is half as strong
    float inner_cos;    // spot lights: cosine of the angle within which the light is full
    float outer_cos;    // spot lights: cosine of the angle beyond which there is no light;
                        // less than inner_cos
} DipKitLight;

typedef struct DipKitMaterial {
    float diffuse[3];     // share of the light that is scattered, 0..1
    float specular[3];    // share of the light that is mirrored in the highlight
    int exponent_doubled; // the highlight's exponent is 2 to this power
} DipKitMaterial;

// Points of a surface. Element i of each array belongs to point i.
typedef struct DipKitPoints {
    int count; // at most DIP_FRAGMENT_BATCH
    const float *position[3];
    const float *normal[3]; // unit vectors
    const float *eye;       // the camera's position
} DipKitPoints;

// Normalises three arrays of vectors.
void dip_kit_normalise(const float *const in[3], int count, float (*out)[DIP_FRAGMENT_BATCH]);

// Writes the sky's light to out[0..2][i]: sky * material where the surface faces upwards. Where it
// stands upright, only the share `upright` of this light arrives.
void dip_kit_light_sky(const float sky[3], float upright, const DipKitMaterial *material,
                       const DipKitPoints *points, float (*out)[DIP_FRAGMENT_BATCH]);

// Adds a light's diffuse and specular part to out[0..2][i]. lit: share of the light that reaches
// each point, 0..1; NULL means all of it.
void dip_kit_light_add(const DipKitLight *light, const DipKitMaterial *material,
                       const DipKitPoints *points, const float *lit,
                       float (*out)[DIP_FRAGMENT_BATCH]);

// Writes the ambient light, which is the same at all points, and adds the parts of several lights.
void dip_kit_light_all(const float ambient[3], const DipKitLight *lights, int light_count,
                       const DipKitMaterial *material, const DipKitPoints *points,
                       float (*out)[DIP_FRAGMENT_BATCH]);

// Returns the fragments of a batch as points. The batch has the uniforms and the varyings of
// dip_kit_vertex. `normals` receives the points' unit normals and must outlive the points.
DipKitPoints dip_kit_fragment_points(const DipFragmentBatch *batch,
                                     float (*normals)[DIP_FRAGMENT_BATCH]);

// Does the same as dip_kit_light_all for the fragments of such a batch.
void dip_kit_light_fragments(const DipFragmentBatch *batch, const float ambient[3],
                             const DipKitLight *lights, int light_count,
                             const DipKitMaterial *material, float (*out)[DIP_FRAGMENT_BATCH]);

#endif
