// Measures the combinations that are predicted to be best, in several goes. A go measures some of
// them, and then predicts the others anew from all that were measured so far.
#include "app/cost/steps.h"

#include <math.h>
#include <stdlib.h>

enum {
    MOST_GOES = 4,
    FEW_GOES = 2, // Greatest number of goes if a run has fewer than FEW_ROUNDS rounds, for a
                  // fast answer.
    FEW_ROUNDS = 8,
    MOST_PROMISING = 24, // Greatest number of combinations that one go measures.
    FRONT_PER_GO = 5     // Greatest number of these that are added for the Pareto front.
};

int dip_cost_most_goes(const DipCostOptions *options) {
    return options->rounds < FEW_ROUNDS ? FEW_GOES : MOST_GOES;
}

// --- limits --------------------------------------------------------------------------------------

// Bounds of the value of miss_of_times.
static const double least_miss = 0.02, most_miss = 0.25;

// If fewer best combinations than this have been measured, miss_of_times does not use their misses.
enum { ENOUGH_MISSES = 8 };

// Returns the relative miss that nine of ten predictions of times do not exceed, limited to the
// bounds above. It comes from the best combinations that have been measured or, if these are too
// few, from the combinations that were measured first.
static double miss_of_times(const DipCostReport *report) {
    const DipCostPredictions *predicted = &report->predicted;
    const DipCostMisses *misses =
        predicted->times.rows >= ENOUGH_MISSES ? &predicted->times : &predicted->times_left_out;
    return fmin(fmax(misses->p90, least_miss), most_miss);
}

double dip_cost_limit_ms(const DipCostReport *report, int budget, int limit) {
    const double factor = 1.0 + miss_of_times(report);
    return report->options.budgets_ms[budget] *
           (limit == DIP_COST_LIMIT_SURE ? 1.0 / factor : factor);
}

// --- what is worth measuring ---------------------------------------------------------------------

// The combinations that should be measured: indices of report->predicted.
typedef struct Promising {
    const DipCostPrediction *predictions;
    int *list;
    int count;
    int most;
} Promising;

// Adds a combination unless it is measured or listed already, or the list is full.
static void add_promising(Promising *promising, int index) {
    bool needed = promising->predictions[index].row < 0 && promising->count < promising->most;
    for (int i = 0; i < promising->count; i++) {
        needed = needed && promising->list[i] != index;
    }
    if (needed) {
        promising->list[promising->count++] = index;
    }
}

static int compare_losses(const void *a, const void *b) {
    const DipCandidate *x = a, *y = b;
    return (x->loss > y->loss) - (x->loss < y->loss);
}

// Returns whether a candidate keeps a limit of a budget (dip_cost_limit_ms). One that was measured
// keeps DIP_COST_LIMIT_SURE if it surely fits the budget, and DIP_COST_LIMIT_MAY unless it surely
// does not fit.
static bool keeps(const DipCostReport *report, const DipCandidate *candidate, int budget,
                  int limit) {
    const double fits = dip_candidate_fits(candidate, report->options.budgets_ms[budget]);
    return isnan(fits) ? candidate->time.value <= dip_cost_limit_ms(report, budget, limit)
           : limit == DIP_COST_LIMIT_SURE ? fits >= DIP_SURELY_FITS
                                          : fits > 1.0 - DIP_SURELY_FITS;
}

// Looks at the first DIP_COST_PER_LIMIT candidates that keep a limit, and adds those of them that
// are not measured yet. `all` has the candidates of least FLIP first. Candidates that are no better
// than the one that would be advised now need not be measured.
static void add_within(Promising *promising, const DipCostReport *report, const DipCandidates *all,
                       int budget, int limit) {
    const DipCandidate *chosen = dip_cost_chosen(report, budget);
    for (int i = 0, seen = 0; i < all->count && seen < DIP_COST_PER_LIMIT; i++) {
        const DipCandidate *c = &all->list[i];
        if (chosen && c->loss >= chosen->loss) {
            break;
        }
        if (keeps(report, c, budget, limit)) {
            add_promising(promising, c->row);
            seen++;
        }
    }
}

int dip_cost_list_promising(const DipCostReport *report, int most, int *list, DipError *err) {
    const DipCostOptions *options = &report->options;
    Promising promising = {.predictions = report->predicted.list, .list = list, .most = most};
    DipCandidates all;
    int front[DIP_COST_MAX_ROWS];
    if (!dip_candidates_of_predictions(report, options->budget_of, true, &all, err)) {
        return -1;
    }
    qsort(all.list, (size_t)all.count, sizeof *all.list, compare_losses);
    for (int b = 0; b < options->budget_count; b++) {
        for (int limit = 0; limit < DIP_COST_LIMITS; limit++) {
            add_within(&promising, report, &all, b, limit);
        }
    }
    const int count = dip_front(&all, DIP_CLEARLY_BETTER, front);
    const int room = promising.count + FRONT_PER_GO;
    promising.most = room < most ? room : most;
    for (int i = 0; i < count; i++) {
        add_promising(&promising, all.list[front[i]].row);
    }
    dip_candidates_free(&all);
    return promising.count;
}

// --- goes ----------------------------------------------------------------------------------------

bool dip_cost_add_rows(DipCostReport *report, const int *list, int count, int *rows,
                       DipError *err) {
    for (int i = 0; i < count; i++) {
        DipCostPrediction *p = &report->predicted.list[list[i]];
        p->row = p->row >= 0 ? p->row : dip_cost_report_add_row(report, &p->quality, 0, err);
        rows[i] = p->row;
        if (rows[i] < 0) {
            return false;
        }
    }
    return true;
}

// Predicts every listed combination that has no row, from those that have one. If not all
// combinations are listed, since they are too many, first searches all of them for the best, and
// lists these.
static bool predict(DipCostReport *report, DipPool *pool, DipError *err) {
    DipCostModels models;
    const bool done = dip_cost_models_of(report, &models, err) &&
                      (report->predicted.searched <= DIP_COST_MAX_ROWS ||
                       dip_cost_search(report, pool, &models, err)) &&
                      dip_cost_predict_others(report, &models, err);
    dip_cost_models_free(&models);
    return done;
}

// Compares the rows from first_row on, which were measured after they had been predicted, with
// their predictions.
static void judge_predictions(DipCostReport *report, int first_row) {
    DipCostPredictions *predicted = &report->predicted;
    double times[DIP_COST_MAX_ROWS], errors[DIP_COST_MAX_ROWS];
    int time_count = 0, error_count = 0;
    for (int i = 0; i < predicted->count; i++) {
        const DipCostPrediction *p = &predicted->list[i];
        if (p->row >= first_row) {
            const double flip = dip_cost_row_metrics(report, p->row, 0).flip;
            times[time_count++] = fabs(p->ms / dip_cost_ms(report, p->row) - 1.0);
            if (flip > 0.0) { // A row that equals the truth has no relative error.
                errors[error_count++] = fabs(p->flip / flip - 1.0);
            }
        }
    }
    predicted->times = dip_cost_misses_of(times, time_count);
    predicted->errors = dip_cost_misses_of(errors, error_count);
}

bool dip_cost_measure_best(DipCostReport *report, DipPool *pool, DipCostMeasure *measure,
                           void *context, DipError *err) {
    const int first_row = report->row_count;
    bool done = predict(report, pool, err);
    // With a red verdict, no settings will be advised, so none are looked for.
    const int goes = report->verdict == DIP_COST_RED ? 0 : dip_cost_most_goes(&report->options);
    for (int go = 0; done && go < goes; go++) {
        int list[MOST_PROMISING], rows[MOST_PROMISING];
        const int count = dip_cost_list_promising(report, MOST_PROMISING, list, err);
        if (count <= 0) {
            done = count == 0;
            break;
        }
        done =
            dip_cost_add_rows(report, list, count, rows, err) && measure(context, rows, count, err);
        if (done) {
            judge_predictions(report, first_row);
            done = predict(report, pool, err);
        }
    }
    return done;
}
