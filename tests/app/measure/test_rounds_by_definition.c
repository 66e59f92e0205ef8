// Compares fits of whole logs with the same values computed from their definitions: medians by
// sorting, windows by collecting their values, and variances from sums of squares. The bases have
// exact times, so that only the subjects' ratios have noise.
#include "app/measure/stats/rounds.h"
#include "tests/app/measure/noise.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SUBJECTS = 4, BLOCKS = 2, MOST_FRAMES = 64, MOST_ROUNDS = 16, MOST_PAIRS = 256, VALUES = 3 };
enum { RATIO, P95, WORST };

static const int base_of[SUBJECTS] = {0};

// --- logs ----------------------------------------------------------------------------------------

typedef struct Pair {
    int frame, round, block; // `round` counts the rounds of all starts.
    double log_ratio;
} Pair;

typedef struct Log {
    int starts, rounds, frames;
    bool complete;
    double level[MOST_FRAMES];        // Logarithm of the base's time.
    double speed[MOST_ROUNDS];        // Logarithm of how much slower the machine is in a round.
    Pair pairs[SUBJECTS][MOST_PAIRS]; // In path order; those of one frame in the order of rounds.
    int count[SUBJECTS];
} Log;

static double share_of_part(int frame) {
    return 0.2 + 0.01 * frame;
}

static DipTimed timed(const Log *made, int subject, const Pair *pair) {
    const double ms = exp(made->level[pair->frame] + made->speed[pair->round] + pair->log_ratio);
    return (DipTimed){.subject = subject,
                      .start = pair->round / made->rounds,
                      .round = pair->round % made->rounds,
                      .block = pair->block,
                      .frame = pair->frame,
                      .ms = ms,
                      .parts_ms = {ms * share_of_part(pair->frame)}};
}

// The base draws all frames in every block.
static DipTimesFit *fit_log(const Log *made) {
    static DipTimed list[MOST_ROUNDS * BLOCKS * MOST_FRAMES + SUBJECTS * MOST_PAIRS];
    int count = 0;
    for (int i = 0; i < made->starts * made->rounds * BLOCKS * made->frames; i++) {
        const Pair pair = {i % made->frames, i / made->frames / BLOCKS, i / made->frames % BLOCKS,
                           0.0};
        list[count++] = timed(made, 0, &pair);
    }
    for (int s = 1; s < SUBJECTS; s++) {
        for (int i = 0; i < made->count[s]; i++) {
            list[count++] = timed(made, s, &made->pairs[s][i]);
        }
    }
    const DipTimes times = {list,         count,        SUBJECTS, made->starts,
                            made->rounds, made->frames, base_of,  made->complete};
    DipTimesFit *fit = dip_times_fit(&times, NULL);
    assert_non_null(fit);
    return fit;
}

static void begin_log(Log *made, int starts, int rounds, int frames, NoiseRandom *random) {
    memset(made, 0, sizeof *made);
    made->starts = starts;
    made->rounds = rounds;
    made->frames = frames;
    for (int f = 0; f < frames; f++) {
        made->level[f] = 1.0 + 0.3 * sin(0.2 * f) + 0.1 * noise_normal(random);
    }
    for (int r = 0; r < starts * rounds; r++) {
        made->speed[r] = 0.05 * noise_normal(random);
    }
}

// Each round draws a few frames. The ratios follow a wave of this height and length, and the second
// subject never draws the first, the last and some other frames.
static void make_dealt(Log *made, int starts, int rounds, double height, double length,
                       double noise, NoiseRandom *random) {
    begin_log(made, starts, rounds, 60, random);
    for (int s = 1; s < SUBJECTS; s++) {
        for (int f = 0; f < made->frames; f++) {
            if (s == 2 && (f == 0 || f % 9 == 4 || f % 9 == 5 || f == made->frames - 1)) {
                continue;
            }
            const int round = f * 7 % (starts * rounds);
            const double moved = 0.02 * noise_normal(random) * (f % 3 == 0);
            made->pairs[s][made->count[s]++] =
                (Pair){f, round, f / (starts * rounds) % BLOCKS,
                       0.3 * s + height * sin(6.28 * f / length + s) + moved +
                           noise * noise_normal(random) + 0.01 * s * (round % 3)};
        }
    }
}

// Every round draws all frames, in the first block.
static void make_complete(Log *made, int starts, int rounds, int frames, NoiseRandom *random) {
    begin_log(made, starts, rounds, frames, random);
    made->complete = true;
    for (int s = 1; s < SUBJECTS; s++) {
        double luck[MOST_ROUNDS];
        for (int i = 0; i < starts * rounds; i++) {
            luck[i] = 0.03 * noise_normal(random);
        }
        for (int i = 0; i < frames * starts * rounds; i++) {
            const int f = i / (starts * rounds), round = i % (starts * rounds);
            made->pairs[s][made->count[s]++] =
                (Pair){f, round, 0,
                       0.1 * s + 0.2 * cos(f * s) + luck[starts > 1 ? round / rounds : round] +
                           0.02 * noise_normal(random)};
        }
    }
}

// --- definitions ---------------------------------------------------------------------------------

static int compare(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double percentile_of(const double *values, int count, double share) {
    static double sorted[MOST_PAIRS * MOST_PAIRS];
    memcpy(sorted, values, (size_t)count * sizeof *values);
    qsort(sorted, (size_t)count, sizeof *sorted, compare);
    const double place = share * (count - 1);
    const int below = (int)floor(place), above = (int)ceil(place);
    return sorted[below] + (place - below) * (sorted[above] - sorted[below]);
}

static double median_of(const double *values, int count) {
    return percentile_of(values, count, 0.5);
}

// Median of the values of up to window / 2 neighbours on either side, and of the value itself
// unless it is left out.
static double median_around(const double *values, int count, int at, int window, bool without) {
    double inside[MOST_PAIRS];
    int found = 0;
    for (int i = 0; i < count; i++) {
        if (abs(i - at) <= window / 2 && !(without && i == at)) {
            inside[found++] = values[i];
        }
    }
    return median_of(inside, found);
}

// The pairs of some units, and what the fit of all units chose.
typedef struct Set {
    double logs[MOST_PAIRS], rest[MOST_PAIRS];
    int frame[MOST_PAIRS], visit[MOST_PAIRS];
    int count, window;
    bool repeats;
} Set;

static int unit_of(const Log *made, const Pair *pair) {
    return made->starts > 1 ? pair->round / made->rounds : pair->round;
}

static bool is_alone(const Log *made) {
    return made->complete && made->starts > 1;
}

static void collect(const Log *made, int subject, int unit, Set *set) {
    set->count = 0;
    for (int i = 0; i < made->count[subject]; i++) {
        const Pair *pair = &made->pairs[subject][i];
        if (unit < 0 || (unit_of(made, pair) == unit) == is_alone(made)) {
            set->logs[set->count] = pair->log_ratio;
            set->frame[set->count] = pair->frame;
            set->visit[set->count++] = pair->round * BLOCKS + pair->block;
        }
    }
}

// The window whose predictions from neighbours miss least, if no error counts for more than three
// times the median error. A shorter window must be better by 3 %.
static int best_window(const Set *set) {
    const int windows[] = {2 * set->count + 1, 31, 15, 7};
    double least = INFINITY;
    int best = 0;
    for (int k = 0; k < 4; k++) {
        double missed[MOST_PAIRS], sum = 0.0;
        for (int i = 0; i < set->count; i++) {
            missed[i] =
                fabs(set->logs[i] - median_around(set->logs, set->count, i, windows[k], true));
        }
        const double most = 3.0 * median_of(missed, set->count);
        for (int i = 0; i < set->count; i++) {
            sum += missed[i] < most ? missed[i] : most;
        }
        if (sum < 0.97 * least) {
            least = sum;
            best = windows[k];
        }
    }
    return best;
}

static double smoothed(const Set *set, int at) {
    if (!set->repeats) {
        return median_around(set->logs, set->count, at, set->window, false);
    }
    double same[MOST_PAIRS];
    int found = 0;
    for (int i = 0; i < set->count; i++) {
        if (set->frame[i] == set->frame[at]) {
            same[found++] = set->logs[i];
        }
    }
    return median_of(same, found);
}

// Hodges and Lehmann's estimate from the medians of the visits, and how far these lie apart.
static double common_rest(const Set *set, double *spread) {
    static double means[MOST_PAIRS * MOST_PAIRS];
    double medians[MOST_ROUNDS * BLOCKS], away[MOST_ROUNDS * BLOCKS];
    int found = 0, count = 0;
    for (int visit = 0; visit < MOST_ROUNDS * BLOCKS; visit++) {
        double inside[MOST_PAIRS];
        int in_visit = 0;
        for (int i = 0; i < set->count; i++) {
            if (set->visit[i] == visit) {
                inside[in_visit++] = set->rest[i];
            }
        }
        if (in_visit > 0) {
            medians[found++] = median_of(inside, in_visit);
        }
    }
    for (int i = 0; i < found; i++) {
        away[i] = fabs(medians[i] - median_of(medians, found));
        for (int j = 0; j <= i; j++) {
            means[count++] = (medians[i] + medians[j]) / 2.0;
        }
    }
    *spread = 1.4826 * median_of(away, found);
    return median_of(means, count);
}

// Log ratio of a frame on the straight line between the nearest frames that have one.
static double ratio_at(const Set *set, const double *ratio, int frame) {
    int before = -1, after = -1;
    for (int i = 0; i < set->count; i++) {
        if (set->frame[i] <= frame) {
            before = i;
        }
        if (after < 0 && set->frame[i] >= frame) {
            after = i;
        }
    }
    if (before < 0 || after < 0 || set->frame[before] == set->frame[after]) {
        return ratio[before < 0 ? after : before];
    }
    const double share =
        (double)(frame - set->frame[before]) / (set->frame[after] - set->frame[before]);
    return ratio[before] + share * (ratio[after] - ratio[before]);
}

// What a fit finds for a subject from one set of pairs. `ms` is for a machine whose speed is 0.
typedef struct Found {
    double values[VALUES], ms[MOST_FRAMES], spread, doubt;
} Found;

static void find(const Log *made, Set *set, Found *found) {
    const int frames = made->frames;
    double ratio[MOST_PAIRS], away[MOST_PAIRS], mean = 0.0, squares = 0.0;
    for (int i = 0; i < set->count; i++) {
        ratio[i] = smoothed(set, i);
        set->rest[i] = set->logs[i] - ratio[i];
        away[i] = fabs(set->rest[i]);
    }
    const double common = common_rest(set, &found->spread);
    const double noise = 1.4826 * median_of(away, set->count);
    const double whole = set->window < set->count ? set->window : set->count;
    const double joined = set->repeats ? (double)set->count / frames : whole;
    found->doubt = 3.0 * noise * noise / (2.0 * joined + 1.0);
    double total = 0.0, base_total = 0.0, after = 0.0, worst = 0.0;
    for (int f = 0; f < frames; f++) {
        found->ms[f] = exp(made->level[f] + ratio_at(set, ratio, f) + common);
        total += found->ms[f];
        base_total += exp(made->level[f]);
        mean += (made->level[f] + ratio_at(set, ratio, f) + common) / frames;
    }
    // The noise makes the times differ more. Their distances shrink until it is taken off, but not
    // below 0, and the mean time stays.
    for (int f = 0; f < frames; f++) {
        squares += pow(log(found->ms[f]) - mean, 2.0) / frames;
    }
    const double left = squares > found->doubt ? squares - found->doubt : 0.0;
    for (int f = 0; f < frames; f++) {
        found->ms[f] = exp(mean + sqrt(left / squares) * (log(found->ms[f]) - mean));
        after += found->ms[f];
    }
    for (int f = 0; f < frames; f++) {
        found->ms[f] *= total / after;
        worst = found->ms[f] > worst ? found->ms[f] : worst;
    }
    found->values[RATIO] = log(total / base_total);
    found->values[P95] = log(percentile_of(found->ms, frames, 0.95) * frames / base_total);
    found->values[WORST] = log(worst * frames / base_total);
}

typedef struct Truth {
    int units;
    Found found[SUBJECTS];
    double moves[SUBJECTS][MOST_ROUNDS][VALUES];
    double own[SUBJECTS][VALUES], pooled[VALUES], shared[VALUES]; // Variances between units.
    double level_ms, level_error;
    int windows[SUBJECTS];
} Truth;

static void find_moves(const Log *made, int subject, Set *set, Truth *truth) {
    const int units = truth->units;
    double mean[VALUES] = {0.0};
    for (int unit = 0; unit < units; unit++) {
        Found without;
        collect(made, subject, unit, set);
        find(made, set, &without);
        for (int v = 0; v < VALUES; v++) {
            truth->moves[subject][unit][v] = without.values[v];
            mean[v] += without.values[v] / units;
        }
    }
    for (int unit = 0; unit < units; unit++) {
        for (int v = 0; v < VALUES; v++) {
            double *move = &truth->moves[subject][unit][v];
            *move = is_alone(made) ? *move - mean[v] : (units - 1) * (mean[v] - *move);
        }
    }
}

// Divides the variance of the moves: `shared` is that of the mean move of all subjects, less what
// the subjects' own moves add to it; it counts for units - 1 degrees of freedom, beside one of the
// subjects' own variance.
static void divide_variance(Truth *truth) {
    const int units = truth->units, members = SUBJECTS - 1;
    for (int v = 0; v < VALUES; v++) {
        double together = 0.0;
        for (int unit = 0; unit < units; unit++) {
            double mean = 0.0;
            for (int s = 1; s < SUBJECTS; s++) {
                mean += truth->moves[s][unit][v] / members;
            }
            together += mean * mean / (units - 1);
            for (int s = 1; s < SUBJECTS; s++) {
                truth->own[s][v] += pow(truth->moves[s][unit][v] - mean, 2.0) / (units - 1) *
                                    members / (members - 1);
            }
        }
        for (int s = 1; s < SUBJECTS; s++) {
            truth->pooled[v] += truth->own[s][v] / members;
        }
        const double seen = fmax(together - truth->pooled[v] / members, 0.0);
        truth->shared[v] = ((units - 1) * seen + truth->pooled[v]) / units;
    }
}

// The level's error is that of the mean of the starts' speeds, or of four groups of rounds.
static void find_level(const Log *made, Truth *truth) {
    const int rounds = made->starts * made->rounds;
    const int groups = made->starts > 1 ? made->starts : 4;
    double mean = 0.0, squares = 0.0, of_group[MOST_ROUNDS] = {0.0};
    for (int g = 0; g < groups; g++) {
        const int first = g * rounds / groups, end = (g + 1) * rounds / groups;
        for (int r = first; r < end; r++) {
            of_group[g] += made->speed[r] / (end - first);
        }
        mean += of_group[g] / groups;
    }
    for (int g = 0; g < groups; g++) {
        squares += pow(of_group[g] - mean, 2.0) / (groups - 1) / groups;
    }
    for (int f = 0; f < made->frames; f++) {
        truth->level_ms += exp(made->level[f] + median_of(made->speed, rounds)) / made->frames;
    }
    truth->level_error = fmax(sqrt(squares), 0.001);
}

static void find_truth(const Log *made, Truth *truth) {
    static Set set;
    memset(truth, 0, sizeof *truth);
    truth->units = made->starts > 1 ? made->starts : made->rounds;
    for (int s = 1; s < SUBJECTS; s++) {
        collect(made, s, -1, &set);
        set.repeats = made->complete || set.count >= 3 * made->frames;
        truth->windows[s] = set.window = set.repeats ? 0 : best_window(&set);
        find(made, &set, &truth->found[s]);
        find_moves(made, s, &set, truth);
    }
    divide_variance(truth);
    find_level(made, truth);
}

// --- comparison ----------------------------------------------------------------------------------

static bool near(double a, double b) {
    return fabs(a - b) <= 1e-7 * fabs(b);
}

// A sum of independent variances, and the degrees of freedom that Satterthwaite gives it.
typedef struct Sum {
    double value, parts;
} Sum;

static void add(Sum *sum, double value, double degrees) {
    sum->value += value;
    sum->parts += value * value / degrees;
}

static void check_estimate(DipEstimate got, double value, Sum sum) {
    assert_true(near(got.value, value));
    assert_true(near(got.log_error, sqrt(sum.value)));
    assert_true(near(got.degrees, sum.value * sum.value / sum.parts));
}

// The variance of a mean of the units: the subject's own variance averaged with that of all
// subjects, whose degrees of freedom count for at most 12.
static void add_own(const Log *made, const Truth *truth, double own, double pooled, Sum *sum) {
    const double degrees = truth->units - 1;
    const double more = fmin((SUBJECTS - 2) * degrees, 12.0);
    const double divisor = truth->units * (made->complete ? 1.0 : 1.25);
    add(sum, (degrees * own + more * pooled) / (degrees + more) / divisor, degrees + more);
}

static void add_value(const Log *made, const Truth *truth, int subject, int v, Sum *sum) {
    const double divisor = truth->units * (made->complete ? 1.0 : 1.25);
    add_own(made, truth, truth->own[subject][v], truth->pooled[v], sum);
    add(sum, truth->shared[v] / divisor, truth->units);
    add(sum, 1e-6, INFINITY);
}

static void check_ratios(const Log *made, const Truth *truth, const DipTimesFit *fit) {
    for (int s = 1; s < SUBJECTS; s++) {
        const double value = truth->found[s].values[RATIO];
        Sum sum = {0.0, 0.0};
        add_value(made, truth, s, RATIO, &sum);
        check_estimate(dip_times_ratio(fit, s), exp(value), sum);
        check_estimate(dip_times_ratio_of(fit, 0, s), exp(-value), sum);
        assert_true(near(dip_times_spread(fit, s), truth->found[s].spread));
        const int other = s % (SUBJECTS - 1) + 1;
        double squares = 0.0;
        for (int unit = 0; unit < truth->units; unit++) {
            squares += pow(truth->moves[s][unit][RATIO] - truth->moves[other][unit][RATIO], 2.0);
        }
        sum = (Sum){0.0, 0.0};
        add_own(made, truth, squares / (truth->units - 1), 2.0 * truth->pooled[RATIO], &sum);
        add(&sum, 1e-6, INFINITY);
        check_estimate(dip_times_ratio_of(fit, s, other),
                       exp(value - truth->found[other].values[RATIO]), sum);
    }
}

static void check_times(const Log *made, const Truth *truth, const DipTimesFit *fit) {
    const int groups = made->starts > 1 ? made->starts : 4;
    const double usual = median_of(made->speed, made->starts * made->rounds);
    for (int s = 1; s < SUBJECTS; s++) {
        const DipAlong along = dip_times_along(fit, s);
        const DipEstimate *const got[VALUES] = {&along.mean_ms, &along.p95_ms, &along.worst_ms};
        assert_int_equal(along.timed, made->count[s]);
        assert_int_equal(along.kept, made->count[s]);
        assert_true(near(along.level_error, truth->level_error));
        for (int v = 0; v < VALUES; v++) {
            Sum sum = {0.0, 0.0};
            add_value(made, truth, s, v, &sum);
            add(&sum, pow(truth->level_error, 2.0), groups - 1);
            add(&sum, v == RATIO ? 0.0 : truth->found[s].doubt, INFINITY);
            check_estimate(*got[v], truth->level_ms * exp(truth->found[s].values[v]), sum);
        }
        double part = 0.0, whole = 0.0;
        for (int i = 0; i < made->count[s]; i++) {
            const double weight = exp(made->level[made->pairs[s][i].frame]);
            part += weight * share_of_part(made->pairs[s][i].frame);
            whole += weight;
        }
        assert_true(near(dip_times_shares(fit, s)[0], part / whole));
        for (int f = 0; f < made->frames; f++) {
            assert_true(near(dip_times_frames(fit, s)[f], truth->found[s].ms[f] * exp(usual)));
        }
    }
}

static void check(const Log *made, Truth *truth) {
    DipTimesFit *fit = fit_log(made);
    find_truth(made, truth);
    check_ratios(made, truth, fit);
    check_times(made, truth, fit);
    dip_times_fit_free(&fit);
}

// The waves make each of the windows the best one for some subject.
static void dealt_frames_have_the_defined_ratios_and_times(void **state) {
    (void)state;
    static const double lengths[] = {1e9, 50.0, 30.0, 18.0, 12.0};
    static Log made;
    static Truth truth;
    NoiseRandom random = {11};
    int all = 0, of_window[32] = {0};
    for (int i = 0; i < 20; i++) {
        make_dealt(&made, i % 2 ? 5 : 1, i % 2 ? 3 : 12, 0.2, lengths[i / 2 % 5],
                   0.02 + 0.01 * (i % 3), &random);
        check(&made, &truth);
        for (int s = 1; s < SUBJECTS; s++) {
            all += truth.windows[s] > 31;
            of_window[truth.windows[s] > 31 ? 0 : truth.windows[s]]++;
        }
    }
    assert_true(all > 0 && of_window[31] > 0 && of_window[15] > 0 && of_window[7] > 0);
}

static void complete_rounds_have_the_defined_ratios_and_times(void **state) {
    (void)state;
    static Log made;
    static Truth truth;
    NoiseRandom random = {12};
    for (int i = 0; i < 4; i++) {
        make_complete(&made, 3 + i, 2, 6, &random);
        check(&made, &truth);
        make_complete(&made, 1, 9 + i, 7, &random);
        check(&made, &truth);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(dealt_frames_have_the_defined_ratios_and_times),
        cmocka_unit_test(complete_rounds_have_the_defined_ratios_and_times),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
