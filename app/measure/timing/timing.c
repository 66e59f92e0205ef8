// Runs a measurement: draws everything once (warm-up), waits until times are steady (settling),
// then runs rounds. In each round, every subject is timed once (a visit), in shuffled order.
#include "app/measure/timing/timing.h"

#include "app/measure/stats/random.h"
#include "app/measure/timing/runner.h"
#include "renderer/base/assert.h"

#include <stdlib.h>
#include <time.h>

typedef struct Timing {
    const DipTimingDef *def;
    const DipTimingCalls *calls;
    DipTimingRunner runner;
    uint64_t random;
    int *order;       // subjects, in the round's order
    double *round_ms; // times of one round, as after_round receives them
} Timing;

static bool run(Timing *t, const DipTimingTurn *turn, double *ms, DipError *err) {
    return dip_timing_run_once(&t->runner, turn, ms, err);
}

// --- before the rounds -------------------------------------------------------------------------

static bool warm_up(Timing *t, DipError *err) {
    DipTimingTurn turn = {.phase = DIP_TIMING_WARM_UP, .round = -1};
    double ms;
    for (turn.subject = 0; turn.subject < t->def->subject_count; turn.subject++) {
        for (turn.frame = 0; turn.frame < t->def->frame_count; turn.frame++) {
            for (turn.version = 0; turn.version < t->def->version_count; turn.version++) {
                if (!run(t, &turn, &ms, err)) {
                    return false;
                }
            }
        }
    }
    return true;
}

// --- rounds ------------------------------------------------------------------------------------

static double *round_time(Timing *t, const DipTimingTurn *turn) {
    const DipTimingDef *def = t->def;
    return &t->round_ms[(turn->version * def->subject_count + turn->subject) * def->frame_count +
                        turn->frame];
}

static bool visit_one_version(Timing *t, int round, int subject, DipError *err) {
    DipTimingTurn turn = {.phase = DIP_TIMING_REWARM, .round = round, .subject = subject};
    double untimed;
    if (!run(t, &turn, &untimed, err)) {
        return false;
    }
    turn.phase = DIP_TIMING_TIMED;
    for (turn.frame = 0; turn.frame < t->def->frame_count; turn.frame++) {
        if (!run(t, &turn, round_time(t, &turn), err)) {
            return false;
        }
    }
    return true;
}

static bool visit_two_versions(Timing *t, int round, int subject, DipError *err) {
    DipTimingTurn turn = {.phase = DIP_TIMING_TIMED, .round = round, .subject = subject};
    const struct timespec rest = {.tv_sec = (time_t)(t->def->rest_ns / 1000000000),
                                  .tv_nsec = (long)(t->def->rest_ns % 1000000000)};
    for (turn.frame = 0; turn.frame < t->def->frame_count; turn.frame++) {
        const int first = (int)(dip_random_next(&t->random) >> 7 & 1);
        for (int i = 0; i < 2; i++) {
            turn.version = first ^ i;
            if (t->def->rest_ns > 0) {
                nanosleep(&rest, NULL);
            }
            if (!run(t, &turn, round_time(t, &turn), err)) {
                return false;
            }
        }
    }
    return true;
}

static void keep_round(const DipTimingDef *def, int round, const double *round_ms, double *ms) {
    for (int v = 0; v < def->version_count; v++) {
        for (int s = 0; s < def->subject_count; s++) {
            double *to = ms + dip_timing_index(def, v, s) + (size_t)(round * def->frame_count);
            for (int f = 0; f < def->frame_count; f++) {
                to[f] = *round_ms++;
            }
        }
    }
}

// If the caller already has the round's times, from an earlier measurement, no subject is timed.
// The subjects are shuffled all the same, so that later rounds have the same order as if this round
// had been run.
static bool run_round(Timing *t, int round, double *ms, DipError *err) {
    const DipTimingCalls *calls = t->calls;
    const double *known = calls->known_round ? calls->known_round(calls->context, round) : NULL;
    dip_random_shuffle(&t->random, t->order, t->def->subject_count);
    for (int i = 0; !known && i < t->def->subject_count; i++) {
        const bool visited = t->def->version_count == 1
                                 ? visit_one_version(t, round, t->order[i], err)
                                 : visit_two_versions(t, round, t->order[i], err);
        if (!visited) {
            return false;
        }
    }
    const double *round_ms = known ? known : t->round_ms;
    if (ms) {
        keep_round(t->def, round, round_ms, ms);
    }
    return !calls->after_round ||
           calls->after_round(calls->context, round, round_ms, known != NULL, err);
}

// --- the whole ---------------------------------------------------------------------------------

bool dip_timing_run(const DipTimingDef *def, const DipTimingCalls *calls, double *ms,
                    DipError *err) {
    DIP_ASSERT(def->subject_count > 0 && def->frame_count > 0 && def->round_count >= 0);
    DIP_ASSERT(def->version_count == 1 || def->version_count == DIP_TIMING_MAX_VERSIONS);
    const size_t subjects = (size_t)def->subject_count;
    const size_t values = (size_t)def->version_count * subjects * (size_t)def->frame_count;
    Timing t = {
        .def = def,
        .calls = calls,
        .runner = {calls->run, calls->after_run, calls->clock_ns, calls->context},
        .random = def->seed,
        .order = malloc(subjects * sizeof(int)),
        .round_ms = malloc(values * sizeof(double)),
    };
    bool done = (t.order && t.round_ms) ||
                dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "timing", "out of memory");
    for (int i = 0; done && i < def->subject_count; i++) {
        t.order[i] = i;
    }
    bool settled;
    done =
        done && warm_up(&t, err) && (!def->settle || dip_timing_settle(&t.runner, &settled, err));
    for (int round = 0; done && round < def->round_count; round++) {
        done = run_round(&t, round, ms, err);
    }
    free(t.order);
    free(t.round_ms);
    return done;
}

int64_t dip_timing_run_count(const DipTimingDef *def, int known_rounds) {
    const int64_t rewarm = def->version_count == 1;
    const int64_t warm_up = (int64_t)def->version_count * def->frame_count;
    const int64_t visit = (int64_t)def->version_count * def->frame_count + rewarm;
    return def->subject_count * (warm_up + (def->round_count - known_rounds) * visit);
}

size_t dip_timing_index(const DipTimingDef *def, int version, int subject) {
    return (size_t)(version * def->subject_count + subject) * (size_t)def->round_count *
           (size_t)def->frame_count;
}
