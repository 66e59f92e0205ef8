// Writes the bench's results as text and CSV.
#ifndef DIP_APP_BENCH_TABLE_H
#define DIP_APP_BENCH_TABLE_H

#include "app/bench/measure.h"

#include <stdio.h>

// Prints what was measured: scene, machine, values that are the same in all combinations, frames,
// rounds, seed.
void dip_bench_print_heading(const DipBenchPlan *plan, const DipSession *session, FILE *out);

// Prints the median, 95th percentile and minimum time of each combination in each stage, in
// milliseconds. Also prints for each combination the ratio of its mean time of a frame to that of
// the plan's base and, if the number of threads varies, its speed-up over the same combination with
// the fewest threads.
void dip_bench_print_times(const DipBenchResult *result, FILE *out);

// Prints the means of the work counters over the frames, for each combination with the first
// instruction set and number of threads. Combinations that differ only in these do the same work.
void dip_bench_print_work(const DipBenchResult *result, FILE *out);

// Prints for each combination the median times of both programs, the ratio of the mean time of the
// program of --vs to the mean time of this program, the 95 % interval of this ratio, and whether
// the pictures are the same. Also prints the ratio of the sums of the frames' fastest times, and
// the ratios of the stages' medians.
void dip_bench_print_ratios(const DipBenchResult *here, const DipBenchResult *other, FILE *out);

// Writes a heading, and a CSV line for each program, combination, round and frame. `count` is the
// number of programs, 1 or 2. With 2 programs, the first column names the program. The file is
// written whole or not at all.
bool dip_bench_write_csv(const char *file, const DipBenchResult *results, int count, DipError *err);

#endif
