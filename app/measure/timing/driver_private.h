// Declares what the files of the timing driver share. driver.c draws frames step by step,
// driver_plan.c plans starts and rounds, and driver_log.c keeps the frames of complete rounds.
#ifndef DIP_APP_MEASURE_TIMING_DRIVER_PRIVATE_H
#define DIP_APP_MEASURE_TIMING_DRIVER_PRIVATE_H

#include "app/measure/timing/driver.h"

enum { DIP_DRIVER_SETTLE_RUNS = 5 }; // Phase 2 takes the median of this many frame times.

// A frame to draw, in a plan.
typedef struct DipDriverDraw {
    DipDriverPhase phase;
    int subject;
    int block;
    int frame;
    bool begins_visit;
} DipDriverDraw;

// A block of a round: a few subjects and their base.
typedef struct DipDriverBlock {
    int base;
    int first;       // Index of its first subject in DipDriver.members.
    int count;       // Number of subjects besides the base.
    int number;      // No other block of the round or of its repetition has the same number.
    int nth_of_base; // Index of this block among the blocks of its base in the round.
    int of_base;     // Number of blocks of this base in the round.
} DipDriverBlock;

// What the next step does.
typedef enum DipDriverStage {
    DIP_DRIVER_STAGE_PLAN,
    DIP_DRIVER_STAGE_WARM_UP,
    DIP_DRIVER_STAGE_SETTLE,
    DIP_DRIVER_STAGE_DRAW,
    DIP_DRIVER_STAGE_DONE,
    DIP_DRIVER_STAGE_FAILED
} DipDriverStage;

struct DipDriver {
    DipDriverDef def; // `starts` and `rounds` change if starts take long (most_start).
    DipDriverCalls calls;
    DipThreadWatch *watch; // NULL if the caller has a function `thread_use`, or if the machine does
                           // not tell how long threads wait.
    int *base_of;          // Owned; the other arrays of int lie in the same memory.
    int *deal; // [copy * frames + frame]: the round that draws the frame (dip_rounds_deal); NULL if
               // every round draws all frames.
    DipDriverStage stage;
    int start; // The last start that has begun; -1 if there is none.
    // The round that is drawn next, counted over all starts. From dip_driver_round_count on, the
    // rounds are repetitions of the rounds from 0 on.
    int round;
    bool starts_are_fixed; // True once the number of starts cannot change any more.

    // The plan of the start or round that is being drawn.
    DipDriverDraw *plan;
    int plan_count, plan_room;
    bool plan_failed;       // True if memory ran out.
    int next;               // Index in `plan` of the frame that the next step draws.
    int *members;           // Subjects that the round draws besides the bases, grouped by base.
    DipDriverBlock *blocks; // Blocks of the round, in the order in which they are drawn.
    int *order;             // Scratch for shuffling.
    int *frames; // First the frames that all subjects draw, then those that only bases draw.
    // Number of the frames that all subjects draw, and number of all elements of `frames`.
    int frame_count, all_frame_count;
    int *is_needed; // [subject]: 1 if the round draws the subject. Not used for bases.
    int *score;     // [subject]: number of undisturbed frames minus three times the number of
                    // disturbed frames.

    DipTimed *fresh; // Frames of the incomplete round.
    int fresh_count;
    DipTimed *log;     // Frames of all complete rounds.
    double *base_wait; // [index in `log`]: `wait` of the base's frame in the same block.
    int log_count;
    int *log_begin; // [round]: index in `log` of the round's first frame.

    double settle_ms[DIP_DRIVER_SETTLE_RUNS];
    double settle_last_ms; // Median of the DIP_DRIVER_SETTLE_RUNS times before the current ones.
    int settle_runs;

    int64_t origin_ns, visit_ns, start_begin_ns, round_begin_ns, start_ns;
    bool has_begun;
    int64_t drawn;                  // As in DipDriverProgress.
    int64_t left;                   // Number of frames of rounds that are still to be drawn.
    double wait_ms, cpu_ms, run_ms; // Sums over all timed frames.
    bool has_wait, settled;
    int repeated;
    int in_vain; // Number of repetitions in a row, up to the last one, in which most frames were
                 // disturbed again.
};

static inline int dip_driver_round_count(const DipDriver *d) {
    return d->def.starts * d->def.rounds;
}

static inline bool dip_driver_is_base(const DipDriver *d, int subject) {
    return d->base_of[subject] == subject;
}

// Returns the round that the driver draws now. For a repetition, this is the round that is
// repeated.
static inline int dip_driver_first_round(const DipDriver *d) {
    return d->round % dip_driver_round_count(d);
}

// Returns the round of a frame, counted over all starts.
static inline int dip_driver_round_of(const DipDriver *d, const DipTimed *timed) {
    return timed->start * d->def.rounds + timed->round;
}

// Returns whether the round that the driver draws now repeats an earlier one.
static inline bool dip_driver_repeats(const DipDriver *d) {
    return d->round >= dip_driver_round_count(d);
}

static inline bool dip_driver_is_disturbed(const DipDriver *d, double wait, double base_wait) {
    return d->def.most_wait > 0.0 && (wait > d->def.most_wait || base_wait > d->def.most_wait);
}

// Plan the next start, or the next round: fill in d->plan. Return false if memory runs out.
bool dip_driver_plan_start(DipDriver *d);
bool dip_driver_plan_round(DipDriver *d);

// Adds the fresh frames to the log and goes to the next round. In a repetition, keeps only fresh
// frames whose threads waited less: they replace disturbed frames, and the base's frames beside
// them are added.
void dip_driver_end_round(DipDriver *d);

#endif
