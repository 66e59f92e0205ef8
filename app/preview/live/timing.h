// Keeps the newest frame times, and computes their median and their number.
#ifndef DIP_APP_PREVIEW_LIVE_TIMING_H
#define DIP_APP_PREVIEW_LIVE_TIMING_H

#include <stdint.h>

enum { DIP_TIMING_SAMPLES = 512 };

// Zero-initialise.
typedef struct DipTiming {
    int64_t at_ns[DIP_TIMING_SAMPLES];
    double ms[DIP_TIMING_SAMPLES];
    unsigned count; // Number of times added so far.
} DipTiming;

void dip_timing_add(DipTiming *timing, int64_t now_ns, double ms);
void dip_timing_clear(DipTiming *timing);

// Returns the median of the times added in the last second. If there are none, returns the time
// added last, or 0 if no time was ever added.
double dip_timing_median_ms(const DipTiming *timing, int64_t now_ns);

// Returns the number of times added in the last second, at most DIP_TIMING_SAMPLES.
int dip_timing_per_second(const DipTiming *timing, int64_t now_ns);

// Copies the times added in the last `span_ns`, the newest first, with their age in nanoseconds.
// Returns their number.
int dip_timing_recent(const DipTiming *timing, int64_t now_ns, int64_t span_ns,
                      double ms[DIP_TIMING_SAMPLES], int64_t age_ns[DIP_TIMING_SAMPLES]);

#endif
