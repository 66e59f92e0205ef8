// Scenes of metallic-roughness and blended surfaces, made in code.
#ifndef DIP_TESTS_RENDERER_SCENE_AUTHOR_SCENES_H
#define DIP_TESTS_RENDERER_SCENE_AUTHOR_SCENES_H

#include "renderer/scene/pose.h"
#include "renderer/scene/reflection.h"
#include "renderer/scene/scene.h"

enum { AUTHOR_PARTS = 24, AUTHOR_BLOCKS = 64 };

// A scene that owns everything that def points to. It must not be copied or moved.
typedef struct AuthorScene {
    DipSceneDef def;
    DipPose pose;
    DipReflectionDef reflection; // width 0 until author_add_water
    DipTextureDef textures[AUTHOR_PARTS];
    DipMaterialDef materials[AUTHOR_PARTS];
    DipPbrDef pbrs[AUTHOR_PARTS]; // of the materials with the same indices
    DipMeshDef meshes[AUTHOR_PARTS];
    DipObjectDef objects[AUTHOR_PARTS];
    DipLightDef lights[4];
    DipLightingDef lighting; // def.lighting points here if the test lights the scene
    void *blocks[AUTHOR_BLOCKS];
    int block_count;
} AuthorScene;

// Begins an empty scene with a black background and a camera at (0, 0, 8) that looks along -z with
// a vertical field of view of 36 degrees.
void author_begin(AuthorScene *scene);
void author_free(AuthorScene *scene);

// Adds a lit white material with a metallic-roughness surface that has no maps: a dielectric of
// index 1.5. Returns its index.
int author_add_pbr(AuthorScene *scene, float metallic, float roughness);

// Adds a texture of size x size opaque texels, all 128, and returns its index.
int author_add_texture(AuthorScene *scene, int size, DipEncoding encoding);
uint8_t *author_texels(AuthorScene *scene, int texture);

// Adds a sphere, or a quad with corner p and sides a and b that faces along a x b, as a mesh and an
// object. Both have normals, and texture coordinates 0..1 in both sets. Returns the object's index.
int author_add_sphere(AuthorScene *scene, int material, const float centre[3], float radius);
int author_add_quad(AuthorScene *scene, int material, const float p[3], const float a[3],
                    const float b[3]);

// Adds dark water at a height of -1, below the middle of the picture. Returns its material. The
// mirrored picture has the given size in pixels.
int author_add_water(AuthorScene *scene, int width, int height);

// Makes one mesh of the meshes of the objects first..last, which must be the last ones, in this
// order. If `linked`, triangles without area connect each part with the next one. The new object
// takes the place of the first one, whose index is returned.
int author_join(AuthorScene *scene, int first, int last, bool linked);

// --- whole scenes --------------------------------------------------------------------------------

// 18 balls of radius 0.45: three rows of metallic 1, 0.5 and 0, six columns of roughness 0 to 1.
// All have the same golden colour.
enum { AUTHOR_BALL_ROWS = 3, AUTHOR_BALL_COLUMNS = 6 };
void author_make_balls(AuthorScene *scene);
void author_ball(int row, int column, double centre[3], float *metallic, float *roughness);
extern const float author_gold_lin[3];

// Balls and a wall with all parts of metallic-roughness surfaces: maps, coat, sheen, emission, both
// sides,
// and three lights of the scene.
void author_make_parts(AuthorScene *scene);

// Blended panes and balls, some of them double-sided or textured, before and behind a wall.
void author_make_panes(AuthorScene *scene);

// The panes and the ball of author_make_panes as glass: tinted, partly transmissive, coated,
// double-sided, with a texture of alpha, and with a sheen. The materials 0 to 3 are glass.
void author_make_glass(AuthorScene *scene);

#endif
