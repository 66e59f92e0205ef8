// Error over time: what stands still, and what flickers.
//
// With e = test - truth at the same instant, per pixel and channel in linear light, the mean of e^2
// over a burst of frames is the square of e's mean plus e's variance. Summed over the picture the
// first is the static error, the second flicker; as roots of means
//     rms^2 = static^2 + flicker^2.
#ifndef DIP_APP_MEASURE_FLICKER_H
#define DIP_APP_MEASURE_FLICKER_H

#include <stdbool.h>
#include <stddef.h>

// Sums over a burst of frames that follow each other.
typedef struct DipFlicker {
    double *mean;      // of e, per value
    double *deviation; // the sum of squared differences from the mean
    float *last;       // e of the frame before
    size_t value_count;
    int frame_count;
    double squares;      // of e, over all values and frames
    double step_squares; // of e less the last e, over all values and steps
    double pair_squares; // of the mean of e and the last e
} DipFlicker;

// value_count: pixels times channels. False when memory runs out.
bool dip_flicker_init(DipFlicker *flicker, size_t value_count);
void dip_flicker_free(DipFlicker *flicker);

// Begins another burst.
void dip_flicker_restart(DipFlicker *flicker);

void dip_flicker_add(DipFlicker *flicker, const float *error_lin);

// Mean squares over the burst's values.
typedef struct DipFlickerResult {
    double squared;          // of e
    double squared_static;   // of the mean of e over time
    double squared_flicker;  // variance of e over time
    double squared_step;     // of the change of e from frame to frame; 0 of a single frame
    double squared_two_mean; // of the mean of two frames' e, what a fast display shows; likewise
} DipFlickerResult;

DipFlickerResult dip_flicker_result(const DipFlicker *flicker);

#endif
