// Filters planes of floats with separable kernels, and computes the kernels of FLIP (flip.h). All
// functions are thread-safe.
#ifndef DIP_APP_MEASURE_METRICS_INTERNAL_FILTERS_H
#define DIP_APP_MEASURE_METRICS_INTERNAL_FILTERS_H

enum { DIP_KERNEL_MAX_RADIUS = 80 };

// A one-dimensional kernel. weights[radius + i] multiplies the value at offset i, -radius..radius.
// Products are added from the lowest i to the highest.
typedef struct DipKernel1D {
    int radius;
    float weights[2 * DIP_KERNEL_MAX_RADIUS + 1];
} DipKernel1D;

// Filters width * height values along x (rows) or y (columns). Values beyond the border repeat the
// border's value. `out` and `in` must be different planes. `padded` has room for width + 2 * radius
// values.
void dip_convolve_rows(const DipKernel1D *kernel, const float *in, int width, int height,
                       float *padded, float *out);
void dip_convolve_columns(const DipKernel1D *kernel, const float *in, int width, int height,
                          float *out);

// The kernels of FLIP. A filter applies one of them along x and one along y. Sections 4.1.1
// (contrast sensitivity) and 4.2 (features) of the paper that flip.h names define them.
typedef struct DipFlipKernels {
    DipKernel1D luma;      // Contrast sensitivity of Y.
    DipKernel1D red_green; // Contrast sensitivity of Cx.
    DipKernel1D blue[2];   // Contrast sensitivity of Cz: the sum of two Gaussians.
    DipKernel1D gauss;     // Gaussian, applied along the axis without a derivative.
    DipKernel1D edge;      // First derivative, which finds edges.
    DipKernel1D point;     // Second derivative, which finds points and lines.
} DipFlipKernels;

// Returns the kernels for a resolution in DIP_FLIP_MIN_PIXELS_PER_DEGREE..
// DIP_FLIP_MAX_PIXELS_PER_DEGREE.
DipFlipKernels dip_flip_kernels(double pixels_per_degree);

#endif
