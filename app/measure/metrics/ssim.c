// Computes SSIM from the means, the variances and the covariance of every window, which it computes
// with separable filters.
#include "app/measure/metrics/ssim.h"

#include "app/measure/metrics/internal/filters.h"
#include "renderer/base/fp_mode.h"

#include <math.h>
#include <stdlib.h>

// Number of the planes of u, v, u^2, v^2 and u v, where u and v are the centred lumas of the two
// pictures.
enum { MOMENTS = 5 };

static DipKernel1D window(void) {
    const double sigma = 1.5;
    DipKernel1D kernel = {.radius = DIP_SSIM_RADIUS};
    double weights[2 * DIP_SSIM_RADIUS + 1];
    double sum = 0.0;
    for (int i = -DIP_SSIM_RADIUS; i <= DIP_SSIM_RADIUS; i++) {
        weights[i + DIP_SSIM_RADIUS] = exp(-i * i / (2.0 * sigma * sigma));
        sum += weights[i + DIP_SSIM_RADIUS];
    }
    for (int i = 0; i <= 2 * DIP_SSIM_RADIUS; i++) {
        kernel.weights[i] = (float)(weights[i] / sum);
    }
    return kernel;
}

// Returns luma minus the middle of its range. A variance is computed as a difference of squares,
// which loses fewer digits if the values are near zero.
static float centred_luma(const uint8_t *rgb) {
    return (0.299f * rgb[0] + 0.587f * rgb[1] + 0.114f * rgb[2]) - 127.5f;
}

static void fill_products(const DipSrgbPicture *test, const DipSrgbPicture *truth,
                          float *const planes[MOMENTS]) {
    size_t i = 0;
    for (int y = 0; y < test->height; y++) {
        const uint8_t *a = test->rgba8 + (size_t)y * test->stride_bytes;
        const uint8_t *b = truth->rgba8 + (size_t)y * truth->stride_bytes;
        for (int x = 0; x < test->width; x++, i++) {
            const float u = centred_luma(a + 4 * x);
            const float v = centred_luma(b + 4 * x);
            planes[0][i] = u;
            planes[1][i] = v;
            planes[2][i] = u * u;
            planes[3][i] = v * v;
            planes[4][i] = u * v;
        }
    }
}

static float similarity(float *const planes[MOMENTS], size_t i) {
    const double c1 = (0.01 * 255.0) * (0.01 * 255.0);
    const double c2 = (0.03 * 255.0) * (0.03 * 255.0);
    const double u = (double)planes[0][i], v = (double)planes[1][i];
    const double variance_a = (double)planes[2][i] - u * u;
    const double variance_b = (double)planes[3][i] - v * v;
    const double covariance = (double)planes[4][i] - u * v;
    const double a = u + 127.5, b = v + 127.5;
    return (float)((2.0 * a * b + c1) * (2.0 * covariance + c2) /
                   ((a * a + b * b + c1) * (variance_a + variance_b + c2)));
}

bool dip_ssim_map(const DipSrgbPicture *test, const DipSrgbPicture *truth, float *map) {
    DIP_FP_MODE_SCOPE();
    const int width = test->width, height = test->height;
    const size_t count = (size_t)width * (size_t)height;
    const DipKernel1D kernel = window();
    float *scratch =
        malloc((count * (MOMENTS + 1) + (size_t)width + 2 * DIP_SSIM_RADIUS) * sizeof *scratch);
    if (!scratch) {
        return false;
    }
    float *planes[MOMENTS];
    float *rows = scratch + count * MOMENTS;
    for (int m = 0; m < MOMENTS; m++) {
        planes[m] = scratch + count * (size_t)m;
    }
    fill_products(test, truth, planes);
    for (int m = 0; m < MOMENTS; m++) {
        dip_convolve_rows(&kernel, planes[m], width, height, rows + count, rows);
        dip_convolve_columns(&kernel, rows, width, height, planes[m]);
    }
    for (size_t i = 0; i < count; i++) {
        const int x = (int)(i % (size_t)width), y = (int)(i / (size_t)width);
        const bool whole = x >= DIP_SSIM_RADIUS && x < width - DIP_SSIM_RADIUS &&
                           y >= DIP_SSIM_RADIUS && y < height - DIP_SSIM_RADIUS;
        map[i] = whole ? similarity(planes, i) : NAN;
    }
    free(scratch);
    return true;
}
