// The only loop that times frames: many subjects, each timed next to its base, a frame per step.
//
// A subject is anything that draws the frames of a path, for example the renderer with one set of
// quality settings. Each subject has a base, another subject with which it is compared; a base is
// its own base. Subjects without anything to compare with are all bases. A measurement runs these
// phases:
//   1. Start. Where memory lies and which cores the threads get makes a whole start faster or
//      slower, so a measurement may have several starts, each with as many rounds. The caller may
//      start a new process for each. When a start begins, each subject draws its first frames
//      untimed.
//   2. Settling, once. Subject 0 draws frame 0 until two successive medians of five times agree
//      within 2 %, but for at most 20 medians.
//   3. Rounds. Frames are dealt to rounds at random (app/measure/stats/rounds.h), or each round
//      draws them all. A round puts the subjects of a base into blocks: a few subjects and the
//      base, in an order that is shuffled from the seed. The blocks of all bases are shuffled, too.
//      A block visits each of its subjects once. A visit draws the round's frames of one subject in
//      order and times each; before them it draws the first one untimed, because the previous
//      subject has used the caches.
//   4. Repetition. A frame is disturbed if its threads, or those of its base, waited too long for a
//      core. As long as a subject has fewer than three quarters of its frames undisturbed, the
//      blocks of its disturbed rounds are drawn again, each round at most once. A frame's new times
//      are kept if they waited less.
//
// A driver draws one frame per step, so the preview can stop between any two. Commands step until
// the driver is done.
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

typedef struct DipDriverDef {
    int subjects;
    const int *base_of; // [subject]; borrowed. NULL: every subject is a base.
    int block_subjects; // Subjects of a block besides the base, at least 1.
    int starts;         // At least 1.
    int rounds;         // Rounds of each start, at least 1.
    int frames;         // Frames of the path.
    // In how many rounds each frame of a base is timed, at most all. Each frame of another subject
    // is timed in one of these rounds, and `frames` is at least starts * rounds. 0: every round
    // draws all frames of all subjects.
    int base_copies;
    int warm_frames; // Frames that each subject draws untimed when a start begins.
    uint64_t seed;   // Equal seeds lead to equal orders.
    bool settle;     // True to run phase 2.
    // The visits of a block take turns at every frame, in an order that is shuffled for each frame.
    // Every frame then follows another subject's, so none finds warm caches, and none is untimed.
    bool in_turn;
    int64_t rest_ns; // Rest before each timed frame, in which another process' threads fall asleep.
    // A frame is disturbed if its threads waited for more than this share of its time, summed over
    // the threads. 0: no frame is disturbed.
    double most_wait;
    // If a start takes more than this share of its rounds' time, as the first start and round show,
    // there are only 2 starts, with as many rounds in all. 0: there are always `starts`.
    double most_start;
} DipDriverDef;

typedef enum DipDriverPhase {
    DIP_DRIVER_WARM_UP, // The start has begun.
    DIP_DRIVER_SETTLE,  // Phase 2.
    DIP_DRIVER_UNTIMED, // The first frame of a visit.
    DIP_DRIVER_TIMED
} DipDriverPhase;

// A frame to draw.
typedef struct DipDriverTurn {
    DipDriverPhase phase;
    int subject;
    int start;
    int round; // Index of the round within its start; -1 before the rounds.
    int frame;
} DipDriverTurn;

// Functions of the caller. Those that return false, with *err filled, end the measurement.
typedef struct DipDriverCalls {
    // Draws a frame. Writes timed->parts_ms if parts of the time are known. A frame that is drawn
    // in another process also has ms, wait, cpu_ms and switches written; wait is NAN if the machine
    // does not tell. ms stays NAN for frames of this process, whose times the driver takes itself.
    bool (*draw)(void *context, const DipDriverTurn *turn, DipTimed *timed, DipError *err);

    // Begins a start, for example a new process. NULL: all starts are this process.
    bool (*start)(void *context, int start, DipError *err);

    // Receives the frames of a complete round, for a journal. NULL: nobody wants them.
    bool (*keep)(void *context, const DipTimed *timed, int count, DipError *err);

    int64_t (*clock_ns)(void *context);        // NULL: the monotonic clock.
    DipThreadUse (*thread_use)(void *context); // NULL: a watch of this process' threads.
    void *context;
} DipDriverCalls;

// Not thread-safe. Two drivers may work at the same time, but they disturb each other's times.
typedef struct DipDriver DipDriver;

typedef enum DipDriverStep {
    DIP_DRIVER_WORKING,
    DIP_DRIVER_ROUND, // A round is complete.
    DIP_DRIVER_DONE,
    DIP_DRIVER_FAILED
} DipDriverStep;

// Makes a driver. Call it after the threads that draw exist: it watches how long they wait. Fails
// with DIP_ERROR_MEMORY.
DIP_API DipDriver *dip_driver_create(const DipDriverDef *def, const DipDriverCalls *calls,
                                     DipError *err);
DIP_API void dip_driver_destroy(DipDriver **driver);

// Takes the frames that `keep` received from a driver with the same definition, in the same order,
// before the first step. Returns false from the first round on that is not a round of this
// definition, which is drawn like all later ones, or if memory runs out.
DIP_API bool dip_driver_resume(DipDriver *driver, const DipTimed *known, int count);

// Draws at most one frame. Fails with DIP_ERROR_MEMORY and as the caller's functions do.
DIP_API DipDriverStep dip_driver_step(DipDriver *driver, DipError *err);

// Forgets the frames of the incomplete round, which is drawn anew from its beginning.
DIP_API void dip_driver_drop_round(DipDriver *driver);

// Returns the frames of all complete rounds. Borrowed until the next step.
DIP_API DipTimes dip_driver_times(const DipDriver *driver);

typedef struct DipDriverProgress {
    int64_t drawn; // Frames of starts and rounds so far, without those that were resumed.
    int64_t total; // The same and all that are to come, but without settling and repetitions.
    int rounds;    // Complete rounds of all starts, without repetitions.
    int searched;  // Rounds that were searched for disturbed frames to draw again.
    int all_rounds;
} DipDriverProgress;

DIP_API DipDriverProgress dip_driver_progress(const DipDriver *driver);

// What the measurement tells about the machine.
typedef struct DipDriverMachine {
    bool settled;  // The time was steady before the rounds; true if settling was not asked for.
    bool has_wait; // The machine tells how long threads wait. If not, no frame is disturbed, and
                   // wait is 1 - processor time / (time * threads).
    double wait;   // Waiting time of all timed frames / (their time * threads).
    int repeated;  // Number of frames that were drawn again.
} DipDriverMachine;

// `threads` is the number of threads that a frame keeps busy.
DIP_API DipDriverMachine dip_driver_machine(const DipDriver *driver, int threads);

#ifdef __cplusplus
}
#endif

#endif
