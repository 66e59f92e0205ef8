// Trains the prediction on a few combinations of a report, and prints how far it misses the others.
//
//     prediction_study A/cost.json [B/cost.json]...
//
// A is a report with combinations (diptych cost --combine aa,aaa,asd,af,aaf). The first lines are
// about A's own combinations. Each further report, of another size, thread count or camera path, is
// predicted with A's prices: as it is, and with one factor from six rows that were timed there.
#include "app/cost/fit.h"
#include "app/cost/formats.h"
#include "app/cost/predict.h"
#include "renderer/base/assert.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TRAINED = 16, ROWS_ELSEWHERE = 6 };

static void print_misses(const char *what, const DipCostMisses *misses) {
    printf("  %-52s median %5.1f %%, 90 %% within %5.1f %%, %3.0f %% within 10 %%, %3.0f %% within "
           "5 %% (%d rows)\n",
           what, 100.0 * misses->median, 100.0 * misses->p90, 100.0 * misses->within_10,
           100.0 * misses->within_5, misses->rows);
}

// Lists the combinations of a report as predictions, so that training rows can be chosen.
static bool list_combinations(DipCostReport *report) {
    const int count = report->row_count - report->combined_first;
    free(report->predicted.list);
    report->predicted.list = calloc((size_t)count + 1, sizeof *report->predicted.list);
    report->predicted.count = report->predicted.list ? count : 0;
    for (int i = 0; i < report->predicted.count; i++) {
        const DipCostRow *row = &report->rows[report->combined_first + i];
        DipCostPrediction *p = &report->predicted.list[i];
        *p = (DipCostPrediction){.quality = row->quality, .row = -1};
        memcpy(p->counters, row->counters, sizeof p->counters);
    }
    return report->predicted.list != NULL;
}

// Chooses the rows to train on. Returns their number, or 0 if there are too few combinations.
static int choose(DipCostReport *report, int count, int *rows, DipError *err) {
    if (!list_combinations(report) || report->predicted.count <= count ||
        !dip_cost_choose_training(report, count, rows, err)) {
        return 0;
    }
    for (int i = 0; i < count; i++) {
        rows[i] += report->combined_first;
    }
    return count;
}

static int list_others(const DipCostReport *report, const int *rows, int count, int *others) {
    int found = 0;
    for (int r = report->combined_first; r < report->row_count; r++) {
        bool trained = false;
        for (int i = 0; i < count; i++) {
            trained |= rows[i] == r;
        }
        if (!trained) {
            others[found++] = r;
        }
    }
    return found;
}

static bool study_own(DipCostReport *report, DipCostModel *model, DipError *err) {
    int rows[DIP_COST_MAX_ROWS], others[DIP_COST_MAX_ROWS];
    const int count = choose(report, TRAINED, rows, err);
    if (count == 0) {
        return false;
    }
    const int other_count = list_others(report, rows, count, others);
    *model = dip_cost_model_fit(report, rows, count);
    const DipCostErrorModel errors = dip_cost_error_model_fit(report, rows, count);
    const DipCostMisses time_misses = dip_cost_model_misses(report, model, others, other_count);
    const DipCostMisses flip_misses =
        dip_cost_error_model_misses(report, &errors, others, other_count);
    const DipCostMisses left_out = dip_cost_model_leave_one_out(report, rows, count);
    printf("trained on %d of %d combinations:\n", count, report->predicted.count);
    print_misses("times of the others", &time_misses);
    print_misses("times, each trained row from the other trained rows", &left_out);
    print_misses("FLIP of the others", &flip_misses);
    return true;
}

// The usual quotient of measured and predicted time at some rows.
static double factor_at(const DipCostReport *report, const DipCostModel *model, const int *rows,
                        int count) {
    double logs[DIP_COST_MAX_ROWS];
    for (int i = 0; i < count; i++) {
        const DipCostRow *row = &report->rows[rows[i]];
        logs[i] =
            log(row->time.mean_ms.value / dip_cost_model_ms(model, row->counters, &row->quality));
    }
    return exp(dip_stats_median(logs, count));
}

static bool study_elsewhere(DipCostReport *report, const DipCostModel *model, DipError *err) {
    int rows[DIP_COST_MAX_ROWS], others[DIP_COST_MAX_ROWS];
    const int count = choose(report, ROWS_ELSEWHERE, rows, err);
    if (count == 0) {
        return false;
    }
    const int other_count = list_others(report, rows, count, others);
    const double factor = factor_at(report, model, rows, count);
    DipCostModel scaled = *model;
    for (int stage = 0; stage < DIP_COST_STAGE_COUNT; stage++) {
        for (int t = 0; t < DIP_COST_MAX_TERMS; t++) {
            scaled.price_ms[stage][t] *= factor;
        }
    }
    const DipCostMisses as_it_is = dip_cost_model_misses(report, model, others, other_count);
    const DipCostMisses with_factor = dip_cost_model_misses(report, &scaled, others, other_count);
    print_misses("with the prices of the first report", &as_it_is);
    printf("  factor from %d rows timed there: %.3f\n", count, factor);
    print_misses("with this factor", &with_factor);
    return true;
}

int main(int argc, char **argv) {
    DipCostModel model = {.rows = 0};
    bool done = argc > 1;
    for (int i = 1; done && i < argc; i++) {
        DipCostReport report;
        DipError err = {0};
        if (!dip_cost_read_json(&report, argv[i], &err)) {
            fprintf(stderr, "%s: %s\n", argv[i], err.message);
            return 2;
        }
        printf("%s: %s, %dx%d, %d threads, path %s, %s\n", argv[i], report.scene, report.width,
               report.height, report.threads, report.paths[0],
               dip_cost_verdict_names[report.verdict]);
        done = i == 1 ? study_own(&report, &model, &err) : study_elsewhere(&report, &model, &err);
        dip_cost_report_free(&report);
    }
    if (!done) {
        fprintf(stderr, "give reports with times and more than %d combinations\n", TRAINED);
    }
    return done ? 0 : 2;
}
