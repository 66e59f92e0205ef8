// The kernel tables of the filters.
#include "renderer/post/filters/post_kernels.h"

#include "renderer/base/assert.h"

const DipPostKernels *dip_post_kernels(DipIsa isa) {
    static const DipPostKernels tables[DIP_ISA_COUNT] = DIP_KERNEL_TABLES(DIP_POST_KERNEL_LIST);
    DIP_ASSERT(dip_isa_available(isa));
    return &tables[isa];
}
