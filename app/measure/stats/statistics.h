// Order statistics of times, and the bootstrap interval of the ratio of two medians. paired.h has
// the estimates of times that were taken side by side.
//
// A subject is anything that draws frames, and a round times every frame of every subject once
// (timing.h). The times of one subject are an array of rounds * frames values. The index of a time
// is round * frames + frame, as in the array that dip_timing_run fills. The bootstrap (Efron 1979,
// percentile intervals) draws whole rounds with replacement, since the values of one round were
// measured together and share the machine's state. The bootstrap starts from a fixed seed, so the
// same times always give the same interval. All functions are thread-safe.
#ifndef DIP_APP_MEASURE_STATS_STATISTICS_H
#define DIP_APP_MEASURE_STATS_STATISTICS_H

#ifdef __cplusplus
extern "C" {
#endif

// Returns the value below which the given share (0..1) of count >= 1 values lies; a share of 0.5
// gives the median. Interpolates linearly between neighbours. Sorts a copy of the values in
// scratch, which has room for count values.
double dip_stats_quantile(const double *values, int count, double share, double *scratch);

// Returns the median of count >= 1 values. Reorders the values. Takes linear time (Hoare's
// selection).
double dip_stats_median(double *values, int count);

typedef struct DipStatsInterval {
    double low;
    double high;
} DipStatsInterval;

// Computes each frame's median over the rounds, and returns the mean of these medians over the
// frames. scratch has room for `rounds` values.
double dip_stats_time(const double *ms, int frames, int rounds, double *scratch);

// Returns the 95 % interval of median(a) / median(b). The bootstrap draws rounds separately for
// every frame, so that differences between frames do not widen the interval. a and b use the same
// drawn rounds. scratch has room for 3 * frames * rounds + DIP_STATS_RESAMPLES values.
enum { DIP_STATS_RESAMPLES = 1000 };
DipStatsInterval dip_stats_ratio_interval(const double *a, const double *b, int frames, int rounds,
                                          double *scratch);

#ifdef __cplusplus
}
#endif

#endif
