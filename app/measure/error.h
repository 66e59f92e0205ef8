// Errors pixel by pixel, and their means: the root mean square in linear light, the peak
// signal-to-noise ratio on sRGB codes.
//
// A map is width * height values, rows packed. Means are taken over a region's pixels in double,
// in order, so that they are the same for the same map.
#ifndef DIP_APP_MEASURE_ERROR_H
#define DIP_APP_MEASURE_ERROR_H

#include "app/measure/picture.h"

// test - truth in linear light, 0..1; 3 values per pixel, as truth_lin has them.
void dip_error_lin(const DipPicture *test, const float *truth_lin, float *error_lin);

// The mean over the channels of the squared difference of linear light.
void dip_error_squared_map(const float *error_lin, size_t pixel_count, float *map);

// The mean over the channels of the squared difference of codes, 0..65025.
void dip_error_codes_map(const DipPicture *test, const DipPicture *truth, float *map);

// The sum of a map over a region, and of how many pixels it is: sums of several pictures add up to
// a mean over all of them. Not-a-number is passed over.
typedef struct DipErrorSum {
    double sum;
    double pixel_count;
} DipErrorSum;

DipErrorSum dip_error_sum(const float *map, size_t pixel_count, DipRegion region);

// The mean; 0 of no pixels.
double dip_error_mean(DipErrorSum sum);

// Of mean squared differences of codes; infinite for 0.
double dip_error_psnr_db(double mean_squared_codes);

#endif
