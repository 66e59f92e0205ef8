// Computes the squared error and the PSNR of two pictures.
#include "tests/peer/likeness.h"

#include <math.h>

double dip_likeness_squared_error(const uint8_t *a, size_t a_stride_bytes, const uint8_t *b,
                                  size_t b_stride_bytes, int width, int height) {
    uint64_t sum = 0;
    for (int y = 0; y < height; y++) {
        const uint8_t *row_a = a + a_stride_bytes * (size_t)y;
        const uint8_t *row_b = b + b_stride_bytes * (size_t)y;
        for (int i = 0; i < 4 * width; i++) {
            const int difference = i % 4 == 3 ? 0 : row_a[i] - row_b[i];
            sum += (uint64_t)(difference * difference);
        }
    }
    return (double)sum / (3.0 * width * height);
}

double dip_likeness_psnr_db(double squared_error) {
    return 10.0 * log10(255.0 * 255.0 / squared_error);
}
