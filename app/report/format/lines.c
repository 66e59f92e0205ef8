// Lists rows of a cost report as lines of tables (lines.h), and derives the fields of a line.
#include "app/report/format/lines.h"

#include <math.h>
#include <stdio.h>

// --- fields --------------------------------------------------------------------------------------

static const DipCostReport *report_of(const DipFieldAt *at) {
    return at->context;
}

static const DipCostLine *line_of(const DipFieldAt *at) {
    return at->item;
}

DIP_OF_ITEM(bool, has_times,
            line_of(at)->row >= 0 && dip_cost_is_timed(report_of(at), line_of(at)->row))

// Returns how much longer the line's candidate takes than the previous candidate on the front.
static double change_ms(const DipCostLine *line) {
    return line->candidate->time.value - line->before->time.value;
}

DIP_DERIVE(derive_kind, line_of(at)->kind)
DIP_DERIVE(derive_path, report_of(at)->paths[line_of(at)->path])
DIP_DERIVE(derive_settings, line_of(at)->quality)
DIP_DERIVE(derive_row, line_of(at)->row >= 0 ? &report_of(at)->rows[line_of(at)->row] : NULL)
DIP_DERIVE(derive_predicted, line_of(at)->prediction)
DIP_DERIVE(derive_report, report_of(at))
DIP_DERIVE(derive_change_ms, line_of(at)->before ? DIP_MADE(double, change_ms(line_of(at))) : NULL)

static const void *derive_ratio(const DipFieldAt *at, DipFieldScratch *scratch) {
    const DipCostLine *line = at->item;
    (void)scratch;
    return !has_times(at) ? NULL
           : line->sweep  ? &line->sweep->ratios[line->step]
                          : &report_of(at)->rows[line->row].time.ratio;
}

static const void *derive_price_ms(const DipFieldAt *at, DipFieldScratch *scratch) {
    const DipCostLine *line = at->item;
    if (!line->before || line->candidate->loss <= 0.0) {
        return NULL;
    }
    const double percent = 100.0 * log(line->before->loss / line->candidate->loss);
    return DIP_MADE(double, change_ms(line) / percent);
}

static const void *derive_time_miss(const DipFieldAt *at, DipFieldScratch *scratch) {
    const DipCostPrediction *of = line_of(at)->prediction;
    return of && has_times(at)
               ? DIP_MADE(double, of->ms / dip_cost_ms(report_of(at), line_of(at)->row) - 1.0)
               : NULL;
}

static const void *derive_title(const DipFieldAt *at, DipFieldScratch *scratch) {
    const DipCostLine *line = at->item;
    if (!line->sweep) {
        return line->number > 0 ? "Pareto front" : *line->kind == 'a' ? "the baseline twice" : "";
    }
    dip_cost_sweep_title(report_of(at), line->sweep, scratch->text);
    return scratch->text;
}

static const void *derive_step(const DipFieldAt *at, DipFieldScratch *scratch) {
    const DipCostLine *line = at->item;
    char step[DIP_COST_TEXT];
    if (!line->sweep) {
        return NULL;
    }
    dip_cost_step_text(report_of(at), line->sweep, line->row, step);
    snprintf(scratch->text, sizeof scratch->text, "%s%s", step,
             line->row == line->sweep->base ? " (baseline)" : "");
    return scratch->text;
}

static const void *derive_name(const DipFieldAt *at, DipFieldScratch *scratch) {
    const DipCostLine *line = at->item;
    char title[DIP_COST_TEXT], step[DIP_COST_TEXT];
    if (!line->sweep) {
        return NULL;
    }
    dip_cost_sweep_title(report_of(at), line->sweep, title);
    dip_cost_step_text(report_of(at), line->sweep, line->row, step);
    snprintf(scratch->text, sizeof scratch->text, "%s: %s", title, step);
    return scratch->text;
}

static const void *derive_number(const DipFieldAt *at, DipFieldScratch *scratch) {
    const DipCostLine *line = at->item;
    const int knee = report_of(at)->choice.knee;
    snprintf(scratch->text, sizeof scratch->text, "%d%s", line->number,
             knee >= 0 && line->number == knee + 1 ? ", knee" : "");
    return line->number > 0 ? scratch->text : NULL;
}

static const void *derive_time(const DipFieldAt *at, DipFieldScratch *scratch) {
    const DipCandidate *candidate = ((const DipCostLine *)at->item)->candidate;
    return candidate ? DIP_MADE(DipEstimate,
                                dip_estimate_widen(&candidate->time, candidate->common_error))
                     : NULL;
}

// Derives the change of FLIP from the previous candidate on the front. FLIP differs more between
// viewpoints than between settings, so the interval is computed from the change at each viewpoint.
static const void *derive_change_flip(const DipFieldAt *at, DipFieldScratch *scratch) {
    const DipCostLine *line = at->item;
    return line->before
               ? DIP_MADE(DipEstimate, dip_cost_metric_change(report_of(at), line->row,
                                                              line->before->row, DIP_COST_FLIP))
               : NULL;
}

static const void *derive_flip_miss(const DipFieldAt *at, DipFieldScratch *scratch) {
    const DipCostLine *line = at->item;
    if (!line->prediction || line->row < 0) {
        return NULL;
    }
    const double flip = dip_cost_row_metrics(report_of(at), line->row).flip;
    return flip > 0.0 ? DIP_MADE(double, line->prediction->flip / flip - 1.0) : NULL;
}

static const void *derive_floor(const DipFieldAt *at, DipFieldScratch *scratch) {
    const DipCostLine *line = at->item;
    return line->row >= 0 ? DIP_MADE(DipMetrics, dip_cost_floor_metrics(report_of(at), line->path))
                          : NULL;
}

#define RECORD(function, record_of)                                                                \
    .kind = DIP_FIELD_RECORD, .derive = function, .record = record_of
static const DipField line_fields[] = {
    {"kind", NULL, NULL, "\"a/a\", \"step\", \"combination\" or \"predicted\".",
     DIP_DERIVED(TEXT, derive_kind)},
    {"title", "row of", NULL, "The sweep of a step.", DIP_DERIVED(TEXT, derive_title)},
    {"path", NULL, NULL, "The camera path.", DIP_DERIVED(TEXT, derive_path)},
    {"settings", NULL, NULL, "All quality settings.", DIP_DERIVED(SETTINGS, derive_settings)},
    {"step", NULL, NULL, "The step's name.", DIP_DERIVED(TEXT, derive_step)},
    {"name", "step", NULL, "The sweep and the step.", DIP_DERIVED(TEXT, derive_name)},
    {"ratio", NULL, NULL, "The time divided by that of the sweep's base, or of the baseline.",
     DIP_DERIVED(ESTIMATE, derive_ratio), .show = DIP_SHOW_OF_TIMES, .digits = 3},
    {"number", NULL, NULL, "The place on the front.", DIP_DERIVED(TEXT, derive_number)},
    {"time", NULL, "ms", "The time that budgets are meant for.", DIP_DERIVED(ESTIMATE, derive_time),
     .digits = 2},
    {"change_ms", "more time", "ms", "The time less that of the line before.",
     DIP_DERIVED(NUMBER, derive_change_ms), .show = DIP_SHOW_SIGN, .digits = 2},
    {"change_flip", "change of FLIP", NULL, "FLIP less that of the line before.",
     DIP_DERIVED(ESTIMATE, derive_change_flip), .show = DIP_SHOW_SIGN, .digits = 4},
    {"price_ms", "1 % less FLIP", "ms", "The time that each 1 % less FLIP costs.",
     DIP_DERIVED(NUMBER, derive_price_ms), .digits = 3},
    {"time_miss", "miss of the time", "%", "Predicted time over the measured one, less 1.",
     DIP_DERIVED(NUMBER, derive_time_miss), .show = DIP_SHOW_SIGN | DIP_SHOW_OF_TIMES, .digits = 1,
     .scale = 100.0},
    {"flip_miss", "miss of FLIP", "%", "Predicted FLIP over the measured one, less 1.",
     DIP_DERIVED(NUMBER, derive_flip_miss), .show = DIP_SHOW_SIGN, .digits = 1, .scale = 100.0},
    {"row", NULL, NULL, "The row.", RECORD(derive_row, &dip_cost_row_record)},
    {"predicted", NULL, NULL, "The prediction.",
     RECORD(derive_predicted, &dip_cost_prediction_of_report_record)},
    {"floor", NULL, NULL, "The noise of the path's truths.",
     RECORD(derive_floor, &dip_cost_metrics_record)},
    {"report", NULL, NULL, "The report.", RECORD(derive_report, &dip_cost_report_record)},
};
const DipRecord dip_cost_line_record =
    DIP_RECORD("line", "A line of cost.csv.", line_fields, DipCostLine, NULL);

// --- lists ---------------------------------------------------------------------------------------

static DipCostLine row_line(const DipCostReport *report, const char *kind, int row) {
    return (DipCostLine){.kind = kind,
                         .row = row,
                         .path = report->rows[row].path,
                         .quality = &report->rows[row].quality};
}

int dip_cost_same_lines(const DipCostReport *report, DipCostLine lines[DIP_COST_MAX_PATHS]) {
    for (int p = 0; p < report->path_count; p++) {
        lines[p] = row_line(report, "a/a", report->same_rows[p]);
    }
    return report->path_count;
}

int dip_cost_floor_lines(const DipCostReport *report, DipCostLine lines[DIP_COST_MAX_PATHS]) {
    for (int p = 0; p < report->path_count; p++) {
        lines[p] = row_line(report, "floor", report->base_rows[p]);
    }
    return report->path_count;
}

int dip_cost_step_lines(const DipCostReport *report, int sweep,
                        DipCostLine lines[DIP_COST_MAX_SWEEP_ROWS]) {
    const DipCostSweep *of = &report->sweeps[sweep];
    for (int i = 0; i < of->row_count; i++) {
        lines[i] = row_line(report, "step", of->rows[i]);
        lines[i].sweep = of;
        lines[i].step = i;
    }
    return of->row_count;
}

int dip_cost_all_step_lines(const DipCostReport *report,
                            DipCostLine lines[DIP_COST_MAX_SWEEPS * DIP_COST_MAX_SWEEP_ROWS]) {
    int count = 0;
    for (int s = 0; s < report->sweep_count; s++) {
        count += dip_cost_step_lines(report, s, lines + count);
    }
    return count;
}

int dip_cost_front_lines(const DipCostReport *report, DipCostLine lines[DIP_COST_MAX_ROWS]) {
    const DipCostChoice *choice = &report->choice;
    for (int i = 0; i < choice->front_count; i++) {
        const DipCandidate *candidate = &choice->candidates.list[choice->front[i]];
        lines[i] = row_line(report, "front", candidate->row);
        lines[i].number = i + 1;
        lines[i].candidate = candidate;
        lines[i].before = i > 0 ? &choice->candidates.list[choice->front[i - 1]] : NULL;
    }
    return choice->front_count;
}

int dip_cost_combination_lines(const DipCostReport *report, DipCostLine lines[DIP_COST_MAX_ROWS]) {
    int count = 0;
    for (int r = report->combined_first; r < report->row_count; r++) {
        lines[count++] = row_line(report, "combination", r);
    }
    return count;
}

DipCostLine dip_cost_prediction_line(const DipCostReport *report, int prediction) {
    const DipCostPrediction *of = &report->predicted.list[prediction];
    return (DipCostLine){
        .kind = "predicted", .row = of->row, .quality = &of->quality, .prediction = of};
}
