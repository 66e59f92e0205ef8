// Times frames. Every measurement that compares times of frames uses this driver. (`diptych dump`
// and the preview also say how long each drawn frame took.)
//
// A subject is anything that draws the frames of a path, for example the renderer with one set of
// quality settings. Each subject is compared with another subject, its base. A base is its own
// base, as is a subject that is not compared with any other. A measurement has these phases:
//   1. Start. A start is a new process, or just a new beginning in this one. Where memory lies and
//      which cores the threads get makes a whole start faster or slower, so a measurement may have
//      several starts, each with the same number of rounds. When a start begins, each subject draws
//      its first frames untimed.
//   2. Settling, once. Subject 0 draws frame 0 again and again. The driver takes the median of
//      every five frame times. The phase ends when two successive medians agree within 2 %, or
//      after 20 medians.
//   3. Rounds. A round draws some or all frames of the path with every subject. Frames are dealt to
//      rounds at random (app/measure/stats/rounds.h), or each round draws all of them. In each
//      round, the subjects of a base are divided at random into blocks. A block consists of a few
//      subjects and the base, in random order. A visit draws the round's frames of one subject, in
//      path order, and times each. If base_copies is above 1, the round also has frames that only
//      the base draws; the visits of the base divide them evenly and draw them last. A visit first
//      draws its first frame untimed, because the previous subject has used the caches. A block
//      visits each of its subjects once (but see in_turn).
//   4. Repetition. A frame is disturbed if its threads, or those that drew the same frame of the
//      base, waited too long for a core. The driver repeats rounds that have disturbed frames, each
//      at most once. A repetition draws a subject, next to its base, if a frame of the subject is
//      disturbed in the round and more than a quarter of the subject's frames are disturbed in the
//      whole measurement. The new time of a subject's disturbed frame replaces the old one if its
//      threads and those of the base's frame together waited less than before; the base keeps its
//      old time and gets the new one as well. The phase ends early when most frames of two rounds
//      in a row are disturbed again, since the machine is still busy.
//
// A driver draws one frame per step, so the preview can stop between any two frames. Commands step
// until the driver is done.
#ifndef DIP_APP_MEASURE_TIMING_DRIVER_H
#define DIP_APP_MEASURE_TIMING_DRIVER_H

#include "renderer/base/api.h"
#include "app/measure/stats/rounds.h"
#include "app/measure/timing/thread_use.h"
#include "renderer/base/error.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Describes a measurement.
typedef struct DipDriverDef {
    int subjects;
    const int *base_of; // [subject]: index of its base. Borrowed. If NULL, all subjects are bases.
    int block_subjects; // Greatest number of subjects in a block besides the base, at least 1.
    int starts;         // At least 1.
    int rounds;         // Rounds of each start, at least 1.
    int frames;         // Frames of the path.
    // 0 if every round draws all frames of all subjects. Otherwise frames are dealt to rounds: each
    // frame of a base is timed in this many rounds (at most starts * rounds), and each frame of
    // another subject is timed in one of these rounds. `frames` must then be at least starts *
    // rounds.
    int base_copies;
    int warm_frames; // Frames that each subject draws untimed when a start begins.
    uint64_t seed;   // Seed of all random orders.
    bool settle;     // True to run phase 2.
    // True if the subjects of a block take turns after every frame, in an order that is shuffled
    // for each frame. Most frames then follow a frame of another subject; the last subject of one
    // order may be the first of the next. A visit then has one frame, and no frame is drawn untimed
    // before it.
    bool in_turn;
    // Pause before each timed frame, so that threads of other processes fall asleep.
    int64_t rest_ns;
    // A frame is disturbed if its threads together waited for a core for more than this share of
    // the frame's time, or if this holds for the base's frame beside it. If most_wait is 0, no
    // frame counts as disturbed.
    double most_wait;
    // The driver makes only 2 starts instead of more, with the same total number of rounds, if this
    // number is even and beginning the first start (with its untimed frames) takes long: more than
    // this share of the time of the start's rounds, estimated from the first round. If most_start
    // is 0, the number of starts is always `starts`.
    double most_start;
} DipDriverDef;

typedef enum DipDriverPhase {
    DIP_DRIVER_WARM_UP, // A first frame of a start, untimed.
    DIP_DRIVER_SETTLE,  // A frame of phase 2.
    DIP_DRIVER_UNTIMED, // The untimed frame before a visit.
    DIP_DRIVER_TIMED    // A timed frame of a round.
} DipDriverPhase;

// A frame to draw.
typedef struct DipDriverTurn {
    DipDriverPhase phase;
    int subject;
    int start;
    int round; // Index of the round within its start; -1 in the phases WARM_UP and SETTLE.
    int frame;
} DipDriverTurn;

// Functions of the caller, which run in the caller's floating-point mode (renderer/base/fp_mode.h).
// Those that return false, with *err filled, end the measurement.
typedef struct DipDriverCalls {
    // Draws a frame. Writes timed->parts_ms if the times of the parts are known. If the function
    // knows the frame's time, for example from another process that draws the frame, it also writes
    // ms, wait, cpu_ms and switches; wait is NAN if it is not known. Otherwise it leaves ms NAN,
    // and the driver measures these four itself.
    bool (*draw)(void *context, const DipDriverTurn *turn, DipTimed *timed, DipError *err);

    // Does what must come before a frame and is not timed, such as drawing the frame before it. May
    // be NULL.
    bool (*prepare)(void *context, const DipDriverTurn *turn, DipError *err);

    // Begins a start, for example by starting a process. May be NULL.
    bool (*start)(void *context, int start, DipError *err);

    // Receives the timed frames of each complete round, for example to write them to a journal. May
    // be NULL.
    bool (*keep)(void *context, const DipTimed *timed, int count, DipError *err);

    int64_t (*clock_ns)(void *context);        // If NULL, the driver reads the monotonic clock.
    DipThreadUse (*thread_use)(void *context); // If NULL, the driver watches this process' threads.
    void *context;                             // Passed to the functions.
} DipDriverCalls;

// A driver is not thread-safe. Two drivers may work at the same time, but they disturb each other's
// times.
typedef struct DipDriver DipDriver;

typedef enum DipDriverStep {
    DIP_DRIVER_WORKING,
    DIP_DRIVER_ROUND, // A round is complete.
    DIP_DRIVER_DONE,
    DIP_DRIVER_FAILED
} DipDriverStep;

// Makes a driver. Unless calls->thread_use is set, the driver watches the threads of this process,
// and the threads that draw must exist before. Fails with DIP_ERROR_MEMORY.
DIP_API DipDriver *dip_driver_create(const DipDriverDef *def, const DipDriverCalls *calls,
                                     DipError *err);
DIP_API void dip_driver_destroy(DipDriver **driver);

// Continues an earlier measurement with the same definition. `known` holds the frames that the
// function `keep` received in the earlier measurement, in the same order. Call this before the
// first step. Returns false if memory runs out, or if some frames are not those of a complete round
// of this definition; the driver then draws this round and all later ones.
DIP_API bool dip_driver_resume(DipDriver *driver, const DipTimed *known, int count);

// Draws at most one frame. Fails with DIP_ERROR_MEMORY, or with the error of a function of the
// caller.
DIP_API DipDriverStep dip_driver_step(DipDriver *driver, DipError *err);

// Forgets the frames of the incomplete round. The next step begins this round anew.
DIP_API void dip_driver_drop_round(DipDriver *driver);

// Returns the frames of all complete rounds. Borrowed until the next step.
DIP_API DipTimes dip_driver_times(const DipDriver *driver);

// How much of a measurement is done. Frames of settling and of repetitions do not count, nor do
// frames that dip_driver_resume took.
typedef struct DipDriverProgress {
    int64_t drawn;  // Number of frames drawn so far.
    int64_t total;  // Number of frames drawn so far and still to be drawn.
    int rounds;     // Number of complete rounds of all starts.
    int searched;   // Number of rounds whose disturbed frames were drawn again, if there were any.
    int all_rounds; // Number of all rounds of all starts.
} DipDriverProgress;

DIP_API DipDriverProgress dip_driver_progress(const DipDriver *driver);

// What the measurement tells about the machine.
typedef struct DipDriverMachine {
    bool settled;  // True if the times settled in phase 2, or if there was no such phase.
    bool has_wait; // True if the machine tells how long threads wait for a core. If it is false, no
                   // frame counts as disturbed.
    double wait;   // Sum of the waiting times of all frames / (sum of their times * threads). If
                   // has_wait is false, 1 - processor time / (time * threads) stands in for it.
    int repeated;  // Number of frames that were drawn again.
} DipDriverMachine;

// `threads` is the number of threads that a frame keeps busy.
DIP_API DipDriverMachine dip_driver_machine(const DipDriver *driver, int threads);

#ifdef __cplusplus
}
#endif

#endif
