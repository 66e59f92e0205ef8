// Running the programs, start by start, and estimating from their times.
#include "app/cost/diff/diff_duel.h"

#include "app/bench/child.h"
#include "app/cli/interrupt.h"
#include "app/measure/timing/thread_use.h"
#include "app/measure/timing/timing.h"
#include "app/cli/progress.h"

#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>

// Rest before a frame, in which the other program's threads go to sleep.
static const int64_t rest_ns = 1000000;

static bool out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost diff", "out of memory");
}

// --- indices -------------------------------------------------------------------------------------

static int frame_count(const DipCostDuel *duel) {
    return duel->def->plan->options.frames;
}

static int time_count(const DipCostDuel *duel) {
    return duel->def->starts * duel->def->rounds * frame_count(duel);
}

static double *times_of(const DipCostDuel *duel, int side, int pair, DipBenchStage stage) {
    const int index = (side * duel->def->pair_count + pair) * DIP_BENCH_STAGE_COUNT + (int)stage;
    return duel->ms + (size_t)index * (size_t)time_count(duel);
}

const double *dip_cost_duel_ms(const DipCostDuel *duel, int side, int pair, DipBenchStage stage) {
    return times_of(duel, side, pair, stage);
}

static const bool *disturbed_of(const DipCostDuel *duel, int pair) {
    return duel->disturbed + (size_t)pair * (size_t)time_count(duel);
}

// --- one start -----------------------------------------------------------------------------------

typedef struct Start {
    DipCostDuel *duel;
    DipBenchChild *children[2];
    DipThreadWatch *watches[2];
    int start;
    DipBenchSample sample; // Of the latest run.
    int64_t waited_ns;     // Waiting time of the latest run's threads.
    double *sums;          // Of all timed runs: {waiting time, time * threads}, in milliseconds.
    DipProgress *progress;
    int64_t *drawn;
} Start;

static bool interrupted(DipError *err) {
    return !dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "cost diff", "interrupted");
}

static bool draw(void *context, const DipTimingTurn *turn, DipError *err) {
    Start *s = context;
    const DipCostDuelDef *def = s->duel->def;
    const int program = def->program_of[turn->subject][turn->version];
    const bool hash = turn->phase == DIP_TIMING_WARM_UP && s->start == 0;
    const int64_t before_ns = dip_thread_watch_read(s->watches[program]).wait_ns;
    const bool drawn = !dip_interrupted() &&
                       dip_bench_child_draw(s->children[program],
                                            def->combination_of[turn->subject][turn->version],
                                            turn->frame, hash, &s->sample, err);
    s->waited_ns = dip_thread_watch_read(s->watches[program]).wait_ns - before_ns;
    // Ctrl-C ends the children, too, so a failed draw is then no fault of theirs.
    return dip_interrupted() ? !interrupted(err) : drawn;
}

static void keep_time(Start *s, const DipTimingTurn *turn) {
    DipCostDuel *duel = s->duel;
    const int at = (s->start * duel->def->rounds + turn->round) * frame_count(duel) + turn->frame;
    const double total_ms = s->sample.ms[DIP_BENCH_STAGE_total];
    const double waited_ms = 1e-6 * (double)s->waited_ns;
    for (int stage = 0; stage < DIP_BENCH_STAGE_COUNT; stage++) {
        times_of(duel, turn->version, turn->subject, (DipBenchStage)stage)[at] =
            s->sample.ms[stage];
    }
    duel->disturbed[turn->subject * time_count(duel) + at] |=
        waited_ms > DIP_PAIRED_MOST_WAIT * total_ms;
    s->sums[0] += waited_ms;
    s->sums[1] += total_ms * duel->threads;
}

static bool after_draw(void *context, const DipTimingTurn *turn, double ms, DipError *err) {
    (void)ms;
    (void)err;
    Start *s = context;
    DipCostDuel *duel = s->duel;
    if (turn->phase == DIP_TIMING_TIMED) {
        keep_time(s, turn);
    } else if (s->start == 0 && turn->phase == DIP_TIMING_WARM_UP) {
        const int row = turn->version * duel->def->pair_count + turn->subject;
        duel->first[row * frame_count(duel) + turn->frame] = s->sample;
    }
    dip_progress_show(s->progress, ++*s->drawn);
    return true;
}

// The number of threads that draw. If it was not given, the programs' ini decides, and the threads
// are counted: bench has a pool of its own beside the session's, and the main thread is in both.
static int thread_count(const DipCostDuelDef *def, const DipThreadWatch *watch) {
    const int threads = (dip_thread_watch_count(watch) + 1) / 2;
    return def->threads > 0 ? def->threads : threads > 0 ? threads : 1;
}

// Starts the programs. A program that does not answer is a mistake on the command line.
static bool open_start(Start *s, DipError *err) {
    DipCostDuel *duel = s->duel;
    for (int p = 0; p < duel->def->program_count; p++) {
        s->children[p] = dip_bench_child_start(duel->def->programs[p], duel->def->plan, err);
        if (!s->children[p]) {
            if (err && err->code != DIP_ERROR_MEMORY && !dip_interrupted()) {
                err->origin = s->start == 0 ? DIP_ORIGIN_INPUT : DIP_ORIGIN_RUNTIME;
                memcpy(err->key, "cost diff", sizeof "cost diff");
            }
            return dip_interrupted() ? !interrupted(err) : false;
        }
        s->watches[p] = dip_thread_watch_open_process(dip_bench_child_pid(s->children[p]));
        duel->has_wait = duel->has_wait && s->watches[p];
        duel->threads = thread_count(duel->def, s->watches[p]);
    }
    return true;
}

static void close_start(Start *s) {
    for (int p = 0; p < 2; p++) {
        dip_thread_watch_close(&s->watches[p]);
        if (s->children[p] && dip_interrupted()) {
            // Its answer is no longer read, so it must not complain that it cannot be written.
            kill((pid_t)dip_bench_child_pid(s->children[p]), SIGTERM);
        }
        dip_bench_child_stop(&s->children[p]);
    }
}

static DipTimingDef timing_def(const DipCostDuelDef *def, int start) {
    return (DipTimingDef){
        .subject_count = def->pair_count,
        .frame_count = def->plan->options.frames,
        .version_count = 2,
        .round_count = def->rounds,
        .seed = def->seed + (uint64_t)start,
        .rest_ns = rest_ns,
    };
}

static bool run_starts(DipCostDuel *duel, DipError *err) {
    const DipCostDuelDef *def = duel->def;
    const DipTimingDef one = timing_def(def, 0);
    DipProgress progress =
        dip_progress_begin("frames", def->starts * dip_timing_run_count(&one, 0));
    double sums[2] = {0.0, 0.0};
    int64_t drawn = 0;
    bool done = true;
    for (int start = 0; done && start < def->starts; start++) {
        Start s = {
            .duel = duel, .start = start, .sums = sums, .progress = &progress, .drawn = &drawn};
        const DipTimingDef timing = timing_def(def, start);
        const DipTimingCalls calls = {.run = draw, .after_run = after_draw, .context = &s};
        done = open_start(&s, err) && dip_timing_run(&timing, &calls, NULL, err);
        close_start(&s);
    }
    dip_progress_end(&progress, drawn);
    duel->wait = duel->has_wait && sums[1] > 0.0 ? sums[0] / sums[1] : 0.0;
    return done;
}

bool dip_cost_duel_run(const DipCostDuelDef *def, DipCostDuel *duel, DipError *err) {
    *duel = (DipCostDuel){.def = def, .has_wait = true};
    const size_t pairs = (size_t)def->pair_count;
    const size_t times = pairs * (size_t)time_count(duel);
    duel->ms = calloc(2 * DIP_BENCH_STAGE_COUNT * times, sizeof *duel->ms);
    duel->disturbed = calloc(times, sizeof *duel->disturbed);
    duel->first = calloc(2 * pairs * (size_t)frame_count(duel), sizeof *duel->first);
    dip_interrupt_watch();
    const bool made = duel->ms && duel->disturbed && duel->first;
    const bool done = made ? run_starts(duel, err) : out_of_memory(err);
    if (!done) {
        dip_cost_duel_free(duel);
    }
    return done;
}

void dip_cost_duel_free(DipCostDuel *duel) {
    free(duel->ms);
    free(duel->disturbed);
    free(duel->first);
    *duel = (DipCostDuel){.def = NULL};
}

// --- estimates -----------------------------------------------------------------------------------

static bool drops(const DipCostDuel *duel, int pair) {
    int disturbed = 0;
    for (int i = 0; i < time_count(duel); i++) {
        disturbed += disturbed_of(duel, pair)[i];
    }
    return 2 * disturbed <= time_count(duel);
}

// Fills ms[] with side 1's time of the frame as if only the given stage differed from side 0, so
// that the ratio to side 0's time is the stage's share of the change.
static DipPairedStarts list_times(const DipCostDuel *duel, int pair, DipBenchStage stage,
                                  double *ms) {
    const double *base = dip_cost_duel_ms(duel, 0, pair, DIP_BENCH_STAGE_total);
    const double *from = dip_cost_duel_ms(duel, 0, pair, stage);
    const double *to = dip_cost_duel_ms(duel, 1, pair, stage);
    const bool *disturbed = disturbed_of(duel, pair);
    const bool drop = drops(duel, pair);
    for (int i = 0; i < time_count(duel); i++) {
        ms[i] = drop && disturbed[i] ? NAN : fmax(base[i] + to[i] - from[i], 0.01 * base[i]);
    }
    return (DipPairedStarts){ms, base, duel->def->starts, duel->def->rounds, frame_count(duel)};
}

bool dip_cost_duel_change(const DipCostDuel *duel, int pair, DipBenchStage stage,
                          DipStatsEstimate *change, DipError *err) {
    double *ms = malloc((size_t)time_count(duel) * sizeof *ms);
    if (!ms) {
        return out_of_memory(err);
    }
    const DipPairedStarts times = list_times(duel, pair, stage, ms);
    const bool done = dip_paired_starts_ratio(&times, change, err);
    free(ms);
    return done;
}

bool dip_cost_duel_difference(const DipCostDuel *duel, int pair, DipBenchStage stage,
                              double *per_start, DipStartDifference *difference, DipError *err) {
    double *ms = malloc((size_t)time_count(duel) * sizeof *ms);
    if (!ms) {
        return out_of_memory(err);
    }
    const DipPairedStarts times = list_times(duel, pair, stage, ms);
    const bool done = dip_paired_starts_difference(&times, difference, per_start, err);
    free(ms);
    return done;
}

double dip_cost_duel_mean_ms(const DipCostDuel *duel, int side, int pair) {
    const int rounds = duel->def->starts * duel->def->rounds;
    double *scratch = malloc((size_t)rounds * sizeof *scratch);
    const double ms =
        scratch ? dip_stats_time(dip_cost_duel_ms(duel, side, pair, DIP_BENCH_STAGE_total),
                                 frame_count(duel), rounds, scratch)
                : NAN;
    free(scratch);
    return ms;
}

bool dip_cost_duel_signs(const DipCostDuel *duel, DipCostSigns *signs, DipError *err) {
    const int same = duel->def->pair_count - 1;
    const DipPairedTimes times = {dip_cost_duel_ms(duel, 1, same, DIP_BENCH_STAGE_total),
                                  dip_cost_duel_ms(duel, 0, same, DIP_BENCH_STAGE_total),
                                  duel->def->starts * duel->def->rounds, frame_count(duel)};
    DipStatsEstimate ratio;
    if (!dip_cost_duel_change(duel, same, DIP_BENCH_STAGE_total, &ratio, err)) {
        return false;
    }
    int disturbed = 0;
    const int count = duel->def->pair_count * time_count(duel);
    for (int i = 0; i < count; i++) {
        disturbed += duel->disturbed[i];
    }
    *signs = (DipCostSigns){
        .wait = duel->wait,
        .spread = fmax(dip_paired_spread(&times), 0.0),
        .offset = fabs(log(ratio.value)),
        .disturbed = (double)disturbed / count,
        .settled = true,
    };
    return true;
}
