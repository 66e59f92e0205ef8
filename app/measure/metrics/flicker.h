// Splits the error over time into a part that stays constant and a part that flickers.
//
// For each pixel and channel, let e = test - truth be the difference, in linear light, of a tested
// picture from the converged picture (the truth) of the same instant. Over a burst (a few
// successive frames), the mean of e^2 equals the square of the mean of e plus the variance of e.
// Averaged over the whole picture, the first term is the squared static error and the second term
// is the squared flicker:
//     rms^2 = static^2 + flicker^2.
#ifndef DIP_APP_MEASURE_METRICS_FLICKER_H
#define DIP_APP_MEASURE_METRICS_FLICKER_H

#include "renderer/base/api.h"

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// Running sums over a burst of successive frames. Owns its arrays. Use one per thread.
typedef struct DipFlicker {
    double *mean;       // [value_count]: mean of e so far.
    double *deviation;  // [value_count]: sum of squared deviations of e from its mean.
    float *last;        // e of the previous frame.
    size_t value_count; // Number of values of a frame.
    size_t added;       // Number of values that the unfinished frame has so far.
    int frame_count;
    double step_squares; // Sum of (e - previous e)^2 over all values and pairs of frames.
    double pair_squares; // Sum of ((e + previous e) / 2)^2 over all values and pairs of frames.
} DipFlicker;

// value_count is the number of pixels times the number of channels, at least 1. Returns false when
// memory runs out; *flicker then owns nothing.
DIP_API bool dip_flicker_init(DipFlicker *flicker, size_t value_count);
DIP_API void dip_flicker_free(DipFlicker *flicker);

// Begins a new burst.
DIP_API void dip_flicker_restart(DipFlicker *flicker);

// Adds the next `count` values of a frame, in the order in which dip_difference_lin writes them. A
// frame may be added in parts and is complete after value_count values.
DIP_API void dip_flicker_add(DipFlicker *flicker, const float *error_lin, size_t count);

// Mean squares over all values of the burst. A single frame has no previous frame, so its
// squared_step and squared_two_mean are 0. A burst without frames has only zeros.
typedef struct DipFlickerResult {
    double squared_static;  // Square of the mean of e over time.
    double squared_flicker; // Variance of e over time.
    double squared_step;    // Squared change of e from one frame to the next.
    // Square of the mean of e in two successive frames. On a fast display, a viewer sees the mean
    // of two frames.
    double squared_two_mean;
} DipFlickerResult;

DIP_API DipFlickerResult dip_flicker_result(const DipFlicker *flicker);

#ifdef __cplusplus
}
#endif

#endif
