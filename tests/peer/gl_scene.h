// A scene description in OpenGL's memory, and the drawing of its objects.
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
    int features; // features (surfaces.h) of the program that draws the mesh
    float min[3]; // corners of the bounding box
    float max[3];
} DipGlMesh;

// A sampler object for each pair of address modes.
typedef struct DipGlSamplers {
    GLuint name[2][2]; // [wrap_u][wrap_v]
} DipGlSamplers;

typedef struct DipGlScene {
    const DipSceneDef *def; // the description, borrowed
    DipGlMesh *meshes;      // one per mesh
    GLuint *textures;       // one per texture; 0 if no material uses it
    DipGlProgram programs[DIP_PEER_SURFACE_COUNT];
    DipGlSamplers colour;
    DipGlSamplers light_map;
} DipGlScene;

// Uploads the scene. def is borrowed until the scene is freed. On failure *scene is freed.
bool dip_gl_scene_make(const DipGl *gl, const DipSceneDef *def, DipGlScene *scene, DipError *err);
// Frees the scene's memory, but not OpenGL's objects, which belong to the context.
void dip_gl_scene_free(DipGlScene *scene);

// Sets the anisotropy of colour textures, 1 (trilinear) to 16. Light maps stay trilinear.
void dip_gl_scene_set_anisotropy(const DipGl *gl, const DipGlScene *scene, int max_anisotropy);

// Draws the objects in the scene's order into the bound target. Skips objects whose bounding box is
// out of view.
void dip_gl_scene_draw(const DipGl *gl, const DipGlScene *scene, const DipPose *pose,
                       double aspect);

#endif
