// The model of times, stage by stage.
#include "app/report/fit.h"

#include "app/measure/stats/least_squares.h"
#include "renderer/base/assert.h"

#include <math.h>
#include <stdlib.h>

// How often the combinations that were timed there count together, for each time that the report's
// rows count together. From 3 to 100 it matters little: 6 combinations of the courtyard, at two
// sizes and on three other paths, then predict the others about as well.
static const double there_weight = 30.0;

// The equations of all stages.
typedef struct Equations {
    DipNormalEquations stages[DIP_COST_STAGE_COUNT];
} Equations;

// What a row, or a combination that was timed elsewhere, tells about prices.
typedef struct Sample {
    const double *counters;
    const double *stage_ms;
    const DipQuality *quality;
} Sample;

static Sample sample_of(const DipCostRow *row) {
    return (Sample){row->counters, row->stage_ms, &row->quality};
}

static Sample elsewhere_sample(const DipCostElsewhere *row) {
    return (Sample){row->counters, row->stage_ms, &row->quality};
}

static void enlarge_scale(const Sample *sample, DipCostStage stage,
                          double scale[DIP_COST_MAX_TERMS]) {
    double amounts[DIP_COST_MAX_TERMS];
    dip_cost_terms(stage, sample->counters, sample->quality, amounts);
    for (int t = 0; t < dip_cost_term_count(stage); t++) {
        scale[t] = fmax(scale[t], amounts[t]);
    }
}

static double whole_of(const Sample *sample) {
    double ms = 0.0;
    for (int stage = 0; stage < DIP_COST_STAGE_COUNT; stage++) {
        ms += sample->stage_ms[stage];
    }
    return ms;
}

static double whole_ms(const DipCostRow *row) {
    const Sample sample = sample_of(row);
    return whole_of(&sample);
}

// Adds a sample `weight` times. A weight of -1 takes it away.
static void add(Equations *equations, const Sample *sample, double weight) {
    const double ms = whole_of(sample);
    for (int stage = 0; stage < DIP_COST_STAGE_COUNT; stage++) {
        double amounts[DIP_COST_MAX_TERMS];
        dip_cost_terms((DipCostStage)stage, sample->counters, sample->quality, amounts);
        dip_normal_equations_add(&equations->stages[stage], amounts, sample->stage_ms[stage],
                                 weight / (ms * ms));
    }
}

static void add_row(Equations *equations, const DipCostRow *row, double weight) {
    const Sample sample = sample_of(row);
    add(equations, &sample, weight);
}

// Adds combinations that were timed elsewhere.
static void add_elsewhere(Equations *equations, const DipCostElsewhere *list, int count,
                          double weight) {
    for (int i = 0; i < count; i++) {
        const Sample sample = elsewhere_sample(&list[i]);
        if (whole_of(&sample) > 0.0) {
            add(equations, &sample, weight);
        }
    }
}

// Starts the equations of some rows, and adds the combinations that were timed at a smaller size.
static void begin(Equations *equations, const DipCostReport *report, const int *rows, int count) {
    for (int stage = 0; stage < DIP_COST_STAGE_COUNT; stage++) {
        double scale[DIP_COST_MAX_TERMS] = {0};
        for (int r = 0; r < count; r++) {
            const Sample sample = sample_of(&report->rows[rows[r]]);
            enlarge_scale(&sample, (DipCostStage)stage, scale);
        }
        for (int i = 0; i < report->smaller_count; i++) {
            const Sample sample = elsewhere_sample(&report->smaller[i]);
            enlarge_scale(&sample, (DipCostStage)stage, scale);
        }
        dip_normal_equations_begin(&equations->stages[stage],
                                   dip_cost_term_count((DipCostStage)stage), scale);
    }
    add_elsewhere(equations, report->smaller, report->smaller_count, 1.0);
}

static DipCostModel solve(const Equations *equations, int rows) {
    DipCostModel model = {.rows = rows};
    for (int stage = 0; stage < DIP_COST_STAGE_COUNT; stage++) {
        dip_least_squares_nonnegative(&equations->stages[stage], model.price_ms[stage]);
    }
    return model;
}

static bool is_known(const DipCostRow *row) {
    return whole_ms(row) > 0.0;
}

DipCostModel dip_cost_model_fit_there(const DipCostReport *report, const int *rows, int count,
                                      const DipCostElsewhere *there, int there_count) {
    Equations equations;
    int known = 0;
    begin(&equations, report, rows, count);
    for (int r = 0; r < count; r++) {
        if (is_known(&report->rows[rows[r]])) {
            add_row(&equations, &report->rows[rows[r]], 1.0);
            known++;
        }
    }
    add_elsewhere(&equations, there, there_count,
                  there_weight * (known + report->smaller_count) / there_count);
    return solve(&equations, known + there_count);
}

DipCostModel dip_cost_model_fit(const DipCostReport *report, const int *rows, int count) {
    return dip_cost_model_fit_there(report, rows, count, NULL, 0);
}

double dip_cost_model_ms(const DipCostModel *model, const double counters[DIP_COST_COUNTER_COUNT],
                         const DipQuality *quality) {
    double ms = 0.0;
    for (int stage = 0; stage < DIP_COST_STAGE_COUNT; stage++) {
        double amounts[DIP_COST_MAX_TERMS];
        dip_cost_terms((DipCostStage)stage, counters, quality, amounts);
        for (int t = 0; t < dip_cost_term_count((DipCostStage)stage); t++) {
            ms += amounts[t] * model->price_ms[stage][t];
        }
    }
    return ms;
}

// --- misses --------------------------------------------------------------------------------------

static double miss_of(const DipCostModel *model, const DipCostRow *row) {
    return fabs(dip_cost_model_ms(model, row->counters, &row->quality) / whole_ms(row) - 1.0);
}

DipCostMisses dip_cost_misses_of(double *misses, int count) {
    if (count == 0) {
        return (DipCostMisses){0};
    }
    int within_10 = 0, within_5 = 0;
    for (int i = 0; i < count; i++) {
        within_10 += misses[i] <= 0.10;
        within_5 += misses[i] <= 0.05;
    }
    return (DipCostMisses){
        .median = dip_percentile(misses, count, 0.5),
        .p90 = dip_percentile(misses, count, 0.9),
        .within_10 = (double)within_10 / count,
        .within_5 = (double)within_5 / count,
        .rows = count,
    };
}

DipCostMisses dip_cost_model_misses(const DipCostReport *report, const DipCostModel *model,
                                    const int *rows, int count) {
    double misses[DIP_COST_MAX_ROWS];
    int known = 0;
    DIP_ASSERT(count <= DIP_COST_MAX_ROWS);
    for (int r = 0; r < count; r++) {
        if (is_known(&report->rows[rows[r]])) {
            misses[known++] = miss_of(model, &report->rows[rows[r]]);
        }
    }
    return dip_cost_misses_of(misses, known);
}

DipCostMisses dip_cost_model_leave_one_out(const DipCostReport *report, const int *rows,
                                           int count) {
    Equations equations;
    double misses[DIP_COST_MAX_ROWS];
    int known = 0;
    DIP_ASSERT(count <= DIP_COST_MAX_ROWS);
    begin(&equations, report, rows, count);
    for (int r = 0; r < count; r++) {
        if (is_known(&report->rows[rows[r]])) {
            add_row(&equations, &report->rows[rows[r]], 1.0);
        }
    }
    for (int r = 0; r < count; r++) {
        const DipCostRow *row = &report->rows[rows[r]];
        if (is_known(row)) {
            add_row(&equations, row, -1.0);
            const DipCostModel others = solve(&equations, count - 1);
            add_row(&equations, row, 1.0);
            misses[known++] = miss_of(&others, row);
        }
    }
    return dip_cost_misses_of(misses, known);
}

// --- errors --------------------------------------------------------------------------------------

// Without it, rows that do not tell two terms apart would give them great coefficients of opposite
// sign.
static const double error_ridge = 1e-5;

// FLIP of a row, or 0 if the row was not judged.
static double flip_of(const DipCostReport *report, int row) {
    int viewpoints;
    const DipMetricSums sums = dip_cost_row_sums(report, row, &viewpoints);
    return viewpoints > 0 ? dip_metrics_of(&sums, 0).flip : 0.0;
}

static void add_error(DipNormalEquations *equations, const DipQuality *quality, double flip,
                      double sign) {
    double terms[DIP_COST_ERROR_TERMS];
    dip_cost_error_terms(quality, terms);
    dip_normal_equations_add(equations, terms, flip, sign / (flip * flip));
}

static int begin_errors(DipNormalEquations *equations, const DipCostReport *report, const int *rows,
                        int count) {
    double scale[DIP_COST_ERROR_TERMS];
    int known = 0;
    for (int t = 0; t < DIP_COST_ERROR_TERMS; t++) {
        scale[t] = 1.0; // Terms are at most 1.
    }
    dip_normal_equations_begin(equations, DIP_COST_ERROR_TERMS, scale);
    for (int r = 0; r < count; r++) {
        const double flip = flip_of(report, rows[r]);
        if (flip > 0.0) {
            add_error(equations, &report->rows[rows[r]].quality, flip, 1.0);
            known++;
        }
    }
    return known;
}

static DipCostErrorModel solve_errors(const DipNormalEquations *equations, int rows) {
    DipCostErrorModel model = {.rows = rows};
    dip_least_squares_ridge(equations, error_ridge * equations->left[0][0], model.coefficients);
    return model;
}

DipCostErrorModel dip_cost_error_model_fit(const DipCostReport *report, const int *rows,
                                           int count) {
    DipNormalEquations equations;
    const int known = begin_errors(&equations, report, rows, count);
    return solve_errors(&equations, known);
}

double dip_cost_error_model_flip(const DipCostErrorModel *model, const DipQuality *quality) {
    double terms[DIP_COST_ERROR_TERMS];
    double flip = 0.0;
    dip_cost_error_terms(quality, terms);
    for (int t = 0; t < DIP_COST_ERROR_TERMS; t++) {
        flip += terms[t] * model->coefficients[t];
    }
    return fmax(flip, 0.0);
}

DipCostMisses dip_cost_error_model_misses(const DipCostReport *report,
                                          const DipCostErrorModel *model, const int *rows,
                                          int count) {
    double misses[DIP_COST_MAX_ROWS];
    int known = 0;
    DIP_ASSERT(count <= DIP_COST_MAX_ROWS);
    for (int r = 0; r < count; r++) {
        const double flip = flip_of(report, rows[r]);
        if (flip > 0.0) {
            misses[known++] =
                fabs(dip_cost_error_model_flip(model, &report->rows[rows[r]].quality) / flip - 1.0);
        }
    }
    return dip_cost_misses_of(misses, known);
}

DipCostMisses dip_cost_error_model_leave_one_out(const DipCostReport *report, const int *rows,
                                                 int count) {
    DipNormalEquations equations;
    double misses[DIP_COST_MAX_ROWS];
    int known = 0;
    DIP_ASSERT(count <= DIP_COST_MAX_ROWS);
    const int judged = begin_errors(&equations, report, rows, count);
    for (int r = 0; r < count; r++) {
        const DipQuality *quality = &report->rows[rows[r]].quality;
        const double flip = flip_of(report, rows[r]);
        if (flip > 0.0) {
            add_error(&equations, quality, flip, -1.0);
            const DipCostErrorModel others = solve_errors(&equations, judged - 1);
            add_error(&equations, quality, flip, 1.0);
            misses[known++] = fabs(dip_cost_error_model_flip(&others, quality) / flip - 1.0);
        }
    }
    return dip_cost_misses_of(misses, known);
}

// --- the fit of a whole report -------------------------------------------------------------------

// R2 compares the fit with a constant: the one time that fits all rows best. The errors of both are
// relative errors.
static void judge_fit(const DipCostReport *report, const DipCostModel *model, const int *rows,
                      DipCostFit *fit) {
    double misses[DIP_COST_MAX_ROWS];
    double sum = 0.0, weight = 0.0, all = 0.0, left = 0.0;
    for (int r = 0; r < fit->rows; r++) {
        const double ms = whole_ms(&report->rows[rows[r]]);
        sum += 1.0 / ms;
        weight += 1.0 / (ms * ms);
    }
    for (int r = 0; r < fit->rows; r++) {
        const DipCostRow *row = &report->rows[rows[r]];
        const double off = sum / weight / whole_ms(row) - 1.0;
        misses[r] = miss_of(model, row);
        all += off * off;
        left += misses[r] * misses[r];
    }
    fit->median_miss = dip_cost_misses_of(misses, fit->rows).median;
    fit->r2 = all > 0.0 ? 1.0 - left / all : 0.0;
}

DipCostFit dip_cost_fit(const DipCostReport *report) {
    DipCostFit fit = {0};
    int rows[DIP_COST_MAX_ROWS];
    for (int r = 0; report->rounds > 0 && r < report->row_count; r++) {
        if (is_known(&report->rows[r])) {
            rows[fit.rows++] = r;
        }
    }
    if (fit.rows < 2 * dip_cost_term_count(DIP_COST_STAGE_raster)) {
        return (DipCostFit){0};
    }
    const DipCostModel model = dip_cost_model_fit(report, rows, fit.rows);
    for (int stage = 0; stage < DIP_COST_STAGE_COUNT; stage++) {
        for (int t = 0; t < dip_cost_term_count((DipCostStage)stage); t++) {
            fit.stages[fit.count] = dip_cost_stage_names[stage];
            fit.names[fit.count] = dip_cost_term_name((DipCostStage)stage, t);
            fit.ns[fit.count++] = 1e6 * model.price_ms[stage][t];
        }
    }
    judge_fit(report, &model, rows, &fit);
    fit.others = dip_cost_model_leave_one_out(report, rows, fit.rows);
    return fit;
}
