// Separable filters over planes of floats.
#ifndef DIP_APP_MEASURE_CONVOLVE_H
#define DIP_APP_MEASURE_CONVOLVE_H

enum { DIP_KERNEL_MAX_RADIUS = 80 };

// weights[radius + i] is for the value i places on. Sums are taken from the lowest i up.
typedef struct DipKernel1D {
    int radius;
    float weights[2 * DIP_KERNEL_MAX_RADIUS + 1];
} DipKernel1D;

// Beyond the border the border's value goes on. out is another plane than in. padded: room for
// width + 2 * radius values.
void dip_convolve_rows(const DipKernel1D *kernel, const float *in, int width, int height,
                       float *padded, float *out);
void dip_convolve_columns(const DipKernel1D *kernel, const float *in, int width, int height,
                          float *out);

#endif
