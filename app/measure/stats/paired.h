// Estimates from paired times: how much slower a subject is than its base.
//
// A pair is the time of a subject and the time of its base, both for the same frame and taken
// within a short while of each other. Whatever slows the machine down for that while slows both
// alike, so that their ratio holds while the times themselves do not. A pair whose subject's time
// is NAN was dropped and takes no part.
//
// There are two forms of measurement:
//   - Rounds of the same frames: each round times every frame. A frame's ratio is the median over
//     the rounds (DipPairedTimes).
//   - Frames along a path: each frame is timed once, in a round of its own, so that many more
//     frames are seen in the same time. The ratio of a frame is smoothed over its neighbours
//     (DipPathTimes).
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
// single round the interval is 0 to infinity. Fails with DIP_ERROR_MEMORY, or with
// DIP_ERROR_RUNTIME if no pair is left.
bool dip_paired_ratio(const DipPairedTimes *times, DipStatsEstimate *ratio, DipError *err);

// Computes the ratio of dip_paired_ratio without its interval; NAN if no pair is left. Fails with
// DIP_ERROR_MEMORY.
bool dip_paired_ratio_value(const DipPairedTimes *times, double *ratio, DipError *err);

// Returns how far the rounds' own ratios lie apart: 1.4826 times the median distance of the rounds'
// log ratios (of the sums over the frames) from their median. Called for a base that is timed twice
// (A/A), it tells how noisy the machine is. Returns a negative value if there are fewer than two
// rounds without dropped pairs, and NAN if memory runs out.
double dip_paired_spread(const DipPairedTimes *times);

// --- frames along a path -----------------------------------------------------------------------

// Times of `frames` frames in the order of the path. Frame f belongs to round f % rounds.
typedef struct DipPathTimes {
    const double *ms;       // Time of the subject; NAN for a pair that was dropped.
    const double *base_ms;  // Time of the base in the same pair.
    const double *level_ms; // The base's usual time of this frame: the median of all its timings.
    int frames;
    int rounds;
    double level_error; // Standard error of the level's logarithm; 0 if it is not known.
} DipPathTimes;

// A row's time along a path. The bounds of mean_ms hold the error of the base's level too.
typedef struct DipPathEstimate {
    DipStatsEstimate ratio;   // The subject's time over the base's, for the whole path.
    DipStatsEstimate mean_ms; // Mean over the frames.
    DipStatsEstimate p95_ms; // 95th percentile over the frames; `high` is its one-sided 95 % bound.
    DipStatsEstimate worst_ms; // The slowest frame; `high` is its one-sided 95 % bound.
    int used;                  // Number of frames whose pair was not dropped.
    // Standard errors of the logarithms of ratio, p95 and worst, without that of the level.
    double ratio_error;
    double p95_error;
    double worst_error;
    double level_error; // As in DipPathTimes; all rows beside one base share it.
} DipPathEstimate;

// Let q_f = log(ms_f / base_ms_f), s = running median of 7 of q along the path (pairs that were
// dropped are passed over), and time_f = level_f exp(s_f). Then ratio = sum time_f / sum level_f,
// and mean, percentile and worst are those of time_f. The bootstrap draws the residuals q - s anew
// with replacement, 1.25 times as large, because the running median follows the noise in part, adds
// them to s and smooths again. Standard errors of logarithms; the ratio's interval is
// +- t hypot(s, 0.002). The bounds of p95 and worst are exp(1.75 hypot(s, level_error)).
// If over a tenth of the pairs was dropped, every error has another 1 % in quadrature.
// Fails with DIP_ERROR_MEMORY, or with DIP_ERROR_RUNTIME if fewer than half of the pairs are left.
bool dip_path_estimate(const DipPathTimes *times, DipPathEstimate *estimate, DipError *err);

// Writes time_f of every frame, from which dip_path_estimate makes its values. Fails as that
// function does.
bool dip_path_frame_times(const DipPathTimes *times, double *frame_ms, DipError *err);

// Computes the standard error of the logarithm of a level from timings in the order in which they
// were taken: the timings are cut into 7 groups of successive ones, the groups' medians have the
// spread s and the correlation r between neighbours, and the error is
// s / sqrt(7) sqrt((1 + r) / (1 - r)). Each timing is the log of a time over the median time of the
// same frame. Returns 0 for fewer than 14 timings, and a negative value if memory runs out.
double dip_level_error(const double *log_times, int count);

#ifdef __cplusplus
}
#endif

#endif
