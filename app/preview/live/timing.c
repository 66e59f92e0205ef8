// A ring buffer of frame times.
#include "app/preview/live/timing.h"

#include "app/measure/stats/estimate.h"

static const int64_t window_ns = 1000000000;

void dip_timing_add(DipTiming *timing, int64_t now_ns, double ms) {
    const unsigned slot = timing->count++ % DIP_TIMING_SAMPLES;
    timing->at_ns[slot] = now_ns;
    timing->ms[slot] = ms;
}

void dip_timing_clear(DipTiming *timing) {
    timing->count = 0;
}

// Collects the times of the last second, newest first. Returns their number.
static int young(const DipTiming *timing, int64_t now_ns, double *ms) {
    const unsigned kept = timing->count < DIP_TIMING_SAMPLES ? timing->count : DIP_TIMING_SAMPLES;
    int found = 0;
    for (unsigned i = 1; i <= kept; ++i) {
        const unsigned slot = (timing->count - i) % DIP_TIMING_SAMPLES;
        if (now_ns - timing->at_ns[slot] >= window_ns) {
            break;
        }
        ms[found++] = timing->ms[slot];
    }
    return found;
}

double dip_timing_median_ms(const DipTiming *timing, int64_t now_ns) {
    double ms[DIP_TIMING_SAMPLES];
    const int found = young(timing, now_ns, ms);
    if (found == 0) {
        return timing->count ? timing->ms[(timing->count - 1) % DIP_TIMING_SAMPLES] : 0.0;
    }
    return dip_percentile(ms, found, 0.5);
}

int dip_timing_per_second(const DipTiming *timing, int64_t now_ns) {
    double ms[DIP_TIMING_SAMPLES];
    return young(timing, now_ns, ms);
}

int dip_timing_recent(const DipTiming *timing, int64_t now_ns, int64_t span_ns,
                      double ms[DIP_TIMING_SAMPLES], int64_t age_ns[DIP_TIMING_SAMPLES]) {
    const unsigned kept = timing->count < DIP_TIMING_SAMPLES ? timing->count : DIP_TIMING_SAMPLES;
    int found = 0;
    for (unsigned i = 1; i <= kept; ++i) {
        const unsigned slot = (timing->count - i) % DIP_TIMING_SAMPLES;
        if (now_ns - timing->at_ns[slot] >= span_ns) {
            break;
        }
        ms[found] = timing->ms[slot];
        age_ns[found++] = now_ns - timing->at_ns[slot];
    }
    return found;
}
