// Sets floating-point modes.
#include "tests/stability/fp_modes.h"

#include <stddef.h>

static const int rounding[] = {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};

#if defined(__SSE2__)
enum { FLUSH_BITS = 0x8040 }; // FTZ and DAZ of MXCSR

static void set_flush(void) {
    uint32_t mode;
    __asm__ volatile("stmxcsr %0" : "=m"(mode));
    mode |= FLUSH_BITS;
    __asm__ volatile("ldmxcsr %0" : : "m"(mode) : "memory");
}

static bool has_flush(void) {
    uint32_t mode;
    __asm__ volatile("stmxcsr %0" : "=m"(mode));
    return (mode & FLUSH_BITS) == FLUSH_BITS;
}
#elif defined(__aarch64__)
enum { FLUSH_BITS = 1 << 24 }; // FZ of FPCR

static void set_flush(void) {
    uint64_t mode;
    __asm__ volatile("mrs %0, fpcr" : "=r"(mode));
    mode |= FLUSH_BITS;
    __asm__ volatile("msr fpcr, %0" : : "r"(mode) : "memory");
}

static bool has_flush(void) {
    uint64_t mode;
    __asm__ volatile("mrs %0, fpcr" : "=r"(mode));
    return (mode & FLUSH_BITS) != 0;
}
#else
#error "fp_modes.c does not know how this processor flushes subnormal numbers"
#endif

const char *fp_mode_name(FpMode mode) {
    static const char *const names[] = {"upward", "downward", "toward zero", "flush to zero"};
    return names[mode];
}

FpModeState fp_mode_enter(FpMode mode) {
    FpModeState before;
    fegetenv(&before.environment);
    if (mode == FP_MODE_FLUSH_TO_ZERO) {
        set_flush();
    } else {
        fesetround(rounding[mode]);
    }
    return before;
}

bool fp_mode_is(FpMode mode) {
    return mode == FP_MODE_FLUSH_TO_ZERO ? has_flush() : fegetround() == rounding[mode];
}

void fp_mode_return(FpModeState before) {
    fesetenv(&before.environment);
}
