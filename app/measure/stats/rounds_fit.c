// Fits the times of subjects relative to those of their bases, once from all units and once for
// each unit (rounds_fit_private.h).
#include "app/measure/stats/rounds_fit_private.h"

#include "app/measure/stats/estimate.h"
#include "renderer/base/assert.h"
#include "renderer/base/fp_mode.h"

#include <stdlib.h>
#include <string.h>

// If a subject has more visits than this, the median of the visits replaces Hodges and Lehmann's
// estimate, whose work grows with the square of the number.
enum { MOST_VISITS = 512 };

// A subject's variance is drawn towards the mean variance of all subjects of its base. That mean
// counts for at most this many degrees of freedom, since some subjects are noisier than others.
static const double most_pooled_degrees = 12.0;

// If each round draws only the frames that dip_rounds_deal gives it, the jackknife's variance is
// too great by about this factor: a subject draws each frame in one unit only, so leaving out the
// unit removes all times of these frames. test_rounds_simulated draws such logs.
static const double excess_of_dealt_frames = 1.25;

// --- order of the log ----------------------------------------------------------------------------

// Compares two elements of DipTimesWork.sorted by subject, start, round, block and frame.
static int compare_places(const void *a, const void *b) {
    const DipTimed *x = *(const DipTimed *const *)a, *y = *(const DipTimed *const *)b;
    const int of_x[] = {x->subject, x->start, x->round, x->block, x->frame};
    const int of_y[] = {y->subject, y->start, y->round, y->block, y->frame};
    int side = 0;
    for (int i = 0; side == 0 && i < 5; i++) {
        side = (of_x[i] > of_y[i]) - (of_x[i] < of_y[i]);
    }
    return side;
}

// Compares as compare_places does. Elements that compare_places finds equal keep their order in the
// log.
static int compare_times(const void *a, const void *b) {
    const DipTimed *x = *(const DipTimed *const *)a, *y = *(const DipTimed *const *)b;
    const int side = compare_places(a, b);
    return side ? side : (x > y) - (x < y);
}

static void sort_times(DipTimesWork *w) {
    const DipTimes *times = w->times;
    for (int i = 0; i < times->count; i++) {
        const DipTimed *t = &times->list[i];
        DIP_ASSERT(t->subject >= 0 && t->subject < times->subjects && t->start >= 0 &&
                   t->start < times->starts && t->round >= 0 && t->round < times->rounds &&
                   t->frame >= 0 && t->frame < times->frames);
        w->sorted[i] = t;
    }
    qsort(w->sorted, (size_t)times->count, sizeof *w->sorted, compare_times);
    for (int s = 0, at = 0; s <= times->subjects; s++) {
        while (at < times->count && w->sorted[at]->subject < s) {
            at++;
        }
        w->first_of[s] = at;
    }
}

// --- a subject's ratios along the path -----------------------------------------------------------

// Returns the base's time of the same frame in the same block, or NULL if there is none.
static const DipTimed *beside(const DipTimesWork *w, int base, const DipTimed *timed) {
    DipTimed wanted = *timed;
    wanted.subject = base;
    const DipTimed *key = &wanted;
    const DipTimed *const *found =
        bsearch(&key, w->sorted + w->first_of[base],
                (size_t)(w->first_of[base + 1] - w->first_of[base]), sizeof key, compare_places);
    return found ? *found : NULL;
}

static double log_ratio(const DipTimesWork *w, const DipTimed *timed, const DipTimed *base) {
    if (w->part < 0) {
        return log(timed->ms / base->ms);
    }
    const double more = timed->parts_ms[w->part] - base->parts_ms[w->part];
    return log(fmax(1.0 + more / base->ms, 0.01));
}

static int compare_pairs(const void *a, const void *b) {
    const DipTimesPair *x = a, *y = b;
    return x->frame != y->frame ? x->frame - y->frame : x->visit - y->visit;
}

// Lists the pairs of a subject and its base in path order. Leaves out pairs with a disturbed frame,
// unless most pairs have one.
static void list_pairs(DipTimesWork *w, int subject, DipTimesSubject *to) {
    const DipTimes *times = w->times;
    for (int pass = 0; pass < 2; pass++) {
        const DipTimed *last = NULL;
        w->pair_count = 0;
        w->visit_count = 0;
        to->timed = 0;
        for (int i = w->first_of[subject]; i < w->first_of[subject + 1]; i++) {
            const DipTimed *t = w->sorted[i];
            const DipTimed *base = beside(w, to->base, t);
            if (!base || !(t->ms > 0.0) || !(base->ms > 0.0)) {
                continue;
            }
            to->timed++;
            if (pass == 0 && (t->wait > DIP_TIMED_MOST_WAIT || base->wait > DIP_TIMED_MOST_WAIT)) {
                continue;
            }
            w->visit_count += !last || !dip_times_same_visit(last, t);
            last = t;
            w->pairs[w->pair_count++] = (DipTimesPair){
                t->frame, w->visit_count - 1, dip_times_unit(times, t), log_ratio(w, t, base)};
        }
        if (pass == 0) {
            to->kept = w->pair_count;
            if (2 * to->kept >= to->timed) {
                break;
            }
        }
    }
    qsort(w->pairs, (size_t)w->pair_count, sizeof *w->pairs, compare_pairs);
}

// Returns the median of the means of all pairs of values, including each value paired with itself
// (Hodges and Lehmann 1963).
static double hodges_lehmann(const double *values, int count, double *means) {
    int pairs = 0;
    for (int i = 0; i < count; i++) {
        for (int j = i; j < count; j++) {
            means[pairs++] = 0.5 * (values[i] + values[j]);
        }
    }
    return dip_median(means, pairs);
}

// Returns the index of the first of `count` sorted values that is not less than `value`.
static int find_sorted(const double *sorted, int count, double value) {
    int low = 0, high = count;
    while (low < high) {
        const int middle = (low + high) / 2;
        *(sorted[middle] < value ? &low : &high) = sorted[middle] < value ? middle + 1 : middle;
    }
    return low;
}

static void insert_sorted(double *sorted, int *count, double value) {
    const int at = find_sorted(sorted, *count, value);
    memmove(sorted + at + 1, sorted + at, (size_t)(*count - at) * sizeof *sorted);
    sorted[at] = value;
    ++*count;
}

// Returns the median of sorted values without the value at index `without`. If `without` is
// `count`, no value is left out.
static double median_of_sorted(const double *sorted, int count, int without) {
    const int rest = count - (without < count);
    const int below = (rest - 1) / 2, above = rest / 2;
    return 0.5 * (sorted[below + (below >= without)] + sorted[above + (above >= without)]);
}

// Writes for each value the median of the value and its neighbours, up to window / 2 of them on
// either side. If `without` is true, leaves out the value itself.
static void running_median(const double *values, int count, int window, bool without, double *to,
                           double *sorted) {
    const int side = window / 2 < count ? window / 2 : count;
    int in_window = 0;
    for (int i = -side; i < count; i++) {
        if (i + side < count) {
            insert_sorted(sorted, &in_window, values[i + side]);
        }
        if (i - side - 1 >= 0) {
            const int at = find_sorted(sorted, in_window, values[i - side - 1]);
            memmove(sorted + at, sorted + at + 1, (size_t)(--in_window - at) * sizeof *sorted);
        }
        if (i >= 0) {
            to[i] = median_of_sorted(
                sorted, in_window, without ? find_sorted(sorted, in_window, values[i]) : in_window);
        }
    }
}

// Writes for each value the median of all values of the same frame. If `without` is true, leaves
// out the value itself, unless the frame has no other.
static void median_of_frames(const double *values, const int *frames, int count, bool without,
                             double *smooth, double *sorted) {
    for (int first = 0, end; first < count; first = end) {
        int in_frame = 0;
        for (end = first; end < count && frames[end] == frames[first]; end++) {
            insert_sorted(sorted, &in_frame, values[end]);
        }
        for (int i = first; i < end; i++) {
            const int left_out =
                without && in_frame > 1 ? find_sorted(sorted, in_frame, values[i]) : in_frame;
            smooth[i] = median_of_sorted(sorted, in_frame, left_out);
        }
    }
}

// Returns the sum of the distances of the log ratios from their predictions in w->smooth. A very
// wrong prediction comes from a disturbed visit, so its distance counts for no more than 3 times
// the median distance.
static double misses_of(DipTimesWork *w, int count) {
    for (int i = 0; i < count; i++) {
        w->rest[i] = fabs(w->logs[i] - w->smooth[i]);
    }
    double sum = 0.0;
    const double typical = dip_median(w->rest, count);
    for (int i = 0; i < count; i++) {
        sum += fmin(w->rest[i], 3.0 * typical);
    }
    return sum;
}

// Chooses how log ratios are smoothed along the path: what predicts each value best from the
// others, most of which were timed in other rounds. That is a running median with a window
// (w->window), or, if there are at least 3 pairs per frame, the median of a frame (w->repeats). A
// choice that joins fewer values must be 3 % better than one that joins more, since the relative
// cost of most settings is the same along the whole path.
static void choose_smoothing(DipTimesWork *w, int count) {
    const int frames = w->times->frames;
    const int windows[] = {2 * count + 1, 31, 15, 7};
    const int per_frame = count < frames ? 1 : count / frames;
    double least = INFINITY;
    w->window = windows[0];
    for (int k = 0; k < 4 && count > 2; k++) {
        const int window = k == 0 ? windows[0] : windows[k] * per_frame | 1;
        running_median(w->logs, count, window, true, w->smooth, w->of_visit);
        const double misses = misses_of(w, count);
        if (misses < 0.97 * least) {
            least = misses;
            w->window = window;
        }
    }
    w->repeats = w->times->complete;
    if (!w->repeats && count >= 3 * frames) {
        median_of_frames(w->logs, w->pair_frames, count, true, w->smooth, w->of_visit);
        w->repeats = misses_of(w, count) < 0.97 * least;
    }
    w->window = w->repeats ? 0 : w->window;
}

// Returns the offset that all pairs have in common after the smoothed log ratios were subtracted:
// Hodges and Lehmann's estimate from the medians of the visits. Writes to w->spread how far these
// medians lie apart. A visit counts once, since what slows down one of its frames slows down its
// other frames, too.
static double common_rest(DipTimesWork *w, int count, const int *visits, const double *rest) {
    int found = 0;
    double *of_visits = w->logs; // The log ratios are no longer needed.
    for (int v = 0; v < w->visit_count; v++) {
        int in_visit = 0;
        for (int i = 0; i < count; i++) {
            if (visits[i] == v) {
                w->of_visit[in_visit++] = rest[i];
            }
        }
        if (in_visit > 0) {
            of_visits[found++] = dip_median(w->of_visit, in_visit);
        }
    }
    w->spread = NAN;
    if (found > 1) {
        memcpy(w->of_visit, of_visits, (size_t)found * sizeof *of_visits);
        const double middle = dip_median(w->of_visit, found);
        for (int i = 0; i < found; i++) {
            w->of_visit[i] = fabs(of_visits[i] - middle);
        }
        w->spread = DIP_TIMES_MAD_TO_SD * dip_median(w->of_visit, found);
    }
    return found <= MOST_VISITS ? hodges_lehmann(of_visits, found, w->means)
                                : dip_median(of_visits, found);
}

// Moves the times of frames closer to their mean, so that the variance of their logarithms falls by
// noise_variance. If noise_variance is negative, moves them apart. Noise makes the times differ
// more than the true times do, so percentiles would be too high. Keeps the mean.
static void take_off_noise(double *ms, int frames, double noise_variance) {
    double mean = 0.0, squares = 0.0, before = 0.0, after = 0.0;
    for (int f = 0; f < frames; f++) {
        mean += log(ms[f]) / frames;
        before += ms[f];
    }
    for (int f = 0; f < frames; f++) {
        squares += (log(ms[f]) - mean) * (log(ms[f]) - mean) / frames;
    }
    const double share = sqrt(fmax(1.0 - noise_variance / (squares + 1e-12), 0.0));
    for (int f = 0; f < frames; f++) {
        ms[f] = exp(mean + share * (log(ms[f]) - mean));
        after += ms[f];
    }
    for (int f = 0; f < frames; f++) {
        ms[f] *= before / after;
    }
}

// Estimates the log ratio of each frame from the first `count` elements of w->logs, and writes it
// to w->ratio. Returns the variance of the noise in w->ratio.
static double fit_ratios(DipTimesWork *w, int count) {
    if (w->repeats) {
        median_of_frames(w->logs, w->pair_frames, count, false, w->smooth, w->of_visit);
    } else {
        running_median(w->logs, count, w->window, false, w->smooth, w->of_visit);
    }
    for (int i = 0; i < count; i++) {
        w->rest[i] = w->logs[i] - w->smooth[i];
        w->of_visit[i] = fabs(w->rest[i]);
    }
    const double noise = DIP_TIMES_MAD_TO_SD * dip_median(w->of_visit, count);
    const double common = common_rest(w, count, w->visits, w->rest);
    for (int i = 0; i < count; i++) {
        w->ratio[w->pair_frames[i]] = w->smooth[i] + common;
    }
    dip_times_fill_gaps(w->ratio, w->times->frames);
    const double joined = w->repeats ? (double)count / w->times->frames : fmin(w->window, count);
    return 1.5 / (joined + 0.5) * noise * noise; // Variance of a median of `joined` values.
}

// Returns whether a unit's times belong to a set. Set -1 holds the times of all units. Set n >= 0
// holds only those of unit n if w->is_alone, and otherwise those of all units but n.
static bool is_in_set(const DipTimesWork *w, int set, int unit) {
    return set < 0 || (unit == set) == w->is_alone;
}

// Computes from the times of a set (is_in_set) the logarithms of a subject's values, and writes the
// times of its frames to w->time. If the set has no times, sets the logarithms to NAN and returns
// false.
static bool find_values(DipTimesWork *w, int set, double logs[DIP_TIMES_VALUE_COUNT]) {
    const int frames = w->times->frames;
    const int lacking = w->is_alone && !w->is_base ? 0 : set + 1;
    const double *level = w->level + lacking * frames;
    int count = 0;
    for (int f = 0; f < frames; f++) {
        w->ratio[f] = w->is_base ? 0.0 : NAN;
    }
    for (int i = 0; i < w->pair_count; i++) {
        if (is_in_set(w, set, w->pairs[i].unit)) {
            w->logs[count] = w->pairs[i].log_ratio;
            w->pair_frames[count] = w->pairs[i].frame;
            w->visits[count++] = w->pairs[i].visit;
        }
    }
    for (int v = 0; v < DIP_TIMES_VALUE_COUNT; v++) {
        logs[v] = NAN;
    }
    if ((count == 0 && !w->is_base) || isnan(level[0])) {
        return false;
    }
    if (set < 0 && count > 0) {
        choose_smoothing(w, count);
    }
    const double noise = count > 0 ? fit_ratios(w, count) : 0.0;
    double base_total = 0.0, total = 0.0, worst = 0.0;
    for (int f = 0; f < frames; f++) {
        w->time[f] = exp(level[f] + w->ratio[f]);
        base_total += exp(level[f]);
        total += w->time[f];
    }
    const double missing = w->missing[lacking];
    w->doubt = noise + missing;
    take_off_noise(w->time, frames, noise - missing);
    for (int f = 0; f < frames; f++) {
        worst = fmax(worst, w->time[f]);
        w->ratio[f] = w->time[f]; // Copied, since dip_percentile sorts its input.
    }
    logs[DIP_TIMES_RATIO] = log(total / base_total);
    logs[DIP_TIMES_P95] = log(dip_percentile(w->ratio, frames, 0.95) * frames / base_total);
    logs[DIP_TIMES_WORST] = log(worst * frames / base_total);
    return true;
}

// --- a subject -----------------------------------------------------------------------------------

// Computes which share of the subject's time each part of its work takes. Leaves out disturbed
// frames, unless most are disturbed or the subject is a base.
static void find_shares(const DipTimesWork *w, int s, DipTimesSubject *subject) {
    const bool all = w->is_base || 2 * subject->kept < subject->timed;
    double total = 0.0;
    for (int i = w->first_of[s]; i < w->first_of[s + 1]; i++) {
        const DipTimed *t = w->sorted[i];
        if (t->ms > 0.0 && (all || !(t->wait > DIP_TIMED_MOST_WAIT))) {
            const double weight = exp(w->level[t->frame]);
            total += weight;
            for (int p = 0; p < DIP_TIMED_PARTS; p++) {
                subject->shares[p] += weight * t->parts_ms[p] / t->ms;
            }
        }
    }
    for (int p = 0; p < DIP_TIMED_PARTS && total > 0.0; p++) {
        subject->shares[p] /= total;
    }
}

// Computes how far each unit moves the values. If find_values leaves out the unit, the move is
// units - 1 times the difference that this makes (the jackknife). If find_values uses the times of
// this unit alone, the move is the unit's values minus the mean of the values of all units that
// have times. If some units have no times, this difference is scaled up. In the first case, all
// moves are NAN if the values are not known without one of the units; in the second case, if fewer
// than two units have times.
static void find_moves(DipTimesWork *w, int s) {
    DipTimesFit *fit = w->fit;
    const int units = fit->units;
    double mean[DIP_TIMES_VALUE_COUNT] = {0};
    int known = 0;
    for (int unit = 0; unit < units; unit++) {
        double *move = dip_times_moves(fit, s, unit);
        known += find_values(w, unit, move);
        for (int v = 0; v < DIP_TIMES_VALUE_COUNT; v++) {
            mean[v] += isnan(move[v]) ? 0.0 : move[v];
        }
    }
    double scale = known == units ? 1.0 - units : NAN;
    if (w->is_alone && !w->is_base) {
        scale = known > 1 ? sqrt(units * (units - 1.0) / (known * (known - 1.0))) : NAN;
    }
    for (int unit = 0; unit < units; unit++) {
        double *move = dip_times_moves(fit, s, unit);
        for (int v = 0; v < DIP_TIMES_VALUE_COUNT; v++) {
            move[v] = scale * (isnan(move[v]) ? 0.0 : move[v] - mean[v] / known);
        }
    }
}

static void fit_subject(DipTimesWork *w, int s) {
    DipTimesFit *fit = w->fit;
    DipTimesSubject *subject = &fit->subjects[s];
    w->is_base = s == subject->base;
    w->pair_count = 0;
    if (!w->is_base) {
        list_pairs(w, s, subject);
    }
    w->spread = NAN;
    const bool known = find_values(w, -1, subject->logs);
    subject->spread = w->spread;
    subject->doubt = known ? w->doubt : 0.0;
    for (int f = 0; f < fit->frames; f++) {
        fit->frame_ms[(size_t)s * (size_t)fit->frames + (size_t)f] = known ? w->time[f] : NAN;
    }
    find_shares(w, s, subject);
    find_moves(w, s);
}

// --- the parts of the variance -------------------------------------------------------------------

static bool has_moves(const DipTimesFit *fit, int subject) {
    return !isnan(dip_times_moves(fit, subject, 0)[DIP_TIMES_RATIO]);
}

static int list_members(const DipTimesWork *w, int base) {
    int count = 0;
    for (int s = 0; s < w->times->subjects; s++) {
        if (w->times->base_of[s] == base && s != base && has_moves(w->fit, s)) {
            w->members[count++] = s;
        }
    }
    return count;
}

// Divides the variance between units into two parts. The part of the base moves all its subjects by
// the same amount; the part of a subject moves that subject only.
static void divide_variance(DipTimesFit *fit, DipTimesBase *base, const int *members, int count,
                            int v) {
    const int units = fit->units;
    double shared_squares = 0.0;
    for (int unit = 0; unit < units; unit++) {
        double shared = 0.0;
        for (int i = 0; count > 1 && i < count; i++) {
            shared += dip_times_moves(fit, members[i], unit)[v] / count;
        }
        shared_squares += shared * shared / (units - 1);
        for (int i = 0; i < count; i++) {
            const double own = dip_times_moves(fit, members[i], unit)[v] - shared;
            const double share = count > 1 ? (count - 1.0) / count : 1.0;
            fit->subjects[members[i]].variance[v] += own * own / share / (units - 1);
        }
    }
    for (int i = 0; i < count; i++) {
        base->pooled[v] += fit->subjects[members[i]].variance[v] / count;
    }
    if (count > 1) {
        const double seen = fmax(shared_squares - base->pooled[v] / count, 0.0);
        base->variance[v] = ((units - 1) * seen + DIP_TIMES_BASE_DEGREES * base->pooled[v]) /
                            (units - 1 + DIP_TIMES_BASE_DEGREES);
        base->pooled_degrees = fmin(most_pooled_degrees, (count - 1.0) * (units - 1));
    }
}

static void fit_base(DipTimesWork *w, int b) {
    DipTimesFit *fit = w->fit;
    dip_times_fit_levels(w, b);
    for (int s = 0; s < w->times->subjects; s++) {
        if (w->times->base_of[s] == b) {
            fit->subjects[s].base = b;
            fit_subject(w, s);
        }
    }
    const int count = list_members(w, b);
    for (int v = 0; fit->units > 1 && v < DIP_TIMES_VALUE_COUNT; v++) {
        for (int s = 0; s < w->times->subjects; s++) {
            if (w->times->base_of[s] == b && !has_moves(fit, s)) {
                fit->subjects[s].variance[v] = NAN;
            }
        }
        divide_variance(fit, &fit->bases[b], w->members, count, v);
        for (int unit = 0; unit < fit->units; unit++) {
            const double move = dip_times_moves(fit, b, unit)[v];
            fit->subjects[b].variance[v] += move * move / (fit->units - 1);
        }
    }
}

// --- memory --------------------------------------------------------------------------------------

static void close_work(DipTimesWork *w) {
    free(w->sorted);
    free(w->first_of);
    free(w->cells);
    free(w->pairs);
    free(w->visits);
    free(w->level);
    free(w->logs);
    free(w->means);
}

static bool open_work(DipTimesWork *w, const DipTimes *times, int part, DipTimesFit *fit) {
    const size_t count = (size_t)times->count + 1, frames = (size_t)times->frames;
    const size_t all = count > frames ? count : frames;
    const size_t sets = 1 + (size_t)fit->units;
    *w = (DipTimesWork){
        .times = times,
        .fit = fit,
        .part = part,
        .is_alone = times->complete && times->starts > 1,
        .sorted = malloc(count * sizeof(DipTimed *)),
        .first_of = malloc((2 * (size_t)times->subjects + 1) * sizeof(int)),
        .cells = malloc(count * sizeof(DipTimesCell)),
        .pairs = malloc(count * sizeof(DipTimesPair)),
        .visits = malloc(2 * count * sizeof(int)),
        .level = malloc((sets * (frames + 1) + count + all + 2 * frames) * sizeof(double)),
        .logs = malloc(4 * all * sizeof(double)),
        .means = malloc(MOST_VISITS * (MOST_VISITS + 1) / 2 * sizeof(double)),
    };
    if (!w->sorted || !w->first_of || !w->cells || !w->pairs || !w->visits || !w->level ||
        !w->logs || !w->means) {
        return false;
    }
    w->members = w->first_of + times->subjects + 1;
    sort_times(w);
    w->missing = w->level + sets * frames;
    w->speed = w->missing + sets;
    w->weights = w->speed + count;
    w->ratio = w->weights + all;
    w->time = w->ratio + frames;
    w->pair_frames = w->visits + count;
    w->smooth = w->logs + all;
    w->rest = w->smooth + all;
    w->of_visit = w->rest + all;
    return true;
}

DipTimesFit *dip_times_fit(const DipTimes *times, DipError *err) {
    return dip_times_fit_part(times, -1, err);
}

DipTimesFit *dip_times_fit_part(const DipTimes *times, int part, DipError *err) {
    DIP_FP_MODE_SCOPE();
    DIP_ASSERT(times->subjects > 0 && times->frames > 0 && times->starts > 0 && times->rounds > 0);
    const size_t subjects = (size_t)times->subjects, frames = (size_t)times->frames;
    DipTimesFit *fit = calloc(1, sizeof *fit);
    DipTimesWork w = {0};
    bool made = fit;
    if (made) {
        fit->frames = times->frames;
        fit->units = times->starts > 1 ? times->starts : times->rounds;
        fit->excess = times->complete ? 1.0 : excess_of_dealt_frames;
        fit->subjects = calloc(subjects, sizeof *fit->subjects);
        fit->bases = calloc(subjects, sizeof *fit->bases);
        fit->frame_ms = malloc(subjects * frames * sizeof *fit->frame_ms);
        fit->moves =
            calloc(subjects * (size_t)fit->units * DIP_TIMES_VALUE_COUNT, sizeof *fit->moves);
        made = fit->subjects && fit->bases && fit->frame_ms && fit->moves &&
               open_work(&w, times, part, fit);
    }
    for (int s = 0; made && s < times->subjects; s++) {
        if (times->base_of[s] == s) {
            fit_base(&w, s);
        }
    }
    close_work(&w);
    if (!made) {
        dip_times_fit_free(&fit);
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "timing", "out of memory");
    }
    return fit;
}

void dip_times_fit_free(DipTimesFit **fit_pointer) {
    DipTimesFit *fit = *fit_pointer;
    if (fit) {
        free(fit->subjects);
        free(fit->bases);
        free(fit->frame_ms);
        free(fit->moves);
        free(fit);
        *fit_pointer = NULL;
    }
}
