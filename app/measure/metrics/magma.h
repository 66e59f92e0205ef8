// The palette in which FLIP maps are shown: black, purple, orange, light yellow.
#ifndef DIP_APP_MEASURE_METRICS_MAGMA_H
#define DIP_APP_MEASURE_METRICS_MAGMA_H

#include <stdint.h>

// Writes the sRGB colour of an error in 0..1. Values outside 0..1 are clamped. Thread-safe.
void dip_magma(float error, uint8_t rgb[3]);

#endif
