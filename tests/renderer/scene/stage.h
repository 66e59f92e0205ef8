// Scenes that tests draw with a renderer of their own, and the same pictures from the reference.
// What cannot be made or drawn fails the running cmocka test and prints the reason.
#ifndef DIP_TESTS_RENDERER_SCENE_STAGE_H
#define DIP_TESTS_RENDERER_SCENE_STAGE_H

#include "renderer/catalogue/scenes.h"
#include "renderer/scene/renderer.h"
#include "tests/renderer/scene/image.h"

#include <stdint.h>

// A scene, and a renderer for it on a pool of its own.
typedef struct Stage {
    DipPool *pool;
    DipScene *scene;
    DipRenderer *renderer;
    DipRendererDef def;        // of the renderer when it was made
    const DipSceneDef *source; // of the scene; borrowed
    DipTestScene *made;        // the scene that stage_open_kind made, or NULL; owned
} Stage;

// Returns the default description of a renderer with a size in pixels and settings like
// "aa=4,af=8". Settings that the text leaves out get their defaults.
DipRendererDef stage_def(int width, int height, const char *settings);

// Makes a renderer without a stage. The caller destroys it.
DipRenderer *stage_make_renderer(const DipRendererDef *def);

// Makes a scene from its description, and a renderer on a pool of `threads` threads. The pool also
// makes the scene. def.pool is ignored.
Stage stage_open(const DipSceneDef *source, DipRendererDef def, int threads);

// Makes a scene of a kind and opens a stage for it. def.reflection is ignored: the renderer gets
// the reflection of the scene.
Stage stage_open_kind(DipTestSceneKind kind, DipRendererDef def, int threads);

void stage_close(Stage *stage);

// Draws a frame. Its pixels stay valid until the stage draws again or is closed.
DipFrame stage_draw(const Stage *stage, const DipPose *pose, int64_t time_ns);

// Selects settings, with defaults for those that the text leaves out, and draws the scene of
// stage_open_kind from its own pose at time 0.
DipFrame stage_draw_kind(const Stage *stage, const char *settings);

// Draws a scene on one thread, from its own pose at time 0, and copies the pixels. `pixels` has
// room for width * height of them.
void stage_draw_scene(const DipTestScene *scene, int width, int height, const char *settings,
                      uint32_t *pixels);

// --- the reference -------------------------------------------------------------------------------

// Draws the picture of a stage's renderer with the reference: the same scene, size, settings and
// reflection, at time 0. Returns width * height * 3 values in linear light, which the caller frees.
// The description of the scene must still be the one that the stage was opened with.
double *stage_draw_reference(const Stage *stage, const DipPose *pose);

// Draws a picture with both renderers, prints its errors in a line that begins with the name and
// the settings, and checks that they stay within the bounds (see dip_image_check). pixel_lin of the
// bounds also is the error from which on pixels are counted in the line. Returns the frame.
DipFrame stage_compare(const Stage *stage, const DipPose *pose, const char *name,
                       const char *settings, const DipImageBounds *bounds);

#endif
