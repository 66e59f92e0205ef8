// Computing the times of a report's rows from pairs of times, and the verdict on the machine.
#include "app/report/report.h"

#include "app/report/verdict.h"

#include <math.h>
#include <stdlib.h>

int dip_cost_frame_count(const DipCostReport *report) {
    return report->options.rounds * report->options.timed_frames;
}

static bool out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost", "out of memory");
}

// --- levels --------------------------------------------------------------------------------------

// What is common to the rows of one path. Arrays are owned.
typedef struct PathLevel {
    double *level_ms; // [frame]: the baseline's usual time.
    double error;     // Standard error of the level's logarithm.
    double *ms;       // [frame]: scratch for the times of one row.
    double *base_ms;
} PathLevel;

static void close_level(PathLevel *level) {
    free(level->level_ms);
}

// Median of the baseline's times of a frame. Every block has one, and each row of a block repeats
// it, so the median is that of the blocks.
static double level_of_frame(const DipCostReport *report, int path, int frame, double *scratch) {
    int count = 0;
    for (int r = 0; r < report->row_count; r++) {
        const DipTimePair *pair = &report->rows[r].pairs[frame];
        if (report->rows[r].path == path && pair->ms > 0.0 &&
            pair->base_wait <= DIP_PAIRED_MOST_WAIT) {
            scratch[count++] = pair->base_ms;
        }
    }
    if (count == 0) { // Every run waited.
        for (int r = 0; r < report->row_count; r++) {
            if (report->rows[r].path == path && report->rows[r].pairs[frame].ms > 0.0) {
                scratch[count++] = report->rows[r].pairs[frame].base_ms;
            }
        }
    }
    return count > 0 ? dip_stats_median(scratch, count) : NAN;
}

// Lists the logarithms of all the baseline's times over their frame's level, round by round.
static double level_error(const DipCostReport *report, int path, const double *level_ms,
                          double *scratch) {
    int count = 0;
    for (int round = 0; round < report->options.rounds; round++) {
        for (int r = 0; r < report->row_count; r++) {
            for (int f = round; f < dip_cost_frame_count(report); f += report->options.rounds) {
                const DipTimePair *pair = &report->rows[r].pairs[f];
                if (report->rows[r].path == path && !dip_time_pair_is_disturbed(pair)) {
                    scratch[count++] = log(pair->base_ms / level_ms[f]);
                }
            }
        }
    }
    return dip_level_error(scratch, count);
}

static bool open_level(PathLevel *level, const DipCostReport *report, int path) {
    const size_t frames = (size_t)dip_cost_frame_count(report);
    double *scratch = malloc((size_t)report->row_count * frames * sizeof *scratch);
    *level = (PathLevel){.level_ms = malloc(3 * frames * sizeof(double))};
    bool made = scratch && level->level_ms;
    if (made) {
        level->ms = level->level_ms + frames;
        level->base_ms = level->ms + frames;
        for (size_t f = 0; f < frames; f++) {
            level->level_ms[f] = level_of_frame(report, path, (int)f, scratch);
        }
        level->error = level_error(report, path, level->level_ms, scratch);
        made = level->error >= 0.0;
    }
    free(scratch);
    return made;
}

// --- rows ----------------------------------------------------------------------------------------

// Number of frames that were disturbed in either row.
static int count_disturbed(const DipTimePair *row, const DipTimePair *base, int frames) {
    int count = 0;
    for (int f = 0; f < frames; f++) {
        count += dip_time_pair_is_disturbed(&row[f]) || dip_time_pair_is_disturbed(&base[f]);
    }
    return count;
}

// Returns the times of pairs, in the scratch memory of the level, without those that were
// disturbed. If more than half of them were, all of them are used: the verdict is then red.
static DipPathTimes times_of(const DipCostReport *report, PathLevel *level,
                             double (*ms_of)(const DipTimePair *, const DipTimePair *),
                             double (*base_ms_of)(const DipTimePair *, const DipTimePair *),
                             const DipTimePair *row, const DipTimePair *base) {
    const int frames = dip_cost_frame_count(report);
    const bool most = 2 * count_disturbed(row, base, frames) > frames;
    for (int f = 0; f < frames; f++) {
        const bool drop =
            !most && (dip_time_pair_is_disturbed(&row[f]) || dip_time_pair_is_disturbed(&base[f]));
        level->ms[f] = drop ? NAN : ms_of(&row[f], &base[f]);
        level->base_ms[f] = base_ms_of(&row[f], &base[f]);
    }
    return (DipPathTimes){
        .ms = level->ms,
        .base_ms = level->base_ms,
        .level_ms = level->level_ms,
        .frames = frames,
        .rounds = report->options.rounds,
        .level_error = level->error,
    };
}

static double own_ms(const DipTimePair *row, const DipTimePair *base) {
    (void)base;
    return row->ms;
}

static double own_base_ms(const DipTimePair *row, const DipTimePair *base) {
    (void)base;
    return row->base_ms;
}

// Two rows that were both timed beside the baseline: their ratio is the quotient of their ratios.
static double quotient_ms(const DipTimePair *row, const DipTimePair *base) {
    return row->ms / row->base_ms * base->base_ms;
}

static double quotient_base_ms(const DipTimePair *row, const DipTimePair *base) {
    (void)row;
    return base->ms;
}

bool dip_cost_is_timed(const DipCostReport *report, int row) {
    return report->rounds > 0 && report->rows[row].pairs;
}

double dip_cost_ms(const DipCostReport *report, int row) {
    return report->rows[row].time.mean_ms.value;
}

bool dip_cost_ratio(const DipCostReport *report, int row, int base, DipStatsEstimate *ratio,
                    DipError *err) {
    const DipCostRow *a = &report->rows[row];
    const DipCostRow *b = &report->rows[base];
    if (row == base) {
        *ratio = (DipStatsEstimate){1.0, 1.0, 1.0};
        return true;
    }
    if (base == report->base_rows[a->path]) {
        *ratio = a->time.ratio;
        return true;
    }
    PathLevel level;
    DipPathEstimate time = {0};
    bool done = open_level(&level, report, a->path) || out_of_memory(err);
    for (int f = 0; done && f < dip_cost_frame_count(report); f++) {
        level.level_ms[f] *= b->time.ratio.value; // The level of the base row.
    }
    if (done) {
        const DipPathTimes times =
            times_of(report, &level, quotient_ms, quotient_base_ms, a->pairs, b->pairs);
        done = dip_path_estimate(&times, &time, err);
    }
    close_level(&level);
    *ratio = time.ratio;
    return done;
}

bool dip_cost_frame_times(const DipCostReport *report, const int *rows, int count, double *ms,
                          DipError *err) {
    PathLevel level;
    bool done =
        count == 0 || open_level(&level, report, report->rows[rows[0]].path) || out_of_memory(err);
    for (int i = 0; done && i < count; i++) {
        const DipTimePair *pairs = report->rows[rows[i]].pairs;
        const DipPathTimes times = times_of(report, &level, own_ms, own_base_ms, pairs, pairs);
        done = dip_path_frame_times(&times, ms + (size_t)i * (size_t)times.frames, err);
    }
    if (count > 0) {
        close_level(&level);
    }
    return done;
}

// Computes how a mean time divides into the stages: the shares of the frames that the estimate
// uses, weighted by the baseline's times. Pairs that were read from a file have no shares; then the
// stages keep the times that the file has.
static void divide_into_stages(const DipCostReport *report, const PathLevel *level,
                               const DipTimePair *pairs, double mean_ms,
                               double stage_ms[DIP_COST_STAGE_COUNT]) {
    double sums[DIP_TIME_PARTS] = {0};
    double weight = 0.0, all = 0.0;
    const int frames = dip_cost_frame_count(report);
    const bool most = 2 * count_disturbed(pairs, pairs, frames) > frames;
    for (int f = 0; f < frames; f++) {
        const DipTimePair *pair = &pairs[f];
        const double share = pair->shares[0] + pair->shares[1] + pair->shares[2] + pair->shares[3];
        if (share > 0.0 && (most || !dip_time_pair_is_disturbed(pair))) {
            weight += level->level_ms[f];
            for (int i = 0; i < DIP_TIME_PARTS; i++) {
                sums[i] += level->level_ms[f] * pair->shares[i];
            }
        }
    }
    if (weight > 0.0) {
        for (int i = 0; i < DIP_TIME_PARTS; i++) {
            stage_ms[i] = mean_ms * sums[i] / weight;
            all += stage_ms[i];
        }
        stage_ms[DIP_COST_STAGE_rest] = fmax(mean_ms - all, 0.0);
    }
}

bool dip_cost_estimate_elsewhere(const DipCostReport *report, const DipTimePair *pairs,
                                 DipCostElsewhere *row, DipError *err) {
    PathLevel level;
    DipPathEstimate time = {0};
    bool done = open_level(&level, report, 0) || out_of_memory(err);
    if (done) {
        const DipPathTimes times = times_of(report, &level, own_ms, own_base_ms, pairs, pairs);
        done = dip_path_estimate(&times, &time, err);
        row->ms = time.mean_ms;
        divide_into_stages(report, &level, pairs, row->ms.value, row->stage_ms);
    }
    close_level(&level);
    return done;
}

static bool estimate_sweeps(DipCostReport *report, DipError *err) {
    bool done = true;
    for (int s = 0; s < report->sweep_count; s++) {
        DipCostSweep *sweep = &report->sweeps[s];
        for (int i = 0; done && i < sweep->row_count; i++) {
            done = dip_cost_ratio(report, sweep->rows[i], sweep->base, &sweep->ratios[i], err);
        }
    }
    return done;
}

bool dip_cost_estimate_times(DipCostReport *report, DipError *err) {
    bool done = true;
    for (int path = 0; done && path < report->path_count; path++) {
        PathLevel level;
        done = open_level(&level, report, path) || out_of_memory(err);
        for (int r = 0; done && r < report->row_count; r++) {
            DipCostRow *row = &report->rows[r];
            if (row->path == path) {
                const DipPathTimes times =
                    times_of(report, &level, own_ms, own_base_ms, row->pairs, row->pairs);
                done = dip_path_estimate(&times, &row->time, err);
                divide_into_stages(report, &level, row->pairs, row->time.mean_ms.value,
                                   row->stage_ms);
            }
        }
        close_level(&level);
    }
    return done && estimate_sweeps(report, err) && dip_cost_judge_machine(report, err) &&
           dip_cost_choose(report, err);
}
