// Lists of candidates, and the choice that a report derives from its measurements.
#include "app/report/candidates.h"

#include <math.h>
#include <stdlib.h>

// The least standard error of a time's logarithm: two runs on a quiet machine differ by as much.
static const double least_error = 0.002;

static bool out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost", "out of memory");
}

// Returns a time without the error of the level that all rows share. What is not known stays so.
static DipEstimate time_of_kind(const DipPathEstimate *time, DipTimeKind kind, int rounds) {
    const DipEstimate times[DIP_TIME_KIND_COUNT] = {
        [DIP_TIME_P95] = time->p95_ms,
        [DIP_TIME_MEAN] = time->mean_ms,
        [DIP_TIME_WORST] = time->worst_ms,
    };
    const double errors[DIP_TIME_KIND_COUNT] = {
        [DIP_TIME_P95] = time->p95_error,
        [DIP_TIME_MEAN] = time->ratio_error,
        [DIP_TIME_WORST] = time->worst_error,
    };
    const DipEstimate *whole = &times[kind];
    if (isnan(whole->log_error)) {
        return dip_estimate_unknown(whole->value);
    }
    return dip_estimate_make(whole->value, hypot(errors[kind], least_error),
                             whole->degrees >= 1.0 ? whole->degrees : rounds - 1);
}

DipCandidate dip_candidate_of_row(const DipCostReport *report, int row, DipTimeKind kind) {
    const DipPathEstimate *time = &report->rows[row].time;
    return (DipCandidate){
        .quality = report->rows[row].quality,
        .time = time_of_kind(time, kind, report->rounds),
        .common_error = time->level_error,
        .loss = dip_cost_ranking_flip(report, row),
        .flip = dip_cost_row_metrics(report, row, 0).flip,
        .row = row,
    };
}

static bool begin(const DipCostReport *report, DipTimeKind kind, int room,
                  DipCandidates *candidates, DipError *err) {
    *candidates = (DipCandidates){.list = calloc((size_t)room + 1, sizeof *candidates->list),
                                  .kind = kind,
                                  .disturbed = report->verdict == DIP_COST_RED};
    return candidates->list || out_of_memory(err);
}

bool dip_candidates_of(const DipCostReport *report, DipTimeKind kind, DipCandidates *candidates,
                       DipError *err) {
    if (!begin(report, kind, report->row_count - report->combined_first, candidates, err)) {
        return false;
    }
    for (int r = report->combined_first; r < report->row_count; r++) {
        int viewpoints;
        dip_cost_row_sums(report, r, &viewpoints);
        if (viewpoints > 0 && dip_cost_is_timed(report, r)) {
            candidates->list[candidates->count++] = dip_candidate_of_row(report, r, kind);
        }
    }
    return true;
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

// --- the choice of a report ----------------------------------------------------------------------

void dip_cost_choice_free(DipCostChoice *choice) {
    dip_candidates_free(&choice->candidates);
    free(choice->front);
    *choice = (DipCostChoice){.knee = -1};
}

bool dip_cost_choose(DipCostReport *report, DipError *err) {
    DipCostChoice *choice = &report->choice;
    dip_cost_choice_free(choice);
    if (report->rounds == 0) {
        return true;
    }
    if (!dip_candidates_of(report, report->options.budget_of, &choice->candidates, err)) {
        return false;
    }
    choice->front = calloc((size_t)choice->candidates.count + 1, sizeof *choice->front);
    if (!choice->front) {
        return out_of_memory(err);
    }
    choice->front_count = dip_front(&choice->candidates, DIP_CLEARLY_BETTER, choice->front);
    choice->knee = dip_front_knee(&choice->candidates, choice->front, choice->front_count);
    choice->advice_count = choice->candidates.count > 0 ? report->options.budget_count : 0;
    for (int i = 0; i < choice->advice_count; i++) {
        choice->advice[i] = dip_advise(&choice->candidates, report->options.budgets_ms[i]);
    }
    return true;
}

const DipCandidate *dip_cost_chosen(const DipCostReport *report, int budget) {
    const DipCostChoice *choice = &report->choice;
    const int chosen = budget < choice->advice_count ? choice->advice[budget].chosen : -1;
    return chosen >= 0 ? &choice->candidates.list[chosen] : NULL;
}

static int compare_times(const void *a, const void *b) {
    const DipCandidate *x = a;
    const DipCandidate *y = b;
    return (x->time.value > y->time.value) - (x->time.value < y->time.value);
}

bool dip_candidates_to_list(const DipCostReport *report, DipCandidates *all) {
    const DipCostPrediction *list = report->predicted.list;
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
    for (int i = 0; i < count; i++) {
        if ((count <= DIP_CANDIDATES_LISTED || is_best[i] || list[i].row >= 0) &&
            all->count < DIP_CANDIDATES_LISTED) {
            all->list[all->count++] = all->list[i];
        }
    }
    qsort(all->list, (size_t)all->count, sizeof *all->list, compare_times);
    return true;
}
