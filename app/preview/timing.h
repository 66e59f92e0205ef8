// Keeps the frame times of the last second, for their median and their number.
#ifndef DIP_APP_PREVIEW_TIMING_H
#define DIP_APP_PREVIEW_TIMING_H

#include <stdint.h>

enum { DIP_TIMING_SAMPLES = 256 };

// Zero-initialise.
typedef struct DipTiming {
    int64_t at_ns[DIP_TIMING_SAMPLES];
    double ms[DIP_TIMING_SAMPLES];
    unsigned count; // Number of times added since the start.
} DipTiming;

void dip_timing_add(DipTiming *timing, int64_t now_ns, double ms);
void dip_timing_clear(DipTiming *timing);

// Median of the last second's times. If none is that young, the last time; 0 if there is none.
double dip_timing_median_ms(const DipTiming *timing, int64_t now_ns);

// Number of times added in the last second, at most DIP_TIMING_SAMPLES.
int dip_timing_per_second(const DipTiming *timing, int64_t now_ns);

#endif
