// Fits the levels of a base. The level of a frame is the logarithm of the time that the frame takes
// at the machine's usual speed. The speed of a visit or of a round is here the logarithm of the
// factor by which its frames take longer than their levels say. rounds_fit_private.h explains units
// and cells.
#include "app/measure/stats/rounds_fit_private.h"

#include "app/measure/stats/estimate.h"

#include <string.h>

enum {
    SWEEPS = 40,     // Number of times that levels and speeds are fitted in turn.
    SPEED_GROUPS = 4 // If there is one start, at most this many groups of rounds are compared.
};

// Lists the base's times as cells. Leaves out disturbed times, unless most are disturbed.
static void list_base_times(DipTimesWork *w, int base) {
    const DipTimes *times = w->times;
    const int from = w->first_of[base], end = w->first_of[base + 1];
    int disturbed = 0;
    for (int i = from; i < end; i++) {
        disturbed += w->sorted[i]->wait > DIP_TIMED_MOST_WAIT;
    }
    const bool all = 2 * disturbed > end - from;
    const DipTimed *last = NULL;
    w->cell_count = w->base_visits = 0;
    for (int i = from; i < end; i++) {
        const DipTimed *t = w->sorted[i];
        w->base_visits += !last || !dip_times_same_visit(last, t);
        last = t;
        if (t->ms > 0.0 && (all || t->wait <= DIP_TIMED_MOST_WAIT)) {
            w->cells[w->cell_count++] = (DipTimesCell){t->frame, w->base_visits - 1,
                                                       dip_times_unit(times, t), log(t->ms), 1.0};
        }
    }
}

static double rest_of(const DipTimesWork *w, const DipTimesCell *cell, const double *level) {
    return cell->log_ms - level[cell->frame] - w->speed[cell->visit];
}

// Sets the trust of each cell by its distance from the fit, with Tukey's biweight: 1 at distance 0,
// falling to 0 at 6 times the median distance.
static void trust_cells(DipTimesWork *w, int left_out, const double *level) {
    int count = 0;
    for (int i = 0; i < w->cell_count; i++) {
        if (w->cells[i].unit != left_out) {
            w->logs[count++] = fabs(rest_of(w, &w->cells[i], level));
        }
    }
    const double typical = count > 0 ? dip_median(w->logs, count) : 0.0;
    for (int i = 0; i < w->cell_count; i++) {
        const double distance = rest_of(w, &w->cells[i], level) / (6.0 * typical + 1e-9);
        const double close = 1.0 - fmin(distance * distance, 1.0);
        w->cells[i].trust = close * close;
    }
}

// If is_level is true, sets the levels of frames to weighted means of log ms - speed. Otherwise
// sets the speeds of visits to weighted means of log ms - level. `other` holds the values that are
// subtracted. Leaves out the cells of the unit `left_out`.
static void fit_side(DipTimesWork *w, int left_out, double *to, int count, const double *other,
                     bool is_level) {
    memset(to, 0, (size_t)count * sizeof *to);
    memset(w->weights, 0, (size_t)count * sizeof *w->weights);
    for (int i = 0; i < w->cell_count; i++) {
        const DipTimesCell *cell = &w->cells[i];
        if (cell->unit != left_out) {
            const int at = is_level ? cell->frame : cell->visit;
            const double weight = cell->trust + 1e-3;
            to[at] += weight * (cell->log_ms - other[is_level ? cell->visit : cell->frame]);
            w->weights[at] += weight;
        }
    }
    for (int i = 0; i < count; i++) {
        to[i] = w->weights[i] > 0.0 ? to[i] / w->weights[i] : NAN;
    }
}

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

// Fits log ms = level(frame) + speed(visit) + rest, without the cells of the unit `left_out`, or
// with all cells if `left_out` is -1. Levels of frames that have no cell are NAN.
static void fit_levels(DipTimesWork *w, int left_out, double *level) {
    const int frames = w->times->frames;
    memset(w->speed, 0, (size_t)w->base_visits * sizeof *w->speed);
    for (int i = 0; i < w->cell_count; i++) {
        w->cells[i].trust = 1.0;
    }
    for (int sweep = 0; sweep < SWEEPS; sweep++) {
        fit_side(w, left_out, level, frames, w->speed, true);
        fit_side(w, left_out, w->speed, w->base_visits, level, false);
        if (sweep % 10 == 9) {
            trust_cells(w, left_out, level);
        }
    }
}

double dip_times_noise_of_levels(const double *levels, int frames, int units) {
    double squares = 0.0;
    for (int unit = 0; unit < units; unit++) {
        const double *without = levels + (unit + 1) * frames;
        double mean = 0.0, sum = 0.0;
        int known = 0;
        for (int f = 0; f < frames; f++) {
            const double moved = without[f] - levels[f];
            if (!isnan(moved)) {
                known++;
                sum += (moved - mean) * (moved - mean) * (known - 1) / known;
                mean += (moved - mean) / known;
            }
        }
        squares += known > 0 ? sum / known : 0.0;
    }
    return 0.5 * squares * (units - 1.0) / units;
}

// Predicts the level of each frame as the mean of its neighbours' levels: up to `reach` frames on
// either side, as many on one side as on the other. The first and the last frame of the path get
// the level of their only neighbour. Returns the mean squared difference of predictions and levels.
static double predict_levels(const double *level, int frames, int reach, double *to) {
    double squares = 0.0;
    for (int f = 0; f < frames; f++) {
        const int inside = f < frames - 1 - f ? f : frames - 1 - f;
        const int side = inside < reach ? inside : reach;
        double sum = side > 0 ? 0.0 : level[f == 0 ? 1 : f - 1];
        for (int i = 1; i <= side; i++) {
            sum += 0.5 * (level[f - i] + level[f + i]) / side;
        }
        to[f] = sum;
        squares += (level[f] - sum) * (level[f] - sum) / frames;
    }
    return squares;
}

// Returns which of 1, 2, 4, 8 and 16 neighbours on either side predict the levels best.
static int choose_reach(DipTimesWork *w, const double *level) {
    int best = 1;
    double least = INFINITY;
    for (int reach = 1; reach <= 16; reach *= 2) {
        const double squares = predict_levels(level, w->times->frames, reach, w->time);
        if (squares < least) {
            least = squares;
            best = reach;
        }
    }
    return best;
}

// Replaces each level by the weighted mean of the level and the prediction from its neighbours. The
// weights are the inverse variances of the two. `noise` is the variance of the levels' noise. A
// prediction is wrong because the neighbours are noisy and because the levels change along the
// path; its variance is estimated as the mean squared difference from the levels, minus `noise`,
// but as at least noise / (2 * reach), the noise of the mean of the neighbours. Returns by how much
// the variance of the true levels exceeds that of the new levels.
static double join_neighbours(DipTimesWork *w, int reach, double noise, double *level) {
    const int frames = w->times->frames;
    if (frames < 3 || !(noise > 0.0)) { // Too few neighbours, or the noise is not known.
        return 0.0;
    }
    const double squares = predict_levels(level, frames, reach, w->time);
    const double missed = fmax(squares - noise, 0.5 * noise / reach);
    const double own = missed / (missed + noise);
    for (int f = 0; f < frames; f++) {
        level[f] = own * level[f] + (1.0 - own) * w->time[f];
    }
    return own * noise;
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

// Returns how much slower than their levels the base's frames were in a round: the median of log ms
// - level. Returns NAN if the round has no frames of the base.
static double speed_of_round(DipTimesWork *w, int base, int round, const double *level) {
    int count = 0;
    for (int i = w->first_of[base]; i < w->first_of[base + 1]; i++) {
        const DipTimed *t = w->sorted[i];
        if (dip_times_round(w->times, t) == round && t->ms > 0.0) {
            w->logs[count++] = log(t->ms) - level[t->frame];
        }
    }
    return count > 0 ? dip_median(w->logs, count) : NAN;
}

// Computes the speeds of the rounds. Adds their median, the usual speed, to the levels that were
// fitted from all units. Computes the error of the levels' mean from how much the speeds differ
// between the starts, or between groups of successive rounds if there is only one start.
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
    list_base_times(w, base);
    const int frames = w->times->frames, units = w->fit->units;
    for (int unit = -1; unit < units; unit++) {
        fit_levels(w, unit, w->level + (unit + 1) * frames);
    }
    const double noise = dip_times_noise_of_levels(w->level, frames, units);
    dip_times_fill_gaps(w->level, frames);
    const int reach = frames > 2 ? choose_reach(w, w->level) : 1;
    for (int unit = -1; unit < units; unit++) {
        double *level = w->level + (unit + 1) * frames;
        const double share = unit < 0 ? 1.0 : units / (units - 1.0);
        dip_times_fill_gaps(level, frames);
        w->missing[unit + 1] = join_neighbours(w, reach, share * noise, level);
    }
    judge_speeds(w, base);
}
