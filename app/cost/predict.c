// Measures every step of every setting, chooses which combinations to measure besides, predicts all
// others from them, and measures those that the prediction puts near a budget or on the front.
#include "app/cost/steps.h"

#include "app/report/report.h"
#include "app/report/fit.h"
#include "app/measure/stats/least_squares.h"
#include "renderer/base/assert.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    DESIGN_TERMS = DIP_LEAST_SQUARES_MAX_TERMS,
    // After the first combinations, those that are predicted to be best are measured, in at most
    // MOST_GOES goes of at most MOST_PROMISING combinations, of which at most FRONT_PER_GO are
    // measured because they are on the front.
    MOST_PROMISING = 24,
    MOST_GOES = 3,
    FEW_ROUNDS = 8, // With fewer rounds, the user is in a hurry, and there is one go less.
    FRONT_PER_GO = 8
};

// --- the rows to measure first -------------------------------------------------------------------

int dip_cost_training_count(unsigned settings, int count) {
    const unsigned main = 1u << DIP_SETTING_AA | 1u << DIP_SETTING_AAA | 1u << DIP_SETTING_ASD |
                          1u << DIP_SETTING_AF | 1u << DIP_SETTING_AAF;
    int training = settings >> DIP_SETTING_AAA & 1 ? 20 : 16;
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        if (settings >> s & 1 && !(main >> s & 1)) {
            training += 2 * (dip_setting_info((DipSetting)s)->step_count - 1);
        }
    }
    return training < count ? training : count;
}

// Writes the terms of the model (fit.h) for all stages and for FLIP. One constant term, 1, stands
// for the constant terms of all of them. Returns the number of terms.
static int design_terms(const DipCostPrediction *prediction, double terms[DESIGN_TERMS]) {
    int count = 0;
    terms[count++] = 1.0;
    for (int part = 0; part < DIP_COST_PART_COUNT; part++) {
        double amounts[DIP_COST_MAX_TERMS];
        dip_cost_terms(part, prediction->counters, &prediction->quality, amounts);
        DIP_ASSERT(count + dip_cost_term_count(part) - 1 <= DESIGN_TERMS);
        for (int t = 1; t < dip_cost_term_count(part); t++) {
            terms[count++] = amounts[t];
        }
    }
    return count;
}

bool dip_cost_choose_training(const DipCostReport *report, int count, int *chosen, DipError *err) {
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

// --- predicting ----------------------------------------------------------------------------------

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

DipCostModels dip_cost_models_of(const DipCostReport *report) {
    int rows[DIP_COST_MAX_ROWS] = {0};
    const int count = list_rows(&report->predicted, rows);
    return (DipCostModels){
        .times = dip_cost_model_fit(report, DIP_COST_TIME, rows, count),
        .errors = dip_cost_model_fit(report, DIP_COST_FLIP_ERROR, rows, count),
        .p95 = usual_p95(report, rows, count),
    };
}

void dip_cost_predict_others(DipCostReport *report, const DipCostModels *models) {
    for (int i = 0; i < report->predicted.count; i++) {
        DipCostPrediction *p = &report->predicted.list[i];
        if (p->row < 0) {
            p->ms = dip_cost_model_value(&models->times, p->counters, &p->quality);
            p->p95_ms = models->p95 * p->ms;
            p->flip = dip_cost_model_value(&models->errors, p->counters, &p->quality);
        }
    }
}

// --- what is worth measuring ---------------------------------------------------------------------

// The combinations that should be measured: indices of report->predicted.
typedef struct Promising {
    const DipCostPrediction *predictions;
    int *list;
    int count;
    int most;
} Promising;

// Adds a combination unless it is measured or listed already, or the list is full.
static void add_promising(Promising *promising, int index) {
    bool needed = promising->predictions[index].row < 0 && promising->count < promising->most;
    for (int i = 0; i < promising->count; i++) {
        needed = needed && promising->list[i] != index;
    }
    if (needed) {
        promising->list[promising->count++] = index;
    }
}

static int compare_losses(const void *a, const void *b) {
    const DipCandidate *x = a, *y = b;
    return (x->loss > y->loss) - (x->loss < y->loss);
}

int dip_cost_list_promising(const DipCostReport *report, int most, int *list, DipError *err) {
    const DipCostOptions *options = &report->options;
    Promising promising = {.predictions = report->predicted.list, .list = list, .most = most};
    DipCandidates all;
    int front[DIP_COST_MAX_ROWS];
    if (!dip_candidates_of_predictions(report, options->budget_of, true, &all, err)) {
        return -1;
    }
    qsort(all.list, (size_t)all.count, sizeof *all.list, compare_losses);
    for (int b = 0; b < options->budget_count; b++) {
        // Adds the candidates of least FLIP among those that may be within the budget.
        for (int i = 0, seen = 0; i < all.count && seen < DIP_COST_PER_BUDGET; i++) {
            if (all.list[i].time.value <= DIP_COST_MAY_FIT * options->budgets_ms[b]) {
                add_promising(&promising, all.list[i].row);
                seen++;
            }
        }
    }
    const int count = dip_front(&all, DIP_CLEARLY_BETTER, front);
    const int room = promising.count + FRONT_PER_GO;
    promising.most = room < most ? room : most;
    for (int i = 0; i < count; i++) {
        add_promising(&promising, all.list[front[i]].row);
    }
    dip_candidates_free(&all);
    return promising.count;
}

// --- the whole -----------------------------------------------------------------------------------

// Adds rows for those combinations of report->predicted that have none, and lists the rows of all.
static bool add_rows(DipCostReport *report, const int *list, int count, int *rows, DipError *err) {
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

// Predicts all combinations without a row from those that have one. If the combinations are too
// many to be listed, searches them all.
static bool predict(DipCostContext *cost, DipError *err) {
    DipCostReport *report = cost->report;
    const DipCostModels models = dip_cost_models_of(report);
    if (report->predicted.searched > DIP_COST_MAX_ROWS && !dip_cost_search(cost, &models, err)) {
        return false;
    }
    dip_cost_predict_others(report, &models);
    return true;
}

// Measures the combinations that tell most about all others.
static bool measure_training(DipCostContext *cost, DipError *err) {
    DipCostReport *report = cost->report;
    DipCostPredictions *predicted = &report->predicted;
    int chosen[DIP_COST_MAX_ROWS], rows[DIP_COST_MAX_ROWS];
    const int count = dip_cost_training_count(report->options.combined, predicted->count);
    predicted->trained = count;
    if (!dip_cost_choose_training(report, count, chosen, err) ||
        !add_rows(report, chosen, count, rows, err)) {
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
    predicted->times_left_out = dip_cost_model_leave_one_out(report, DIP_COST_TIME, rows, count);
    predicted->errors_left_out =
        dip_cost_model_leave_one_out(report, DIP_COST_FLIP_ERROR, rows, count);
    for (int i = 0; i < count; i++) {
        DipCostPrediction *p = &predicted->list[chosen[i]];
        p->ms = dip_cost_ms(report, p->row);
        p->p95_ms = report->rows[p->row].time.p95_ms.value;
        p->flip = dip_cost_row_metrics(report, p->row, 0).flip;
    }
    return true;
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
            const double flip = dip_cost_row_metrics(report, p->row, 0).flip;
            times[time_count++] = fabs(p->ms / dip_cost_ms(report, p->row) - 1.0);
            if (flip > 0.0) { // A row that equals the truth has no relative error.
                errors[error_count++] = fabs(p->flip / flip - 1.0);
            }
        }
    }
    predicted->times = dip_cost_misses_of(times, time_count);
    predicted->errors = dip_cost_misses_of(errors, error_count);
}

// Lists the combinations, once the pictures of the sweeps tell which settings change any.
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

// Measures some of the predicted combinations, and predicts the others anew.
static bool measure_best(DipCostContext *cost, const int *list, int count, DipError *err) {
    DipCostReport *report = cost->report;
    int rows[MOST_PROMISING];
    dip_cost_begin_phase(cost, DIP_COST_PHASE_BEST_ERRORS);
    if (!add_rows(report, list, count, rows, err) || !dip_cost_judge(cost, err)) {
        return false;
    }
    dip_cost_begin_phase(cost, DIP_COST_PHASE_BEST_TIMES);
    return dip_cost_time_more(cost, rows, count, 0, err) && dip_cost_estimate_times(report, err) &&
           predict(cost, err);
}

bool dip_cost_predict(DipCostContext *cost, DipError *err) {
    DipCostReport *report = cost->report;
    if (!list_combinations(cost, err) || !measure_training(cost, err) || !predict(cost, err)) {
        return false;
    }
    if (report->verdict == DIP_COST_RED) { // No settings will be advised, so none are looked for.
        return true;
    }
    const int first_row = report->row_count;
    const int goes = report->options.rounds < FEW_ROUNDS ? MOST_GOES - 1 : MOST_GOES;
    for (int go = 0; go < goes; go++) {
        int list[MOST_PROMISING];
        const int count = dip_cost_list_promising(report, MOST_PROMISING, list, err);
        cost->forecast.goes = go;
        if (count < 0 || (count > 0 && !measure_best(cost, list, count, err))) {
            return false;
        }
        if (count == 0) {
            break;
        }
    }
    judge_predictions(report, first_row);
    return true;
}
