// Quantiles and the bootstrap.
#include "app/measure/stats.h"

#include <stdlib.h>
#include <stdint.h>
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
