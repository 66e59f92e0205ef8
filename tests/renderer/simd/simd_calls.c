// Calls the kernels of the instruction sets that this machine has.
#include "tests/renderer/simd/simd_calls.h"

#include "renderer/base/assert.h"
#include "tests/renderer/simd/values.h"

enum { SEED = 4217, LANES_TESTED = 20000 };

const SimdSet simd_sets[DIP_ISA_COUNT] = {
#define SIMD_SET(name, NAME, lanes) {DIP_ISA_##NAME, lanes, (lanes + 1) / 2},
    DIP_ISA_LIST(SIMD_SET)
#undef SIMD_SET
};

int simd_call_with(const SimdSet *set, SimdCall function, const void *const in[4], void *out) {
    static const SimdKernels tables[DIP_ISA_COUNT] = DIP_KERNEL_TABLES(SIMD_KERNEL_LIST);
    DIP_ASSERT(dip_isa_available(set->isa));
    return tables[set->isa].dip_kernel_simd_call(function, in, out);
}

int simd_call(const SimdSet *set, SimdCall function, const void *in0, const void *in1,
              const void *in2, void *out) {
    return simd_call_with(set, function, (const void *[4]){in0, in1, in2}, out);
}

void simd_for_each_set(void (*check)(const SimdSet *set, Random *random)) {
    for (int isa = 0; isa < DIP_ISA_COUNT; isa++) {
        if (!dip_isa_available((DipIsa)isa)) {
            continue;
        }
        Random random = {SEED};
        for (int round = 0; round < LANES_TESTED / simd_sets[isa].lanes; round++) {
            check(&simd_sets[isa], &random);
            free_exact_memory();
        }
    }
}

const char *simd_call_name(SimdCall call) {
    static const char *const names[] = {
#define SIMD_CALL_NAME(name) #name,
        SIMD_CALL_LIST(SIMD_CALL_NAME)
#undef SIMD_CALL_NAME
    };
    return names[call];
}
