// Measuring the combinations and programs in turn.
#include "app/bench/measure.h"

#include "app/cli/drive.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCK_SUBJECTS = 4 }; // As in a report.

// Subject i is combination i / source_count of source i % source_count. If there are two sources,
// the first one is the base of the second; otherwise the plan's base is that of all combinations.
typedef struct BenchTiming {
    const DipBenchPlan *plan;
    const DipBenchSource *sources;
    int source_count;
    DipBenchResult *results;
} BenchTiming;

// This program's pictures must not depend on threads or instruction sets. The driver's warm-up
// draws the combinations in order, so the other picture is there already.
static bool check_picture(const BenchTiming *t, int combination, int frame, const char *hash,
                          DipError *err) {
    const int like = dip_bench_same_pictures(t->plan, combination);
    const char *expected = dip_bench_result_first(&t->results[0], like, frame)->hash;
    char label[DIP_BENCH_LABEL_SIZE];
    dip_bench_label(t->plan, &t->plan->combinations[combination], DIP_BENCH_AXIS_COUNT, label);
    return strcmp(hash, expected) == 0 ||
           dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "bench",
                         "the picture of frame %d with %s has the hash %s, but row %d has %s; they "
                         "must be the same",
                         frame, label, hash, like + 1, expected);
}

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
        if (turn->subject % t->source_count == 0 &&
            !check_picture(t, combination, turn->frame, sample.hash, err)) {
            return false;
        }
    }
    dip_bench_sample_time(&sample, timed);
    timed->wait = NAN;
    return true;
}

// The base has a visit in every block of a round; the last one's times are kept.
static void keep_times(const BenchTiming *t, const DipTimes *times) {
    for (int i = 0; i < times->count; i++) {
        const DipTimed *timed = &times->list[i];
        dip_bench_result_add(&t->results[timed->subject % t->source_count],
                             timed->subject / t->source_count, timed);
    }
}

static bool compare(const BenchTiming *t, const DipTimes *times, DipError *err) {
    DipTimesFit *fit = dip_times_fit(times, err);
    for (int s = 0; fit && s < times->subjects; s++) {
        const int combination = s / t->source_count;
        DipBenchResult *result = &t->results[s % t->source_count];
        result->ratios[combination] = dip_times_ratio(fit, s);
        if (t->source_count == 1) {
            result->speed_ups[combination] =
                dip_times_ratio_of(fit, dip_bench_fewest_threads(t->plan, combination), s);
        }
    }
    const bool done = fit != NULL;
    dip_times_fit_free(&fit);
    return done;
}

bool dip_bench_measure(const DipBenchPlan *plan, const DipBenchSource *sources, int source_count,
                       DipBenchResult *results, DipError *err) {
    const int subjects = plan->count * source_count;
    int base_of[2 * DIP_BENCH_MAX_COMBINATIONS];
    for (int s = 0; s < subjects; s++) {
        base_of[s] = source_count == 2 ? s - s % 2 : plan->base;
    }
    const DipDriverDef def = {
        .subjects = subjects,
        .base_of = base_of,
        .block_subjects = source_count == 2 ? 1 : BLOCK_SUBJECTS,
        .starts = 1,
        .rounds = plan->options.measure.rounds,
        .frames = plan->options.frames,
        .warm_frames = plan->options.frames,
        .seed = (uint64_t)plan->options.measure.seed,
        .in_turn = source_count == 2,
        .rest_ns = source_count == 2 ? 1000000 : 0,
    };
    BenchTiming t = {plan, sources, source_count, results};
    const DipDriverCalls calls = {.draw = draw, .context = &t};
    DipDriver *driver = dip_driver_create(&def, &calls, err);
    bool done = driver && dip_drive(driver, "frames", "bench", "interrupted", err);
    if (done) {
        const DipTimes times = dip_driver_times(driver);
        keep_times(&t, &times);
        done = compare(&t, &times, err);
    }
    dip_driver_destroy(&driver);
    return done;
}
