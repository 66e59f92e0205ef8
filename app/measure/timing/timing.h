// Interleaved timing: several subjects take turns. Whatever slows the machine down for a while then
// slows all subjects alike, and the effect cancels in the ratios of their times.
//
// A subject is anything that draws a few frames, for example the renderer with one set of quality
// settings. dip_timing_run runs these phases:
//   1. Warm-up. Every subject runs every frame once, untimed.
//   2. Settling, if asked for. Subject 0 runs its frame 0 until two successive medians of five runs
//      agree within 2 %, but for at most 20 medians. Clock frequency and caches are then steady.
//   3. Rounds. Each round visits every subject once, in an order that is shuffled anew from the
//      seed. A visit runs the subject's frames in order and times each. Before them it runs the
//      first frame once untimed, since the previous subject has used the caches.
// If there are two versions (two builds of one program), a visit works differently: it runs each
// frame once in each version. The order of the versions is drawn from the seed, so that neither
// version always gets the warm cache. Before each run there is a rest, so that the threads of the
// other version go to sleep.
//
// To learn how much of a difference is noise, give one subject two indices, so that it is timed
// twice (A/A). The interval of the ratio of the two times should contain 1.
//
// dip_timing_run calls the subjects on the calling thread. Two calls may run at the same time, but
// they disturb each other's times.
#ifndef DIP_APP_MEASURE_TIMING_TIMING_H
#define DIP_APP_MEASURE_TIMING_TIMING_H

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

    // Called after each run, with the time of the run. Can show progress, interrupt the measurement
    // or record more about the run. The function pointer may be NULL.
    bool (*after_run)(void *context, const DipTimingTurn *turn, double ms, DipError *err);

    // Returns the times of a round if an earlier measurement has them, in the layout that
    // after_round receives; dip_timing_run then does not run this round. Returns NULL if the round
    // must be run. The function pointer may be NULL.
    const double *(*known_round)(void *context, int round);

    // Receives the times of a round. The index of a time is
    // (version * subject_count + subject) * frame_count + frame.
    // `known` is true if the times came from known_round. The function pointer may be NULL.
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
    uint64_t seed;     // Seed of the order of runs. Equal seeds lead to equal orders.
    bool settle;       // True to run phase 2.
    int64_t rest_ns;   // Rest before each run in phase 3 if there are two versions.
} DipTimingDef;

// Runs all phases. `ms` receives the times, grouped by subject for the functions of statistics.h.
// The index of a time is
// ((version * subject_count + subject) * round_count + round) * frame_count + frame.
// `ms` has room for version_count * subject_count * round_count * frame_count values, or is NULL.
// Returns false if a function of the caller returns false. Fails with DIP_ERROR_MEMORY.
bool dip_timing_run(const DipTimingDef *def, const DipTimingCalls *calls, double *ms,
                    DipError *err);

// Returns the number of runs that phases 1 and 3 take if `known_rounds` rounds are known. Use it to
// show progress.
int64_t dip_timing_run_count(const DipTimingDef *def, int known_rounds);

// Returns the index of a subject's first time in the array `ms` that dip_timing_run fills.
size_t dip_timing_index(const DipTimingDef *def, int version, int subject);

#ifdef __cplusplus
}
#endif

#endif
