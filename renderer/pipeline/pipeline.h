// The pipeline: draws a list of meshes with the caller's shaders into a target.
//
// A pipeline owns the working memory for targets of one size. It is not thread-safe, but spreads
// its work over a pool of threads. Pictures are the same to the bit for any number of threads and
// any instruction set.
#ifndef DIP_RENDERER_PIPELINE_PIPELINE_H
#define DIP_RENDERER_PIPELINE_PIPELINE_H

#include "renderer/base/api.h"
#include "renderer/base/error.h"
#include "renderer/base/isa.h"
#include "renderer/base/pool.h"
#include "renderer/pipeline/counters.h"
#include "renderer/pipeline/mesh.h"
#include "renderer/pipeline/pattern.h"
#include "renderer/pipeline/shader.h"
#include "renderer/pipeline/target.h"
#include "renderer/pipeline/texture.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { DIP_MAX_CLIP_PLANES = 6 };

// Which triangles are left out. A front face winds counter-clockwise on the screen, +y up.
typedef enum DipCull { DIP_CULL_NONE, DIP_CULL_BACK, DIP_CULL_FRONT } DipCull;

// One mesh with its shaders. Everything pointed to is borrowed for the call that draws it.
typedef struct DipDraw {
    const DipMesh *mesh;
    DipVertexShader *vertex_shader;
    DipFragmentShader *fragment_shader;
    DipFragmentShader *clip_shader; // decides where the surface exists; NULL: everywhere
    int varying_count;              // 0..DIP_MAX_VARYINGS
    // The clip shader gets only the first clip_varying_count varyings, 0..varying_count.
    int clip_varying_count;
    // The last value_only_varying_count varyings, 0..varying_count, come without derivatives, which
    // saves time.
    int value_only_varying_count;
    const void *uniforms;
    const DipSampler *samplers; // up to DIP_MAX_SAMPLERS
    // 4x4, row-major: takes mesh positions to clip space, to cull chunks by their boxes. NULL: the
    // vertex shader runs over every chunk.
    const float *bounds_to_clip;
    DipCull cull;
} DipDraw;

// A render pass: draws into one target.
typedef struct DipPass {
    const DipDraw *draws; // in submission order: of coplanar surfaces the first one stays
    int draw_count;
    int sample_count; // 1, 2, 4, 6 or 8 samples per pixel
    DipPatternKind pattern;
    // Adaptive antialiasing of alpha-clipped draws: their samples are clipped and shaded in groups
    // of this many, each group at the centroid of its covered samples. The pair must be one for
    // which dip_sample_groups_exist (pattern.h). 0 or sample_count: one group, shaded as any other
    // surface.
    int samples_per_group;
    float clear_lin[3]; // linear light, clamped to 0..1
    // User planes in clip space: a surface is seen where dot(plane, clip position) >= 0.
    float clip_planes[DIP_MAX_CLIP_PLANES][4];
    int clip_plane_count;
    DipTarget target;
    // Only this rectangle is needed. Blocks of 8x8 pixels outside it are left untouched; blocks
    // that it meets are the same to the bit as without a region.
    DipTargetRegion region;
    // What is needed of each tile of the target, row by row; it is narrowed further by the region.
    // NULL: all of each tile.
    const DipTileRegion *tile_regions;
} DipPass;

typedef struct DipPipeline DipPipeline;

// width, height: 1..DIP_MAX_TARGET_SIZE pixels. The pool is borrowed and must outlive the pipeline.
// Fails with RANGE, UNSUPPORTED (an instruction set that this machine lacks) or MEMORY.
DIP_API DipPipeline *dip_pipeline_create(DipPool *pool, DipIsa isa, int width, int height,
                                         DipError *err);
// Frees a pipeline that draws nothing. *pipeline may be NULL and becomes NULL.
DIP_API void dip_pipeline_destroy(DipPipeline **pipeline);

// Draws a pass and adds to *counters and *times. It fails with
// - RANGE, CONFLICT or MISSING, with the field as the error's key, if a field does not keep to its
//   comment above; then the target is unchanged;
// - OVERSIZED if 32 bits cannot index the pass's triangles: about 2^31 / (8 + 3 * the largest
//   varying_count) of them, counted once for each draw that uses them, in view or not;
// - MEMORY; then the target's content is undefined.
DIP_API bool dip_pipeline_draw(DipPipeline *pipeline, const DipPass *pass,
                               DipPipelineCounters *counters, DipStageTimes *times, DipError *err);

// A pass, the pipeline that draws it, and what drawing adds to.
typedef struct DipPassWork {
    DipPipeline *pipeline;
    const DipPass *pass;
    DipPipelineCounters *counters;
    DipStageTimes *times;
} DipPassWork;

enum { DIP_MAX_PASSES_AT_ONCE = 8 };

// Draws several independent passes at once: count of 1..DIP_MAX_PASSES_AT_ONCE, each with a
// pipeline and a target of its own, all pipelines on one pool. The pictures are those that
// dip_pipeline_draw makes. A worker that has drawn a tile of one pass draws the same tile of the
// next, so passes that show much the same find each other's texels in the cache.
// same_geometry: the passes differ only in samples, textures and fragment shaders, not in target
// size, region, clip planes or vertex shaders. The geometry stage then runs once for all, and its
// time and counters are added to each. Every pass's stages of tiles are timed apart.
// Errors are those of dip_pipeline_draw, and CONFLICT for pipelines that are not distinct or not on
// one pool.
DIP_API bool dip_pipeline_draw_passes(const DipPassWork *works, int count, bool same_geometry,
                                      DipError *err);

// Allocates what drawing the pass needs, so that drawing it later allocates nothing (except what
// clipping may add). The pass's target and uniforms are not read. Fails with OVERSIZED or MEMORY.
DIP_API bool dip_pipeline_reserve(DipPipeline *pipeline, const DipPass *pass, DipError *err);

#ifdef __cplusplus
}
#endif

#endif
