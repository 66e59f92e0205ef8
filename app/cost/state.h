// What an unfinished report has measured so far: a file in its folder that the next run goes on
// from. Every line stands for one finished measurement and carries its own check, so that the
// program may be ended at any time; a line that was cut short is dropped.
#ifndef DIP_APP_COST_STATE_H
#define DIP_APP_COST_STATE_H

#include "app/measure/metrics.h"
#include "renderer/base/error.h"

#include <stdbool.h>

typedef struct DipCostState DipCostState;

// plan: name of what times are of; those of other plans are passed over.
DipCostState *dip_cost_state_open(const char *folder, const char *plan, DipError *err);

// finished: the report is written, and nothing needs to be kept.
void dip_cost_state_close(DipCostState **state, bool finished);

// Errors by the content that they are of: pictures and truths.
bool dip_cost_state_find(const DipCostState *state, const char *key, DipMetricSums *sums);
bool dip_cost_state_add(DipCostState *state, const char *key, const DipMetricSums *sums,
                        DipError *err);

// Rounds of `count` times each, in the order they were taken. Of a number that is not there NULL.
const double *dip_cost_state_round(const DipCostState *state, int round, int count);
bool dip_cost_state_add_round(DipCostState *state, const double *ms, int count, DipError *err);

#endif
