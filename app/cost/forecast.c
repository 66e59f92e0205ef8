// Forecasts how long the phases of a run that are still to come will take, so that the progress
// display tells the time left of the whole run.
#include "app/cost/steps.h"

#include "app/cli/progress.h"
#include "app/report/combinations.h"

#include <math.h>

enum {
    RACES = 2,      // How often rows are usually timed again (race in advice.c).
    RACED_ROWS = 4, // Usual number of rows that are timed again each time.
    GOES = 4,       // Usual number of goes in which best combinations are measured (best.c).
    GO_ROWS = 8     // Usual number of combinations that are measured in a go.
};

// These values stand in for measurements that have not been made yet.
static const double row_ratio = 2.5;    // Time of a row's frame over that of the baseline's frame.
static const double judging_ns = 600.0; // Time in which a thread judges a pixel.
static const double start_s = 0.5;      // Time of a start of the program.
static const double most_ratio = 8.0;   // Greatest time of a combination over the baseline's.
static const double cuts_per_row = 2.0; // Frames of each row that are drawn for the page.

static double judging_s(const DipCostContext *cost, int rows) {
    const DipCostOptions *options = &cost->report->options;
    return cost->forecast.picture_s * rows * options->places * options->burst;
}

// Returns how long it takes to time rows whose frames take `ms` milliseconds. Every row draws all
// frames once, and one frame untimed in each round and at each start. For each block of rows, the
// baseline draws as many frames as one row.
static double timing_s(const DipCostContext *cost, int rows, int blocks, double ms) {
    const DipCostReport *report = cost->report;
    const int starts = report->options.starts;
    const int frames = dip_cost_frame_count(report) + report->options.rounds + starts;
    return 1e-3 * frames * (rows * ms + blocks * cost->baseline_ms) + starts * start_s;
}

// Estimates the mean time of a frame of the combinations that are measured because they may fit a
// budget, in milliseconds.
static double promising_ms(const DipCostContext *cost) {
    const DipCostOptions *options = &cost->report->options;
    double sum = 0.0;
    for (int b = 0; b < options->budget_count; b++) {
        sum += fmin(options->budgets_ms[b], most_ratio * cost->baseline_ms);
    }
    return options->budget_count > 0 ? sum / options->budget_count : cost->baseline_ms;
}

static double go_errors_s(const DipCostContext *cost) {
    return judging_s(cost, GO_ROWS);
}

static double go_times_s(const DipCostContext *cost) {
    return timing_s(cost, GO_ROWS, GO_ROWS / 4 + 1, promising_ms(cost));
}

// Returns the time of a phase that belongs to predictions; 0 for all other phases.
static double predicting_s(const DipCostContext *cost, DipCostPhase phase) {
    const DipCostForecast *forecast = &cost->forecast;
    switch (phase) {
    case DIP_COST_PHASE_COUNTING:
        return 1e-3 * forecast->row_ms * forecast->counted_frames;
    case DIP_COST_PHASE_TRAINING:
        return judging_s(cost, forecast->timed_rows - forecast->swept_rows);
    case DIP_COST_PHASE_BEST_ERRORS:
        return go_errors_s(cost);
    case DIP_COST_PHASE_BEST_TIMES:
        return go_times_s(cost);
    case DIP_COST_PHASE_MORE_BEST:
        return fmax(fmin(GOES, dip_cost_most_goes(&cost->report->options)) - 1 - forecast->goes,
                    0.0) *
               (go_errors_s(cost) + go_times_s(cost));
    default:
        return 0.0;
    }
}

static double phase_s(const DipCostContext *cost, DipCostPhase phase) {
    const DipCostReport *report = cost->report;
    const DipCostForecast *forecast = &cost->forecast;
    const int rows = forecast->timed_rows;
    switch (phase) {
    case DIP_COST_PHASE_SWEEPS:
        return judging_s(cost, forecast->swept_rows);
    case DIP_COST_PHASE_TIMES:
        return timing_s(cost, rows, rows / 4 + report->path_count, forecast->row_ms);
    case DIP_COST_PHASE_ADVICE:
        return RACES * timing_s(cost, RACED_ROWS, RACED_ROWS, promising_ms(cost));
    case DIP_COST_PHASE_PAGE:
        return report->options.pictures == DIP_COST_PICTURES_NONE
                   ? 0.0
                   : 1e-3 * cuts_per_row * forecast->row_ms * report->row_count;
    default:
        return report->options.predict ? predicting_s(cost, phase) : 0.0;
    }
}

void dip_cost_forecast_begin(DipCostContext *cost) {
    const DipCostReport *report = cost->report;
    const DipCostOptions *options = &report->options;
    const double pixels = (double)report->width * report->height;
    DipCostForecast *forecast = &cost->forecast;
    *forecast = (DipCostForecast){
        .row_ms = row_ratio * cost->baseline_ms,
        .swept_rows = report->row_count,
        .timed_rows = report->row_count,
    };
    forecast->picture_s = 1e-3 * forecast->row_ms + 1e-9 * judging_ns * pixels / report->threads;
    for (int g = 0; options->predict && g < DIP_WORK_GROUPS; g++) {
        forecast->counted_frames +=
            DIP_COST_COUNTED_FRAMES *
            dip_cost_list_combinations(&options->baseline, options->combined & dip_work_group(g),
                                       NULL, 0);
    }
    if (options->predict) {
        const int rows = dip_cost_training_count(options->combined, DIP_COST_MAX_ROWS);
        forecast->timed_rows = rows > report->row_count ? rows : report->row_count;
    }
}

double dip_cost_begin_phase(DipCostContext *cost, DipCostPhase phase) {
    double later_s = 0.0;
    for (int later = (int)phase + 1; later < DIP_COST_PHASE_COUNT; later++) {
        later_s += cost->report->options.errors_only && later != DIP_COST_PHASE_SWEEPS
                       ? 0.0
                       : phase_s(cost, (DipCostPhase)later);
    }
    dip_progress_expect(phase_s(cost, phase), later_s);
    return later_s;
}
