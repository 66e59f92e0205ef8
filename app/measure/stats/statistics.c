// Quantiles and the bootstrap.
#include "app/measure/stats/statistics.h"

#include "app/measure/stats/random.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

// --- order statistics --------------------------------------------------------------------------

static int compare(const void *a, const void *b) {
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

double dip_stats_quantile(const double *values, int count, double share, double *scratch) {
    memcpy(scratch, values, sizeof *values * (size_t)count);
    qsort(scratch, (size_t)count, sizeof *scratch, compare);
    const double position = share * (count - 1);
    const int below = (int)position;
    const int above = below + 1 < count ? below + 1 : below;
    return scratch[below] + (position - below) * (scratch[above] - scratch[below]);
}

// Returns the value that sorting would put at values[index]. Uses Hoare's selection, which reorders
// the values.
static double select_value(double *values, int count, int index) {
    int low = 0, high = count - 1;
    while (low < high) {
        const double pivot = values[(low + high) / 2];
        int i = low, j = high;
        while (i <= j) {
            while (values[i] < pivot) {
                i++;
            }
            while (values[j] > pivot) {
                j--;
            }
            if (i <= j) {
                const double swap = values[i];
                values[i++] = values[j];
                values[j--] = swap;
            }
        }
        if (index <= j) {
            high = j;
        } else if (index >= i) {
            low = i;
        } else {
            break;
        }
    }
    return values[index];
}

double dip_stats_median(double *values, int count) {
    const double below = select_value(values, count, (count - 1) / 2);
    return count % 2 ? below : 0.5 * (below + select_value(values, count, count / 2));
}

// --- times over rounds -------------------------------------------------------------------------

double dip_stats_time(const double *ms, int frames, int rounds, double *scratch) {
    double sum = 0.0;
    for (int f = 0; f < frames; f++) {
        for (int r = 0; r < rounds; r++) {
            scratch[r] = ms[r * frames + f];
        }
        sum += dip_stats_median(scratch, rounds) / frames;
    }
    return sum;
}

// --- the ratio of two medians ------------------------------------------------------------------

DipStatsInterval dip_stats_ratio_interval(const double *a, const double *b, int frames, int rounds,
                                          double *scratch) {
    const int count = frames * rounds;
    double *drawn_a = scratch;
    double *drawn_b = drawn_a + count;
    double *sorted = drawn_b + count;
    double *ratios = sorted + count;
    uint64_t random = 1;
    for (int r = 0; r < DIP_STATS_RESAMPLES; r++) {
        for (int i = 0; i < count; i++) {
            // a and b come from the same round, since their runs took turns within a round.
            const int from = dip_random_below(&random, rounds) * frames + i % frames;
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
