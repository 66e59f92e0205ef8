// Running, timing and settling.
#include "app/measure/timing/runner.h"

#include "app/measure/stats/statistics.h"
#include "renderer/base/clock.h"

#include <math.h>

enum { SETTLE_RUNS = 5, SETTLE_TRIES = 20 };
static const double settle_tolerance = 0.02;

static int64_t now_ns(const DipTimingRunner *runner) {
    return runner->clock_ns ? runner->clock_ns(runner->context) : dip_clock_ns();
}

bool dip_timing_run_once(const DipTimingRunner *runner, const DipTimingTurn *turn, double *ms,
                         DipError *err) {
    const int64_t begin_ns = now_ns(runner);
    const bool done = runner->run(runner->context, turn, err);
    *ms = 1e-6 * (double)(now_ns(runner) - begin_ns);
    return done && (!runner->after_run || runner->after_run(runner->context, turn, *ms, err));
}

bool dip_timing_settle(const DipTimingRunner *runner, bool *settled, DipError *err) {
    const DipTimingTurn turn = {.phase = DIP_TIMING_SETTLE, .round = -1};
    double last = 0.0;
    *settled = false;
    for (int tries = 0; tries < SETTLE_TRIES && !*settled; tries++) {
        double ms[SETTLE_RUNS];
        for (int i = 0; i < SETTLE_RUNS; i++) {
            if (!dip_timing_run_once(runner, &turn, &ms[i], err)) {
                return false;
            }
        }
        const double median = dip_stats_median(ms, SETTLE_RUNS);
        *settled = tries > 0 && fabs(median - last) <= settle_tolerance * last;
        last = median;
    }
    return true;
}
