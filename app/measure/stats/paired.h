// Estimates from paired times: how much slower a subject is than its base.
//
// A pair is the time of a subject and the time of its base, both for the same frame and taken
// within a short while of each other. Whatever slows the machine down for that while slows both
// alike, so that their ratio holds while the times themselves do not. A pair whose subject's time
// is NAN was dropped and takes no part.
//
// Rounds time the same frames; a frame's ratio is the median over the rounds. rounds.h has the
// estimates along a path and over starts.
//
// Intervals come from the bootstrap (Efron 1979) with a fixed seed, so the same times always give
// the same interval. The spread of the resampled estimates, times the quantile of Student's t for
// the number of rounds, gives 95 %: the plain percentiles of the bootstrap are too narrow for a few
// rounds. All functions are thread-safe.
#ifndef DIP_APP_MEASURE_STATS_PAIRED_H
#define DIP_APP_MEASURE_STATS_PAIRED_H

#include "app/measure/stats/estimate.h"
#include "app/measure/stats/statistics.h"
#include "app/measure/stats/estimate.h"
#include "renderer/base/error.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

// --- rounds of the same frames -----------------------------------------------------------------

// Index of a time: round * frames + frame. Times are positive. Arrays are borrowed.
typedef struct DipPairedTimes {
    const double *ms;      // Times of the subject; NAN for a pair that was dropped.
    const double *base_ms; // Times of the base.
    int rounds;
    int frames;
} DipPairedTimes;

// Returns the ratio of the time of all frames of the subject to that of the base:
//     sum_f w_f median_r(ms_rf / base_ms_rf) / sum_f w_f,  with w_f = median_r base_ms_rf.
// A frame whose pairs were all dropped is left out. The interval is exp(log ratio +- t s), where s
// is the bootstrap's standard deviation of the log ratio over whole rounds, times sqrt(R / (R - 1))
// for R rounds, and t the 97.5 % quantile of Student's t with R - 1 degrees of freedom. With a
// single round there is no interval. Fails with DIP_ERROR_MEMORY, or with
// DIP_ERROR_RUNTIME if no pair is left.
bool dip_paired_ratio(const DipPairedTimes *times, DipEstimate *ratio, DipError *err);

// Computes the ratio of dip_paired_ratio without its interval; NAN if no pair is left. Fails with
// DIP_ERROR_MEMORY.
bool dip_paired_ratio_value(const DipPairedTimes *times, double *ratio, DipError *err);

// Returns how far the rounds' own ratios lie apart: 1.4826 times the median distance of the rounds'
// log ratios (of the sums over the frames) from their median. Called for a base that is timed twice
// (A/A), it tells how noisy the machine is. Returns a negative value if there are fewer than two
// rounds without dropped pairs, and NAN if memory runs out.
double dip_paired_spread(const DipPairedTimes *times);

#ifdef __cplusplus
}
#endif

#endif
