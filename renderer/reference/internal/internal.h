// Private to the reference path: its scene, its triangles and what they share.
#ifndef DIP_RENDERER_REFERENCE_INTERNAL_INTERNAL_H
#define DIP_RENDERER_REFERENCE_INTERNAL_INTERNAL_H

#include "renderer/reference/reference.h"
#include "renderer/reference/internal/texture.h"

#include <stddef.h>

struct DipReference {
    const DipSceneDef *def; // borrowed
    uint64_t frame_index;
    int64_t time_ns;
    DipReflectionDef reflection;
    const atomic_bool *stop; // NULL: never
    bool for_truth;          // textures have level 0 alone
    uint32_t **patches;      // of the triangles of each mesh; NULL for the truth
    DipRefTexture *textures; // by the description's index; those that nothing shows have no levels
};

// What a vertex carries beside its place, interpolated perspective-correctly.
enum {
    DIP_REF_U0,
    DIP_REF_V0,
    DIP_REF_U1,
    DIP_REF_V1,
    DIP_REF_X, // from the eye, world axes, metres
    DIP_REF_Y,
    DIP_REF_Z,
    DIP_REF_NORMAL_X, // unit at the vertices; of normal-mapped surfaces
    DIP_REF_NORMAL_Y,
    DIP_REF_NORMAL_Z,
    DIP_REF_RED, // vertex colour times vertex light
    DIP_REF_GREEN,
    DIP_REF_BLUE,
    DIP_REF_VARYINGS
};

enum { DIP_REF_DERIVED = 7 }; // the first of them, which also need derivatives

typedef struct DipRefVertex {
    double x; // screen, 1/256 pixel, right
    double y; // down
    double inv_w;
    double varyings[DIP_REF_VARYINGS];
} DipRefVertex;

// Clipped, seen from the side that shows, wound so that its area is positive with y down.
typedef struct DipRefTriangle {
    DipRefVertex vertices[3];
    double area; // twice the area, in 1/256 pixel squared
    const DipMaterialDef *material;
    const DipRefTexture *colour;     // NULL: no colour texture, or no coordinates for it
    const DipRefTexture *light_map;  // likewise
    const DipRefTexture *normal_map; // likewise; and no normals or nothing that lights it
    const DipSkyDef *sky;            // of sky with clouds; NULL: of other surfaces
    int64_t time_ns;                 // of the sky
    uint64_t patch;                  // of all objects' patches, shaded as one
    bool mirrored;                   // by its object's transform, which turns the winding around
    bool clipped;                    // by the alpha of `colour`
    int min_x, max_x;                // pixels of the frame that it may touch, inclusive
    int min_y, max_y;
} DipRefTriangle;

typedef struct DipRefTriangles {
    DipRefTriangle *items;
    size_t count;
    size_t capacity;
} DipRefTriangles;

// A picture of the scene.
typedef struct DipRefShot {
    const DipPose *pose;
    int width; // pixels
    int height;
    double aspect; // width / height of what is seen, whatever the pixels' shape
    bool rounded;  // positions, to whole steps of 1/256 pixel, before anything is decided on them
    // The scene turned upside down at the reflection's level, without its water, cut at the level;
    // what is `margin` times its distance along the view axis below it stays.
    bool mirrored;
    double margin;
} DipRefShot;

// All triangles that may be seen, in submission order.
bool dip_reference_build_triangles(const DipReference *reference, const DipRefShot *shot,
                                   DipRefTriangles *triangles, DipError *err);
void dip_reference_triangles_free(DipRefTriangles *triangles);

// A triangle at one place: edge functions there (the weights of its vertices, up to a factor).
typedef struct DipRefPosition {
    const DipRefTriangle *triangle;
    double edges[3];
    double x; // in the picture, 1/256 pixel
    double y;
} DipRefPosition;

double dip_reference_depth(const DipRefPosition *place, double near_m);

// Alpha of a clipped surface. filter NULL: bilinear, level 0.
double dip_reference_alpha(const DipRefPosition *place, const DipRefFilter *filter);

// Linear light, 0..1. filter is the colour texture's; NULL: bilinear, level 0, for all textures.
void dip_reference_shade(const DipRefPosition *place, const DipRefFilter *filter, double rgb[3]);

// The light of sun and sky on a unit normal, with a part of the sun.
extern const double dip_reference_sun[3]; // direction to it, not normalised
double dip_reference_light(const double normal[3], double sunlit);

// Whether a material's normal map is drawn.
bool dip_reference_is_bumpy(const DipMaterialDef *material);

// Varyings at a place, and the derivatives per pixel of those that need them.
typedef struct DipRefVaryings {
    double value[DIP_REF_VARYINGS];
    double ddx[DIP_REF_DERIVED];
    double ddy[DIP_REF_DERIVED];
} DipRefVaryings;

// normal_map.c: lights a surface's own colour by a map's texel (0..1 each); light: of the light
// map, NULL: none.
void dip_reference_light_bumps(const DipMaterialDef *material, const DipRefVaryings *varyings,
                               const double texel[3], const double light[3], double rgb[3]);

// sky.c: filter NULL: bilinear, level 0.
void dip_reference_shade_sky(const DipRefTriangle *triangle, const DipRefFilter *filter,
                             const DipRefVaryings *varyings, double rgb[3]);
// Water shows the mirrored scene: the eye is above it.
bool dip_reference_reflects(const DipReference *reference, const DipPose *pose);

// Turns water's own colour at a place of a frame into what is seen, with the mirrored scene's
// colour there.
void dip_reference_blend_water(const DipReference *reference, const DipPose *pose, int width,
                               int height, const DipRefPosition *place, const double mirrored[3],
                               double rgb[3]);

// The mirrored scene's colour at a place of a frame, bilinearly from its picture.
void dip_reference_read_mirrored(const DipReference *reference, const double *mirrored, int width,
                                 int height, const DipRefPosition *place, double rgb[3]);

// The converged picture's sample `index` of a pixel: jittered within its cell of a side x side
// grid. pixel: y * width + x. The place is in the frame, in 1/256 pixel.
void dip_reference_sample_position(int index, int side, uint32_t seed, size_t pixel, int x, int y,
                                   double *place_x, double *place_y);

// The count is a square; *side is its root.
bool dip_reference_check_samples(int sample_count, int *side, DipError *err);

// Whether work is to end early; asked once in so many triangles.
enum { DIP_REF_STOP_PERIOD = 4096 };
bool dip_reference_stopped(const DipReference *reference, DipError *err);

// The size is one that a frame may have.
bool dip_reference_check_size(int width, int height, DipError *err);

#endif
