// Lists the candidates of a report, which are combinations with a time and an error, and makes the
// report's choice among them.
#include "app/report/report.h"

#include <math.h>
#include <stdlib.h>

// Standard error of a time's logarithm between two runs on a quiet machine. It is combined with the
// error of a row's time, if that error is known.
static const double least_error = 0.002;

// Returns a row's time of this kind. Its error leaves out time->level_error, which all rows share.
// A time whose error is not known has no interval.
static DipEstimate time_of_kind(const DipPathEstimate *time, DipTimeKind kind, int rounds) {
    const DipEstimate whole = kind == DIP_TIME_P95    ? time->p95_ms
                              : kind == DIP_TIME_MEAN ? time->mean_ms
                                                      : time->worst_ms;
    const double error = kind == DIP_TIME_P95    ? time->p95_error
                         : kind == DIP_TIME_MEAN ? time->ratio_error
                                                 : time->worst_error;
    return isnan(whole.log_error)
               ? dip_estimate_unknown(whole.value)
               : dip_estimate_make(whole.value, hypot(error, least_error),
                                   whole.degrees >= 1.0 ? whole.degrees : rounds - 1);
}

DipCandidate dip_candidate_of_row(const DipCostReport *report, int row, DipTimeKind kind) {
    const DipPathEstimate *time = &report->rows[row].time;
    return (DipCandidate){
        .quality = report->rows[row].quality,
        .time = time_of_kind(time, kind, report->rounds),
        .common_error = time->level_error,
        .loss = dip_cost_ranking_flip(report, row),
        .flip = dip_cost_row_metrics(report, row).flip,
        .row = row,
    };
}

static bool begin(const DipCostReport *report, DipTimeKind kind, int room,
                  DipCandidates *candidates, DipError *err) {
    *candidates = (DipCandidates){.list = calloc((size_t)room + 1, sizeof *candidates->list),
                                  .kind = kind,
                                  .disturbed = report->verdict == DIP_COST_RED};
    return candidates->list || dip_cost_out_of_memory(err);
}

bool dip_candidates_of_predictions(const DipCostReport *report, DipTimeKind kind, bool measured,
                                   DipCandidates *candidates, DipError *err) {
    const DipCostPredictions *predicted = &report->predicted;
    if (!begin(report, kind, predicted->count, candidates, err)) {
        return false;
    }
    for (int i = 0; i < predicted->count; i++) {
        const DipCostPrediction *p = &predicted->list[i];
        DipCandidate *c = &candidates->list[candidates->count++];
        if (measured && p->row >= 0) {
            *c = dip_candidate_of_row(report, p->row, kind);
        } else {
            *c = (DipCandidate){
                .quality = p->quality,
                .time = dip_estimate_unknown(kind == DIP_TIME_MEAN ? p->ms : p->p95_ms),
                .loss = fmax(p->flip, dip_cost_floor_flip(report, 0)),
                .flip = p->flip,
            };
        }
        c->row = i;
    }
    return true;
}

void dip_candidates_free(DipCandidates *candidates) {
    free(candidates->list);
    *candidates = (DipCandidates){0};
}

static int compare_times(const void *a, const void *b) {
    const DipCandidate *x = a, *y = b;
    return (x->time.value > y->time.value) - (x->time.value < y->time.value);
}

bool dip_candidates_to_list(const DipCostReport *report, DipCandidates *all) {
    int front[DIP_COST_MAX_ROWS];
    bool is_best[DIP_COST_MAX_ROWS] = {false};
    if (!dip_candidates_of_predictions(report, report->options.budget_of, false, all, NULL)) {
        return false;
    }
    const int best = dip_front(all, DIP_CLEARLY_BETTER, front);
    for (int i = 0; i < best; i++) {
        is_best[front[i]] = true;
    }
    const int count = all->count;
    all->count = 0;
    for (int i = 0; i < count && all->count < DIP_CANDIDATES_LISTED; i++) {
        if (count <= DIP_CANDIDATES_LISTED || is_best[i] || report->predicted.list[i].row >= 0) {
            all->list[all->count++] = all->list[i];
        }
    }
    qsort(all->list, (size_t)all->count, sizeof *all->list, compare_times);
    return true;
}

// --- the choice of a report ----------------------------------------------------------------------

void dip_cost_choice_free(DipCostChoice *choice) {
    dip_candidates_free(&choice->candidates);
    free(choice->front);
    *choice = (DipCostChoice){.knee = -1};
}

bool dip_cost_choose(DipCostReport *report, DipError *err) {
    DipCostChoice *choice = &report->choice;
    DipCandidates *all = &choice->candidates;
    const DipTimeKind kind = report->options.budget_of;
    const int first = report->combined_first;
    dip_cost_choice_free(choice);
    if (report->rounds == 0) {
        return true;
    }
    if (!begin(report, kind, report->row_count - first, all, err)) {
        return false;
    }
    for (int r = first; r < report->row_count; r++) {
        // A search keeps rows with the same pictures; only the simplest of them can be chosen.
        if (dip_cost_is_judged(report, r) && dip_cost_simplest_row(report, r) == r) {
            all->list[all->count++] = dip_candidate_of_row(report, r, kind);
        }
    }
    choice->front = calloc((size_t)all->count + 1, sizeof *choice->front);
    if (!choice->front) {
        return dip_cost_out_of_memory(err);
    }
    choice->front_count = dip_front(all, DIP_CLEARLY_BETTER, choice->front);
    choice->knee = dip_front_knee(all, choice->front, choice->front_count);
    choice->advice_count = all->count > 0 ? report->options.budget_count : 0;
    for (int i = 0; i < choice->advice_count; i++) {
        choice->advice[i] = dip_advise(all, report->options.budgets_ms[i]);
    }
    return true;
}

const DipCandidate *dip_cost_chosen(const DipCostReport *report, int budget) {
    const DipCostChoice *choice = &report->choice;
    const int chosen = budget < choice->advice_count ? choice->advice[budget].chosen : -1;
    return chosen >= 0 ? &choice->candidates.list[chosen] : NULL;
}
