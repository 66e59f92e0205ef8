// Fits the models of times and of FLIP, and judges them.
#include "app/report/fit.h"

#include "app/measure/stats/least_squares.h"
#include "renderer/base/assert.h"

#include <math.h>

// All combinations `there` (dip_cost_model_fit_there) together count this many times as much as all
// rows and smaller combinations of the report. Any value from 3 to 100 does about as well. This was
// tried in the scene "courtyard", where 6 timed combinations predicted the others at two sizes and
// on three paths.
static const double there_weight = 30.0;

// The ridge of the fit of FLIP, as a share of the summed weight of the rows. Without a ridge, two
// terms that the rows do not tell apart would get great prices of opposite sign.
static const double flip_ridge = 1e-5;

// A measurement to which prices are fitted: a row, or a combination that was timed elsewhere.
typedef struct Sample {
    const double *counters;
    const double *stage_ms;
    const DipQuality *quality;
    double whole; // The time of the frame, or its FLIP; 0 if it is not known.
} Sample;

// The least-squares equations of the parts that are fitted: all stages, or FLIP.
typedef struct Equations {
    DipCostModelled what;
    int first, end; // The parts from `first` to end - 1.
    DipNormalEquations parts[DIP_COST_PART_COUNT];
    int known; // Number of rows, and of combinations in `there`, that were added.
} Equations;

static double sum_stages(const double stage_ms[DIP_COST_STAGE_COUNT]) {
    double ms = 0.0;
    for (int stage = 0; stage < DIP_COST_STAGE_COUNT; stage++) {
        ms += stage_ms[stage];
    }
    return ms;
}

static Sample sample_of(const DipCostReport *report, DipCostModelled what, int row) {
    const DipCostRow *r = &report->rows[row];
    const double whole =
        what == DIP_COST_TIME ? sum_stages(r->stage_ms) : dip_cost_row_metrics(report, row, 0).flip;
    return (Sample){r->counters, r->stage_ms, &r->quality, whole};
}

// Returns the sample of the row rows[index], or of the row `index` if `rows` is NULL.
static Sample sample_at(const DipCostReport *report, DipCostModelled what, const int *rows,
                        int index) {
    return sample_of(report, what, rows ? rows[index] : index);
}

static Sample elsewhere_sample(const DipCostElsewhere *row) {
    return (Sample){row->counters, row->stage_ms, &row->quality, sum_stages(row->stage_ms)};
}

// Adds a sample `weight` times. A weight of -1 takes it away. Returns false if its value is not
// known.
static bool add(Equations *equations, const Sample *sample, double weight) {
    double amounts[DIP_COST_MAX_TERMS];
    if (!(sample->whole > 0.0)) {
        return false;
    }
    for (int part = equations->first; part < equations->end; part++) {
        const double value = part == DIP_COST_PART_FLIP ? sample->whole : sample->stage_ms[part];
        dip_cost_terms(part, sample->counters, sample->quality, amounts);
        dip_normal_equations_add(&equations->parts[part], amounts, value,
                                 weight / (sample->whole * sample->whole));
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

static void enlarge_scale(const Sample *sample, int part, double scale[DIP_COST_MAX_TERMS]) {
    double amounts[DIP_COST_MAX_TERMS];
    dip_cost_terms(part, sample->counters, sample->quality, amounts);
    for (int t = 0; t < dip_cost_term_count(part); t++) {
        scale[t] = fmax(scale[t], amounts[t]);
    }
}

// Starts the equations of a part. Each term is scaled by its greatest amount. The scale of FLIP's
// terms is 1, because their amounts are at most 1.
static void begin_part(Equations *equations, const DipCostReport *report, const int *rows,
                       int count, int part) {
    double scale[DIP_COST_MAX_TERMS];
    for (int t = 0; t < DIP_COST_MAX_TERMS; t++) {
        scale[t] = part == DIP_COST_PART_FLIP;
    }
    for (int r = 0; r < count; r++) {
        const Sample sample = sample_at(report, equations->what, rows, r);
        enlarge_scale(&sample, part, scale);
    }
    for (int i = 0; i < report->smaller_count; i++) {
        const Sample sample = elsewhere_sample(&report->smaller[i]);
        enlarge_scale(&sample, part, scale);
    }
    dip_normal_equations_begin(&equations->parts[part], dip_cost_term_count(part), scale);
}

// Makes the equations of some rows. The equations of times also get the combinations that
// were timed at a smaller size.
static void begin(Equations *equations, const DipCostReport *report, DipCostModelled what,
                  const int *rows, int count) {
    const bool is_time = what == DIP_COST_TIME;
    equations->what = what;
    equations->first = is_time ? 0 : DIP_COST_PART_FLIP;
    equations->end = is_time ? DIP_COST_STAGE_COUNT : DIP_COST_PART_COUNT;
    equations->known = 0;
    for (int part = equations->first; part < equations->end; part++) {
        begin_part(equations, report, rows, count, part);
    }
    if (is_time) {
        add_elsewhere(equations, report->smaller, report->smaller_count, 1.0);
    }
    for (int r = 0; r < count; r++) {
        const Sample sample = sample_at(report, what, rows, r);
        equations->known += add(equations, &sample, 1.0);
    }
}

static DipCostModel solve(const Equations *equations) {
    DipCostModel model = {.what = equations->what, .rows = equations->known};
    for (int part = equations->first; part < equations->end; part++) {
        const DipNormalEquations *e = &equations->parts[part];
        if (part == DIP_COST_PART_FLIP) {
            dip_least_squares_ridge(e, flip_ridge * e->left[0][0], model.prices[part]);
        } else {
            dip_least_squares_nonnegative(e, model.prices[part]);
        }
    }
    return model;
}

DipCostModel dip_cost_model_fit(const DipCostReport *report, DipCostModelled what, const int *rows,
                                int count) {
    Equations equations;
    begin(&equations, report, what, rows, count);
    return solve(&equations);
}

DipCostModel dip_cost_model_fit_there(const DipCostReport *report, const int *rows, int count,
                                      const DipCostElsewhere *there, int there_count) {
    Equations equations;
    begin(&equations, report, DIP_COST_TIME, rows, count);
    add_elsewhere(&equations, there, there_count,
                  there_weight * (equations.known + report->smaller_count) / there_count);
    equations.known += there_count;
    return solve(&equations);
}

double dip_cost_model_value(const DipCostModel *model,
                            const double counters[DIP_COST_COUNTER_COUNT],
                            const DipQuality *quality) {
    const bool is_time = model->what == DIP_COST_TIME;
    const double value = dip_cost_sum_terms(is_time ? 0 : DIP_COST_PART_FLIP,
                                            is_time ? DIP_COST_STAGE_COUNT : DIP_COST_PART_COUNT,
                                            model->prices, counters, quality);
    return is_time ? value : fmax(value, 0.0);
}

// --- misses --------------------------------------------------------------------------------------

static double miss_of(const DipCostModel *model, const Sample *sample) {
    return fabs(dip_cost_model_value(model, sample->counters, sample->quality) / sample->whole -
                1.0);
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

DipCostMisses dip_cost_model_leave_one_out(const DipCostReport *report, DipCostModelled what,
                                           const int *rows, int count) {
    Equations equations;
    double misses[DIP_COST_MAX_ROWS];
    int known = 0;
    DIP_ASSERT(count <= DIP_COST_MAX_ROWS);
    begin(&equations, report, what, rows, count);
    for (int r = 0; r < count; r++) {
        const Sample sample = sample_at(report, what, rows, r);
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
        const double ms = sample_of(report, DIP_COST_TIME, rows[r]).whole;
        sum += 1.0 / ms;
        weight += 1.0 / (ms * ms);
    }
    for (int r = 0; r < fit->rows; r++) {
        const Sample sample = sample_of(report, DIP_COST_TIME, rows[r]);
        const double off = sum / weight / sample.whole - 1.0;
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
    const DipCostModel model = dip_cost_model_fit(report, DIP_COST_TIME, rows, fit.rows);
    for (int stage = 0; stage < DIP_COST_STAGE_COUNT; stage++) {
        for (int t = 0; t < dip_cost_term_count(stage); t++) {
            fit.stages[fit.count] = dip_cost_stage_names[stage];
            fit.names[fit.count] = dip_cost_term_name(stage, t);
            fit.ns[fit.count++] = 1e6 * model.prices[stage][t];
        }
    }
    judge_fit(report, &model, rows, &fit);
    fit.others = dip_cost_model_leave_one_out(report, DIP_COST_TIME, rows, fit.rows);
    return fit;
}
