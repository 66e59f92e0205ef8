// Scenes made in code for picture tests, each with a pose that shows what the scene tests.
#ifndef DIP_RENDERER_CATALOGUE_SCENES_H
#define DIP_RENDERER_CATALOGUE_SCENES_H

#include "renderer/scene/pose.h"
#include "renderer/scene/reflection.h"
#include "renderer/scene/scene.h"

// The kinds of scenes. X(name, "what the scene tests")
#define DIP_TEST_SCENE_LIST(X)                                                                     \
    X(grazing_checker, "a plane to the horizon, 512-texel checker")                                \
    X(grazing_noise, "a plane to the horizon, 1024-texel noise, rolled by 22.5 degrees")           \
    X(grazing_rolled, "a plane to the horizon, 256-texel checker, rolled by 45 degrees")           \
    X(cube_on_plane, "a closed mesh over a textured plane, and a coplanar decal")                  \
    X(fence, "alpha-clipped bars, 4 texels wide in every 32, in front of a plane")                 \
    X(soup, "400 random triangles, double-sided, with vertex colours")                             \
    X(slivers, "triangles thinner than a pixel, some thinner than 1/256 pixel")                    \
    X(huge, "triangles that cross the near plane and reach far beyond the guard band")             \
    X(odd_textures,                                                                                \
      "textures of 1x1, 7x5 and 1x9 texels, repeated and clamped, coordinates outside 0..1")       \
    X(vertex_colours, "vertex colours over a perspective quad, no texture")                        \
    X(lit_sphere, "spheres with smooth normals, also scaled unevenly, mirrored and very small")    \
    X(light_map, "a scaled light map at second texture coordinates, linear encoding")              \
    X(normal_map,                                                                                  \
      "bumps under a light map and the sun; coordinates mirrored, without area, on a sphere")      \
    X(lights,                                                                                      \
      "all kinds of lights with highlights at the fragments, on bumps and clipped bars too")       \
    X(gouraud_lights, "the same lights at the vertices")                                           \
    X(sky, "two layers of cloud over a quad to the horizon")                                       \
    X(water, "pools at two heights that reflect what stands in and around them")                   \
    X(water_effects, "a pool that mirrors clouds, a fence and a bumpy wall: all effects together") \
    X(metal_gloss, "metallic-roughness surfaces with all maps, a clear coat and both sides")       \
    X(blending, "blended panes and a ball, single- and double-sided, mirrored by a pool")          \
    X(clear_water, "the pools of `water`, whose floors are seen through it")

typedef enum DipTestSceneKind {
#define DIP_TEST_SCENE_ENUM(name, text) DIP_TEST_SCENE_##name,
    DIP_TEST_SCENE_LIST(DIP_TEST_SCENE_ENUM)
#undef DIP_TEST_SCENE_ENUM
        DIP_TEST_SCENE_COUNT
} DipTestSceneKind;

enum { DIP_TEST_SCENE_PARTS = 8, DIP_TEST_SCENE_BLOCKS = 64 };

// A scene. It owns everything that def points to. def points into this struct, which must therefore
// not be copied or moved.
typedef struct DipTestScene {
    DipSceneDef def;
    DipPose pose;
    DipReflectionDef reflection; // width 0 if the scene does not test water
    DipTextureDef textures[DIP_TEST_SCENE_PARTS];
    DipMaterialDef materials[DIP_TEST_SCENE_PARTS];
    DipPbrDef
        pbrs[DIP_TEST_SCENE_PARTS]; // of the materials with the same indices, if they have one
    DipMeshDef meshes[DIP_TEST_SCENE_PARTS];
    DipObjectDef objects[DIP_TEST_SCENE_PARTS];
    DipLightDef lights[DIP_TEST_SCENE_PARTS];
    DipLightingDef lighting; // def.lighting points here if the scene has lights
    void *blocks[DIP_TEST_SCENE_BLOCKS];
    int block_count;
} DipTestScene;

const char *dip_test_scene_name(DipTestSceneKind kind);
void dip_test_scene_make(DipTestScene *scene, DipTestSceneKind kind);
void dip_test_scene_free(DipTestScene *scene);

typedef enum DipTestTexture { DIP_TEST_CHECKER, DIP_TEST_NOISE } DipTestTexture;

// Makes a plane 1 m below the eye that reaches to the horizon. The camera is rolled about its view
// axis. The texture repeats every metre.
void dip_test_scene_make_grazing(DipTestScene *scene, DipTestTexture texture, int size,
                                 double roll_deg);

// --- parts, for tests that build their own scenes ----------------------------------------------

// Begins an empty scene with a grey background, a near plane at 0.1 m, and a camera at the origin
// with a vertical field of view of 60 degrees.
void dip_test_scene_begin(DipTestScene *scene);

// Allocates zeroed memory that the scene owns.
void *dip_test_scene_alloc(DipTestScene *scene, size_t count, size_t size);

// Each of these functions returns the index of the texture or material that it added. Texels are
// opaque; the test may change them afterwards.
int dip_test_scene_add_texture(DipTestScene *scene, DipTestTexture texture, int width, int height);
int dip_test_scene_add_material(DipTestScene *scene, int colour_texture);

// Gives a material a metallic-roughness surface without maps, lights it and returns the surface.
DipPbrDef *dip_test_scene_add_pbr(DipTestScene *scene, int material, float metallic,
                                  float roughness);

// The first function adds a normal map of round bumps, which can be repeated. The second adds soft
// noise as the data texture of a sky. Both textures have linear encoding.
int dip_test_scene_add_bumps(DipTestScene *scene, int size);
int dip_test_scene_add_clouds(DipTestScene *scene, int size);
// Returns the texels of a texture.
uint8_t *dip_test_scene_texels(DipTestScene *scene, int texture);

// The arrays of a mesh that is being made. Arrays that the test did not ask for are NULL.
typedef struct DipTestMesh {
    float *positions;
    float *normals;
    float *uv0;
    float *uv1;
    float *colours_lin;
    uint32_t *indices;
} DipTestMesh;

enum { DIP_TEST_NORMALS = 1, DIP_TEST_UV0 = 2, DIP_TEST_UV1 = 4, DIP_TEST_COLOURS = 8 };

// Adds a mesh, and an object that draws it without a transform. The test fills the arrays.
DipTestMesh dip_test_scene_add_mesh(DipTestScene *scene, uint32_t vertex_count,
                                    uint32_t index_count, int arrays, int material);

// Adds a quad with corner p and sides a and b. The quad faces along a x b. Its uv0 run from (0,0)
// to (u,v) along a and b.
void dip_test_scene_add_quad(DipTestScene *scene, int material, const float p[3], const float a[3],
                             const float b[3], float u, float v);

// --- changes that must not show ------------------------------------------------------------------

// Enlarges a scene with its camera. Places are rounded to whole metres, and that of the camera to
// sixteenths. Objects with a transform keep their mesh, and the light on the surfaces stays.
void dip_test_scene_enlarge(DipTestScene *scene, float factor);

// Moves a scene with its camera. Objects without a transform are moved by their vertices.
void dip_test_scene_move(DipTestScene *scene, const double by[3]);

// Rounds texture coordinates to multiples of 1/8, which floats hold up to 2^21, and adds whole
// numbers along the axes where textures repeat, mirrored or not. They must be even for textures
// that are mirrored.
void dip_test_scene_shift_uv(DipTestScene *scene, const float by[2]);

#endif
