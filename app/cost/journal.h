// The journal of an unfinished report: a file in the report's folder with every measurement made so
// far, from which the next run continues. Each line holds one measurement and a check of its own,
// so the program may be ended at any time; a line that was cut short is dropped.
#ifndef DIP_APP_COST_JOURNAL_H
#define DIP_APP_COST_JOURNAL_H

#include "app/measure/metrics.h"
#include "renderer/base/error.h"

#include <stdbool.h>

// Not thread-safe.
typedef struct DipCostJournal DipCostJournal;

// Opens folder/cost.state, or creates it. `plan` is the name of what times belong to
// (dip_cost_plan_hash); rounds of other plans are ignored.
DipCostJournal *dip_cost_journal_open(const char *folder, const char *plan, DipError *err);

// Closes the journal. If the report is finished, the file is removed.
void dip_cost_journal_close(DipCostJournal **journal, bool finished);

// Finds or adds errors by their key, a hash of the pictures and truths that they were measured on.
bool dip_cost_journal_find(const DipCostJournal *journal, const char *key, DipMetricSums *sums);
bool dip_cost_journal_add(DipCostJournal *journal, const char *key, const DipMetricSums *sums,
                          DipError *err);

// The plan's round with this number, counted in the order in which rounds were added, if it has
// `count` times; else NULL. The times are borrowed until the journal is closed.
const double *dip_cost_journal_round(const DipCostJournal *journal, int round, int count);
bool dip_cost_journal_add_round(DipCostJournal *journal, const double *ms, int count,
                                DipError *err);

#endif
