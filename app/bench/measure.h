// Measuring every combination of a plan in interleaved rounds (app/measure/timing/driver.h).
#ifndef DIP_APP_BENCH_MEASURE_H
#define DIP_APP_BENCH_MEASURE_H

#include "app/bench/result.h"

// A program that is measured: this process or a child process. draw() draws a frame of a
// combination and stores its times and counters in *sample. If `hash` is true, draw() also stores
// the hash of the pixels.
typedef struct DipBenchSource {
    bool (*draw)(void *context, int combination, int frame, bool hash, DipBenchSample *sample,
                 DipError *err);
    void *context;
} DipBenchSource;

// Fills one result for each source. There are 1 or 2 sources. The results must be initialised
// before the call.
//
// Before any time is taken, the warm-up draws each frame once. Its samples, with hashes and
// counters, become the results' `first` samples. Two sources take turns at every frame. A rest of
// one millisecond before each run lets the other source's threads go to sleep. Progress goes to
// standard error.
bool dip_bench_measure(const DipBenchPlan *plan, const DipBenchSource *sources, int source_count,
                       DipBenchResult *results, DipError *err);

#endif
