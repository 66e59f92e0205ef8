// Computes the Pareto front of candidates, its knee, and the advice for a budget.
#include "app/report/choice.h"

#include <math.h>

const char *const dip_time_kind_names[DIP_TIME_KIND_COUNT] = {
    [DIP_TIME_P95] = "p95",
    [DIP_TIME_MEAN] = "mean",
    [DIP_TIME_WORST] = "worst",
};

// --- the front -----------------------------------------------------------------------------------

static bool is_faster(const DipCandidate *a, const DipCandidate *b) {
    return a->time.value < b->time.value ||
           (a->time.value == b->time.value && a->loss < b->loss); // NOLINT: the loss breaks ties.
}

int dip_next_better(const DipCandidates *candidates, double loss, double step) {
    int next = -1;
    for (int i = 0; i < candidates->count; i++) {
        const DipCandidate *c = &candidates->list[i];
        if (c->loss < loss && c->loss <= (1.0 - step) * loss &&
            (next < 0 || is_faster(c, &candidates->list[next]))) {
            next = i;
        }
    }
    return next;
}

int dip_front(const DipCandidates *candidates, double step, int *list) {
    int count = 0;
    int at = dip_next_better(candidates, INFINITY, 0.0);
    while (at >= 0) {
        list[count++] = at;
        at = dip_next_better(candidates, candidates->list[at].loss, step);
    }
    return count;
}

int dip_front_knee(const DipCandidates *candidates, const int *front, int count) {
    if (count < 3) {
        return -1;
    }
    const DipCandidate *first = &candidates->list[front[0]];
    const DipCandidate *last = &candidates->list[front[count - 1]];
    const double slope = log(last->loss / first->loss) / log(last->time.value / first->time.value);
    int knee = -1;
    double farthest = 0.0;
    for (int i = 1; i < count - 1; i++) {
        const DipCandidate *c = &candidates->list[front[i]];
        const double below =
            slope * log(c->time.value / first->time.value) - log(c->loss / first->loss);
        if (below > farthest) {
            farthest = below;
            knee = i;
        }
    }
    return knee;
}

// --- advice --------------------------------------------------------------------------------------

double dip_candidate_fits(const DipCandidate *candidate, double budget_ms) {
    return dip_estimate_chance_below(&candidate->time, budget_ms, candidate->common_error);
}

static bool overlap(const DipEstimate *a, const DipEstimate *b) {
    return a->low <= b->high && b->low <= a->high; // False for an end that is not known (NAN).
}

// The alike candidates of a budget: those that surely fit it and whose loss is at most `most_loss`.
typedef struct Alike {
    const DipCandidates *all;
    double budget_ms;
    double most_loss;
} Alike;

// Returns whether a candidate is alike. The cheap comparison of the times comes first: a candidate
// that takes longer than the budget fits it with a probability below a half.
static bool contains(const Alike *alike, int index) {
    const DipCandidate *c = &alike->all->list[index];
    return c->loss <= alike->most_loss && c->time.value <= alike->budget_ms &&
           dip_candidate_fits(c, alike->budget_ms) >= DIP_SURELY_FITS;
}

// Sets most_loss to 1 % above the least loss of the candidates that surely fit. Returns the fastest
// of the alike candidates, or -1 if there is none.
static int find_alike(Alike *alike) {
    int fastest = -1;
    for (int i = 0; i < alike->all->count; i++) {
        if (contains(alike, i)) {
            alike->most_loss = alike->all->list[i].loss;
        }
    }
    alike->most_loss *= 1.0 + DIP_CLEARLY_BETTER;
    for (int i = 0; i < alike->all->count; i++) {
        if (contains(alike, i) &&
            (fastest < 0 || is_faster(&alike->all->list[i], &alike->all->list[fastest]))) {
            fastest = i;
        }
    }
    return fastest;
}

// Returns the alike candidate with the fewest settings off their defaults, among those whose time
// cannot be told from that of the fastest: the intervals of their times overlap.
static int choose(const Alike *alike, int fastest) {
    const DipCandidate *list = alike->all->list;
    int best = fastest;
    for (int i = 0; i < alike->all->count; i++) {
        const int fewer = dip_quality_count_changes(&list[best].quality) -
                          dip_quality_count_changes(&list[i].quality);
        if ((fewer > 0 || (fewer == 0 && is_faster(&list[i], &list[best]))) &&
            overlap(&list[i].time, &list[fastest].time) && contains(alike, i)) {
            best = i;
        }
    }
    return best;
}

// Counts the alike candidates that were not chosen, and lists the first DIP_ADVICE_TIES of them,
// the fastest first.
static void list_ties(const Alike *alike, DipAdvice *advice) {
    const DipCandidate *list = alike->all->list;
    for (int i = 0; i < alike->all->count; i++) {
        if (i == advice->chosen || !contains(alike, i)) {
            continue;
        }
        int at = advice->tie_count++;
        for (; at > 0 && (at > DIP_ADVICE_TIES || is_faster(&list[i], &list[advice->ties[at - 1]]));
             at--) {
            if (at < DIP_ADVICE_TIES) {
                advice->ties[at] = advice->ties[at - 1];
            }
        }
        if (at < DIP_ADVICE_TIES) {
            advice->ties[at] = i;
        }
    }
}

DipAdvice dip_advise(const DipCandidates *candidates, double budget_ms) {
    DipAdvice advice = {
        .budget_ms = budget_ms, .chosen = -1, .fits = NAN, .next = -1, .next_fits = NAN};
    Alike alike = {candidates, budget_ms, INFINITY};
    const DipCandidate *list = candidates->list;
    if (candidates->disturbed) {
        return advice;
    }
    const int fastest = find_alike(&alike);
    if (fastest >= 0) {
        advice.chosen = choose(&alike, fastest);
        advice.fits = dip_candidate_fits(&list[advice.chosen], budget_ms);
        advice.next = dip_next_better(candidates, list[advice.chosen].loss, DIP_CLEARLY_BETTER);
        list_ties(&alike, &advice);
    } else {
        advice.next = dip_next_better(candidates, INFINITY, 0.0);
    }
    if (advice.next >= 0) {
        const double from_ms = fastest >= 0 ? list[advice.chosen].time.value : budget_ms;
        advice.next_ms = list[advice.next].time.value - from_ms;
        advice.next_fits = dip_candidate_fits(&list[advice.next], budget_ms);
    }
    return advice;
}
