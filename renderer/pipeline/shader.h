// Programmable stages: vertex and fragment shaders are C functions over batches.
//
// A batch is structure-of-arrays: element i of every array belongs to vertex or fragment i. A
// shader loops over 0..count-1. Every array may be read and written up to the next multiple of
// DIP_BATCH_ALIGN, so a vectorised loop needs no tail. Shaders run on worker threads and must write
// nothing but their batch's outputs. A picture is the same on every machine if its shaders use only
// + - * / and sqrt and are compiled without contraction (-ffp-contract=off).
#ifndef DIP_RENDERER_PIPELINE_SHADER_H
#define DIP_RENDERER_PIPELINE_SHADER_H

#include "renderer/pipeline/counters.h"
#include "renderer/pipeline/depth.h"
#include "renderer/pipeline/pattern.h"
#include "renderer/pipeline/target.h"
#include "renderer/pipeline/texture.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    DIP_BATCH_ALIGN = 16,
    DIP_FRAGMENT_BATCH = 256,
    DIP_VERTEX_BATCH = 256,
    DIP_MAX_VARYINGS = 12,   // floats interpolated from the vertices to a fragment
    DIP_MAX_ATTRIBUTES = 16, // floats per vertex
    DIP_MAX_SAMPLERS = 16,
};

// A vertex shader reads in[a][i]: float a of vertex i's attributes in the mesh, and 0 for the
// attributes up to DIP_MAX_ATTRIBUTES that the mesh lacks. It writes varying[s][i], the vertex's
// varying s, and clip[0..3][i], its clip position x, y, z, w; what it does not write is 0. A vertex
// is in view if -w <= x <= w, -w <= y <= w and 0 <= z <= w; z = w is nearest.
typedef struct DipVertexBatch {
    int count; // 1..DIP_VERTEX_BATCH
    const float *const *in;
    float *const *clip;
    float *const *varying;
    const void *uniforms; // uniforms of the draw (DipDraw, pipeline.h)
} DipVertexBatch;

typedef void DipVertexShader(const DipVertexBatch *batch);

// Numbers of texture reads, and counts that the shaders define. They are summed per tile.
typedef struct DipShaderWork {
    uint64_t probes;
    uint64_t texels;
    uint64_t counts[DIP_SHADER_COUNT_MAX]; // shader_counts of DipPipelineCounters
} DipShaderWork;

typedef struct DipFragmentBatch DipFragmentBatch;

// The functions below read for a whole batch. A read that the draw does not allow gives 0, and
// drawing the pass fails with an error that names the draw and the fault (dip_pipeline_draw).

// Reads a texture at the coordinates u and v, which are varyings u_varying and u_varying + 1. The
// derivatives of u and v determine the footprint: the area of the texture that a pixel covers. Only
// a sampler without mips and anisotropic filtering reads at varyings without derivatives. Writes
// linear light, 0..1, to out[0..2][i].
typedef void DipSampleColour(DipFragmentBatch *batch, const DipSampler *sampler, int u_varying,
                             float (*out)[DIP_FRAGMENT_BATCH]);

// Samples two textures at the same coordinates. One such call costs less than two calls of
// DipSampleColour if both textures have the same size and sampler settings.
typedef void DipSampleColours(DipFragmentBatch *batch, const DipSampler *const samplers[2],
                              int u_varying, float (*const out[2])[DIP_FRAGMENT_BATCH]);

// Reads a texture's alpha, 0..1, into out[i]. The alpha is 1 if the texture has none.
typedef void DipSampleAlpha(DipFragmentBatch *batch, const DipSampler *sampler, int u_varying,
                            float *out);

// Reads a texture's alpha as DipSampleAlpha does, and how fast it changes from pixel to pixel:
// slope[i] is |d alpha / dx| + |d alpha / dy|. It comes from the texels of the footprint: it is the
// derivative of their weighted mean by the position. It is 0 if the texture has no alpha, and where
// the nearest texel is read.
typedef void DipSampleAlphaSlope(DipFragmentBatch *batch, const DipSampler *sampler, int u_varying,
                                 float *out, float *slope);

// Reads a target of format DIP_FORMAT_SRGB8 that an earlier pass drew; it may not share memory with
// the target of this pass or of a pass that is drawn at once. u[i] and v[i] are fractions of the
// target's size, measured from its top left corner; they are clamped to the target. The function
// filters bilinearly in linear light and writes out[0..2][i].
typedef void DipSampleTarget(DipFragmentBatch *batch, const DipTarget *target, const float *u,
                             const float *v, float (*out)[DIP_FRAGMENT_BATCH]);

// Compares depths with those that an earlier pass drew, not with those of this pass or of a pass
// that is drawn at once. u[i] and v[i] are fractions of the map's size, measured from its top left
// corner. out[i] is the share of light, 0..1: of the stored depths around the point, those that are
// not nearer than z[i] count as lit (z[i] >= stored). With DIP_SHADOW_LINEAR, each of the four
// texels around the point is compared first, and the four results are averaged with the weights of
// bilinear filtering, in 1/256. With DIP_SHADOW_WIDE, each of the nine texels around the point is
// compared, and the weight of a result is the area that its texel has in common with a square of
// 2x2 texels around the point. Points beside the map are lit, and those behind its far plane (z <
// 0) are compared as if they lay on it: they are lit where the map is cleared to 0. Texels beyond
// the map's border repeat the border. A map is drawn with the depth bias that its filter needs
// (DipShadowFilter in depth.h).
typedef void DipSampleShadow(DipFragmentBatch *batch, const DipShadowMap *map, const float *u,
                             const float *v, const float *z, float *out);

struct DipFragmentBatch {
    // Varyings at the fragment's position, and their derivatives per pixel along x and y. Varyings
    // and derivatives that the draw does not have are 0. The shader may write to the varyings that
    // the draw declares as computed (computed_varying_count in pipeline.h).
    float varying[DIP_MAX_VARYINGS][DIP_FRAGMENT_BATCH];
    float varying_dx[DIP_MAX_VARYINGS][DIP_FRAGMENT_BATCH];
    float varying_dy[DIP_MAX_VARYINGS][DIP_FRAGMENT_BATCH];
    float x[DIP_FRAGMENT_BATCH]; // the shaded position, in pixels from the target's top left corner
    float y[DIP_FRAGMENT_BATCH];
    // A fragment shader writes linear light. The pipeline clamps it to 0..1 for targets of 8 bits.
    // What it does not write is black.
    float colour[3][DIP_FRAGMENT_BATCH];
    // A fragment shader of an ordered draw (state.h) may write an alpha; it is 1 if it does not.
    float alpha[DIP_FRAGMENT_BATCH];
    // A clip shader writes 1 where the surface exists and 0, as at first, where it is cut away. In
    // a pass with alpha_to_coverage, it writes a number of samples.
    uint8_t keep[DIP_FRAGMENT_BATCH];
    // 1 if the fragment lies on a front face (DipCull in pipeline.h), and 0 if it lies on a back
    // face. Only draws whose state sets reads_front (state.h) have it; for others it is 0.
    uint8_t front[DIP_FRAGMENT_BATCH];
    int count;                  // 1..DIP_FRAGMENT_BATCH
    const DipSampler *samplers; // samplers of the draw
    const void *uniforms;       // uniforms of the draw
    DipSampleColour *sample_colour;
    DipSampleColours *sample_colours;
    DipSampleAlpha *sample_alpha;
    DipSampleAlphaSlope *sample_alpha_slope;
    DipSampleTarget *sample_target;
    DipSampleShadow *sample_shadow;
    const float *srgb_light;      // linear light of the 256 8-bit sRGB values, for sample_target
    DipShaderWork work;           // a shader may add to work.counts
    struct DipShaderGuard *guard; // the pipeline's own
};

typedef void DipFragmentShader(DipFragmentBatch *batch);

// Least slope of alpha per pixel that alpha to coverage divides by.
#define DIP_LEAST_ALPHA_SLOPE 0.02f

// Alpha to coverage: returns how many of a pixel's samples a surface covers, 0..sample_count. Where
// alpha is the cutoff, the surface's edge runs through the pixel's middle; (alpha - cutoff) / slope
// is the distance from the edge, in pixels. The share of the samples is this distance plus 1/2,
// within 0..1 and rounded to the nearest number of samples, halves up. With one sample it is 1
// exactly where alpha >= cutoff. The decision is made in integers, in 1/65536. Numbers that are not
// finite: the surface covers no sample where alpha - cutoff is NaN, and a slope that is NaN counts
// as the steepest one, 1024.
static inline int dip_alpha_to_coverage(float alpha, float slope, float cutoff, int sample_count) {
    const float difference = alpha - cutoff;
    // From half of the steepest slope on, all samples are covered, and as far below none is.
    // Greater differences would not fit in an integer. The first bound also replaces NaN.
    const float from_below = difference > -512.0f ? difference : -512.0f;
    const float over = from_below < 512.0f ? from_below : 512.0f;
    const float bounded = slope < 1024.0f ? slope : 1024.0f; // also of NaN
    const float least = bounded > DIP_LEAST_ALPHA_SLOPE ? bounded : DIP_LEAST_ALPHA_SLOPE;
    const int32_t width = (int32_t)(least * 65536.0f);
    const int32_t distance = (int32_t)(over * 65536.0f) - (over < 0.0f); // below 0 where over is
    // The share times twice the width and the number of samples, plus the width for rounding.
    const int32_t share = (2 * distance + width) * sample_count + width;
    int covered = 0;
    for (int n = 1; n <= DIP_MAX_SAMPLES; n++) {
        covered += share >= 2 * n * width;
    }
    return covered < sample_count ? covered : sample_count;
}

#ifdef __cplusplus
}
#endif

#endif
