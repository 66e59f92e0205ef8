// Adds one kernel tap after the other over whole rows, in loops that the compiler turns into vector
// code.
#include "app/measure/metrics/internal/convolve.h"

#include <string.h>

// Adds weights[k] * rows[k] to out for every k, in order. Handles four taps at a time, so that sums
// stay in registers.
static void add_taps(const float *const *rows, const float *weights, int count, int width,
                     float *restrict out) {
    int k = 0;
    for (; k + 4 <= count; k += 4) {
        const float *a = rows[k], *b = rows[k + 1], *c = rows[k + 2], *d = rows[k + 3];
        const float wa = weights[k], wb = weights[k + 1], wc = weights[k + 2], wd = weights[k + 3];
        for (int x = 0; x < width; x++) {
            out[x] = (((out[x] + wa * a[x]) + wb * b[x]) + wc * c[x]) + wd * d[x];
        }
    }
    for (; k < count; k++) {
        for (int x = 0; x < width; x++) {
            out[x] += weights[k] * rows[k][x];
        }
    }
}

void dip_convolve_rows(const DipKernel1D *kernel, const float *in, int width, int height,
                       float *padded, float *out) {
    const int radius = kernel->radius;
    const float *rows[2 * DIP_KERNEL_MAX_RADIUS + 1];
    for (int k = 0; k <= 2 * radius; k++) {
        rows[k] = padded + k;
    }
    for (int y = 0; y < height; y++, in += width, out += width) {
        for (int i = 0; i < radius; i++) {
            padded[i] = in[0];
            padded[radius + width + i] = in[width - 1];
        }
        memcpy(padded + radius, in, sizeof *in * (size_t)width);
        memset(out, 0, sizeof *out * (size_t)width);
        add_taps(rows, kernel->weights, 2 * radius + 1, width, out);
    }
}

void dip_convolve_columns(const DipKernel1D *kernel, const float *in, int width, int height,
                          float *out) {
    const int radius = kernel->radius;
    const float *rows[2 * DIP_KERNEL_MAX_RADIUS + 1];
    for (int y = 0; y < height; y++, out += width) {
        for (int k = -radius; k <= radius; k++) {
            const int from = y + k < 0 ? 0 : y + k >= height ? height - 1 : y + k;
            rows[k + radius] = in + (long)from * width;
        }
        memset(out, 0, sizeof *out * (size_t)width);
        add_taps(rows, kernel->weights, 2 * radius + 1, width, out);
    }
}
