// Declares lights and materials, and shades points of a surface with the model of Phong and Blinn,
// in fragment or vertex shaders. Colours are linear light. Positions and directions are in world
// space.
#ifndef DIP_APP_GALLERY_KIT_LIGHT_H
#define DIP_APP_GALLERY_KIT_LIGHT_H

#include "renderer/pipeline/shader.h"

typedef enum DipKitLightKind {
    DIP_KIT_DIRECTIONAL, // The light comes from one direction everywhere, as the sun's does.
    DIP_KIT_POINT,       // The light comes from a point and weakens with distance.
    DIP_KIT_SPOT,        // The light comes from a point, weakens with distance and fills a cone.
} DipKitLightKind;

typedef struct DipKitLight {
    DipKitLightKind kind;
    float position[3];  // Position of a point or spot light.
    float direction[3]; // Unit vector along which directional and spot lights shine.
    float colour[3];    // May exceed 1.
    float reach;        // Distance at which a point or spot light has half its strength.
    float inner_cos;    // Cosine of the angle within which a spot light has its full strength.
    float outer_cos;    // Cosine of the angle beyond which a spot light is dark; < inner_cos.
} DipKitLight;

typedef struct DipKitMaterial {
    float diffuse[3];     // Share of the light that is scattered, 0..1.
    float specular[3];    // Share of the light that is mirrored in the highlight.
    int exponent_doubled; // The highlight's exponent is 2 to the power of this number.
} DipKitMaterial;

// Points of a surface. Element i of position[0..2] and normal[0..2] belongs to point i. All
// arrays are borrowed.
typedef struct DipKitPoints {
    int count; // At most DIP_FRAGMENT_BATCH.
    const float *position[3];
    const float *normal[3]; // Unit vectors.
    const float *eye;       // The camera's position, x, y and z.
} DipKitPoints;

// Normalises `count` vectors, whose x, y and z are in three arrays.
void dip_kit_normalise(const float *const in[3], int count, float (*out)[DIP_FRAGMENT_BATCH]);

// Writes to out[0..2][i] the light of the sky that point i reflects. A surface that faces upwards
// gets all the light `sky`; an upright surface gets only the share `upright` of this light.
void dip_kit_light_sky(const float sky[3], float upright, const DipKitMaterial *material,
                       const DipKitPoints *points, float (*out)[DIP_FRAGMENT_BATCH]);

// Adds to out[0..2][i] the diffuse and the specular light that point i reflects. `lit` holds the
// share of the light that reaches each point, 0..1. If `lit` is NULL, all the light reaches all
// points.
void dip_kit_light_add(const DipKitLight *light, const DipKitMaterial *material,
                       const DipKitPoints *points, const float *lit,
                       float (*out)[DIP_FRAGMENT_BATCH]);

// Writes `ambient` to out[0..2][i] for each point i, and adds the light that the points reflect
// from several lights.
void dip_kit_light_all(const float ambient[3], const DipKitLight *lights, int light_count,
                       const DipKitMaterial *material, const DipKitPoints *points,
                       float (*out)[DIP_FRAGMENT_BATCH]);

// Returns the fragments of a batch as points. The batch has the uniforms and the varyings of
// dip_kit_vertex (kit.h). `normals` receives the points' unit normals and must outlive the points.
DipKitPoints dip_kit_fragment_points(const DipFragmentBatch *batch,
                                     float (*normals)[DIP_FRAGMENT_BATCH]);

// Does what dip_kit_light_all does, for the fragments of a batch. The batch must be one that
// dip_kit_fragment_points accepts.
void dip_kit_light_fragments(const DipFragmentBatch *batch, const float ambient[3],
                             const DipKitLight *lights, int light_count,
                             const DipKitMaterial *material, float (*out)[DIP_FRAGMENT_BATCH]);

#endif
