// Estimates from paired times, on simulated noise whose truth is known: do intervals hold the truth
// as often as they say, and how wide are they?
#include "app/measure/stats/paired.h"
#include "renderer/base/assert.h"
#include "tests/app/measure/noise.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { RUNS = 400, ROUNDS = 14, FRAMES = 4, BLOCKS = 40, BLOCK_ROWS = 4, SLOTS = FRAMES + 1 };

// --- a simulated sweep ---------------------------------------------------------------------------

typedef enum Case { EVEN, CLUSTERS, CASE_COUNT } Case;
static const char *const case_names[CASE_COUNT] = {"even", "clusters"};
static const double base_frames[FRAMES] = {9.0, 6.5, 5.2, 7.0};
static const double ratios[CASE_COUNT][FRAMES] = {{1.50, 1.52, 1.48, 1.51}, {1.2, 1.25, 2.2, 2.3}};

typedef struct Run {
    double ms[ROUNDS * FRAMES];
    double base_ms[ROUNDS * FRAMES];
} Run;

static double truth_of(Case which) {
    double total = 0.0, base = 0.0;
    for (int f = 0; f < FRAMES; f++) {
        total += base_frames[f] * ratios[which][f];
        base += base_frames[f];
    }
    return total / base;
}

// Times of one visit: an untimed frame, then the timed ones. Neighbours in time share the noise but
// for .4 % of their own.
static void visit(const double *noise, NoiseRandom *random, const double *ratio, double *ms) {
    for (int f = 0; f < FRAMES; f++) {
        const double own = 0.004 * noise_normal(random);
        ms[f] = base_frames[f] * (ratio ? ratio[f] : 1.0) * exp(noise[1 + f] + own);
    }
}

// A round visits 160 rows in blocks of 4 rows and the base, in random order. One row and its base
// are kept.
static void simulate(Run *run, NoiseKind kind, Case which, NoiseRandom *random, double *noise) {
    const int block_slots = (BLOCK_ROWS + 1) * SLOTS;
    const int round_slots = BLOCKS * block_slots;
    noise_run(kind, random, noise, ROUNDS * round_slots);
    for (int r = 0; r < ROUNDS; r++) {
        const double *block = noise + r * round_slots + noise_below(random, BLOCKS) * block_slots;
        const int row = noise_below(random, BLOCK_ROWS + 1);
        const int other = noise_below(random, BLOCK_ROWS);
        const int base = other + (other >= row);
        visit(block + row * SLOTS, random, ratios[which], run->ms + r * FRAMES);
        visit(block + base * SLOTS, random, NULL, run->base_ms + r * FRAMES);
    }
}

static double *noise_room(void) {
    double *noise = malloc(ROUNDS * BLOCKS * (BLOCK_ROWS + 1) * SLOTS * sizeof *noise);
    assert_non_null(noise);
    return noise;
}

// --- the ratio -----------------------------------------------------------------------------------

// The estimate that Diptych used before: the median of all ratios, with percentiles of the
// bootstrap.
static DipStatsEstimate pooled_ratio(const Run *run) {
    enum { RESAMPLES = 300 };
    double all[ROUNDS * FRAMES], values[RESAMPLES], scratch[RESAMPLES];
    NoiseRandom random = {1};
    for (int i = 0; i < RESAMPLES; i++) {
        for (int r = 0; r < ROUNDS; r++) {
            const int from = noise_below(&random, ROUNDS);
            for (int f = 0; f < FRAMES; f++) {
                all[r * FRAMES + f] = run->ms[from * FRAMES + f] / run->base_ms[from * FRAMES + f];
            }
        }
        values[i] = dip_stats_median(all, ROUNDS * FRAMES);
    }
    return (DipStatsEstimate){dip_stats_quantile(values, RESAMPLES, 0.5, scratch),
                              dip_stats_quantile(values, RESAMPLES, 0.025, scratch),
                              dip_stats_quantile(values, RESAMPLES, 0.975, scratch)};
}

static DipStatsEstimate paired_ratio(const Run *run) {
    const DipPairedTimes times = {run->ms, run->base_ms, ROUNDS, FRAMES};
    DipStatsEstimate ratio;
    assert_true(dip_paired_ratio(&times, &ratio, NULL));
    return ratio;
}

typedef struct Score {
    double covered;    // Share of the intervals that hold the truth.
    double half_width; // Median half width of the intervals, as a logarithm.
    double bias;       // Median error, as a logarithm.
    double deviation;  // Standard deviation of the estimates' logarithm.
} Score;

static Score score(DipStatsEstimate (*estimator)(const Run *), NoiseKind kind, Case which) {
    static double halves[RUNS], errors[RUNS];
    NoiseRandom random = {20261122 + (uint64_t)(kind * CASE_COUNT + which)};
    double *noise = noise_room();
    const double truth = truth_of(which);
    Score result = {0};
    double squares = 0.0;
    for (int i = 0; i < RUNS; i++) {
        Run run;
        simulate(&run, kind, which, &random, noise);
        const DipStatsEstimate ratio = estimator(&run);
        result.covered += (ratio.low <= truth && truth <= ratio.high) / (double)RUNS;
        halves[i] = 0.5 * log(ratio.high / ratio.low);
        errors[i] = log(ratio.value / truth);
        squares += errors[i] * errors[i] / RUNS;
    }
    free(noise);
    result.half_width = dip_stats_median(halves, RUNS);
    result.bias = dip_stats_median(errors, RUNS);
    result.deviation = sqrt(squares);
    return result;
}

// The bounds of the half widths are 1.3 times those of a study with another implementation and
// other random numbers (the same estimator, in Python).
static void ratio_intervals_hold_the_truth(void **state) {
    (void)state;
    static const double study[CASE_COUNT][NOISE_KIND_COUNT] = {{0.024, 0.012, 0.012, 0.019, 0.024},
                                                               {0.024, 0.012, 0.012, 0.019, 0.024}};
    for (int c = 0; c < CASE_COUNT; c++) {
        for (int k = 0; k < NOISE_KIND_COUNT; k++) {
            const Score got = score(paired_ratio, (NoiseKind)k, (Case)c);
            print_message("%-8s %-6s covered %5.1f %%, half width %.2f %%, bias %+.2f %%\n",
                          case_names[c], noise_names[k], 100.0 * got.covered,
                          100.0 * got.half_width, 100.0 * got.bias);
            assert_true(got.covered >= 0.94);
            assert_true(got.half_width <= 1.3 * study[c][k]);
            assert_true(fabs(got.bias) < 0.5 * got.deviation);
        }
    }
}

// The same check refuses the estimate that Diptych used before.
static void pooled_medians_fall_between_clusters(void **state) {
    (void)state;
    for (int k = NOISE_DRIFT; k <= NOISE_BURSTS; k++) {
        const Score got = score(pooled_ratio, (NoiseKind)k, CLUSTERS);
        print_message("pooled median, clusters, %s: covered %.1f %%\n", noise_names[k],
                      100.0 * got.covered);
        assert_true(got.covered < 0.5);
    }
}

static void even_pairs_have_an_exact_ratio(void **state) {
    (void)state;
    double base[6] = {1.0, 10.0, 2.0, 20.0, 4.0, 40.0}, ms[6];
    for (int i = 0; i < 6; i++) {
        ms[i] = base[i] * (i % 2 ? 3.0 : 2.0);
    }
    const DipPairedTimes times = {ms, base, 3, 2};
    DipStatsEstimate ratio;
    assert_true(dip_paired_ratio(&times, &ratio, NULL));
    // Weights are the medians 2 and 20.
    assert_true(fabs(ratio.value - (2.0 * 2.0 + 20.0 * 3.0) / 22.0) < 1e-12);
    // The machine became slower from round to round, but that cancels. Only the weights vary, and
    // they keep their quotient.
    assert_true(ratio.high - ratio.low < 1e-9);
}

static void dropped_pairs_take_no_part(void **state) {
    (void)state;
    double base[8] = {1, 1, 1, 1, 1, 1, 1, 1};
    double ms[8] = {2, 4, NAN, 4, 2, NAN, 2, 4};
    const DipPairedTimes times = {ms, base, 4, 2};
    DipStatsEstimate ratio;
    assert_true(dip_paired_ratio(&times, &ratio, NULL));
    assert_true(ratio.value == 3.0);
    for (int i = 0; i < 8; i++) {
        ms[i] = NAN;
    }
    DipError err = {0};
    assert_false(dip_paired_ratio(&times, &ratio, &err));
    assert_non_null(strstr(err.message, "disturbed"));
}

static void a_single_round_has_no_interval(void **state) {
    (void)state;
    const DipPairedTimes times = {(double[]){2.0}, (double[]){1.0}, 1, 1};
    DipStatsEstimate ratio;
    assert_true(dip_paired_ratio(&times, &ratio, NULL));
    assert_true(ratio.value == 2.0 && ratio.low == 0.0 && isinf(ratio.high));
}

static void spread_is_that_of_the_rounds(void **state) {
    (void)state;
    double base[5] = {1, 1, 1, 1, 1};
    double ms[5] = {exp(-0.2), exp(-0.1), 1.0, exp(0.1), exp(0.3)};
    const DipPairedTimes times = {ms, base, 5, 1};
    assert_true(fabs(dip_paired_spread(&times) - 1.4826 * 0.1) < 1e-9);
}

// --- along a path --------------------------------------------------------------------------------

enum { PATH_FRAMES = 240, TIMED = 64, PATH_ROUNDS = 16, PATH_RUNS = 200, COST = 50, LEVELS = 10 };

// Times of a path's frames: a smoothed random walk whose worst frame takes some 1.5 times the mean.
static void path_curve(NoiseRandom *random, double *ms) {
    static double walk[PATH_FRAMES];
    double at = 0.0, mean = 0.0, squares = 0.0;
    for (int f = 0; f < PATH_FRAMES; f++) {
        at += noise_normal(random);
        walk[f] = at;
    }
    for (int f = 0; f < PATH_FRAMES; f++) {
        ms[f] = 0.0;
        for (int d = -12; d <= 12; d++) {
            const int i = f + d < 0 ? 0 : f + d >= PATH_FRAMES ? PATH_FRAMES - 1 : f + d;
            ms[f] += walk[i] / 25.0;
        }
        mean += ms[f] / PATH_FRAMES;
    }
    for (int f = 0; f < PATH_FRAMES; f++) {
        squares += (ms[f] - mean) * (ms[f] - mean) / PATH_FRAMES;
    }
    for (int f = 0; f < PATH_FRAMES; f++) {
        ms[f] = 7.0 * exp(0.17 * (ms[f] - mean) / sqrt(squares));
    }
}

typedef struct PathTruth {
    double ratio, p95, worst;
} PathTruth;

// Simulates the times of a row and of its base along a path.
static PathTruth simulate_path(NoiseKind kind, NoiseRandom *random, double *noise, double ms[TIMED],
                               double base_ms[TIMED], double level_ms[TIMED], double *level_error) {
    double base[PATH_FRAMES], row[PATH_FRAMES], sorted[PATH_FRAMES];
    path_curve(random, base);
    path_curve(random, row);
    PathTruth truth = {0};
    double total = 0.0, base_total = 0.0;
    for (int f = 0; f < PATH_FRAMES; f++) {
        row[f] = base[f] * 1.6 * exp(0.06 * log(row[f] / 7.0) / 0.17);
        total += row[f];
        base_total += base[f];
        truth.worst = fmax(truth.worst, row[f]);
    }
    truth.ratio = total / base_total;
    truth.p95 = dip_stats_quantile(row, PATH_FRAMES, 0.95, sorted);
    noise_run(kind, random, noise, TIMED * COST);
    for (int j = 0; j < TIMED; j++) {
        const int f = (int)((j + 0.5) * PATH_FRAMES / TIMED);
        const int turn = j % PATH_ROUNDS * (TIMED / PATH_ROUNDS) + j / PATH_ROUNDS;
        const double *at = noise + turn * COST;
        ms[j] = row[f] * exp(at[noise_below(random, 12)] + 0.004 * noise_normal(random));
        base_ms[j] = base[f] * exp(at[12 + noise_below(random, 12)] + 0.004 * noise_normal(random));
        double levels[LEVELS];
        for (int i = 0; i < LEVELS; i++) {
            levels[i] = base[f] * exp(noise[noise_below(random, TIMED * COST)]);
        }
        level_ms[j] = dip_stats_median(levels, LEVELS);
    }
    *level_error = dip_level_error(noise, TIMED * COST);
    return truth;
}

typedef struct PathScore {
    double ratio_covered, p95_held, p95_bias, p95_excess;
} PathScore;

static PathScore score_path(NoiseKind kind) {
    static double biases[PATH_RUNS], excesses[PATH_RUNS];
    NoiseRandom random = {99 + (uint64_t)kind};
    double *noise = malloc(TIMED * COST * sizeof *noise);
    assert_non_null(noise);
    PathScore result = {0};
    for (int i = 0; i < PATH_RUNS; i++) {
        double ms[TIMED], base_ms[TIMED], level_ms[TIMED], level_error;
        const PathTruth truth =
            simulate_path(kind, &random, noise, ms, base_ms, level_ms, &level_error);
        const DipPathTimes times = {ms, base_ms, level_ms, TIMED, PATH_ROUNDS, level_error};
        DipPathEstimate got;
        assert_true(dip_path_estimate(&times, &got, NULL));
        const bool covered = got.ratio.low <= truth.ratio && truth.ratio <= got.ratio.high;
        result.ratio_covered += covered / (double)PATH_RUNS;
        result.p95_held += (truth.p95 <= got.p95_ms.high) / (double)PATH_RUNS;
        biases[i] = log(got.p95_ms.value / truth.p95);
        excesses[i] = log(got.p95_ms.high / truth.p95);
    }
    free(noise);
    result.p95_bias = dip_stats_median(biases, PATH_RUNS);
    result.p95_excess = dip_stats_median(excesses, PATH_RUNS);
    return result;
}

// A level that drifts over the whole run is seen only between runs, so the bound holds less often
// there.
static void path_bounds_hold_the_truth(void **state) {
    (void)state;
    for (int k = 0; k < NOISE_KIND_COUNT; k++) {
        const PathScore got = score_path((NoiseKind)k);
        print_message("path, %-6s ratio covered %5.1f %%; 95th percentile: bias %+.1f %%, bound "
                      "holds %5.1f %%, exceeds by %.1f %%\n",
                      noise_names[k], 100.0 * got.ratio_covered, 100.0 * got.p95_bias,
                      100.0 * got.p95_held, 100.0 * got.p95_excess);
        assert_true(got.ratio_covered >= 0.94);
        assert_true(got.p95_held >= (k == NOISE_DRIFT ? 0.70 : 0.93));
    }
}

static void a_path_without_noise_is_exact(void **state) {
    (void)state;
    double ms[TIMED], base_ms[TIMED];
    double total = 0.0, base_total = 0.0;
    for (int f = 0; f < TIMED; f++) {
        base_ms[f] = 5.0 + 0.01 * f;
        ms[f] = 2.0 * base_ms[f];
        total += ms[f];
        base_total += base_ms[f];
    }
    const DipPathTimes times = {ms, base_ms, base_ms, TIMED, PATH_ROUNDS, 0.0};
    DipPathEstimate got;
    assert_true(dip_path_estimate(&times, &got, NULL));
    assert_true(fabs(got.ratio.value - total / base_total) < 1e-12);
    assert_true(fabs(got.mean_ms.value - total / TIMED) < 1e-12);
    assert_true(fabs(got.worst_ms.value - ms[TIMED - 1]) < 1e-12);
    assert_int_equal(got.used, TIMED);
    // A third of the pairs dropped: the rest tells the same.
    for (int f = 0; f < TIMED; f += 3) {
        ms[f] = NAN;
    }
    assert_true(dip_path_estimate(&times, &got, NULL));
    assert_true(fabs(got.ratio.value - 2.0) < 1e-12 && got.used == TIMED - 22);
    assert_true(log(got.ratio.high / got.ratio.value) > 0.02); // 1 %, times t.
    for (int f = 0; f < TIMED; f++) {
        ms[f] = f % 3 ? NAN : ms[f];
    }
    DipError err = {0};
    assert_false(dip_path_estimate(&times, &got, &err));
    assert_non_null(strstr(err.message, "disturbed"));
}

// --- Student's t ---------------------------------------------------------------------------------

// Published tables of the distribution (for example NIST's handbook, section 1.3.6.7.2).
static void student_has_the_published_quantiles(void **state) {
    (void)state;
    static const struct {
        double probability;
        int degrees;
        double value;
    } table[] = {{0.975, 1, 12.706}, {0.975, 2, 4.303},  {0.975, 3, 3.182},  {0.975, 6, 2.447},
                 {0.975, 13, 2.160}, {0.975, 15, 2.131}, {0.975, 30, 2.042}, {0.975, 100, 1.984},
                 {0.95, 5, 2.015},   {0.995, 10, 3.169}, {0.9, 7, 1.415}};
    for (size_t i = 0; i < DIP_ARRAY_COUNT(table); i++) {
        const double got = dip_student_quantile(table[i].probability, table[i].degrees);
        assert_true(fabs(got - table[i].value) < 6e-4);
    }
    assert_true(fabs(dip_student_quantile(0.5, 4)) < 1e-9);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ratio_intervals_hold_the_truth),
        cmocka_unit_test(pooled_medians_fall_between_clusters),
        cmocka_unit_test(even_pairs_have_an_exact_ratio),
        cmocka_unit_test(dropped_pairs_take_no_part),
        cmocka_unit_test(a_single_round_has_no_interval),
        cmocka_unit_test(spread_is_that_of_the_rounds),
        cmocka_unit_test(path_bounds_hold_the_truth),
        cmocka_unit_test(a_path_without_noise_is_exact),
        cmocka_unit_test(student_has_the_published_quantiles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
