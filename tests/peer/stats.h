// Order statistics of times, the spread of their ratio, and the likeness of pictures.
#ifndef DIP_TESTS_PEER_STATS_H
#define DIP_TESTS_PEER_STATS_H

#include <stddef.h>
#include <stdint.h>

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

// Mean of the squared differences of red, green and blue, in codes squared. Pixels of 4 bytes;
// alpha is left out.
double dip_stats_squared_error(const uint8_t *a, size_t a_stride_bytes, const uint8_t *b,
                               size_t b_stride_bytes, int width, int height);

// Decibels below full scale (255); infinite for no error.
double dip_stats_psnr_db(double squared_error);

#endif
