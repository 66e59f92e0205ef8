// Finds the likely cause of a slowdown: the kind of work with which the additional time grows. Fits
// a line through the origin for each kind of work. Whether the best fit is more than chance follows
// from random draws of the programs' starts (bootstrap).
#include "app/cost/diff/diff.h"
#include "app/measure/stats/random.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DRAWS = 200 };
static const double surely_wins = 0.9;
static const double surely_explains = 0.9;
static const double same_cosine = 0.999;

static double dot(const double *a, const double *b, int count) {
    double sum = 0.0;
    for (int i = 0; i < count; i++) {
        sum += a[i] * b[i];
    }
    return sum;
}

bool dip_cause_is_same_work(const DipCauseData *data, int a, int b) {
    const double *x = data->work + a * data->rows, *y = data->work + b * data->rows;
    const double lengths = sqrt(dot(x, x, data->rows) * dot(y, y, data->rows));
    return lengths > 0.0 && dot(x, y, data->rows) > same_cosine * lengths;
}

// Finds the kind of work that explains most of the sum of squares of the times, with a positive
// price. If several kinds cannot be told apart (dip_cause_is_same_work), returns the first of them.
// If there is no such kind, the returned kind is -1.
static DipCause best_fit(const DipCauseData *data, const double *times) {
    DipCause best = {.kind = -1};
    const double squares = dot(times, times, data->rows);
    for (int k = 0; k < data->kinds; k++) {
        const double *work = data->work + k * data->rows;
        const double amount = dot(work, work, data->rows);
        const double common = dot(work, times, data->rows);
        const double share =
            amount > 0.0 && squares > 0.0 ? common * common / amount / squares : 0.0;
        if (common > 0.0 && share > best.share) {
            best = (DipCause){k, common / amount, share};
        }
    }
    for (int k = 0; best.kind > 0 && k < best.kind; k++) {
        if (dip_cause_is_same_work(data, k, best.kind)) {
            const double *work = data->work + k * data->rows;
            best.kind = k;
            best.price = dot(work, times, data->rows) / dot(work, work, data->rows);
        }
    }
    return best;
}

// Computes the mean additional time of each row over the drawn starts. Returns false if there is a
// row that has a time in none of these starts.
static bool mean_times(const DipCauseData *data, const int *drawn, double *times) {
    for (int r = 0; r < data->rows; r++) {
        double sum = 0.0;
        int count = 0;
        for (int s = 0; s < data->starts; s++) {
            const double time = data->per_start[r * data->starts + drawn[s]];
            sum += isnan(time) ? 0.0 : time;
            count += !isnan(time);
        }
        if (count == 0) {
            return false;
        }
        times[r] = sum / count;
    }
    return true;
}

static double share_of_wins(const DipCauseData *data, int kind, int *drawn, double *times) {
    uint64_t random = 1;
    int wins = 0;
    for (int i = 0; i < DRAWS; i++) {
        for (int s = 0; s < data->starts; s++) {
            drawn[s] = dip_random_below(&random, data->starts);
        }
        wins += mean_times(data, drawn, times) && best_fit(data, times).kind == kind;
    }
    return (double)wins / DRAWS;
}

bool dip_cause_find(const DipCauseData *data, DipCause *cause, DipError *err) {
    double *times = malloc((size_t)data->rows * sizeof *times);
    int *drawn = malloc((size_t)data->starts * sizeof *drawn);
    const bool made = (times && drawn) || dip_cost_diff_no_memory(err);
    *cause = (DipCause){.kind = -1};
    for (int s = 0; made && s < data->starts; s++) {
        drawn[s] = s;
    }
    if (made && mean_times(data, drawn, times)) {
        const DipCause best = best_fit(data, times);
        if (best.kind >= 0 && best.share >= surely_explains &&
            share_of_wins(data, best.kind, drawn, times) >= surely_wins) {
            *cause = best;
        }
    }
    free(times);
    free(drawn);
    return made;
}

// --- describing the cause ------------------------------------------------------------------------

// Returns the stage that takes most of the additional time of the slower rows. Writes this stage's
// share of the additional time of all stages that take longer.
static DipBenchStage slowest_stage(const DipCostDiff *diff, double *share) {
    double most = 0.0, total = 0.0;
    DipBenchStage found = (DipBenchStage)0;
    for (int stage = 0; stage < DIP_COST_DIFF_STAGES; stage++) {
        double ms = 0.0;
        for (int r = 0; r < diff->row_count; r++) {
            const DipCostDiffRow *row = &diff->rows[r];
            ms += row->mark == DIP_COST_DIFF_SLOWER ? row->ms[0] * (row->stages[stage].value - 1.0)
                                                    : 0.0;
        }
        total += fmax(ms, 0.0);
        if (ms > most) {
            most = ms;
            found = (DipBenchStage)stage;
        }
    }
    *share = total > 0.0 ? most / total : 0.0;
    return found;
}

// Kinds of work that may explain additional time: PER_FRAME is 1 for each frame, STAGE_TIME is A's
// time in the stage that slowest_stage returns, and the counters follow from FIRST_COUNTER on.
enum { PER_FRAME, STAGE_TIME, FIRST_COUNTER };

static void list_work(const DipTimesFit *fit, const DipCostDiff *diff, DipBenchStage stage,
                      double *work) {
    const int rows = diff->row_count;
    for (int r = 0; r < rows; r++) {
        work[PER_FRAME * rows + r] = 1.0;
        work[STAGE_TIME * rows + r] = diff->rows[r].ms[0] * dip_times_shares(fit, 2 * r)[stage];
        for (int c = 0; c < DIP_COUNTER_COUNT; c++) {
            const double value = diff->rows[r].values[0][DIP_COST_DIFF_FIRST_COUNTER + c];
            work[(FIRST_COUNTER + c) * rows + r] = isnan(value) ? 0.0 : value;
        }
    }
}

static void write_cause(DipCostDiff *diff, const DipCauseData *data, const DipCause *cause,
                        const char *stage) {
    const size_t used = strlen(diff->cause);
    char *text = diff->cause + used;
    const size_t size = sizeof diff->cause - used;
    if (cause->kind == PER_FRAME) {
        snprintf(text, size,
                 " It is about the same with all settings, %.3f ms per frame, so its cause does "
                 "not grow with their work.",
                 cause->price);
    } else if (cause->kind == STAGE_TIME) {
        snprintf(text, size, " It is about the same share of %s with all settings, %.1f %%.", stage,
                 100.0 * cause->price);
    } else if (cause->kind >= FIRST_COUNTER) {
        const int counter = cause->kind - FIRST_COUNTER;
        int written = snprintf(text, size,
                               " It grows with %s, by %.3g ns each: this work is the likely cause.",
                               dip_counter_names[counter], 1e6 * cause->price);
        for (int k = cause->kind + 1; k < data->kinds; k++) {
            if (dip_cause_is_same_work(data, cause->kind, k) && written >= 0 &&
                (size_t)written < size) {
                written +=
                    snprintf(text + written, size - (size_t)written, " (%s grows in proportion.)",
                             dip_counter_names[k - FIRST_COUNTER]);
            }
        }
    }
}

// Writes how much longer B takes than A in a stage, in milliseconds, for each row in each start by
// itself: per_start[row * starts + start].
static bool list_per_start(const DipTimes *all, int rows, DipBenchStage stage, double *per_start,
                           DipError *err) {
    DipTimesFit *fit = NULL;
    DipTimed *list = malloc(((size_t)all->count + 1) * sizeof *list);
    bool done = list || dip_cost_diff_no_memory(err);
    DipTimes times = *all;
    times.list = list;
    times.starts = 1;
    for (int start = 0; done && start < all->starts; start++) {
        times.count = 0;
        for (int i = 0; i < all->count; i++) {
            if (all->list[i].start == start) {
                list[times.count] = all->list[i];
                list[times.count++].start = 0;
            }
        }
        fit = dip_times_fit_part(&times, (int)stage, err);
        done = fit != NULL;
        for (int r = 0; done && r < rows; r++) {
            per_start[r * all->starts + start] = dip_times_along(fit, 2 * r + 1).mean_ms.value -
                                                 dip_times_along(fit, 2 * r).mean_ms.value;
        }
        dip_times_fit_free(&fit);
    }
    free(list);
    return done;
}

bool dip_cost_diff_explain(DipCostDiff *diff, const DipTimes *times, const DipTimesFit *fit,
                           DipError *err) {
    const int rows = diff->row_count, starts = times->starts;
    const int kinds = FIRST_COUNTER + DIP_COUNTER_COUNT;
    double share;
    const DipBenchStage stage = slowest_stage(diff, &share);
    const char *name = dip_bench_stage_names[stage];
    snprintf(diff->cause, sizeof diff->cause, "%.0f %% of the additional time is in the stage %s.",
             100.0 * share, name);
    if (rows < 4) {
        return true;
    }
    double *per_start = malloc((size_t)(rows * (starts + kinds)) * sizeof *per_start);
    if (!per_start) {
        return dip_cost_diff_no_memory(err);
    }
    DipCause cause;
    const DipCauseData data = {rows, starts, kinds, per_start, per_start + rows * starts};
    list_work(fit, diff, stage, per_start + rows * starts);
    const bool done =
        list_per_start(times, rows, stage, per_start, err) && dip_cause_find(&data, &cause, err);
    if (done) {
        write_cause(diff, &data, &cause, name);
    }
    free(per_start);
    return done;
}
