// Private to the reference renderer: its scene, its triangles and the functions its files share.
#ifndef DIP_RENDERER_REFERENCE_INTERNAL_INTERNAL_H
#define DIP_RENDERER_REFERENCE_INTERNAL_INTERNAL_H

#include "renderer/reference/reference.h"
#include "renderer/reference/internal/texture.h"
#include "renderer/scene/motion.h"

#include <stddef.h>

// Tables of the light that metallic-roughness surfaces reflect.
typedef struct DipRefEnvironment DipRefEnvironment;

// What lies behind rough glass.
typedef struct DipRefBackdrop DipRefBackdrop;

// The surfaces that cast shadows, and the light whose shadows they cast.
typedef struct DipRefShadows DipRefShadows;

struct DipReference {
    const DipSceneDef *def;     // borrowed; that of `posed` if the scene moves
    DipPosedDef *posed;         // owned: the scene at the reference's time; NULL if nothing moves
    const DipMotionDef *motion; // of the scene; NULL if nothing moves
    uint64_t frame_index;
    int64_t time_ns;
    DipReflectionDef reflection;
    const atomic_bool *stop; // NULL: the work never stops early
    bool for_truth;          // true: draws converged pictures only, so textures have level 0 only
    uint32_t **patches;      // for each mesh, the patch of each of its triangles; NULL if for_truth
    // Textures, with the same indices as in the description. A texture that no surface shows has no
    // levels.
    DipRefTexture *textures;
    // Owned. NULL without an environment, or if no material has a metallic-roughness surface.
    DipRefEnvironment *environment;
    DipRefShadows *shadows; // owned; NULL if the scene can have no shadows
    bool lacks_shadows;     // no memory was left for the shadows of this time
    bool differs;           // shares differences of the fast renderer (differences.h)
    bool in_floats;         // interpolates as the fast renderer does (differences.h)
};

// The varyings: values that a vertex carries besides its position. They are interpolated with
// perspective correction.
enum {
    DIP_REF_U0,
    DIP_REF_V0,
    DIP_REF_U1,
    DIP_REF_V1,
    DIP_REF_ALPHA, // of the vertices
    DIP_REF_X,     // position relative to the eye, along the world's axes, in metres
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
    DIP_REF_DIRECT_RED, // vertex colour times the light of the light with shadows, which RED lacks
    DIP_REF_DIRECT_GREEN,
    DIP_REF_DIRECT_BLUE,
    DIP_REF_VARYINGS
};

enum { DIP_REF_DERIVED = 8 }; // number of varyings with derivatives: the first ones

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
    const DipRefShadows *shadows; // NULL: the surface receives no shadows
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
    bool repeats[2];  // u0 and v0: all textures that are read at them repeat along this axis
    double repeat[2]; // u0 and v0 where they repeat: the multiple of 64 nearest to the eye's corner
    DipRefLit lit;
    const DipPbrDef *pbr; // NULL unless the surface is drawn by its metallic-roughness description
    bool few_entries;     // its tables have as few entries as the fast renderer's (differences.h)
    const DipRefEnvironment *environment; // NULL: the surroundings of the lighting
    const DipRefTexture *metal_rough;     // maps of such a surface, or NULL
    const DipRefTexture *occlusion;
    const DipRefTexture *emission;
    const DipSkyDef *sky; // the clouds of a sky surface; NULL for other surfaces
    int64_t time_ns;      // time of the clouds
    uint64_t patch; // number of a patch, which is shaded as one surface; unique among all objects
    bool in_floats; // its varyings are interpolated as the fast renderer does (differences.h)
    bool mirrored;  // true if the object's transform mirrors, which reverses the winding
    bool clipped;   // true if the alpha of `colour` or of the vertices clips the surface
    bool blended;   // true if the surface is drawn over what lies behind it
    bool water;
    int min_x, max_x; // pixels of the frame that the triangle may touch, inclusive
    int min_y, max_y;
} DipRefTriangle;

typedef struct DipRefTriangles {
    DipRefTriangle *items;
    bool has_blended;    // some triangle is blended
    bool has_water;      // some triangle is water
    bool has_scattering; // some triangle blurs what is seen through it
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
    bool shadows; // true: a directional light casts shadows
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

// Returns the share of what lies behind that a surface covers; 1 unless it is blended. filter: as
// above.
double dip_reference_opacity(const DipRefPosition *place, const DipRefFilter *filter);

// A surface as it is drawn over what lies behind it: its colour, the share of the pixel that it
// covers, and the shares of the three channels of what lies behind that are seen.
enum { DIP_REF_LAYER = 7 };

// Finds what is seen of what lies behind a surface whose colour and covered share are known.
// backdrop: what rough glass shows blurred; NULL: it shows what lies behind it sharp.
void dip_reference_see_through(const DipRefPosition *place, const DipRefFilter *filter,
                               const DipRefBackdrop *backdrop, double layer[DIP_REF_LAYER]);

// backdrop.c: makes the levels of a picture of the surfaces that are not blended. Returns NULL if
// memory runs out.
DipRefBackdrop *dip_reference_backdrop_create(const double *rgb_lin, int width, int height);
// *backdrop may be NULL and becomes NULL.
void dip_reference_backdrop_destroy(DipRefBackdrop **backdrop);
// Reads a backdrop around a position, blurred for a roughness.
void dip_reference_backdrop_read(const DipRefBackdrop *backdrop, const DipRefPosition *place,
                                 double roughness, double rgb[3]);

// Returns whether a surface blurs what is seen through it.
bool dip_reference_scatters(const DipRefTriangle *triangle);

// converge.c: draws the backdrop of converged pictures, or sets *backdrop to NULL if no rough glass
// is in view.
bool dip_reference_converge_backdrop(const DipReference *reference, const DipPose *pose, int width,
                                     int height, DipRefBackdrop **backdrop, DipError *err);

// Draws a surface over a colour.
void dip_reference_blend(const double layer[DIP_REF_LAYER], double rgb[3]);

// Shades a triangle at a position; the result is linear light, 0..1. filter is the colour texture's
// filter. If filter is NULL, all textures are read bilinearly from level 0.
void dip_reference_shade(const DipRefPosition *place, const DipRefFilter *filter, double rgb[3]);

// Returns the light of sun and sky on a surface with a normal of length 1. sunlit, 0..1, is the
// part of the sun that reaches the surface.
extern const double dip_reference_sun[3]; // direction to the sun, not normalised
double dip_reference_light(const double normal[3], double sunlit);

// Computes the scene's lights on a surface. place: position relative to the eye. ray: direction
// from the eye. normal: unit normal. diffuse is the factor of the surface's own colour, and
// highlight is added. The light with shadows is multiplied by `sunlit`, the part of it that
// arrives. If direct is not NULL, it receives the diffuse part of this light, which `diffuse` then
// lacks.
void dip_reference_lights(const DipRefLit *lit, const double place[3], const double ray[3],
                          const double normal[3], double sunlit, double diffuse[3],
                          double highlight[3], double direct[3]);

// shadows.c: collects what casts shadows. *shadows is NULL if the scene has no directional light,
// or if no surface casts shadows.
bool dip_reference_shadows_create(const DipReference *reference, DipRefShadows **shadows,
                                  DipError *err);
// *shadows may be NULL and becomes NULL.
void dip_reference_shadows_destroy(DipRefShadows **shadows);

// Returns the index of the light that casts the shadows, or -1 if shadows is NULL.
int dip_reference_shadow_light(const DipRefShadows *shadows);

// Returns 1 if a ray from a place to the light with shadows meets nothing, otherwise 0. place:
// relative to the eye. If the surface receives no shadows, the result is 1.
double dip_reference_sunlit(const DipRefLit *lit, const double place[3]);

// Finds the direction to a light and returns the part of its light that arrives at a place. `place`
// is relative to the eye, and `eye` is the eye's position in the world.
double dip_reference_arrival(const DipLightDef *light, const double eye[3], const double place[3],
                             double to_light[3]);

// Returns true for opaque, clipped and blended surfaces, which may have normal maps, the lights of
// the scene and metallic-roughness descriptions.
bool dip_reference_is_solid(const DipMaterialDef *material);

// Returns true if surfaces with this material show its normal map.
bool dip_reference_is_bumpy(const DipMaterialDef *material);

// Varyings at a position. The first DIP_REF_DERIVED also have derivatives per pixel.
typedef struct DipRefVaryings {
    double value[DIP_REF_VARYINGS];
    double ddx[DIP_REF_DERIVED];
    double ddy[DIP_REF_DERIVED];
    double depth_change; // |dw/dx| + |dw/dy|, divided by w; w is the distance along the view axis
    const DipRefTriangle *triangle;
    bool beyond_horizon; // the triangle's plane meets the view ray behind the eye, not ahead
} DipRefVaryings;

// Returns the direction from the eye through a position, of any length. A triangle may be shaded at
// a position outside of it where its plane meets the view ray behind the eye.
void dip_reference_ray(const DipRefVaryings *varyings, double ray[3]);

// Finds the unit normal at a position: the interpolated normal, or the normal map's if texel is not
// NULL. scale multiplies x and y of the map's normal. Returns the length of the normal map's
// filtered normal before it is scaled, or 1.
double dip_reference_normal(const DipRefVaryings *varyings, const double texel[3], double scale,
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

// Reads a map that holds data or emission, at the varyings `coordinate` and the next one. filter is
// that of the colour texture.
void dip_reference_read_data(const DipRefTexture *map, const DipRefFilter *filter,
                             const DipRefVaryings *varyings, int coordinate, double texel[4]);

// pbr.c: computes the tables that all references share, unless they are there. It must come before
// metallic-roughness surfaces are drawn. Several threads may call it.
void dip_reference_pbr_prepare(void);
// The same for the tables that references read that share the fast renderer's differences.
void dip_reference_pbr_prepare_few(void);

// environment.c: makes what surfaces see of an environment, which is borrowed. Returns NULL if
// memory runs out. *environment may be NULL and becomes NULL.
DipRefEnvironment *dip_reference_environment_create(const DipEnvironmentDef *def);
void dip_reference_environment_destroy(DipRefEnvironment **environment);
// Computes the light that a lobe of some roughness, 0..1, sees around a direction (unit).
void dip_reference_environment_see(const DipRefEnvironment *environment, double roughness,
                                   const double towards[3], double rgb[3]);
// Computes the light that falls on a white matt surface with a normal (unit).
void dip_reference_environment_soften(const DipRefEnvironment *environment, const double normal[3],
                                      double rgb[3]);

// Shades a metallic-roughness surface, whose own colour is rgb. texel: its normal map's, or NULL.
void dip_reference_shade_pbr(const DipRefTriangle *triangle, const DipRefFilter *filter,
                             const DipRefVaryings *varyings, const double texel[3], double rgb[3]);

// pbr.c: finds the shares of the three channels of what lies behind that a transmitting surface,
// whose own colour is base, lets through. Returns the roughness with its map, but without the
// spread of the normal map.
double dip_reference_transmit_pbr(const DipRefTriangle *triangle, const DipRefFilter *filter,
                                  const DipRefVaryings *varyings, const double texel[3],
                                  const double base[3], double through[3]);

// sky.c: shades a sky surface. If filter is NULL, the texture is read bilinearly from level 0.
void dip_reference_shade_sky(const DipRefTriangle *triangle, const DipRefFilter *filter,
                             const DipRefVaryings *varyings, double rgb[3]);
// Returns true if water shows the mirrored scene. Water does so only if the eye is above the water
// level.
bool dip_reference_reflects(const DipReference *reference, const DipPose *pose);

// Blends water's own colour, rgba, with the colour of the mirrored scene at the same position of
// the frame. rgba[3] is the share of what lies behind that the water's own colour covers. It
// becomes the share that colour and reflection cover.
void dip_reference_blend_water(const DipReference *reference, const DipRefShot *shot,
                               const DipRefPosition *place, const double mirrored[3],
                               double rgba[4]);

// Reads the colour of the mirrored scene at a position of the frame, bilinearly from the mirrored
// picture, which has the given width and height.
void dip_reference_read_mirrored(const double *mirrored, const int size[2], int width, int height,
                                 const DipRefPosition *place, double rgb[3]);

// A sample whose blended surfaces are drawn from far to near, one at a time.
typedef struct DipRefPeel {
    double rgb[3]; // with the surfaces so far
    double depth;  // of the surface that was drawn last
    int32_t last;  // its triangle
    double next_depth;
    int32_t next; // triangle of the farthest surface that is left, or -1
    bool water;   // water has been drawn
} DipRefPeel;

// Begins with the colour and the depth of what is opaque.
DipRefPeel dip_reference_peel_begin(const double rgb[3], double depth);
// Offers a triangle that covers the sample. Surfaces of equal depth keep their submission order.
void dip_reference_peel_offer(DipRefPeel *peel, double depth, int32_t triangle);
// Draws the farthest of the offered surfaces.
void dip_reference_peel_blend(DipRefPeel *peel, const double layer[DIP_REF_LAYER]);

// enlarge.c: enlarges the picture of a scale below 1. Its colours, in linear light, are rounded to
// codes first. upscale: the step of the setting. Fails with MEMORY.
bool dip_reference_enlarge(int upscale, const double *drawn_lin, int from_width, int from_height,
                           double *rgb_lin, int width, int height, DipError *err);

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

// Checks that a frame may have this pose and size, and that the reference has all that it draws.
bool dip_reference_check_frame(const DipReference *reference, const DipPose *pose, int width,
                               int height, DipError *err);

#endif
