// Private to the reference renderer: its scene, its triangles and the functions its files share.
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
    const atomic_bool *stop; // NULL: the work never stops early
    bool for_truth;          // true: draws converged pictures only, so textures have level 0 only
    uint32_t **patches;      // for each mesh, the patch of each of its triangles; NULL if for_truth
    // Textures, with the same indices as in the description. A texture that no surface shows has no
    // levels.
    DipRefTexture *textures;
};

// The varyings: values that a vertex carries besides its position. They are interpolated with
// perspective correction.
enum {
    DIP_REF_U0,
    DIP_REF_V0,
    DIP_REF_U1,
    DIP_REF_V1,
    DIP_REF_X, // position relative to the eye, along the world's axes, in metres
    DIP_REF_Y,
    DIP_REF_Z,
    DIP_REF_NORMAL_X, // normal, of length 1 at the vertices
    DIP_REF_NORMAL_Y,
    DIP_REF_NORMAL_Z,
    DIP_REF_RED, // vertex colour times vertex light
    DIP_REF_GREEN,
    DIP_REF_BLUE,
    DIP_REF_HIGHLIGHT_RED, // highlight of the scene's lights at the vertex
    DIP_REF_HIGHLIGHT_GREEN,
    DIP_REF_HIGHLIGHT_BLUE,
    DIP_REF_VARYINGS
};

enum { DIP_REF_DERIVED = 7 }; // number of varyings with derivatives: the first ones

typedef struct DipRefVertex {
    double x; // on the screen, to the right, in 1/256 pixel
    double y; // on the screen, downwards, in 1/256 pixel
    double inv_w;
    double varyings[DIP_REF_VARYINGS];
} DipRefVertex;

// A surface that the lights of the scene light.
typedef struct DipRefLit {
    const DipLightingDef *lighting; // NULL: the lights of the scene do not light the surface
    const DipMaterialDef *material;
    double eye[3];  // position of the eye in world space; of its mirror image if the shot mirrors
    bool fragments; // true: the light is computed where the surface is shaded, not at the vertices
} DipRefLit;

// A triangle after clipping. It faces the eye or is double-sided. Its vertices are ordered so that
// its area is positive if y points down.
typedef struct DipRefTriangle {
    DipRefVertex vertices[3];
    double area; // twice the area, in squared steps of 1/256 pixel
    const DipMaterialDef *material;
    // The triangle's textures are NULL if the material has none or the mesh has no texture
    // coordinates for it. A normal map is also NULL if the mesh has no normals or no light falls on
    // the material.
    const DipRefTexture *colour;
    const DipRefTexture *light_map;
    const DipRefTexture *normal_map;
    DipRefLit lit;
    const DipSkyDef *sky; // the clouds of a sky surface; NULL for other surfaces
    int64_t time_ns;      // time of the clouds
    uint64_t patch;   // number of a patch, which is shaded as one surface; unique among all objects
    bool mirrored;    // true if the object's transform mirrors, which reverses the winding
    bool clipped;     // true if the alpha of `colour` clips the surface
    int min_x, max_x; // pixels of the frame that the triangle may touch, inclusive
    int min_y, max_y;
} DipRefTriangle;

typedef struct DipRefTriangles {
    DipRefTriangle *items;
    size_t count;
    size_t capacity;
} DipRefTriangles;

// A view of the scene that is drawn to one picture.
typedef struct DipRefShot {
    const DipPose *pose;
    int width; // pixels
    int height;
    double aspect; // width / height of the view; pixels need not be square
    bool rounded;  // true: positions are rounded to 1/256 pixel before any decision
    // If true, the scene is mirrored at the reflection's level and cut there, and its water is left
    // out. A point below the level stays if its distance below the level is less than `margin`
    // times its distance along the view axis.
    bool mirrored;
    double margin;
} DipRefShot;

// Returns a pose's orientation, scaled by a power of two so that squares of its components neither
// overflow nor vanish.
void dip_reference_orientation(const DipPose *pose, double q[4]);

// Collects all triangles that may be visible, in submission order.
bool dip_reference_build_triangles(const DipReference *reference, const DipRefShot *shot,
                                   DipRefTriangles *triangles, DipError *err);
void dip_reference_triangles_free(DipRefTriangles *triangles);

// A triangle at one position. Up to a common factor, the edge functions at the position are the
// weights of the vertices.
typedef struct DipRefPosition {
    const DipRefTriangle *triangle;
    double edges[3];
    double x; // in the picture, in 1/256 pixel
    double y;
} DipRefPosition;

double dip_reference_depth(const DipRefPosition *place, double near_m);

// Returns the alpha of a clipped surface. If filter is NULL, the texture is read bilinearly from
// level 0.
double dip_reference_alpha(const DipRefPosition *place, const DipRefFilter *filter);

// Returns the alpha of a clipped surface and finds how fast it changes, in |d alpha / dx| + |d
// alpha / dy| per pixel.
double dip_reference_alpha_slope(const DipRefPosition *place, const DipRefFilter *filter,
                                 double *slope);

// Shades a triangle at a position; the result is linear light, 0..1. filter is the colour texture's
// filter. If filter is NULL, all textures are read bilinearly from level 0.
void dip_reference_shade(const DipRefPosition *place, const DipRefFilter *filter, double rgb[3]);

// Returns the light of sun and sky on a surface with a normal of length 1. sunlit, 0..1, is the
// part of the sun that reaches the surface.
extern const double dip_reference_sun[3]; // direction to the sun, not normalised
double dip_reference_light(const double normal[3], double sunlit);

// Computes the scene's lights on a surface. place: position relative to the eye. normal: unit
// normal. diffuse is the factor of the surface's own colour, and highlight is added.
void dip_reference_lights(const DipRefLit *lit, const double place[3], const double normal[3],
                          double diffuse[3], double highlight[3]);

// Returns true if surfaces with this material show its normal map.
bool dip_reference_is_bumpy(const DipMaterialDef *material);

// Varyings at a position. The first DIP_REF_DERIVED also have derivatives per pixel.
typedef struct DipRefVaryings {
    double value[DIP_REF_VARYINGS];
    double ddx[DIP_REF_DERIVED];
    double ddy[DIP_REF_DERIVED];
    double depth_change; // |dw/dx| + |dw/dy|, divided by w; w is the distance along the view axis
} DipRefVaryings;

// Finds the unit normal at a position: the interpolated normal, or the normal map's if texel is not
// NULL. Returns the length of the normal map's filtered normal, or 1.
double dip_reference_normal(const DipRefVaryings *varyings, const double texel[3],
                            double normal[3]);

// Interpolates `count` varyings from `first` on, with perspective correction. If derive is true,
// the derivatives of those that have any are computed too.
void dip_reference_interpolate(const DipRefPosition *place, int first, int count, bool derive,
                               DipRefVaryings *out);

// normal_map.c: multiplies a surface's own colour by the light that falls on a normal-mapped
// surface, and adds the highlight. texel is the normal map's value, 0..1 each. light is the light
// map's value, or NULL if there is no light map.
void dip_reference_light_bumps(const DipMaterialDef *material, const DipRefVaryings *varyings,
                               const double texel[3], const double light[3], double rgb[3]);

// sky.c: shades a sky surface. If filter is NULL, the texture is read bilinearly from level 0.
void dip_reference_shade_sky(const DipRefTriangle *triangle, const DipRefFilter *filter,
                             const DipRefVaryings *varyings, double rgb[3]);
// Returns true if water shows the mirrored scene. Water does so only if the eye is above the water
// level.
bool dip_reference_reflects(const DipReference *reference, const DipPose *pose);

// Blends water's own colour, rgb, with the colour of the mirrored scene at the same position of the
// frame.
void dip_reference_blend_water(const DipReference *reference, const DipPose *pose, int width,
                               int height, const DipRefPosition *place, const double mirrored[3],
                               double rgb[3]);

// Reads the colour of the mirrored scene at a position of the frame, bilinearly from the mirrored
// picture, which has the given width and height.
void dip_reference_read_mirrored(const double *mirrored, const int size[2], int width, int height,
                                 const DipRefPosition *place, double rgb[3]);

// Computes the position of sample `index` of the converged picture in a pixel. The sample is
// jittered within its cell of a side x side grid. pixel is y * width + x. The position is relative
// to the frame, in 1/256 pixel.
void dip_reference_sample_position(int index, int side, uint32_t seed, size_t pixel, int x, int y,
                                   double *place_x, double *place_y);

// Checks that the sample count is a square number; *side receives its root.
bool dip_reference_check_samples(int sample_count, int *side, DipError *err);

// Returns true if work should end early. Loops over triangles call this once per
// DIP_REF_STOP_PERIOD triangles.
enum { DIP_REF_STOP_PERIOD = 4096 };
bool dip_reference_stopped(const DipReference *reference, DipError *err);

// Checks that a frame may have this size.
bool dip_reference_check_size(int width, int height, DipError *err);

#endif
