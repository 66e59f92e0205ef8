// Measuring the combinations and programs in turn.
#include "app/bench/measure.h"

#include "app/measure/timing/timing.h"
#include "app/cli/progress.h"

typedef struct BenchTiming {
    const DipBenchSource *sources;
    DipBenchResult *results;
    DipBenchSample sample; // the sample of the latest run
    DipProgress progress;
    int64_t drawn; // frames drawn so far by all sources
} BenchTiming;

static bool draw(void *context, const DipTimingTurn *turn, DipError *err) {
    BenchTiming *t = context;
    const DipBenchSource *source = &t->sources[turn->version];
    const bool hash = turn->phase == DIP_TIMING_WARM_UP;
    return source->draw(source->context, turn->subject, turn->frame, hash, &t->sample, err);
}

// Stores the sample, which has the times that the source itself measured for each stage. `ms` is
// not used, because it also includes the communication with a child process.
static bool after_draw(void *context, const DipTimingTurn *turn, double ms, DipError *err) {
    (void)ms;
    (void)err;
    BenchTiming *t = context;
    DipBenchResult *result = &t->results[turn->version];
    if (turn->phase == DIP_TIMING_WARM_UP) {
        dip_bench_result_set_first(result, turn->subject, turn->frame, &t->sample);
    } else if (turn->phase == DIP_TIMING_TIMED) {
        dip_bench_result_add(result, turn->subject, turn->round, turn->frame, &t->sample);
    }
    dip_progress_show(&t->progress, ++t->drawn);
    return true;
}

bool dip_bench_measure(const DipBenchPlan *plan, const DipBenchSource *sources, int source_count,
                       DipBenchResult *results, DipError *err) {
    const DipTimingDef def = {
        .subject_count = plan->count,
        .frame_count = plan->options.frames,
        .version_count = source_count,
        .round_count = plan->options.rounds,
        .seed = (uint64_t)plan->options.seed,
        .rest_ns = 1000000,
    };
    BenchTiming t = {.sources = sources, .results = results};
    const DipTimingCalls calls = {.run = draw, .after_run = after_draw, .context = &t};
    t.progress = dip_progress_begin("frames", dip_timing_run_count(&def, 0));
    const bool done = dip_timing_run(&def, &calls, NULL, err);
    dip_progress_end(&t.progress, t.drawn);
    return done;
}
