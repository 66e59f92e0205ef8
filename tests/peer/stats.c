// Quantiles, the bootstrap, PSNR.
#include "tests/peer/stats.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int compare(const void *a, const void *b) {
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

double dip_stats_quantile(const double *values, int count, double share, double *scratch) {
    memcpy(scratch, values, sizeof *values * (size_t)count);
    qsort(scratch, (size_t)count, sizeof *scratch, compare);
    const double place = share * (count - 1);
    const int below = (int)place;
    const int above = below + 1 < count ? below + 1 : below;
    return scratch[below] + (place - below) * (scratch[above] - scratch[below]);
}

static uint32_t next_random(uint64_t *state) {
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (uint32_t)(*state >> 33);
}

DipStatsInterval dip_stats_ratio_interval(const double *a, const double *b, int frames, int rounds,
                                          double *scratch) {
    const int count = frames * rounds;
    double *drawn_a = scratch;
    double *drawn_b = drawn_a + count;
    double *sorted = drawn_b + count;
    double *ratios = sorted + count;
    uint64_t state = 1;
    for (int r = 0; r < DIP_STATS_RESAMPLES; r++) {
        for (int i = 0; i < count; i++) {
            // Both of one round, since they were measured next to each other.
            const int from = (int)(next_random(&state) % (uint32_t)rounds) * frames + i % frames;
            drawn_a[i] = a[from];
            drawn_b[i] = b[from];
        }
        ratios[r] = dip_stats_quantile(drawn_a, count, 0.5, sorted) /
                    dip_stats_quantile(drawn_b, count, 0.5, sorted);
    }
    qsort(ratios, DIP_STATS_RESAMPLES, sizeof *ratios, compare);
    return (DipStatsInterval){ratios[DIP_STATS_RESAMPLES / 40],
                              ratios[DIP_STATS_RESAMPLES - 1 - DIP_STATS_RESAMPLES / 40]};
}

double dip_stats_squared_error(const uint8_t *a, size_t a_stride_bytes, const uint8_t *b,
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

double dip_stats_psnr_db(double squared_error) {
    return 10.0 * log10(255.0 * 255.0 / squared_error);
}
