// Logs in which every round draws every frame, on simulated noise whose truth is known: do
// intervals hold the truth as often as they say, how often is an equal program called slower, and
// how often is a slower one found?
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

enum { MOST = 288 }; // Frames of a subject.

// Fits subject 1 beside subject 0. The index of a time is (start * rounds + round) * frames +
// frame; a frame whose time is NAN was disturbed.
static DipTimesFit *fit_times(const double *ms, const double *base_ms, int starts, int rounds,
                              int frames) {
    static const int base_of[2] = {0};
    static DipTimed list[2 * MOST];
    const int count = starts * rounds * frames;
    assert_true(count <= MOST);
    for (int i = 0; i < 2 * count; i++) {
        const int at = i / 2;
        const bool disturbed = isnan(ms[at]);
        list[i] = (DipTimed){.subject = i % 2,
                             .start = at / (rounds * frames),
                             .round = at / frames % rounds,
                             .frame = at % frames,
                             .ms = i % 2 == 0  ? base_ms[at]
                                   : disturbed ? 1e6
                                               : ms[at],
                             .wait = disturbed ? 1.0 : 0.0};
    }
    const DipTimes times = {list, 2 * count, 2, starts, rounds, frames, base_of, .complete = true};
    DipTimesFit *fit = dip_times_fit(&times, NULL);
    assert_non_null(fit);
    return fit;
}

static DipEstimate ratio_of(const double *ms, const double *base_ms, int starts, int rounds,
                            int frames) {
    DipTimesFit *fit = fit_times(ms, base_ms, starts, rounds, frames);
    const DipEstimate ratio = dip_times_ratio(fit, 1);
    dip_times_fit_free(&fit);
    return ratio;
}

// --- rounds of one start -------------------------------------------------------------------------

enum { RUNS = 400, ROUNDS = 14, FRAMES = 4, BLOCKS = 40, BLOCK_ROWS = 4, SLOTS = FRAMES + 1 };

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
        values[i] = dip_median(all, ROUNDS * FRAMES);
    }
    DipEstimate ratio = dip_estimate_unknown(dip_percentile_of(values, RESAMPLES, 0.5, scratch));
    ratio.low = dip_percentile_of(values, RESAMPLES, 0.025, scratch);
    ratio.high = dip_percentile_of(values, RESAMPLES, 0.975, scratch);
    return ratio;
}

static DipEstimate log_ratio(const Run *run) {
    return ratio_of(run->ms, run->base_ms, 1, ROUNDS, FRAMES);
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
    result.half_width = dip_median(halves, RUNS);
    result.bias = dip_median(errors, RUNS);
    result.deviation = sqrt(squares);
    return result;
}

// The bounds of the half widths are 1.3 times those of the bootstrap over rounds, in another
// implementation with other random numbers.
static void intervals_of_rounds_hold_the_truth(void **state) {
    (void)state;
    static const double study[CASE_COUNT][NOISE_KIND_COUNT] = {{0.024, 0.012, 0.012, 0.019, 0.024},
                                                               {0.024, 0.012, 0.012, 0.019, 0.024}};
    for (int c = 0; c < CASE_COUNT; c++) {
        for (int k = 0; k < NOISE_KIND_COUNT; k++) {
            const Score got = score(log_ratio, (NoiseKind)k, (Case)c);
            print_message("%-8s %-6s covered %5.1f %%, half width %.2f %%, bias %+.2f %%\n",
                          case_names[c], noise_names[k], 100.0 * got.covered,
                          100.0 * got.half_width, 100.0 * got.bias);
            assert_true(got.covered >= 0.93 && got.covered <= 0.98);
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

static void even_rounds_have_an_exact_ratio(void **state) {
    (void)state;
    double base[6] = {1.0, 10.0, 2.0, 20.0, 4.0, 40.0}, ms[6];
    for (int i = 0; i < 6; i++) {
        ms[i] = base[i] * (i % 2 ? 3.0 : 2.0);
    }
    const DipEstimate ratio = ratio_of(ms, base, 1, 3, 2);
    assert_true(fabs(ratio.value - (2.0 + 10.0 * 3.0) / 11.0) < 1e-9);
    // The machine became slower from round to round, but that cancels. What is left is the error
    // that repetition never shows.
    assert_true(fabs(ratio.log_error - 0.001) < 1e-6);
}

static void disturbed_frames_take_no_part(void **state) {
    (void)state;
    const double base[8] = {1, 1, 1, 1, 1, 1, 1, 1};
    const double ms[8] = {2, 4, NAN, 4, 2, NAN, 2, 4};
    DipTimesFit *fit = fit_times(ms, base, 1, 4, 2);
    assert_true(fabs(dip_times_ratio(fit, 1).value - 3.0) < 1e-9);
    assert_int_equal(dip_times_along(fit, 1).kept, 6);
    dip_times_fit_free(&fit);
}

static void a_single_round_has_no_interval(void **state) {
    (void)state;
    const DipEstimate ratio = ratio_of((double[]){2.0}, (double[]){1.0}, 1, 1, 1);
    assert_true(fabs(ratio.value - 2.0) < 1e-12 && isnan(ratio.low) && isnan(ratio.high));
}

static void spread_is_that_of_the_rounds(void **state) {
    (void)state;
    const double base[5] = {1, 1, 1, 1, 1};
    const double ms[5] = {exp(-0.2), exp(-0.1), 1.0, exp(0.1), exp(0.3)};
    DipTimesFit *fit = fit_times(ms, base, 1, 5, 1);
    assert_true(fabs(dip_times_spread(fit, 1) - 1.4826 * 0.1) < 1e-9);
    dip_times_fit_free(&fit);
}

// --- starts --------------------------------------------------------------------------------------

enum { STARTS = 6, PER_START = 8, PATH = 6, COUNT = STARTS * PER_START * PATH };

static const double limit = 1.01; // A lower bound above this is an alarm.
static const double frame_ms[PATH] = {9.0, 6.5, 5.2, 7.0, 6.0, 8.0};

// The luck of a start, as a logarithm.
typedef enum Luck {
    QUIET_LUCK, // .6 % times Student's t with 3 degrees: between starts on a quiet machine.
    LOAD_LUCK   // 25 %: beside another program that keeps to one core.
} Luck;

typedef struct Duel {
    double ms[COUNT];
    double base_ms[COUNT];
} Duel;

static double luck_of_start(Luck luck, NoiseRandom *random) {
    return luck == QUIET_LUCK ? 0.006 * noise_student(random, 3) : 0.25 * noise_normal(random);
}

// The two programs take turns at every frame. Which one is first is drawn anew. 1 % of noise is
// each frame's own.
static void simulate_duel(Duel *duel, NoiseKind kind, Luck luck, double slower,
                          NoiseRandom *random) {
    double noise[2 * PER_START * PATH];
    for (int s = 0; s < STARTS; s++) {
        const double own_luck = luck_of_start(luck, random);
        noise_run(kind, random, noise, 2 * PER_START * PATH);
        for (int i = 0; i < PER_START * PATH; i++) {
            const int first = noise_below(random, 2);
            const double ms = frame_ms[i % PATH];
            const double own = 0.01 * noise_normal(random), base_own = 0.01 * noise_normal(random);
            const int at = s * PER_START * PATH + i;
            duel->base_ms[at] = ms * exp(noise[2 * i + first] + base_own);
            duel->ms[at] = ms * slower * exp(noise[2 * i + 1 - first] + own + own_luck);
        }
    }
}

typedef struct Alarms {
    int starts;     // By the starts.
    int rounds;     // By all rounds, as if the starts had no luck of their own.
    double covered; // Share of the intervals that hold the truth.
} Alarms;

static Alarms count_alarms(NoiseKind kind, Luck luck, double slower, int runs) {
    static Duel duel;
    Alarms alarms = {0};
    NoiseRandom random = {17};
    for (int run = 0; run < runs; run++) {
        DipEstimate ratio;
        simulate_duel(&duel, kind, luck, slower, &random);
        ratio = ratio_of(duel.ms, duel.base_ms, STARTS, PER_START, PATH);
        alarms.starts += ratio.low > limit;
        alarms.covered += (ratio.low <= slower && slower <= ratio.high) / (double)runs;
        if (luck == LOAD_LUCK) {
            ratio = ratio_of(duel.ms, duel.base_ms, 1, STARTS * PER_START, PATH);
            alarms.rounds += ratio.low > limit;
        }
    }
    print_message(
        "%-7s luck %s, slower by %.0f %%: %d of %d runs raise an alarm, covered %.1f %%\n",
        noise_names[kind], luck == QUIET_LUCK ? ".6 %" : "25 %", 100.0 * (slower - 1.0),
        alarms.starts, runs, 100.0 * alarms.covered);
    return alarms;
}

static const NoiseKind kinds[] = {NOISE_QUIET, NOISE_BURSTS, NOISE_TAILS};

static void equal_programs_raise_no_alarm(void **state) {
    (void)state;
    for (int k = 0; k < 3; k++) {
        const Alarms alarms = count_alarms(kinds[k], QUIET_LUCK, 1.0, 400);
        assert_in_range(alarms.starts, 0, 8);
        assert_true(alarms.covered >= 0.93 && alarms.covered <= 0.98);
    }
}

static void three_per_cent_are_found(void **state) {
    (void)state;
    for (int k = 0; k < 3; k++) {
        assert_in_range(count_alarms(kinds[k], QUIET_LUCK, 1.03, 200).starts, 160, 200);
    }
}

// Each start beside a load has luck of 25 %. Whoever takes rounds for units takes this luck for a
// difference between the programs.
static void the_luck_of_starts_raises_no_alarm(void **state) {
    (void)state;
    for (int k = 0; k < 3; k += 2) {
        const Alarms alarms = count_alarms(kinds[k], LOAD_LUCK, 1.0, 400);
        assert_in_range(alarms.starts, 0, 16);
        assert_in_range(alarms.rounds, 60, 400); // Rounds as units fail the same test.
    }
}

// Without noise within the starts, the interval is Student's t over the starts' log ratios 0, .01
// and .03. The sum of the squared distances from their mean is .000466667, and .001 is added to the
// error in quadrature. The means of all pairs of rounds have the median .01.
static void the_interval_is_students_t_over_the_starts(void **state) {
    (void)state;
    const double logs[3] = {0.0, 0.01, 0.03};
    double ms[12], base_ms[12];
    for (int i = 0; i < 12; i++) {
        base_ms[i] = 1.0 + i % 2;
        ms[i] = base_ms[i] * exp(logs[i / 4]);
    }
    const DipEstimate ratio = ratio_of(ms, base_ms, 3, 2, 2);
    assert_true(ratio.value > exp(0.0099) && ratio.value < exp(0.0151));
    assert_true(fabs(ratio.log_error - sqrt(0.0014 / 3.0 / 2.0 / 3.0 + 1e-6)) < 1e-9);
    assert_true(ratio.degrees >= 2.0 && ratio.degrees < 2.1);
}

static void starts_without_times_take_no_part(void **state) {
    (void)state;
    double ms[8] = {2.0, 2.0, NAN, NAN, 2.0, NAN, 2.0, 2.0}, base_ms[8];
    for (int i = 0; i < 8; i++) {
        base_ms[i] = 1.0;
    }
    const DipEstimate ratio = ratio_of(ms, base_ms, 4, 1, 2);
    assert_true(fabs(ratio.value - 2.0) < 1e-9 && ratio.low > 1.9 && ratio.high < 2.1);
    const double one[8] = {2.0, 2.0, 2.0, 2.0, NAN, NAN, NAN, 2.0};
    assert_false(isnan(ratio_of(one, base_ms, 2, 2, 2).low));
    const double none[8] = {2.0, 2.0, 2.0, 2.0, NAN, NAN, NAN, NAN};
    assert_true(isnan(ratio_of(none, base_ms, 2, 2, 2).low)); // A single start is left.
}

// Only the second part takes longer: half of the base's time more.
static void a_part_alone_has_a_ratio(void **state) {
    (void)state;
    static const int base_of[2] = {0};
    DipTimed list[24];
    for (int i = 0; i < 24; i++) {
        const double frame = 1.0 + i / 2 % 2, slow = 1.0 + i % 2;
        list[i] = (DipTimed){.subject = i % 2,
                             .start = i / 8,
                             .round = i / 4 % 2,
                             .frame = i / 2 % 2,
                             .ms = frame * (0.5 + 0.5 * slow),
                             .parts_ms = {0.3 * frame, 0.5 * slow * frame}};
    }
    const DipTimes times = {list, 24, 2, 3, 2, 2, base_of, .complete = true};
    const double expected[] = {1.0, 1.5, 1.0};
    for (int part = 0; part < 3; part++) {
        DipTimesFit *fit = dip_times_fit_part(&times, part, NULL);
        assert_true(fabs(dip_times_ratio(fit, 1).value - expected[part]) < 1e-9);
        assert_true(fabs(dip_times_along(fit, 0).mean_ms.value - 1.5) < 1e-9);
        assert_true(fabs(dip_times_shares(fit, 0)[1] - 0.5) < 1e-9);
        assert_true(fabs(dip_times_shares(fit, 1)[1] - 2.0 / 3.0) < 1e-9);
        dip_times_fit_free(&fit);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(intervals_of_rounds_hold_the_truth),
        cmocka_unit_test(pooled_medians_fall_between_clusters),
        cmocka_unit_test(even_rounds_have_an_exact_ratio),
        cmocka_unit_test(disturbed_frames_take_no_part),
        cmocka_unit_test(a_single_round_has_no_interval),
        cmocka_unit_test(spread_is_that_of_the_rounds),
        cmocka_unit_test(the_interval_is_students_t_over_the_starts),
        cmocka_unit_test(starts_without_times_take_no_part),
        cmocka_unit_test(a_part_alone_has_a_ratio),
        cmocka_unit_test(equal_programs_raise_no_alarm),
        cmocka_unit_test(three_per_cent_are_found),
        cmocka_unit_test(the_luck_of_starts_raises_no_alarm),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
