// What drawing a frame yields: pixels, counters of work, times and the effects that ran.
#ifndef DIP_RENDERER_SCENE_FRAME_H
#define DIP_RENDERER_SCENE_FRAME_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { DIP_MAX_FRAME_SIZE = 8192 }; // width and height, pixels

// Work done, exact: the same for any thread count, SIMD width and machine.
// X(name, "what it counts")
#define DIP_COUNTER_LIST(X)                                                                        \
    X(passes, "passes drawn")                                                                      \
    X(tiles_drawn, "64x64-pixel tiles of these that were drawn")                                   \
    X(tiles_spared, "tiles that the plan left out, whole passes included")                         \
    X(triangles_in, "triangles of the chunks (up to 128 each) that are not culled whole")          \
    X(triangles_drawn, "triangles left after culling and clipping")                                \
    X(tile_triangles, "triangles times the tiles they are binned to")                              \
    X(sub_blocks_tested, "4x4-pixel blocks tested against a triangle's edges")                     \
    X(sub_blocks_accepted, "of these, blocks wholly inside the triangle")                          \
    X(fragments_clip_tested, "places of alpha-clipped surfaces whose clip map was read")           \
    X(clip_passes, "passes over alpha-clipped triangles, tile by tile")                            \
    X(fragments_shaded, "fragments shaded: pixels times the patches of surface seen in them")      \
    X(samples_shown, "samples that show a surface: covered, nearest, kept by its clip map")        \
    X(pixels_resolved, "pixels whose samples show more than one patch or pass")                    \
    X(texture_probes, "places of texture reads, in the finer of two levels")                       \
    X(texels_fetched, "texels read by these")                                                      \
    X(target_bytes, "bytes of colour that are written to targets")                                 \
    X(fragments_normal_mapped, "fragments whose normal came from a map")                           \
    X(fragments_sky, "fragments of sky with moving clouds")                                        \
    X(fragments_reflecting, "fragments of water that show the reflection")                         \
    X(fragments_mirrored, "of the fragments shaded, those of the reflection")                      \
    X(reflection_bytes, "memory of the reflection's target")                                       \
    X(normal_map_bytes, "memory of normal maps")                                                   \
    X(clip_map_bytes, "memory of the alpha of clip maps")                                          \
    X(cloud_bytes, "memory of the sky's clouds")                                                   \
    X(meshes, "meshes that the scene's objects are drawn from, in view or not")                    \
    X(geometry_bytes, "memory of these: vertices, indices, bounds")

typedef struct DipCounters {
#define DIP_COUNTER_FIELD(name, text) uint64_t name;
    DIP_COUNTER_LIST(DIP_COUNTER_FIELD)
#undef DIP_COUNTER_FIELD
} DipCounters;

// Wall-clock time of a frame and its parts, milliseconds. The stages of a tile overlap on the
// workers; their times are the workers' sums scaled to the wall time of the tile phase.
// X(name, "Title")
#define DIP_STAGE_LIST(X)                                                                          \
    X(geometry, "transform, clip, set-up, bins")                                                   \
    X(raster, "coverage and depth")                                                                \
    X(shading, "fragments and textures")                                                           \
    X(resolve, "samples to pixels")

typedef struct DipStageTimes {
#define DIP_STAGE_FIELD(name, text) double name##_ms;
    DIP_STAGE_LIST(DIP_STAGE_FIELD)
#undef DIP_STAGE_FIELD
    double total_ms;
} DipStageTimes;

// Whether an effect ran in this frame, and why; in the order in which the plan decides them
// (renderer/plan/).
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
void dip_frame_hash(const DipFrame *frame, char hex[33]);

#endif
