// The bench's results: the times of every frame in every round, and the work of every frame. Each
// round draws every frame of every combination of the plan (plan.h) once.
#ifndef DIP_APP_BENCH_RESULT_H
#define DIP_APP_BENCH_RESULT_H

#include "app/bench/plan.h"
#include "app/measure/timing/sample.h"

// The results of one program. The bench measures one program, or two with --vs. Owns its arrays,
// borrows the plan.
typedef struct DipBenchResult {
    const DipBenchPlan *plan;
    double *ms;            // times, [combination][stage][round][frame]
    DipBenchSample *first; // samples of the warm-up, [combination][frame]
    // [combination]: the ratio of the mean time to that of the plan's base; for the second of two
    // programs, to that of the first.
    DipEstimate *ratios;
    // [combination]: how many times as fast as with the fewest threads. Of one program only.
    DipEstimate *speed_ups;
} DipBenchResult;

bool dip_bench_result_init(DipBenchResult *result, const DipBenchPlan *plan, DipError *err);
void dip_bench_result_free(DipBenchResult *result);

// Stores the sample of a frame's first drawing, which is the one with the hash and the counters.
void dip_bench_result_set_first(DipBenchResult *result, int combination, int frame,
                                const DipBenchSample *sample);

// Stores the times of a frame of a round.
void dip_bench_result_add(DipBenchResult *result, int combination, const DipTimed *timed);

// Returns the times of a stage: rounds * frames values, [round * frames + frame].
const double *dip_bench_result_ms(const DipBenchResult *result, int combination,
                                  DipBenchStage stage);
const DipBenchSample *dip_bench_result_first(const DipBenchResult *result, int combination,
                                             int frame);

// Writes the means of the counters over the frames.
void dip_bench_result_work(const DipBenchResult *result, int combination,
                           double means[DIP_COUNTER_COUNT]);

#endif
