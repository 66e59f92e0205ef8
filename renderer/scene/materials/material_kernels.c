// The kernel tables of the scene's materials.
#include "renderer/scene/materials/material_kernels.h"

#include "renderer/base/assert.h"

const DipMaterialKernels *dip_material_kernels(DipIsa isa) {
    static const DipMaterialKernels tables[DIP_ISA_COUNT] =
        DIP_KERNEL_TABLES(DIP_MATERIAL_KERNEL_LIST);
    DIP_ASSERT(dip_isa_available(isa));
    return &tables[isa];
}
