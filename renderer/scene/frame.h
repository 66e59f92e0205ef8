// What drawing a frame yields: pixels, counters of work, times and the effects that ran.
#ifndef DIP_RENDERER_SCENE_FRAME_H
#define DIP_RENDERER_SCENE_FRAME_H

#include "renderer/base/api.h"
#include "renderer/pipeline/counters.h"
#include "renderer/pipeline/target.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { DIP_MAX_FRAME_SIZE = DIP_MAX_TARGET_SIZE }; // largest width and height, in pixels

// Exact counts of what the scene's effects did and hold.
// X(name, "what it counts")
#define DIP_SCENE_COUNTER_LIST(X)                                                                  \
    X(fragments_normal_mapped, "fragments whose normal came from a normal map")                    \
    X(fragments_sky, "fragments of sky with moving clouds")                                        \
    X(fragments_reflecting, "fragments of water that show the reflection")                         \
    X(fragments_mirrored, "fragments shaded to draw the reflection's picture")                     \
    X(reflection_bytes, "memory of the reflection's target")                                       \
    X(normal_map_bytes, "memory of normal maps")                                                   \
    X(clip_map_bytes, "memory of the alpha of clip maps")                                          \
    X(cloud_bytes, "memory of the sky's clouds")                                                   \
    X(meshes, "meshes that the scene's objects are drawn from, in view or not")                    \
    X(geometry_bytes, "memory of these meshes: vertices, indices, bounds")

// All counters of a frame: those of its passes, then those of the scene.
#define DIP_COUNTER_LIST(X)                                                                        \
    DIP_PIPELINE_COUNTER_LIST(X)                                                                   \
    DIP_SCENE_COUNTER_LIST(X)

typedef struct DipCounters {
#define DIP_COUNTER_FIELD(name, text) uint64_t name;
    DIP_COUNTER_LIST(DIP_COUNTER_FIELD)
#undef DIP_COUNTER_FIELD
} DipCounters;

// Whether an effect ran in this frame, and why; in the order in which the plan decides them
// (renderer/scene/plan/).
// X(name, "Title")
#define DIP_EFFECT_LIST(X)                                                                         \
    X(reflection, "reflection")                                                                    \
    X(alpha_clip, "alpha clip")                                                                    \
    X(adaptive_aa, "adaptive AA")                                                                  \
    X(light_map, "light map")                                                                      \
    X(normal_map, "normal maps")                                                                   \
    X(sky, "clouds")

typedef struct DipEffect {
    bool run;
    const char *why; // static storage
} DipEffect;

typedef struct DipEffects {
#define DIP_EFFECT_FIELD(name, text) DipEffect name;
    DIP_EFFECT_LIST(DIP_EFFECT_FIELD)
#undef DIP_EFFECT_FIELD
} DipEffects;

// Owned by the renderer that drew it and valid until it draws, resizes or is destroyed.
typedef struct DipFrame {
    const uint8_t *rgba8; // sRGB, alpha 255, the top row first
    size_t stride_bytes;
    int width;
    int height;
    DipCounters counters;
    DipStageTimes stages;
    DipEffects effects;
} DipFrame;

// 128-bit hash of the frame's pixels (not of its padding or counters) as 32 hex digits. FNV-1a in
// two lanes: guards determinism, is no protection against forgery.
DIP_API void dip_frame_hash(const DipFrame *frame, char hex[33]);

#ifdef __cplusplus
}
#endif

#endif
