// Pairs of times, for estimates that take a subject's frame and the base's frame beside it
// together.
#ifndef DIP_APP_MEASURE_TIMING_PAIRS_H
#define DIP_APP_MEASURE_TIMING_PAIRS_H

#include "app/measure/stats/rounds.h"
#include "renderer/base/error.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DIP_PAIRED_MOST_WAIT DIP_TIMED_MOST_WAIT

enum { DIP_TIME_PARTS = DIP_TIMED_PARTS };

// A subject's time and its base's time for one frame of a block.
typedef struct DipTimePair {
    double ms;                     // Of the subject; 0 if it was not timed.
    double base_ms;                // Of the base.
    double wait;                   // Waiting time of all threads in the subject's frame / its time.
    double base_wait;              // The same of the base's frame.
    double cpu_ms;                 // Processor time of the subject's frame, over all threads.
    double switches;               // Involuntary context switches in the subject's frame.
    double shares[DIP_TIME_PARTS]; // Shares of the parts in the subject's time.
} DipTimePair;

static inline bool dip_time_pair_is_disturbed(const DipTimePair *pair) {
    return !(pair->ms > 0.0) || pair->wait > DIP_TIMED_MOST_WAIT ||
           pair->base_wait > DIP_TIMED_MOST_WAIT;
}

// Makes the pairs of a log in which each subject has every frame once. The index of a pair is
// subject * frames + frame. A base's own pairs have the median of its times as both times, and no
// waiting. Fails with DIP_ERROR_MEMORY.
bool dip_times_pairs(const DipTimes *times, DipTimePair *pairs, DipError *err);

#ifdef __cplusplus
}
#endif

#endif
