// Sets floating-point modes.
#include "renderer/catalogue/fp_modes.h"

#include <stddef.h>

static const int rounding[] = {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};

#if defined(__SSE2__)
enum { FLUSH_BITS = 0x8040, X87_PRECISION = 0x300 }; // FTZ and DAZ of MXCSR

static uint16_t read_x87(void) {
    uint16_t word = 0;
    __asm__ volatile("fnstcw %0" : "+m"(word));
    return word;
}

static void write_x87(uint16_t word) {
    __asm__ volatile("fldcw %0" : : "m"(word) : "memory");
}

static uint64_t read_register(void) {
    uint32_t mode = 0;
    __asm__ volatile("stmxcsr %0" : "+m"(mode));
    return mode;
}

static void write_register(uint64_t value) {
    const uint32_t mode = (uint32_t)value;
    __asm__ volatile("ldmxcsr %0" : : "m"(mode) : "memory");
}
#elif defined(__aarch64__)
enum { FLUSH_BITS = 1 << 24, X87_PRECISION = 0 }; // FZ of FPCR

static uint16_t read_x87(void) {
    return 0;
}

static void write_x87(uint16_t word) {
    (void)word;
}

static uint64_t read_register(void) {
    uint64_t mode;
    __asm__ volatile("mrs %0, fpcr" : "=r"(mode));
    return mode;
}

static void write_register(uint64_t mode) {
    __asm__ volatile("msr fpcr, %0" : : "r"(mode) : "memory");
}
#else
#error "fp_modes.c does not know how this processor flushes subnormal numbers"
#endif

const char *fp_mode_name(FpMode mode) {
    static const char *const names[] = {"upward", "downward", "toward zero", "flush to zero",
                                        "24 bits of x87"};
    return names[mode];
}

FpModeState fp_mode_enter(FpMode mode) {
    const FpModeState before = {fegetround(), read_register(), read_x87()};
    if (mode == FP_MODE_FLUSH_TO_ZERO) {
        write_register(read_register() | FLUSH_BITS);
    } else if (mode == FP_MODE_SHORT_X87) {
        write_x87((uint16_t)(read_x87() & ~X87_PRECISION));
    } else {
        fesetround(rounding[mode]);
    }
    return before;
}

bool fp_mode_is(FpMode mode) {
    if (mode == FP_MODE_SHORT_X87) {
        return (read_x87() & X87_PRECISION) == 0;
    }
    return mode == FP_MODE_FLUSH_TO_ZERO ? (read_register() & FLUSH_BITS) == FLUSH_BITS
                                         : fegetround() == rounding[mode];
}

void fp_mode_return(FpModeState before) {
    fesetround(before.rounding); // some C libraries also have another unit with a mode of its own
    write_x87(before.x87);
    write_register(before.flushing);
}
