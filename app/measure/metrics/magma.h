// The palette in which FLIP maps are shown: black, purple, orange, light yellow.
#ifndef DIP_APP_MEASURE_METRICS_MAGMA_H
#define DIP_APP_MEASURE_METRICS_MAGMA_H

#include "renderer/base/api.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Writes the sRGB colour of an error in 0..1. Values outside 0..1 are clamped. Thread-safe.
DIP_API void dip_magma(float error, uint8_t rgb[3]);

#ifdef __cplusplus
}
#endif

#endif
