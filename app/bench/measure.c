// Measures the plan's combinations in one program, or in two programs in turn, and stores the times
// and counters of every frame.
#include "app/bench/measure.h"

#include "app/cli/progress.h"
#include "app/measure/stats/estimate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- results -------------------------------------------------------------------------------------

static size_t values_per_stage(const DipBenchPlan *plan) {
    return (size_t)plan->options.measure.rounds * (size_t)plan->options.frames;
}

bool dip_bench_result_init(DipBenchResult *result, const DipBenchPlan *plan, DipError *err) {
    const size_t count = (size_t)plan->count;
    *result = (DipBenchResult){.plan = plan};
    result->ms = calloc(count * DIP_BENCH_STAGE_COUNT * values_per_stage(plan), sizeof(double));
    result->first = calloc(count * (size_t)plan->options.frames, sizeof(DipBenchSample));
    result->scratch = calloc(values_per_stage(plan), sizeof(double));
    result->ratios = calloc(count, sizeof(DipEstimate));
    result->speed_ups = calloc(count, sizeof(DipEstimate));
    if (!result->ms || !result->first || !result->scratch || !result->ratios ||
        !result->speed_ups) {
        dip_bench_result_free(result);
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "bench", "out of memory");
    }
    return true;
}

void dip_bench_result_free(DipBenchResult *result) {
    free(result->ms);
    free(result->first);
    free(result->scratch);
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

double dip_bench_result_quantile(const DipBenchResult *result, int combination, DipBenchStage stage,
                                 double share) {
    return dip_percentile_of(dip_bench_result_ms(result, combination, stage),
                             (int)values_per_stage(result->plan), share, result->scratch);
}

double dip_bench_result_fastest_ms(const DipBenchResult *result, int combination,
                                   DipBenchStage stage) {
    const DipBenchOptions *options = &result->plan->options;
    const double *ms = dip_bench_result_ms(result, combination, stage);
    double sum = 0.0;
    for (int frame = 0; frame < options->frames; frame++) {
        double least = ms[frame];
        for (int round = 1; round < options->measure.rounds; round++) {
            least = fmin(least, ms[round * options->frames + frame]);
        }
        sum += least;
    }
    return sum / options->frames;
}

DipBenchSample *dip_bench_result_first(const DipBenchResult *result, int combination, int frame) {
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

// --- measuring -----------------------------------------------------------------------------------

// Greatest number of subjects in a block besides the base (driver.h), if one program is measured.
// `diptych cost` times as many rows beside one drawing of the baseline (app/cost/times.c).
enum { BLOCK_SUBJECTS = 4 };

// The driver's subject i (driver.h) is combination i / source_count of source i % source_count. If
// there are two sources, each combination of the second is compared with the same combination of
// the first, its base. Otherwise all combinations are compared with the plan's base.
typedef struct BenchTiming {
    const DipBenchPlan *plan;
    const DipBenchSource *sources;
    int source_count;
    DipBenchResult *results;
} BenchTiming;

// Fails unless a picture equals the picture of the first instruction set and number of threads,
// because pictures must depend on neither. The driver's warm-up draws the combinations in order, so
// the picture to compare with has been drawn already.
static bool check_picture(const BenchTiming *t, int combination, int frame, const char *hash,
                          DipError *err) {
    const int like = dip_bench_same_pictures(t->plan, combination);
    const char *expected = dip_bench_result_first(&t->results[0], like, frame)->hash;
    char label[DIP_BENCH_LABEL_SIZE];
    dip_bench_label(t->plan, combination, DIP_BENCH_AXIS_COUNT, label);
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
        *dip_bench_result_first(&t->results[turn->subject % t->source_count], combination,
                                turn->frame) = sample;
        if (turn->subject % t->source_count == 0 &&
            !check_picture(t, combination, turn->frame, sample.hash, err)) {
            return false;
        }
    }
    dip_bench_sample_time(&sample, timed);
    timed->wait = NAN;
    return true;
}

// Stores the times in the results. With one program, every block of a round draws the plan's base;
// the times of the last block are kept.
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
