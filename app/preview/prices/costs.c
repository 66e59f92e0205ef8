// Turns a report's times and errors into text.
#include "app/preview/prices/costs.h"

#include "app/report/format/formats.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double default_budget_ms = 16.6;

// Writes a FLIP value, or a change of FLIP with its sign. Omits the zero before the decimal point.
static void format_flip(double flip, bool change, char text[24]) {
    char digits[16];
    snprintf(digits, sizeof digits, "%.4f", fabs(flip));
    snprintf(text, 24, "%s%s",
             !change      ? ""
             : flip < 0.0 ? "-"
                          : "+",
             digits[0] == '0' ? digits + 1 : digits);
}

static double flip_of(const DipCostReport *report, int row) {
    int places;
    const DipMetricSums sums = dip_cost_row_sums(report, row, &places);
    return places > 0 ? dip_metrics_of(&sums, 0).flip : NAN;
}

static void make_step(DipCostsStep *step, const DipCostReport *report, const DipCostSweep *sweep,
                      int index) {
    const int row = sweep->rows[index];
    char name[DIP_COST_TEXT], ratio[24] = "", flip[24] = "";
    const double base_flip = flip_of(report, sweep->base);
    const bool is_base = row == sweep->base;
    dip_cost_step_text(report, sweep, row, name);
    if (is_base) {
        snprintf(ratio, sizeof ratio, "1x ");
    } else if (dip_cost_is_timed(report, row) && dip_cost_is_timed(report, sweep->base)) {
        snprintf(ratio, sizeof ratio, "%.2fx ", sweep->ratios[index].value);
    }
    const double shown = is_base ? base_flip : flip_of(report, row) - base_flip;
    if (!isnan(shown)) {
        format_flip(shown, !is_base, flip);
    }
    step->quality = report->rows[row].quality;
    snprintf(step->name, sizeof step->name, "%.23s", name);
    snprintf(step->figures, sizeof step->figures, "%s%s", ratio, flip);
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

// Makes advice from row `row` of the report, a measured combination; a negative row means that no
// combination was found. If the combination was measured again, `ms` is its new time. If `ms` is 0,
// the report's time of the row is used.
static DipCostsAdvice advice_of(const DipCostReport *report, double budget_ms, int row, double ms) {
    if (row < 0) {
        return (DipCostsAdvice){.budget_ms = budget_ms};
    }
    return (DipCostsAdvice){budget_ms, true, report->rows[row].quality,
                            ms > 0.0 ? ms : dip_cost_ms(report, row), flip_of(report, row)};
}

static int choose(const DipCostReport *report, double budget_ms) {
    const bool believed = report->rounds > 0 && report->verdict != DIP_COST_RED;
    return believed ? dip_cost_choose(report, budget_ms) : -1;
}

static void make_advice(DipCosts *costs, const DipCostReport *report) {
    for (int i = 0; i < report->advice_count; i++) {
        const DipCostAdvice *advice = &report->advice[i];
        costs->advice[costs->advice_count++] =
            advice_of(report, advice->budget_ms, advice->row, advice->ms);
    }
    if (report->advice_count == 0) {
        costs->advice[costs->advice_count++] =
            advice_of(report, default_budget_ms, choose(report, default_budget_ms), 0.0);
    }
    const DipQuality *baseline = &report->options.baseline;
    for (int r = report->combined_first; r < report->row_count; r++) {
        if (memcmp(&report->rows[r].quality, baseline, sizeof *baseline) == 0 &&
            dip_cost_is_timed(report, r)) {
            costs->baseline = advice_of(report, 0.0, r, 0.0);
        }
    }
}

static int compare_points(const void *a, const void *b) {
    const DipCostsPoint *p = a;
    const DipCostsPoint *q = b;
    return (p->ms > q->ms) - (p->ms < q->ms);
}

// Collects the combinations with a time and an error, and marks those on the front: in order of
// time, each has a lower error than all before it.
static void make_points(DipCosts *costs, const DipCostReport *report) {
    for (int r = report->combined_first; r < report->row_count; ++r) {
        const double flip = flip_of(report, r);
        const bool measured = report->rounds > 0 && dip_cost_is_timed(report, r) && !isnan(flip);
        costs->combination_count += measured;
        if (measured && costs->point_count < DIP_COSTS_MAX_POINTS) {
            costs->points[costs->point_count++] =
                (DipCostsPoint){report->rows[r].quality, dip_cost_ms(report, r), flip, false};
        }
    }
    qsort(costs->points, (size_t)costs->point_count, sizeof costs->points[0], compare_points);
    double least_flip = INFINITY;
    for (int i = 0; i < costs->point_count; ++i) {
        costs->points[i].on_front = costs->points[i].flip < least_flip;
        least_flip = fmin(least_flip, costs->points[i].flip);
    }
}

int dip_costs_front_step(const DipCosts *costs, double ms, int direction) {
    const int count = costs->point_count;
    for (int i = 0; i < count; ++i) {
        const int at = direction > 0 ? i : count - 1 - i;
        const DipCostsPoint *point = &costs->points[at];
        if (point->on_front && (direction > 0 ? point->ms > ms : point->ms < ms)) {
            return at;
        }
    }
    return -1;
}

void dip_costs_make(DipCosts *costs, const DipCostReport *report) {
    *costs = (DipCosts){0};
    snprintf(costs->heading, sizeof costs->heading, "%.80s, %dx%d, %d thread%s, %s", report->scene,
             report->width, report->height, report->threads, report->threads == 1 ? "" : "s",
             report->isa);
    costs->width = report->width;
    costs->height = report->height;
    snprintf(costs->path, sizeof costs->path, "%s", report->paths[0]);
    make_points(costs, report);
    for (int i = 0; i < report->sweep_count; i++) {
        make_row(&costs->rows[costs->row_count++], report, &report->sweeps[i]);
    }
    make_advice(costs, report);
}

bool dip_costs_load(DipCosts *costs, DipPrices *prices, const char *file, const char *scene,
                    DipError *err) {
    DipCostReport report;
    if (!dip_cost_read_json(&report, file, err)) {
        return false;
    }
    bool fits = strcmp(report.scene, scene) == 0 ||
                dip_error_set(err, DIP_ERROR_CONFLICT, file, 0, "--cost",
                              "is a report of %s, accepted a report of %s", report.scene, scene);
    if (fits) {
        dip_costs_make(costs, &report);
        fits = !prices || dip_prices_set_report(prices, &report, err);
    }
    dip_cost_report_free(&report);
    return fits;
}

void dip_costs_describe(const DipCosts *costs, int index, char *text, size_t size_bytes) {
    const DipCostsAdvice *advice = &costs->advice[index];
    char flip[24], base_flip[24], base[64] = "";
    if (!advice->found) {
        snprintf(text, size_bytes, "Nothing measured is within %.4g ms", advice->budget_ms);
        return;
    }
    format_flip(advice->flip, false, flip);
    if (costs->baseline.found) {
        format_flip(costs->baseline.flip, false, base_flip);
        snprintf(base, sizeof base, "; baseline %.1f ms, %s", costs->baseline.ms, base_flip);
    }
    snprintf(text, size_bytes, "Within %.4g ms: %.1f ms, FLIP %s%s", advice->budget_ms, advice->ms,
             flip, base);
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
