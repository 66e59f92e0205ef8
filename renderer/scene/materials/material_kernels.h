// The shaders of the scene's materials, one table per instruction set
// (renderer/simd/kernel_table.h). The pipeline treats them as it treats any caller's shaders.
#ifndef DIP_RENDERER_SCENE_MATERIALS_MATERIAL_KERNELS_H
#define DIP_RENDERER_SCENE_MATERIALS_MATERIAL_KERNELS_H

#include "renderer/pipeline/shader.h"
#include "renderer/simd/kernel_table.h"

// X(result, name, parameters)
#define DIP_MATERIAL_KERNEL_LIST(X)                                                                \
    X(void, dip_kernel_surface_vertex, (const DipVertexBatch *batch))                              \
    X(void, dip_kernel_surface_fragment, (DipFragmentBatch * batch))                               \
    X(void, dip_kernel_surface_clip, (DipFragmentBatch * batch))                                   \
    /* A clip shader for passes with alpha_to_coverage. */                                         \
    X(void, dip_kernel_surface_cover, (DipFragmentBatch * batch))                                  \
    X(void, dip_kernel_fragment_lit_vertex, (const DipVertexBatch *batch))                         \
    X(void, dip_kernel_normal_map_fragment, (DipFragmentBatch * batch))                            \
    X(void, dip_kernel_gouraud_vertex, (const DipVertexBatch *batch))                              \
    X(void, dip_kernel_gouraud_fragment, (DipFragmentBatch * batch))                               \
    X(void, dip_kernel_phong_fragment, (DipFragmentBatch * batch))                                 \
    X(void, dip_kernel_pbr_fragment, (DipFragmentBatch * batch))                                   \
    /* The same for surfaces that see an environment. */                                           \
    X(void, dip_kernel_pbr_environment_fragment, (DipFragmentBatch * batch))                       \
    /* For surfaces with a sheen or transmission, whether they see an environment or not. */       \
    X(void, dip_kernel_pbr_layered_fragment, (DipFragmentBatch * batch))                           \
    X(void, dip_kernel_blended_fragment, (DipFragmentBatch * batch))                               \
    /* The share of what lies behind that a transmitting surface lets through. */                  \
    X(void, dip_kernel_transmittance_fragment, (DipFragmentBatch * batch))                         \
    /* For surfaces that scatter what they let through: reads it from the backdrop. */             \
    X(void, dip_kernel_pbr_scattering_fragment, (DipFragmentBatch * batch))                        \
    X(void, dip_kernel_sky_fragment, (DipFragmentBatch * batch))                                   \
    X(void, dip_kernel_water_fragment, (DipFragmentBatch * batch))

typedef struct DipMaterialKernels {
    DIP_MATERIAL_KERNEL_LIST(DIP_KERNEL_FIELD)
} DipMaterialKernels;

DIP_KERNELS_DECLARE(DIP_MATERIAL_KERNEL_LIST)

// Returns the shaders for an instruction set that this machine has (dip_isa_available). Static
// storage.
const DipMaterialKernels *dip_material_kernels(DipIsa isa);

#endif
