// The floating-point mode of every thread that draws: round to nearest, subnormals kept.
//
// A host program may have set flush-to-zero (linking fast-math start-up code does it); pictures
// must not depend on that, so the pool sets the mode for its own work and restores it after.
#ifndef DIP_RENDERER_BASE_FP_MODE_H
#define DIP_RENDERER_BASE_FP_MODE_H

#include <stdint.h>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

typedef uint64_t DipFpMode;

// Returns the mode that was set before.
static inline DipFpMode dip_fp_mode_set(void) {
#if defined(__x86_64__)
    const unsigned before = _mm_getcsr();
    _mm_setcsr(0x1f80); // exceptions masked, nearest, no FTZ, no DAZ
    return before;
#elif defined(__aarch64__)
    uint64_t before;
    __asm__ volatile("mrs %0, fpcr" : "=r"(before));
    __asm__ volatile("msr fpcr, %0" : : "r"((uint64_t)0));
    return before;
#else
    return 0;
#endif
}

static inline void dip_fp_mode_restore(DipFpMode mode) {
#if defined(__x86_64__)
    _mm_setcsr((unsigned)mode);
#elif defined(__aarch64__)
    __asm__ volatile("msr fpcr, %0" : : "r"(mode));
#else
    (void)mode;
#endif
}

#endif
