// Declares the sample: the times of the renderer's stages, the work counters and the hash of the
// picture that are taken when a frame is drawn once.
#ifndef DIP_APP_MEASURE_TIMING_SAMPLE_H
#define DIP_APP_MEASURE_TIMING_SAMPLE_H

#include "renderer/base/api.h"
#include "app/measure/stats/rounds.h"
#include "renderer/scene/frame.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

// Indices of a frame's times: the renderer's stages, then the total.
typedef enum DipBenchStage {
#define DIP_BENCH_STAGE_ENUM(name, text) DIP_BENCH_STAGE_##name,
    DIP_STAGE_LIST(DIP_BENCH_STAGE_ENUM)
#undef DIP_BENCH_STAGE_ENUM
        DIP_BENCH_STAGE_total,
    DIP_BENCH_STAGE_COUNT
} DipBenchStage;

// Indices of the work counters of a frame.
enum {
#define DIP_COUNTER_ENUM(name, text) DIP_COUNTER_##name,
    DIP_COUNTER_LIST(DIP_COUNTER_ENUM)
#undef DIP_COUNTER_ENUM
        DIP_COUNTER_COUNT
};

extern DIP_API const char *const dip_bench_stage_names[DIP_BENCH_STAGE_COUNT];
extern DIP_API const char *const dip_counter_names[DIP_COUNTER_COUNT];

// A sample of one drawing of a frame.
typedef struct DipBenchSample {
    double ms[DIP_BENCH_STAGE_COUNT]; // [DipBenchStage]
    DipCounters counters;
    char hash[33]; // Hash of the picture (dip_frame_hash), or "" if none was requested.
} DipBenchSample;

// Fills in the sample of a frame that was just drawn. `hash` says whether to compute the hash.
DIP_API void dip_bench_sample_set(DipBenchSample *sample, const DipFrame *frame, bool hash);

// Writes the sample's total time to timed->ms and the times of its stages to timed->parts_ms.
DIP_API void dip_bench_sample_time(const DipBenchSample *sample, DipTimed *timed);

// Adds a frame's counters to sums in the order of DIP_COUNTER_LIST. All sums are whole numbers, so
// the order in which frames are added does not change them.
static inline void dip_counters_add(const DipCounters *counters, double sums[DIP_COUNTER_COUNT]) {
#define DIP_COUNTER_ADD(name, text) *sums++ += (double)counters->name;
    DIP_COUNTER_LIST(DIP_COUNTER_ADD)
#undef DIP_COUNTER_ADD
}

#ifdef __cplusplus
}
#endif

#endif
