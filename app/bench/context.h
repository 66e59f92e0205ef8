// The bench context: the thread pools and scenes that the bench draws with, and a renderer for each
// combination of values (settings, threads, size, ...; plan.h).
#ifndef DIP_APP_BENCH_CONTEXT_H
#define DIP_APP_BENCH_CONTEXT_H

#include "app/bench/plan.h"

typedef struct DipBenchContext DipBenchContext;

// Borrows the plan and the session. Not thread-safe.
DipBenchContext *dip_bench_context_create(const DipBenchPlan *plan, const DipSession *session,
                                          DipError *err);
void dip_bench_context_destroy(DipBenchContext **bench);

// Draws a frame (0..frames - 1) of a combination. The frames divide the camera path evenly.
// *picture is valid until the combination draws again.
bool dip_bench_context_draw(DipBenchContext *bench, int combination, int frame, DipFrame *picture,
                            DipError *err);

#endif
