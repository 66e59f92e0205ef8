// Finds the instruction sets that are built into the program and supported by the processor.
#include "renderer/base/isa.h"

#include <string.h>

const char *dip_isa_name(DipIsa isa) {
    static const char *const names[] = {
#define DIP_ISA_NAME(name, NAME, lanes) #name,
        DIP_ISA_LIST(DIP_ISA_NAME)
#undef DIP_ISA_NAME
    };
    return (unsigned)isa < DIP_ISA_COUNT ? names[isa] : "?";
}

bool dip_isa_parse(const char *name, DipIsa *isa) {
    for (int i = 0; i < DIP_ISA_COUNT; i++) {
        if (strcmp(name, dip_isa_name((DipIsa)i)) == 0) {
            *isa = (DipIsa)i;
            return true;
        }
    }
    return false;
}

#if defined(__x86_64__)
// Returns whether the processor has the bit-counting and bit-moving instructions that the kernels
// for avx2 and avx512 use.
static bool has_bit_counts(void) {
    return __builtin_cpu_supports("popcnt") && __builtin_cpu_supports("bmi") &&
           __builtin_cpu_supports("bmi2");
}
#endif

bool dip_isa_available(DipIsa isa) {
    switch (isa) {
    case DIP_ISA_SCALAR:
        return true;
#if defined(__i386__)
    case DIP_ISA_SSE2: // renderer/base/platform.h requires it
        return true;
#elif defined(__x86_64__)
    case DIP_ISA_SSE2:
        return true;
    case DIP_ISA_AVX2:
        return has_bit_counts() && __builtin_cpu_supports("avx2");
    case DIP_ISA_AVX512:
        return has_bit_counts() && __builtin_cpu_supports("avx512f") &&
               __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") &&
               __builtin_cpu_supports("avx512dq");
#elif defined(__aarch64__)
    case DIP_ISA_NEON:
        return true;
#endif
    default:
        return false;
    }
}

DipIsa dip_isa_best(void) {
    DipIsa best = DIP_ISA_SCALAR;
    for (int i = 0; i < DIP_ISA_COUNT; i++) {
        if (dip_isa_available((DipIsa)i)) {
            best = (DipIsa)i;
        }
    }
    return best;
}
