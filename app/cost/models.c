// Predicts combinations from those that were measured. A predicted time is the value of a model of
// work (fit.h), multiplied by a correction. The correction follows from measured / modelled time at
// the measured combinations; those with similar settings count most. FLIP is predicted without a
// model of work, only from the FLIP of the measured combinations (flip_model.h).
#include "app/cost/steps.h"

#include <math.h>
#include <stdlib.h>

// The logarithms of measured / modelled time are a Gaussian process (process.h). The covariance of
// two combinations is alike_time to the power of d / DIP_PROCESS_STEP, where d is their distance
// with the weights of the FLIP model (dip_cost_distance). own_time is the further variance that
// each combination has by itself.
static const double alike_time = 0.6, own_time = 0.3;

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

// Adds the rows to the Gaussian process of_times, and computes each row's share (process.h) in the
// corrections of means and of 95th percentiles.
static bool correct_times(const DipCostReport *report, DipCostModels *models, const int *rows,
                          int count) {
    double ms_logs[DIP_COST_MAX_ROWS], p95_logs[DIP_COST_MAX_ROWS];
    int distances[DIP_COST_MAX_ROWS];
    models->ms_shares = calloc(2 * (size_t)count + 1, sizeof *models->ms_shares);
    if (!dip_cost_process_begin(&models->of_times, 0.0, alike_time, own_time, count) ||
        !models->ms_shares) {
        return false;
    }
    models->p95_shares = models->ms_shares + count;
    for (int i = 0; i < count; i++) {
        const DipCostRow *r = &report->rows[rows[i]];
        const double ms = dip_cost_model_value(&models->times, r->counters, &r->quality);
        ms_logs[i] = log_ratio(r->time.mean_ms.value, ms);
        p95_logs[i] = log_ratio(r->time.p95_ms.value, models->p95 * ms);
        dip_flip_model_distances(&models->flip, &r->quality, distances);
        dip_cost_process_add(&models->of_times, distances);
    }
    dip_cost_process_solve(&models->of_times, ms_logs, models->ms_shares);
    dip_cost_process_solve(&models->of_times, p95_logs, models->p95_shares);
    return true;
}

bool dip_cost_models_of(const DipCostReport *report, DipCostModels *models, DipError *err) {
    int rows[DIP_COST_MAX_ROWS] = {0};
    const int count = list_rows(&report->predicted, rows);
    *models = (DipCostModels){
        .times = dip_cost_model_fit(report, rows, count),
        .p95 = usual_p95(report, rows, count),
    };
    return (dip_flip_model_fit(report, rows, count, DIP_COST_MOST_PROMISING, &models->flip) &&
            correct_times(report, models, rows, count)) ||
           dip_cost_out_of_memory(err);
}

void dip_cost_models_free(DipCostModels *models) {
    dip_flip_model_free(&models->flip);
    dip_cost_process_free(&models->of_times);
    free(models->ms_shares);
    *models = (DipCostModels){0};
}

// --- predictions ---------------------------------------------------------------------------------

void dip_cost_predict_one(const DipCostModels *models, const double *counters,
                          const DipQuality *quality, const int *distances,
                          double values[DIP_COST_PREDICTED]) {
    const double ms = dip_cost_model_value(&models->times, counters, quality);
    double ms_log = 0.0, p95_log = 0.0;
    for (int i = 0; i < models->flip.count; i++) {
        const double covariance = models->of_times.covariance[distances[i]];
        ms_log += covariance * models->ms_shares[i];
        p95_log += covariance * models->p95_shares[i];
    }
    values[DIP_COST_PREDICTED_MS] = ms * exp(ms_log);
    values[DIP_COST_PREDICTED_P95] = models->p95 * ms * exp(p95_log);
    values[DIP_COST_PREDICTED_FLIP] = dip_flip_model_value(&models->flip, distances);
}

bool dip_cost_predict_others(DipCostReport *report, const DipCostModels *models, DipError *err) {
    int *distances = calloc((size_t)models->flip.count + 1, sizeof *distances);
    for (int i = 0; distances && i < report->predicted.count; i++) {
        DipCostPrediction *p = &report->predicted.list[i];
        if (p->row < 0) {
            double values[DIP_COST_PREDICTED];
            dip_flip_model_distances(&models->flip, &p->quality, distances);
            dip_cost_predict_one(models, p->counters, &p->quality, distances, values);
            p->ms = values[DIP_COST_PREDICTED_MS];
            p->p95_ms = values[DIP_COST_PREDICTED_P95];
            p->flip = values[DIP_COST_PREDICTED_FLIP];
        }
    }
    free(distances);
    return distances || dip_cost_out_of_memory(err);
}
