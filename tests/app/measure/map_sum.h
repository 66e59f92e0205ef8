// Sums and means of whole maps, for tests of the metrics.
#ifndef DIP_TESTS_APP_MEASURE_MAP_SUM_H
#define DIP_TESTS_APP_MEASURE_MAP_SUM_H

#include "app/measure/metrics/difference.h"

static inline DipMapSum dip_map_sum(const float *map, size_t pixel_count, DipPixelMask mask) {
    DipMapSum sum = {0};
    dip_map_sum_add(&sum, map, pixel_count, mask);
    return sum;
}

// Returns the mean; 0 if the sum has no pixels.
static inline double dip_map_mean(DipMapSum sum) {
    return sum.pixel_count > 0.0 ? sum.sum / sum.pixel_count : 0.0;
}

#endif
