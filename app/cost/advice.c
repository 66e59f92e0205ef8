// Advice for each time budget: the combination with the least error that is surely within the
// budget. Combinations that may be within it, and would then be better, are timed again until they
// are on one side.
#include "app/cost/steps.h"

#include "app/cost/verdict.h"
#include "app/progress.h"

#include <stdlib.h>

enum { MOST_AGAIN = 8, MOST_RACES = 6 };

typedef struct Candidate {
    int row;
    double flip;
} Candidate;

static int compare_candidates(const void *a, const void *b) {
    const Candidate *x = a;
    const Candidate *y = b;
    return (x->flip > y->flip) - (x->flip < y->flip);
}

static double flip_of(const DipCostReport *report, int row) {
    return dip_cost_row_metrics(report, row, 0).flip;
}

// Lists the rows whose interval holds the budget and whose FLIP is at least 1 % below that of the
// row chosen so far: those of least FLIP first, at most MOST_AGAIN. Returns their number.
static int list_undecided(const DipCostReport *report, double budget_ms, Candidate *candidates,
                          int rows[MOST_AGAIN]) {
    const int chosen = dip_cost_choose(report, budget_ms);
    int count = 0;
    for (int r = report->combined_first; r < report->row_count; r++) {
        int viewpoints;
        const DipMetricSums sums = dip_cost_row_sums(report, r, &viewpoints);
        const double flip = dip_metrics_of(&sums, 0).flip;
        const DipStatsEstimate time = dip_cost_budget_time(report, r);
        if (viewpoints > 0 && time.low <= budget_ms && time.high > budget_ms &&
            (chosen < 0 || flip < 0.99 * flip_of(report, chosen))) {
            candidates[count++] = (Candidate){r, flip};
        }
    }
    qsort(candidates, (size_t)count, sizeof *candidates, compare_candidates);
    count = count < MOST_AGAIN ? count : MOST_AGAIN;
    for (int i = 0; i < count; i++) {
        rows[i] = candidates[i].row;
    }
    return count;
}

static bool race(DipCostContext *cost, double budget_ms, Candidate *candidates, DipError *err) {
    for (int i = 1; i <= MOST_RACES; i++) {
        int rows[MOST_AGAIN];
        const int count = list_undecided(cost->report, budget_ms, candidates, rows);
        if (count == 0) {
            break;
        }
        if (!dip_cost_time_again(cost, rows, count, i, err) ||
            !dip_cost_estimate_times(cost->report, err)) {
            return false;
        }
    }
    return true;
}

bool dip_cost_advise(DipCostContext *cost, DipError *err) {
    DipCostReport *report = cost->report;
    const int budgets = report->options.budget_count;
    Candidate *candidates = malloc(((size_t)report->row_count + 1) * sizeof *candidates);
    if (!candidates) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost", "out of memory");
    }
    bool advised = true;
    if (report->verdict != DIP_COST_RED) {
        DipProgress progress = dip_progress_begin("budgets", budgets);
        for (int i = 0; advised && i < budgets; i++) {
            advised = race(cost, report->options.budgets_ms[i], candidates, err);
            dip_progress_show(&progress, i + 1);
        }
        dip_progress_end(&progress, budgets);
    }
    for (int i = 0; advised && i < budgets && report->verdict != DIP_COST_RED; i++) {
        const double budget_ms = report->options.budgets_ms[i];
        const int row = dip_cost_choose(report, budget_ms);
        const DipStatsEstimate time =
            row >= 0 ? dip_cost_budget_time(report, row) : (DipStatsEstimate){0};
        report->advice[report->advice_count++] =
            (DipCostAdvice){budget_ms, row, time.value, time.low, time.high};
    }
    free(candidates);
    return advised;
}
