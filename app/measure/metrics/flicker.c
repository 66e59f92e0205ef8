// Computes running means and deviations of errors over successive frames.
#include "app/measure/metrics/flicker.h"

#include "renderer/base/fp_mode.h"

#include <stdlib.h>
#include <string.h>

bool dip_flicker_init(DipFlicker *flicker, size_t value_count) {
    *flicker = (DipFlicker){
        .mean = calloc(value_count, sizeof *flicker->mean),
        .deviation = calloc(value_count, sizeof *flicker->deviation),
        .last = calloc(value_count, sizeof *flicker->last),
        .value_count = value_count,
    };
    if (!flicker->mean || !flicker->deviation || !flicker->last) {
        dip_flicker_free(flicker);
        return false;
    }
    return true;
}

void dip_flicker_free(DipFlicker *flicker) {
    free(flicker->mean);
    free(flicker->deviation);
    free(flicker->last);
    *flicker = (DipFlicker){0};
}

void dip_flicker_restart(DipFlicker *flicker) {
    memset(flicker->mean, 0, flicker->value_count * sizeof *flicker->mean);
    memset(flicker->deviation, 0, flicker->value_count * sizeof *flicker->deviation);
    flicker->added = 0;
    flicker->frame_count = 0;
    flicker->step_squares = 0.0;
    flicker->pair_squares = 0.0;
}

// Uses Welford's update, which computes mean and variance without subtracting large sums.
void dip_flicker_add(DipFlicker *flicker, const float *error_lin, size_t count) {
    DIP_FP_MODE_SCOPE();
    double *mean = flicker->mean + flicker->added;
    double *deviation = flicker->deviation + flicker->added;
    float *last = flicker->last + flicker->added;
    flicker->frame_count += flicker->added == 0;
    for (size_t i = 0; i < count; i++) {
        const double e = (double)error_lin[i];
        const double before = (double)last[i];
        const double from_old_mean = e - mean[i];
        mean[i] += from_old_mean / flicker->frame_count;
        deviation[i] += from_old_mean * (e - mean[i]);
        if (flicker->frame_count > 1) {
            flicker->step_squares += (e - before) * (e - before);
            flicker->pair_squares += 0.25 * (e + before) * (e + before);
        }
    }
    memcpy(last, error_lin, count * sizeof *error_lin);
    flicker->added = (flicker->added + count) % flicker->value_count;
}

DipFlickerResult dip_flicker_result(const DipFlicker *flicker) {
    DIP_FP_MODE_SCOPE();
    const double frames = flicker->frame_count;
    const double values = (double)flicker->value_count;
    DipFlickerResult result = {0};
    for (size_t i = 0; flicker->frame_count > 0 && i < flicker->value_count; i++) {
        result.squared_static += flicker->mean[i] * flicker->mean[i] / values;
        result.squared_flicker += flicker->deviation[i] / (values * frames);
    }
    if (flicker->frame_count > 1) {
        result.squared_step = flicker->step_squares / (values * (frames - 1.0));
        result.squared_two_mean = flicker->pair_squares / (values * (frames - 1.0));
    }
    DIP_FP_PIN_STRUCT(result);
    return result;
}
