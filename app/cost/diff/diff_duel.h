// Times pairs of subjects for `cost diff`. A subject is a set of settings that one program draws.
// The two subjects of a pair, called sides, take turns at every frame. The programs are started
// several times, because each start is by chance a little faster or slower than another.
//
// The programs run as `PROGRAM bench ... --serve` (app/measure/timing/child.h). With two programs,
// pair p is set p in both. With one, it is set 0 beside set p + 1. The last pair is the A/A pair:
// set 0 and the last set, which has the same settings, in program 0.
#ifndef DIP_APP_COST_DIFF_DIFF_DUEL_H
#define DIP_APP_COST_DIFF_DIFF_DUEL_H

#include "app/cost/diff/diff_options.h"
#include "app/measure/timing/driver.h"
#include "app/measure/timing/sample.h"
#include "app/report/report.h"
#include "app/report/verdict.h"

#include <stdbool.h>

// Zero-initialise it, and fill in the programs.
typedef struct DipCostDuel {
    const char *programs[2]; // The second one is NULL if there is only one. Borrowed.
    char sets[(DIP_COST_DIFF_MAX_SETS + 2) * DIP_COST_TEXT];
    int set_count;
    int pair_count;
    int starts;
    int rounds;
    int frames;
    int threads;       // Number of threads of a program that draw.
    DipDriver *driver; // Has the times of subject 2 * pair + side. Side 0 is the base. Owned.
    DipTimesFit *fit;  // Owned.
    // [subject * frames + frame]: the first drawing, which has counters and a hash. Owned.
    DipBenchSample *first;
} DipCostDuel;

// Adds a set of settings.
void dip_cost_duel_add_set(DipCostDuel *duel, const char *text);

// Times all pairs in `frames` frames and `rounds` rounds of each start. Fails as dip_child_start
// does, with DIP_ERROR_RUNTIME if the user presses Ctrl-C, or with DIP_ERROR_MEMORY.
bool dip_cost_duel_run(DipCostDuel *duel, const DipCostDiffArguments *arguments, int frames,
                       int rounds, DipError *err);

// Frees what the duel owns.
void dip_cost_duel_free(DipCostDuel *duel);

// Adds up the counters of a subject's frames and divides them by the number of frames. The counters
// have the order of DIP_COUNTER_LIST and must be 0.
void dip_cost_duel_count(const DipCostDuel *duel, int subject, double *counters);

// Writes how much longer side 1 of each pair takes in a stage, in milliseconds, in each start by
// itself: per_start[pair * starts + start]. Fails with DIP_ERROR_MEMORY.
bool dip_cost_duel_per_start(const DipCostDuel *duel, DipBenchStage stage, double *per_start,
                             DipError *err);

// Judges the machine by the waiting times and the A/A pair.
DipCostVerdict dip_cost_duel_verdict(const DipCostDuel *duel, char reason[DIP_COST_REASON]);

#endif
