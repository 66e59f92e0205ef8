// Computes differences of two pictures pixel by pixel, and metrics from their means: the root mean
// square error in linear light and the peak signal-to-noise ratio on sRGB codes (the 8-bit values
// of the channels). `test` is the picture that is judged; `truth` is the picture that it is
// compared with.
//
// A map has one value per pixel: width * height values with rows packed. Sums are computed in
// double precision and in pixel order, so the same map always gives the same sum. All functions are
// thread-safe. Both pictures must have the same size.
#ifndef DIP_APP_MEASURE_METRICS_DIFFERENCE_H
#define DIP_APP_MEASURE_METRICS_DIFFERENCE_H

#include "renderer/base/api.h"
#include "app/measure/metrics/picture.h"

#ifdef __cplusplus
extern "C" {
#endif

// Writes test - truth in linear light, 3 values per pixel in -1..1. truth_lin has 3 values per
// pixel in 0..1.
DIP_API void dip_difference_lin(const DipSrgbPicture *test, const float *truth_lin,
                                float *error_lin);

// Writes for each pixel the mean of the squared linear differences of its three channels. `map` may
// be the same array as `error_lin`.
DIP_API void dip_difference_squared_map(const float *error_lin, size_t pixel_count, float *map);

// Writes for each pixel the mean of the squared code differences of its three channels, 0..65025.
DIP_API void dip_difference_codes_map(const DipSrgbPicture *test, const DipSrgbPicture *truth,
                                      float *map);

// The sum of a map over some pixels, and the number of these pixels. Sums of several pictures can
// be added; the mean of the total is the mean over all their pixels.
typedef struct DipMapSum {
    double sum;
    double pixel_count;
} DipMapSum;

// Adds the next pixel_count pixels of a map to a sum, but only those that `mask` selects. A map
// that is added in parts gives the same result as a map that is added at once. Values that are not
// a number (SSIM near the border) are skipped and not counted.
DIP_API void dip_map_sum_add(DipMapSum *sum, const float *map, size_t pixel_count,
                             DipPixelMask mask);

// Returns the peak signal-to-noise ratio in decibels: 10 log10(255^2 / mean_squared_codes). It is
// infinite if mean_squared_codes is 0, and NaN if it is NaN or negative.
DIP_API double dip_psnr_db(double mean_squared_codes);

#ifdef __cplusplus
}
#endif

#endif
