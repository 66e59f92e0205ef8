// Sets floating-point modes that a host program may have chosen.
#ifndef DIP_RENDERER_CATALOGUE_FP_MODES_H
#define DIP_RENDERER_CATALOGUE_FP_MODES_H

#include <fenv.h>
#include <stdbool.h>
#include <stdint.h>

typedef enum FpMode {
    FP_MODE_UPWARD,
    FP_MODE_DOWNWARD,
    FP_MODE_TOWARD_ZERO,
    FP_MODE_FLUSH_TO_ZERO, // subnormal results and operands become zero
    FP_MODE_SHORT_X87,     // the x87 unit computes with 24 bits
    FP_MODE_COUNT
} FpMode;

// The mode before fp_mode_enter.
typedef struct FpModeState {
    int rounding;
    uint64_t flushing; // the register that holds the bits for flushing
    uint16_t x87;      // the control word of the x87 unit; 0 on other processors
} FpModeState;

const char *fp_mode_name(FpMode mode);
// Enters the mode. On a processor without an x87 unit, FP_MODE_SHORT_X87 changes nothing.
FpModeState fp_mode_enter(FpMode mode);
// Returns whether the thread still computes in this mode.
bool fp_mode_is(FpMode mode);
void fp_mode_return(FpModeState before);

#endif
