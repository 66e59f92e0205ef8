// A monotonic clock for measuring times.
#ifndef DIP_RENDERER_BASE_CLOCK_H
#define DIP_RENDERER_BASE_CLOCK_H

#include "renderer/base/api.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Returns nanoseconds since an unspecified moment. Thread-safe.
DIP_API int64_t dip_clock_ns(void);

#ifdef __cplusplus
}
#endif

#endif
