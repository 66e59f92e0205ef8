// The reference renderer. It draws the picture that docs/picture.md defines, in double precision,
// one sample at a time, without tiles or SIMD: plain and slow. It reads the scene's description and
// shares no derived data with the fast renderer. It is single-threaded; give each thread a
// reference of its own. Functions that fail return NULL or false; err may be NULL.
#ifndef DIP_RENDERER_REFERENCE_REFERENCE_H
#define DIP_RENDERER_REFERENCE_REFERENCE_H

#include "renderer/base/api.h"
#include "renderer/base/error.h"
#include "renderer/scene/pose.h"
#include "renderer/scene/quality.h"
#include "renderer/scene/reflection.h"
#include "renderer/scene/scene.h"

#include <stdint.h>

// A flag that another thread may set while the reference works.
#ifdef __cplusplus
#include <atomic>
typedef std::atomic_bool DipCancelFlag;
extern "C" {
#else
#include <stdatomic.h>
typedef atomic_bool DipCancelFlag;
#endif

typedef struct DipReference DipReference;

// Creates a reference for *def, which is borrowed until destroy. *def must be a description that
// dip_scene_create accepts: the reference checks its indices, near plane, motion and texture sizes,
// but not every number. The reference decodes its own mip chains. Fails with RANGE or MEMORY.
DIP_API DipReference *dip_reference_create(const DipSceneDef *def, DipError *err);

// Creates a reference that draws converged pictures only. It has neither smaller mip levels nor
// compressed textures. This function, dip_reference_converge and dip_convergence_create with this
// reference fail with RUNTIME soon after *stop becomes true. If stop is NULL, they never stop
// early. stop is borrowed until destroy. Otherwise fails as dip_reference_create does.
DIP_API DipReference *dip_reference_create_for_truth(const DipSceneDef *def,
                                                     const DipCancelFlag *stop, DipError *err);
// *reference may be NULL and becomes NULL.
DIP_API void dip_reference_destroy(DipReference **reference);

// Sets the number of the frame that is drawn next, as dip_renderer_set_frame_index does.
DIP_API void dip_reference_set_frame_index(DipReference *reference, uint64_t frame_index);

// Sets the time of the pictures drawn next, in nanoseconds since the start of the path; 0 at first.
DIP_API void dip_reference_set_time(DipReference *reference, int64_t time_ns);
// Sets how water reflects. Without a call, water does not reflect. The def's `show` has no effect
// here. The def is copied and not checked: it must be one that dip_renderer_set_reflection accepts.
DIP_API void dip_reference_set_reflection(DipReference *reference,
                                          const DipReflectionDef *reflection);

// Draws what the fast renderer should draw with these settings. taa=history, post and sharpen count
// as off, because they filter finished pictures. Shadows are exact with every size of the shadow
// map. rgb_lin receives width * height * 3 doubles, the top row first, in linear light: resolved
// but not encoded. Fails with RANGE (a pose that dip_pose_check refuses, a step, or a width or
// height outside 1..DIP_MAX_FRAME_SIZE, also of the picture that scale draws), CONFLICT (see
// dip_quality_check), UNSUPPORTED (the reference is for truths) or MEMORY.
DIP_API bool dip_reference_draw(const DipReference *reference, const DipQuality *quality,
                                const DipPose *pose, int width, int height, double *rgb_lin,
                                DipError *err);

// Draws the converged picture. Each pixel has sample_count samples (a square number), jittered
// within the cells of a grid. Each sample is shaded at its own position, with its own alpha test.
// Textures are read bilinearly from level 0, and positions are not rounded. If the scene has a
// directional light, the strongest one casts exact shadows. A pixel is the mean of its samples in
// linear light. seed selects the jitter: two seeds give independent pictures. rgb_lin: as in
// dip_reference_draw; its content is undefined after a failure. Fails with RANGE (pose, size or
// sample_count), RUNTIME (stopped) or MEMORY.
DIP_API bool dip_reference_converge(const DipReference *reference, const DipPose *pose, int width,
                                    int height, int sample_count, uint32_t seed, double *rgb_lin,
                                    DipError *err);

#ifdef __cplusplus
}
#endif

#endif
