// A monotonic clock for measuring times.
#ifndef DIP_RENDERER_BASE_CLOCK_H
#define DIP_RENDERER_BASE_CLOCK_H

#include <stdint.h>
#include <time.h>

#ifdef __cplusplus
extern "C" {
#endif

// Returns nanoseconds since an unspecified moment. Thread-safe.
static inline int64_t dip_clock_ns(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

#ifdef __cplusplus
}
#endif

#endif
