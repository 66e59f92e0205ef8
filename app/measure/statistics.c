// Quantiles, estimates and the bootstrap.
#include "app/measure/statistics.h"

#include "app/measure/internal/random.h"

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

// --- estimates over rounds ---------------------------------------------------------------------

enum { ESTIMATE_RESAMPLES = 2000 };

typedef struct Times {
    const double *ms;
    const double *base_ms; // NULL for estimates of one subject
    int frames;
    int rounds;
} Times;

// Computes an estimate from the rounds listed in `drawn`. scratch has room for frames * rounds
// values.
typedef double Estimator(const Times *times, const int *drawn, double *scratch);

static double mean_of_frame_medians(const Times *times, const int *drawn, double *scratch) {
    double sum = 0.0;
    for (int f = 0; f < times->frames; f++) {
        for (int r = 0; r < times->rounds; r++) {
            scratch[r] = times->ms[drawn[r] * times->frames + f];
        }
        sum += dip_stats_median(scratch, times->rounds) / times->frames;
    }
    return sum;
}

static double median_of_ratios(const Times *times, const int *drawn, double *scratch) {
    int count = 0;
    for (int r = 0; r < times->rounds; r++) {
        for (int f = 0; f < times->frames; f++) {
            const int i = drawn[r] * times->frames + f;
            scratch[count++] = times->ms[i] / times->base_ms[i];
        }
    }
    return dip_stats_median(scratch, count);
}

static _Thread_local bool ran_out;

bool dip_stats_ran_out(void) {
    const bool had_run_out = ran_out;
    ran_out = false;
    return had_run_out;
}

// Computes the estimate from all rounds, and its 95 % interval. For the interval, the estimate is
// repeated `resamples` times, each time from a new drawing of rounds: as many rounds as were
// measured, drawn with replacement. If `resamples` is 0, the interval's ends are 0.
static DipStatsEstimate estimate(const Times *times, Estimator *estimator, int resamples) {
    const int count = times->rounds;
    double *scratch = malloc((size_t)count * (size_t)times->frames * sizeof *scratch);
    int *drawn = malloc((size_t)count * sizeof *drawn);
    double *values = malloc(((size_t)resamples + 1) * sizeof *values);
    DipStatsEstimate result = {0.0, 0.0, 0.0};
    if (scratch && drawn && values) {
        uint64_t random = 1;
        for (int r = 0; r < count; r++) {
            drawn[r] = r;
        }
        result.value = estimator(times, drawn, scratch);
        for (int i = 0; i < resamples; i++) {
            for (int r = 0; r < count; r++) {
                drawn[r] = dip_random_below(&random, count);
            }
            values[i] = estimator(times, drawn, scratch);
        }
        if (resamples > 0) {
            qsort(values, (size_t)resamples, sizeof *values, compare);
            result.low = values[resamples / 40];
            result.high = values[resamples - 1 - resamples / 40];
        }
    } else {
        ran_out = true;
    }
    free(scratch);
    free(drawn);
    free(values);
    return result;
}

double dip_stats_time(const double *ms, int frames, int rounds) {
    return estimate(&(Times){ms, NULL, frames, rounds}, mean_of_frame_medians, 0).value;
}

DipStatsEstimate dip_stats_time_estimate(const double *ms, int frames, int rounds) {
    return estimate(&(Times){ms, NULL, frames, rounds}, mean_of_frame_medians, ESTIMATE_RESAMPLES);
}

double dip_stats_paired_ratio(const double *ms, const double *base_ms, int frames, int rounds) {
    return estimate(&(Times){ms, base_ms, frames, rounds}, median_of_ratios, 0).value;
}

DipStatsEstimate dip_stats_paired_ratio_estimate(const double *ms, const double *base_ms,
                                                 int frames, int rounds) {
    return estimate(&(Times){ms, base_ms, frames, rounds}, median_of_ratios, ESTIMATE_RESAMPLES);
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
