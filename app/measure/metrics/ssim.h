// Computes structural similarity (Wang, Bovik, Sheikh, Simoncelli, "Image Quality Assessment: From
// Error Visibility to Structural Similarity", 2004) on the luma of sRGB codes.
//
// The windows have 11 x 11 pixels with Gaussian weights of standard deviation 1.5. The constants
// are K1 = 0.01, K2 = 0.03 and L = 255. Luma is 0.299 R + 0.587 G + 0.114 B, not rounded. As in the
// authors' implementation, only windows that lie wholly within the picture count.
#ifndef DIP_APP_MEASURE_METRICS_SSIM_H
#define DIP_APP_MEASURE_METRICS_SSIM_H

#include "renderer/base/api.h"
#include "app/measure/metrics/picture.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { DIP_SSIM_RADIUS = 5 }; // Pixels.

// Writes for each pixel the similarity of two windows around the pixel, one in each picture. A
// similarity is at most 1. Pixels within DIP_SSIM_RADIUS of the border get not-a-number. Both
// pictures must have the same size. Returns false when memory runs out. Thread-safe.
DIP_API bool dip_ssim_map(const DipSrgbPicture *test, const DipSrgbPicture *truth, float *map);

#ifdef __cplusplus
}
#endif

#endif
