// A scene: textures, materials, meshes, and objects that place the meshes in the world. The visible
// content of a scene never changes, so any number of renderers on any threads may draw it.
//
// DipSceneDef is the plain description that loaders fill. dip_scene_create copies what it needs,
// builds mip chains and splits the meshes into chunks. The reference renderer reads the same
// description, so the two renderers share no derived data.
#ifndef DIP_RENDERER_SCENE_SCENE_H
#define DIP_RENDERER_SCENE_SCENE_H

#include "renderer/base/api.h"
#include "renderer/base/error.h"
#include "renderer/base/pool.h"
#include "renderer/pipeline/texture.h"
#include "renderer/scene/lights.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// The kind of surface that a material describes. Model files name it (docs/models.md).
typedef enum DipSurface {
    DIP_SURFACE_OPAQUE,
    DIP_SURFACE_CLIPPED, // alpha-clipped: cut away where the alpha of the texture and the vertices
                         // is below alpha_cutoff
    DIP_SURFACE_BLENDED, // drawn over what lies behind it, with this alpha * opacity
    DIP_SURFACE_WATER,   // reflects the scene, and lets `transmission` of the light from below
                         // through
    DIP_SURFACE_SKY,
} DipSurface;

enum { DIP_NO_TEXTURE = -1 };

struct DipMotionDef;

// The reflection of a surface as glTF's metallic-roughness materials describe it. A surface with
// one reflects its surroundings, and its highlights follow from its roughness; docs/picture.md
// defines the formulas. An index of a texture may be DIP_NO_TEXTURE. The maps are read at the first
// texture coordinates (uv0), unless occlusion_at_uv1 or emission_at_uv1 says otherwise.
typedef struct DipPbrDef {
    float metallic;           // 0..1: 1 is a metal. It multiplies the blue of the metal_rough_map.
    float roughness;          // 0..1: it multiplies the green of the metal_rough_map
    float f0_lin[3];          // 0..1: reflected share at normal incidence where metallic is 0
    float f90;                // 0..1: reflected share at grazing incidence where metallic is 0
    int metal_rough_map;      // linear encoding
    int occlusion_map;        // linear encoding; its red is the share of ambient light that arrives
    bool occlusion_at_uv1;    // true: the occlusion map is read at uv1
    float occlusion_strength; // 0..1
    int emission_map;         // sRGB encoding; it multiplies emission_lin
    bool emission_at_uv1;     // true: the emission map is read at uv1
    float emission_lin[3];    // 0 or more: light that the surface sends out itself
    float normal_scale;       // multiplies x and y of the normal map's normals
    float coat;               // 0..1: strength of a clear coat with a reflected share of .04
    float coat_roughness;     // 0..1
    float sheen_lin[3];       // 0..1: colour of the sheen of cloth; black: there is none
    float sheen_roughness;    // 0..1
    // 0..1, for DIP_SURFACE_BLENDED: where metallic is 0, the share of the light that would become
    // diffuse that comes from behind instead, multiplied by the surface's own colour
    float transmission;
    // 0..1: how much the roughness blurs what is seen through the surface. It stays sharp if
    // roughness * scattering is 0.1 or less
    float scattering;
} DipPbrDef;

// The colour of a surface is base colour * vertex colour * colour texture * light, in linear light,
// clamped to 0..1 at the end. The light is
// - light_map * light_map_scale if there is a light map,
// - otherwise, on a `lit` surface with normals, the lights of the scene (lights.h). A scene without
//   lights has a fixed light of sky and sun at the vertices,
// - otherwise 1.
// The lights of the scene add highlights. On opaque, clipped and blended surfaces, a normal map
// changes the first two lights and may add a highlight of the sun; and lit ones with `pbr`, normals
// and no light map have its colour instead of all this. docs/picture.md defines the formulas.
typedef struct DipMaterialDef {
    const char *name;
    DipSurface surface;
    float base_colour_lin[3]; // 0..1
    // Indices of textures, or DIP_NO_TEXTURE. The light map is read at the second texture
    // coordinates (uv1), the other two at the first (uv0). A normal map has linear encoding, and
    // its green points up.
    int colour_texture;
    int light_map;
    int normal_map;
    float light_map_scale; // 2 for a light map that stores half the light
    float roughness;       // 0..1: roughness of the sun's highlight on normal-mapped surfaces
    float specular_lin[3]; // 0 or more: colour of the highlights of the scene's lights
    float shininess;       // 0..DIP_MAX_SHININESS: their exponent, rounded to a whole number
    float alpha_cutoff;    // 0..1, for DIP_SURFACE_CLIPPED: alpha >= alpha_cutoff is kept
    bool double_sided;     // false: visible only where the winding is counter-clockwise
    bool lit;      // true: without a light map, the scene's lights or the fixed light fall on it
    float opacity; // 0..1, for DIP_SURFACE_BLENDED
    // 0..1, for DIP_SURFACE_WATER: the share of the light from below that the water lets through,
    // as far as the surface does not reflect it. Water of more than 0 is drawn over what lies
    // behind it, as blended surfaces are.
    float transmission;
    const DipPbrDef *pbr; // NULL: the surface reflects nothing but the highlights described above
} DipMaterialDef;

// Indexed triangles of one material. All arrays are packed. An array of an attribute that the mesh
// does not have is NULL; only positions are required. All numbers must be finite.
typedef struct DipMeshDef {
    const char *name;
    uint32_t vertex_count;
    const float *positions;   // x, y, z
    const float *normals;     // x, y, z, unit; a normal 0, 0, 0 faces no light
    const float *uv0;         // u, v for the colour texture and the normal map
    const float *uv1;         // u, v for the light map
    const float *colours_lin; // r, g, b; multiplies the base colour
    const float *alphas;      // 0..1; multiplies the alpha of clipped and blended surfaces
    uint32_t index_count;     // a multiple of 3
    const uint32_t *indices;
    int material; // index of the mesh's material
} DipMeshDef;

// A mesh placed in the world: world = transform * (x, y, z, 1).
typedef struct DipObjectDef {
    const char *name;
    int mesh;            // index of the object's mesh
    float transform[12]; // 3x4 matrix, row by row
} DipObjectDef;

enum { DIP_MAX_SKY_SPEED = 600 }; // texture widths per minute

// One layer of clouds: the sky's texture, scrolled along u and displaced.
typedef struct DipSkyLayer {
    float scale;          // repeats of the texture per unit of the surface's texture coordinates
    double speed_per_min; // speed along u, in texture widths per minute, within +-DIP_MAX_SKY_SPEED
    // Displacement, in texture widths, where the texture's red and green are 1. Where red and green
    // are 0, the displacement is as large in the opposite direction.
    float perturbation_widths;
} DipSkyLayer;

// The look of sky surfaces that have a colour texture and first texture coordinates (uv0).
// docs/picture.md, Sky, defines the formulas. The texture's red and green displace the clouds, and
// its blue is the density of the clouds. The texture should repeat and have linear encoding. All
// numbers must be finite.
typedef struct DipSkyDef {
    DipSkyLayer layers[2];
    float perturbation_scale; // repeats of the displacing texture per unit of texture coordinates
    float blend;              // share of the second layer, 0..1
    float clear;              // value of the texture's blue that means no cloud
    float dense;              // value of the texture's blue that means the densest cloud; > clear
    float overcast;           // 0: no clouds, 1: nothing but clouds
    float zenith_lin[3];
    float horizon_lin[3];
    float cloud_lin[3];
    float glare_lin[3]; // colour of the sun's glare, which is added to the sky
    float tint_lin[3];  // tint times brightness; multiplies the whole sky
} DipSkyDef;

// The default sky: blue and half overcast.
DIP_API DipSkyDef dip_sky_default(void);

// Least and greatest distance of the near plane.
#define DIP_MIN_NEAR_M 1e-12f
#define DIP_MAX_NEAR_M 1e12f

typedef struct DipSceneDef {
    const DipTextureDef *textures;
    const DipMaterialDef *materials;
    const DipMeshDef *meshes;
    const DipObjectDef *objects;
    int texture_count;
    int material_count;
    int mesh_count;
    int object_count;
    float background_lin[3]; // colour of samples that no surface covers
    float
        near_m; // distance of the near plane, DIP_MIN_NEAR_M..DIP_MAX_NEAR_M; there is no far plane
    DipSkyDef sky;                  // look of all DIP_SURFACE_SKY surfaces
    const DipLightingDef *lighting; // NULL: the fixed light of sky and sun
    // What surfaces with `pbr` reflect. In a scene without lights, it also takes the place of the
    // fixed sun on them. NULL: the surroundings that the lighting describes.
    const DipEnvironmentDef *environment;
    const struct DipMotionDef *motion; // clips that move objects and meshes (motion.h); NULL: none
} DipSceneDef;

typedef struct DipScene DipScene;

// Creates a scene from a description. It copies everything, so *def and what it points to may be
// freed afterwards. The mip chains are built on the pool, or on the caller's thread if pool is
// NULL. Returns NULL with a reason if an index, size or number is out of range or memory runs out.
DIP_API DipScene *dip_scene_create(const DipSceneDef *def, DipPool *pool, DipError *err);
DIP_API void dip_scene_destroy(DipScene **scene);

// Compresses the textures that opt=standard and opt=advanced show, unless they are compressed
// already. If a program does not call this function, the first frame that shows the compressed
// textures makes them. The compressed textures stay until the scene is destroyed. During the call,
// other threads may draw the scene with a pool of their own; a frame that needs the compressed
// textures waits for them. If pool is NULL, the caller's thread does all the work. Fails with
// DIP_ERROR_MEMORY.
DIP_API bool dip_scene_compress_textures(const DipScene *scene, DipPool *pool, DipError *err);

// Durations of the parts of dip_scene_create, in milliseconds.
typedef struct DipSceneTimes {
    double textures_ms; // packing the textures, building their mip chains, blurring the environment
    double meshes_ms;
} DipSceneTimes;
DIP_API DipSceneTimes dip_scene_times(const DipScene *scene);

// Returns whether the picture of a still camera changes with time, because clouds drift or a clip
// plays.
DIP_API bool dip_scene_moves(const DipScene *scene);

// Axis-aligned bounds in world space of all objects that are not sky, so that a camera placed by
// these bounds does not look at a sky dome from outside. They hold for all moments of the scene's
// motion. If the scene has nothing but sky, these are the sky's bounds; if it has no triangles, all
// coordinates are 0.
DIP_API void dip_scene_bounds(const DipScene *scene, float min_world[3], float max_world[3]);

// Height (world y) of the scene's lowest water. Returns false if the scene has no water.
DIP_API bool dip_scene_water_level(const DipScene *scene, double *level_m);

// Returns whether the setting `shadows` can change a picture of the scene: it has a directional
// light and surfaces that this light lights and that cast shadows.
DIP_API bool dip_scene_has_shadows(const DipScene *scene);

// Triangles of all objects: a mesh counts once for each object that uses it.
DIP_API uint64_t dip_scene_triangle_count(const DipScene *scene);

// Memory that the scene's textures take now, in bytes. Compressing textures adds to it.
DIP_API uint64_t dip_scene_texture_bytes(const DipScene *scene);

#ifdef __cplusplus
}
#endif

#endif
