// Order statistics of times and the spread of their ratio.
#ifndef DIP_APP_MEASURE_STATS_H
#define DIP_APP_MEASURE_STATS_H

// The value below which a share (0..1) of count >= 1 values lies, linear between neighbours:
// 0.5 is the median. Sorts a copy in scratch, which has room for count values.
double dip_stats_quantile(const double *values, int count, double share, double *scratch);

typedef struct DipStatsInterval {
    double low;
    double high;
} DipStatsInterval;

// 95 % interval of median(a) / median(b) by bootstrap: values are [round * frames + frame], and
// within every frame rounds are drawn again, with replacement, so that what differs from frame to
// frame is no spread. scratch: 3 * frames * rounds + DIP_STATS_RESAMPLES values. Always the same
// for the same values.
enum { DIP_STATS_RESAMPLES = 1000 };
DipStatsInterval dip_stats_ratio_interval(const double *a, const double *b, int frames, int rounds,
                                          double *scratch);

#endif
