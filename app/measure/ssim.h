// Structural similarity (Wang, Bovik, Sheikh, Simoncelli 2004) on the luma of sRGB codes.
//
// Windows are Gaussian, 11x11, of deviation 1.5; K1 = 0.01, K2 = 0.03, L = 255; luma is
// 0.299 R + 0.587 G + 0.114 B, not rounded. As the authors have it only windows that lie within
// the picture count.
#ifndef DIP_APP_MEASURE_SSIM_H
#define DIP_APP_MEASURE_SSIM_H

#include "app/measure/picture.h"

#include <stdbool.h>

enum { DIP_SSIM_RADIUS = 5 };

// map[pixel]: the similarity of the windows around it, at most 1; not-a-number within
// DIP_SSIM_RADIUS of the border. False when memory runs out.
bool dip_ssim_map(const DipPicture *test, const DipPicture *truth, float *map);

#endif
