// A scene description in OpenGL's memory, and how its objects are drawn.
#ifndef DIP_TESTS_PEER_GL_SCENE_H
#define DIP_TESTS_PEER_GL_SCENE_H

#include "renderer/scene/pose.h"
#include "renderer/scene/scene.h"
#include "tests/peer/gl.h"
#include "tests/peer/gl_program.h"

typedef struct DipGlMesh {
    GLuint vertex_array;
    GLsizei index_count;
    int material;
    int features; // of the program that draws it
    float min[3]; // bounds
    float max[3];
} DipGlMesh;

// A sampler for each pair of address modes.
typedef struct DipGlSamplers {
    GLuint name[2][2]; // [wrap_u][wrap_v]
} DipGlSamplers;

typedef struct DipGlScene {
    const DipSceneDef *def; // borrowed
    DipGlMesh *meshes;      // per mesh
    GLuint *textures;       // per texture; 0 where no material uses it
    DipGlProgram programs[DIP_GL_PROGRAM_COUNT];
    DipGlSamplers colour;
    DipGlSamplers light_map;
} DipGlScene;

// Uploads everything. def is borrowed until the scene is freed. On failure *scene is freed.
bool dip_gl_scene_make(const DipGl *gl, const DipSceneDef *def, DipGlScene *scene, DipError *err);
void dip_gl_scene_free(DipGlScene *scene); // OpenGL's objects end with the context

// 1 (trilinear) to 16, for colour textures; light maps stay trilinear.
void dip_gl_scene_set_anisotropy(const DipGl *gl, const DipGlScene *scene, int max_anisotropy);

// Draws all objects that a box test does not exclude, in their order, into the bound target.
void dip_gl_scene_draw(const DipGl *gl, const DipGlScene *scene, const DipPose *pose,
                       double aspect);

#endif
