// Fills in bench plans and results by formula.
#include "tests/app/bench/made_result.h"

#include <stdlib.h>
#include <string.h>

static DipOptionSet set_of(const char *text) {
    DipOptionSet set = {.quality = dip_quality_default()};
    snprintf(set.text, sizeof set.text, "%s", text);
    dip_quality_parse(text, &set.quality, NULL);
    return set;
}

void dip_made_plan(DipBenchPlan *plan, int frames, int rounds) {
    const DipSession session = {.isa = DIP_ISA_SCALAR};
    DipBenchOptions options = {.counts[DIP_BENCH_AXIS_SET] = 2,
                               .threads = {1, 2},
                               .counts[DIP_BENCH_AXIS_THREADS] = 2,
                               .sizes = {{64, 48}, {128, 96}},
                               .counts[DIP_BENCH_AXIS_SIZE] = 2,
                               .frames = frames,
                               .measure.rounds = rounds,
                               .measure.has_seed = true,
                               .measure.seed = 7};
    options.sets[0] = set_of("aa=none");
    options.sets[1] = set_of("aa=4");
    dip_bench_plan_make(plan, &session, &options);
}

void dip_made_single_plan(DipBenchPlan *plan, int frames, int rounds) {
    const DipSession session = {.isa = DIP_ISA_SCALAR};
    DipBenchOptions options = {.counts[DIP_BENCH_AXIS_SET] = 1,
                               .threads = {1},
                               .counts[DIP_BENCH_AXIS_THREADS] = 1,
                               .sizes = {{64, 48}},
                               .counts[DIP_BENCH_AXIS_SIZE] = 1,
                               .frames = frames,
                               .measure.rounds = rounds,
                               .measure.has_seed = true,
                               .measure.seed = 7};
    options.sets[0] = set_of("aa=none");
    dip_bench_plan_make(plan, &session, &options);
}

void dip_made_result(DipBenchResult *result, const DipBenchPlan *plan, const double *total_ms) {
    dip_bench_result_init(result, plan, NULL);
    const int frames = plan->options.frames;
    for (int i = 0; i < plan->options.measure.rounds * frames; i++) {
        DipBenchSample sample = {.hash = ""};
        for (int stage = 0; stage < DIP_BENCH_STAGE_total; stage++) {
            sample.ms[stage] = 0.25 * total_ms[i];
        }
        sample.ms[DIP_BENCH_STAGE_total] = total_ms[i];
        DipTimed timed = {.round = i / frames, .frame = i % frames};
        dip_bench_sample_time(&sample, &timed);
        dip_bench_result_add(result, 0, &timed);
    }
    for (int f = 0; f < frames; f++) {
        DipBenchSample sample = {.counters = {.texels_fetched = 10 * (uint64_t)(f + 1)}};
        snprintf(sample.hash, sizeof sample.hash, "%d", f);
        *dip_bench_result_first(result, 0, f) = sample;
    }
}

char *dip_printed(bool (*print)(void *context, FILE *out), void *context) {
    char *text = NULL;
    size_t size_bytes = 0;
    FILE *out = open_memstream(&text, &size_bytes);
    const bool printed = out && print(context, out);
    if (out) {
        fclose(out);
    }
    if (!printed) {
        free(text);
        return NULL;
    }
    return text;
}
