// Makes the truths (converged pictures), and judges every row: measures its pictures' errors
// against the truths.
#include "app/cost/steps.h"
#include "app/files/whole_file.h"
#include "app/files/pictures.h"
#include "app/measure/metrics/meter.h"
#include "app/cli/progress.h"
#include "renderer/base/hash.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// --- truths --------------------------------------------------------------------------------------

enum { STEPS_PER_TRUTH = 1000 }; // Steps of the progress display for each truth.

typedef struct TruthProgress {
    DipProgress progress;
    int64_t before; // Number of steps of all truths that are complete.
} TruthProgress;

static bool show_truth(void *context, double done) {
    TruthProgress *at = context;
    dip_progress_show(&at->progress, at->before + (int64_t)(done * STEPS_PER_TRUTH));
    return !dip_interrupted();
}

// Writes a truth into the folder of --save-truths as PATH-VIEWPOINT-FRAME.pfm.
static bool save_truth(const DipCostReport *report, const DipTruth *truth, int path, int viewpoint,
                       int frame, DipError *err) {
    const char *folder = report->options.truths;
    char file[PATH_MAX];
    const int length = snprintf(file, sizeof file, "%s/%s-%d-%d.pfm", folder, report->paths[path],
                                viewpoint, frame);
    if (length < 0 || (size_t)length >= sizeof file) {
        return dip_error_set_runtime(err, DIP_ERROR_OVERSIZED, folder, 0, "--save-truths",
                                     "the name is too long");
    }
    return dip_pfm_write(file, truth->rgb_lin, truth->width, truth->height, err);
}

static bool make_truth(DipCostContext *cost, int path, int viewpoint, int frame, TruthProgress *at,
                       DipError *err) {
    DipCostReport *report = cost->report;
    const int index = path * report->options.places + viewpoint;
    DipTruth truth;
    if (!dip_cost_context_truth(cost, path, viewpoint, frame, show_truth, at, &truth, err)) {
        return false;
    }
    dip_metric_sums_add(&report->floors[index], &truth.floor);
    report->has_floor[index] = true;
    at->before += STEPS_PER_TRUTH;
    const bool saved =
        !report->options.truths || save_truth(report, &truth, path, viewpoint, frame, err);
    dip_truth_free(&truth);
    return saved;
}

bool dip_cost_make_truths(DipCostContext *cost, DipError *err) {
    const DipCostOptions *options = &cost->report->options;
    const int per_path = (options->end_place - options->first_place) * options->burst;
    const int truths = cost->report->path_count * per_path;
    if (options->truths && !dip_folder_make(options->truths, "--save-truths", err)) {
        return false;
    }
    TruthProgress at = {
        dip_progress_begin("steps (1000 per converged picture)", (int64_t)truths * STEPS_PER_TRUTH),
        0};
    bool made = true;
    for (int i = 0; made && i < truths; i++) {
        const int in_path = i % per_path;
        made = make_truth(cost, i / per_path, options->first_place + in_path / options->burst,
                          in_path % options->burst, &at, err);
    }
    dip_progress_end(&at.progress, at.before);
    return made;
}

// --- judging -------------------------------------------------------------------------------------

// The pictures that a row has in one burst (the successive frames at a viewpoint), and their
// errors.
typedef struct Burst {
    uint8_t *rgba8; // One frame after another, without padding between lines. Borrowed.
    int row;
    char key[33];     // Hash of the pictures, their truths and the pixels per degree.
    char journal[33]; // Key in the journal: hash of `key` and of the program's file, since another
                      // build may measure other errors.
    DipCostBurstErrors errors;
    bool failed;
} Burst;

typedef struct Judge {
    DipCostContext *cost;
    int path;
    int viewpoint;
    DipTruth truths[DIP_COST_MAX_BURST];
    DipFlipAnalysis analyses[DIP_COST_MAX_BURST];
    DipMeter *meters; // One per thread.
    int meter_count;
    Burst *bursts;     // Drawn bursts that wait to be judged together.
    uint8_t *pictures; // Memory of the pictures of all bursts.
    int burst_room;    // Greatest number of bursts: two per thread.
    int burst_count;
    DipProgress progress;
    int64_t done;     // Number of bursts drawn so far.
    int64_t computed; // Number of bursts whose errors were measured, since the journal lacked them.
} Judge;

static size_t picture_bytes(const Judge *j) {
    return (size_t)j->cost->report->width * (size_t)j->cost->report->height * 4;
}

static void close_judge(Judge *j) {
    for (int i = 0; j->meters && i < j->meter_count; i++) {
        dip_meter_free(&j->meters[i]);
    }
    for (int i = 0; i < DIP_COST_MAX_BURST; i++) {
        dip_flip_analysis_free(&j->analyses[i]);
    }
    free(j->meters);
    free(j->bursts);
    free(j->pictures);
}

static bool open_judge(Judge *j, DipCostContext *cost, DipError *err) {
    const DipCostReport *report = cost->report;
    const int burst = report->options.burst;
    *j = (Judge){.cost = cost, .meter_count = report->threads, .burst_room = 2 * report->threads};
    const size_t burst_bytes = picture_bytes(j) * (size_t)burst;
    j->meters = calloc((size_t)j->meter_count, sizeof *j->meters);
    j->bursts = calloc((size_t)j->burst_room, sizeof *j->bursts);
    j->pictures = malloc((size_t)j->burst_room * burst_bytes);
    bool made = j->meters && j->bursts && j->pictures;
    for (int i = 0; made && i < j->meter_count; i++) {
        made = dip_meter_init(&j->meters[i], burst > 1 ? DIP_METER_BURSTS : DIP_METER_PICTURES,
                              report->width, report->height, report->options.pixels_per_degree);
    }
    for (int i = 0; made && i < j->burst_room; i++) {
        j->bursts[i].rgba8 = j->pictures + (size_t)i * burst_bytes;
    }
    for (int i = 0; made && i < burst; i++) {
        made = dip_flip_analysis_init(&j->meters[0].flip, &j->analyses[i]);
    }
    if (!made) {
        close_judge(j);
        return dip_cost_out_of_memory(err);
    }
    return true;
}

static DipSrgbPicture picture_of(const Judge *j, const uint8_t *rgba8) {
    const DipCostReport *report = j->cost->report;
    return (DipSrgbPicture){rgba8, (size_t)report->width * 4, report->width, report->height};
}

// Measures the errors of one burst, on one thread.
static void judge_burst(void *context, int index, int worker) {
    Judge *j = context;
    Burst *drawn = &j->bursts[index];
    DipMeter *meter = &j->meters[worker];
    drawn->errors = (DipCostBurstErrors){.sums = {.bursts = 0.0}};
    drawn->failed = false;
    dip_meter_begin_burst(meter);
    for (int f = 0; f < j->cost->report->options.burst; f++) {
        const DipSrgbPicture test = picture_of(j, drawn->rgba8 + (size_t)f * picture_bytes(j));
        DipMeterStandard standard = dip_truth_standard(&j->truths[f]);
        standard.analysis = &j->analyses[f];
        if (!dip_meter_add(meter, &test, NULL, &standard, &drawn->errors.sums)) {
            drawn->failed = true;
        }
    }
    dip_meter_end_burst(meter, &drawn->errors.sums);
    drawn->errors.tail = dip_flip_tail_result(&meter->tail);
}

// Puts the errors of a burst into the report.
static void keep_errors(const Judge *j, const Burst *drawn) {
    DipCostRow *row = &j->cost->report->rows[drawn->row];
    row->viewpoints[j->viewpoint] = drawn->errors.sums;
    row->tails[j->viewpoint] = drawn->errors.tail;
    row->judged[j->viewpoint] = true;
    memcpy(row->pictures[j->viewpoint], drawn->key, sizeof drawn->key);
}

// Judges the collected bursts on all threads, and keeps their errors.
static bool judge_bursts(Judge *j, DipError *err) {
    dip_pool_run(j->cost->session->pool, j->burst_count, judge_burst, j);
    for (int i = 0; i < j->burst_count; i++) {
        const Burst *drawn = &j->bursts[i];
        if (drawn->failed) {
            return dip_cost_out_of_memory(err);
        }
        keep_errors(j, drawn);
        if (!dip_cost_journal_add(j->cost->journal, drawn->journal, &drawn->errors, err)) {
            return false;
        }
    }
    j->computed += j->burst_count;
    j->burst_count = 0;
    return true;
}

// Draws a row's burst at the viewpoint, and computes its two keys.
static bool draw_burst(Judge *j, int row, Burst *drawn, DipError *err) {
    const DipCostReport *report = j->cost->report;
    DipHash hash = dip_hash_begin(0);
    dip_hash_text(&hash, "diptych errors 1");
    dip_hash_number(&hash, report->options.pixels_per_degree);
    drawn->row = row;
    for (int f = 0; f < report->options.burst; f++) {
        char hex[33];
        if (!dip_cost_draw_viewpoint(j->cost, row, j->viewpoint, f,
                                     drawn->rgba8 + (size_t)f * picture_bytes(j), hex, err)) {
            return false;
        }
        dip_hash_text(&hash, hex);
        dip_hash_text(&hash, j->truths[f].key);
    }
    dip_hash_hex(&hash, drawn->key);
    dip_hash_text(&hash, report->build);
    dip_hash_hex(&hash, drawn->journal);
    return true;
}

// Judges all rows of path j->path whose errors at viewpoint j->viewpoint are not known yet. Takes
// errors from the journal if it has them.
static bool judge_rows(Judge *j, DipError *err) {
    DipCostReport *report = j->cost->report;
    bool judged = true;
    for (int row = 0; judged && row < report->row_count; row++) {
        if (report->rows[row].path != j->path || report->rows[row].judged[j->viewpoint]) {
            continue;
        }
        Burst *drawn = &j->bursts[j->burst_count];
        judged = draw_burst(j, row, drawn, err);
        if (judged && dip_cost_journal_find(j->cost->journal, drawn->journal, &drawn->errors)) {
            keep_errors(j, drawn);
        } else if (judged && ++j->burst_count == j->burst_room) {
            judged = judge_bursts(j, err);
        }
        dip_progress_show(&j->progress, ++j->done);
        judged = judged && !dip_cost_interrupted(j->cost, err);
    }
    return judged && judge_bursts(j, err);
}

// Gets the truths of viewpoint j->viewpoint on path j->path, and judges the path's rows against
// them.
static bool judge_viewpoint(Judge *j, DipError *err) {
    const int burst = j->cost->report->options.burst;
    int got = 0;
    while (got < burst && dip_cost_context_truth(j->cost, j->path, j->viewpoint, got, NULL, NULL,
                                                 &j->truths[got], err)) {
        const DipSrgbPicture picture = picture_of(j, j->truths[got].rgba8);
        dip_flip_analyse(&j->meters[0].flip, &picture, &j->analyses[got]);
        got++;
    }
    const bool judged = got == burst && judge_rows(j, err);
    while (got > 0) {
        dip_truth_free(&j->truths[--got]);
    }
    return judged;
}

// Returns the number of bursts at this run's viewpoints (--part) whose errors are not known yet.
static int64_t count_bursts(const DipCostReport *report) {
    const DipCostOptions *options = &report->options;
    int64_t count = 0;
    for (int row = 0; row < report->row_count; row++) {
        for (int p = options->first_place; p < options->end_place; p++) {
            count += !report->rows[row].judged[p];
        }
    }
    return count;
}

bool dip_cost_judge(DipCostContext *cost, DipError *err) {
    const DipCostReport *report = cost->report;
    const DipCostOptions *options = &report->options;
    Judge j;
    if (!open_judge(&j, cost, err)) {
        return false;
    }
    j.progress = dip_progress_begin("bursts of frames judged", count_bursts(report));
    bool judged = true;
    for (j.path = 0; judged && j.path < report->path_count; j.path++) {
        for (j.viewpoint = options->first_place; judged && j.viewpoint < options->end_place;
             j.viewpoint++) {
            judged = judge_viewpoint(&j, err);
        }
    }
    dip_progress_end(&j.progress, j.done);
    if (j.computed > 0) {
        cost->forecast.picture_s =
            dip_progress_elapsed_s(&j.progress) / (double)(j.computed * options->burst);
    }
    close_judge(&j);
    return judged;
}
