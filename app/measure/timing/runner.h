// What both forms of timing share: a run with its time, and the runs until times are steady.
#ifndef DIP_APP_MEASURE_TIMING_RUNNER_H
#define DIP_APP_MEASURE_TIMING_RUNNER_H

#include "app/measure/timing/timing.h"

// The caller's functions; see DipTimingCalls. after_run and clock_ns may be NULL.
typedef struct DipTimingRunner {
    bool (*run)(void *context, const DipTimingTurn *turn, DipError *err);
    bool (*after_run)(void *context, const DipTimingTurn *turn, double ms, DipError *err);
    int64_t (*clock_ns)(void *context);
    void *context;
} DipTimingRunner;

// Runs a frame, takes the time and calls after_run.
bool dip_timing_run_once(const DipTimingRunner *runner, const DipTimingTurn *turn, double *ms,
                         DipError *err);

// Runs subject 0's frame 0 until two successive medians of five runs agree within 2 %, for at most
// 20 medians. Sets *settled to whether they did.
bool dip_timing_settle(const DipTimingRunner *runner, bool *settled, DipError *err);

#endif
