// A renderer: draws a scene from a pose, with one set of image-quality settings, into a frame that
// the renderer owns.
//
// Several renderers may share a scene and a pool, but a pool may work on one frame at a time only.
// Two threads must not use the same renderer at once.
#ifndef DIP_RENDERER_SCENE_RENDERER_H
#define DIP_RENDERER_SCENE_RENDERER_H

#include "renderer/base/api.h"
#include "renderer/base/error.h"
#include "renderer/base/isa.h"
#include "renderer/base/pool.h"
#include "renderer/pipeline/readback.h"
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
    DipPool *pool; // borrowed; must outlive the renderer; NULL: the callers' threads do the work
    DipIsa isa;    // an instruction set that this machine has (dip_isa_available)
    int width;     // pixels, 1..DIP_MAX_FRAME_SIZE
    int height;    // pixels, 1..DIP_MAX_FRAME_SIZE
    DipQuality quality;
    // Leaves out normal maps, moving clouds and the reflection, so that measurements can compare
    // with renderers that do not have them.
    bool plain_surfaces;
    DipReflectionDef reflection;
    // Runs every effect that the scene has, even if the plan finds that the effect cannot be seen.
    // The picture is the same.
    bool force_all_effects;
} DipRendererDef;

typedef struct DipRenderer DipRenderer;

// Default settings, 640x480 pixels, the best instruction set of this machine and no reflection. The
// caller fills in the pool.
DIP_API DipRendererDef dip_renderer_default_def(void);

// Fails with RANGE, CONFLICT (see dip_quality_check), UNSUPPORTED (an instruction set that this
// machine lacks) or MEMORY.
DIP_API DipRenderer *dip_renderer_create(const DipRendererDef *def, DipError *err);
// *renderer may be NULL and becomes NULL.
DIP_API void dip_renderer_destroy(DipRenderer **renderer);

// Each of these functions takes effect in the next frame. A function that fails changes nothing.
// They fail as dip_renderer_create does with the same values.
DIP_API bool dip_renderer_set_quality(DipRenderer *renderer, const DipQuality *quality,
                                      DipError *err);
DIP_API bool dip_renderer_set_reflection(DipRenderer *renderer, const DipReflectionDef *reflection,
                                         DipError *err);
DIP_API bool dip_renderer_resize(DipRenderer *renderer, int width, int height, DipError *err);

// Records the work and the time of each tile into DipFrame.tiles, or stops recording. Off at first.
// The pictures and the counters are the same either way. Fails with MEMORY.
DIP_API bool dip_renderer_record_tiles(DipRenderer *renderer, bool on, DipError *err);

DIP_API DipQuality dip_renderer_quality(const DipRenderer *renderer);

// Sets the number of the frame that is drawn next. The caller counts frames; the number is 0 at
// first. Only temporal antialiasing uses it. With taa=alternate, even frames have one sample
// pattern, odd frames the other. With taa=history, the number chooses the part of a pixel by which
// the frame is shifted; the shifts repeat after 16 frames. A frame is blended with those before it
// if its number follows theirs. The history begins anew with a frame of any other number, of an
// earlier time, of another scene or another size, or after a change of the settings or the
// reflection.
DIP_API void dip_renderer_set_frame_index(DipRenderer *renderer, uint64_t frame_index);

// Lets the history begin anew with the next frame, after a cut or a jump in time.
DIP_API void dip_renderer_cut(DipRenderer *renderer);

// Frames that the caller should draw before a frame that stands alone with taa=history, so that its
// history is as long as it matters: the frames with the numbers before it, from the poses that led
// to it.
enum { DIP_FRAMES_BEFORE = 16 };

// Replaces the flat colours of mip debugging by pictures. Picture 0 stands for mip levels of 1024
// texels and more, picture 1 for 512 texels, and so on; picture 7 stands for 8 texels and fewer. A
// level whose picture is NULL keeps its flat colour. If `pictures` is NULL, all levels get their
// flat colours back. The pictures are copied. Fails as dip_texture_create does.
enum { DIP_MIP_DEBUG_LEVELS = 8 };
DIP_API bool dip_renderer_set_mip_pictures(DipRenderer *renderer,
                                           const DipTextureDef *pictures[DIP_MIP_DEBUG_LEVELS],
                                           DipError *err);

// Draws the scene at a time, in nanoseconds since the start of the path. The frame is the same to
// the bit for any number of threads and any instruction set. Fails with RANGE (a pose that
// dip_pose_check refuses, or a scale that would draw more than DIP_MAX_FRAME_SIZE pixels along an
// axis), OVERSIZED (see dip_pipeline_draw) or MEMORY.
DIP_API bool dip_renderer_draw(DipRenderer *renderer, const DipScene *scene, const DipPose *pose,
                               int64_t time_ns, DipFrame *frame, DipError *err);

// Lets the renderer copy shaded pixels when its frame is drawn at once with others, or stops it.
// Off at first. A frame then copies from the first frame of the call whose renderer does not copy,
// if both have the same geometry (see dip_renderer_draw_frames) and the same settings but for aa,
// taa, aaa and asd, without mip colours. Copied are the pixels that show one surface alone, at the
// same triangle in both frames; water that shows a reflection is always shaded. The picture has the
// same bits. The frame's counter fragments_copied counts the copied pixels, and no other counter of
// shading has them. The frame's times are then less than what its settings cost: a frame's times
// are its own only if fragments_copied is 0. An effect whose fragments are all copied counts as
// run. Nothing is copied with force_all_effects, nor from or to a frame whose renderer records
// tiles.
DIP_API void dip_renderer_copy_shading(DipRenderer *renderer, bool on);

enum { DIP_MAX_FRAMES_AT_ONCE = 4 };

// Draws one frame with each of several renderers, all from one pose. frames[i] has the same bits as
// if dip_renderer_draw drew it with renderers[i]. Drawing the frames together takes less time,
// because each worker draws the same tile of every frame in turn. If the renderers have the same gi
// and differ in nothing but their other settings, which affect only samples and shading, the
// geometry stage runs only once for all frames. The geometry stage's time and counters are then
// part of every frame. count is 1..DIP_MAX_FRAMES_AT_ONCE. The renderers must be distinct and on
// one pool. Errors are those of dip_renderer_draw. A count out of range also fails with RANGE.
DIP_API bool dip_renderer_draw_frames(DipRenderer *const *renderers, int count,
                                      const DipScene *scene, const DipPose *pose, int64_t time_ns,
                                      DipFrame *const *frames, DipError *err);

// Reads what the samples of some pixels of the frame show, for example of the frame that was drawn
// last. Draws only the blocks around the readback's region again, into the frame that the renderer
// owns: with the pose, time, settings and frame index of the last frame, its pixels do not change.
// The readback's samples have the sample pattern
// dip_sample_pattern_of(dip_quality_sample_count(...),
//                       dip_pattern_kind(dip_quality_alternates(...), frame_index))
// (pattern.h). With taa=history, they are those of the shifted frame. They show the frame as it is
// before taa=history, post and sharpen filter it. The picture of the reflection that
// DipReflectionDef.show puts into the frame is not part of the samples, nor are blended surfaces.
// Takes about as long as the geometry stage of a frame. Fails as
// dip_renderer_draw does, with RANGE if the region is empty or does not lie in the frame, with
// MISSING if readback->samples is NULL, and with UNSUPPORTED if scale draws a picture of another
// size, whose pixels are not those of the frame.
DIP_API bool dip_renderer_read_samples(DipRenderer *renderer, const DipScene *scene,
                                       const DipPose *pose, int64_t time_ns,
                                       const DipSampleReadback *readback, DipError *err);

#ifdef __cplusplus
}
#endif

#endif
