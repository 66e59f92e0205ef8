// Measuring another build of this program. The build runs as a child process, `PROGRAM bench ...
// --serve`, and is controlled through two pipes.
//
// The protocol consists of lines of text. The child first sends the greeting "diptych-bench 1
// COMBINATIONS FRAMES". For each request "draw COMBINATION FRAME HASH" (HASH is 0 or 1) it answers
// "total_ms=1.5 geometry_ms=... hash=...", or writes an error to standard error and ends. Unknown
// names are ignored, so that builds with different stages can be compared.
#ifndef DIP_APP_BENCH_CHILD_H
#define DIP_APP_BENCH_CHILD_H

#include "app/bench/measure.h"

typedef struct DipBenchChild DipBenchChild;

// Starts a program with the plan's command line and --serve. Fails if the program cannot be started
// or does not send the greeting. Also fails if the greeting's number of combinations or frames
// differs from the plan's.
DipBenchChild *dip_bench_child_start(const char *program, const DipBenchPlan *plan, DipError *err);

// Returns the child's process.
long dip_bench_child_pid(const DipBenchChild *child);

// Closes the child's standard input and waits until it has ended.
void dip_bench_child_stop(DipBenchChild **child);

// The `draw` of a DipBenchSource whose context is a DipBenchChild.
bool dip_bench_child_draw(void *context, int combination, int frame, bool hash,
                          DipBenchSample *sample, DipError *err);

// Runs in the child: answers requests on standard input until standard input is closed.
bool dip_bench_serve(const DipBenchPlan *plan, const DipBenchSource *source, DipError *err);

#endif
