// Running the programs, start by start, and estimating from their times.
#include "app/cost/diff/diff_duel.h"

#include "app/cli/interrupt.h"
#include "app/measure/timing/child.h"
#include "app/cli/drive.h"

#include <math.h>
#include <stdio.h>
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

// --- drawing -------------------------------------------------------------------------------------

// Subject i is side i % 2 of pair i / 2; side 0 is the base.
typedef struct Programs {
    DipCostDuel *duel;
    DipChild *children[2];
} Programs;

static bool draw(void *context, const DipDriverTurn *turn, DipTimed *timed, DipError *err) {
    const Programs *p = context;
    DipCostDuel *duel = p->duel;
    const DipCostDuelDef *def = duel->def;
    const int pair = turn->subject / 2, side = turn->subject % 2;
    const int program = def->program_of[pair][side];
    const bool first = turn->phase == DIP_DRIVER_WARM_UP && turn->start == 0;
    char request[64];
    DipBenchSample sample;
    snprintf(request, sizeof request, "draw %d %d %d", def->combination_of[pair][side], turn->frame,
             first);
    if (!dip_child_draw(p->children[program], request, &sample, timed, err)) {
        return false;
    }
    if (first) {
        duel->first[(side * def->pair_count + pair) * frame_count(duel) + turn->frame] = sample;
    }
    return true;
}

// --- starts --------------------------------------------------------------------------------------

// The number of threads that draw. If it was not given, the programs' ini decides, and the threads
// are counted: bench has a pool of its own beside the session's, and the main thread is in both.
static int thread_count(const DipCostDuelDef *def, const DipChild *child) {
    const int threads = (dip_child_thread_count(child) + 1) / 2;
    return def->threads > 0 ? def->threads : threads > 0 ? threads : 1;
}

static void stop_programs(Programs *p) {
    dip_child_stop(&p->children[0], dip_interrupted());
    dip_child_stop(&p->children[1], dip_interrupted());
}

// Starts the programs anew. A program that does not answer is a mistake on the command line.
static bool start_programs(void *context, int start, DipError *err) {
    Programs *p = context;
    DipCostDuel *duel = p->duel;
    const DipBenchOptions *options = &duel->def->plan->options;
    stop_programs(p);
    for (int i = 0; i < duel->def->program_count; i++) {
        const DipChildDef def = {duel->def->programs[i], options->argv,   options->argc, "bench",
                                 duel->def->plan->count, options->frames, "--vs"};
        p->children[i] = dip_child_start(&def, err);
        if (!p->children[i]) {
            if (err && err->code != DIP_ERROR_MEMORY) {
                err->origin = start == 0 ? DIP_ORIGIN_INPUT : DIP_ORIGIN_RUNTIME;
                memcpy(err->key, "cost diff", sizeof "cost diff");
            }
            return false;
        }
        duel->threads = thread_count(duel->def, p->children[i]);
    }
    return true;
}

// Copies the times to the duel's arrays.
static void keep_times(DipCostDuel *duel, const DipTimes *times) {
    for (int i = 0; i < times->count; i++) {
        const DipTimed *timed = &times->list[i];
        const int pair = timed->subject / 2;
        const int at = (timed->start * times->rounds + timed->round) * times->frames + timed->frame;
        for (int stage = 0; stage < DIP_BENCH_STAGE_COUNT; stage++) {
            times_of(duel, timed->subject % 2, pair, (DipBenchStage)stage)[at] =
                stage == DIP_BENCH_STAGE_total ? timed->ms : timed->parts_ms[stage];
        }
        duel->disturbed[pair * time_count(duel) + at] |= timed->wait > DIP_TIMED_MOST_WAIT;
    }
}

static bool run_starts(DipCostDuel *duel, DipError *err) {
    const DipCostDuelDef *def = duel->def;
    int base_of[2 * DIP_COST_DUEL_MAX_PAIRS];
    for (int s = 0; s < 2 * def->pair_count; s++) {
        base_of[s] = s - s % 2;
    }
    const DipDriverDef timing = {
        .subjects = 2 * def->pair_count,
        .base_of = base_of,
        .block_subjects = 1,
        .starts = def->starts,
        .rounds = def->rounds,
        .frames = def->plan->options.frames,
        .warm_frames = def->plan->options.frames,
        .seed = def->seed,
        .in_turn = true,
        .rest_ns = rest_ns,
    };
    Programs p = {.duel = duel};
    const DipDriverCalls calls = {.draw = draw, .start = start_programs, .context = &p};
    DipDriver *driver = dip_driver_create(&timing, &calls, err);
    const bool done = driver && dip_drive(driver, "frames", "cost diff", "interrupted", err);
    if (done) {
        const DipTimes times = dip_driver_times(driver);
        const DipDriverMachine machine = dip_driver_machine(driver, duel->threads);
        keep_times(duel, &times);
        duel->has_wait = machine.has_wait;
        duel->wait = machine.has_wait ? machine.wait : 0.0;
    }
    stop_programs(&p);
    dip_driver_destroy(&driver);
    return done;
}

bool dip_cost_duel_run(const DipCostDuelDef *def, DipCostDuel *duel, DipError *err) {
    *duel = (DipCostDuel){.def = def};
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
                          DipEstimate *change, DipError *err) {
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
    DipEstimate ratio;
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
