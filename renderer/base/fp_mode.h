// The floating-point mode in which Diptych computes: round to nearest, subnormals kept.
//
// A host program may have chosen another rounding mode, or flush-to-zero; start-up code that
// -ffast-math links in sets flush-to-zero, for example. Results must not depend on the host's mode.
// Every public function that computes with floats therefore sets this mode first and restores the
// caller's mode before it returns. If the mode is set already, both cost a few nanoseconds.
//
// Compilers do not know that arithmetic depends on the mode, so they may move it across the change
// of mode. The functions below keep them from moving loads and stores. A public function whose
// floating-point parameters or results are values, not memory, must also pin these values with
// DIP_FP_PIN or DIP_FP_PIN_STRUCT after the scope begins and before it ends.
#ifndef DIP_RENDERER_BASE_FP_MODE_H
#define DIP_RENDERER_BASE_FP_MODE_H

#include "renderer/base/platform.h"

#include <stdint.h>

typedef uint64_t DipFpMode;

#if defined(__SSE2__)
enum {
    // MXCSR: exceptions masked, round to nearest, neither FTZ nor DAZ. The low six bits are flags
    // of past exceptions, which change nothing.
    DIP_FP_MXCSR = 0x1f80,
    DIP_FP_MXCSR_FLAGS = 0x3f,
    // Control word of the x87 unit, which some C libraries use: exceptions masked, 64 bits of
    // precision, round to nearest.
    DIP_FP_X87 = 0x037f,
};

// Loads both modes, unless they are set already. A mode is (x87 control word << 32) | MXCSR.
static inline void dip_fp_mode_load(DipFpMode from, DipFpMode to) {
    const uint32_t mxcsr = (uint32_t)to;
    const uint16_t x87 = (uint16_t)(to >> 32);
    if (((uint32_t)from ^ mxcsr) & ~(uint32_t)DIP_FP_MXCSR_FLAGS) {
        __asm__ volatile("ldmxcsr %0" : : "m"(mxcsr) : "memory");
    }
    if ((uint16_t)(from >> 32) != x87) {
        __asm__ volatile("fldcw %0" : : "m"(x87) : "memory");
    }
}
#define DIP_FP_MODE ((DipFpMode)DIP_FP_X87 << 32 | DIP_FP_MXCSR)
#endif

// Sets the mode of the calling thread. Returns the thread's previous mode.
static inline DipFpMode dip_fp_mode_set(void) {
#if defined(__SSE2__)
    uint32_t mxcsr = 0; // The memory sanitizer does not see what the instructions write.
    uint16_t x87 = 0;
    __asm__ volatile("stmxcsr %0" : "+m"(mxcsr) : : "memory");
    __asm__ volatile("fnstcw %0" : "+m"(x87) : : "memory");
    const DipFpMode before = (DipFpMode)x87 << 32 | mxcsr;
    dip_fp_mode_load(before, DIP_FP_MODE);
    return before;
#elif defined(__aarch64__)
    uint64_t before;
    __asm__ volatile("mrs %0, fpcr" : "=r"(before) : : "memory");
    if (before) {
        __asm__ volatile("msr fpcr, %0" : : "r"((uint64_t)0) : "memory");
    }
    return before;
#else
    return 0;
#endif
}

// Restores a mode that dip_fp_mode_set returned.
static inline void dip_fp_mode_restore(DipFpMode mode) {
#if defined(__SSE2__)
    dip_fp_mode_load(DIP_FP_MODE, mode);
#elif defined(__aarch64__)
    if (mode) {
        __asm__ volatile("msr fpcr, %0" : : "r"(mode) : "memory");
    }
#else
    (void)mode;
#endif
}

static inline void dip_fp_mode_leave(const DipFpMode *mode) {
    dip_fp_mode_restore(*mode);
}

// Sets the mode until the end of the block in which this stands.
#define DIP_FP_MODE_SCOPE()                                                                        \
    __attribute__((cleanup(dip_fp_mode_leave), unused)) const DipFpMode dip_fp_mode_before =       \
        dip_fp_mode_set()

// Makes every computation that uses this variable wait until here, and every computation that
// assigns it happen before here. The variable is a float or a double.
#if defined(__SSE2__)
#define DIP_FP_PIN(variable) __asm__ volatile("" : "+x"(variable) : : "memory")
#elif defined(__aarch64__)
#define DIP_FP_PIN(variable) __asm__ volatile("" : "+w"(variable) : : "memory")
#else
#define DIP_FP_PIN(variable) __asm__ volatile("" : "+m"(variable) : : "memory")
#endif

// Does the same for a structure, which a function returns as a value.
#define DIP_FP_PIN_STRUCT(variable) __asm__ volatile("" : "+m"(variable) : : "memory")

#endif
