// Two programs that are started anew several times, on simulated noise: how often is an equal
// program called slower, and how often is a slower one found?
#include "app/measure/stats/paired_starts.h"
#include "tests/app/measure/noise.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

enum { STARTS = 6, ROUNDS = 8, FRAMES = 6, COUNT = STARTS * ROUNDS * FRAMES };

static const double limit = 1.01; // A lower bound above this is an alarm.
static const double frame_ms[FRAMES] = {9.0, 6.5, 5.2, 7.0, 6.0, 8.0};

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
static void simulate(Duel *duel, NoiseKind kind, Luck luck, double slower, NoiseRandom *random) {
    double noise[2 * ROUNDS * FRAMES];
    for (int s = 0; s < STARTS; s++) {
        const double own_luck = luck_of_start(luck, random);
        noise_run(kind, random, noise, 2 * ROUNDS * FRAMES);
        for (int i = 0; i < ROUNDS * FRAMES; i++) {
            const int first = noise_below(random, 2);
            const double ms = frame_ms[i % FRAMES];
            const double own = 0.01 * noise_normal(random), base_own = 0.01 * noise_normal(random);
            const int at = s * ROUNDS * FRAMES + i;
            duel->base_ms[at] = ms * exp(noise[2 * i + first] + base_own);
            duel->ms[at] = ms * slower * exp(noise[2 * i + 1 - first] + own + own_luck);
        }
    }
}

typedef struct Alarms {
    int starts; // Of dip_paired_starts_ratio.
    int rounds; // Of the bootstrap over all rounds, as if the starts had no luck of their own.
} Alarms;

static Alarms count_alarms(NoiseKind kind, Luck luck, double slower, int runs) {
    static Duel duel;
    Alarms alarms = {0};
    NoiseRandom random = {17};
    for (int run = 0; run < runs; run++) {
        DipEstimate ratio;
        simulate(&duel, kind, luck, slower, &random);
        assert_true(dip_paired_starts_ratio(
            &(DipPairedStarts){duel.ms, duel.base_ms, STARTS, ROUNDS, FRAMES}, &ratio, NULL));
        alarms.starts += ratio.low > limit;
        if (luck == LOAD_LUCK) {
            assert_true(dip_paired_ratio(
                &(DipPairedTimes){duel.ms, duel.base_ms, STARTS * ROUNDS, FRAMES}, &ratio, NULL));
            alarms.rounds += ratio.low > limit;
        }
    }
    print_message("%-7s luck %s, slower by %.0f %%: %d of %d runs raise an alarm\n",
                  noise_names[kind], luck == QUIET_LUCK ? ".6 %" : "25 %", 100.0 * (slower - 1.0),
                  alarms.starts, runs);
    return alarms;
}

static const NoiseKind kinds[] = {NOISE_QUIET, NOISE_BURSTS, NOISE_TAILS};

static void equal_programs_raise_no_alarm(void **state) {
    (void)state;
    for (int k = 0; k < 3; k++) {
        assert_in_range(count_alarms(kinds[k], QUIET_LUCK, 1.0, 400).starts, 0, 8);
    }
}

static void three_per_cent_are_found(void **state) {
    (void)state;
    for (int k = 0; k < 3; k++) {
        assert_in_range(count_alarms(kinds[k], QUIET_LUCK, 1.03, 200).starts, 160, 200);
    }
}

// Each start beside a load has luck of 25 %. The bootstrap over rounds takes this luck for a
// difference between the programs.
static void the_luck_of_starts_raises_no_alarm(void **state) {
    (void)state;
    for (int k = 0; k < 3; k += 2) {
        const Alarms alarms = count_alarms(kinds[k], LOAD_LUCK, 1.0, 400);
        assert_in_range(alarms.starts, 0, 16);
        assert_in_range(alarms.rounds, 60, 400); // The bootstrap fails the same test.
    }
}

// --- the definition ------------------------------------------------------------------------------

// Without noise within the starts, the interval is Student's t over the starts' log ratios 0, .01
// and .03. The means of all pairs are 0, .005, .01, .015, .02 and .03, with the median .0125. The
// sum of the squared distances from the mean is .000466667, so s / sqrt(3) is .00881917. t with two
// degrees of freedom is 4.30265273 (Abramowitz and Stegun, table 26.10).
static void the_interval_is_students_t_over_the_starts(void **state) {
    (void)state;
    const double logs[3] = {0.0, 0.01, 0.03};
    double ms[12], base_ms[12];
    for (int i = 0; i < 12; i++) {
        base_ms[i] = 1.0 + i % 2;
        ms[i] = base_ms[i] * exp(logs[i / 4]);
    }
    DipEstimate ratio;
    assert_true(dip_paired_starts_ratio(&(DipPairedStarts){ms, base_ms, 3, 2, 2}, &ratio, NULL));
    const double half = 4.30265273 * sqrt(0.0014 / 3.0 / 2.0 / 3.0);
    assert_true(fabs(log(ratio.value) - 0.01) < 1e-12);
    assert_true(fabs(log(ratio.high) - (0.0125 + half)) < 1e-9);
    assert_true(fabs(log(ratio.low) - (0.0125 - half)) < 1e-9);
}

static void starts_without_pairs_take_no_part(void **state) {
    (void)state;
    double ms[8] = {2.0, 2.0, NAN, NAN, 2.0, NAN, NAN, NAN}, base_ms[8];
    for (int i = 0; i < 8; i++) {
        base_ms[i] = 1.0;
    }
    DipEstimate ratio;
    DipError err = {0};
    const DipPairedStarts times = {ms, base_ms, 4, 1, 2};
    assert_true(dip_paired_starts_ratio(&times, &ratio, &err));
    assert_true(fabs(ratio.value - 2.0) < 1e-12 && ratio.low > 1.9 && ratio.high < 2.1);
    ms[4] = NAN;
    assert_true(dip_paired_starts_ratio(&times, &ratio, &err));
    assert_true(isnan(ratio.low) && isnan(ratio.high));
    ms[0] = ms[1] = NAN;
    assert_false(dip_paired_starts_ratio(&times, &ratio, &err));
    assert_int_equal(err.code, DIP_ERROR_RUNTIME);
}

static void differences_have_an_error_over_the_starts(void **state) {
    (void)state;
    // Per start: frames' medians of three rounds, and their mean.
    const double ms[18] = {1.0, 3.0, 1.5, 3.0, 9.0, 3.5, //  medians .5, 1 -> .75
                           1.0, 2.0, 1.0, 2.0, 1.0, 2.0, //  0, 0 -> 0
                           NAN, 4.0, NAN, 4.0, NAN, NAN};
    const double base_ms[18] = {1.0, 2.0, 1.0, 2.0, 1.0, 2.0, 1.0, 2.0, 1.0,
                                2.0, 1.0, 2.0, 1.0, 2.0, 1.0, 2.0, 1.0, 2.0};
    double per_start[3];
    DipStartDifference difference;
    assert_true(dip_paired_starts_difference(&(DipPairedStarts){ms, base_ms, 3, 3, 2}, &difference,
                                             per_start, NULL));
    assert_true(per_start[0] == 0.75 && per_start[1] == 0.0 && per_start[2] == 2.0);
    assert_true(fabs(difference.ms - 2.75 / 3.0) < 1e-12);
    // Standard deviation of .75, 0, 2: sqrt(1.0208333...).
    assert_true(fabs(difference.error - sqrt(1.0208333333333333 / 3.0)) < 1e-12);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_interval_is_students_t_over_the_starts),
        cmocka_unit_test(starts_without_pairs_take_no_part),
        cmocka_unit_test(differences_have_an_error_over_the_starts),
        cmocka_unit_test(equal_programs_raise_no_alarm),
        cmocka_unit_test(three_per_cent_are_found),
        cmocka_unit_test(the_luck_of_starts_raises_no_alarm),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
