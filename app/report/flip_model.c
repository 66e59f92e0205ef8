// Fits the process of FLIP, and predicts by it.
#include "app/report/flip_model.h"

#include "app/report/fit.h"

#include <math.h>
#include <stdlib.h>

// The logarithm of FLIP has a mean that all combinations share, and differs from it nearly as the
// sum of what each setting does. Both follow from a covariance that falls slowly with the distance.
// `spread` is the standard deviation at which combinations really lie from their predictions over
// that which the process expects. `doubt` is how much the logarithm of the likelihood must grow for
// a setting's weight to be doubled or halved; for a weight of 1/4 or 4, it is 4 times as much, and
// so on. These were chosen on recorded pictures of tests/app/cost/test_best.c
// (docs/cost-methods.md).
static const double common = 1.0, alike = 0.96, own = 1e-5, spread = 2.5, doubt = 0.3;

enum {
    MOST_SWEEPS = 3,  // Greatest number of times that all weights are changed in turn.
    MOST_TAUGHT = 128 // If more combinations are known, all weights are 1, since learning them
                      // would take long.
};
static const double least_weight = 0.125; // The greatest is DIP_PROCESS_MOST_WEIGHT.

// FLIP below this is as good as none.
static const double least_flip = 1e-6;

static bool alloc(DipFlipModel *model, int count, int more) {
    *model = (DipFlipModel){
        .known = calloc((size_t)count + 1, sizeof *model->known),
        .shares = calloc((size_t)count + 1, sizeof *model->shares),
    };
    return dip_cost_process_begin(&model->process, common, alike, own, count + more) &&
           model->known && model->shares;
}

// Makes the combinations of model->known known to the process, and computes their shares from the
// logarithms of their FLIP.
static void solve(DipFlipModel *model, int count, const double *logs) {
    int distances[DIP_COST_MAX_ROWS];
    model->process.count = model->count = 0;
    for (int i = 0; i < count; i++) {
        dip_flip_model_distances(model, &model->known[i], distances);
        dip_cost_process_add(&model->process, distances);
        model->count++;
    }
    dip_cost_process_solve(&model->process, logs, model->shares);
}

// --- learning the weights ------------------------------------------------------------------------

// Returns how likely the weights are.
static double judge(DipFlipModel *model, int count, const double *logs) {
    solve(model, count, logs);
    double likelihood = dip_cost_process_likelihood(&model->process, logs, model->shares);
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        likelihood -= doubt * log2(model->weights[s]) * log2(model->weights[s]);
    }
    return likelihood;
}

// Multiplies the weight of a setting by the factor as long as the weights become more likely.
// Updates *best, which is how likely they are. Returns whether the weight has changed.
static bool change_weight(DipFlipModel *model, int count, const double *logs, int setting,
                          double factor, double *best) {
    double *weight = &model->weights[setting];
    bool changed = false, better = true;
    while (better && *weight * factor >= least_weight &&
           *weight * factor <= DIP_PROCESS_MOST_WEIGHT) {
        const double before = *weight;
        *weight *= factor;
        const double likelihood = judge(model, count, logs);
        better = likelihood > *best;
        *best = better ? likelihood : *best;
        *weight = better ? *weight : before;
        changed = changed || better;
    }
    return changed;
}

static bool varies(const DipFlipModel *model, int count, int setting) {
    bool found = false;
    for (int i = 1; i < count; i++) {
        found = found || model->known[i].step[setting] != model->known[0].step[setting];
    }
    return found;
}

// Finds weights that make the known FLIP likely: automatic relevance determination (Rasmussen and
// Williams 2006, section 5.1), by changing one weight after another.
static void learn_weights(DipFlipModel *model, int count, const double *logs) {
    double best = judge(model, count, logs);
    bool changed = true;
    for (int sweep = 0; sweep < MOST_SWEEPS && changed; sweep++) {
        changed = false;
        for (int s = 0; s < DIP_SETTING_COUNT; s++) {
            if (varies(model, count, s)) {
                const bool up = change_weight(model, count, logs, s, 2.0, &best);
                const bool down = change_weight(model, count, logs, s, 0.5, &best);
                changed = changed || up || down;
            }
        }
    }
}

// --- the model -----------------------------------------------------------------------------------

bool dip_flip_model_fit(const DipCostReport *report, const int *rows, int count, int more,
                        DipFlipModel *model) {
    double logs[DIP_COST_MAX_ROWS];
    if (!alloc(model, count, more)) {
        return false;
    }
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        model->weights[s] = 1.0;
    }
    for (int i = 0; i < count; i++) {
        model->known[i] = report->rows[rows[i]].quality;
        logs[i] = log(fmax(dip_cost_row_metrics(report, rows[i]).flip, least_flip));
        model->log_mean += logs[i] / count;
    }
    for (int i = 0; i < count; i++) {
        logs[i] -= model->log_mean;
    }
    if (count <= MOST_TAUGHT) {
        learn_weights(model, count, logs);
    }
    solve(model, count, logs);
    for (int i = 0; i < count; i++) {
        model->variance += spread * spread * logs[i] * model->shares[i] / count;
    }
    return true;
}

void dip_flip_model_free(DipFlipModel *model) {
    dip_cost_process_free(&model->process);
    free(model->known);
    free(model->shares);
    *model = (DipFlipModel){0};
}

void dip_flip_model_distances(const DipFlipModel *model, const DipQuality *quality,
                              int *distances) {
    for (int i = 0; i < model->count; i++) {
        distances[i] = dip_cost_distance(&model->known[i], quality, ~0u, model->weights);
    }
}

double dip_flip_model_value(const DipFlipModel *model, const int *distances) {
    double value = model->log_mean;
    for (int i = 0; i < model->count; i++) {
        value += model->process.covariance[distances[i]] * model->shares[i];
    }
    return exp(value);
}

double dip_flip_model_error(const DipFlipModel *model, const int *distances) {
    return sqrt(model->variance * dip_cost_process_variance(&model->process, distances));
}

double dip_flip_model_error_bound(const DipFlipModel *model, const int *distances) {
    const double *covariance = model->process.covariance;
    double most = 0.0;
    for (int i = 0; i < model->count; i++) {
        most = fmax(most, covariance[distances[i]]);
    }
    return sqrt(model->variance *
                (covariance[0] - most * most / (covariance[0] + model->process.own)));
}

DipCostMisses dip_flip_model_left_out(const DipFlipModel *model) {
    double misses[DIP_COST_MAX_ROWS];
    dip_cost_process_left_out(&model->process, model->shares, misses);
    for (int i = 0; i < model->count; i++) {
        misses[i] = fabs(exp(-misses[i]) - 1.0);
    }
    return dip_cost_misses_of(misses, model->count);
}

// --- what to measure -----------------------------------------------------------------------------

// Returns the variance of a prediction's FLIP if the first process->count chosen ones are known,
// and writes its distances to these. All weights are 1, since none are learned yet.
static double variance_at(const DipCostPredictions *predicted, const DipCostProcess *process,
                          const int *chosen, int index, int *distances) {
    for (int k = 0; k < process->count; k++) {
        distances[k] = dip_cost_distance(&predicted->list[chosen[k]].quality,
                                         &predicted->list[index].quality, ~0u, NULL);
    }
    return dip_cost_process_variance(process, distances);
}

bool dip_flip_model_design(const DipCostPredictions *predicted, int given, int count, int *chosen) {
    int distances[DIP_COST_MAX_ROWS];
    DipCostProcess process;
    double *variances = malloc(((size_t)predicted->count + 1) * sizeof *variances);
    const bool made = dip_cost_process_begin(&process, common, alike, own, count) && variances;
    for (int i = 0; made && i < predicted->count; i++) {
        variances[i] = INFINITY;
    }
    for (int k = 0; made && k < count; k++) {
        int best = k < given ? chosen[k] : -1;
        // A variance only falls when more is known, so only great ones are computed anew.
        for (int i = 0; k >= given && i < predicted->count; i++) {
            if (best < 0 || variances[i] > variances[best]) {
                variances[i] = variance_at(predicted, &process, chosen, i, distances);
                best = best < 0 || variances[i] > variances[best] ? i : best;
            }
        }
        variance_at(predicted, &process, chosen, best, distances);
        chosen[k] = best;
        dip_cost_process_add(&process, distances);
        variances[best] = -1.0;
    }
    free(variances);
    dip_cost_process_free(&process);
    return made;
}
