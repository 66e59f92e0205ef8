// Compares the times of a base whose frames are noisy with the same times computed from their
// definitions on a full table: every visit draws every frame, so a row of the table is a visit.
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

enum { MOST_FRAMES = 48, MOST_VISITS = 8 };

typedef struct Table {
    int frames, visits;
    double log_ms[MOST_VISITS][MOST_FRAMES];
} Table;

static int compare(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double percentile_of(const double *values, int count, double share) {
    double sorted[MOST_VISITS * MOST_FRAMES];
    memcpy(sorted, values, (size_t)count * sizeof *values);
    qsort(sorted, (size_t)count, sizeof *sorted, compare);
    const double place = share * (count - 1);
    const int below = (int)floor(place), above = (int)ceil(place);
    return sorted[below] + (place - below) * (sorted[above] - sorted[below]);
}

// Fits levels of frames and speeds of visits in turn, as weighted means. The weights are Tukey's
// biweight at six times the median distance, and begin as 1.
static void fit_levels(const Table *table, int left_out, double level[MOST_FRAMES]) {
    double weight[MOST_VISITS][MOST_FRAMES], speed[MOST_VISITS] = {0.0};
    for (int sweep = 0; sweep < 40; sweep++) {
        double away[MOST_VISITS * MOST_FRAMES];
        int count = 0;
        for (int f = 0; f < table->frames; f++) {
            double sum = 0.0, whole = 0.0;
            for (int v = 0; v < table->visits; v++) {
                const double w = v == left_out ? 0.0 : sweep < 10 ? 1.001 : weight[v][f];
                sum += w * (table->log_ms[v][f] - speed[v]);
                whole += w;
            }
            level[f] = sum / whole;
        }
        for (int v = 0; v < table->visits; v++) {
            double sum = 0.0, whole = 0.0;
            for (int f = 0; f < table->frames; f++) {
                const double w = sweep < 10 ? 1.001 : weight[v][f];
                sum += w * (table->log_ms[v][f] - level[f]);
                whole += w;
            }
            speed[v] = v == left_out ? 0.0 : sum / whole;
        }
        for (int i = 0; i < table->visits * table->frames; i++) {
            const int v = i / table->frames, f = i % table->frames;
            if (v != left_out) {
                away[count++] = fabs(table->log_ms[v][f] - level[f] - speed[v]);
            }
        }
        const double far = 6.0 * percentile_of(away, count, 0.5) + 1e-9;
        for (int i = 0; sweep % 10 == 9 && i < table->visits * table->frames; i++) {
            const int v = i / table->frames, f = i % table->frames;
            const double share = (table->log_ms[v][f] - level[f] - speed[v]) / far;
            weight[v][f] = 1e-3 + (fabs(share) < 1.0 ? pow(1.0 - share * share, 2.0) : 0.0);
        }
    }
}

// The mean of up to `reach` neighbours on each side of a frame. The first and last frame have one.
static double predicted(const double *level, int frames, int frame, int reach) {
    double sum = 0.0;
    int side = reach;
    side = frame < side ? frame : side;
    side = frames - 1 - frame < side ? frames - 1 - frame : side;
    if (side == 0) {
        return level[frame == 0 ? 1 : frames - 2];
    }
    for (int i = frame - side; i <= frame + side; i++) {
        sum += i == frame ? 0.0 : level[i];
    }
    return sum / (2 * side);
}

static double mean_square_missed(const double *level, int frames, int reach) {
    double sum = 0.0;
    for (int f = 0; f < frames; f++) {
        sum += pow(level[f] - predicted(level, frames, f, reach), 2.0);
    }
    return sum / frames;
}

// Joins each level with the prediction from its neighbours, by the variances of the two. Returns
// the variance that the true levels have beyond the new ones.
static double join(double *level, int frames, int reach, double noise) {
    double joined[MOST_FRAMES];
    const double of_neighbours =
        fmax(mean_square_missed(level, frames, reach) - noise, noise / (2.0 * reach));
    const double own = of_neighbours / (of_neighbours + noise);
    for (int f = 0; f < frames; f++) {
        joined[f] = own * level[f] + (1.0 - own) * predicted(level, frames, f, reach);
    }
    memcpy(level, joined, (size_t)frames * sizeof *joined);
    return own * noise;
}

// The times of levels whose variance grows by `missing`, with an unchanged sum.
static void spread_times(const double *level, int frames, double missing, double *ms) {
    double mean = 0.0, squares = 0.0, before = 0.0, after = 0.0;
    for (int f = 0; f < frames; f++) {
        mean += level[f] / frames;
        before += exp(level[f]);
    }
    for (int f = 0; f < frames; f++) {
        squares += pow(level[f] - mean, 2.0) / frames;
    }
    for (int f = 0; f < frames; f++) {
        ms[f] = exp(mean + sqrt((squares + missing) / squares) * (level[f] - mean));
        after += ms[f];
    }
    for (int f = 0; f < frames; f++) {
        ms[f] *= before / after;
    }
}

typedef struct Truth {
    double level_error, level_ms, ms[MOST_FRAMES], missing;
    double variance[2]; // Variance between visits of the 95th percentile and of the greatest time.
    int reach;
} Truth;

// The logarithms of the 95th percentile and of the greatest time, divided by the mean time.
static void log_values(const double *level, const double *ms, int frames, double values[2]) {
    double total = 0.0;
    for (int f = 0; f < frames; f++) {
        total += exp(level[f]);
    }
    values[0] = log(percentile_of(ms, frames, 0.95) * frames / total);
    values[1] = log(percentile_of(ms, frames, 1.0) * frames / total);
}

static void judge_speeds(const Table *table, double *level, Truth *truth) {
    double speeds[MOST_VISITS], mean = 0.0, squares = 0.0;
    for (int v = 0; v < table->visits; v++) {
        double rest[MOST_FRAMES];
        for (int f = 0; f < table->frames; f++) {
            rest[f] = table->log_ms[v][f] - level[f];
        }
        speeds[v] = percentile_of(rest, table->frames, 0.5);
        mean += speeds[v] / table->visits;
    }
    for (int v = 0; v < table->visits; v++) {
        squares += pow(speeds[v] - mean, 2.0) / (table->visits - 1);
    }
    truth->level_error = fmax(sqrt(squares / table->visits), 0.001);
    const double usual = percentile_of(speeds, table->visits, 0.5);
    for (int f = 0; f < table->frames; f++) {
        level[f] += usual;
        truth->level_ms += exp(level[f]) / table->frames;
    }
}

static void find_truth(const Table *table, Truth *truth) {
    const int frames = table->frames, units = table->visits;
    double level[MOST_FRAMES], without[MOST_VISITS][MOST_FRAMES], values[MOST_VISITS][2];
    double noise = 0.0, least = INFINITY, mean[2] = {0.0};
    memset(truth, 0, sizeof *truth);
    fit_levels(table, -1, level);
    for (int u = 0; u < units; u++) {
        double sum = 0.0, squares = 0.0;
        fit_levels(table, u, without[u]);
        for (int f = 0; f < frames; f++) {
            sum += (without[u][f] - level[f]) / frames;
            squares += pow(without[u][f] - level[f], 2.0) / frames;
        }
        noise += 0.5 * (squares - sum * sum) * (units - 1) / units;
    }
    for (int reach = 1; reach <= 16; reach *= 2) {
        const double missed = mean_square_missed(level, frames, reach);
        truth->reach = missed < least ? reach : truth->reach;
        least = fmin(least, missed);
    }
    truth->missing = join(level, frames, truth->reach, noise);
    judge_speeds(table, level, truth);
    spread_times(level, frames, truth->missing, truth->ms);
    for (int u = 0; u < units; u++) {
        double ms[MOST_FRAMES];
        const double more = join(without[u], frames, truth->reach, noise * units / (units - 1));
        spread_times(without[u], frames, more, ms);
        log_values(without[u], ms, frames, values[u]);
        mean[0] += values[u][0] / units;
        mean[1] += values[u][1] / units;
    }
    for (int i = 0; i < 2 * units; i++) {
        truth->variance[i % 2] += pow(values[i / 2][i % 2] - mean[i % 2], 2.0) * (units - 1);
    }
}

static bool near(double a, double b) {
    return fabs(a - b) <= 1e-6 * fabs(b);
}

static void check(const Table *table, const Truth *truth) {
    static const int base_of[1] = {0};
    static DipTimed list[MOST_VISITS * MOST_FRAMES];
    const int count = table->visits * table->frames, units = table->visits;
    for (int i = 0; i < count; i++) {
        const int v = i / table->frames, f = i % table->frames;
        list[i] = (DipTimed){.start = v, .frame = f, .ms = exp(table->log_ms[v][f])};
    }
    const DipTimes times = {list, count, 1, units, 1, table->frames, base_of, true};
    DipTimesFit *fit = dip_times_fit(&times, NULL);
    assert_non_null(fit);
    for (int f = 0; f < table->frames; f++) {
        assert_true(near(dip_times_frames(fit, 0)[f], truth->ms[f]));
    }
    const DipAlong along = dip_times_along(fit, 0);
    const DipEstimate *const got[2] = {&along.p95_ms, &along.worst_ms};
    assert_true(near(along.level_error, truth->level_error));
    assert_true(near(along.mean_ms.value, truth->level_ms));
    for (int i = 0; i < 2; i++) {
        // Satterthwaite's degrees of freedom: the variance of the mean and that of the level have
        // units - 1 each, and the others have infinitely many.
        const double own = truth->variance[i] / units, shared = pow(truth->level_error, 2.0);
        const double all = own + shared + truth->missing + 1e-6;
        assert_true(
            near(got[i]->value, percentile_of(truth->ms, table->frames, i == 0 ? 0.95 : 1.0)));
        assert_true(near(got[i]->log_error, sqrt(all)));
        assert_true(near(got[i]->degrees, all * all * (units - 1) / (own * own + shared * shared)));
    }
    dip_times_fit_free(&fit);
}

// Frames whose levels change slowly are predicted best by few or by many neighbours, depending on
// the noise; on a flat path, the most neighbours are best. One time in forty is far too long.
static void noisy_bases_have_the_defined_times(void **state) {
    (void)state;
    static Table table;
    NoiseRandom random = {21};
    int of_reach[17] = {0};
    for (int i = 0; i < 24; i++) {
        const double noise = i % 3 == 0 ? 0.001 : i % 3 == 1 ? 0.03 : 0.1;
        const double height = i % 4 == 3 ? 0.0 : 0.2; // Some paths are flat.
        table = (Table){.frames = 20 + i, .visits = 3 + i % 5};
        for (int v = 0; v < table.visits; v++) {
            const double speed = 0.05 * noise_normal(&random);
            for (int f = 0; f < table.frames; f++) {
                const double late = noise_below(&random, 40) == 0 ? 1.0 : 0.0;
                table.log_ms[v][f] =
                    1.5 + height * sin(0.3 * f) + speed + late + noise * noise_normal(&random);
            }
        }
        Truth truth;
        find_truth(&table, &truth);
        check(&table, &truth);
        of_reach[truth.reach]++;
    }
    assert_true(of_reach[1] > 0 && of_reach[2] > 0 && of_reach[4] > 0 && of_reach[16] > 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(noisy_bases_have_the_defined_times),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
