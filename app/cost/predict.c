// Finds the best combinations by predictions. First measures the steps of the combined settings and
// the combinations that tell most about all others. Then predicts these others, and measures those
// that the predictions put near a budget or on the Pareto front.
#include "app/cost/steps.h"

#include "app/report/report.h"
#include "app/report/fit.h"
#include "app/measure/stats/least_squares.h"
#include "renderer/base/assert.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { DESIGN_TERMS = DIP_LEAST_SQUARES_MAX_TERMS };

// --- the rows to measure first -------------------------------------------------------------------

int dip_cost_training_count(unsigned settings, int count) {
    const unsigned main = 1u << DIP_SETTING_AA | 1u << DIP_SETTING_AAA | 1u << DIP_SETTING_ASD |
                          1u << DIP_SETTING_AF | 1u << DIP_SETTING_AAF;
    int training = settings >> DIP_SETTING_AAA & 1 ? 20 : 16;
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        if (settings >> s & 1 && !(main >> s & 1)) {
            training += (3 * (dip_setting_info((DipSetting)s)->step_count - 1) + 1) / 2;
        }
    }
    return training < count ? training : count;
}

// Writes the terms of a combination in the model of times (fit.h): the amounts of work of all
// stages. The constant terms of all stages are merged into the first term, whose amount is 1.
// Returns the number of terms.
static int design_terms(const DipCostPrediction *prediction, double terms[DESIGN_TERMS]) {
    int count = 0;
    terms[count++] = 1.0;
    for (int stage = 0; stage < DIP_COST_STAGE_COUNT; stage++) {
        double amounts[DIP_COST_MAX_TERMS];
        dip_cost_terms(stage, prediction->counters, &prediction->quality, amounts);
        DIP_ASSERT(count + dip_cost_term_count(stage) - 1 <= DESIGN_TERMS);
        for (int t = 1; t < dip_cost_term_count(stage); t++) {
            terms[count++] = amounts[t];
        }
    }
    return count;
}

bool dip_cost_choose_timed(const DipCostReport *report, int count, int *chosen, DipError *err) {
    const DipCostPredictions *predicted = &report->predicted;
    double *matrix = malloc((size_t)predicted->count * DESIGN_TERMS * sizeof *matrix);
    if (!matrix) {
        return dip_cost_out_of_memory(err);
    }
    int terms = 0, given = 0;
    for (int i = 0; i < predicted->count; i++) {
        double row[DESIGN_TERMS];
        terms = design_terms(&predicted->list[i], row);
        memcpy(matrix + (size_t)i * (size_t)terms, row, (size_t)terms * sizeof *row);
    }
    for (int i = 0; i < predicted->count && given < count; i++) {
        if (predicted->list[i].row >= 0) {
            chosen[given++] = i;
        }
    }
    const int baseline = dip_report_find_predicted(predicted, &report->options.baseline);
    if (given == 0 && baseline >= 0 && count > 0) {
        chosen[given++] = baseline;
    }
    dip_design_choose(matrix, predicted->count, terms, given, count, chosen);
    free(matrix);
    return true;
}

bool dip_cost_choose_training(const DipCostReport *report, int count, int *chosen, DipError *err) {
    const DipCostPredictions *predicted = &report->predicted;
    int given = 0;
    for (int i = 0; i < predicted->count && given < count; i++) {
        given += predicted->list[i].row >= 0;
    }
    const int half = given + (count - given) / 2;
    return dip_cost_choose_timed(report, half, chosen, err) &&
           (dip_flip_model_design(predicted, half, count, chosen) || dip_cost_out_of_memory(err));
}

// --- the whole -----------------------------------------------------------------------------------

// Measures the combinations that tell most about all others.
static bool measure_training(DipCostContext *cost, DipError *err) {
    DipCostReport *report = cost->report;
    DipCostPredictions *predicted = &report->predicted;
    int chosen[DIP_COST_MAX_ROWS], rows[DIP_COST_MAX_ROWS];
    const int count = dip_cost_training_count(report->options.combined, predicted->count);
    predicted->trained = count;
    if (!dip_cost_choose_training(report, count, chosen, err) ||
        !dip_cost_add_rows(report, chosen, count, rows, err)) {
        return false;
    }
    dip_cost_begin_phase(cost, DIP_COST_PHASE_TRAINING);
    if (!dip_cost_judge(cost, err)) {
        return false;
    }
    dip_cost_begin_phase(cost, DIP_COST_PHASE_TIMES);
    if (!dip_cost_time_rows(cost, err) || !dip_cost_time_smaller(cost, err)) {
        return false;
    }
    dip_cost_scale_counters(report);
    predicted->times_left_out = dip_cost_model_leave_one_out(report, rows, count);
    for (int i = 0; i < count; i++) {
        DipCostPrediction *p = &predicted->list[chosen[i]];
        p->ms = dip_cost_ms(report, p->row);
        p->p95_ms = report->rows[p->row].time.p95_ms.value;
        p->flip = dip_cost_row_metrics(report, p->row).flip;
    }
    return true;
}

// Measures the errors of the sweeps, and drops the settings whose steps all draw the same pictures.
// Then lists the combinations of the other combined settings, and fills in their counters. If the
// list is only a sample, removes slow combinations from it.
static bool list_combinations(DipCostContext *cost, DipError *err) {
    dip_cost_begin_phase(cost, DIP_COST_PHASE_SWEEPS);
    if (!dip_cost_judge(cost, err)) {
        return false;
    }
    dip_cost_drop_idle_settings(cost->report);
    dip_cost_begin_phase(cost, DIP_COST_PHASE_COUNTING);
    if (!dip_cost_list_predictions(cost->report, err) || !dip_cost_count_combinations(cost, err)) {
        return false;
    }
    dip_cost_drop_slow_sample(cost->report);
    return true;
}

// Measures new rows for dip_cost_measure_best.
static bool measure_rows(void *context, const int *rows, int count, DipError *err) {
    DipCostContext *cost = context;
    dip_cost_begin_phase(cost, DIP_COST_PHASE_BEST_ERRORS);
    if (!dip_cost_judge(cost, err)) {
        return false;
    }
    dip_cost_begin_phase(cost, DIP_COST_PHASE_BEST_TIMES);
    cost->forecast.goes++;
    return dip_cost_time_more(cost, rows, count, 0, err) &&
           dip_cost_estimate_times(cost->report, err);
}

bool dip_cost_predict(DipCostContext *cost, DipError *err) {
    DipCostReport *report = cost->report;
    return list_combinations(cost, err) && measure_training(cost, err) &&
           dip_cost_measure_best(report, cost->session->pool, measure_rows, cost, err);
}
