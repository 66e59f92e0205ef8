// Computes the gain of a combination: the share by which the FLIP of the settings advised for a
// budget is expected to fall if the combination is measured. Chooses the combinations to measure:
// those with the greatest gains and, if the caller asks for them, a few on the Pareto front.
#include "app/cost/steps.h"

#include <math.h>
#include <stdlib.h>

enum {
    PER_GO = 8, // Greatest number of combinations that are listed for each budget.
    FRONT = 5   // Greatest number of combinations that are added for the Pareto front.
};

// 90 % of the values of a normal distribution lie within this many standard deviations of its mean.
static const double deviations = 1.645;

// The 90th percentile of the misses of times (DipCostMisses.p90) is bounded to this range before
// the standard deviation of times is computed from it.
static const double least_miss = 0.02, most_miss = 0.25;

// The misses of rows that were measured after their prediction (predicted.times) are used if there
// are at least this many such rows. Otherwise, the misses of the rows of the training
// (predicted.times_left_out) are used.
enum { ENOUGH_MISSES = 8 };

DipCostAim dip_cost_aim(const DipCostReport *report, int budget) {
    const DipCostPredictions *predicted = &report->predicted;
    const DipCostMisses *misses =
        predicted->times.rows >= ENOUGH_MISSES ? &predicted->times : &predicted->times_left_out;
    const DipCandidate *chosen = dip_cost_chosen(report, budget);
    DipCostAim aim = {
        .budget_ms = report->options.budgets_ms[budget],
        .loss = chosen ? chosen->loss : 0.0,
        .floor = dip_cost_floor_flip(report, 0),
        .time_error = log(1.0 + fmin(fmax(misses->p90, least_miss), most_miss)) / deviations,
    };
    for (int i = 0; !chosen && i < predicted->count; i++) {
        const int row = predicted->list[i].row;
        aim.loss = row >= 0 ? fmax(aim.loss, dip_cost_ranking_flip(report, row)) : aim.loss;
    }
    return aim;
}

// Returns the probability that a standard normal variable is below x.
static double normal(double x) {
    return 0.5 * erfc(-x / sqrt(2.0));
}

// Returns the expected value of max(0, loss - FLIP) / loss. The logarithm of FLIP is normally
// distributed, with the mean log(flip) and the standard deviation `error`.
static double expected_below(double loss, double flip, double error) {
    const double z = log(loss / flip) / error;
    return normal(z) - flip / loss * exp(0.5 * error * error) * normal(z - error);
}

double dip_cost_gain(const DipCostAim *aim, double ms, double flip, double error) {
    if (!(aim->loss > aim->floor)) {
        return 0.0;
    }
    const double fits = normal(log(aim->budget_ms / ms) / aim->time_error);
    // FLIP below the floor cannot be told from the noise of the truth, so the part of the gain that
    // lies below the floor does not count.
    const double below =
        aim->floor > 0.0 ? aim->floor / aim->loss * expected_below(aim->floor, flip, error) : 0.0;
    return fits * (expected_below(aim->loss, flip, error) - below);
}

// --- choosing ------------------------------------------------------------------------------------

// The combinations that should be measured: indices of report->predicted.
typedef struct Promising {
    const DipCostReport *report;
    DipCostModels *models;
    int *list;
    int count;
    double *gains;  // [prediction]: its gain for the current budget as it was last computed;
                    // INFINITY before. find_most takes it as an upper bound of the gain.
    int *distances; // [measured or listed combination]: distances of the combination for which
                    // find_distances was called last.
} Promising;

static bool is_listed(const Promising *promising, int index) {
    bool listed = promising->report->predicted.list[index].row >= 0;
    for (int i = 0; i < promising->count; i++) {
        listed = listed || promising->list[i] == index;
    }
    return listed;
}

// Writes the distances of a combination to those that are measured or listed.
static void find_distances(const Promising *promising, int index) {
    const DipCostPrediction *predictions = promising->report->predicted.list;
    const int measured = promising->models->flip.count;
    dip_flip_model_distances(&promising->models->flip, &predictions[index].quality,
                             promising->distances);
    for (int i = 0; i < promising->count; i++) {
        promising->distances[measured + i] =
            dip_cost_distance(&predictions[promising->list[i]].quality, &predictions[index].quality,
                              ~0u, promising->models->flip.weights);
    }
}

static double gain_of(const Promising *promising, const DipCostAim *aim, int index) {
    const DipCostPrediction *p = &promising->report->predicted.list[index];
    const bool is_mean = promising->report->options.budget_of == DIP_TIME_MEAN;
    find_distances(promising, index);
    const double error = dip_flip_model_error(&promising->models->flip, promising->distances);
    return dip_cost_gain(aim, is_mean ? p->ms : p->p95_ms, p->flip, error);
}

// Lists a combination, and makes it known to models->flip.process.
static void add(Promising *promising, int index) {
    find_distances(promising, index);
    dip_cost_process_add(&promising->models->flip.process, promising->distances);
    promising->list[promising->count++] = index;
}

// Returns the combination that gains most, or -1 if none gains enough. A gain changes only when
// another combination is listed, and then it mostly falls. So the stored gain serves as an upper
// bound, and is computed anew only if it is at least the greatest gain found so far. A gain may
// also rise a little, if the predicted FLIP is far below the advised one; this is neglected.
static int find_most(Promising *promising, const DipCostAim *aim) {
    double most = DIP_COST_LEAST_GAIN;
    int found = -1;
    for (int i = 0; i < promising->report->predicted.count; i++) {
        if (promising->gains[i] >= most && !is_listed(promising, i)) {
            promising->gains[i] = gain_of(promising, aim, i);
            if (promising->gains[i] >= most) {
                most = promising->gains[i];
                found = i;
            }
        }
    }
    return found;
}

static void add_for_budget(Promising *promising, int budget) {
    const DipCostAim aim = dip_cost_aim(promising->report, budget);
    for (int i = 0; i < promising->report->predicted.count; i++) {
        promising->gains[i] = INFINITY;
    }
    for (int i = 0; i < PER_GO && promising->count < DIP_COST_MOST_PROMISING; i++) {
        const int index = find_most(promising, &aim);
        if (index < 0) {
            return;
        }
        add(promising, index);
    }
}

static bool add_front(Promising *promising, DipError *err) {
    const DipCostReport *report = promising->report;
    DipCandidates all;
    int front[DIP_COST_MAX_ROWS];
    if (!dip_candidates_of_predictions(report, report->options.budget_of, true, &all, err)) {
        return false;
    }
    const int count = dip_front(&all, DIP_CLEARLY_BETTER, front);
    for (int i = 0, added = 0; i < count && added < FRONT; i++) {
        const int index = all.list[front[i]].row;
        if (promising->count < DIP_COST_MOST_PROMISING && !is_listed(promising, index)) {
            add(promising, index);
            added++;
        }
    }
    dip_candidates_free(&all);
    return true;
}

int dip_cost_list_promising(const DipCostReport *report, DipCostModels *models, bool front,
                            int list[DIP_COST_MOST_PROMISING], DipError *err) {
    const size_t known = (size_t)models->flip.count + DIP_COST_MOST_PROMISING;
    Promising promising = {
        .report = report,
        .models = models,
        .list = list,
        .gains = malloc(((size_t)report->predicted.count + 1) * sizeof *promising.gains),
        .distances = malloc(known * sizeof *promising.distances),
    };
    bool listed = (promising.gains && promising.distances) || dip_cost_out_of_memory(err);
    for (int b = 0; listed && b < report->options.budget_count; b++) {
        add_for_budget(&promising, b);
    }
    if (listed && front) {
        listed = add_front(&promising, err);
    }
    free(promising.gains);
    free(promising.distances);
    return listed ? promising.count : -1;
}
