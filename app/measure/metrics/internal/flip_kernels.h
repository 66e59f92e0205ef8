// The filters of FLIP for one number of pixels per degree.
#ifndef DIP_APP_MEASURE_METRICS_INTERNAL_FLIP_KERNELS_H
#define DIP_APP_MEASURE_METRICS_INTERNAL_FLIP_KERNELS_H

#include "app/measure/metrics/internal/convolve.h"

// All filters are applied along x and along y. They are defined in sections 4.1.1 (contrast
// sensitivity) and 4.2 (features) of the paper that flip.h names.
typedef struct DipFlipKernels {
    DipKernel1D luma;      // Contrast sensitivity of Y.
    DipKernel1D red_green; // Contrast sensitivity of Cx.
    DipKernel1D blue[2];   // Contrast sensitivity of Cz: the sum of two Gaussians.
    DipKernel1D gauss;     // Gaussian, applied across the derivative's axis.
    DipKernel1D edge;      // First derivative, which finds edges.
    DipKernel1D point;     // Second derivative, which finds points and lines.
} DipFlipKernels;

DipFlipKernels dip_flip_kernels(double pixels_per_degree);

#endif
