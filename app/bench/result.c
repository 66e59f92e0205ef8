// Storing and averaging the bench's samples.
#include "app/bench/result.h"

#include <stdlib.h>
#include <string.h>

static size_t values_per_stage(const DipBenchPlan *plan) {
    return (size_t)plan->options.measure.rounds * (size_t)plan->options.frames;
}

bool dip_bench_result_init(DipBenchResult *result, const DipBenchPlan *plan, DipError *err) {
    const size_t count = (size_t)plan->count;
    *result = (DipBenchResult){.plan = plan};
    result->ms = calloc(count * DIP_BENCH_STAGE_COUNT * values_per_stage(plan), sizeof(double));
    result->first = calloc(count * (size_t)plan->options.frames, sizeof(DipBenchSample));
    if (!result->ms || !result->first) {
        dip_bench_result_free(result);
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "bench", "out of memory");
    }
    return true;
}

void dip_bench_result_free(DipBenchResult *result) {
    free(result->ms);
    free(result->first);
    *result = (DipBenchResult){.plan = NULL};
}

static size_t first_index(const DipBenchResult *result, int combination, DipBenchStage stage) {
    return ((size_t)combination * DIP_BENCH_STAGE_COUNT + stage) * values_per_stage(result->plan);
}

void dip_bench_result_add(DipBenchResult *result, int combination, const DipTimed *timed) {
    const int value = timed->round * result->plan->options.frames + timed->frame;
    for (int stage = 0; stage < DIP_BENCH_STAGE_COUNT; stage++) {
        result->ms[first_index(result, combination, (DipBenchStage)stage) + (size_t)value] =
            stage == DIP_BENCH_STAGE_total ? timed->ms : timed->parts_ms[stage];
    }
}

const double *dip_bench_result_ms(const DipBenchResult *result, int combination,
                                  DipBenchStage stage) {
    return result->ms + first_index(result, combination, stage);
}

void dip_bench_result_set_first(DipBenchResult *result, int combination, int frame,
                                const DipBenchSample *sample) {
    result->first[combination * result->plan->options.frames + frame] = *sample;
}

const DipBenchSample *dip_bench_result_first(const DipBenchResult *result, int combination,
                                             int frame) {
    return &result->first[combination * result->plan->options.frames + frame];
}

DipBenchWork dip_bench_result_work(const DipBenchResult *result, int combination) {
    DipBenchWork work = {0};
    const int frames = result->plan->options.frames;
    for (int i = 0; i < frames; i++) {
        const DipCounters *counters = &dip_bench_result_first(result, combination, i)->counters;
#define ADD_COUNTER(name, text) work.name += (double)counters->name / frames;
        DIP_COUNTER_LIST(ADD_COUNTER)
#undef ADD_COUNTER
    }
    return work;
}
