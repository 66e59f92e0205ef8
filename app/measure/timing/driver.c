// Measures step by step: each step draws the next frame of the plan. If the plan is done, the step
// first plans the next start or round (driver_plan.c).
#include "app/measure/timing/driver_private.h"

#include "app/measure/stats/estimate.h"
#include "renderer/base/assert.h"
#include "renderer/base/clock.h"
#include "renderer/base/fp_mode.h"

#include <math.h>
#include <stdlib.h>
#include <time.h>

enum {
    SETTLE_TRIES = 20,
    MOST_IN_VAIN = 2 // The driver is done after this many repetitions in vain (in_vain) in a row.
};
static const double settle_tolerance = 0.02;

static bool out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "timing", "out of memory");
}

// --- earlier rounds ------------------------------------------------------------------------------

static bool use_two_starts(DipDriver *d) {
    const int rounds = dip_driver_round_count(d);
    if (rounds % 2 != 0) {
        return false;
    }
    d->def.starts = 2;
    d->def.rounds = rounds / 2;
    return true;
}

// Decides on the number of starts (most_start). This happens after the first round, which belongs
// to the first start in any case.
static void fix_starts(DipDriver *d, int64_t round_ns) {
    DIP_FP_MODE_SCOPE();
    const double room_ns = d->def.most_start * (double)round_ns * d->def.rounds;
    if (!d->starts_are_fixed && d->def.starts > 2 && d->def.most_start > 0.0 && d->start == 0 &&
        (double)d->start_ns > room_ns) {
        use_two_starts(d);
    }
    d->starts_are_fixed = true;
}

// Returns whether a frame given to dip_driver_resume is valid and is the frame that `draw`, a part
// of the current round's plan, says.
static bool is_of_draw(const DipDriver *d, const DipTimed *timed, const DipDriverDraw *draw) {
    return timed->subject == draw->subject && timed->block == draw->block &&
           timed->frame == draw->frame &&
           dip_driver_round_of(d, timed) == dip_driver_first_round(d) && timed->round >= 0 &&
           timed->round < d->def.rounds && timed->ms > 0.0 && isfinite(timed->ms) &&
           timed->wait >= 0.0;
}

bool dip_driver_resume(DipDriver *d, const DipTimed *known, int count) {
    DIP_ASSERT(d->stage == DIP_DRIVER_STAGE_PLAN && d->start < 0);
    // If the first start has more rounds than defined, the earlier measurement used two starts.
    for (int i = 0; i < count && !d->starts_are_fixed; i++) {
        d->starts_are_fixed =
            known[i].start == 0 && known[i].round >= d->def.rounds && use_two_starts(d);
    }
    for (int at = 0; at < count;) {
        if (d->round == 2 * dip_driver_round_count(d) || !dip_driver_plan_round(d)) {
            return false;
        }
        for (int p = 0; p < d->plan_count; p++) {
            const DipDriverDraw *draw = &d->plan[p];
            if (draw->phase != DIP_DRIVER_TIMED) {
                continue;
            }
            const DipTimed *timed = &known[at + d->fresh_count];
            if (at + d->fresh_count == count || !is_of_draw(d, timed, draw)) {
                return false;
            }
            d->fresh[d->fresh_count++] = *timed;
        }
        at += d->fresh_count;
        d->left -= dip_driver_repeats(d) ? 0 : d->plan_count;
        if (d->fresh_count > 0) {
            d->origin_ns = -known[at - 1].begin_ns;
        }
        dip_driver_end_round(d);
    }
    return true;
}

// --- drawing -------------------------------------------------------------------------------------

// The functions of the caller run in the caller's floating-point mode, as they would without the
// driver: a mode can make a program slower or faster. Only what computes with their results sets
// the mode.

static int64_t now_ns(const DipDriver *d) {
    return d->calls.clock_ns ? d->calls.clock_ns(d->calls.context) : dip_clock_ns();
}

static DipThreadUse thread_use(const DipDriver *d) {
    return d->calls.thread_use ? d->calls.thread_use(d->calls.context)
                               : dip_thread_watch_read(d->watch);
}

static void rest(int64_t ns) {
    const struct timespec time = {.tv_sec = (time_t)(ns / 1000000000),
                                  .tv_nsec = (long)(ns % 1000000000)};
    nanosleep(&time, NULL);
}

// Writes how long a frame took, from the clock and from the use of the threads before and after it.
static void set_times(DipTimed *timed, int64_t ns, const DipThreadUse *before,
                      const DipThreadUse *after) {
    DIP_FP_MODE_SCOPE();
    timed->ms = fmax(1e-6 * (double)ns, 1e-6); // A clock may stand still for a frame.
    timed->wait = 1e-6 * (double)(after->wait_ns - before->wait_ns) / timed->ms;
    timed->cpu_ms = 1e-6 * (double)(after->cpu_ns - before->cpu_ns);
    timed->switches = (double)(after->switches - before->switches);
}

// Draws a frame and writes its times to *timed.
static bool draw_frame(DipDriver *d, const DipDriverDraw *draw, DipTimed *timed, DipError *err) {
    const bool in_round = draw->phase >= DIP_DRIVER_UNTIMED;
    const int round = dip_driver_first_round(d);
    const DipDriverTurn turn = {
        .phase = draw->phase,
        .subject = draw->subject,
        .start = in_round ? round / d->def.rounds : d->start,
        .round = in_round ? round % d->def.rounds : -1,
        .frame = draw->frame,
    };
    if (d->calls.prepare && !d->calls.prepare(d->calls.context, &turn, err)) {
        return false;
    }
    if (draw->phase == DIP_DRIVER_TIMED && d->def.rest_ns > 0) {
        rest(d->def.rest_ns);
    }
    const DipThreadUse before = thread_use(d);
    const int64_t begin_ns = now_ns(d);
    if (!d->has_begun) {
        // Before, origin_ns is 0, or minus the time at which the last visit of the resumed rounds
        // began.
        d->origin_ns += begin_ns;
        d->has_begun = true;
    }
    d->visit_ns = draw->begins_visit ? begin_ns : d->visit_ns;
    *timed = (DipTimed){.subject = draw->subject,
                        .start = turn.start,
                        .round = turn.round,
                        .block = draw->block,
                        .frame = draw->frame,
                        .begin_ns = d->visit_ns - d->origin_ns,
                        .ms = NAN};
    if (!d->calls.draw(d->calls.context, &turn, timed, err)) {
        return false;
    }
    const int64_t ns = now_ns(d) - begin_ns;
    if (isnan(timed->ms)) {
        const DipThreadUse after = thread_use(d);
        set_times(timed, ns, &before, &after);
    } else if (isnan(timed->wait)) {
        timed->wait = 0.0;
        d->has_wait = false;
    }
    return true;
}

static bool draw_next(DipDriver *d, DipError *err) {
    const DipDriverDraw *draw = &d->plan[d->next];
    DipTimed timed;
    if (!draw_frame(d, draw, &timed, err)) {
        return false;
    }
    if (draw->phase == DIP_DRIVER_TIMED) {
        d->fresh[d->fresh_count++] = timed;
    }
    const bool counts = d->stage == DIP_DRIVER_STAGE_WARM_UP || !dip_driver_repeats(d);
    d->drawn += counts;
    d->left -= counts && d->stage == DIP_DRIVER_STAGE_DRAW;
    d->next++;
    return true;
}

// Adds a time to phase 2, and finds whether the times have settled.
static void judge_settling(DipDriver *d, const DipTimed *timed) {
    DIP_FP_MODE_SCOPE();
    d->settle_ms[d->settle_runs++ % DIP_DRIVER_SETTLE_RUNS] = timed->ms;
    if (d->settle_runs % DIP_DRIVER_SETTLE_RUNS == 0) {
        const double median = dip_median(d->settle_ms, DIP_DRIVER_SETTLE_RUNS);
        d->settled = d->settle_runs > DIP_DRIVER_SETTLE_RUNS &&
                     fabs(median - d->settle_last_ms) <= settle_tolerance * d->settle_last_ms;
        d->settle_last_ms = median;
    }
}

static bool draw_settling(DipDriver *d, DipError *err) {
    DipTimed timed;
    if (!draw_frame(d, &(DipDriverDraw){.phase = DIP_DRIVER_SETTLE}, &timed, err)) {
        return false;
    }
    judge_settling(d, &timed);
    d->stage = d->settled || d->settle_runs == DIP_DRIVER_SETTLE_RUNS * SETTLE_TRIES
                   ? DIP_DRIVER_STAGE_PLAN
                   : DIP_DRIVER_STAGE_SETTLE;
    return true;
}

// --- steps ---------------------------------------------------------------------------------------

// Plans the next round that has frames to draw. Begins a start if the round needs another.
static bool begin_round(DipDriver *d, DipError *err) {
    const int rounds = dip_driver_round_count(d);
    do {
        if (d->round == 2 * rounds || d->in_vain == MOST_IN_VAIN ||
            (dip_driver_repeats(d) && !(d->has_wait && d->def.most_wait > 0.0))) {
            d->stage = DIP_DRIVER_STAGE_DONE;
            return true;
        }
        if (!dip_driver_plan_round(d)) {
            return out_of_memory(err);
        }
        // The plan is empty if no frame of the round has to be drawn again.
        d->round += d->plan_count == 0;
    } while (d->plan_count == 0);
    const int start = !dip_driver_repeats(d) ? d->round / d->def.rounds
                      : d->start >= 0        ? d->start
                                             : d->def.starts - 1;
    d->stage = DIP_DRIVER_STAGE_DRAW;
    if (start == d->start) {
        d->round_begin_ns = now_ns(d);
        return true;
    }
    d->start_begin_ns = now_ns(d);
    d->start = start;
    d->stage = DIP_DRIVER_STAGE_WARM_UP;
    return (!d->calls.start || d->calls.start(d->calls.context, start, err)) &&
           (dip_driver_plan_start(d) || out_of_memory(err));
}

static bool complete_round(DipDriver *d, DipError *err) {
    d->stage = DIP_DRIVER_STAGE_PLAN;
    dip_driver_end_round(d);
    fix_starts(d, now_ns(d) - d->round_begin_ns);
    return !d->calls.keep || d->calls.keep(d->calls.context, d->fresh, d->fresh_count, err);
}

// Plans what comes next if the plan is done, and draws a frame. Writes to *step only if a round is
// complete or all work is done.
static bool take_step(DipDriver *d, DipDriverStep *step, DipError *err) {
    while (d->stage == DIP_DRIVER_STAGE_PLAN ||
           (d->stage == DIP_DRIVER_STAGE_WARM_UP && d->next == d->plan_count)) {
        if (d->stage == DIP_DRIVER_STAGE_WARM_UP) {
            d->start_ns = now_ns(d) - d->start_begin_ns;
            d->stage = d->def.settle && d->settle_runs == 0 ? DIP_DRIVER_STAGE_SETTLE
                                                            : DIP_DRIVER_STAGE_PLAN;
        } else if (!begin_round(d, err)) {
            return false;
        }
    }
    if (d->stage == DIP_DRIVER_STAGE_SETTLE) {
        return draw_settling(d, err);
    }
    if (d->stage == DIP_DRIVER_STAGE_DONE) {
        *step = DIP_DRIVER_DONE;
        return true;
    }
    if (!draw_next(d, err)) {
        return false;
    }
    if (d->stage == DIP_DRIVER_STAGE_DRAW && d->next == d->plan_count) {
        *step = DIP_DRIVER_ROUND;
        return complete_round(d, err);
    }
    return true;
}

DipDriverStep dip_driver_step(DipDriver *d, DipError *err) {
    DipDriverStep step = DIP_DRIVER_WORKING;
    if (d->stage == DIP_DRIVER_STAGE_FAILED || !take_step(d, &step, err)) {
        d->stage = DIP_DRIVER_STAGE_FAILED;
        return DIP_DRIVER_FAILED;
    }
    return step;
}

void dip_driver_drop_round(DipDriver *d) {
    if (d->stage == DIP_DRIVER_STAGE_DRAW) {
        d->drawn -= dip_driver_repeats(d) ? 0 : d->next;
        d->left += dip_driver_repeats(d) ? 0 : d->next;
        d->stage = DIP_DRIVER_STAGE_PLAN;
    }
}

// --- the whole -----------------------------------------------------------------------------------

static bool open_driver(DipDriver *d, const DipDriverDef *def) {
    const size_t subjects = (size_t)def->subjects;
    const size_t deals = (size_t)def->base_copies * (size_t)def->frames;
    const size_t frames = def->base_copies > 0 ? deals : (size_t)def->frames;
    const size_t rounds = (size_t)dip_driver_round_count(d);
    d->base_of = calloc(5 * subjects + 1 + frames + rounds + 1 + deals, sizeof *d->base_of);
    d->blocks = malloc(subjects * sizeof *d->blocks);
    if (!d->base_of || !d->blocks) {
        return false;
    }
    d->members = d->base_of + subjects;
    d->is_needed = d->members + subjects;
    d->score = d->is_needed + subjects;
    d->order = d->score + subjects;
    d->frames = d->order + subjects + 1;
    d->log_begin = d->frames + frames;
    for (int s = 0; s < def->subjects; s++) {
        d->base_of[s] = def->base_of ? def->base_of[s] : s;
    }
    if (def->base_copies > 0) {
        d->deal = d->log_begin + rounds + 1;
        if (!dip_rounds_deal(def->frames, dip_driver_round_count(d), def->base_copies, def->seed,
                             d->deal, NULL)) {
            return false;
        }
    }
    for (d->round = 0; d->round < dip_driver_round_count(d); d->round++) {
        if (!dip_driver_plan_round(d)) {
            return false;
        }
        d->left += d->plan_count;
    }
    d->round = 0;
    // A repetition adds at most one frame of the base for each frame of the rounds.
    d->log = malloc(2 * (size_t)d->left * sizeof *d->log);
    d->base_wait = malloc(2 * (size_t)d->left * sizeof *d->base_wait);
    return d->log && d->base_wait;
}

DipDriver *dip_driver_create(const DipDriverDef *def, const DipDriverCalls *calls, DipError *err) {
    DIP_ASSERT(def->subjects > 0 && def->starts > 0 && def->rounds > 0 && def->frames > 0);
    DIP_ASSERT(def->block_subjects > 0 && def->warm_frames <= def->frames);
    DIP_ASSERT(def->base_copies == 0 || def->frames >= def->starts * def->rounds);
    DIP_ASSERT(def->base_copies <= def->starts * def->rounds);
    DipDriver *d = calloc(1, sizeof *d);
    if (!d) {
        out_of_memory(err);
        return NULL;
    }
    d->def = *def;
    d->calls = *calls;
    d->start = -1;
    d->settled = !def->settle;
    d->watch = calls->thread_use ? NULL : dip_thread_watch_open();
    d->has_wait = thread_use(d).has_wait;
    if (!open_driver(d, def)) {
        out_of_memory(err);
        dip_driver_destroy(&d);
    }
    return d;
}

void dip_driver_destroy(DipDriver **driver) {
    DipDriver *d = *driver;
    if (d) {
        dip_thread_watch_close(&d->watch);
        free(d->base_of);
        free(d->blocks);
        free(d->plan);
        free(d->fresh);
        free(d->log);
        free(d->base_wait);
        free(d);
    }
    *driver = NULL;
}

DipTimes dip_driver_times(const DipDriver *d) {
    return (DipTimes){
        .list = d->log,
        .count = d->log_count,
        .subjects = d->def.subjects,
        .starts = d->def.starts,
        .rounds = d->def.rounds,
        .frames = d->def.frames,
        .base_of = d->base_of,
        .complete = !d->deal,
    };
}

DipDriverProgress dip_driver_progress(const DipDriver *d) {
    const int rounds = dip_driver_round_count(d);
    const int begun = d->start >= 0 ? d->start + 1 : d->round / d->def.rounds;
    const int starts = d->round < rounds ? d->def.starts - begun : 0;
    const int64_t warming = d->stage == DIP_DRIVER_STAGE_WARM_UP ? d->plan_count - d->next : 0;
    const int64_t left = d->left + warming + (int64_t)starts * d->def.subjects * d->def.warm_frames;
    return (DipDriverProgress){
        .drawn = d->drawn,
        .total = d->drawn + left,
        .rounds = dip_driver_repeats(d) ? rounds : d->round,
        .searched = dip_driver_repeats(d) ? d->round - rounds : 0,
        .all_rounds = rounds,
    };
}

DipDriverMachine dip_driver_machine(const DipDriver *d, int threads) {
    DIP_FP_MODE_SCOPE();
    const double room_ms = d->run_ms * threads;
    DipDriverMachine machine = {
        .settled = d->settled || d->settle_runs == 0,
        .has_wait = d->has_wait,
        .repeated = d->repeated,
    };
    if (room_ms > 0.0) {
        machine.wait = (d->has_wait ? d->wait_ms : room_ms - d->cpu_ms) / room_ms;
    }
    DIP_FP_PIN_STRUCT(machine);
    return machine;
}
