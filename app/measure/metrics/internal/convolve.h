// Separable filters over planes of floats. Thread-safe: no state.
#ifndef DIP_APP_MEASURE_METRICS_INTERNAL_CONVOLVE_H
#define DIP_APP_MEASURE_METRICS_INTERNAL_CONVOLVE_H

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

#endif
