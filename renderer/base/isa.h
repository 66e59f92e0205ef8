// The instruction sets that kernels are built for, and the choice among them at run time. All
// functions are thread-safe.
#ifndef DIP_RENDERER_BASE_ISA_H
#define DIP_RENDERER_BASE_ISA_H

#include "renderer/base/api.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

// The instruction sets, as X(name, NAME, lanes), in ascending order of preference. lanes: number of
// 32-bit lanes of a vector. Pictures have the same bits with every instruction set.
#define DIP_ISA_LIST(X)                                                                            \
    X(scalar, SCALAR, 1)                                                                           \
    X(sse2, SSE2, 4)                                                                               \
    X(neon, NEON, 4)                                                                               \
    X(avx2, AVX2, 8)                                                                               \
    X(avx512, AVX512, 16)

typedef enum DipIsa {
#define DIP_ISA_ENUM(name, NAME, lanes) DIP_ISA_##NAME,
    DIP_ISA_LIST(DIP_ISA_ENUM)
#undef DIP_ISA_ENUM
        DIP_ISA_COUNT
} DipIsa;

// Returns the name that DIP_ISA_LIST gives an instruction set, or "?" for any other number. Static
// storage.
DIP_API const char *dip_isa_name(DipIsa isa);
// Sets *isa to the instruction set with exactly this name. Returns false if there is none.
DIP_API bool dip_isa_parse(const char *name, DipIsa *isa);
// Returns whether the kernels for an instruction set are built in and this processor can run them.
DIP_API bool dip_isa_available(DipIsa isa);
// Returns the most preferred instruction set that is available.
DIP_API DipIsa dip_isa_best(void);

#ifdef __cplusplus
}
#endif

#endif
