// Measures the combinations that are predicted to be best, in several goes. A go measures some of
// them, and then predicts the others anew from all combinations that were measured so far.
#include "app/cost/steps.h"

#include <math.h>
#include <stdlib.h>

enum {
    MOST_GOES = 5,
    FEW_GOES = 2, // Greatest number of goes if a run has fewer than FEW_ROUNDS rounds, for a
                  // fast answer.
    FEW_ROUNDS = 8
};

int dip_cost_most_goes(const DipCostOptions *options) {
    return options->rounds < FEW_ROUNDS ? FEW_GOES : MOST_GOES;
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

// Predicts every listed combination that has no row, from the combinations that have a row. If
// there are too many combinations to list, first searches all of them for the best, and lists the
// best. Free the models even after a failure.
static bool predict(DipCostReport *report, DipPool *pool, DipCostModels *models, DipError *err) {
    return dip_cost_models_of(report, models, err) &&
           (report->predicted.searched <= DIP_COST_MAX_ROWS ||
            dip_cost_search(report, pool, models, err)) &&
           dip_cost_predict_others(report, models, err);
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
            const double flip = dip_cost_row_metrics(report, p->row).flip;
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
    DipCostModels models;
    bool done = predict(report, pool, &models, err);
    if (done) {
        report->predicted.errors_left_out = dip_flip_model_left_out(&models.flip);
    }
    // If the verdict is red, the times are wrong (report.h) and no settings will be advised, so no
    // combinations are measured for the advice.
    const int goes = report->verdict == DIP_COST_RED ? 0 : dip_cost_most_goes(&report->options);
    for (int go = 0; done && go < goes; go++) {
        int list[DIP_COST_MOST_PROMISING], rows[DIP_COST_MOST_PROMISING];
        const int count = dip_cost_list_promising(report, &models, go == 0, list, err);
        if (count <= 0) {
            done = count == 0;
            break;
        }
        done =
            dip_cost_add_rows(report, list, count, rows, err) && measure(context, rows, count, err);
        if (done) {
            judge_predictions(report, first_row);
            dip_cost_models_free(&models);
            done = predict(report, pool, &models, err);
        }
    }
    dip_cost_models_free(&models);
    return done;
}
