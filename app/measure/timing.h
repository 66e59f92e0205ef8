// Interleaved timing: several subjects take turns, so that whatever slows the machine down for a
// while slows all of them alike and cancels in their ratios.
//
// A subject is anything that draws a few frames, for example the renderer with one set of quality
// settings. dip_timing_run runs these phases:
//   1. Warm-up. Every subject runs every frame once, untimed.
//   2. Settling, if asked for. Subject 0 runs its frame 0 until two successive medians of five runs
//      agree within 2 %, for at most 20 medians: then clock frequency and caches are steady.
//   3. Rounds. Each round visits every subject once, in an order that is shuffled anew from the
//      seed. A visit runs the subject's frames in order and times each. Before, it runs the first
//      frame once untimed, since the previous subject has used the caches.
// If there are two versions (two builds of one program), a visit instead runs each frame in both,
// in an order that is drawn from the seed, and rests before each run, so that neither always gets
// the warm cache and the other's threads have gone to sleep.
//
// To learn how much of a difference is noise, time one subject twice under two indices (A/A): the
// interval of their ratio should contain 1.
//
// One call runs on the calling thread. Calls may run at the same time, but then disturb each other.
#ifndef DIP_APP_MEASURE_TIMING_H
#define DIP_APP_MEASURE_TIMING_H

#include "renderer/base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { DIP_TIMING_MAX_VERSIONS = 2 };

typedef enum DipTimingPhase {
    DIP_TIMING_WARM_UP, // Phase 1: every frame once.
    DIP_TIMING_SETTLE,  // Phase 2: subject 0 until its time is steady.
    DIP_TIMING_REWARM,  // Phase 3: the untimed run at the start of a visit.
    DIP_TIMING_TIMED    // Phase 3: a run whose time is kept.
} DipTimingPhase;

// One run of one frame.
typedef struct DipTimingTurn {
    DipTimingPhase phase;
    int round; // 0..round_count - 1; -1 before the rounds.
    int subject;
    int frame;
    int version;
} DipTimingTurn;

// Functions of the caller. Each returns false, with *err filled, to end the measurement.
typedef struct DipTimingCalls {
    // Runs a frame. Only this call is timed.
    bool (*run)(void *context, const DipTimingTurn *turn, DipError *err);

    // Called after each run with its time: for progress, interruption and further figures of the
    // run. May be NULL.
    bool (*after_run)(void *context, const DipTimingTurn *turn, double ms, DipError *err);

    // Returns the times of a round that is known from an earlier measurement, in the layout that
    // after_round receives; such a round is not run. Returns NULL to run it. May be NULL.
    const double *(*known_round)(void *context, int round);

    // Receives the times of a round, run or known:
    // [(version * subject_count + subject) * frame_count + frame]. May be NULL.
    bool (*after_round)(void *context, int round, const double *ms, bool known, DipError *err);

    // The clock, in nanoseconds. NULL means the monotonic clock.
    int64_t (*clock_ns)(void *context);

    void *context; // Passed to every function.
} DipTimingCalls;

typedef struct DipTimingDef {
    int subject_count; // At least 1.
    int frame_count;   // Frames of each subject, at least 1.
    int version_count; // 1 or 2.
    int round_count;   // At least 0.
    uint64_t seed;     // Of the order. The same seed gives the same order.
    bool settle;       // Run phase 2.
    int64_t rest_ns;   // Pause before each run of the rounds if there are two versions.
} DipTimingDef;

// Runs all phases. `ms` receives the times, grouped by subject for the functions of statistics.h:
// ((version * subject_count + subject) * round_count + round) * frame_count + frame. It has room
// for version_count * subject_count * round_count * frame_count values, or is NULL. Returns false
// when a function of the caller did, or with DIP_ERROR_MEMORY.
bool dip_timing_run(const DipTimingDef *def, const DipTimingCalls *calls, double *ms,
                    DipError *err);

// The number of runs that phases 1 and 3 take if `known_rounds` rounds are known, for progress.
int64_t dip_timing_run_count(const DipTimingDef *def, int known_rounds);

// The index of a subject's first time in `ms` of dip_timing_run.
size_t dip_timing_index(const DipTimingDef *def, int version, int subject);

#ifdef __cplusplus
}
#endif

#endif
