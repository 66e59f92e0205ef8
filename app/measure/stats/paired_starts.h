// Ratios of the times of two programs that are started anew several times.
//
// A start of a program has luck of its own: where its memory lies, and which cores its threads get.
// This luck does not change while the program runs, so no number of rounds within one start shows
// it: on a busy machine two processes of the same program may differ by 40 % for as long as they
// run. Only the spread between starts tells how large it is. Both programs are therefore started
// several times, and in each start they take turns at every frame for a few rounds.
//
// All functions are thread-safe.
#ifndef DIP_APP_MEASURE_STATS_PAIRED_STARTS_H
#define DIP_APP_MEASURE_STATS_PAIRED_STARTS_H

#include "app/measure/stats/paired.h"

#ifdef __cplusplus
extern "C" {
#endif

// Index of a time: (start * rounds + round) * frames + frame. Times are positive. Arrays are
// borrowed.
typedef struct DipPairedStarts {
    const double *ms;      // Times of the subject; NAN for a pair that was dropped.
    const double *base_ms; // Times of the base.
    int starts;            // At least 2.
    int rounds;            // Rounds of each start.
    int frames;
} DipPairedStarts;

// Returns the ratio of the time of the subject to that of the base: dip_paired_ratio over the
// rounds of all starts. Its interval holds two intervals, so that it is as wide as the wider of
// them:
//   - that of dip_paired_ratio over the rounds of all starts, and
//   - Student's t over the starts: the median of the means of all pairs of the starts' own log
//     ratios (Hodges and Lehmann 1963), +- t s / sqrt(S), where s is their standard deviation and t
//     the 97.5 % quantile with S - 1 degrees of freedom for S starts.
// A start whose pairs were all dropped takes no part. If fewer than two starts are left, the
// interval is not known. Fails with DIP_ERROR_MEMORY, or with DIP_ERROR_RUNTIME if no pair is
// left.
bool dip_paired_starts_ratio(const DipPairedStarts *times, DipEstimate *ratio, DipError *err);

// How much longer the subject takes, in milliseconds.
typedef struct DipStartDifference {
    double ms;    // Mean over the starts; 0 if there is no pair.
    double error; // Standard error; INFINITY with fewer than two starts.
} DipStartDifference;

// Computes how much longer the subject takes in the mean of the frames. A start's difference is the
// mean over the frames of the median over its rounds of ms - base_ms. Times may be 0 here, since a
// frame may not use a stage at all. Writes the starts' differences to per_start[starts]; NAN marks
// a start without pairs. Fails with DIP_ERROR_MEMORY.
bool dip_paired_starts_difference(const DipPairedStarts *times, DipStartDifference *difference,
                                  double *per_start, DipError *err);

#ifdef __cplusplus
}
#endif

#endif
