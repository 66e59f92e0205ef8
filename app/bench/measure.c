// Measuring the combinations and programs in turn.
#include "app/bench/measure.h"

#include "app/cli/drive.h"

#include <math.h>
#include <stdlib.h>

// Subject i is combination i / source_count of source i % source_count. If there are two sources,
// the first one is the base of the second.
typedef struct BenchTiming {
    const DipBenchSource *sources;
    int source_count;
    DipBenchResult *results;
} BenchTiming;

static bool draw(void *context, const DipDriverTurn *turn, DipTimed *timed, DipError *err) {
    const BenchTiming *t = context;
    const DipBenchSource *source = &t->sources[turn->subject % t->source_count];
    const int combination = turn->subject / t->source_count;
    const bool first = turn->phase == DIP_DRIVER_WARM_UP;
    DipBenchSample sample;
    if (!source->draw(source->context, combination, turn->frame, first, &sample, err)) {
        return false;
    }
    if (first) {
        dip_bench_result_set_first(&t->results[turn->subject % t->source_count], combination,
                                   turn->frame, &sample);
    }
    dip_bench_sample_time(&sample, timed);
    timed->wait = NAN;
    return true;
}

static void keep_times(const BenchTiming *t, const DipTimes *times) {
    for (int i = 0; i < times->count; i++) {
        const DipTimed *timed = &times->list[i];
        dip_bench_result_add(&t->results[timed->subject % t->source_count],
                             timed->subject / t->source_count, timed);
    }
}

bool dip_bench_measure(const DipBenchPlan *plan, const DipBenchSource *sources, int source_count,
                       DipBenchResult *results, DipError *err) {
    const int subjects = plan->count * source_count;
    int base_of[2 * DIP_BENCH_MAX_COMBINATIONS];
    for (int s = 0; s < subjects; s++) {
        base_of[s] = s - s % source_count;
    }
    const DipDriverDef def = {
        .subjects = subjects,
        .base_of = base_of,
        .block_subjects = 1,
        .starts = 1,
        .rounds = plan->options.measure.rounds,
        .frames = plan->options.frames,
        .warm_frames = plan->options.frames,
        .seed = (uint64_t)plan->options.measure.seed,
        .in_turn = source_count == 2,
        .rest_ns = source_count == 2 ? 1000000 : 0,
    };
    BenchTiming t = {.sources = sources, .source_count = source_count, .results = results};
    const DipDriverCalls calls = {.draw = draw, .context = &t};
    DipDriver *driver = dip_driver_create(&def, &calls, err);
    const bool done = driver && dip_drive(driver, "frames", "bench", "interrupted", err);
    if (done) {
        const DipTimes times = dip_driver_times(driver);
        keep_times(&t, &times);
    }
    dip_driver_destroy(&driver);
    return done;
}
