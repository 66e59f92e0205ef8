// Advice for each time budget: the combination with the least error whose time is within the
// budget. Its time is measured again, and the new time must be within the budget, too.
#include "app/cost/steps.h"

#include "app/progress.h"

#include <stdlib.h>

static bool advise(DipCostContext *cost, double budget_ms, double *latest_ms, DipError *err) {
    DipCostReport *report = cost->report;
    DipCostAdvice advice = {.budget_ms = budget_ms, .row = -1};
    // The row is timed again, and the new time replaces the old one. If the new time exceeds the
    // budget, the next best row is tried.
    for (int row; (row = dip_cost_choose(report, latest_ms, budget_ms)) >= 0;) {
        DipStatsEstimate time;
        if (!dip_cost_time_row_again(cost, row, &time, err)) {
            return false;
        }
        latest_ms[row] = time.value;
        if (time.value <= budget_ms) {
            advice = (DipCostAdvice){budget_ms, row, time.value, time.low, time.high};
            break;
        }
    }
    report->advice[report->advice_count++] = advice;
    return true;
}

bool dip_cost_advise(DipCostContext *cost, DipError *err) {
    DipCostReport *report = cost->report;
    const int budgets = report->options.budget_count;
    double *latest_ms = malloc((size_t)report->row_count * sizeof *latest_ms);
    if (!latest_ms) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost", "out of memory");
    }
    (void)dip_stats_ran_out();
    for (int r = 0; r < report->row_count; r++) {
        latest_ms[r] = dip_cost_ms(report, r);
    }
    bool advised = !dip_stats_ran_out() ||
                   dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost", "out of memory");
    DipProgress progress = dip_progress_begin("budgets", budgets);
    for (int i = 0; advised && i < budgets; i++) {
        advised = advise(cost, report->options.budgets_ms[i], latest_ms, err);
        dip_progress_show(&progress, i + 1);
    }
    dip_progress_end(&progress, report->advice_count);
    free(latest_ms);
    return advised;
}
