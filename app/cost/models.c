// Predicts combinations from those that were measured. Their times are those of a model of work
// (fit.h), corrected by what it misses at combinations that are alike. Their FLIP comes from that
// of all measured combinations alone, the more alike the more (process.h).
#include "app/cost/steps.h"

#include <math.h>
#include <stdlib.h>

// What a model of work misses is alike at combinations that are alike: its covariance is this
// number to the power of their distance, plus the variance of what each misses of its own.
static const double alike_time = 0.6, own_time = 0.3;

// The logarithm of FLIP has a mean that all combinations share, and differs from it nearly as the
// sum of what each setting does. Both follow from a covariance that falls slowly with the distance.
// `spread` is the standard deviation at which combinations really lie from their predictions over
// that which the process expects. These were chosen on recorded pictures of torture, and confirmed
// on those of the other scenes of tests/app/cost/test_best.c (docs/cost-methods.md).
static const double common_flip = 1.0, alike_flip = 0.96, own_flip = 1e-5, spread = 1.5;

// FLIP below this is as good as none.
static const double least_flip = 1e-6;

static int list_rows(const DipCostPredictions *predicted, int rows[DIP_COST_MAX_ROWS]) {
    int count = 0;
    for (int i = 0; i < predicted->count; i++) {
        if (predicted->list[i].row >= 0) {
            rows[count++] = predicted->list[i].row;
        }
    }
    return count;
}

// Returns the usual ratio of the 95th percentile of the frames' times to their mean: the median
// over some rows of path 0.
static double usual_p95(const DipCostReport *report, const int *rows, int count) {
    double ratios[DIP_COST_MAX_ROWS];
    for (int i = 0; i < count; i++) {
        const DipPathEstimate *time = &report->rows[rows[i]].time;
        ratios[i] = time->p95_ms.value / time->mean_ms.value;
    }
    return dip_median(ratios, count);
}

// Returns log(measured / predicted), or 0 if one of the two is not above 0.
static double log_ratio(double measured, double predicted) {
    return measured > 0.0 && predicted > 0.0 ? log(measured / predicted) : 0.0;
}

static double log_flip(double flip) {
    return log(fmax(flip, least_flip));
}

// Writes what is known at the combinations, for each predicted value: the logarithms of what the
// models of time miss, and of FLIP.
static bool solve(const DipCostReport *report, DipCostModels *models, const int *rows) {
    const size_t count = (size_t)models->correction_count;
    double *values = calloc(2 * count + 1, sizeof *values), *shares = values + count;
    for (int value = 0; values && value < DIP_COST_PREDICTED; value++) {
        const bool is_flip = value == DIP_COST_PREDICTED_FLIP;
        for (size_t i = 0; i < count; i++) {
            const DipCostRow *r = &report->rows[rows[i]];
            const double ms = dip_cost_model_value(&models->times, r->counters, &r->quality);
            const double flip = dip_cost_row_metrics(report, rows[i], 0).flip;
            values[i] = is_flip ? log_flip(flip) - models->log_flip
                        : value == DIP_COST_PREDICTED_MS
                            ? log_ratio(r->time.mean_ms.value, ms)
                            : log_ratio(r->time.p95_ms.value, models->p95 * ms);
        }
        dip_cost_process_solve(is_flip ? &models->of_flip : &models->of_times, values, shares);
        for (size_t i = 0; i < count; i++) {
            models->corrections[i].shares[value] = shares[i];
            models->flip_variance +=
                is_flip ? spread * spread * values[i] * shares[i] / (double)count : 0.0;
        }
    }
    free(values);
    return values != NULL;
}

// Makes the measured combinations known to both processes.
static bool begin_processes(const DipCostReport *report, DipCostModels *models, const int *rows) {
    const int count = models->correction_count;
    int *distances = malloc(((size_t)count + 1) * sizeof *distances);
    const bool made = dip_cost_process_begin(&models->of_times, 0.0, alike_time, own_time, count) &&
                      dip_cost_process_begin(&models->of_flip, common_flip, alike_flip, own_flip,
                                             count + DIP_COST_MOST_PROMISING) &&
                      distances;
    for (int i = 0; made && i < count; i++) {
        models->corrections[i].quality = report->rows[rows[i]].quality;
        dip_cost_find_distances(models, i, &models->corrections[i].quality, distances);
        dip_cost_process_add(&models->of_times, distances);
        dip_cost_process_add(&models->of_flip, distances);
        models->log_flip += log_flip(dip_cost_row_metrics(report, rows[i], 0).flip) / count;
    }
    free(distances);
    return made;
}

bool dip_cost_models_of(const DipCostReport *report, DipCostModels *models, DipError *err) {
    int rows[DIP_COST_MAX_ROWS] = {0};
    const int count = list_rows(&report->predicted, rows);
    *models = (DipCostModels){
        .times = dip_cost_model_fit(report, DIP_COST_TIME, rows, count),
        .p95 = usual_p95(report, rows, count),
        .corrections = calloc((size_t)count + 1, sizeof *models->corrections),
        .correction_count = count,
    };
    return (models->corrections && begin_processes(report, models, rows) &&
            solve(report, models, rows)) ||
           dip_cost_out_of_memory(err);
}

void dip_cost_models_free(DipCostModels *models) {
    dip_cost_process_free(&models->of_times);
    dip_cost_process_free(&models->of_flip);
    free(models->corrections);
    *models = (DipCostModels){0};
}

DipCostMisses dip_cost_flip_left_out(const DipCostModels *models) {
    const int count = models->correction_count;
    double shares[DIP_COST_MAX_ROWS] = {0.0}, misses[DIP_COST_MAX_ROWS];
    for (int i = 0; i < count; i++) {
        shares[i] = models->corrections[i].shares[DIP_COST_PREDICTED_FLIP];
    }
    dip_cost_process_left_out(&models->of_flip, shares, misses);
    for (int i = 0; i < count; i++) {
        misses[i] = fabs(exp(-misses[i]) - 1.0);
    }
    return dip_cost_misses_of(misses, count);
}

// --- predictions ---------------------------------------------------------------------------------

void dip_cost_find_distances(const DipCostModels *models, int count, const DipQuality *quality,
                             int *distances) {
    for (int i = 0; i < count; i++) {
        distances[i] = dip_cost_distance(&models->corrections[i].quality, quality, ~0u);
    }
}

void dip_cost_predict_one(const DipCostModels *models, const double *counters,
                          const DipQuality *quality, const int *distances,
                          double values[DIP_COST_PREDICTED]) {
    double logs[DIP_COST_PREDICTED] = {[DIP_COST_PREDICTED_FLIP] = models->log_flip};
    for (int i = 0; i < models->correction_count; i++) {
        const double *shares = models->corrections[i].shares;
        const double time = models->of_times.covariance[distances[i]];
        logs[DIP_COST_PREDICTED_MS] += time * shares[DIP_COST_PREDICTED_MS];
        logs[DIP_COST_PREDICTED_P95] += time * shares[DIP_COST_PREDICTED_P95];
        logs[DIP_COST_PREDICTED_FLIP] +=
            models->of_flip.covariance[distances[i]] * shares[DIP_COST_PREDICTED_FLIP];
    }
    const double ms = dip_cost_model_value(&models->times, counters, quality);
    values[DIP_COST_PREDICTED_MS] = ms * exp(logs[DIP_COST_PREDICTED_MS]);
    values[DIP_COST_PREDICTED_P95] = models->p95 * ms * exp(logs[DIP_COST_PREDICTED_P95]);
    values[DIP_COST_PREDICTED_FLIP] = exp(logs[DIP_COST_PREDICTED_FLIP]);
}

bool dip_cost_predict_others(DipCostReport *report, const DipCostModels *models, DipError *err) {
    int *distances = calloc((size_t)models->correction_count + 1, sizeof *distances);
    for (int i = 0; distances && i < report->predicted.count; i++) {
        DipCostPrediction *p = &report->predicted.list[i];
        if (p->row < 0) {
            double values[DIP_COST_PREDICTED];
            dip_cost_find_distances(models, models->correction_count, &p->quality, distances);
            dip_cost_predict_one(models, p->counters, &p->quality, distances, values);
            p->ms = values[DIP_COST_PREDICTED_MS];
            p->p95_ms = values[DIP_COST_PREDICTED_P95];
            p->flip = values[DIP_COST_PREDICTED_FLIP];
        }
    }
    free(distances);
    return distances || dip_cost_out_of_memory(err);
}
