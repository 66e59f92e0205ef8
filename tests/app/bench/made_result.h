// Bench plans and results with made-up numbers, for tests of the bench's arithmetic.
#ifndef DIP_TESTS_APP_BENCH_MADE_RESULT_H
#define DIP_TESTS_APP_BENCH_MADE_RESULT_H

#include "app/bench/measure.h"

#include <stdio.h>

// Makes a plan with two sizes, two sets of settings, one instruction set and two numbers of
// threads: 8 combinations of `frames` frames in `rounds` rounds. It needs no session.
void dip_made_plan(DipBenchPlan *plan, int frames, int rounds);

// Makes a plan with one combination: 64x48 pixels and the default settings.
void dip_made_single_plan(DipBenchPlan *plan, int frames, int rounds);

// Initialises a result. For combination 0, the total time of a frame in a round is
// total_ms[round * frames + frame], and each stage takes a quarter of it. Frame f has the hash "f"
// and fetches 10 * (f + 1) texels.
void dip_made_result(DipBenchResult *result, const DipBenchPlan *plan, const double *total_ms);

// Returns what a function prints. The caller frees the text.
char *dip_printed(bool (*print)(void *context, FILE *out), void *context);

#endif
