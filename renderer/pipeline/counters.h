// What drawing costs: exact counters of work, and times by stage.
#ifndef DIP_RENDERER_PIPELINE_COUNTERS_H
#define DIP_RENDERER_PIPELINE_COUNTERS_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Work done, as X(name, "what it counts"). A sample group is a set of samples of one pixel that
// adaptive antialiasing clips and shades together (pattern.h). A patch is a small group of
// triangles that join smoothly (patch.h). A probe is one bilinear read of a mip level.
// The counts are exact: they are the same for any thread count, SIMD width and machine.
#define DIP_PIPELINE_COUNTER_LIST(X)                                                               \
    X(passes, "render passes drawn")                                                               \
    X(tiles_drawn, "64x64-pixel tiles drawn in these passes")                                      \
    X(tiles_spared, "tiles not drawn because nothing visible needs them")                          \
    X(draws_in_view, "draws (objects) of which some chunk may be in view")                         \
    X(draws_culled, "draws left out as a whole because they are out of view")                      \
    X(triangles_in, "triangles of mesh chunks that are not culled as a whole")                     \
    X(triangles_drawn, "triangles left after culling and clipping")                                \
    X(tile_triangles, "triangles binned to tiles: one per triangle and tile")                      \
    X(sub_blocks_tested, "4x4-pixel blocks tested against a triangle's edges")                     \
    X(sub_blocks_accepted, "tested blocks that lie wholly inside the triangle")                    \
    X(fragments_clip_tested, "fragments of alpha-clipped surfaces whose clip map was read")        \
    X(clip_sample_groups, "sample groups drawn, summed over alpha-clipped triangles")              \
    X(fragments_shaded, "fragments shaded: one per pixel and visible patch")                       \
    X(fragments_copied,                                                                            \
      "fragments copied from another pass that shaded them; not among those shaded")               \
    X(fragments_of_blocks, "shaded fragments of 4x4-pixel blocks that one draw fills alone")       \
    X(shader_batches, "calls of fragment shaders: up to 256 fragments of one draw in one tile")    \
    X(fragments_ordered, "fragments of ordered draws (state.h): one per pixel and triangle")       \
    X(samples_shown, "samples that show a surface: covered, nearest, kept by its clip map")        \
    X(pixels_resolved, "pixels whose samples show more than one fragment")                         \
    X(texture_probes, "texture probes in the finer mip level of each read")                        \
    X(clip_probes, "texture probes of clip shaders; texture_probes holds them, too")               \
    X(texels_fetched, "texels read for all probes, in both levels")                                \
    X(target_bytes, "bytes of colour written to targets")

enum { DIP_SHADER_COUNT_MAX = 16 };

typedef struct DipPipelineCounters {
#define DIP_COUNTER_FIELD(name, text) uint64_t name;
    DIP_PIPELINE_COUNTER_LIST(DIP_COUNTER_FIELD)
#undef DIP_COUNTER_FIELD
    // Counts that the caller's fragment shaders add to (DipFragmentBatch.work). The pipeline only
    // sums these counts; the caller decides what each of them means.
    uint64_t shader_counts[DIP_SHADER_COUNT_MAX];
} DipPipelineCounters;

// Wall-clock time by stage, in milliseconds. The three stages after geometry run per tile and
// overlap on the worker threads. Their times are summed over the workers; then they are scaled so
// that the sums of all passes drawn at once add up to the wall-clock time of drawing the tiles.
// The list has X(name, "what happens in it").
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

// The work and the times of drawing one tile of a pass.
typedef struct DipTileRecord {
    // Only counters of work that is done in the tile are set; their sums over all tiles of a pass
    // are the pass's counters. The geometry stage runs before the tiles. Therefore `passes`,
    // `tiles_spared`, `draws_in_view`, `draws_culled`, `triangles_in`, `triangles_drawn`,
    // `tile_triangles` and `target_bytes` are 0. `tiles_drawn` is 1, or 0 if the tile is spared.
    DipPipelineCounters counters;
    // Wall-clock time of the worker that drew the tile, in nanoseconds.
    int64_t raster_ns;
    int64_t shading_ns;
    int64_t resolve_ns;
} DipTileRecord;

// Where a pipeline records what happens in the tiles. The caller owns the arrays.
typedef struct DipTileRecording {
    DipTileRecord *tiles; // one per tile (DIP_TARGET_TILE) of the target, row by row
    // One byte per pixel of the target, rows packed: 1 if the pixel's samples show more than one
    // fragment of plain draws. The sum of a tile is its counter `pixels_resolved`, or less if plain
    // draws follow ordered ones (state.h) in it. NULL: not recorded.
    uint8_t *mixed;
} DipTileRecording;

#ifdef __cplusplus
}
#endif

#endif
