// What drawing costs: exact counters of work, and times by stage.
#ifndef DIP_RENDERER_PIPELINE_COUNTERS_H
#define DIP_RENDERER_PIPELINE_COUNTERS_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Work done. The counts are exact: they are the same for any thread count, SIMD width and machine.
// X(name, "what it counts")
#define DIP_PIPELINE_COUNTER_LIST(X)                                                               \
    X(passes, "render passes drawn")                                                               \
    X(tiles_drawn, "64x64-pixel tiles drawn in these passes")                                      \
    X(tiles_spared, "tiles left out because nothing visible needs them")                           \
    X(triangles_in, "triangles of mesh chunks that are not culled as a whole")                     \
    X(triangles_drawn, "triangles left after culling and clipping")                                \
    X(tile_triangles, "pairs of a triangle and a tile that it is binned to")                       \
    X(sub_blocks_tested, "4x4-pixel blocks tested against a triangle's edges")                     \
    X(sub_blocks_accepted, "tested blocks that lie wholly inside the triangle")                    \
    X(fragments_clip_tested, "fragments of alpha-clipped surfaces whose clip map was read")        \
    X(clip_sample_groups, "sample groups drawn of alpha-clipped triangles, tile by tile")          \
    X(fragments_shaded, "fragments shaded: one per pixel and patch of surface seen in it")         \
    X(samples_shown, "samples that show a surface: covered, nearest, kept by its clip map")        \
    X(pixels_resolved, "pixels whose samples show more than one fragment")                         \
    X(texture_probes, "positions at which textures were read, in the finer of two levels")         \
    X(texels_fetched, "texels read for these probes")                                              \
    X(target_bytes, "bytes of colour written to targets")

enum { DIP_SHADER_COUNT_MAX = 4 };

typedef struct DipPipelineCounters {
#define DIP_COUNTER_FIELD(name, text) uint64_t name;
    DIP_PIPELINE_COUNTER_LIST(DIP_COUNTER_FIELD)
#undef DIP_COUNTER_FIELD
    // Counts that the caller's fragment shaders add to (DipFragmentBatch.work). The pipeline only
    // sums them; what each one means is the caller's choice.
    uint64_t shader_counts[DIP_SHADER_COUNT_MAX];
} DipPipelineCounters;

// Wall-clock time by stage, in milliseconds. The stages of a tile overlap on the workers: their
// times are summed over the workers and scaled to the wall time of the whole tile phase.
// X(name, "what happens in it")
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

#ifdef __cplusplus
}
#endif

#endif
