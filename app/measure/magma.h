// The colours that FLIP's error maps are shown in: black over purple and orange to light yellow.
#ifndef DIP_APP_MEASURE_MAGMA_H
#define DIP_APP_MEASURE_MAGMA_H

#include <stdint.h>

// error: 0..1, others are clamped.
void dip_magma(float error, uint8_t rgb[3]);

#endif
