// Programmable stages: vertex and fragment shaders are C functions over batches.
//
// A batch is structure-of-arrays: element i of every array belongs to vertex or fragment i. A
// shader loops over 0..count-1; every array may be read and written up to the next multiple of
// DIP_BATCH_ALIGN, so a vectorised loop needs no tail. Shaders run on worker threads and must
// write nothing but their batch's outputs. For pictures that are the same on every machine they
// must use only + - * / and sqrt, compiled without contraction.
#ifndef DIP_RENDERER_PIPELINE_SHADER_H
#define DIP_RENDERER_PIPELINE_SHADER_H

#include <stdbool.h>
#include <stdint.h>

enum {
    DIP_BATCH_ALIGN = 16,
    DIP_FRAGMENT_BATCH = 64,
    DIP_VERTEX_BATCH = 256,
    DIP_MAX_SLOTS = 12,      // varyings
    DIP_MAX_ATTRIBUTES = 16, // floats per vertex
    DIP_MAX_SAMPLERS = 4,
};

// in[a][i]: attribute float a of vertex i, as laid down by the mesh.
// The shader writes clip[0..3][i] (x, y, z, w: seen where 0 <= z <= w, z = w nearest) and
// slot[s][i].
typedef struct DipVertexBatch {
    int count; // 1..DIP_VERTEX_BATCH
    const float *const *in;
    float *const *clip;
    float *const *slot;
    const void *uniforms; // the draw's
} DipVertexBatch;

typedef void DipVertexShader(const DipVertexBatch *batch);

typedef struct DipTexture DipTexture;

// How a texture is read. Level-of-detail numbers are in 1/256 level.
typedef struct DipSampler {
    const DipTexture *texture;
    int max_anisotropy; // 1 (trilinear) .. 16
    bool advanced;      // the exact ellipse rather than the two-frame estimate
    int32_t bias_lod8;
    int32_t min_lod8;
    bool cheap; // levels blend over a quarter of the way between them; half the probes
    // Mip debugging: level l of `texture` shows level shown_level[l] of `shown`. NULL: itself.
    const DipTexture *shown;
    int32_t shown_level[16];
} DipSampler;

// Work done for texture reads and effects, added up per tile.
typedef struct DipSampleWork {
    uint64_t probes;
    uint64_t texels;
    uint64_t normal_mapped; // fragments
    uint64_t sky;           // likewise
    uint64_t reflecting;    // likewise
} DipSampleWork;

typedef struct DipFragmentBatch DipFragmentBatch;

// Reads a texture at slots u_slot and u_slot + 1 with these slots' derivatives.
// colour: out[0..2][i] linear light, 0..1.
typedef void DipSampleColour(DipFragmentBatch *batch, const DipSampler *sampler, int u_slot,
                             float (*out)[DIP_FRAGMENT_BATCH]);
// The same of two textures at the same slots: where these are of one size and are read alike, for
// less than two calls.
typedef void DipSampleColours(DipFragmentBatch *batch, const DipSampler *const samplers[2],
                              int u_slot, float (*const out[2])[DIP_FRAGMENT_BATCH]);
// alpha: out[i], 0..1, is 1 for a texture without alpha.
typedef void DipSampleAlpha(DipFragmentBatch *batch, const DipSampler *sampler, int u_slot,
                            float *out);

// Reads a target that a pass before drew (renderer/pipeline/pipeline.h) at (u[i], v[i]), fractions
// of its size from the top left corner, clamped to it: bilinear in linear light, out[0..2][i].
typedef struct DipTarget DipTarget;
typedef void DipSampleTarget(DipFragmentBatch *batch, const DipTarget *target, const float *u,
                             const float *v, float (*out)[DIP_FRAGMENT_BATCH]);

struct DipFragmentBatch {
    int count; // 1..DIP_FRAGMENT_BATCH
    // Varyings at the fragment's place and their derivatives per pixel along x and y.
    float slot[DIP_MAX_SLOTS][DIP_FRAGMENT_BATCH];
    float slot_dx[DIP_MAX_SLOTS][DIP_FRAGMENT_BATCH];
    float slot_dy[DIP_MAX_SLOTS][DIP_FRAGMENT_BATCH];
    float x[DIP_FRAGMENT_BATCH]; // where it is shaded, pixels from the target's top left corner
    float y[DIP_FRAGMENT_BATCH];
    const DipSampler *samplers; // the draw's
    const void *uniforms;       // likewise
    DipSampleColour *sample_colour;
    DipSampleColours *sample_colours;
    DipSampleAlpha *sample_alpha;
    DipSampleTarget *sample_target;
    const float *srgb_light; // linear light of the 256 codes, for sample_target
    DipSampleWork work;
    // A fragment shader writes linear light, 0..1 (clamped after).
    float colour[3][DIP_FRAGMENT_BATCH];
    // A clip shader writes 1 where the surface is there, 0 where it is not.
    uint8_t keep[DIP_FRAGMENT_BATCH];
};

typedef void DipFragmentShader(DipFragmentBatch *batch);

#endif
