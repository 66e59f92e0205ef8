// A scene: textures, materials, meshes and the objects that place them. What it shows never
// changes, so that any number of renderers on any thread may draw it.
//
// DipSceneDef is the plain description that loaders fill; dip_scene_create copies what it needs,
// builds mip chains and splits the meshes into chunks. The reference path reads the same
// description, so that fast and slow share no derived data.
#ifndef DIP_RENDERER_SCENE_SCENE_H
#define DIP_RENDERER_SCENE_SCENE_H

#include "renderer/base/api.h"
#include "renderer/base/error.h"
#include "renderer/base/pool.h"
#include "renderer/pipeline/texture.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// What a surface is, as the model file tags it.
typedef enum DipSurface {
    DIP_SURFACE_OPAQUE,
    DIP_SURFACE_CLIPPED, // alpha-clipped: a texel with alpha below alpha_cutoff is not there
    DIP_SURFACE_WATER,
    DIP_SURFACE_SKY,
} DipSurface;

enum { DIP_NO_TEXTURE = -1 };

// Colour = base colour * colour texture * light, all in linear light, clamped to 0..1 at the end.
// Light is light_map * light_map_scale where there is a light map; else, for a surface that is
// `lit`, a fixed sky-and-sun light from the vertex normals; else 1. A normal map changes the light
// of opaque and clipped surfaces that have one of the two and adds a highlight of the sun.
typedef struct DipMaterialDef {
    const char *name;
    DipSurface surface;
    float base_colour_lin[3]; // 0..1
    int colour_texture;       // index of a texture or DIP_NO_TEXTURE; uses the first coordinates
    int light_map;            // likewise; uses the second coordinates
    int normal_map;           // likewise; uses the first coordinates, green up, linear encoding
    float light_map_scale;    // 2 for light maps stored as light / 2
    float roughness;          // 0..1, of the highlight on normal-mapped surfaces
    float alpha_cutoff;       // 0..1, for DIP_SURFACE_CLIPPED; alpha >= cutoff is there
    bool double_sided;        // false: seen only where the winding is counter-clockwise
    bool lit;
} DipMaterialDef;

// Indexed triangles of one material. Arrays are packed; NULL where the mesh has none of a kind.
typedef struct DipMeshDef {
    const char *name;
    uint32_t vertex_count;
    const float *positions;   // x, y, z
    const float *normals;     // x, y, z, unit
    const float *uv0;         // u, v: colour textures
    const float *uv1;         // u, v: light map
    const float *colours_lin; // r, g, b, multiplies the base colour
    uint32_t index_count;     // a multiple of 3
    const uint32_t *indices;
    int material;
} DipMeshDef;

// A mesh placed in the world: world = transform * (x, y, z, 1), rows of a 3x4 matrix.
typedef struct DipObjectDef {
    const char *name;
    int mesh;
    float transform[12];
} DipObjectDef;

enum { DIP_MAX_SKY_SPEED = 600 };

// A layer of clouds: the sky's texture, scrolled and displaced.
typedef struct DipSkyLayer {
    float scale;               // repeats of the texture per unit of the surface's coordinates
    double speed_per_min;      // texture widths that u grows a minute, +-DIP_MAX_SKY_SPEED
    float perturbation_widths; // displacement where red and green are 1 (0: as much back)
} DipSkyLayer;

// How sky surfaces with a texture and coordinates look: docs/picture.md, Sky. Of the texture red
// and green displace, blue is cloud; it should repeat and be of linear encoding.
typedef struct DipSkyDef {
    DipSkyLayer layers[2];
    float perturbation_scale; // repeats of red and green per unit of the surface's coordinates
    float blend;              // share of the second layer, 0..1
    float clear;              // blue where there is no cloud
    float dense;              // blue where it is densest, more than clear
    float overcast;           // 0: no cloud, 1: nothing but cloud
    float zenith_lin[3];
    float horizon_lin[3];
    float cloud_lin[3];
    float glare_lin[3]; // added at the sun
    float tint_lin[3];  // multiplies all of it, brightness included
} DipSkyDef;

// Blue sky, half overcast.
DIP_API DipSkyDef dip_sky_default(void);

typedef struct DipSceneDef {
    const DipTextureDef *textures;
    const DipMaterialDef *materials;
    const DipMeshDef *meshes;
    const DipObjectDef *objects;
    int texture_count;
    int material_count;
    int mesh_count;
    int object_count;
    float background_lin[3]; // seen where nothing is
    float near_m;            // distance of the near plane, > 0; there is no far plane
    DipSkyDef sky;           // of surfaces of kind sky
} DipSceneDef;

typedef struct DipScene DipScene;

// Copies the description; nothing of *def is kept. The pool (may be NULL) speeds it up. Fails
// with a reason when an index, size or number is out of range or memory runs out.
DIP_API DipScene *dip_scene_create(const DipSceneDef *def, DipPool *pool, DipError *err);
DIP_API void dip_scene_destroy(DipScene **scene);

// Makes the textures that opt=standard and opt=advanced show, unless they are there already; else
// the first frame that shows them does, and takes as long. They stay until the scene is destroyed.
// Beside it other threads may draw the scene, with a pool of their own; those that need the
// textures wait for them. Without a pool (NULL) the caller's thread does all the work.
DIP_API bool dip_scene_compress_textures(const DipScene *scene, DipPool *pool, DipError *err);

// How long the parts of making it took, milliseconds.
typedef struct DipSceneTimes {
    double textures_ms; // mip chains
    double meshes_ms;
} DipSceneTimes;
DIP_API DipSceneTimes dip_scene_times(const DipScene *scene);

// Axis-aligned bounds of all objects in world space; of sky only where there is nothing else, so
// that a camera made for the bounds does not look at a sky dome from outside.
DIP_API void dip_scene_bounds(const DipScene *scene, float min_world[3], float max_world[3]);

// Height (world y) of the scene's lowest water; false when it has none.
DIP_API bool dip_scene_water_level(const DipScene *scene, double *level_m);

DIP_API uint64_t dip_scene_triangle_count(const DipScene *scene);
DIP_API uint64_t dip_scene_texture_bytes(const DipScene *scene); // held now

#ifdef __cplusplus
}
#endif

#endif
