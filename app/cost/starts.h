// Starts of a measurement: `diptych cost` starts itself with --serve, and asks that process for the
// frames to time. A start has luck of its own: where its memory lies, and which cores its threads
// get.
#ifndef DIP_APP_COST_STARTS_H
#define DIP_APP_COST_STARTS_H

#include "app/cost/context.h"
#include "app/measure/timing/child.h"

// Starts this program anew, with the command line of the context. Fails as dip_child_start does.
DipChild *dip_cost_start(const DipCostContext *cost, DipError *err);

// Asks a start for the timed frame `index` of a path. Writes its counters and its times.
bool dip_cost_start_draw(DipChild *child, const DipQuality *quality, int path, int index,
                         DipCounters *counters, DipTimed *timed, DipError *err);

// Runs in a start: answers requests on standard input until it is closed.
bool dip_cost_serve(DipCostContext *cost, DipError *err);

#endif
