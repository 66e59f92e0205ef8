// Turns a report's times and errors into text.
#include "app/preview/prices/costs.h"

#include "app/report/candidates.h"
#include "app/report/format/formats.h"
#include "app/report/words.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static double flip_of(const DipCostReport *report, int row) {
    int places;
    const DipMetricSums sums = dip_cost_row_sums(report, row, &places);
    return places > 0 ? dip_metrics_of(&sums, 0).flip : NAN;
}

static void make_step(DipCostsStep *step, const DipCostReport *report, const DipCostSweep *sweep,
                      int index) {
    const int row = sweep->rows[index];
    char name[DIP_COST_TEXT], flip[DIP_NUMBER_BYTES];
    const double base_flip = flip_of(report, sweep->base);
    const bool is_base = row == sweep->base;
    dip_cost_step_text(report, sweep, row, name);
    *step = (DipCostsStep){.quality = report->rows[row].quality,
                           .flip_change = is_base ? 0.0 : flip_of(report, row) - base_flip};
    if (is_base) {
        snprintf(step->time, sizeof step->time, "1x");
    } else if (dip_cost_is_timed(report, row) && dip_cost_is_timed(report, sweep->base)) {
        snprintf(step->time, sizeof step->time, "%.2fx", sweep->ratios[index].value);
    }
    const double shown = is_base ? base_flip : step->flip_change;
    if (!isnan(shown)) {
        dip_flip_number(shown, !is_base, "-", flip);
        snprintf(step->flip, sizeof step->flip, "%.15s", flip);
    }
    snprintf(step->figures, sizeof step->figures, "%.14s%s%.15s", step->time,
             step->time[0] && step->flip[0] ? " " : "", step->flip);
    snprintf(step->name, sizeof step->name, "%.23s", name);
}

static void make_row(DipCostsRow *row, const DipCostReport *report, const DipCostSweep *sweep) {
    char title[DIP_COST_TEXT];
    dip_cost_sweep_title(report, sweep, title);
    snprintf(row->title, sizeof row->title, "%.47s", title);
    row->setting = sweep->setting;
    row->step_count = sweep->row_count;
    for (int i = 0; i < sweep->row_count; i++) {
        make_step(&row->steps[i], report, sweep, i);
    }
}

bool dip_costs_make(DipCosts *costs, const DipCostReport *report, DipError *err) {
    *costs = (DipCosts){.base = report->options.baseline};
    snprintf(costs->heading, sizeof costs->heading, "%.80s, %dx%d, %d thread%s, %s", report->scene,
             report->width, report->height, report->threads, report->threads == 1 ? "" : "s",
             report->isa);
    costs->width = report->width;
    costs->height = report->height;
    snprintf(costs->path, sizeof costs->path, "%s", report->paths[0]);
    for (int i = 0; i < report->sweep_count; i++) {
        make_row(&costs->rows[costs->row_count++], report, &report->sweeps[i]);
    }
    costs->budget_count = report->options.budget_count;
    memcpy(costs->budgets_ms, report->options.budgets_ms, sizeof costs->budgets_ms);
    return report->rounds == 0 ||
           dip_candidates_of(report, report->options.budget_of, &costs->candidates, err);
}

void dip_costs_free(DipCosts *costs) {
    dip_candidates_free(&costs->candidates);
}

bool dip_costs_load(DipCosts *costs, DipPrices *prices, const char *file, const char *scene,
                    DipError *err) {
    DipCostReport report;
    *costs = (DipCosts){0};
    if (!dip_cost_read_json(&report, file, err)) {
        return false;
    }
    bool fits = strcmp(report.scene, scene) == 0 ||
                dip_error_set(err, DIP_ERROR_CONFLICT, file, 0, "--cost",
                              "is a report of %s, accepted a report of %s", report.scene, scene);
    fits = fits && dip_costs_make(costs, &report, err) &&
           (!prices || dip_prices_set_report(prices, &report, err));
    dip_cost_report_free(&report);
    return fits;
}

// The report measures the steps of adaptive AA with one number of samples, so the pane must have
// the same number of samples.
bool dip_costs_is_at(const DipCostsRow *row, int step, const DipQuality *quality) {
    const DipQuality *at = &row->steps[step].quality;
    const bool adaptive = row->setting == DIP_SETTING_AAA || row->setting == DIP_SETTING_ASD;
    const bool on = quality->step[DIP_SETTING_AAA] != 0;
    return quality->step[row->setting] == at->step[row->setting] &&
           (!adaptive || (quality->step[DIP_SETTING_AA] == at->step[DIP_SETTING_AA] &&
                          (!on || quality->step[DIP_SETTING_ASD] == at->step[DIP_SETTING_ASD])));
}
