// The rounds of the bench: every combination once in each, in an order that is drawn anew.
#ifndef DIP_APP_BENCH_MEASURE_H
#define DIP_APP_BENCH_MEASURE_H

#include "app/bench/result.h"

// Somebody who draws a frame of a combination and says how long it took.
typedef struct DipBenchSource {
    bool (*draw)(void *context, int combination, int frame, bool hash, DipBenchSample *sample,
                 DipError *err);
    void *context;
} DipBenchSource;

// Fills a result per source (1 or 2; already initialised).
//
// Every source first draws every frame of every combination untimed: the results' `first`. One
// source then draws, in each round, the frames of a combination one after the other, the first of
// them once more before, untimed, as another combination has just used the caches. Two sources
// take turns at every frame in an order that is tossed for, with a millisecond of rest before
// each, in which the other's threads go to sleep. Progress goes to standard error.
bool dip_bench_measure(const DipBenchPlan *plan, const DipBenchSource *sources, int source_count,
                       DipBenchResult *results, DipError *err);

#endif
