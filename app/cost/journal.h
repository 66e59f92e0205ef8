// Keeps the journal of an unfinished report: a file in the report's folder with the errors measured
// so far, and with the rounds that dip_cost_time_rows (steps.h) has timed so far. The next run
// continues from the journal. A measurement is either the errors of one burst or the times of one
// round (app/measure/timing/driver.h). A burst is the successive frames that are drawn at a
// viewpoint; its errors are measured against truths (converged pictures). Each line of the file is
// one measurement and its checksum. The program may be ended at any time, because the next run
// drops a line that was cut short.
#ifndef DIP_APP_COST_JOURNAL_H
#define DIP_APP_COST_JOURNAL_H

#include "app/measure/metrics/flip_tail.h"
#include "app/measure/metrics/metrics.h"
#include "app/measure/stats/rounds.h"
#include "renderer/base/error.h"

#include <stdbool.h>

// The errors of a burst. All members are doubles, since the journal stores them as an array.
typedef struct DipCostBurstErrors {
    DipMetricSums sums;
    DipFlipTail tail;
} DipCostBurstErrors;

// Not thread-safe.
typedef struct DipCostJournal DipCostJournal;

// Opens folder/cost.state, or creates it. `plan` is the hash of everything that times depend on
// (dip_cost_plan_hash). Rounds that were stored with another hash are ignored. Fails with CONFLICT
// while another journal of the folder is open, in this process or in another one (as far as the
// file system can lock files).
DipCostJournal *dip_cost_journal_open(const char *folder, const char *plan, DipError *err);

// Closes the journal. Removes its file if the report is finished.
void dip_cost_journal_close(DipCostJournal **journal, bool finished);

// dip_cost_journal_find looks up the errors of a burst and returns false if the journal did not
// have them when it was opened. dip_cost_journal_add stores them for the next run. The key is a
// hash of everything that the errors depend on: pictures, truths, pixels per degree and the
// program's build.
bool dip_cost_journal_find(const DipCostJournal *journal, const char *key,
                           DipCostBurstErrors *errors);
bool dip_cost_journal_add(DipCostJournal *journal, const char *key,
                          const DipCostBurstErrors *errors, DipError *err);

// Returns how many rounds the journal had when it was opened, counting only rounds that were stored
// with this journal's plan hash. Sets *seed to the seed of the first of these rounds, if there are
// any. `seed` may be NULL.
int dip_cost_journal_round_count(const DipCostJournal *journal, int *seed);

// Returns the frames of a round, in the order in which they were stored. `round` is
// 0..dip_cost_journal_round_count - 1. Sets *count to their number, or to 0 if the round was
// stored with another seed than `seed`, or if its line does not hold a seed and whole frames. The
// caller frees the frames. Returns NULL when memory runs out.
DipTimed *dip_cost_journal_round(const DipCostJournal *journal, int round, int seed, int *count);

// Stores a round with the journal's plan hash for the next run.
bool dip_cost_journal_add_round(DipCostJournal *journal, int seed, const DipTimed *timed, int count,
                                DipError *err);

#endif
