// The base's levels: how long each frame takes at the machine's usual speed.
#include "app/measure/stats/rounds_fit.h"

#include "app/measure/stats/estimate.h"

#include <stdlib.h>
#include <string.h>

enum {
    SWEEPS = 40,     // Of the fit of levels and speeds.
    SPEED_GROUPS = 4 // Groups of rounds whose speeds are compared, if there is one start.
};

static int compare_cells(const void *a, const void *b) {
    const DipTimesCell *x = a, *y = b;
    return x->moment != y->moment ? x->moment - y->moment
           : x->frame != y->frame ? x->frame - y->frame
                                  : x->visit - y->visit;
}

// Lists the base's times. Of those that were disturbed, only if most were.
static int list_base_times(DipTimesWork *w, int base) {
    const DipTimes *times = w->times;
    const int from = w->first_of[base], end = w->first_of[base + 1];
    int disturbed = 0, count = 0, visit = -1;
    for (int i = from; i < end; i++) {
        disturbed += times->list[w->order[i]].wait > DIP_TIMED_MOST_WAIT;
    }
    const bool all = 2 * disturbed > end - from;
    const DipTimed *last = NULL;
    int moment = 0;
    w->moment_count = 0;
    for (int i = from; i < end; i++) {
        const DipTimed *t = &times->list[w->order[i]];
        const int round = dip_times_round(times, t);
        if (!last || last->block != t->block || dip_times_round(times, last) != round) {
            visit++;
            moment = w->moment_count;
            while (moment > 0 && w->moments[moment - 1].round == round &&
                   w->moments[moment - 1].first_frame != t->frame) {
                moment--;
            }
            if (moment > 0 && w->moments[moment - 1].round == round) {
                moment--;
            } else {
                moment = w->moment_count++;
                w->moments[moment] = (DipTimesMoment){round, t->frame};
            }
        }
        last = t;
        if (t->ms > 0.0 && (all || t->wait <= DIP_TIMED_MOST_WAIT)) {
            w->cells[count++] = (DipTimesCell){t->frame,   moment, visit, dip_times_unit(times, t),
                                               log(t->ms), 1.0,    1.0};
        }
    }
    w->base_visits = visit + 1;
    return count;
}

// Returns the end of the cell that begins at `first`: of the times of one frame in one moment.
static int end_of_cell(const DipTimesWork *w, int first, int count) {
    int end = first;
    while (end < count && w->cells[end].moment == w->cells[first].moment &&
           w->cells[end].frame == w->cells[first].frame) {
        end++;
    }
    return end;
}

// Joins the times of each cell: their median over the visits, after the visits' own speeds were
// taken out.
static void join_cells(DipTimesWork *w, int count) {
    double *speed = w->rest;   // [visit]
    double *sum = w->of_visit; // [visit]
    int *frames = w->visits;   // [visit]
    memset(speed, 0, (size_t)w->base_visits * sizeof *speed);
    for (int pass = 0; pass < 3; pass++) {
        memset(sum, 0, (size_t)w->base_visits * sizeof *sum);
        memset(frames, 0, (size_t)w->base_visits * sizeof *frames);
        w->cell_count = 0;
        for (int first = 0, end; first < count; first = end) {
            end = end_of_cell(w, first, count);
            for (int i = first; i < end; i++) {
                w->logs[i - first] = w->cells[i].log_ms - speed[w->cells[i].visit];
            }
            const double middle = dip_median(w->logs, end - first);
            for (int i = first; i < end; i++) {
                sum[w->cells[i].visit] += w->cells[i].log_ms - middle;
                frames[w->cells[i].visit]++;
            }
            w->smooth[w->cell_count++] = middle;
        }
        for (int v = 0; v < w->base_visits; v++) {
            speed[v] = frames[v] > 0 ? sum[v] / frames[v] : 0.0;
        }
    }
    for (int first = 0, end, cell = 0; first < count; first = end, cell++) {
        end = end_of_cell(w, first, count);
        w->cells[cell] = w->cells[first];
        w->cells[cell].log_ms = w->smooth[cell];
        // More visits make the differences between a moment's frames better known, not its speed.
        w->cells[cell].weight = (end - first) / (1.0 + 0.2 * (end - first - 1));
    }
}

static double rest_of(const DipTimesWork *w, const DipTimesCell *cell, const double *level) {
    return cell->log_ms - level[cell->frame] - w->speed[cell->moment];
}

// Weights cells by their distance from the fit: Tukey's biweight of 6 times the typical distance.
static double trust_cells(DipTimesWork *w, int set, const double *level) {
    int count = 0;
    for (int i = 0; i < w->cell_count; i++) {
        if (dip_times_is_in_set(w, set, w->cells[i].unit)) {
            w->logs[count++] = fabs(rest_of(w, &w->cells[i], level)) * sqrt(w->cells[i].weight);
        }
    }
    const double typical = count > 0 ? dip_median(w->logs, count) : 0.0;
    for (int i = 0; i < w->cell_count; i++) {
        const double distance =
            rest_of(w, &w->cells[i], level) * sqrt(w->cells[i].weight) / (6.0 * typical + 1e-9);
        const double close = 1.0 - fmin(distance * distance, 1.0);
        w->cells[i].trust = close * close;
    }
    return typical;
}

// Sets levels, or speeds, to the weighted means of what remains.
static void fit_side(DipTimesWork *w, int set, double *to, int count, const double *other,
                     bool is_level) {
    memset(to, 0, (size_t)count * sizeof *to);
    memset(w->weights, 0, (size_t)count * sizeof *w->weights);
    for (int i = 0; i < w->cell_count; i++) {
        const DipTimesCell *cell = &w->cells[i];
        if (dip_times_is_in_set(w, set, cell->unit)) {
            const int at = is_level ? cell->frame : cell->moment;
            const double weight = cell->weight * (cell->trust + 1e-3);
            to[at] += weight * (cell->log_ms - other[is_level ? cell->moment : cell->frame]);
            w->weights[at] += weight;
        }
    }
    for (int i = 0; i < count; i++) {
        to[i] = w->weights[i] > 0.0 ? to[i] / w->weights[i] : NAN;
    }
}

// Fills values that are not known from their neighbours: linear between them, constant beyond.
void dip_times_fill_gaps(double *values, int count) {
    int last = -1;
    for (int i = 0; i < count; i++) {
        if (isnan(values[i])) {
            continue;
        }
        for (int j = last + 1; j < i; j++) {
            const double share = (double)(j - last) / (i - last);
            values[j] = last < 0 ? values[i] : values[last] + share * (values[i] - values[last]);
        }
        last = i;
    }
    for (int j = last + 1; last >= 0 && j < count; j++) {
        values[j] = values[last];
    }
}

// Fits log ms = level(frame) + speed(moment) + rest from the cells of a set.
// Levels of frames that have no cell are interpolated. Returns the mean variance of the noise that
// levels have.
static double fit_levels(DipTimesWork *w, int set, double *level) {
    const int frames = w->times->frames;
    double typical = 0.0;
    memset(w->speed, 0, (size_t)w->moment_count * sizeof *w->speed);
    for (int i = 0; i < w->cell_count; i++) {
        w->cells[i].trust = 1.0;
    }
    for (int sweep = 0; sweep < SWEEPS; sweep++) {
        fit_side(w, set, level, frames, w->speed, true);
        fit_side(w, set, w->speed, w->moment_count, level, false);
        if (sweep % 10 == 9) {
            typical = trust_cells(w, set, level);
        }
    }
    int cells = 0, levels = 0, moments = 0;
    for (int i = 0; i < w->cell_count; i++) {
        cells += dip_times_is_in_set(w, set, w->cells[i].unit);
    }
    for (int m = 0; m < w->moment_count; m++) {
        moments += !isnan(w->speed[m]);
    }
    double noise = 0.0;
    fit_side(w, set, level, frames, w->speed, true);
    for (int f = 0; f < frames; f++) {
        if (w->weights[f] > 0.0) {
            noise += 1.0 / w->weights[f];
            levels++;
        }
    }
    dip_times_fill_gaps(level, frames);
    const int free_cells = cells - levels - moments + 1;
    const double spread = DIP_TIMES_MAD_TO_SD * typical;
    return free_cells > 0 ? noise / levels * spread * spread * cells / free_cells : 0.0;
}

static double deviation(const double *values, int count) {
    double mean = 0.0, squares = 0.0;
    for (int i = 0; i < count; i++) {
        mean += values[i] / count;
    }
    for (int i = 0; i < count; i++) {
        squares += (values[i] - mean) * (values[i] - mean);
    }
    return sqrt(squares / (count - 1));
}

// Returns the median of what the base's frames took in a round beyond their level; NAN without any.
static double speed_of_round(DipTimesWork *w, int base, int round, const double *level) {
    int count = 0;
    for (int i = w->first_of[base]; i < w->first_of[base + 1]; i++) {
        const DipTimed *t = &w->times->list[w->order[i]];
        if (dip_times_round(w->times, t) == round && t->ms > 0.0) {
            w->logs[count++] = log(t->ms) - level[t->frame];
        }
    }
    return count > 0 ? dip_median(w->logs, count) : NAN;
}

// Finds the rounds' speeds, relates the levels to the usual one (the median), and tells how far the
// mean of the starts, or of groups of successive rounds, can be off.
static void judge_speeds(DipTimesWork *w, int b) {
    const DipTimes *times = w->times;
    DipTimesBase *base = &w->fit->bases[b];
    double *level = w->level;
    const int rounds = times->starts * times->rounds;
    const int groups = times->starts > 1       ? times->starts
                       : rounds < SPEED_GROUPS ? rounds
                                               : SPEED_GROUPS;
    double of_groups[DIP_TIMED_MOST_STARTS];
    int group_count = 0, known = 0;
    for (int g = 0; g < groups; g++) {
        double sum = 0.0;
        const int before = known;
        for (int r = g * rounds / groups; r < (g + 1) * rounds / groups; r++) {
            const double speed = speed_of_round(w, b, r, level);
            if (!isnan(speed)) {
                w->rest[known++] = speed;
                sum += speed;
            }
        }
        if (known > before) {
            of_groups[group_count++] = sum / (known - before);
        }
    }
    base->moment = known > 1 ? deviation(w->rest, known) : NAN;
    base->level_error = NAN;
    if (group_count > 1) {
        base->level_error =
            fmax(deviation(of_groups, group_count) / sqrt(group_count), DIP_TIMES_LEAST_ERROR);
        base->level_degrees = group_count - 1;
    }
    const double usual = known > 0 ? dip_median(w->rest, known) : 0.0;
    for (int f = 0; f < times->frames; f++) {
        level[f] += usual;
        base->level_ms += exp(level[f]) / times->frames;
    }
}

void dip_times_fit_levels(DipTimesWork *w, int base) {
    const int count = list_base_times(w, base);
    qsort(w->cells, (size_t)count, sizeof *w->cells, compare_cells);
    join_cells(w, count);
    for (int set = -1; set < w->fit->units; set++) {
        w->noise[set + 1] = fit_levels(w, set, w->level + (set + 1) * w->times->frames);
    }
    judge_speeds(w, base);
}
