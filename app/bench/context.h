// What the bench draws with: pools, scenes, and a renderer for each combination.
#ifndef DIP_APP_BENCH_RIG_H
#define DIP_APP_BENCH_RIG_H

#include "app/bench/plan.h"

typedef struct DipBenchContext DipBenchContext;

// Borrows the plan and the session.
DipBenchContext *dip_bench_context_create(const DipBenchPlan *plan, const DipSession *session,
                                          DipError *err);
void dip_bench_context_destroy(DipBenchContext **bench);

// Draws one of the frames that divide the camera path evenly.
bool dip_bench_context_draw(DipBenchContext *bench, int combination, int frame, DipFrame *picture,
                            DipError *err);

// Of what a combination draws.
uint64_t dip_bench_context_triangles(const DipBenchContext *bench, int combination);

#endif
