// Order statistics of times, estimates over rounds, and their bootstrap intervals.
//
// Times of one subject are an array of rounds * frames values, [round * frames + frame], as
// dip_timing_run fills it. The bootstrap (Efron 1979, percentile intervals) draws whole rounds with
// replacement: values of one round were measured together and share the machine's state. It starts
// from a fixed seed, so the same times always give the same interval. All functions are
// thread-safe.
#ifndef DIP_APP_MEASURE_STATISTICS_H
#define DIP_APP_MEASURE_STATISTICS_H

#ifdef __cplusplus
extern "C" {
#endif

// The value below which a share (0..1) of count >= 1 values lies, linear between neighbours: 0.5 is
// the median. Sorts a copy in scratch, which has room for count values.
double dip_stats_quantile(const double *values, int count, double share, double *scratch);

// The median of count >= 1 values, which it reorders. Takes linear time (Hoare's selection).
double dip_stats_median(double *values, int count);

typedef struct DipStatsInterval {
    double low;
    double high;
} DipStatsInterval;

// A value with its 95 % interval.
typedef struct DipStatsEstimate {
    double value;
    double low;
    double high;
} DipStatsEstimate;

// Mean over the frames of each frame's median over the rounds. 0 when memory runs out.
double dip_stats_time(const double *ms, int frames, int rounds);
DipStatsEstimate dip_stats_time_estimate(const double *ms, int frames, int rounds);

// Median over frames and rounds of ms / base_ms, both of the same frame and round. 0 when memory
// runs out.
double dip_stats_paired_ratio(const double *ms, const double *base_ms, int frames, int rounds);
DipStatsEstimate dip_stats_paired_ratio_estimate(const double *ms, const double *base_ms,
                                                 int frames, int rounds);

// 95 % interval of median(a) / median(b), where rounds are drawn separately for every frame but
// together for a and b, so that differences between frames do not widen the interval. scratch has
// room for 3 * frames * rounds + DIP_STATS_RESAMPLES values.
enum { DIP_STATS_RESAMPLES = 1000 };
DipStatsInterval dip_stats_ratio_interval(const double *a, const double *b, int frames, int rounds,
                                          double *scratch);

#ifdef __cplusplus
}
#endif

#endif
