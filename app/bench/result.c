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
    result->ratios = calloc(count, sizeof(DipEstimate));
    result->speed_ups = calloc(count, sizeof(DipEstimate));
    if (!result->ms || !result->first || !result->ratios || !result->speed_ups) {
        dip_bench_result_free(result);
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "bench", "out of memory");
    }
    return true;
}

void dip_bench_result_free(DipBenchResult *result) {
    free(result->ms);
    free(result->first);
    free(result->ratios);
    free(result->speed_ups);
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

void dip_bench_result_work(const DipBenchResult *result, int combination,
                           double means[DIP_COUNTER_COUNT]) {
    const int frames = result->plan->options.frames;
    memset(means, 0, DIP_COUNTER_COUNT * sizeof *means);
    for (int i = 0; i < frames; i++) {
        dip_counters_add(&dip_bench_result_first(result, combination, i)->counters, means);
    }
    for (int c = 0; c < DIP_COUNTER_COUNT; c++) {
        means[c] /= frames;
    }
}
