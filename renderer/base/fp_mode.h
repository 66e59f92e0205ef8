// The floating-point mode of every thread that draws: round to nearest, subnormals kept.
//
// A host program may have set flush-to-zero; linking with fast-math start-up code sets it, for
// example. Pictures must not depend on the host's mode. The pool therefore sets this mode for its
// own work and restores the caller's mode afterwards.
#ifndef DIP_RENDERER_BASE_FP_MODE_H
#define DIP_RENDERER_BASE_FP_MODE_H

#include <stdint.h>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

typedef uint64_t DipFpMode;

// Sets the mode of the calling thread. Returns the thread's previous mode.
static inline DipFpMode dip_fp_mode_set(void) {
#if defined(__x86_64__)
    const unsigned before = _mm_getcsr();
    _mm_setcsr(0x1f80); // exceptions masked, round to nearest, neither FTZ nor DAZ
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

// Restores a mode that dip_fp_mode_set returned.
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
