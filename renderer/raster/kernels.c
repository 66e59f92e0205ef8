// Filling the kernel tables.
#include "renderer/raster/kernels.h"

#include "renderer/base/assert.h"

#define FIELD_SCALAR(result, name, parameters) name##_scalar,
#define FIELD_SSE2(result, name, parameters)   name##_sse2,
#define FIELD_NEON(result, name, parameters)   name##_neon,
#define FIELD_AVX2(result, name, parameters)   name##_avx2,
#define FIELD_AVX512(result, name, parameters) name##_avx512,

static const DipKernels scalar = {DIP_KERNEL_LIST(FIELD_SCALAR)};
#if defined(__x86_64__)
static const DipKernels sse2 = {DIP_KERNEL_LIST(FIELD_SSE2)};
static const DipKernels avx2 = {DIP_KERNEL_LIST(FIELD_AVX2)};
static const DipKernels avx512 = {DIP_KERNEL_LIST(FIELD_AVX512)};
#elif defined(__aarch64__)
static const DipKernels neon = {DIP_KERNEL_LIST(FIELD_NEON)};
#endif

const DipKernels *dip_kernels(DipIsa isa) {
    DIP_ASSERT(dip_isa_available(isa));
    switch (isa) {
#if defined(__x86_64__)
    case DIP_ISA_SSE2:
        return &sse2;
    case DIP_ISA_AVX2:
        return &avx2;
    case DIP_ISA_AVX512:
        return &avx512;
#elif defined(__aarch64__)
    case DIP_ISA_NEON:
        return &neon;
#endif
    default:
        return &scalar;
    }
}
