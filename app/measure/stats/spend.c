// Convex hulls by gift wrapping (Jarvis 1973), and the walk along their edges.
#include "app/measure/stats/spend.h"

#include "renderer/base/assert.h"

// --- hulls ---------------------------------------------------------------------------------------

static int cheapest(const DipSpendOption *options, int count) {
    int best = 0;
    for (int i = 1; i < count; i++) {
        const bool is_cheaper = options[i].cost < options[best].cost;
        if (is_cheaper ||
            (options[i].cost == options[best].cost && options[i].loss < options[best].loss)) {
            best = i;
        }
    }
    return best;
}

// By how much the loss falls per unit of cost from a to b, which costs more.
static double slope_of(const DipSpendOption *a, const DipSpendOption *b) {
    return (a->loss - b->loss) / (b->cost - a->cost);
}

// Returns the point of the hull after point `at`: the one to which the loss falls most steeply, and
// of several on one line the farthest. Returns -1 after the last point.
static int next_on_hull(const DipSpendOption *options, int count, int at) {
    int next = -1;
    double steepest = 0.0;
    for (int i = 0; i < count; i++) {
        if (!(options[i].cost > options[at].cost) || !(options[i].loss < options[at].loss)) {
            continue;
        }
        const double slope = slope_of(&options[at], &options[i]);
        if (next < 0 || slope > steepest ||
            (slope == steepest && options[i].cost > options[next].cost)) {
            next = i;
            steepest = slope;
        }
    }
    return next;
}

int dip_spend_hull(const DipSpendOption *options, int count, int *hull) {
    DIP_ASSERT(count >= 1);
    int kept = 0;
    for (int at = cheapest(options, count); at >= 0; at = next_on_hull(options, count, at)) {
        hull[kept++] = at;
    }
    return kept;
}

// --- spending ------------------------------------------------------------------------------------

typedef struct Spending {
    const DipSpendOption *options;
    int parts;
    int count;
    double budget;
    int *chosen;
} Spending;

static const DipSpendOption *option_of(const Spending *s, int part, int index) {
    return &s->options[part * s->count + index];
}

// The cost of all parts if `part` took option `index`.
static double cost_with(const Spending *s, int part, int index) {
    double sum = 0.0;
    for (int p = 0; p < s->parts; p++) {
        sum += option_of(s, p, p == part ? index : s->chosen[p])->cost;
    }
    return sum;
}

static double total_loss(const Spending *s) {
    double sum = 0.0;
    for (int p = 0; p < s->parts; p++) {
        sum += option_of(s, p, s->chosen[p])->loss;
    }
    return sum;
}

// Goes along the steepest of all next edges. Returns false if there is none, or if it does not fit.
// Sets *slope to its slope, or to 0.
static bool go_along_edge(const Spending *s, double *slope) {
    int part = -1, index = -1;
    *slope = 0.0;
    for (int p = 0; p < s->parts; p++) {
        const DipSpendOption *options = option_of(s, p, 0);
        const int next = next_on_hull(options, s->count, s->chosen[p]);
        const double fall = next >= 0 ? slope_of(&options[s->chosen[p]], &options[next]) : 0.0;
        if (fall > *slope) {
            part = p;
            index = next;
            *slope = fall;
        }
    }
    if (part < 0 || cost_with(s, part, index) > s->budget) {
        return false;
    }
    s->chosen[part] = index;
    return true;
}

// Takes the single option that lowers the loss most within the budget. Returns false if there is
// none.
static bool take_best(const Spending *s) {
    int part = -1, index = -1;
    double most = 0.0;
    for (int p = 0; p < s->parts; p++) {
        for (int i = 0; i < s->count; i++) {
            const double fall = option_of(s, p, s->chosen[p])->loss - option_of(s, p, i)->loss;
            if (fall > most && cost_with(s, p, i) <= s->budget) {
                part = p;
                index = i;
                most = fall;
            }
        }
    }
    if (part >= 0) {
        s->chosen[part] = index;
    }
    return part >= 0;
}

DipSpendResult dip_spend(const DipSpendOption *options, int parts, int count, double budget,
                         int *chosen) {
    DIP_ASSERT(parts >= 1 && count >= 1);
    const Spending s = {options, parts, count, budget, chosen};
    DipSpendResult result = {.fits = false};
    for (int p = 0; p < parts; p++) {
        chosen[p] = cheapest(option_of(&s, p, 0), count);
    }
    result.fits = cost_with(&s, 0, chosen[0]) <= budget;
    while (go_along_edge(&s, &result.slope)) {
    }
    while (take_best(&s)) {
    }
    result.cost = cost_with(&s, 0, chosen[0]);
    result.loss = total_loss(&s);
    return result;
}
