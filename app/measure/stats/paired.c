// Ratios of paired times, times along a path, and their bootstrap intervals.
#include "app/measure/stats/paired.h"

#include "app/measure/stats/random.h"
#include "renderer/base/assert.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { RESAMPLES = 300, SMOOTHED = 7, LEVEL_GROUPS = 7 };
// The standard deviation of normally distributed values is this many times the median of their
// distances from their median.
static const double mad_to_sd = 1.4826;

static bool out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "timing", "out of memory");
}

// --- spread ------------------------------------------------------------------------------------

// Standard deviation of count >= 2 values.
static double deviation(const double *values, int count) {
    double mean = 0.0, squares = 0.0;
    for (int i = 0; i < count; i++) {
        mean += values[i] / count;
    }
    for (int i = 0; i < count; i++) {
        squares += (values[i] - mean) * (values[i] - mean);
    }
    return sqrt(squares / (count - 1));
}

// --- rounds of the same frames -----------------------------------------------------------------

// Computes the ratio from the rounds listed in `drawn`. Returns NAN if no pair is left. scratch has
// room for `rounds` values.
static double ratio_of(const DipPairedTimes *times, const int *drawn, double *scratch) {
    double total = 0.0, base_total = 0.0;
    for (int f = 0; f < times->frames; f++) {
        int count = 0;
        for (int r = 0; r < times->rounds; r++) {
            const int i = drawn[r] * times->frames + f;
            if (!isnan(times->ms[i])) {
                scratch[count++] = times->ms[i] / times->base_ms[i];
            }
        }
        if (count == 0) {
            continue;
        }
        const double ratio = dip_stats_median(scratch, count);
        for (int r = 0; r < times->rounds; r++) {
            scratch[r] = times->base_ms[drawn[r] * times->frames + f];
        }
        const double weight = dip_stats_median(scratch, times->rounds);
        total += weight * ratio;
        base_total += weight;
    }
    return base_total > 0.0 ? total / base_total : NAN;
}

// Standard error of the log ratio: the bootstrap over whole rounds.
static double ratio_error(const DipPairedTimes *times, int *drawn, double *logs, double *scratch) {
    const int rounds = times->rounds;
    uint64_t random = 1;
    int count = 0;
    for (int i = 0; i < RESAMPLES; i++) {
        for (int r = 0; r < rounds; r++) {
            drawn[r] = dip_random_below(&random, rounds);
        }
        const double ratio = ratio_of(times, drawn, scratch);
        if (!isnan(ratio)) {
            logs[count++] = log(ratio);
        }
    }
    return deviation(logs, count) * sqrt((double)rounds / (rounds - 1));
}

bool dip_paired_ratio_value(const DipPairedTimes *times, double *ratio, DipError *err) {
    int *every = malloc((size_t)times->rounds * sizeof *every);
    double *scratch = malloc((size_t)times->rounds * sizeof *scratch);
    const bool done = (every && scratch) || out_of_memory(err);
    for (int r = 0; done && r < times->rounds; r++) {
        every[r] = r;
    }
    *ratio = done ? ratio_of(times, every, scratch) : NAN;
    free(every);
    free(scratch);
    return done;
}

bool dip_paired_ratio(const DipPairedTimes *times, DipEstimate *ratio, DipError *err) {
    const int rounds = times->rounds;
    DIP_ASSERT(rounds > 0 && times->frames > 0);
    int *drawn = calloc((size_t)rounds, sizeof *drawn);
    double *scratch = malloc((size_t)rounds * sizeof *scratch);
    double *logs = malloc(RESAMPLES * sizeof *logs);
    bool done = (drawn && scratch && logs) || out_of_memory(err);
    double value = 0.0;
    done = done && dip_paired_ratio_value(times, &value, err);
    if (done && isnan(value)) {
        done = dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "timing",
                             "every pair of times was disturbed; time again on a quieter machine");
    }
    if (done) {
        *ratio = rounds < 2 ? dip_estimate_unknown(value)
                            : dip_estimate_make(value, ratio_error(times, drawn, logs, scratch),
                                                rounds - 1);
    }
    free(drawn);
    free(scratch);
    free(logs);
    return done;
}

double dip_paired_spread(const DipPairedTimes *times) {
    double *logs = malloc((size_t)times->rounds * sizeof *logs);
    int count = 0;
    for (int r = 0; logs && r < times->rounds; r++) {
        double total = 0.0, base_total = 0.0;
        for (int f = 0; f < times->frames; f++) {
            total += times->ms[r * times->frames + f];
            base_total += times->base_ms[r * times->frames + f];
        }
        if (!isnan(total)) {
            logs[count++] = log(total / base_total);
        }
    }
    double spread = logs ? -1.0 : NAN;
    if (count >= 2) {
        const double middle = dip_stats_median(logs, count);
        for (int i = 0; i < count; i++) {
            logs[i] = fabs(logs[i] - middle);
        }
        spread = mad_to_sd * dip_stats_median(logs, count);
    }
    free(logs);
    return spread;
}
