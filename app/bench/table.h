// The bench's figures as text.
#ifndef DIP_APP_BENCH_TABLE_H
#define DIP_APP_BENCH_TABLE_H

#include "app/bench/result.h"

#include <stdio.h>

// What was measured: scene, machine, values that do not vary, frames, rounds, seed.
void dip_bench_print_heading(const DipBenchPlan *plan, const DipSession *session,
                             const DipOptions *options, FILE *out);

// Milliseconds by stage: median, 95th percentile and least of each combination.
bool dip_bench_print_times(const DipBenchResult *result, FILE *out, DipError *err);

// The work counters' means over the frames.
void dip_bench_print_work(const DipBenchResult *result, FILE *out);

// The other program's medians over this one's, with intervals, and whether pictures are the same.
bool dip_bench_print_ratios(const DipBenchResult *here, const DipBenchResult *other, FILE *out,
                            DipError *err);

// Every combination, frame and round of `count` programs (named in a column if there are two).
bool dip_bench_write_csv(const char *file, const DipBenchResult *results, int count, DipError *err);

#endif
