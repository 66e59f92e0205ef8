// Scenes made in code for picture tests, each with a pose that shows what it is about.
#ifndef DIP_TESTS_RENDERER_SCENE_SCENES_H
#define DIP_TESTS_RENDERER_SCENE_SCENES_H

#include "renderer/scene/pose.h"
#include "renderer/scene/reflection.h"
#include "renderer/scene/scene.h"

// X(name, "what it is about")
#define DIP_TEST_SCENE_LIST(X)                                                                     \
    X(grazing_checker, "a plane to the horizon, 512-texel checker")                                \
    X(grazing_noise, "the same, 1024-texel noise, rolled by 22.5 degrees")                         \
    X(grazing_rolled, "the same, 256-texel checker, rolled by 45 degrees")                         \
    X(cube_on_plane, "closed mesh over a textured plane, coplanar decal")                          \
    X(fence, "alpha-clipped bars of 4 in 32 texels before a plane")                                \
    X(soup, "400 random triangles, double-sided, vertex colours")                                  \
    X(slivers, "triangles thinner than a pixel and than 1/256 pixel")                              \
    X(huge, "triangles that cross the near plane and reach far beyond the guard band")             \
    X(odd_textures, "1x1, 7x5, 1x9 texels, repeat and clamp, coordinates beyond 0..1")             \
    X(vertex_colours, "vertex colours over a perspective quad, no texture")                        \
    X(lit_sphere, "smooth normals, also scaled unevenly, mirrored and very small")                 \
    X(light_map, "second coordinates, scaled light map, linear encoding")                          \
    X(normal_map,                                                                                  \
      "bumps under light map and sun; coordinates mirrored, without area, on a sphere")            \
    X(sky, "two layers of cloud over a quad to the horizon")                                       \
    X(water, "pools at two heights that reflect what stands in and around them")                   \
    X(water_effects, "a pool under clouds, before a fence and bumps: all effects, mirrored too")

typedef enum DipTestSceneKind {
#define DIP_TEST_SCENE_ENUM(name, text) DIP_TEST_SCENE_##name,
    DIP_TEST_SCENE_LIST(DIP_TEST_SCENE_ENUM)
#undef DIP_TEST_SCENE_ENUM
        DIP_TEST_SCENE_COUNT
} DipTestSceneKind;

enum { DIP_TEST_SCENE_PARTS = 8, DIP_TEST_SCENE_BLOCKS = 64 };

// Owns all that def points to. def points into the struct: it must not be copied or moved.
typedef struct DipTestScene {
    DipSceneDef def;
    DipPose pose;
    DipReflectionDef reflection; // width 0 unless the scene is about it
    DipTextureDef textures[DIP_TEST_SCENE_PARTS];
    DipMaterialDef materials[DIP_TEST_SCENE_PARTS];
    DipMeshDef meshes[DIP_TEST_SCENE_PARTS];
    DipObjectDef objects[DIP_TEST_SCENE_PARTS];
    void *blocks[DIP_TEST_SCENE_BLOCKS];
    int block_count;
} DipTestScene;

const char *dip_test_scene_name(DipTestSceneKind kind);
void dip_test_scene_make(DipTestScene *scene, DipTestSceneKind kind);
void dip_test_scene_free(DipTestScene *scene);

typedef enum DipTestTexture { DIP_TEST_CHECKER, DIP_TEST_NOISE } DipTestTexture;

// A plane 1 m below the eye, seen towards the horizon, with the camera rolled about its axis. The
// texture repeats every metre.
void dip_test_scene_make_grazing(DipTestScene *scene, DipTestTexture texture, int size,
                                 double roll_deg);

// --- parts, for tests that build their own -----------------------------------------------------

// An empty scene: grey background, near plane at 0.1 m, camera at the origin, 60 degrees high.
void dip_test_scene_begin(DipTestScene *scene);

// Zeroed memory that the scene owns.
void *dip_test_scene_alloc(DipTestScene *scene, size_t count, size_t size);

// Each returns the index of what it added. Texels are opaque; they may be written after.
int dip_test_scene_add_texture(DipTestScene *scene, DipTestTexture texture, int width, int height);
int dip_test_scene_add_material(DipTestScene *scene, int colour_texture);

// A normal map of round bumps that repeats, and a sky's data: soft noise. Linear encoding.
int dip_test_scene_add_bumps(DipTestScene *scene, int size);
int dip_test_scene_add_clouds(DipTestScene *scene, int size);
uint8_t *dip_test_scene_texels(DipTestScene *scene, int texture);

// Arrays of a mesh that is being made; those of a kind not asked for are NULL.
typedef struct DipTestMesh {
    float *positions;
    float *normals;
    float *uv0;
    float *uv1;
    float *colours_lin;
    uint32_t *indices;
} DipTestMesh;

enum { DIP_TEST_NORMALS = 1, DIP_TEST_UV0 = 2, DIP_TEST_UV1 = 4, DIP_TEST_COLOURS = 8 };

// Adds a mesh and an object that places it as it is; the arrays are to be filled in.
DipTestMesh dip_test_scene_add_mesh(DipTestScene *scene, uint32_t vertex_count,
                                    uint32_t index_count, int arrays, int material);

// A quad of corner p and sides a and b, facing along a x b, uv0 (0,0)..(u,v) along a and b.
void dip_test_scene_add_quad(DipTestScene *scene, int material, const float p[3], const float a[3],
                             const float b[3], float u, float v);

#endif
