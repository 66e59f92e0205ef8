// The pipeline: draws a list of meshes with the caller's shaders into a target.
//
// A pipeline owns the working memory for targets of one size. It spreads its work over a pool of
// threads, but only one thread may call it at a time. Several threads may draw with different
// pipelines of one pool; they take turns in using the pool. Pictures are the same to the bit for
// any number of threads and any instruction set.
#ifndef DIP_RENDERER_PIPELINE_PIPELINE_H
#define DIP_RENDERER_PIPELINE_PIPELINE_H

#include "renderer/base/api.h"
#include "renderer/base/error.h"
#include "renderer/base/isa.h"
#include "renderer/base/pool.h"
#include "renderer/pipeline/batch.h"
#include "renderer/pipeline/counters.h"
#include "renderer/pipeline/depth.h"
#include "renderer/pipeline/mesh.h"
#include "renderer/pipeline/pattern.h"
#include "renderer/pipeline/readback.h"
#include "renderer/pipeline/samples.h"
#include "renderer/pipeline/shader.h"
#include "renderer/pipeline/state.h"
#include "renderer/pipeline/target.h"
#include "renderer/pipeline/texture.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { DIP_MAX_CLIP_PLANES = 6 };

// The triangles that a draw leaves out. A front face winds counter-clockwise on the screen, +y up.
typedef enum DipCull { DIP_CULL_NONE, DIP_CULL_BACK, DIP_CULL_FRONT } DipCull;

// Takes mesh positions to clip space: to_clip * (position - origin, 1). The matrix is row-major.
typedef struct DipExactTransform {
    double to_clip[16];
    float origin[3];
    // Corners are far away if a clip coordinate has a greater magnitude. 0: the pipeline decides.
    float far_coordinate;
} DipExactTransform;

// A draw: one mesh with its shaders. Everything that its pointers refer to is borrowed for the call
// that draws it.
typedef struct DipDraw {
    const DipMesh *mesh;
    DipVertexShader *vertex_shader;
    DipFragmentShader *fragment_shader; // may be NULL in a pass without colours
    DipFragmentShader *clip_shader;     // cuts away parts of the surface; NULL: cuts nothing away
    // 0..DIP_MAX_VARYINGS. The vertex shader may write more varyings, which are dropped, so that a
    // draw that needs fewer can share it. Fragment shaders read the varyings from this number on as
    // 0. That is no error, since the pipeline does not see what shaders read in their arrays, but
    // it is a first reason to look for where colours are black. A texture read at varyings that the
    // draw does not have is an error (shader.h).
    int varying_count;
    // The clip shader gets only the first clip_varying_count varyings, 0..varying_count.
    int clip_varying_count;
    // Fragment shaders get the last value_only_varying_count varyings, 0..varying_count, without
    // derivatives, which saves time.
    int value_only_varying_count;
    // The shaders compute the last computed_varying_count of the DIP_MAX_VARYINGS varyings of their
    // batches themselves, with derivatives, to read textures there. They are 0 at first.
    // 0..DIP_MAX_VARYINGS - varying_count.
    int computed_varying_count;
    // Bit s: the shaders use varying s only modulo 2, as a coordinate along which all their
    // textures repeat or mirror (DIP_WRAP_REPEAT, DIP_WRAP_MIRROR). The pipeline may then add even
    // whole numbers to the varying, the same at all corners of a triangle but different from
    // triangle to triangle, so that large coordinates keep their precision near the eye.
    // Derivatives do not change.
    uint32_t repeating_varyings;
    // Bit s: varying s is the clip coordinate w. At the new corners of triangles that are cut, the
    // pipeline then sets it to their w, which interpolation in floats misses where a triangle that
    // reaches far away passes close by the eye.
    uint32_t w_varyings;
    const void *uniforms;
    const DipSampler *samplers; // at most DIP_MAX_SAMPLERS
    // 4x4 matrix, row-major, that takes mesh positions to clip space. The pipeline uses it to cull
    // chunks of the mesh by their boxes. Set it if much of a mesh may be out of view and the vertex
    // shader moves positions by this matrix alone. NULL: no chunk is culled.
    const float *bounds_to_clip;
    // What the vertex shader computes in floats. The pipeline uses it for triangles that have to be
    // cut and reach far away: floats of the far corners are too coarse for the new corners near the
    // eye. NULL: new corners are computed from the vertex shader's positions.
    const DipExactTransform *exact_to_clip;
    DipCull cull;
    const DipDrawState *state; // blending, depth, stencil, fill; NULL: the draw is plain (state.h)
    // The draw's fragments may have other colours than in the passes that are drawn at once, for
    // example because its shader reads a target of this pass alone. They are never copied
    // (DipPassWork.copies_from).
    bool own_shading;
} DipDraw;

// What an attachment of a pass (its colours, depths or stencil values) holds at the start.
typedef enum DipLoad {
    DIP_LOAD_CLEAR,   // the pass's clear value
    DIP_LOAD_KEEP,    // what is there
    DIP_LOAD_DISCARD, // anything: the caller promises to overwrite it
} DipLoad;

// What becomes of an attachment at the end of a pass.
typedef enum DipStore {
    DIP_STORE_KEEP,
    DIP_STORE_DISCARD, // nothing reads it: it is undefined after the pass
    DIP_STORE_REVERT,  // it is again what it was before the pass
} DipStore;

// The attachments of a pass beside its target. All 0 means what most passes need: colours, depths
// and stencil values are cleared at the start, and depths and stencil values end with the pass. If
// `depth` or `samples` is given, it keeps them after the pass.
typedef struct DipAttachments {
    DipLoad colour_load;
    DipStore colour_store;
    bool clear_transparent; // cleared pixels have the alpha 0 instead of 1
    // Colours of samples that outlive the pass, borrowed, of the target's size and format and of
    // the pass's sample_count. colour_load and colour_store then say what the samples hold at the
    // start and what becomes of them, and the target receives the mean of each pixel's samples at
    // the end of the pass. A pass without draws that keeps samples stores their means. NULL: the
    // pass has its own samples, and colour_load and colour_store are about the target.
    DipSamples *samples;
    // Only with samples: the pass leaves the target untouched. The target's pixels and its function
    // `store` may then be NULL.
    bool keep_target;
    // Depths and stencil values that outlive the pass, borrowed, of the target's size and of the
    // pass's sample_count. NULL: the pass has its own, and cannot keep earlier ones.
    DipDepth *depth;
    DipLoad depth_load;
    DipStore depth_store;
    float clear_depth; // 0..1; 0 is infinitely far
    DipLoad stencil_load;
    DipStore stencil_store;
    uint8_t clear_stencil;
} DipAttachments;

// Takes a finished tile of a pass. pixels: the tile's part of the target. light16: the colours of
// these pixels before they are encoded, in 16-bit linear light; the pixel in column x and row y of
// the tile has red, green and blue in light16[c * DIP_TARGET_TILE * DIP_TARGET_TILE + y *
// DIP_TARGET_TILE + x], c = 0..2. NULL if the pass is merged for another reason than ordered draws
// (state.h); then the target has the pixels.
// Worker threads call the function for different tiles at once.
typedef void DipTileDone(void *context, const DipTargetRegion *pixels, const uint16_t *light16);

// A render pass: draws into one target, or with attachments.depth into depths alone.
typedef struct DipPass {
    const DipDraw *draws; // in submission order; where depths are equal, the earlier draw is shown
    // 0: the pass draws nothing, and its attachments are cleared, loaded and stored as in any pass.
    // `draws` is then ignored, since a list may be empty in some frames.
    int draw_count;
    int sample_count; // 1, 2, 4, 6 or 8 samples per pixel
    DipPatternKind pattern;
    // Adaptive antialiasing of alpha-clipped draws (draws with a clip shader). A pixel's samples
    // are divided into groups of this number of samples. Each group is clipped and shaded by
    // itself, at the centroid of its covered samples. dip_sample_groups_exist (pattern.h) must
    // return true for sample_count and this number. If the number is 0 or sample_count, the samples
    // are not divided, and these draws are shaded like any other draw.
    int samples_per_group;
    // True: all plain draws are shaded in these groups, not only alpha-clipped ones. (Every surface
    // is then supersampled. Its samplers should have a bias of -log2(sqrt(groups)) levels.)
    bool groups_shade_all;
    // Alpha to coverage. True: clip shaders write to DipFragmentBatch.keep how many of the pixel's
    // samples the surface may have, 0..sample_count (dip_alpha_to_coverage in shader.h). Where the
    // triangle covers the pixel, that many are kept, in the order of DipSamplePattern.order. The
    // samples may not be divided into groups.
    bool alpha_to_coverage;
    // Linear light, not NaN; clamped to 0..1 for targets of 8 bits per channel.
    float clear_lin[3];
    // User clip planes in clip space, for all draws of the pass. A surface is kept where
    // dot(plane, clip position) >= 0. dip_matrix_clip_plane (renderer/shapes/camera.h) makes them
    // from planes of the world.
    float clip_planes[DIP_MAX_CLIP_PLANES][4];
    int clip_plane_count;
    // A target whose pixels are NULL, of any format but DIP_FORMAT_CALLER, is a pass without
    // colours: it needs attachments.depth, and runs no fragment shader, only clip shaders. A pass
    // with attachments.samples always has colours.
    DipTarget target;
    // Only this rectangle is needed. Blocks of 8x8 pixels that lie outside it are left untouched.
    // The other blocks are the same to the bit as without a region.
    DipTargetRegion region;
    // The rectangle that is needed of each tile of the target, row by row. Only pixels that are in
    // this rectangle and in `region` are needed. NULL: all of each tile.
    const DipTileRegion *tile_regions;
    DipAttachments attachments;
    // Pixels to which clip space maps. Pixels outside it are neither drawn nor cleared: they are
    // left untouched, with their depths and stencil values. All 0: the whole target.
    DipTargetRegion viewport;
    // Pixels outside this rectangle are left untouched, to the pixel. All 0: the whole target.
    DipTargetRegion scissor;
    // Called when a tile is finished, or NULL. A pass that is not merged (state.h), or only for its
    // ordered draws, then hands its colours to this function instead of storing them in the target.
    DipTileDone *tile_done;
    void *tile_context;
    // Where the pass also stores the depth of sample 0 of each pixel of the target, z / w of the
    // nearest surface; 0 is infinitely far. Rows follow each other without gaps. NULL: nowhere.
    float *depths;
    // Where the pass writes what its samples show, or NULL. Pixels that the pass does not draw
    // because of `region` or `tile_regions` read as background. A pass with a readback must not
    // need merging (state.h): no ordered draws, attachments, viewport or scissor, and a target of
    // format DIP_FORMAT_SRGB8.
    const DipSampleReadback *readback;
} DipPass;

typedef struct DipPipeline DipPipeline;

// Creates a pipeline for targets of width x height pixels, each 1..DIP_MAX_TARGET_SIZE. The pool is
// borrowed and must outlive the pipeline. If it is NULL, the callers' threads do the work. Fails
// with RANGE, UNSUPPORTED (an instruction set that this machine lacks) or MEMORY.
DIP_API DipPipeline *dip_pipeline_create(DipPool *pool, DipIsa isa, int width, int height,
                                         DipError *err);
// Frees a pipeline, which must not be drawing. *pipeline may be NULL and becomes NULL.
DIP_API void dip_pipeline_destroy(DipPipeline **pipeline);

// Draws a pass, and adds its work and its times to *counters and *times, each of which may be NULL.
// Fails with
// - RANGE, CONFLICT or MISSING if a field breaks the rules in its comment above; the error's key is
//   the field, for example "draws[7].mesh", and the target is unchanged;
// - RANGE, CONFLICT or MISSING if a shader reads what it cannot have (shader.h). The pass is drawn,
//   with 0 in place of these reads. The error's key names the earliest of these draws;
// - CONFLICT if another thread is drawing with the pipeline;
// - OVERSIZED if 32 bits cannot index the pass's triangles. The limit is about
//   2^31 / (8 + 3 * the largest varying_count) triangles. The triangles of a mesh count once for
//   each draw of the mesh, in view or not;
// - MEMORY; the target's content is then undefined.
DIP_API bool dip_pipeline_draw(DipPipeline *pipeline, const DipPass *pass,
                               DipPipelineCounters *counters, DipStageTimes *times, DipError *err);

// A pass, the pipeline that draws it, and the counters and times that drawing adds to, or NULL.
typedef struct DipPassWork {
    DipPipeline *pipeline;
    const DipPass *pass;
    DipPipelineCounters *counters;
    DipStageTimes *times;
    // Another work of the same call, which copies from no work itself, or NULL. If a pixel shows
    // one patch alone in both passes, at the same triangle, this pass copies the other one's pixel
    // and does not shade it. The picture stays the same, because the caller promises that the
    // fragments of each draw have the same colours in both passes: the draws differ in nothing that
    // their fragment shaders read, unless a pass says own_shading. Copied fragments have a counter
    // of their own; no other counter of shading, and no time, has their part. A pass that needs
    // merging (state.h), has a readback or records its tiles neither copies nor is copied from.
    const struct DipPassWork *copies_from;
} DipPassWork;

enum { DIP_MAX_PASSES_AT_ONCE = 8 };

// Draws several independent passes at once. count: 1..DIP_MAX_PASSES_AT_ONCE. Each pass has a
// pipeline and a target of its own; all pipelines use one pool. The pictures are the same as from
// dip_pipeline_draw. A worker draws the same tile of each pass, one after the other. Passes that
// show much the same scene therefore find each other's texels in the cache.
// same_geometry: the caller promises that the passes differ only in samples, textures and fragment
// shaders, not in target size, region, clip planes or vertex shaders. The geometry stage then runs
// once for all passes, and its time and counters are added to each pass. The stages that run per
// tile are timed for each pass separately.
// Fails as dip_pipeline_draw does. Also fails with RANGE if count is out of range, and with
// CONFLICT if two passes have the same pipeline, the same attachments.samples, or the same
// attachments.depth while one of them does not revert its depths and stencil values
// (DIP_STORE_REVERT), if their pipelines use different pools, or if copies_from of a work breaks
// the rules in its comment or is set without same_geometry.
DIP_API bool dip_pipeline_draw_passes(const DipPassWork *works, int count, bool same_geometry,
                                      DipError *err);

// Records the tiles of each pass that the pipeline draws from now on; every pass clears the
// recording when it begins, and fills it while its tiles are drawn. The arrays are borrowed until
// the next call of this function. NULL stops recording, as at first. Recording changes no picture
// and no counter.
DIP_API void dip_pipeline_record_tiles(DipPipeline *pipeline, const DipTileRecording *recording);

// Allocates the memory that drawing the pass needs. Drawing it later allocates nothing, unless
// clipping makes very many triangles. The function does not read the pass's uniforms. Its draws
// need fragment shaders only if it has a target. Fails with OVERSIZED or MEMORY, and as drawing
// does if the pass's draws are wrong.
DIP_API bool dip_pipeline_reserve(DipPipeline *pipeline, const DipPass *pass, DipError *err);

#ifdef __cplusplus
}
#endif

#endif
