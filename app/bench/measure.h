// Measuring every combination of a plan in interleaved rounds (app/measure/timing.h).
#ifndef DIP_APP_BENCH_MEASURE_H
#define DIP_APP_BENCH_MEASURE_H

#include "app/bench/result.h"

// Draws a frame of a combination and reports its times: this program, or a child process. `hash`
// asks for the hash of the pixels too.
typedef struct DipBenchSource {
    bool (*draw)(void *context, int combination, int frame, bool hash, DipBenchSample *sample,
                 DipError *err);
    void *context;
} DipBenchSource;

// Fills one result per source; there are 1 or 2 sources, and the results are already initialised.
//
// The warm-up gives the results' `first` samples, with hashes and counters. Two sources take turns
// at every frame, with a millisecond of rest before each run in which the other's threads go to
// sleep. Progress goes to standard error.
bool dip_bench_measure(const DipBenchPlan *plan, const DipBenchSource *sources, int source_count,
                       DipBenchResult *results, DipError *err);

#endif
