// The kernel table: one set of function pointers per instruction set.
//
// Kernels are *_simd.c files compiled once per instruction set; only scalars and pointers cross
// their boundary, since vector types change their calling convention with the flags.
#ifndef DIP_RENDERER_RASTER_KERNELS_H
#define DIP_RENDERER_RASTER_KERNELS_H

#include "renderer/geometry/project.h"
#include "renderer/geometry/setup.h"
#include "renderer/isa.h"
#include "renderer/raster/tile.h"
#include "renderer/shader.h"
#include "renderer/shading/tile_shading.h"

// X(result, name, parameters): each kernel is declared and filled in from this one list.
#define DIP_KERNEL_LIST(X)                                                                         \
    /* Clip positions to rounded screen positions, depth, 1/w and clip codes. */                   \
    X(void, dip_kernel_project,                                                                    \
      (const DipScreenMapping *map, int count, float *const *clip, DipScreenBatch *out))           \
    /* Projected triangles to those that may cover samples, with their planes; see setup.h. */     \
    X(int, dip_kernel_setup,                                                                       \
      (const DipSetupTarget *target, const DipSetupBatch *batch, DipTriangle *triangles,           \
       float *surfaces))                                                                           \
    /* Coverage and depth of a triangle in a tile that its box reaches. clip NULL: opaque. */      \
    X(void, dip_kernel_draw_triangle,                                                              \
      (DipTile * tile, const DipTriangle *triangle, uint32_t id, const DipClipTest *clip))         \
    /* The surfaces of every pixel of a tile, pushed to the lists of their draws. */               \
    X(void, dip_kernel_collect, (DipTileShading * shading))                                        \
    /* Varyings of a list's fragments, and derivatives but for those of the last plain_count. */   \
    X(void, dip_kernel_interpolate,                                                                \
      (const DipShadingInput *input, const DipFragmentList *list, int slot_count, int plain_count, \
       DipFragmentBatch *batch))                                                                   \
    /* Shaded colours to 16-bit linear light and to sRGB pixels. */                                \
    X(void, dip_kernel_encode,                                                                     \
      (const DipFragmentBatch *batch, const uint8_t *srgb_code, DipEncodedBatch *out))             \
    X(void, dip_kernel_sample_colour,                                                              \
      (DipFragmentBatch * batch, const DipSampler *sampler, int u_slot,                            \
       float(*out)[DIP_FRAGMENT_BATCH]))                                                           \
    X(void, dip_kernel_sample_colours,                                                             \
      (DipFragmentBatch * batch, const DipSampler *const samplers[2], int u_slot,                  \
       float(*const out[2])[DIP_FRAGMENT_BATCH]))                                                  \
    X(void, dip_kernel_sample_alpha,                                                               \
      (DipFragmentBatch * batch, const DipSampler *sampler, int u_slot, float *out))               \
    X(void, dip_kernel_sample_target,                                                              \
      (DipFragmentBatch * batch, const DipTarget *target, const float *u, const float *v,          \
       float(*out)[DIP_FRAGMENT_BATCH]))                                                           \
    /* The scene's own materials, ordinary shaders. */                                             \
    X(void, dip_kernel_surface_vertex, (const DipVertexBatch *batch))                              \
    X(void, dip_kernel_surface_fragment, (DipFragmentBatch * batch))                               \
    X(void, dip_kernel_surface_clip, (DipFragmentBatch * batch))                                   \
    X(void, dip_kernel_normal_map_vertex, (const DipVertexBatch *batch))                           \
    X(void, dip_kernel_normal_map_fragment, (DipFragmentBatch * batch))                            \
    X(void, dip_kernel_sky_fragment, (DipFragmentBatch * batch))                                   \
    X(void, dip_kernel_water_fragment, (DipFragmentBatch * batch))

typedef struct DipKernels {
#define DIP_KERNEL_FIELD(result, name, parameters) result(*name) parameters;
    DIP_KERNEL_LIST(DIP_KERNEL_FIELD)
#undef DIP_KERNEL_FIELD
} DipKernels;

// Declares every kernel of one instruction set: dip_kernel_project_avx2, ...
#define DIP_KERNEL_DECLARE_SCALAR(result, name, parameters) result name##_scalar parameters;
#define DIP_KERNEL_DECLARE_SSE2(result, name, parameters)   result name##_sse2 parameters;
#define DIP_KERNEL_DECLARE_NEON(result, name, parameters)   result name##_neon parameters;
#define DIP_KERNEL_DECLARE_AVX2(result, name, parameters)   result name##_avx2 parameters;
#define DIP_KERNEL_DECLARE_AVX512(result, name, parameters) result name##_avx512 parameters;
DIP_KERNEL_LIST(DIP_KERNEL_DECLARE_SCALAR)
DIP_KERNEL_LIST(DIP_KERNEL_DECLARE_SSE2)
DIP_KERNEL_LIST(DIP_KERNEL_DECLARE_NEON)
DIP_KERNEL_LIST(DIP_KERNEL_DECLARE_AVX2)
DIP_KERNEL_LIST(DIP_KERNEL_DECLARE_AVX512)

// The kernels of an instruction set that dip_isa_available says is there. Static storage.
const DipKernels *dip_kernels(DipIsa isa);

#endif
