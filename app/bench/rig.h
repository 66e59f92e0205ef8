// What the bench draws with: pools, scenes, and a renderer for each combination.
#ifndef DIP_APP_BENCH_RIG_H
#define DIP_APP_BENCH_RIG_H

#include "app/bench/plan.h"

typedef struct DipBenchRig DipBenchRig;

// Borrows the plan and the session.
DipBenchRig *dip_bench_rig_create(const DipBenchPlan *plan, const DipSession *session,
                                  DipError *err);
void dip_bench_rig_destroy(DipBenchRig **rig);

// Draws one of the frames that divide the camera path evenly.
bool dip_bench_rig_draw(DipBenchRig *rig, int combination, int frame, DipFrame *picture,
                        DipError *err);

// Of what a combination draws.
uint64_t dip_bench_rig_triangles(const DipBenchRig *rig, int combination);

#endif
