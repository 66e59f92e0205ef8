// A made-up machine for the timing driver: a clock that the frames advance, and threads that wait
// when the test says so.
#ifndef DIP_TESTS_APP_MEASURE_DRIVER_MACHINE_H
#define DIP_TESTS_APP_MEASURE_DRIVER_MACHINE_H

#include "app/measure/timing/driver.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum {
    SUBJECTS = 12,
    STARTS = 2,
    ROUNDS = 5, // Of each start.
    ALL_ROUNDS = STARTS * ROUNDS,
    PER_ROUND = 2,
    PATH = ALL_ROUNDS * PER_ROUND,
    COPIES = 3,
    WARM = 2,
    MOST_TURNS = 20000
};

// Subjects 0 to 8 have the base 0, subjects 9 to 11 the base 9.
extern const int bases[SUBJECTS];

typedef struct Machine {
    int64_t now_ns;
    DipThreadUse use;
    DipDriverTurn turns[MOST_TURNS];
    int turn_count;
    int starts[16]; // As they were begun.
    int start_count;
    DipTimed kept[MOST_TURNS]; // What the journal has.
    int kept_count;
    int kept_rounds;
    int busy_round;   // In this round of all starts, frames wait for half of their time; -1: none.
    int busy_subject; // Only this subject waits; -1: all do.
    bool busy_again;  // The first repetition waits longer.
    bool busy_always;
    bool busy_at_first; // All frames wait, until the rounds are repeated.
    double slow_down;   // Per frame: the machine becomes slower all the time.
    double start_ms;
    int settling;
    int fail_at;       // The turn that fails; -1 for none.
    bool is_elsewhere; // Another process draws, and tells its times.
    bool tells_no_wait;
    bool stands_still; // The clock does not advance.
    int prepared;      // Number of frames that were prepared.
} Machine;

extern Machine made;
extern DipDriver *driver;
extern DipDriverCalls calls; // of the made-up machine

// Before and after each test.
int machine_set_up(void **state);
int machine_tear_down(void **state);

double true_ms(int subject, int frame);

// Prepares a frame: takes long, and its threads wait. For calls.prepare.
bool machine_prepare(void *context, const DipDriverTurn *turn, DipError *err);

// Keeps the times of a round as a journal does. For calls.keep.
bool machine_keep(void *context, const DipTimed *timed, int count, DipError *err);

// The measurement of a path with all subjects.
DipDriverDef path_def(void);

// Creates the driver.
void begin(const DipDriverDef *def);

// Draws frames until the driver is done or fails.
DipDriverStep work(DipError *err);

// Creates the driver, and draws all its frames.
void work_until_done(const DipDriverDef *def);

// The round of a frame, counted over all starts.
int round_of(const DipTimed *timed);

// Fails the test unless two logs are the same in everything but the moments.
void check_same(const DipTimes *a, const DipTimed *list, int count);

#endif
