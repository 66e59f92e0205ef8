// A renderer: draws a scene from a pose with one pane's settings into its own frame.
//
// Two renderers may share a scene and a pool, but one pool runs one frame at a time. No function
// here is safe to call on the same renderer from two threads.
#ifndef DIP_RENDERER_SCENE_RENDERER_H
#define DIP_RENDERER_SCENE_RENDERER_H

#include "renderer/base/api.h"
#include "renderer/base/error.h"
#include "renderer/base/isa.h"
#include "renderer/base/pool.h"
#include "renderer/scene/frame.h"
#include "renderer/scene/pose.h"
#include "renderer/scene/quality.h"
#include "renderer/scene/reflection.h"
#include "renderer/scene/scene.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct DipRendererDef {
    DipPool *pool; // borrowed; must outlive the renderer
    DipIsa isa;
    int width;  // pixels, 1..DIP_MAX_FRAME_SIZE
    int height; // likewise
    DipQuality quality;
    // Normal maps and moving clouds are left out: a measuring aid, for pictures of what other
    // renderers can draw too.
    bool plain_surfaces;
    DipReflectionDef reflection;
    bool force_all_effects; // also where the plan finds that they cannot be seen; the same picture
} DipRendererDef;

typedef struct DipRenderer DipRenderer;

// Default settings, 640x480, the best instruction set, no reflection; the pool must be filled in.
DIP_API DipRendererDef dip_renderer_default_def(void);

DIP_API DipRenderer *dip_renderer_create(const DipRendererDef *def, DipError *err);
DIP_API void dip_renderer_destroy(DipRenderer **renderer);

// Each takes effect in the next frame. On failure nothing changes.
DIP_API bool dip_renderer_set_quality(DipRenderer *renderer, const DipQuality *quality,
                                      DipError *err);
DIP_API bool dip_renderer_set_reflection(DipRenderer *renderer, const DipReflectionDef *reflection,
                                         DipError *err);
DIP_API bool dip_renderer_resize(DipRenderer *renderer, int width, int height, DipError *err);

DIP_API DipQuality dip_renderer_quality(const DipRenderer *renderer);

// The number of the next frames, 0 at first; the caller counts. Only its parity matters, and only
// to temporal antialiasing: which of the two sample patterns is drawn with.
DIP_API void dip_renderer_set_frame_index(DipRenderer *renderer, uint64_t frame_index);

// Pictures for mip debugging instead of the flat colours: up to one per level size 1024, 512, ...,
// 8 (index 0..7). A NULL picture keeps the flat colour. Copied.
enum { DIP_MIP_DEBUG_LEVELS = 8 };
DIP_API bool dip_renderer_set_mip_pictures(DipRenderer *renderer,
                                           const DipTextureDef *pictures[DIP_MIP_DEBUG_LEVELS],
                                           DipError *err);

// Draws the scene at a time (nanoseconds since the path's start). The frame is the same to the
// bit for any pool size and instruction set.
DIP_API bool dip_renderer_draw(DipRenderer *renderer, const DipScene *scene, const DipPose *pose,
                               int64_t time_ns, DipFrame *frame, DipError *err);

enum { DIP_MAX_FRAMES_AT_ONCE = 4 };

// Draws the frames of several renderers at once, from one pose: frames[i] is what dip_renderer_draw
// gives for renderers[i], to the bit, in less time. Tiles take turns on each worker, and the
// geometry runs once if the settings differ only in samples and shading (everything but gi); its
// time and counters are then in every frame. count: 1..DIP_MAX_FRAMES_AT_ONCE; the renderers are
// distinct and on one pool.
DIP_API bool dip_renderer_draw_frames(DipRenderer *const *renderers, int count,
                                      const DipScene *scene, const DipPose *pose, int64_t time_ns,
                                      DipFrame *const *frames, DipError *err);

#ifdef __cplusplus
}
#endif

#endif
