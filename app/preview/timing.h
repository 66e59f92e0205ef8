// Frame times of the last second: their median and how many there were.
#ifndef DIP_APP_PREVIEW_TIMING_H
#define DIP_APP_PREVIEW_TIMING_H

#include <stdint.h>

enum { DIP_TIMING_SAMPLES = 256 };

// Zero-initialise.
typedef struct DipTiming {
    int64_t at_ns[DIP_TIMING_SAMPLES];
    double ms[DIP_TIMING_SAMPLES];
    unsigned count; // ever added
} DipTiming;

void dip_timing_add(DipTiming *timing, int64_t now_ns, double ms);
void dip_timing_clear(DipTiming *timing);

// Of the last second; when nothing is that young, the last one. 0 when there is none at all.
double dip_timing_median_ms(const DipTiming *timing, int64_t now_ns);

// How many were added in the last second (at most DIP_TIMING_SAMPLES).
int dip_timing_per_second(const DipTiming *timing, int64_t now_ns);

#endif
