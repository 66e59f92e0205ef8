// Convolves planes with kernels, and computes the kernels of FLIP: the eye's contrast sensitivity,
// and the detectors of edges and points.
#include "app/measure/metrics/internal/filters.h"

#include <math.h>
#include <string.h>

// --- convolving ----------------------------------------------------------------------------------

// Adds weights[k] * rows[k] to out for every k, in order. The loops run over whole rows, so that
// the compiler turns them into vector code. Handles four rows at a time, so that sums stay in
// registers.
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

// --- FLIP's filters ------------------------------------------------------------------------------

static const double pi = 3.14159265358979323846;

// Fills a kernel with factor * exp(-pi^2 x^2 / b), where x is in degrees: the spatial form of a
// Gaussian contrast sensitivity. The caller chooses `factor` so that the weights have the sum
// that FLIP's paper (flip.h) demands. `ppd` is the number of pixels per degree.
static void fill_gaussian(DipKernel1D *kernel, int radius, double ppd, double factor, double b) {
    kernel->radius = radius;
    for (int i = -radius; i <= radius; i++) {
        const double x = i / ppd;
        kernel->weights[i + radius] = (float)(factor * exp(-pi * pi * x * x / b));
    }
}

// Returns the sum of the weights that fill_gaussian would write.
static double sum_gaussian(int radius, double ppd, double factor, double b) {
    double sum = 0.0;
    for (int i = -radius; i <= radius; i++) {
        const double x = i / ppd;
        sum += factor * exp(-pi * pi * x * x / b);
    }
    return sum;
}

static void make_sensitivity(DipFlipKernels *kernels, double ppd) {
    static const double luma_b = 0.0047, red_green_b = 0.0053;
    static const double blue_a[2] = {34.1, 13.5}, blue_b[2] = {0.04, 0.025};
    const int radius = (int)ceil(3.0 * sqrt(blue_b[0] / (2.0 * pi * pi)) * ppd);
    fill_gaussian(&kernels->luma, radius, ppd, 1.0 / sum_gaussian(radius, ppd, 1.0, luma_b),
                  luma_b);
    fill_gaussian(&kernels->red_green, radius, ppd,
                  1.0 / sum_gaussian(radius, ppd, 1.0, red_green_b), red_green_b);
    // The filter of Cz, the blue-yellow channel, is the sum of two Gaussians in two dimensions.
    // Each Gaussian is separable, so its weights add up to the square of a one-dimensional sum. The
    // weights of both together are scaled to add up to 1.
    double factors[2], squares = 0.0;
    for (int i = 0; i < 2; i++) {
        factors[i] = sqrt(blue_a[i] * sqrt(pi / blue_b[i]));
        const double sum = sum_gaussian(radius, ppd, factors[i], blue_b[i]);
        squares += sum * sum;
    }
    for (int i = 0; i < 2; i++) {
        fill_gaussian(&kernels->blue[i], radius, ppd, factors[i] / sqrt(squares), blue_b[i]);
    }
}

// Scales positive and negative weights separately, so that the positive ones add up to 1 and the
// negative ones to -1.
static void normalise_lobes(const double *weights, DipKernel1D *kernel) {
    double positive = 0.0, negative = 0.0;
    for (int i = 0; i <= 2 * kernel->radius; i++) {
        positive += weights[i] > 0.0 ? weights[i] : 0.0;
        negative -= weights[i] < 0.0 ? weights[i] : 0.0;
    }
    for (int i = 0; i <= 2 * kernel->radius; i++) {
        kernel->weights[i] = (float)(weights[i] / (weights[i] > 0.0 ? positive : negative));
    }
}

static void make_features(DipFlipKernels *kernels, double ppd) {
    const double sigma = 0.5 * 0.082 * ppd; // Half the width of a visible edge, 0.082 degrees.
    const int radius = (int)ceil(3.0 * sigma);
    double gauss[2 * DIP_KERNEL_MAX_RADIUS + 1];
    double edge[2 * DIP_KERNEL_MAX_RADIUS + 1];
    double point[2 * DIP_KERNEL_MAX_RADIUS + 1];
    for (int i = -radius; i <= radius; i++) {
        const double g = exp(-i * i / (2.0 * sigma * sigma));
        gauss[i + radius] = g;
        edge[i + radius] = -i * g;
        point[i + radius] = (i * i / (sigma * sigma) - 1.0) * g;
    }
    kernels->gauss.radius = kernels->edge.radius = kernels->point.radius = radius;
    normalise_lobes(gauss, &kernels->gauss);
    normalise_lobes(edge, &kernels->edge);
    normalise_lobes(point, &kernels->point);
    kernels->edge.weights[radius] = 0.0f; // The middle weight of a first derivative is 0.
}

DipFlipKernels dip_flip_kernels(double pixels_per_degree) {
    DipFlipKernels kernels;
    memset(&kernels, 0, sizeof kernels);
    make_sensitivity(&kernels, pixels_per_degree);
    make_features(&kernels, pixels_per_degree);
    return kernels;
}
