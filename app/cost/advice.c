// The least error within a time, and a second look at the clock.
#include "app/cost/rig.h"

#include "app/progress.h"
#include "renderer/base/clock.h"

#include <stdlib.h>

// Times a row anew, as rounds of its own.
static bool time_again(DipCostRig *rig, int row, DipCostTime *time, DipError *err) {
    DipCostReport *report = rig->report;
    const int frames = report->options.timed_frames;
    DipCostReport again = *report; // shares all but this row's times
    DipCostRow *rows = malloc(((size_t)row + 1) * sizeof *rows);
    double *ms = malloc((size_t)report->options.rounds * (size_t)frames * sizeof *ms);
    bool timed =
        (rows && ms) || dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost", "out of memory");
    again.rounds = report->options.rounds;
    for (int i = -frames; timed && i < again.rounds * frames; i++) {
        const int index = (i + frames) % frames;
        DipFrame frame;
        const int64_t begin_ns = dip_clock_ns();
        timed =
            dip_cost_draw_timed(rig, row, index, &frame, err) && !dip_cost_interrupted(rig, err);
        if (i >= 0) { // the first frames warm up
            ms[i] = 1e-6 * (double)(dip_clock_ns() - begin_ns);
        }
    }
    if (timed) {
        rows[row] = report->rows[row];
        rows[row].ms = ms;
        again.rows = rows;
        *time = dip_cost_time(&again, row);
    }
    free(rows);
    free(ms);
    return timed;
}

static bool advise(DipCostRig *rig, double budget_ms, double *latest_ms, DipError *err) {
    DipCostReport *report = rig->report;
    DipCostAdvice advice = {.budget_ms = budget_ms, .row = -1};
    // What turns out slower than it seemed is no longer within the budget.
    for (int row; (row = dip_cost_choose(report, latest_ms, budget_ms)) >= 0;) {
        DipCostTime time;
        if (!time_again(rig, row, &time, err)) {
            return false;
        }
        latest_ms[row] = time.ms;
        if (time.ms <= budget_ms) {
            advice = (DipCostAdvice){budget_ms, row, time.ms, time.low, time.high};
            break;
        }
    }
    report->advice[report->advice_count++] = advice;
    return true;
}

bool dip_cost_advise(DipCostRig *rig, DipError *err) {
    DipCostReport *report = rig->report;
    const int budgets = report->options.budget_count;
    double *latest_ms = malloc((size_t)report->row_count * sizeof *latest_ms);
    if (!latest_ms) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost", "out of memory");
    }
    for (int r = 0; r < report->row_count; r++) {
        latest_ms[r] = dip_cost_ms(report, r);
    }
    DipProgress progress = dip_progress_begin("budgets", budgets);
    bool advised = true;
    for (int i = 0; advised && i < budgets; i++) {
        advised = advise(rig, report->options.budgets_ms[i], latest_ms, err);
        dip_progress_show(&progress, i + 1);
    }
    dip_progress_end(&progress, report->advice_count);
    free(latest_ms);
    return advised;
}
