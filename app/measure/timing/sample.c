// Copies the times and counters of a frame into a sample, and hashes the picture.
#include "app/measure/timing/sample.h"

#include <string.h>

const char *const dip_bench_stage_names[DIP_BENCH_STAGE_COUNT] = {
#define STAGE_NAME(name, text) #name,
    DIP_STAGE_LIST(STAGE_NAME)
#undef STAGE_NAME
        "total"};

const char *const dip_counter_names[DIP_COUNTER_COUNT] = {
#define COUNTER_NAME(name, text) #name,
    DIP_COUNTER_LIST(COUNTER_NAME)
#undef COUNTER_NAME
};

void dip_bench_sample_set(DipBenchSample *sample, const DipFrame *frame, bool hash) {
#define SET_STAGE(name, text) sample->ms[DIP_BENCH_STAGE_##name] = frame->stages.name##_ms;
    DIP_STAGE_LIST(SET_STAGE)
#undef SET_STAGE
    sample->ms[DIP_BENCH_STAGE_total] = frame->stages.total_ms;
    sample->counters = frame->counters;
    sample->hash[0] = '\0';
    if (hash) {
        dip_frame_hash(frame, sample->hash);
    }
}

void dip_bench_sample_time(const DipBenchSample *sample, DipTimed *timed) {
    _Static_assert((int)DIP_BENCH_STAGE_total == (int)DIP_TIMED_PARTS, "each stage is a part");
    timed->ms = sample->ms[DIP_BENCH_STAGE_total];
    memcpy(timed->parts_ms, sample->ms, sizeof timed->parts_ms);
}
