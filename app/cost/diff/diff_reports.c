// Compares two reports: their scenes, paths and rows, exact quantities, and ratios of times.
#include "app/cost/diff/diff.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// A ratio differs a little from one start of a program to the next. start_error is the standard
// deviation of the ratio's logarithm between starts. It is used for reports of a single start,
// which cannot measure this deviation.
static const double start_error = 0.006;

enum { NAMED_ROWS = 4 }; // Greatest number of rows that a note names.

// Says which parts of two reports may be compared.
typedef struct Comparable {
    bool pictures; // True if size and scene are the same; an unknown scene (of a program) counts as
                   // the same. If this is false, so are the next three.
    bool errors; // True if the numbers of viewpoints, frames and samples, and the pixels per degree
                 // are the same.
    bool counters;                   // True if both reports have times, of equally many frames.
    bool ratios;                     // True if both reports have times, and the same baseline.
    bool poses[DIP_COST_MAX_PATHS];  // [path of A]: true if B has the same poses (same_poses).
    int path_of[DIP_COST_MAX_PATHS]; // [path of A]: the path of B with this name, or -1.
} Comparable;

// --- headings ------------------------------------------------------------------------------------

static void describe(const DipCostReport *report, int side, DipCostDiff *diff) {
    snprintf(diff->machines[side], sizeof diff->machines[side], "%s, %d thread%s, %s",
             report->processor, report->threads, dip_cost_plural(report->threads), report->isa);
    snprintf(diff->builds[side], sizeof diff->builds[side], "%s", report->build);
    diff->verdicts[side] = report->verdict;
    snprintf(diff->reasons[side], sizeof diff->reasons[side], "%s", report->verdict_reason);
}

static void compare_options(const DipCostReport *a, const DipCostReport *b, Comparable *can,
                            DipCostDiff *diff) {
    const DipCostOptions *o = &a->options, *p = &b->options;
    const bool judged = o->places > 0 && p->places > 0;
    can->errors = can->pictures && judged && o->places == p->places && o->burst == p->burst &&
                  o->samples == p->samples && o->pixels_per_degree == p->pixels_per_degree;
    if (can->pictures && judged && !can->errors) {
        dip_cost_diff_note(diff,
                           "errors are not compared: A has %d viewpoints, %d frames at each, %d "
                           "samples and %.4g pixels per degree; B has %d, %d, %d and %.4g",
                           o->places, o->burst, o->samples, o->pixels_per_degree, p->places,
                           p->burst, p->samples, p->pixels_per_degree);
    }
    const bool timed = a->rounds > 0 && b->rounds > 0;
    can->counters = can->pictures && timed && dip_cost_frame_count(a) == dip_cost_frame_count(b);
    if (can->pictures && timed && !can->counters) {
        dip_cost_diff_note(diff, "counters are not compared: A counts %d frames of each path, B %d",
                           dip_cost_frame_count(a), dip_cost_frame_count(b));
    }
    can->ratios =
        can->pictures && timed && memcmp(&o->baseline, &p->baseline, sizeof o->baseline) == 0;
    if (can->pictures && timed && !can->ratios) {
        char texts[2][DIP_COST_TEXT];
        dip_cost_settings_text(&o->baseline, texts[0]);
        dip_cost_settings_text(&p->baseline, texts[1]);
        dip_cost_diff_note(diff, "times are not compared: the baseline of A is %s, that of B is %s",
                           texts[0], texts[1]);
    }
    for (int side = 0; side < 2; side++) {
        const DipCostReport *report = side ? b : a;
        if (report->rounds == 0) {
            dip_cost_diff_note(diff, "times and counters are not compared: %s has none",
                               side ? "B" : "A");
        }
    }
}

static void compare_headers(const DipCostReport *a, const DipCostReport *b, Comparable *can,
                            DipCostDiff *diff) {
    const bool scene =
        strcmp(a->scene_hash, b->scene_hash) == 0 || !*a->scene_hash || !*b->scene_hash;
    const bool size = a->width == b->width && a->height == b->height;
    if (!scene) {
        dip_cost_diff_note(diff,
                           "scene differs: A has %.60s (hash %.12s), B has %.60s (hash %.12s)",
                           a->scene, a->scene_hash, b->scene, b->scene_hash);
    }
    if (!size) {
        dip_cost_diff_note(diff, "size differs: A has %dx%d pixels, B has %dx%d", a->width,
                           a->height, b->width, b->height);
    }
    can->pictures = scene && size;
    if (can->pictures) {
        snprintf(diff->scene, sizeof diff->scene, "%.100s, %dx%d pixels", a->scene, a->width,
                 a->height);
    } else {
        dip_cost_diff_note(diff, "errors, counters and ratios of different pictures are not "
                                 "compared");
    }
    compare_options(a, b, can, diff);
    diff->same_machine = strcmp(diff->machines[0], diff->machines[1]) == 0;
    diff->has_times = can->ratios;
}

// --- paths ---------------------------------------------------------------------------------------

static int find_path(const DipCostReport *report, const char *name) {
    for (int p = 0; p < report->path_count; p++) {
        if (strcmp(report->paths[p], name) == 0) {
            return p;
        }
    }
    return -1;
}

// Returns whether poses are the same. Unknown poses, such as those of a program, count as the same.
static bool same_poses(const char *a, const char *b) {
    return !*a || !*b || strcmp(a, b) == 0;
}

static void compare_paths(const DipCostReport *a, const DipCostReport *b, Comparable *can,
                          DipCostDiff *diff) {
    for (int p = 0; p < a->path_count; p++) {
        const int q = find_path(b, a->paths[p]);
        can->path_of[p] = q;
        can->poses[p] = q >= 0 && same_poses(a->path_hashes[p], b->path_hashes[q]);
        if (q < 0 && !diff->some_rows) {
            dip_cost_diff_note(diff, "path only in A: %s", a->paths[p]);
        } else if (q >= 0 && !can->poses[p]) {
            dip_cost_diff_note(diff,
                               "poses differ on path %s: its rows are not compared, because the "
                               "camera path changed",
                               a->paths[p]);
        }
    }
    for (int q = 0; q < b->path_count; q++) {
        if (find_path(a, b->paths[q]) < 0 && !diff->some_rows) {
            dip_cost_diff_note(diff, "path only in B: %s", b->paths[q]);
        }
    }
}

// --- rows ----------------------------------------------------------------------------------------

// Returns whether a row is the A/A row of its path (the baseline, timed as if it were another
// setting).
static bool is_repeated_baseline(const DipCostReport *report, int row) {
    return report->same_rows[report->rows[row].path] == row &&
           report->base_rows[report->rows[row].path] != row;
}

// Finds the first row of B that has the settings of a row of A, is on the given path of B, is not
// an A/A row, and belongs to no earlier row of A. Returns -1 if there is none.
static int find_row(const DipCostRow *wanted, const DipCostReport *b, int path, const bool *taken) {
    int row = dip_report_find(b, &wanted->quality, path, 0);
    while (row >= 0 && (taken[row] || is_repeated_baseline(b, row))) {
        row = dip_report_find(b, &wanted->quality, path, row + 1);
    }
    return row;
}

// Appends a row's settings and path to a list of rows. Returns false, and leaves the list as it is,
// if there is no room for the whole text.
static bool name_row(const DipCostReport *report, const DipCostRow *row, char *list, size_t size) {
    char settings[DIP_COST_TEXT];
    const size_t used = strlen(list), room = size - used;
    dip_cost_settings_text(&row->quality, settings);
    const int length = snprintf(list + used, room, "%s%s on %s", used ? "; " : "", settings,
                                report->paths[row->path]);
    const bool fits = length >= 0 && (size_t)length < room;
    list[fits ? used + (size_t)length : used] = '\0';
    return fits;
}

// Adds a note that names the first rows in `lonely`, at most NAMED_ROWS: rows on paths of both
// sides that only this side has. If there are more, the note also tells how many there are in all.
// Adds none if one side is a program that measured only some rows.
static void note_lonely(DipCostDiff *diff, const DipCostReport *report, const bool *lonely,
                        const char *side) {
    char text[DIP_COST_DIFF_NOTE - 48] = ""; // The rest of a note has less than 48 bytes.
    int count = 0, named = 0;
    for (int r = 0; r < report->row_count; r++) {
        const bool all_named = named == count && named < NAMED_ROWS;
        count += lonely[r];
        named += lonely[r] && all_named && name_row(report, &report->rows[r], text, sizeof text);
    }
    if (diff->some_rows || count == 0) {
        return;
    }
    if (count > named) {
        dip_cost_diff_note(diff, "settings only in %s: %d rows: %s; ...", side, count, text);
    } else {
        dip_cost_diff_note(diff, "settings only in %s: %s", side, text);
    }
}

// Computes the errors of both sides over the viewpoints that both reports judged. `rows` holds the
// index of the row on each side.
static void copy_errors(const DipCostReport *const reports[2], const int rows[2],
                        DipCostDiffRow *to) {
    DipMetricSums sums[2] = {{.bursts = 0.0}, {.bursts = 0.0}};
    int viewpoints = 0;
    for (int p = 0; p < reports[0]->options.places; p++) {
        if (reports[0]->rows[rows[0]].judged[p] && reports[1]->rows[rows[1]].judged[p]) {
            dip_metric_sums_add(&sums[0], &reports[0]->rows[rows[0]].viewpoints[p]);
            dip_metric_sums_add(&sums[1], &reports[1]->rows[rows[1]].viewpoints[p]);
            viewpoints++;
        }
    }
    for (int side = 0; viewpoints > 0 && side < 2; side++) {
        const DipMetrics metrics = dip_metrics_of(&sums[side], 0);
        const DipFlickerMetrics flicker = dip_flicker_metrics_of(&sums[side]);
        double *values = to->values[side];
        values[DIP_COST_DIFF_rmse] = metrics.rmse_lin;
        values[DIP_COST_DIFF_psnr] = metrics.psnr_db;
        values[DIP_COST_DIFF_ssim] = metrics.ssim;
        values[DIP_COST_DIFF_flip] = metrics.flip;
        values[DIP_COST_DIFF_flicker] = flicker.flicker;
        values[DIP_COST_DIFF_two_mean] = flicker.two_mean;
    }
}

// Copies the counters, which are means over the frames. Two reports may have rounded equal means in
// different ways. A counter's sum over the frames is a whole number, so the means are computed
// again from the rounded sums.
static void copy_counters(const DipCostReport *const reports[2], const int rows[2],
                          DipCostDiffRow *to) {
    for (int side = 0; side < 2; side++) {
        const double frames = dip_cost_frame_count(reports[side]);
        for (int c = 0; c < DIP_COUNTER_COUNT; c++) {
            to->values[side][DIP_COST_DIFF_FIRST_COUNTER + c] =
                round(reports[side]->rows[rows[side]].counters[c] * frames) / frames;
        }
    }
}

// Computes the quotient of the two sides' ratios. The error of its logarithm combines the errors of
// both ratios and, if a report has a single start, start_error. The baseline's ratio to itself has
// no error.
static void compare_times(const DipCostReport *const reports[2], const int rows[2],
                          DipCostDiffRow *to) {
    const int rounds = reports[0]->options.rounds < reports[1]->options.rounds
                           ? reports[0]->options.rounds
                           : reports[1]->options.rounds;
    for (int side = 0; side < 2; side++) {
        to->ratios[side] = reports[side]->rows[rows[side]].time.ratio;
        to->ms[side] = reports[side]->rows[rows[side]].time.mean_ms.value;
    }
    to->timed = to->ratios[0].value > 0.0 && to->ratios[1].value > 0.0;
    if (!to->timed) {
        return;
    }
    double error = 0.0, degrees = rounds - 1;
    bool shows_starts = true;
    for (int side = 0; side < 2; side++) {
        const double own = to->ratios[side].log_error;
        error = hypot(error, isnan(own) ? 0.0 : own);
        degrees = fmin(degrees, to->ratios[side].degrees);
        shows_starts = shows_starts && reports[side]->starts > 1;
    }
    to->change = dip_estimate_make(to->ratios[1].value / to->ratios[0].value,
                                   hypot(error, shows_starts ? 0.0 : start_error), degrees);
}

// Computes bounds of the changes that are so wide that all of them together hold with a probability
// of 95 % (Bonferroni's correction). Of a hundred intervals of 95 % each, about five would miss the
// truth.
static void widen_bounds(DipCostDiff *diff) {
    int count = 0;
    for (int r = 0; r < diff->row_count; r++) {
        count += diff->rows[r].timed;
    }
    const double probability = 1.0 - 0.025 / fmax(count, 1.0);
    for (int r = 0; r < diff->row_count; r++) {
        DipCostDiffRow *row = &diff->rows[r];
        const DipEstimate *change = &row->change;
        const double half =
            change->degrees >= 1.0
                ? dip_student_quantile(probability, change->degrees) * change->log_error
                : NAN;
        row->surely_above = change->value * exp(-half);
        row->surely_below = change->value * exp(half);
    }
}

static void add_row(const DipCostReport *const reports[2], const int rows[2], const Comparable *can,
                    DipCostDiff *diff) {
    DipCostDiffRow *to = &diff->rows[diff->row_count++];
    const int path = reports[0]->rows[rows[0]].path;
    *to = (DipCostDiffRow){.quality = reports[0]->rows[rows[0]].quality,
                           .is_base = reports[0]->base_rows[path] == rows[0]};
    snprintf(to->path, sizeof to->path, "%s", reports[0]->paths[path]);
    for (int q = 0; q < DIP_COST_DIFF_QUANTITY_COUNT; q++) {
        to->values[0][q] = to->values[1][q] = NAN;
    }
    if (can->poses[path] && can->errors) {
        copy_errors(reports, rows, to);
    }
    if (can->poses[path] && can->counters) {
        copy_counters(reports, rows, to);
    }
    if (can->poses[path] && can->ratios) {
        compare_times(reports, rows, to);
    }
}

static void compare_rows(const DipCostReport *const reports[2], const Comparable *can,
                         DipCostDiff *diff) {
    const DipCostReport *a = reports[0], *b = reports[1];
    bool taken[DIP_COST_MAX_ROWS] = {false}, lonely[DIP_COST_MAX_ROWS] = {false};
    for (int r = 0; r < a->row_count; r++) {
        const int path = can->path_of[a->rows[r].path];
        if (is_repeated_baseline(a, r) || path < 0) {
            continue;
        }
        const int other = find_row(&a->rows[r], b, path, taken);
        lonely[r] = other < 0;
        if (other >= 0) {
            taken[other] = true;
            add_row(reports, (const int[2]){r, other}, can, diff);
        }
    }
    note_lonely(diff, a, lonely, "A");
    for (int r = 0; r < b->row_count; r++) {
        lonely[r] = !taken[r] && !is_repeated_baseline(b, r) &&
                    find_path(a, b->paths[b->rows[r].path]) >= 0;
    }
    note_lonely(diff, b, lonely, "B");
}

bool dip_cost_diff_reports(const DipCostReport *a, const DipCostReport *b, DipCostDiff *diff,
                           DipError *err) {
    Comparable can = {.pictures = true};
    diff->rows = calloc((size_t)a->row_count, sizeof *diff->rows);
    diff->kind = DIP_COST_DIFF_REPORTS;
    if (!diff->rows) {
        return dip_cost_diff_no_memory(err);
    }
    describe(a, 0, diff);
    describe(b, 1, diff);
    compare_headers(a, b, &can, diff);
    compare_paths(a, b, &can, diff);
    compare_rows((const DipCostReport *const[2]){a, b}, &can, diff);
    dip_cost_diff_leave_out_uncounted(diff);
    if (diff->has_times) {
        widen_bounds(diff);
    }
    dip_cost_diff_mark(diff);
    return true;
}
