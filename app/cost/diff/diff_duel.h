// The measurement beneath `cost diff`: pairs of subjects that take turns at every frame, in several
// starts of the programs.
//
// A pair has two sides. Each side is a combination of settings that one of the programs draws. The
// last pair is the A/A pair: the same settings twice in the same program, which shows how quiet the
// machine is.
#ifndef DIP_APP_COST_DIFF_DIFF_DUEL_H
#define DIP_APP_COST_DIFF_DIFF_DUEL_H

#include "app/bench/result.h"
#include "app/report/report.h"
#include "app/report/verdict.h"
#include "app/measure/stats/paired_starts.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { DIP_COST_DUEL_MAX_PAIRS = 32 };

// What to measure. Everything is borrowed.
typedef struct DipCostDuelDef {
    const char *programs[2];
    int program_count;        // 1 or 2.
    const DipBenchPlan *plan; // Its command line, number of combinations and frames.
    int pair_count;           // With the A/A pair, which is the last one.
    int program_of[DIP_COST_DUEL_MAX_PAIRS][2];
    int combination_of[DIP_COST_DUEL_MAX_PAIRS][2];
    int starts;
    int rounds;
    uint64_t seed;
    int threads; // Threads that draw; 0: those that the programs' ini asks for.
} DipCostDuelDef;

// What was measured. Arrays are owned.
typedef struct DipCostDuel {
    const DipCostDuelDef *def;
    double *ms;            // [side][pair][stage][start][round][frame].
    bool *disturbed;       // [pair][start][round][frame]: a side's threads waited too long.
    DipBenchSample *first; // [side][pair][frame]: counters and hash of the first start.
    double wait;           // Waiting time of the threads / (time * threads).
    bool has_wait;
    int threads; // Threads of a program.
} DipCostDuel;

// Fails as dip_child_start does, with DIP_ERROR_RUNTIME if the user presses Ctrl-C, or with
// DIP_ERROR_MEMORY. On success the caller frees the duel.
bool dip_cost_duel_run(const DipCostDuelDef *def, DipCostDuel *duel, DipError *err);
void dip_cost_duel_free(DipCostDuel *duel);

// Returns the times of a side's stage: starts * rounds * frames values.
const double *dip_cost_duel_ms(const DipCostDuel *duel, int side, int pair, DipBenchStage stage);

// Estimates how many times as long side 1 of a pair takes. For a stage, the change is 1 + (the
// difference of the stage's times) / (side 0's time of the frame). Disturbed pairs of times take no
// part unless more than half are disturbed.
bool dip_cost_duel_change(const DipCostDuel *duel, int pair, DipBenchStage stage,
                          DipEstimate *change, DipError *err);

// Writes the difference of each start in a stage, in milliseconds, and estimates their mean.
bool dip_cost_duel_difference(const DipCostDuel *duel, int pair, DipBenchStage stage,
                              double *per_start, DipStartDifference *difference, DipError *err);

// Returns the mean time of a side's frame: the mean over the frames of their medians. Returns NAN
// when memory runs out.
double dip_cost_duel_mean_ms(const DipCostDuel *duel, int side, int pair);

// Collects the signs of the verdict from the waiting times and the A/A pair.
bool dip_cost_duel_signs(const DipCostDuel *duel, DipCostSigns *signs, DipError *err);

#ifdef __cplusplus
}
#endif

#endif
