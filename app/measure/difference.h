// Differences of two pictures pixel by pixel, and their means: the root mean square error in linear
// light and the peak signal-to-noise ratio on sRGB codes.
//
// A map has one value per pixel, width * height values with rows packed. Sums are taken in double
// and in pixel order, so that one map always gives one sum. All functions are thread-safe; both
// pictures must have one size.
#ifndef DIP_APP_MEASURE_DIFFERENCE_H
#define DIP_APP_MEASURE_DIFFERENCE_H

#include "app/measure/picture.h"

#ifdef __cplusplus
extern "C" {
#endif

// Writes test - truth in linear light, 3 values per pixel in -1..1. truth_lin has 3 values per
// pixel in 0..1.
void dip_difference_lin(const DipSrgbPicture *test, const float *truth_lin, float *error_lin);

// Writes the mean over the three channels of the squared linear difference. `map` may be
// `error_lin`.
void dip_difference_squared_map(const float *error_lin, size_t pixel_count, float *map);

// Writes the mean over the three channels of the squared difference of codes, 0..65025.
void dip_difference_codes_map(const DipSrgbPicture *test, const DipSrgbPicture *truth, float *map);

// The sum of a map over some pixels, and the number of these pixels. Sums of several pictures can
// be added; their mean is then the mean over all of them.
typedef struct DipMapSum {
    double sum;
    double pixel_count;
} DipMapSum;

// Values that are not a number (SSIM near the border) are skipped and not counted.
DipMapSum dip_map_sum(const float *map, size_t pixel_count, DipPixelMask mask);

// The mean; 0 if there is no pixel.
double dip_map_mean(DipMapSum sum);

// Peak signal-to-noise ratio in decibels, 10 log10(255^2 / mean squared difference of codes).
// Infinite for 0.
double dip_psnr_db(double mean_squared_codes);

#ifdef __cplusplus
}
#endif

#endif
