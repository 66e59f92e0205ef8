// Allocates the memory of a report, finds its rows, and computes errors from its measurements.
#include "app/report/report.h"

#include "app/measure/metrics/truth.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *const dip_cost_picture_kind_names[3] = {
    [DIP_COST_PICTURES_CROPS] = "crops",
    [DIP_COST_PICTURES_FULL] = "full",
    [DIP_COST_PICTURES_NONE] = "none",
};

const char *const dip_cost_stage_names[DIP_COST_STAGE_COUNT] = {
#define STAGE_NAME(name, text) #name,
    DIP_STAGE_LIST(STAGE_NAME)
#undef STAGE_NAME
        "rest",
};

static bool alloc_row(const DipCostReport *report, DipCostRow *row) {
    const size_t viewpoints = (size_t)report->options.places;
    row->viewpoints = calloc(viewpoints, sizeof *row->viewpoints);
    row->tails = calloc(viewpoints, sizeof *row->tails);
    row->judged = calloc(viewpoints, sizeof *row->judged);
    row->pictures = calloc(viewpoints, sizeof *row->pictures);
    return row->viewpoints && row->tails && row->judged && row->pictures;
}

bool dip_cost_report_alloc(DipCostReport *report, DipError *err) {
    const size_t viewpoints = (size_t)report->options.places;
    report->floors = calloc((size_t)report->path_count * viewpoints, sizeof *report->floors);
    report->has_floor = calloc((size_t)report->path_count * viewpoints, sizeof *report->has_floor);
    bool made = report->floors && report->has_floor;
    for (int r = 0; r < report->row_count; r++) {
        made = alloc_row(report, &report->rows[r]) && made;
    }
    return made || dip_cost_out_of_memory(err);
}

int dip_cost_report_add_row(DipCostReport *report, const DipQuality *quality, int path,
                            DipError *err) {
    if (report->row_count == DIP_COST_MAX_ROWS) {
        dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "cost", "there are more than %d rows",
                      DIP_COST_MAX_ROWS);
        return -1;
    }
    // The row is freed with the report, even if this function fails.
    DipCostRow *row = &report->rows[report->row_count++];
    *row = (DipCostRow){.quality = *quality, .path = path};
    if (!alloc_row(report, row)) {
        dip_cost_out_of_memory(err);
        return -1;
    }
    return report->row_count - 1;
}

int dip_report_find(const DipCostReport *report, const DipQuality *quality, int path, int first) {
    for (int r = first; r < report->row_count; r++) {
        if (report->rows[r].path == path && dip_quality_equal(&report->rows[r].quality, quality)) {
            return r;
        }
    }
    return -1;
}

int dip_report_find_same(const DipCostReport *report, const DipQuality *quality, int first) {
    const int row = dip_report_find(report, quality, 0, first);
    for (int i = 0; row < 0 && i < report->same_count; i++) {
        if (dip_quality_equal(&report->same[i].quality, quality)) {
            return report->same[i].row;
        }
    }
    return row;
}

int dip_report_find_predicted(const DipCostPredictions *predicted, const DipQuality *quality) {
    for (int i = 0; i < predicted->count; i++) {
        if (dip_quality_equal(&predicted->list[i].quality, quality)) {
            return i;
        }
    }
    return -1;
}

void dip_cost_row_free(DipCostRow *row) {
    free(row->viewpoints);
    free(row->tails);
    free(row->judged);
    free(row->pictures);
    *row = (DipCostRow){0};
}

static bool has_warning(const DipCostReport *report, int count, const DipError *warning) {
    for (int i = 0; i < count; i++) {
        const DipError *known = &report->warnings[i];
        if (known->line == warning->line && strcmp(known->file, warning->file) == 0 &&
            strcmp(known->key, warning->key) == 0 &&
            strcmp(known->message, warning->message) == 0) {
            return true;
        }
    }
    return false;
}

bool dip_cost_report_add_warnings(DipCostReport *report, const DipError *warnings, int count,
                                  DipError *err) {
    const int before = report->warning_count;
    DipError *grown =
        realloc(report->warnings, ((size_t)before + (size_t)count + 1) * sizeof *grown);
    if (!grown) {
        return dip_cost_out_of_memory(err);
    }
    report->warnings = grown;
    for (int i = 0; i < count; i++) {
        DipError warning = warnings[i];
        const char *slash = strrchr(warning.file, '/');
        if (slash) {
            memmove(warning.file, slash + 1, strlen(slash));
        }
        if (has_warning(report, before, &warning)) {
            continue;
        }
        if (report->warning_count < DIP_COST_MAX_WARNINGS) {
            report->warnings[report->warning_count++] = warning;
        } else {
            report->warnings_left_out++;
        }
    }
    return true;
}

void dip_cost_report_free(DipCostReport *report) {
    for (int r = 0; r < report->row_count; r++) {
        dip_cost_row_free(&report->rows[r]);
    }
    free(report->same);
    free(report->rows);
    free(report->floors);
    free(report->has_floor);
    free(report->predicted.list);
    free(report->warnings);
    dip_cost_choice_free(&report->choice);
    free(report->analysis);
    dip_times_fit_free(&report->fit);
    free(report->log);
    *report = (DipCostReport){0};
}

void dip_cost_sweep_title(const DipCostReport *report, const DipCostSweep *sweep,
                          char text[DIP_COST_TEXT]) {
    const DipSettingInfo *info = dip_setting_info(sweep->setting);
    DipQuality others = report->rows[sweep->base].quality;
    char with[DIP_COST_TEXT];
    others.step[sweep->setting] = (uint8_t)info->default_step;
    dip_cost_settings_text(&others, with);
    const bool has_others = dip_quality_count_changes(&others) > 0;
    snprintf(text, DIP_COST_TEXT, "%s%s%.100s", info->title, has_others ? " with " : "",
             has_others ? with : "");
}

void dip_cost_step_text(const DipCostReport *report, const DipCostSweep *sweep, int row,
                        char text[DIP_COST_TEXT]) {
    const DipQuality *q = &report->rows[row].quality;
    const DipSettingInfo *info = dip_setting_info(sweep->setting);
    const char *step = info->steps[q->step[sweep->setting]];
    if (sweep->setting == DIP_SETTING_AAA && q->step[DIP_SETTING_AAA] >= DIP_AAA_ON) {
        snprintf(text, DIP_COST_TEXT, "%s, asd=%s", step,
                 dip_setting_info(DIP_SETTING_ASD)->steps[q->step[DIP_SETTING_ASD]]);
    } else {
        snprintf(text, DIP_COST_TEXT, "%s", step);
    }
}

void dip_cost_level_text(const DipCostReport *report, char text[DIP_COST_REASON]) {
    char spread[160] = "one start of the program does not tell by how much", widened[160] = "";
    const double error =
        report->row_count > 0 ? report->rows[report->base_rows[0]].time.level_error : NAN;
    const double student = dip_student_quantile(0.975, report->starts > 1 ? report->starts - 1 : 1);
    if (report->starts > 1 && exp(student * error) > 2.0) {
        snprintf(spread, sizeof spread, "its %d starts lie too far apart to tell by how much",
                 report->starts);
    } else if (report->starts > 1 && error > 0.0) {
        snprintf(spread, sizeof spread, "by how its %d starts lie apart, by up to %.1f %%",
                 report->starts, 100.0 * (exp(student * error) - 1.0));
    }
    if (report->doubt > 0.0) {
        snprintf(widened, sizeof widened,
                 " All intervals of times were widened by what the machine's unrest showed, %.1f "
                 "%%.",
                 100.0 * (exp(report->doubt) - 1.0));
    }
    snprintf(text, DIP_COST_REASON,
             "Milliseconds are those of this run: in another, all may be higher or lower together "
             "(%s). Ratios do not share this.%s",
             spread, widened);
}

// --- errors --------------------------------------------------------------------------------------

DipMetricSums dip_cost_row_sums(const DipCostReport *report, int row, int *viewpoints) {
    DipMetricSums sums = {0};
    *viewpoints = 0;
    for (int p = 0; p < report->options.places; p++) {
        if (report->rows[row].judged[p]) {
            dip_metric_sums_add(&sums, &report->rows[row].viewpoints[p]);
            ++*viewpoints;
        }
    }
    return sums;
}

bool dip_cost_is_judged(const DipCostReport *report, int row) {
    int viewpoints;
    dip_cost_row_sums(report, row, &viewpoints);
    return viewpoints > 0;
}

DipMetrics dip_cost_row_metrics(const DipCostReport *report, int row) {
    int viewpoints;
    const DipMetricSums sums = dip_cost_row_sums(report, row, &viewpoints);
    return dip_metrics_of(&sums, 0);
}

DipCostTail dip_cost_row_tail(const DipCostReport *report, int row) {
    DipCostTail tail = {.viewpoints = 0};
    DipFlipTail sum = {.p50 = 0.0};
    for (int p = 0; p < report->options.places; p++) {
        const DipFlipTail *flip = &report->rows[row].tails[p];
        if (!report->rows[row].judged[p] || flip->worst_width == 0.0) {
            continue;
        }
        sum.p50 += flip->p50;
        sum.p95 += flip->p95;
        sum.p99 += flip->p99;
        if (tail.viewpoints++ == 0 || flip->worst > tail.flip.worst) {
            tail.flip = *flip;
            tail.worst_viewpoint = p;
        }
    }
    if (tail.viewpoints > 0) {
        tail.flip.p50 = sum.p50 / tail.viewpoints;
        tail.flip.p95 = sum.p95 / tail.viewpoints;
        tail.flip.p99 = sum.p99 / tail.viewpoints;
    }
    return tail;
}

DipMetricSums dip_cost_floor(const DipCostReport *report, int path) {
    DipMetricSums sums = {0};
    for (int p = 0; p < report->options.places; p++) {
        if (report->has_floor[path * report->options.places + p]) {
            dip_metric_sums_add(&sums, &report->floors[path * report->options.places + p]);
        }
    }
    return sums;
}

bool dip_cost_at_floor(const DipCostReport *report, int row) {
    int viewpoints;
    const DipMetricSums sums = dip_cost_row_sums(report, row, &viewpoints);
    const DipMetricSums floor = dip_cost_floor(report, report->rows[row].path);
    return dip_truth_hides(&floor, &sums);
}

double dip_cost_floor_flip(const DipCostReport *report, int path) {
    const DipMetricSums sums = dip_cost_floor(report, path);
    return pow(0.5, 0.7) * dip_metrics_of(&sums, 0).flip;
}

double dip_cost_ranking_flip(const DipCostReport *report, int row) {
    return fmax(dip_cost_row_metrics(report, row).flip,
                dip_cost_floor_flip(report, report->rows[row].path));
}
