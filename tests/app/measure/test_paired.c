// Estimates from paired times, on simulated noise whose truth is known: do intervals hold the truth
// as often as they say, and how wide are they?
#include "app/measure/stats/paired.h"
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
static DipEstimate pooled_ratio(const Run *run) {
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
    DipEstimate ratio = dip_estimate_unknown(dip_stats_quantile(values, RESAMPLES, 0.5, scratch));
    ratio.low = dip_stats_quantile(values, RESAMPLES, 0.025, scratch);
    ratio.high = dip_stats_quantile(values, RESAMPLES, 0.975, scratch);
    return ratio;
}

static DipEstimate paired_ratio(const Run *run) {
    const DipPairedTimes times = {run->ms, run->base_ms, ROUNDS, FRAMES};
    DipEstimate ratio;
    assert_true(dip_paired_ratio(&times, &ratio, NULL));
    return ratio;
}

typedef struct Score {
    double covered;    // Share of the intervals that hold the truth.
    double half_width; // Median half width of the intervals, as a logarithm.
    double bias;       // Median error, as a logarithm.
    double deviation;  // Standard deviation of the estimates' logarithm.
} Score;

static Score score(DipEstimate (*estimator)(const Run *), NoiseKind kind, Case which) {
    static double halves[RUNS], errors[RUNS];
    NoiseRandom random = {20261122 + (uint64_t)(kind * CASE_COUNT + which)};
    double *noise = noise_room();
    const double truth = truth_of(which);
    Score result = {0};
    double squares = 0.0;
    for (int i = 0; i < RUNS; i++) {
        Run run;
        simulate(&run, kind, which, &random, noise);
        const DipEstimate ratio = estimator(&run);
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
    DipEstimate ratio;
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
    DipEstimate ratio;
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
    DipEstimate ratio;
    assert_true(dip_paired_ratio(&times, &ratio, NULL));
    assert_true(ratio.value == 2.0 && isnan(ratio.low) && isnan(ratio.high));
}

static void spread_is_that_of_the_rounds(void **state) {
    (void)state;
    double base[5] = {1, 1, 1, 1, 1};
    double ms[5] = {exp(-0.2), exp(-0.1), 1.0, exp(0.1), exp(0.3)};
    const DipPairedTimes times = {ms, base, 5, 1};
    assert_true(fabs(dip_paired_spread(&times) - 1.4826 * 0.1) < 1e-9);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ratio_intervals_hold_the_truth),
        cmocka_unit_test(pooled_medians_fall_between_clusters),
        cmocka_unit_test(even_pairs_have_an_exact_ratio),
        cmocka_unit_test(dropped_pairs_take_no_part),
        cmocka_unit_test(a_single_round_has_no_interval),
        cmocka_unit_test(spread_is_that_of_the_rounds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
