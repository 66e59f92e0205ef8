// Computes the times of a report's rows from its log of timed frames, and the verdict on the
// machine.
#include "app/report/report.h"

#include "app/report/verdict.h"

#include <math.h>
#include <stdlib.h>

// --- the log -------------------------------------------------------------------------------------

void dip_cost_log_clear(DipCostReport *report) {
    free(report->log);
    report->log = NULL;
    report->log_count = 0;
    report->starts = 0;
}

bool dip_cost_log_add(DipCostReport *report, const DipTimes *times, const int *rows,
                      DipError *err) {
    const size_t count = (size_t)report->log_count + (size_t)times->count;
    DipTimed *log = realloc(report->log, (count + 1) * sizeof *log);
    if (!log) {
        return dip_cost_out_of_memory(err);
    }
    int block = 0;
    for (int i = 0; i < report->log_count; i++) {
        block = log[i].block >= block ? log[i].block + 1 : block;
    }
    for (int i = 0; i < times->count; i++) {
        DipTimed *to = &log[report->log_count + i];
        *to = times->list[i];
        to->subject = rows[to->subject];
        to->block += block;
    }
    report->log = log;
    report->log_count = (int)count;
    report->starts = times->starts;
    return true;
}

static DipTimesFit *fit_rows(const DipCostReport *report, DipError *err) {
    int *base_of = malloc(((size_t)report->row_count + 1) * sizeof *base_of);
    if (!base_of) {
        dip_cost_out_of_memory(err);
        return NULL;
    }
    const int starts = report->starts > 0 ? report->starts : 1;
    const DipTimes times = {
        .list = report->log,
        .count = report->log_count,
        .subjects = report->row_count,
        .starts = starts,
        .rounds = report->options.rounds / starts,
        .frames = dip_cost_frame_count(report),
        .base_of = base_of,
        .complete = dip_cost_is_view(report),
    };
    for (int r = 0; r < report->row_count; r++) {
        base_of[r] = report->base_rows[report->rows[r].path];
    }
    DipTimesFit *fit = dip_times_fit(&times, err);
    free(base_of);
    return fit;
}

// --- rows ----------------------------------------------------------------------------------------

// Widens an interval by the doubt that an amber verdict on the machine adds.
static DipEstimate doubted(const DipCostReport *report, DipEstimate estimate) {
    return report->doubt > 0.0 ? dip_estimate_widen(&estimate, report->doubt) : estimate;
}

DipEstimate dip_cost_ratio(const DipCostReport *report, int row, int base) {
    return doubted(report, dip_times_ratio_of(report->fit, row, base));
}

// Computes how a mean time divides into the stages. If the log came from a file, its times have no
// parts, and the stages keep the times that the file has.
static void divide_into_stages(const DipTimesFit *fit, int subject, double mean_ms,
                               double stage_ms[DIP_COST_STAGE_COUNT]) {
    const double *shares = dip_times_shares(fit, subject);
    double all = 0.0;
    for (int i = 0; i < DIP_TIMED_PARTS; i++) {
        all += shares[i];
    }
    for (int i = 0; all > 0.0 && i < DIP_COST_STAGE_COUNT; i++) {
        stage_ms[i] = mean_ms * (i < DIP_TIMED_PARTS ? shares[i] : fmax(1.0 - all, 0.0));
    }
}

void dip_cost_estimate_elsewhere(const DipCostReport *report, const DipTimesFit *fit, int subject,
                                 DipCostElsewhere *row) {
    const DipEstimate level = report->rows[report->base_rows[0]].time.mean_ms;
    const DipEstimate ratio = dip_times_ratio(fit, subject);
    row->ms = dip_estimate_make(ratio.value * level.value, hypot(ratio.log_error, level.log_error),
                                ratio.degrees);
    divide_into_stages(fit, subject, row->ms.value, row->stage_ms);
}

// Returns the part of an estimate's error that does not come from the error of the baseline's mean
// time (DipPathEstimate.level_error); 0 if there is no such part.
static double without_level(DipEstimate estimate, double level_error) {
    const double own = estimate.log_error * estimate.log_error - level_error * level_error;
    return own > 0.0 ? sqrt(own) : 0.0;
}

static void estimate_row(DipCostReport *report, int r) {
    DipCostRow *row = &report->rows[r];
    const DipAlong along = dip_times_along(report->fit, r);
    const int base = report->base_rows[row->path];
    row->time = (DipPathEstimate){
        .ratio = dip_cost_ratio(report, r, base),
        .mean_ms = doubted(report, along.mean_ms),
        .p95_ms = doubted(report, along.p95_ms),
        .worst_ms = doubted(report, along.worst_ms),
        .ratio_error = without_level(doubted(report, dip_times_ratio(report->fit, r)), 0.0),
        .p95_error = without_level(doubted(report, along.p95_ms), along.level_error),
        .worst_error = without_level(doubted(report, along.worst_ms), along.level_error),
        .level_error = along.level_error,
        .used = along.kept,
    };
    divide_into_stages(report->fit, r, row->time.mean_ms.value, row->stage_ms);
}

static void estimate_all(DipCostReport *report) {
    for (int r = 0; r < report->row_count; r++) {
        estimate_row(report, r);
    }
    for (int s = 0; s < report->sweep_count; s++) {
        DipCostSweep *sweep = &report->sweeps[s];
        for (int i = 0; i < sweep->row_count; i++) {
            sweep->ratios[i] = dip_cost_ratio(report, sweep->rows[i], sweep->base);
        }
    }
}

bool dip_cost_estimate_times(DipCostReport *report, DipError *err) {
    dip_times_fit_free(&report->fit);
    report->fit = fit_rows(report, err);
    if (!report->fit) {
        return false;
    }
    dip_cost_judge_machine(report);
    estimate_all(report);
    return dip_cost_choose(report, err);
}
