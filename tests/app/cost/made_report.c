// Fills in a report by formula.
#include "tests/app/cost/made_report.h"

#include <stdlib.h>
#include <stdio.h>

enum { ROWS = 5 };

static void fill_sums(DipMetricSums *sums, int seed) {
    double *values = (double *)sums;
    for (int i = 0; i < DIP_METRIC_SUM_COUNT; i++) {
        values[i] = 1.0 / (1.0 + i + 100.0 * seed); // a number without a short decimal form
    }
    for (int r = 0; r < DIP_METRIC_REGION_COUNT; r++) {
        sums->regions[r].pixels = 10.0;
        sums->regions[r].ssim_pixels = 9.0;
    }
    sums->bursts = 1.0;
}

// Makes room for more frames in the log.
static void reserve(DipCostReport *report, int count) {
    DipTimed *log = realloc(report->log, (size_t)(report->log_count + count) * sizeof *log);
    if (!log) {
        abort();
    }
    report->log = log;
}

// Finds a frame of a row in the log, or adds it where there is room. Each row has a block of its
// own.
static DipTimed *find_timed(DipCostReport *report, int row, int subject, int frame) {
    for (int i = report->log_count - 1; i >= 0; i--) {
        DipTimed *timed = &report->log[i];
        if (timed->block == row && timed->subject == subject && timed->frame == frame) {
            return timed;
        }
    }
    report->starts = 1;
    report->log[report->log_count] = (DipTimed){
        .subject = subject, .round = frame % report->rounds, .block = row, .frame = frame};
    return &report->log[report->log_count++];
}

static void set_frame(DipCostReport *report, int row, int frame, double ms, double base_ms) {
    const int base = report->base_rows[report->rows[row].path];
    find_timed(report, row, base, frame)->ms = base_ms;
    if (row != base) {
        DipTimed *timed = find_timed(report, row, row, frame);
        timed->ms = ms;
        timed->cpu_ms = 1.5 * ms;
    }
}

void dip_made_frame(DipCostReport *report, int row, int frame, double ms, double base_ms) {
    reserve(report, 2);
    set_frame(report, row, frame, ms, base_ms);
}

DipTimed *dip_made_timed(DipCostReport *report, int row, int frame) {
    reserve(report, 1);
    return find_timed(report, row, row, frame);
}

void dip_made_times(DipCostReport *report, int row, double ms) {
    const int frames = report->rounds > 0 ? dip_cost_frame_count(report) : 0;
    reserve(report, 2 * frames + 1);
    for (int f = 0; f < frames; f++) {
        set_frame(report, row, f, ms, 1.0);
    }
}

static void fill_row(DipCostReport *report, int index) {
    static const uint8_t steps[ROWS] = {0, 0, 1, 2, 0};
    DipCostRow *row = &report->rows[index];
    row->quality = dip_quality_default();
    row->quality.step[DIP_SETTING_AA] = steps[index];
    row->path = index == ROWS - 1;
    for (int p = 0; p < report->options.places; p++) {
        row->judged[p] = p != 1; // another machine judged one of the viewpoints
        if (row->judged[p]) {
            fill_sums(&row->viewpoints[p], index * 3 + p);
            row->tails[p] = (DipFlipTail){.p50 = 0.01 / (1 + index),
                                          .p95 = 0.1 / (1 + index),
                                          .p99 = 0.2 / (1 + index),
                                          .worst = 0.3 / (1 + index + p),
                                          .worst_frame = 1,
                                          .worst_x = 32,
                                          .worst_y = 16,
                                          .worst_width = 32,
                                          .worst_height = 32};
        }
    }
    dip_made_times(report, index, index + 1.0);
    for (int c = 0; report->rounds > 0 && c < DIP_COUNTER_COUNT; c++) { // counters come from timing
        row->counters[c] = 1000.0 * index + c;
    }
}

static void add_warnings(DipCostReport *report) {
    static const DipError warnings[] = {
        {.file = "folder/made.gltf", .key = "extensionsUsed", .message = "ACME_smell is not drawn"},
        {.file = "made.ini", .line = 12, .key = "NEAR", .message = "this key was given before"},
        {.message = "a warning without a place"},
    };
    if (!dip_cost_report_add_warnings(report, warnings, 3, NULL)) {
        abort();
    }
    report->warnings_left_out = 2;
}

void dip_made_report(DipCostReport *report, int rounds) {
    *report = (DipCostReport){
        .scene = "made up",
        .scene_hash = "0123456789abcdef0123456789abcdef",
        .processor = "none",
        .isa = "scalar",
        .build = "b",
        .date = "2026-01-31T23:59:58Z",
        .version = "0",
        .threads = 2,
        .width = 64,
        .height = 48,
        .paths = {"DEFAULT", "AA"},
        .path_count = 2,
        .row_count = ROWS,
        .base_rows = {0, 4},
        .same_rows = {1, 4},
        .combined_first = ROWS,
        .sweep_count = 1,
        .refused = {{"opt=standard: not yet"}},
        .refused_count = 1,
        .rounds = rounds,
        .machine = {.settled = true, .has_wait = true, .wait = 0.01},
    };
    report->options = (DipCostOptions){.baseline = dip_quality_default(),
                                       .places = 3,
                                       .burst = 2,
                                       .end_place = 3,
                                       .samples = 64,
                                       .pixels_per_degree = 67.0206451,
                                       .rounds = rounds,
                                       .timed_frames = 4,
                                       .budgets_ms = {16.6},
                                       .budget_count = 1,
                                       .seed = 5};
    report->sweeps[0] =
        (DipCostSweep){.setting = DIP_SETTING_AA, .rows = {0, 2, 3}, .row_count = 3};
    report->rows = calloc(ROWS, sizeof *report->rows);
    if (!report->rows || !dip_cost_report_alloc(report, NULL)) {
        abort();
    }
    for (int r = 0; r < ROWS; r++) {
        fill_row(report, r);
    }
    if (rounds > 0) {
        dip_made_times(report, 1, 1.0); // the A/A rows
        dip_made_times(report, 4, 1.0);
        if (!dip_cost_estimate_times(report, NULL)) {
            abort();
        }
    }
    if (rounds > 0) {
        report->smaller[0] = (DipCostElsewhere){.quality = report->options.baseline,
                                                .counters = {2.0, 3.0, 5.0},
                                                .ms = {.value = 0.5, .low = 0.4, .high = 0.6},
                                                .stage_ms = {0.1, 0.1, 0.25, 0.0, 0.05}};
        report->smaller_count = 1;
        report->smaller_width = 32;
        report->smaller_height = 24;
    }
    report->predicted.list = calloc(2, sizeof *report->predicted.list);
    if (!report->predicted.list) {
        abort();
    }
    report->predicted.count = rounds > 0 ? 2 : 0;
    report->predicted.trained = 1;
    report->predicted.times = (DipCostMisses){0.01, 0.02, 1.0, 0.9, 1};
    report->predicted.errors_left_out = (DipCostMisses){0.02, 0.03, 0.8, 0.7, 1};
    report->predicted.list[0] =
        (DipCostPrediction){.quality = report->rows[2].quality, .ms = 3.5, .flip = 0.1, .row = 2};
    report->predicted.list[1] = (DipCostPrediction){
        .quality = report->rows[3].quality, .ms = 4.5, .p95_ms = 5.0, .flip = 0.2, .row = -1};
    add_warnings(report);
    for (int path = 0; path < report->path_count; path++) {
        report->has_floor[path * report->options.places] = true;
        fill_sums(&report->floors[path * report->options.places], 50 + path);
    }
}

int dip_made_combination(DipCostReport *report, const DipQuality *quality, double ms, double flip) {
    DipCostRow *rows = realloc(report->rows, ((size_t)report->row_count + 1) * sizeof *rows);
    if (!rows) {
        abort();
    }
    report->rows = rows;
    const int row = dip_cost_report_add_row(report, quality, 0, NULL);
    if (row < 0) {
        abort();
    }
    for (int p = 0; p < report->options.places; p++) {
        rows[row].judged[p] = true;
        fill_sums(&rows[row].viewpoints[p], row + p);
        rows[row].viewpoints[p].regions[0].flip = flip * rows[row].viewpoints[p].regions[0].pixels;
    }
    dip_made_times(report, row, ms);
    return row;
}
