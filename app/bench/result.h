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

// Means of the counters over the frames, in the order of DIP_COUNTER_LIST.
typedef struct DipBenchWork {
#define DIP_BENCH_WORK_FIELD(name, text) double name;
    DIP_COUNTER_LIST(DIP_BENCH_WORK_FIELD)
#undef DIP_BENCH_WORK_FIELD
} DipBenchWork;

DipBenchWork dip_bench_result_work(const DipBenchResult *result, int combination);

#endif
