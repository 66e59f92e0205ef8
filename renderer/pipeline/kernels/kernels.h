// The kernels of the pipeline, one table per instruction set (renderer/simd/kernel_table.h).
#ifndef DIP_RENDERER_PIPELINE_KERNELS_KERNELS_H
#define DIP_RENDERER_PIPELINE_KERNELS_KERNELS_H

#include "renderer/base/isa.h"
#include "renderer/base/srgb.h"
#include "renderer/pipeline/shader.h"
#include "renderer/pipeline/state.h"
#include "renderer/simd/kernel_table.h"

#include <stdint.h>

// What the kernels of other folders read and write. The table needs only the names of these types.
// It therefore includes none of those folders, and each of them can use the table.
typedef struct DipBlockLight DipBlockLight;       // merge/ordered.h
typedef struct DipBlockLight16 DipBlockLight16;   // merge/ordered.h
typedef struct DipClipTest DipClipTest;           // raster/fragments.h
typedef struct DipEncodedBatch DipEncodedBatch;   // shading/tile_shading.h
typedef struct DipFragmentList DipFragmentList;   // raster/fragments.h
typedef struct DipOrdered DipOrdered;             // merge/ordered.h
typedef struct DipOrderedBatch DipOrderedBatch;   // merge/ordered.h
typedef struct DipScreenBatch DipScreenBatch;     // geometry/project.h
typedef struct DipScreenMapping DipScreenMapping; // geometry/project.h
typedef struct DipSetupBatch DipSetupBatch;       // geometry/setup.h
typedef struct DipSetupTarget DipSetupTarget;     // geometry/setup.h
typedef struct DipShadingInput DipShadingInput;   // shading/tile_shading.h
typedef struct DipTile DipTile;                   // raster/tile.h
typedef struct DipTileColours DipTileColours;     // merge/ordered.h
typedef struct DipTileShading DipTileShading;     // shading/tile_shading.h
typedef struct DipTriangle DipTriangle;           // raster/triangle.h

// The list of kernels, as X(result, name, parameters). The declarations and the tables are made
// from this list.
#define DIP_KERNEL_LIST(X)                                                                         \
    /* Turns clip positions into rounded screen positions, depth, 1/w and clip codes. */           \
    X(void, dip_kernel_project,                                                                    \
      (const DipScreenMapping *map, int count, float *const *clip, DipScreenBatch *out))           \
    /* Sets up the projected triangles that may cover samples (setup.h). */                        \
    X(int, dip_kernel_setup,                                                                       \
      (const DipSetupTarget *target, const DipSetupBatch *batch, DipTriangle *triangles,           \
       float *planes))                                                                             \
    /* Draws a triangle's coverage and depth in a tile that its box meets. clip NULL: opaque. */   \
    /* Otherwise, its last fragments may wait in clip->queue, and those that wait already are of   \
     */                                                                                            \
    /* the same draw. */                                                                           \
    X(void, dip_kernel_draw_triangle,                                                              \
      (DipTile * tile, const DipTriangle *triangle, uint32_t id, const DipClipTest *clip))         \
    /* Runs the clip test on the fragments that wait, at least one, and draws what it keeps. */    \
    X(void, dip_kernel_clip, (DipTile * tile, const DipClipTest *clip))                            \
    /* Draws a triangle of an ordered draw in a tile that its box meets. */                        \
    X(void, dip_kernel_draw_ordered,                                                               \
      (DipTile * tile, const DipTriangle *triangle, uint32_t index, DipOrdered *ordered))          \
    /* Blends a shaded batch of fragments of an ordered draw into the samples. */                  \
    X(void, dip_kernel_blend,                                                                      \
      (DipTileColours * colours, const DipDrawState *state, const DipOrderedBatch *ordered,        \
       const DipFragmentBatch *batch))                                                             \
    /* Averages the samples of a block to bytes R, G, B, A. srgb NULL: linear codes. */            \
    X(void, dip_kernel_resolve_codes,                                                              \
      (const DipTileColours *colours, int block, const DipSrgbEncodeTable *srgb, uint32_t *rgba8)) \
    /* Averages the colours of the samples of a block to 16-bit linear light. */                   \
    X(void, dip_kernel_resolve_light16,                                                            \
      (const DipTileColours *colours, int block, DipBlockLight16 *light16))                        \
    /* Averages the samples of a block to floats. */                                               \
    X(void, dip_kernel_resolve_light,                                                              \
      (const DipTileColours *colours, int block, DipBlockLight *light))                            \
    /* Adds the fragments of a tile's pixels to the lists of their draws. */                       \
    X(void, dip_kernel_collect, (DipTileShading * shading))                                        \
    /* Interpolates varyings; the last value_only_count get no derivatives. */                     \
    X(void, dip_kernel_interpolate,                                                                \
      (const DipShadingInput *input, const DipFragmentList *list, int varying_count,               \
       int value_only_count, DipFragmentBatch *batch))                                             \
    /* Converts shaded colours to 16-bit linear light and, unless srgb is NULL, to sRGB */         \
    /* pixels. */                                                                                  \
    X(void, dip_kernel_encode,                                                                     \
      (const DipFragmentBatch *batch, const DipSrgbEncodeTable *srgb, DipEncodedBatch *out))       \
    /* Texture and target reads: DipSampleColour and its companions in shader.h. */                \
    X(void, dip_kernel_sample_colour,                                                              \
      (DipFragmentBatch * batch, const DipSampler *sampler, int u_varying,                         \
       float(*out)[DIP_FRAGMENT_BATCH]))                                                           \
    X(void, dip_kernel_sample_colours,                                                             \
      (DipFragmentBatch * batch, const DipSampler *const samplers[2], int u_varying,               \
       float(*const out[2])[DIP_FRAGMENT_BATCH]))                                                  \
    X(void, dip_kernel_sample_alpha,                                                               \
      (DipFragmentBatch * batch, const DipSampler *sampler, int u_varying, float *out))            \
    X(void, dip_kernel_sample_alpha_slope,                                                         \
      (DipFragmentBatch * batch, const DipSampler *sampler, int u_varying, float *out,             \
       float *slope))                                                                              \
    X(void, dip_kernel_sample_target,                                                              \
      (DipFragmentBatch * batch, const DipTarget *target, const float *u, const float *v,          \
       float(*out)[DIP_FRAGMENT_BATCH]))                                                           \
    X(void, dip_kernel_sample_shadow,                                                              \
      (DipFragmentBatch * batch, const DipShadowMap *map, const float *u, const float *v,          \
       const float *z, float *out))

typedef struct DipKernels {
    DIP_KERNEL_LIST(DIP_KERNEL_FIELD)
} DipKernels;

DIP_KERNELS_DECLARE(DIP_KERNEL_LIST)

// Returns the kernels of an instruction set. dip_isa_available must be true for it. Static storage.
const DipKernels *dip_kernels(DipIsa isa);

#endif
