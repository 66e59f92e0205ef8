// Reads a cost report, and turns its times and errors into texts.
#include "app/preview/prices/costs.h"

#include "app/preview/prices/price_text.h"
#include "app/report/format/formats.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static double flip_of(const DipCostReport *report, int row) {
    int places;
    const DipMetricSums sums = dip_cost_row_sums(report, row, &places);
    return places > 0 ? dip_metrics_of(&sums, 0).flip : NAN;
}

// Returns whether a step's time is doubtful by the rule for prices (dip_price_trust).
static bool is_doubtful(const DipCostReport *report, const DipCostSweep *sweep, int index) {
    const DipEstimate *ratio = &sweep->ratios[index];
    const double base_ms = dip_cost_ms(report, sweep->base);
    const DipPrice price = {.state = DIP_PRICE_MEASURED,
                            .ms = base_ms * (ratio->value - 1.0),
                            .ms_low = base_ms * (ratio->low - 1.0),
                            .ms_high = base_ms * (ratio->high - 1.0),
                            .without_ms = base_ms,
                            .doubtful = report->verdict == DIP_COST_RED};
    return dip_price_trust(&price) == DIP_PRICE_TRUST_DOUBTFUL;
}

static void make_step(DipCostsStep *step, const DipCostReport *report, const DipCostSweep *sweep,
                      int index) {
    const int row = sweep->rows[index];
    char name[DIP_COST_TEXT], flip[DIP_STEP_NAME_BYTES];
    const double base_flip = flip_of(report, sweep->base);
    const bool is_base = row == sweep->base;
    dip_cost_step_text(report, sweep, row, name);
    *step = (DipCostsStep){.quality = report->rows[row].quality,
                           .flip_change = is_base ? 0.0 : flip_of(report, row) - base_flip};
    if (is_base) {
        snprintf(step->time, sizeof step->time, "1x");
    } else if (dip_cost_is_timed(report, row) && dip_cost_is_timed(report, sweep->base)) {
        char ratio[DIP_NUMBER_BYTES];
        dip_ratio_number(sweep->ratios[index].value, is_doubtful(report, sweep, index), ratio);
        snprintf(step->time, sizeof step->time, "%.14sx", ratio);
    }
    const double shown = is_base ? base_flip : step->flip_change;
    if (!isnan(shown)) {
        dip_flip_text(shown, !is_base, flip);
        snprintf(step->flip, sizeof step->flip, "%.15s", flip);
    }
    snprintf(step->figures, sizeof step->figures, "%.14s%s%.15s", step->time,
             step->time[0] && step->flip[0] ? " " : "", step->flip);
    snprintf(step->name, sizeof step->name, "%.23s", name);
}

DipCostsRow dip_costs_row(const DipCostReport *report, const DipCostSweep *sweep) {
    DipCostsRow row = {.setting = sweep->setting, .step_count = sweep->row_count};
    char title[DIP_COST_TEXT];
    dip_cost_sweep_title(report, sweep, title);
    snprintf(row.title, sizeof row.title, "%.47s", title);
    for (int i = 0; i < sweep->row_count; i++) {
        make_step(&row.steps[i], report, sweep, i);
    }
    return row;
}

void dip_costs_heading(const DipCostReport *report, char text[DIP_COSTS_HEADING]) {
    snprintf(text, DIP_COSTS_HEADING, "%.80s, %dx%d, %d thread%s, %s", report->scene, report->width,
             report->height, report->threads, report->threads == 1 ? "" : "s", report->isa);
}

static bool read_report(DipCostReport *report, DipPrices *prices, const char *file,
                        const char *scene, DipError *err) {
    return dip_cost_read_report(file, report, err) &&
           (strcmp(report->scene, scene) == 0 ||
            dip_error_set(err, DIP_ERROR_CONFLICT, file, 0, "--cost",
                          "is a report of %s, accepted a report of %s", report->scene, scene)) &&
           (!prices || dip_prices_set_report(prices, report, err));
}

DipCostReport *dip_costs_load(DipPrices *prices, const char *file, const char *scene,
                              DipError *err) {
    DipCostReport *report = calloc(1, sizeof *report);
    if (!report) {
        dip_error_set(err, DIP_ERROR_MEMORY, file, 0, "--cost", "out of memory");
    } else if (!read_report(report, prices, file, scene, err)) {
        dip_costs_free(&report);
    }
    return report;
}

void dip_costs_free(DipCostReport **report) {
    if (*report) {
        dip_cost_report_free(*report);
        free(*report);
        *report = NULL;
    }
}

// A report measures all steps of adaptive AA with the same number of samples. A pane has such a
// step only if it also has this number of samples and, while adaptive AA is on, the same group
// size.
bool dip_costs_is_at(const DipCostsRow *row, int step, const DipQuality *quality) {
    const DipQuality *at = &row->steps[step].quality;
    const bool adaptive = row->setting == DIP_SETTING_AAA || row->setting == DIP_SETTING_ASD;
    const bool on = quality->step[DIP_SETTING_AAA] >= DIP_AAA_ON;
    return quality->step[row->setting] == at->step[row->setting] &&
           (!adaptive || (quality->step[DIP_SETTING_AA] == at->step[DIP_SETTING_AA] &&
                          (!on || quality->step[DIP_SETTING_ASD] == at->step[DIP_SETTING_ASD])));
}
