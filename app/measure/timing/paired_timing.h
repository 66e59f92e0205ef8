// Paired timing: many subjects along a path, each timed next to its base.
//
// A subject is anything that draws the frames of a path, for example the renderer with one set of
// quality settings. Each subject has a base, another subject with which it is compared; a base is
// its own base. dip_paired_timing_run runs these phases:
//   1. Warm-up. Every subject runs its frame 0 once, untimed.
//   2. Settling. Subject 0 runs its frame 0 until two successive medians of five runs agree within
//      2 %, but for at most 20 medians.
//   3. Rounds. Round r times the frames r, r + rounds, r + 2 rounds, ... of the path, so that all
//      rounds together see frames_per_round * rounds frames, each once. In a round, the subjects of
//      a base are put into blocks of a few subjects and the base, in an order that is shuffled anew
//      from the seed, and the blocks of all bases are shuffled. A visit runs the round's frames in
//      order and times each; before them it runs the first one once untimed, since the previous
//      subject has used the caches.
//   4. Repetition. A pair of times is disturbed if the threads of either run waited for a core for
//      more than a fifth of the run's time. As long as a subject has fewer than three quarters of
//      its pairs undisturbed, its disturbed rounds are timed again, each at most once.
//
// A pair is a subject's time and the base's time for the same frame in the same block, so at most a
// few tens of frames lie between the two. paired.h makes estimates of the pairs.
#ifndef DIP_APP_MEASURE_TIMING_PAIRED_TIMING_H
#define DIP_APP_MEASURE_TIMING_PAIRED_TIMING_H

#include "app/measure/timing/thread_use.h"
#include "app/measure/timing/timing.h"
#include "renderer/base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// A run's threads waited too long if they waited for more than this share of its time, summed over
// the threads.
#define DIP_PAIRED_MOST_WAIT 0.2

// Number of parts into which the caller may divide the time of a run.
enum { DIP_TIME_PARTS = 4 };

// A subject's time and its base's time for one frame.
typedef struct DipTimePair {
    double ms;                     // Of the subject; 0 if it was not timed.
    double base_ms;                // Of the base.
    double wait;                   // Waiting time of all threads in the subject's run / its time.
    double base_wait;              // The same of the base's run.
    double cpu_ms;                 // Processor time of the subject's run, summed over the threads.
    double switches;               // Involuntary context switches in the subject's run.
    double shares[DIP_TIME_PARTS]; // Shares of the parts in the subject's time; see part_ms.
} DipTimePair;

enum { DIP_TIME_PAIR_VALUES = sizeof(DipTimePair) / sizeof(double) };

static inline bool dip_time_pair_is_disturbed(const DipTimePair *pair) {
    return !(pair->ms > 0.0) || pair->wait > DIP_PAIRED_MOST_WAIT ||
           pair->base_wait > DIP_PAIRED_MOST_WAIT;
}

typedef struct DipPairedTimingDef {
    int subject_count;    // At least 1.
    const int *base_of;   // [subject]: the subject's base. Borrowed.
    int block_subjects;   // Subjects per block besides the base, at least 1.
    int rounds;           // At least 1.
    int frames_per_round; // At least 1.
    uint64_t seed;        // Equal seeds lead to equal orders.
    bool settle;          // True to run phase 2.
} DipPairedTimingDef;

// Functions of the caller, as in DipTimingCalls. In DipTimingTurn, frame is the index of the frame
// on the path, 0 to rounds * frames_per_round - 1, and version is 0.
typedef struct DipPairedTimingCalls {
    bool (*run)(void *context, const DipTimingTurn *turn, DipError *err);
    bool (*after_run)(void *context, const DipTimingTurn *turn, double ms, DipError *err);

    // Returns the pairs of a round if an earlier measurement has them, or NULL. Rounds `rounds` to
    // 2 rounds - 1 are the repetitions of rounds 0 to rounds - 1. The function pointer may be NULL.
    const DipTimePair *(*known_round)(void *context, int round);

    // Receives the pairs of a round, [subject * frames_per_round + f] for the round's f-th frame.
    // Pairs that were not timed are 0. The function pointer may be NULL.
    bool (*after_round)(void *context, int round, const DipTimePair *pairs, bool known,
                        DipError *err);

    // Writes the times of the parts of the latest run, in milliseconds, for example of its stages.
    // NULL means that no parts are known; their shares are then 0.
    void (*part_ms)(void *context, double ms[DIP_TIME_PARTS]);

    int64_t (*clock_ns)(void *context);        // NULL means the monotonic clock.
    DipThreadUse (*thread_use)(void *context); // NULL means a watch of this process' threads.
    void *context;
} DipPairedTimingCalls;

// What the measurement tells about the machine.
typedef struct DipPairedTimingResult {
    bool settled;  // The time was steady before the rounds; true if settling was not asked for.
    bool has_wait; // The machine tells how long threads wait. If not, no pair is disturbed, and
                   // wait is 1 - processor time / (time * threads).
    double wait;   // Waiting time of all timed runs / (their time * threads).
    int repeated;  // Number of pairs that were timed again.
} DipPairedTimingResult;

// Runs all phases. `pairs` has room for subject_count * rounds * frames_per_round pairs; the index
// is subject * (rounds * frames_per_round) + frame. `threads` is the number of threads that a run
// keeps busy. Returns false if a function of the caller returns false. Fails with DIP_ERROR_MEMORY.
bool dip_paired_timing_run(const DipPairedTimingDef *def, const DipPairedTimingCalls *calls,
                           int threads, DipTimePair *pairs, DipPairedTimingResult *result,
                           DipError *err);

// Returns the number of runs of phases 1 and 3 if `known_rounds` rounds are known.
int64_t dip_paired_timing_run_count(const DipPairedTimingDef *def, int known_rounds);

#ifdef __cplusplus
}
#endif

#endif
