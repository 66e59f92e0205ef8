// Another program of this kind as a source: `PROGRAM bench ... --serve` at the end of two pipes.
//
// The conversation, in lines: the child greets with "diptych-bench 1 COMBINATIONS FRAMES". It is
// asked "draw COMBINATION FRAME HASH" (0 or 1) and answers "total_ms=1.5 geometry_ms=.. hash=.."
// or, when it failed, says why on standard error and ends. Names that one side does not know are
// passed over, so that builds with other stages can be compared.
#ifndef DIP_APP_BENCH_CHILD_H
#define DIP_APP_BENCH_CHILD_H

#include "app/bench/measure.h"

typedef struct DipBenchChild DipBenchChild;

// Starts a program with the plan's command line and --serve. Fails when it does not start, does
// not greet, or has other combinations or frames.
DipBenchChild *dip_bench_child_start(const char *program, const DipBenchPlan *plan, DipError *err);

// Closes its standard input and waits until it has ended.
void dip_bench_child_stop(DipBenchChild **child);

// Asks the child; the context is a DipBenchChild.
bool dip_bench_child_draw(void *context, int combination, int frame, bool hash,
                          DipBenchSample *sample, DipError *err);

// The other end: answers standard input until it is closed.
bool dip_bench_serve(const DipBenchPlan *plan, const DipBenchSource *source, DipError *err);

#endif
