// Kernel tables: one set of function pointers per instruction set, made from one list of kernels.
//
// The list is a macro LIST(X) with one X(result, name, parameters) per kernel. A kernel is a
// function in a *_simd.c file that is compiled once per instruction set; the version for avx2 is
// called name_avx2. Only scalars and pointers cross a kernel's boundary, because the calling
// convention of vector types changes with the compiler's flags.
#ifndef DIP_RENDERER_SIMD_KERNEL_TABLE_H
#define DIP_RENDERER_SIMD_KERNEL_TABLE_H

#include "renderer/base/isa.h"

#define DIP_KERNEL_DECLARE_SCALAR(result, name, parameters) result name##_scalar parameters;
#define DIP_KERNEL_DECLARE_SSE2(result, name, parameters)   result name##_sse2 parameters;
#define DIP_KERNEL_DECLARE_NEON(result, name, parameters)   result name##_neon parameters;
#define DIP_KERNEL_DECLARE_AVX2(result, name, parameters)   result name##_avx2 parameters;
#define DIP_KERNEL_DECLARE_AVX512(result, name, parameters) result name##_avx512 parameters;

// Declares every kernel of a list for every instruction set.
#define DIP_KERNELS_DECLARE(LIST)                                                                  \
    LIST(DIP_KERNEL_DECLARE_SCALAR)                                                                \
    LIST(DIP_KERNEL_DECLARE_SSE2)                                                                  \
    LIST(DIP_KERNEL_DECLARE_NEON)                                                                  \
    LIST(DIP_KERNEL_DECLARE_AVX2)                                                                  \
    LIST(DIP_KERNEL_DECLARE_AVX512)

// The fields of a kernel table: one function pointer per kernel.
#define DIP_KERNEL_FIELD(result, name, parameters) result(*name) parameters;

#define DIP_KERNEL_ENTRY_SCALAR(result, name, parameters) name##_scalar,
#define DIP_KERNEL_ENTRY_SSE2(result, name, parameters)   name##_sse2,
#define DIP_KERNEL_ENTRY_NEON(result, name, parameters)   name##_neon,
#define DIP_KERNEL_ENTRY_AVX2(result, name, parameters)   name##_avx2,
#define DIP_KERNEL_ENTRY_AVX512(result, name, parameters) name##_avx512,

// Initialises an array of kernel tables. The index is a DipIsa; the array has an entry for every
// instruction set of this processor family.
#if defined(__x86_64__)
#define DIP_KERNEL_TABLES(LIST)                                                                    \
    {                                                                                              \
        [DIP_ISA_SCALAR] = {LIST(DIP_KERNEL_ENTRY_SCALAR)},                                        \
        [DIP_ISA_SSE2] = {LIST(DIP_KERNEL_ENTRY_SSE2)},                                            \
        [DIP_ISA_AVX2] = {LIST(DIP_KERNEL_ENTRY_AVX2)},                                            \
        [DIP_ISA_AVX512] = {LIST(DIP_KERNEL_ENTRY_AVX512)},                                        \
    }
#elif defined(__i386__)
#define DIP_KERNEL_TABLES(LIST)                                                                    \
    {                                                                                              \
        [DIP_ISA_SCALAR] = {LIST(DIP_KERNEL_ENTRY_SCALAR)},                                        \
        [DIP_ISA_SSE2] = {LIST(DIP_KERNEL_ENTRY_SSE2)},                                            \
    }
#elif defined(__aarch64__)
#define DIP_KERNEL_TABLES(LIST)                                                                    \
    {                                                                                              \
        [DIP_ISA_SCALAR] = {LIST(DIP_KERNEL_ENTRY_SCALAR)},                                        \
        [DIP_ISA_NEON] = {LIST(DIP_KERNEL_ENTRY_NEON)},                                            \
    }
#else
#define DIP_KERNEL_TABLES(LIST)                                                                    \
    {                                                                                              \
        [DIP_ISA_SCALAR] = { LIST(DIP_KERNEL_ENTRY_SCALAR) }                                       \
    }
#endif

#endif
