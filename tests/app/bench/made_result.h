// A plan and results by formula, for tests of the bench's arithmetic.
#ifndef DIP_TESTS_APP_BENCH_MADE_RESULT_H
#define DIP_TESTS_APP_BENCH_MADE_RESULT_H

#include "app/bench/result.h"

#include <stdio.h>

// Two sizes, two settings, one instruction set, two numbers of threads: 8 combinations of `frames`
// frames in `rounds` rounds. No session is needed.
void dip_made_plan(DipBenchPlan *plan, int frames, int rounds);

// The plan of one combination, 64x48 pixels with the default settings.
void dip_made_single_plan(DipBenchPlan *plan, int frames, int rounds);

// Initialises a result whose every stage of combination 0 has total_ms[round * frames + frame]
// times 0.25, and whose total is total_ms. Frame f has the hash "f" and 10 * (f + 1) texels.
void dip_made_result(DipBenchResult *result, const DipBenchPlan *plan, const double *total_ms);

// What a function prints, to be freed.
char *dip_printed(bool (*print)(void *context, FILE *out), void *context);

#endif
