// The reference path: the picture of docs/picture.md in double precision, plain and slow, one
// sample at a time, no tiles, no SIMD. It reads the scene's description and shares no derived data
// with the fast path. Single-threaded; give each thread its own.
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

// Builds its own decoded mip chains from *def, which is borrowed until destroy.
DIP_API DipReference *dip_reference_create(const DipSceneDef *def, DipError *err);

// Likewise for converged pictures alone: it has neither smaller mip levels nor compressed
// textures. Making it, and making a convergence with it, fail soon after *stop becomes true; stop
// is
DIP_API DipReference *dip_reference_create_for_truth(const DipSceneDef *def,
                                                     const DipCancelFlag *stop, DipError *err);
DIP_API void dip_reference_destroy(DipReference **reference);

// The number of the frames drawn next, as dip_renderer_set_frame_index.
DIP_API void dip_reference_set_frame_index(DipReference *reference, uint64_t frame_index);

// The time of the pictures drawn after: nanoseconds since the path's start, 0 at first.
DIP_API void dip_reference_set_time(DipReference *reference, int64_t time_ns);
// Without it water does not reflect. The def's `show` has no meaning here. Not checked.
DIP_API void dip_reference_set_reflection(DipReference *reference,
                                          const DipReflectionDef *reflection);

// What the fast path should draw with these settings. rgb_lin: width*height*3 doubles, linear
// light, resolved but not encoded, the top row first.
DIP_API bool dip_reference_draw(const DipReference *reference, const DipQuality *quality,
                                const DipPose *pose, int width, int height, double *rgb_lin,
                                DipError *err);

// The converged picture: sample_count (a square) jittered samples in a grid per pixel, each shaded
// at its own place, alpha tested per sample, textures read bilinearly from level 0, positions not
// rounded; the mean in linear light. seed chooses the jitter: two seeds give independent
// pictures.
DIP_API bool dip_reference_converge(const DipReference *reference, const DipPose *pose, int width,
                                    int height, int sample_count, uint32_t seed, double *rgb_lin,
                                    DipError *err);

#ifdef __cplusplus
}
#endif

#endif
