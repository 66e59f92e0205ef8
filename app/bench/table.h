// The bench's results as text and CSV.
#ifndef DIP_APP_BENCH_TABLE_H
#define DIP_APP_BENCH_TABLE_H

#include "app/bench/result.h"

#include <stdio.h>

// Prints what was measured: scene, machine, values that do not vary, frames, rounds, seed.
void dip_bench_print_heading(const DipBenchPlan *plan, const DipSession *session, FILE *out);

// Prints milliseconds by stage: median, 95th percentile and minimum of each combination.
bool dip_bench_print_times(const DipBenchResult *result, FILE *out, DipError *err);

// Prints the work counters: means over the frames.
void dip_bench_print_work(const DipBenchResult *result, FILE *out);

// Prints the ratios of the other program's medians to this one's, with 95 % intervals, and whether
// the pictures are the same.
bool dip_bench_print_ratios(const DipBenchResult *here, const DipBenchResult *other, FILE *out,
                            DipError *err);

// Writes one line for each combination, round and frame of `count` programs, 1 or 2. Two programs
// are told apart by a first column. The file is written whole or not at all.
bool dip_bench_write_csv(const char *file, const DipBenchResult *results, int count, DipError *err);

#endif
