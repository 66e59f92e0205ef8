// Checks the advice for each time budget (app/report/choice.h). A combination is timed again if it
// is unclear whether it fits the budget. If a combination is advised already, only combinations
// that are clearly better are timed again. Such combinations are timed again until each of them
// clearly fits or clearly does not, but at most MOST_RACES times.
#include "app/cost/steps.h"

#include "app/cli/progress.h"

#include <math.h>
#include <stdlib.h>

enum {
    MOST_AGAIN = 4, // Greatest number of rows that are timed again together.
    MOST_RACES = 6  // Greatest number of times that rows are timed again for a budget.
};

// True if it is unclear whether the candidate fits the budget: if the probability that it fits lies
// between 1 - DIP_SURELY_FITS and DIP_SURELY_FITS.
static bool is_undecided(const DipCandidate *candidate, double budget_ms) {
    const double fits = dip_candidate_fits(candidate, budget_ms);
    return fits > 1.0 - DIP_SURELY_FITS && fits < DIP_SURELY_FITS;
}

// Lists the undecided rows (is_undecided) whose loss (choice.h) is at least 1 % below the loss of
// the row advised so far; if no row is advised, all undecided rows. Lists at most MOST_AGAIN rows,
// the row with the least loss first. Returns their number.
static int list_undecided(const DipCostReport *report, int budget, int rows[MOST_AGAIN]) {
    const DipCandidates *candidates = &report->choice.candidates;
    const DipCandidate *chosen = dip_cost_chosen(report, budget);
    const DipCandidate *found[MOST_AGAIN + 1];
    int count = 0;
    for (int i = 0; i < candidates->count; i++) {
        const DipCandidate *c = &candidates->list[i];
        if (c->row == report->base_rows[0] || // It is timed beside all others anyway.
            !is_undecided(c, report->options.budgets_ms[budget]) ||
            (chosen && c->loss > (1.0 - DIP_CLEARLY_BETTER) * chosen->loss)) {
            continue;
        }
        int at = count;
        for (; at > 0 && found[at - 1]->loss > c->loss; at--) {
            found[at] = found[at - 1];
        }
        found[at] = c;
        count += count < MOST_AGAIN;
    }
    for (int i = 0; i < count; i++) {
        rows[i] = found[i]->row;
    }
    return count;
}

// Times the undecided rows of a budget again until there are none, but at most MOST_RACES times.
static bool race(DipCostContext *cost, int budget, DipError *err) {
    for (int i = 1; i <= MOST_RACES; i++) {
        int rows[MOST_AGAIN];
        const int count = list_undecided(cost->report, budget, rows);
        if (count == 0) {
            break;
        }
        if (!dip_cost_time_more(cost, rows, count, i, err) ||
            !dip_cost_estimate_times(cost->report, err)) {
            return false;
        }
    }
    return true;
}

bool dip_cost_advise(DipCostContext *cost, DipError *err) {
    const DipCostReport *report = cost->report;
    const int budgets = report->options.budget_count;
    bool advised = true;
    if (report->verdict != DIP_COST_RED) {
        DipProgress progress = dip_progress_begin("budgets", budgets);
        for (int i = 0; advised && i < budgets; i++) {
            advised = race(cost, i, err);
            dip_progress_show(&progress, i + 1);
        }
        dip_progress_end(&progress, budgets);
    }
    return advised;
}
