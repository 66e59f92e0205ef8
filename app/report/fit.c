// Fits the model of times, and judges it.
#include "app/report/fit.h"

#include "app/measure/stats/least_squares.h"
#include "renderer/base/assert.h"

#include <math.h>

// At another place, all combinations `there` (dip_cost_model_fit_there) together count this many
// times as much as all rows and smaller combinations of the report. Any value from 3 to 100 does
// about as well. This was tried in the scene "courtyard", where 6 timed combinations predicted the
// others at two sizes and on three paths.
static const double there_weight = 30.0;

// A measurement to which prices are fitted: a row, or a combination that was timed elsewhere.
typedef struct Sample {
    const double *counters;
    const double *stage_ms;
    const DipQuality *quality;
    double ms; // The sum of stage_ms; 0 if the times are not known.
} Sample;

// The least-squares equations of each stage.
typedef struct Equations {
    DipNormalEquations stages[DIP_COST_STAGE_COUNT];
    int known; // Number of rows, and of combinations in `there`, that were added.
} Equations;

static double sum_stages(const double stage_ms[DIP_COST_STAGE_COUNT]) {
    double ms = 0.0;
    for (int stage = 0; stage < DIP_COST_STAGE_COUNT; stage++) {
        ms += stage_ms[stage];
    }
    return ms;
}

static Sample sample_of(const DipCostReport *report, int row) {
    const DipCostRow *r = &report->rows[row];
    return (Sample){r->counters, r->stage_ms, &r->quality, sum_stages(r->stage_ms)};
}

// Returns the sample of the row rows[index], or of the row `index` if `rows` is NULL.
static Sample sample_at(const DipCostReport *report, const int *rows, int index) {
    return sample_of(report, rows ? rows[index] : index);
}

static Sample elsewhere_sample(const DipCostElsewhere *row) {
    return (Sample){row->counters, row->stage_ms, &row->quality, sum_stages(row->stage_ms)};
}

// Adds a sample `weight` times. A weight of -1 takes it away. Returns false if its time is not
// known.
static bool add(Equations *equations, const Sample *sample, double weight) {
    double amounts[DIP_COST_MAX_TERMS];
    if (!(sample->ms > 0.0)) {
        return false;
    }
    for (int stage = 0; stage < DIP_COST_STAGE_COUNT; stage++) {
        dip_cost_terms(stage, sample->counters, sample->quality, amounts);
        dip_normal_equations_add(&equations->stages[stage], amounts, sample->stage_ms[stage],
                                 weight / (sample->ms * sample->ms));
    }
    return true;
}

static void add_elsewhere(Equations *equations, const DipCostElsewhere *list, int count,
                          double weight) {
    for (int i = 0; i < count; i++) {
        const Sample sample = elsewhere_sample(&list[i]);
        add(equations, &sample, weight);
    }
}

static void enlarge_scale(const Sample *sample, int stage, double scale[DIP_COST_MAX_TERMS]) {
    double amounts[DIP_COST_MAX_TERMS];
    dip_cost_terms(stage, sample->counters, sample->quality, amounts);
    for (int t = 0; t < dip_cost_term_count(stage); t++) {
        scale[t] = fmax(scale[t], amounts[t]);
    }
}

// Starts the equations of a stage. Each term is scaled by its greatest amount.
static void begin_stage(Equations *equations, const DipCostReport *report, const int *rows,
                        int count, int stage) {
    double scale[DIP_COST_MAX_TERMS] = {0.0};
    for (int r = 0; r < count; r++) {
        const Sample sample = sample_at(report, rows, r);
        enlarge_scale(&sample, stage, scale);
    }
    for (int i = 0; i < report->smaller_count; i++) {
        const Sample sample = elsewhere_sample(&report->smaller[i]);
        enlarge_scale(&sample, stage, scale);
    }
    dip_normal_equations_begin(&equations->stages[stage], dip_cost_term_count(stage), scale);
}

// Makes the equations of some rows and of the combinations that were timed at a smaller size.
static void begin(Equations *equations, const DipCostReport *report, const int *rows, int count) {
    equations->known = 0;
    for (int stage = 0; stage < DIP_COST_STAGE_COUNT; stage++) {
        begin_stage(equations, report, rows, count, stage);
    }
    add_elsewhere(equations, report->smaller, report->smaller_count, 1.0);
    for (int r = 0; r < count; r++) {
        const Sample sample = sample_at(report, rows, r);
        equations->known += add(equations, &sample, 1.0);
    }
}

static DipCostModel solve(const Equations *equations) {
    DipCostModel model = {.rows = equations->known};
    for (int stage = 0; stage < DIP_COST_STAGE_COUNT; stage++) {
        dip_least_squares_nonnegative(&equations->stages[stage], model.prices[stage]);
    }
    return model;
}

DipCostModel dip_cost_model_fit(const DipCostReport *report, const int *rows, int count) {
    Equations equations;
    begin(&equations, report, rows, count);
    return solve(&equations);
}

DipCostModel dip_cost_model_fit_there(const DipCostReport *report, const int *rows, int count,
                                      const DipCostElsewhere *there, int there_count,
                                      bool same_place) {
    Equations equations;
    begin(&equations, report, rows, count);
    const double weight =
        there_weight * (equations.known + report->smaller_count) / fmax(there_count, 1.0);
    add_elsewhere(&equations, there, there_count, same_place ? 1.0 : weight);
    equations.known += there_count;
    return solve(&equations);
}

double dip_cost_model_value(const DipCostModel *model, const double counters[DIP_COUNTER_COUNT],
                            const DipQuality *quality) {
    return dip_cost_sum_terms(0, DIP_COST_STAGE_COUNT, model->prices, counters, quality);
}

// --- misses --------------------------------------------------------------------------------------

static double miss_of(const DipCostModel *model, const Sample *sample) {
    return fabs(dip_cost_model_value(model, sample->counters, sample->quality) / sample->ms - 1.0);
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

DipCostMisses dip_cost_model_leave_one_out(const DipCostReport *report, const int *rows,
                                           int count) {
    Equations equations;
    double misses[DIP_COST_MAX_ROWS];
    int known = 0;
    DIP_ASSERT(count <= DIP_COST_MAX_ROWS);
    begin(&equations, report, rows, count);
    for (int r = 0; r < count; r++) {
        const Sample sample = sample_at(report, rows, r);
        if (add(&equations, &sample, -1.0)) {
            const DipCostModel others = solve(&equations);
            add(&equations, &sample, 1.0);
            misses[known++] = miss_of(&others, &sample);
        }
    }
    return dip_cost_misses_of(misses, known);
}

// --- the fit of a whole report -------------------------------------------------------------------

int dip_cost_fit_rows(const DipCostReport *report, int rows[DIP_COST_MAX_ROWS]) {
    int count = 0;
    for (int r = 0; report->rounds > 0 && r < report->row_count; r++) {
        if (sum_stages(report->rows[r].stage_ms) > 0.0) {
            rows[count++] = r;
        }
    }
    return count < 2 * dip_cost_term_count(DIP_COST_STAGE_raster) ? 0 : count;
}

// Computes R2 and the misses. R2 says how much smaller the squared relative errors of the fit are
// than those of the best constant, which predicts one time for all rows.
static void judge_fit(const DipCostReport *report, const DipCostModel *model, const int *rows,
                      DipCostFit *fit) {
    double misses[DIP_COST_MAX_ROWS];
    double sum = 0.0, weight = 0.0, all = 0.0, left = 0.0;
    for (int r = 0; r < fit->rows; r++) {
        const double ms = sample_of(report, rows[r]).ms;
        sum += 1.0 / ms;
        weight += 1.0 / (ms * ms);
    }
    for (int r = 0; r < fit->rows; r++) {
        const Sample sample = sample_of(report, rows[r]);
        const double off = sum / weight / sample.ms - 1.0;
        misses[r] = miss_of(model, &sample);
        all += off * off;
        left += misses[r] * misses[r];
    }
    fit->median_miss = dip_cost_misses_of(misses, fit->rows).median;
    fit->r2 = all > 0.0 ? 1.0 - left / all : 0.0;
}

DipCostFit dip_cost_fit(const DipCostReport *report) {
    int rows[DIP_COST_MAX_ROWS];
    DipCostFit fit = {.rows = dip_cost_fit_rows(report, rows)};
    if (fit.rows == 0) {
        return fit;
    }
    const DipCostModel model = dip_cost_model_fit(report, rows, fit.rows);
    for (int stage = 0; stage < DIP_COST_STAGE_COUNT; stage++) {
        for (int t = 0; t < dip_cost_term_count(stage); t++) {
            fit.stages[fit.count] = dip_cost_stage_names[stage];
            fit.names[fit.count] = dip_cost_term_name(stage, t);
            fit.ns[fit.count++] = 1e6 * model.prices[stage][t];
        }
    }
    judge_fit(report, &model, rows, &fit);
    fit.others = dip_cost_model_leave_one_out(report, rows, fit.rows);
    return fit;
}
