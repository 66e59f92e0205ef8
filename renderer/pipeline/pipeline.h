// The pipeline: draws a list of meshes with the caller's shaders into a target.
//
// One pipeline owns the scratch of one picture size; it is not thread-safe, but spreads its work
// over the pool. Pictures are the same to the bit for any pool size and instruction set.
#ifndef DIP_RENDERER_PIPELINE_PIPELINE_H
#define DIP_RENDERER_PIPELINE_PIPELINE_H

#include "renderer/base/error.h"
#include "renderer/base/isa.h"
#include "renderer/base/pool.h"
#include "renderer/pipeline/mesh.h"
#include "renderer/pipeline/pattern.h"
#include "renderer/pipeline/shader.h"
#include "renderer/scene/frame.h"

#include <stdbool.h>
#include <stdint.h>

enum { DIP_MAX_CLIP_PLANES = 6 };

typedef enum DipCull { DIP_CULL_NONE, DIP_CULL_BACK, DIP_CULL_FRONT } DipCull;

// One mesh with its shaders. Everything pointed to is borrowed for the call.
typedef struct DipDraw {
    const DipMesh *mesh;
    DipVertexShader *vertex_shader;
    DipFragmentShader *fragment_shader;
    DipFragmentShader *clip_shader; // NULL: opaque. Runs while coverage is decided
    int slot_count;                 // 0..DIP_MAX_SLOTS
    int clip_slot_count;            // 0..slot_count: the clip shader gets the first ones only
    int plain_slot_count;           // 0..slot_count: of the last ones no shader reads derivatives
    const void *uniforms;
    const DipSampler *samplers; // up to DIP_MAX_SAMPLERS
    // 4x4, row-major: takes mesh positions to clip space, only to cull what is out of view by its
    // bounds; NULL: nothing is culled before the vertex shader.
    const float *bounds_to_clip;
    DipCull cull; // a front face winds counter-clockwise seen with +y up
} DipDraw;

// Where the picture goes: sRGB bytes R, G, B, 255; the top row first.
// A pass' fragment shaders may sample the target of a pass before (DipSampleTarget in shader.h).
struct DipTarget {
    uint8_t *rgba8;
    size_t stride_bytes; // a multiple of 4, at least 4 * width
    int width;           // as the pipeline's
    int height;
};

// Pixels x0..x1-1 by y0..y1-1. All 0: the whole target.
typedef struct DipRegion {
    int x0, y0, x1, y1;
} DipRegion;

// Pixels x0..x1-1 by y0..y1-1 of a tile of 64x64, from its corner; multiples of 8. All 0: none.
typedef struct DipTilePart {
    uint8_t x0, y0, x1, y1;
} DipTilePart;

typedef struct DipPass {
    const DipDraw *draws; // in submission order: of coplanar surfaces the first stays
    int draw_count;
    int sample_count; // 1, 2, 4, 6 or 8
    DipPatternKind pattern;
    // Of alpha-clipped draws: 0 or sample_count: one pass, shaded as any other surface; else one of
    // dip_sample_passes_exist, each pass clipped and shaded at the centroid of its own samples.
    int samples_per_pass;
    float clear_lin[3];
    // User planes in clip space: seen where dot(plane, clip position) >= 0.
    float clip_planes[DIP_MAX_CLIP_PLANES][4];
    int clip_plane_count;
    DipTarget target;
    // The part of the target that is wanted. Blocks (8x8 pixels from the corner) that it does not
    // meet are neither drawn nor cleared; the others hold what they would without it, to the bit.
    DipRegion region;
    // Likewise what is wanted of each tile of the target, row by row: no more than the region asks
    // for. NULL: all of it.
    const DipTilePart *tile_parts;
} DipPass;

typedef struct DipPipeline DipPipeline;

// width and height: 1..DIP_MAX_FRAME_SIZE pixels. The pool is borrowed and must outlive the
// pipeline.
DipPipeline *dip_pipeline_create(DipPool *pool, DipIsa isa, int width, int height, DipError *err);
void dip_pipeline_destroy(DipPipeline **pipeline);

// What the fields' comments ask for is asserted in debug builds and not checked in others.
// Draws a pass and adds to *counters and *times. Fails only when memory for the pass' triangles
// runs out, or with OVERSIZED when they are more than 32 bits index: about 2^31 / (8 + 3 * the
// largest slot_count), each counted as often as draws use it, whether it is in view or not. Then
// the target's content is undefined.
bool dip_pipeline_draw(DipPipeline *pipeline, const DipPass *pass, DipCounters *counters,
                       DipStageTimes *times, DipError *err);

// A pass and what is added to.
typedef struct DipPassWork {
    DipPipeline *pipeline;
    const DipPass *pass;
    DipCounters *counters;
    DipStageTimes *times;
} DipPassWork;

// Draws two passes into two targets at once, with two pipelines of one pool: a worker that has
// drawn a tile of one draws the other's next, which shows much the same, and finds its texels in
// the cache. The pictures are those that dip_pipeline_draw makes. same_geometry: the passes differ
// in samples, textures and fragment shaders alone, not in target size, region, planes or what
// vertex shaders do; geometry then runs once, keeps what any sample of either may show, and its
// time and counters are added to both. Times of tiles are each pass' own.
bool dip_pipeline_draw_pair(const DipPassWork works[2], bool same_geometry, DipError *err);

// Makes the room that drawing the pass takes, so that drawing it later allocates nothing (but for
// what clipping may add). The pass' target and uniforms are not read.
bool dip_pipeline_reserve(DipPipeline *pipeline, const DipPass *pass, DipError *err);

#endif
