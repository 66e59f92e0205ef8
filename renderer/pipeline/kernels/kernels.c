// The pipeline's kernel tables.
#include "renderer/pipeline/kernels/kernels.h"

#include "renderer/base/assert.h"

const DipKernels *dip_kernels(DipIsa isa) {
    static const DipKernels tables[DIP_ISA_COUNT] = DIP_KERNEL_TABLES(DIP_KERNEL_LIST);
    DIP_ASSERT(dip_isa_available(isa));
    return &tables[isa];
}
