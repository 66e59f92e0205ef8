// A frame: the result of drawing. It has pixels, counters of work, times and the effects that ran.
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

// Exact counts of the work that the scene's effects did and of the memory that they take.
// X(name, "what it counts")
#define DIP_SCENE_COUNTER_LIST(X)                                                                  \
    X(fragments_lit, "fragments that the scene's own lights light")                                \
    X(fragments_normal_mapped, "fragments whose normal came from a normal map")                    \
    X(fragments_pbr, "fragments of metallic-roughness surfaces")                                   \
    X(fragments_occluded, "fragments of such surfaces with an occlusion map")                      \
    X(fragments_emitting, "fragments of such surfaces that send out light")                        \
    X(fragments_coated, "fragments of such surfaces with a clear coat")                            \
    X(fragments_surrounded, "fragments of such surfaces that see an environment")                  \
    X(fragments_sheen, "fragments of such surfaces with a sheen")                                  \
    X(fragments_transmitting, "fragments of such surfaces that let light through")                 \
    X(fragments_scattering, "fragments of such surfaces that blur what they let through")          \
    X(fragments_blended, "fragments of blended surfaces")                                          \
    X(fragments_shadowed, "fragments that read the shadow map")                                    \
    X(fragments_sky, "fragments of sky with moving clouds")                                        \
    X(fragments_reflecting, "fragments of water that show the reflection")                         \
    X(fragments_mirrored, "fragments shaded to draw the mirrored scene")                           \
    X(fragments_behind, "fragments shaded to draw what lies behind rough glass")                   \
    X(backdrop_texels, "texels of what lies behind rough glass, in all its levels")                \
    X(backdrop_bytes, "bytes of the picture of what lies behind rough glass, and of its levels")   \
    X(shadow_texels, "texels of the shadow map that was drawn")                                    \
    X(shadow_bytes, "bytes of the shadow map")                                                     \
    X(reflection_bytes, "bytes of the mirrored scene's picture")                                   \
    X(normal_map_bytes, "bytes of all normal maps")                                                \
    X(clip_map_bytes, "bytes of the alpha of clip maps and blended textures")                      \
    X(cloud_bytes, "bytes of the textures of skies with clouds")                                   \
    X(vertices_posed, "vertices that a clip moves with skins or morph targets")                    \
    X(meshes, "meshes that the scene's objects are drawn from, in view or not")                    \
    X(geometry_bytes, "bytes of the vertices, indices and bounds of these meshes")                 \
    X(pixels_filtered, "pixels that filters of the finished picture wrote")                        \
    X(pixels_reprojected, "pixels that a history blended with the frame before")                   \
    X(history_bytes, "bytes of the history of temporal AA, with the depths of its frames")         \
    X(edges_found, "pixels at which post-process AA found an edge")

// All counters of a frame: the counters of its render passes, then those of the scene.
#define DIP_COUNTER_LIST(X)                                                                        \
    DIP_PIPELINE_COUNTER_LIST(X)                                                                   \
    DIP_SCENE_COUNTER_LIST(X)

typedef struct DipCounters {
#define DIP_COUNTER_FIELD(name, text) uint64_t name;
    DIP_COUNTER_LIST(DIP_COUNTER_FIELD)
#undef DIP_COUNTER_FIELD
} DipCounters;

// The effects: features, such as the reflection, that a frame can skip if they are not visible.
// They have the order in which the plan (renderer/scene/plan/) decides about them.
// X(name, "title")
#define DIP_EFFECT_LIST(X)                                                                         \
    X(reflection, "reflection")                                                                    \
    X(alpha_clip, "alpha clip")                                                                    \
    X(adaptive_aa, "adaptive AA")                                                                  \
    X(light_map, "light map")                                                                      \
    X(lights, "lights")                                                                            \
    X(shadows, "shadows")                                                                          \
    X(normal_map, "normal maps")                                                                   \
    X(pbr, "metal and gloss")                                                                      \
    X(occlusion, "occlusion maps")                                                                 \
    X(emission, "emission")                                                                        \
    X(coat, "clear coats")                                                                         \
    X(sheen, "sheens")                                                                             \
    X(transmission, "transmission")                                                                \
    X(scattering, "rough glass")                                                                   \
    X(environment, "environment")                                                                  \
    X(blend, "blending")                                                                           \
    X(sky, "clouds")                                                                               \
    X(history, "history")                                                                          \
    X(post, "post-process AA")                                                                     \
    X(upscale, "upscaling")                                                                        \
    X(sharpen, "sharpening")

// Tells whether an effect ran in a frame, and why or why not.
typedef struct DipEffect {
    bool run;
    const char *why; // the reason; static storage
} DipEffect;

typedef struct DipEffects {
#define DIP_EFFECT_FIELD(name, text) DipEffect name;
    DIP_EFFECT_LIST(DIP_EFFECT_FIELD)
#undef DIP_EFFECT_FIELD
} DipEffects;

// Where in the picture a frame's work was done (dip_renderer_record_tiles). For each counter of
// work that is done in tiles (DipTileRecord), the sum of `records` and `mirrored` is the frame's
// counter.
typedef struct DipFrameTiles {
    const DipTileRecord *records; // across * down tiles, row by row; NULL if not recorded
    const uint8_t *mixed;         // DipTileRecording.mixed, width * height bytes
    int across;
    int down;
    // The work and the times of drawing the mirrored scene, the shadow map and the backdrop of
    // rough glass, with their geometry. These are pictures of their own, so their tiles are not
    // those of the frame.
    DipPipelineCounters mirrored;
    DipStageTimes mirrored_times;
} DipFrameTiles;

// The renderer that drew a frame owns its pixels and its tiles. They are valid until that renderer
// draws again, is resized or is destroyed.
typedef struct DipFrame {
    const uint8_t *rgba8; // sRGB, top row first; alpha is 255 in the frames of a DipRenderer
    size_t stride_bytes;
    int width;
    int height;
    DipCounters counters;
    DipStageTimes stages;
    DipEffects effects;
    // All 0 unless the renderer records tiles. Also 0 if scale draws a picture of another size,
    // whose tiles are not those of the frame.
    DipFrameTiles tiles;
} DipFrame;

// Writes a 128-bit hash of a frame's size and pixels as 32 hex digits and a final 0. The hash
// ignores padding and counters. It is FNV-1a in two lanes: it shows whether two pictures are the
// same but does not protect against forgery.
DIP_API void dip_frame_hash(const DipFrame *frame, char hex[33]);

#ifdef __cplusplus
}
#endif

#endif
