// Fits models of time and FLIP to the measured combinations, and predicts the others. A prediction
// is the value of a model, corrected by what the model misses at measured combinations that are
// alike.
#include "app/cost/steps.h"

#include <math.h>
#include <stdlib.h>

// The likeness of two combinations is this number to the power of the number of settings in which
// they differ. This value and the next one were chosen on the made-up machines of
// tests/app/cost/test_best.c.
static const double alike = 0.5;

// What a model misses at a combination has two parts: one that alike combinations share, and one of
// its own. This is the variance of the part of its own, divided by that of the shared part.
static const double own_variance = 0.3;

// Number of iterations that solve the equations for the shares, to 5 % of a miss or better.
enum { SWEEPS = 200 };

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

// Writes what the models alone miss at a row, as log(measured / predicted) of each value.
static void find_misses(const DipCostReport *report, const DipCostModels *models, int row,
                        double misses[DIP_COST_PREDICTED]) {
    const DipCostRow *r = &report->rows[row];
    const double ms = dip_cost_model_value(&models->times, r->counters, &r->quality);
    const double flip = dip_cost_model_value(&models->errors, r->counters, &r->quality);
    misses[DIP_COST_PREDICTED_MS] = log_ratio(r->time.mean_ms.value, ms);
    misses[DIP_COST_PREDICTED_P95] = log_ratio(r->time.p95_ms.value, models->p95 * ms);
    misses[DIP_COST_PREDICTED_FLIP] = log_ratio(dip_cost_row_metrics(report, row, 0).flip, flip);
}

// Solves (K + own_variance I) a = misses for the shares a of all corrections, by Gauss-Seidel
// iterations. The matrix K has the likeness of each two measured combinations, and I is the unit
// matrix, so the sum is positive definite.
static bool solve(const DipCostModels *models, double (*misses)[DIP_COST_PREDICTED]) {
    const size_t count = (size_t)models->correction_count;
    DipCostCorrection *list = models->corrections;
    double *likeness = malloc((count * count + 1) * sizeof *likeness);
    for (size_t i = 0; likeness && i < count * count; i++) {
        likeness[i] = dip_cost_alike(&list[i / count].quality, &list[i % count].quality, ~0u);
    }
    for (size_t i = 0; likeness && i < SWEEPS * count; i++) {
        const size_t at = i % count;
        for (int value = 0; value < DIP_COST_PREDICTED; value++) {
            double left = misses[at][value] + list[at].shares[value];
            for (size_t k = 0; k < count; k++) {
                left -= likeness[at * count + k] * list[k].shares[value];
            }
            list[at].shares[value] = left / (1.0 + own_variance);
        }
    }
    free(likeness);
    return likeness != NULL;
}

bool dip_cost_models_of(const DipCostReport *report, DipCostModels *models, DipError *err) {
    int rows[DIP_COST_MAX_ROWS] = {0};
    const int count = list_rows(&report->predicted, rows);
    *models = (DipCostModels){
        .times = dip_cost_model_fit(report, DIP_COST_TIME, rows, count),
        .errors = dip_cost_model_fit(report, DIP_COST_FLIP_ERROR, rows, count),
        .p95 = usual_p95(report, rows, count),
        .corrections = calloc((size_t)count + 1, sizeof *models->corrections),
        .correction_count = count,
    };
    double(*misses)[DIP_COST_PREDICTED] = calloc((size_t)count + 1, sizeof *misses);
    bool made = models->corrections && misses;
    for (int i = 0; made && i < count; i++) {
        models->corrections[i].quality = report->rows[rows[i]].quality;
        find_misses(report, models, rows[i], misses[i]);
    }
    made = made && solve(models, misses);
    free(misses);
    return made || dip_cost_out_of_memory(err);
}

void dip_cost_models_free(DipCostModels *models) {
    free(models->corrections);
    *models = (DipCostModels){0};
}

// --- predictions ---------------------------------------------------------------------------------

double dip_cost_alike(const DipQuality *a, const DipQuality *b, unsigned settings) {
    double likeness = 1.0;
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        likeness *= settings >> s & 1 && a->step[s] != b->step[s] ? alike : 1.0;
    }
    return likeness;
}

void dip_cost_predict_one(const DipCostModels *models, const double *counters,
                          const DipQuality *quality, const double *likeness,
                          double values[DIP_COST_PREDICTED]) {
    double logs[DIP_COST_PREDICTED] = {0.0};
    for (int i = 0; i < models->correction_count; i++) {
        for (int value = 0; value < DIP_COST_PREDICTED; value++) {
            logs[value] += likeness[i] * models->corrections[i].shares[value];
        }
    }
    const double ms = dip_cost_model_value(&models->times, counters, quality);
    values[DIP_COST_PREDICTED_MS] = ms * exp(logs[DIP_COST_PREDICTED_MS]);
    values[DIP_COST_PREDICTED_P95] = models->p95 * ms * exp(logs[DIP_COST_PREDICTED_P95]);
    values[DIP_COST_PREDICTED_FLIP] = dip_cost_model_value(&models->errors, counters, quality) *
                                      exp(logs[DIP_COST_PREDICTED_FLIP]);
}

bool dip_cost_predict_others(DipCostReport *report, const DipCostModels *models, DipError *err) {
    double *likeness = calloc((size_t)models->correction_count + 1, sizeof *likeness);
    for (int i = 0; likeness && i < report->predicted.count; i++) {
        DipCostPrediction *p = &report->predicted.list[i];
        if (p->row < 0) {
            double values[DIP_COST_PREDICTED];
            for (int k = 0; k < models->correction_count; k++) {
                likeness[k] = dip_cost_alike(&models->corrections[k].quality, &p->quality, ~0u);
            }
            dip_cost_predict_one(models, p->counters, &p->quality, likeness, values);
            p->ms = values[DIP_COST_PREDICTED_MS];
            p->p95_ms = values[DIP_COST_PREDICTED_P95];
            p->flip = values[DIP_COST_PREDICTED_FLIP];
        }
    }
    free(likeness);
    return likeness || dip_cost_out_of_memory(err);
}
