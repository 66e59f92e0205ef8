// Advice for each time budget: the combination with the least error that is surely within the
// budget. Combinations that may be within it, and would then be better, are timed again until they
// are on one side.
#include "app/cost/steps.h"

#include "app/report/verdict.h"
#include "app/measure/stats/choice.h"
#include "app/cli/progress.h"

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

// Lists the rows whose interval holds the budget and whose FLIP is at least 1 % below that of the
// row chosen so far: those of least FLIP first, at most MOST_AGAIN. Returns their number.
static int list_undecided(const DipCostReport *report, double budget_ms, Candidate *candidates,
                          int rows[MOST_AGAIN]) {
    const int chosen = dip_cost_choose(report, budget_ms);
    int count = 0;
    for (int r = report->combined_first; r < report->row_count; r++) {
        int viewpoints;
        dip_cost_row_sums(report, r, &viewpoints);
        const double flip = dip_cost_ranking_flip(report, r);
        const DipEstimate time = dip_cost_budget_time(report, r);
        if (viewpoints > 0 && time.low <= budget_ms && time.high > budget_ms &&
            (chosen < 0 || flip < 0.99 * dip_cost_ranking_flip(report, chosen))) {
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

static double budget_error(const DipCostReport *report, const DipPathEstimate *time) {
    const double errors[] = {
        [DIP_COST_BUDGET_P95] = time->p95_error,
        [DIP_COST_BUDGET_MEAN] = time->ratio_error,
        [DIP_COST_BUDGET_WORST] = time->worst_error,
    };
    return errors[report->options.budget_of];
}

// Fills in how sure the advised row is. Fails with DIP_ERROR_MEMORY.
static bool add_odds(const DipCostReport *report, DipCostAdvice *advice, DipError *err) {
    const int first = report->combined_first;
    int rows[DIP_COST_MAX_ROWS];
    int count = 0, chosen = 0;
    DipChoice *choices = malloc(((size_t)report->row_count + 1) * sizeof *choices);
    if (!choices) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost", "out of memory");
    }
    for (int r = first; r < report->row_count; r++) {
        int viewpoints;
        dip_cost_row_sums(report, r, &viewpoints);
        if (viewpoints > 0) {
            chosen = r == advice->row ? count : chosen;
            rows[count] = r;
            choices[count++] = (DipChoice){
                .time = dip_cost_budget_time(report, r).value,
                .error = budget_error(report, &report->rows[r].time),
                .loss = dip_cost_ranking_flip(report, r),
            };
        }
    }
    DipChoiceOdds odds;
    const bool done = dip_choice_odds(choices, count, chosen, advice->budget_ms,
                                      report->rows[advice->row].time.level_error, 0.01, &odds, err);
    if (done) {
        advice->probability = odds.best;
        advice->runner_up = odds.runner_up >= 0 ? rows[odds.runner_up] : -1;
        advice->runner_up_probability = odds.runner_up_best;
    }
    free(choices);
    return done;
}

// Chooses a row for a budget and fills in the advice.
static bool choose(const DipCostReport *report, double budget_ms, DipCostAdvice *advice,
                   DipError *err) {
    const int row = dip_cost_choose(report, budget_ms);
    const DipEstimate time = row >= 0 ? dip_cost_budget_time(report, row) : (DipEstimate){0};
    *advice = (DipCostAdvice){
        .budget_ms = budget_ms,
        .row = row,
        .ms = time.value,
        .ms_low = time.low,
        .ms_high = time.high,
        .runner_up = -1,
    };
    return row < 0 || add_odds(report, advice, err);
}

bool dip_cost_choose_again(DipCostReport *report, DipError *err) {
    bool chosen = true;
    for (int i = 0; chosen && report->rounds > 0 && i < report->advice_count; i++) {
        chosen = choose(report, report->advice[i].budget_ms, &report->advice[i], err);
    }
    return chosen;
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
        DipCostAdvice *advice = &report->advice[report->advice_count++];
        advised = choose(report, report->options.budgets_ms[i], advice, err);
    }
    free(candidates);
    return advised;
}
